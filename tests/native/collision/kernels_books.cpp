// The books of the collision model: ledgers, other forces, collisions, contact points, diagnosis, and their words.
#include "../../../native/collision/checks.hpp"
#include "../../../native/collision/contact_points.hpp"
#include "../../../native/collision/delayed_impulses.hpp"
#include "../../../native/collision/diagnosis.hpp"
#include "../../../native/collision/dynamics/contact_frame.hpp"
#include "../../../native/collision/dynamics/other_forces.hpp"
#include "../../../native/collision/feedback.hpp"
#include "../../../native/collision/ship_names.hpp"
#include "../../../native/collision/totals.hpp"
#include "kernels.hpp"

using namespace shipcollision;

namespace {

Memory memory;

// in: feedback, M_inverse, reach, H, and of each of 8 steps whether impulses are applied at once, late or at random, a
// pose, a twist, what is applied at random, an impulse, and the pose of application
void ledger(const double* in, double* out) {
  Take take{in};
  Put put{out};
  const Feedback feedback = static_cast<Feedback>(take.whole());
  Matrix inverse;
  take.matrix(inverse);
  const double reach = take.real(), H = take.real();
  ImpulseLedger books;
  Six before{}, last{};
  for (int step = 0; step < 8; ++step) {
    const int mode = take.whole();
    const Pose pose = take.all<Pose>();
    Six nu = take.all<Six>();
    const Six any = take.all<Six>(), J = take.all<Six>();
    const Pose application = take.all<Pose>();
    if (mode == 0) nu = nu + multiply(inverse, last);
    const Six applied = mode == 0 ? books.issued() : mode == 1 ? before : any;
    before = books.issued();
    const Reading reading = books.read(feedback, pose, nu, applied, inverse, reach, H);
    books.close(reading, J, reading.nu, mode == 1 ? application : reading.pose);
    last = books.issued() - before;
    put.all(reading.nu);
    put.all(reading.applied_n);
    put.all(reading.pending);
    put.all(reading.deficit);
    put.real(reading.delay == Delay::one_step);
    put.real(reading.is_out_of_range);
    put.all(books.issued());
    put.real(books.is_settled());
    unsigned char bytes[2000];  // a state comes back
    ByteWriter writer(bytes, sizeof bytes);
    books.get_state(writer);
    books = ImpulseLedger();
    ByteReader reader(bytes, writer.size());
    put.real(books.set_state(reader) && reader.left() == 0);
  }
}

// in: number of a body, reach, H, t, two received states
void forces(const double* in, double* out) {
  Take take{in};
  Put put{out};
  const Body& body = get_kernel_bodies()[take.whole()];
  const double reach = take.real();
  ReceivedState before = take.all<ReceivedState>(), now = take.all<ReceivedState>();
  Matrix inverse;
  body.inverse_at(before.attitude, inverse);
  OtherForces found;
  bool is_any = false;
  Text why;
  if (!estimate_other_forces(before, now, inverse, body.r_bg, reach, body.has_coasting ? &body.coasting : nullptr, found,
                             is_any, why)) {
    return;
  }
  put.real(is_any);
  if (!is_any) found = {};
  put.all(found.velocity_bias);
  put.all(found.velocity_gain);
  put.all(is_any && found.has_scheme_error ? found.scheme_error : Six{});
}

void put_points(Put& put, const Buffer<ContactOutput>& outputs) {
  for (const ContactOutput& each : outputs) {
    const Three vectors[] = {each.point, each.normal, each.r_a, each.r_b, each.impulse, each.couple, each.first};
    for (const Three& vector : vectors) put.all(vector);
    const double reals[] = {each.gap,    each.impulse_normal, each.impulse_tangential, each.energy,
                            each.start, each.closing_speed,  each.angle};
    for (double real : reals) put.real(real);
    const int numbers[] = {each.ship_a, each.ship_b, each.collision, each.scratch};
    for (int number : numbers) put.real(number);
  }
}

// in: most points, three bodies, and of 12 instants the time and three contacts: bodies, point, normal, gap, P, losses
void contacts(const double* in, double* out) {
  Take take{in};
  Put put{out};
  const int most = take.whole();
  BodyState states[3] = {take_state(take), take_state(take), take_state(take)};
  const Answering answering[3] = {{false, true}, {true, false}, {false, true}};
  Collisions collisions(memory);
  collisions.set_up(2.0, answering, 3);
  ContactPoints points(memory);
  Buffer<Numbers> numbers(memory);
  Buffer<ContactOutput> outputs(memory);
  Totals totals;
  CollisionOutputs all(memory);
  for (int instant = 0; instant < 12; ++instant) {
    const double t = take.real();
    collisions.close_old(t);
    Impulse impulses[3];
    Loss losses[3];
    for (int i = 0; i < 3; ++i) {
      const int a = take.whole(), b = take.whole();
      const Three point = take.all<Three>(), normal = take.all<Three>();
      impulses[i].contact = make_contact(a, b, states, point, take.real(), contact_axes(normal));
      impulses[i].P = take.all<Three>();
      losses[i] = take.all<Loss>();
      put.real(collisions.is_recorded({a, b}));
      totals.add_energy(losses[i].normal, losses[i].tangential);
    }
    Contact each[3] = {impulses[0].contact, impulses[1].contact, impulses[2].contact};
    collisions.register_contacts(t, each, 3, states, numbers);
    points.merge_impulses(impulses, losses, 3, numbers);
    if (instant % 4 == 1) points.merge_contact_point(impulses[1], 3.0);
    totals.add(losses[0].normal * 1e-10, instant, losses[0].normal * 1e-5);
    bool is_colliding[3] = {};
    collisions.mark_bodies_in_collision(is_colliding);
    for (bool colliding : is_colliding) put.real(colliding);
    int open = 0;
    collisions.find_open_pair([&](const Pair& pair) { return (open = 10 * open + 3 * pair.a + pair.b, false); });
    put.real(open);
    if (instant % 4 == 3) {
      outputs.fill(most, {});
      points.fit(most);
      points.fill(outputs);
      put.real(points.are_active());
      put.real(points.latest_scratch());
      put_points(put, outputs);
      points.clear();
      totals.fill(all);
      put.all(all.energy);
      put.real(all.solver.residual);
      put.real(all.solver.sweeps + 100 * all.solver.unconverged + 10000 * all.solver.scaled);
    }
  }
  put.real(collisions.count());
  put.real(collisions.latest().closing_speed);
  put.real(collisions.latest().angle);
}

constexpr Named KERNELS[] = {{"ledger", ledger}, {"forces", forces}, {"contacts", contacts}};

void put_words(char*& words, const Text& text) {
  memcpy(words, text.get(), text.size());
  words += text.size();
  *words++ = '\n';
  *words = '\0';
}

}  // namespace

SHIPCOLLISION_EXPORT bool shipcollision_evaluate_books(const char* name, const double* in, size_t ins, double* out,
                                                       size_t outs, size_t count) {
  return evaluate(KERNELS, name, in, ins, out, outs, count) && !memory.is_exhausted;
}

// A number with so many decimals.
SHIPCOLLISION_EXPORT void shipcollision_fixed_number(double number, int decimals, char* words) {
  Text text;
  text.fixed_number(number, decimals);
  put_words(words, text);
}

// What is said of the names of ships.
SHIPCOLLISION_EXPORT void shipcollision_say_names(const char* const* names, int count, char* words) {
  Text text;
  check_ship_names(names, count, text);
  put_words(words, text);
}

// The feedback of a ship, or why not; and the finding of that code about the ship, with every number measured.
SHIPCOLLISION_EXPORT void shipcollision_say_feedback(const char* name, int own, const char* own_name, int common,
                                                     char* words) {
  CollisionShipParameters ship;
  ship.feedback = static_cast<Feedback>(own);
  strcpy(ship.feedback_name, own_name);
  Feedback chosen;
  Text text;
  if (choose_feedback(name, ship, static_cast<CommonFeedback>(common), chosen, text)) {
    text << SHIP_FEEDBACKS[static_cast<int>(chosen)];
  }
  put_words(words, text);
}

SHIPCOLLISION_EXPORT void shipcollision_say_finding(int code, const char* ship, double number, char* words) {
  Found found;
  found.finding = static_cast<Finding>(code);
  found.measured = {number, number, number, number, number, number, number, number, "knots", "other"};
  Text text;
  describe_finding(found, ship, text);
  put_words(words, text);
}

SHIPCOLLISION_EXPORT void shipcollision_say_delay(double t, double H, double speed, double thin, char* words) {
  Text text;
  describe_delayed_impulse(t, H, speed, "own", "target", thin, text);
  put_words(words, text);
}

SHIPCOLLISION_EXPORT void shipcollision_say_unconverged(double t, double H, double residual, char* words) {
  Totals totals;
  totals.add(residual, 3, 0.0);
  Text text;
  totals.describe_unconverged(t, H, text);
  put_words(words, text);
}

// What the parameters, a step and the received states of the opened bodies are refused with: numbers friction,
// restitution, substep, minimum_separation_time, clearance_range, response, t, H, and the states.
SHIPCOLLISION_EXPORT void shipcollision_say_checks(const double* in, char* words) {
  Take take{in};
  CollisionParameters p(memory);
  p.friction = take.real();
  p.restitution = take.real();
  p.substep = take.real();
  p.minimum_separation_time = take.real();
  p.clearance_range = take.real();
  p.response = static_cast<Response>(take.whole());
  Text text, step;
  check_parameters(p, text);
  put_words(words, text);
  const double t = take.real(), H = take.real();
  CollisionInputs inputs(memory);
  for (int i = 0; i < get_kernel_bodies().ships(); ++i) inputs.ships.add(take.all<ShipState>());
  check_step(t, H, get_kernel_bodies(), inputs, step);
  put_words(words, step);
}

// What diagnosis says in a run of the opened bodies: of each step t, H, whether contact gave impulses, and of each ship
// what is received and the impulse issued. absent: of each ship; gap: of the first two at the start.
SHIPCOLLISION_EXPORT void shipcollision_say_diagnosis(int steps, const double* in, const double* absent, double gap,
                                                      char* words) {
  const Bodies& bodies = get_kernel_bodies();
  Take take{in};
  ImpulseLedger ledgers[8];
  bool is_absent[8];
  for (int i = 0; i < bodies.ships(); ++i) is_absent[i] = absent[i] != 0.0;
  CollisionInputs inputs(memory);
  inputs.ships.fill(bodies.ships(), {});
  DiagnosisOutput out;
  Diagnosis diagnosis(bodies, ledgers, inputs, out, memory);
  Buffer<NearPair> near(memory);
  near.add({{0, 1}, gap, 0.0});
  static unsigned char bytes[20000];
  for (int step = 0; step < steps; ++step) {
    const double t = take.real(), H = take.real();
    const bool has_touched = take.real() != 0.0;
    for (int i = 0; i < bodies.ships(); ++i) {
      ShipState& ship = inputs.ships[i];
      ship = take.all<ShipState>();
      const Six J = take.all<Six>();
      Matrix inverse;
      bodies[i].inverse_at(ship.attitude, inverse);
      const Pose pose{ship.position, rotation_rows(ship.attitude[0], ship.attitude[1], ship.attitude[2])};
      const Reading reading =
          ledgers[i].read(bodies[i].feedback, pose, ship.nu(), ship.impulse_applied, inverse, 100.0, H);
      ledgers[i].close(reading, J, reading.nu, reading.pose);
    }
    if (t < diagnosis.due() && !has_touched) continue;
    Text said;
    diagnosis.examine(t, H, is_absent, near, has_touched, said);
    if (!said.is_empty()) {
      Text line;
      line << step << " " << said;
      put_words(words, line);
    }
    ByteWriter writer(bytes, sizeof bytes);
    diagnosis.get_state(writer);
    ByteReader reader(bytes, writer.size());
    if (!diagnosis.set_state(reader) || reader.left() != 0) return;
  }
  Text line;
  line << out.code << " " << out.ship << " " << out.count << " " << out.text;
  put_words(words, line);
}
