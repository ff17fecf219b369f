// The parts of native/collision that make impulses of contacts, and account for them.
#include "../../../native/collision/dynamics/contact_frame.hpp"
#include "../../../native/collision/dynamics/self_stress.hpp"
#include "../../../native/collision/responses.hpp"
#include "../../../native/collision/solvers/energy_split.hpp"
#include "kernels.hpp"

using namespace shipcollision;

namespace {

// Bodies that touch, and impulses at their contacts.
struct Patch {
  Memory memory;
  Buffer<BodyState> states{memory};
  Buffer<Impulse> impulses{memory};
  Buffer<Contact> contacts{memory};
  double mu, e;
};

BodyState take_body(Take& take) {
  BodyState state = take_state(take);
  state.has_held = take.real() != 0.0;
  state.held = take.all<Rows>();
  const bool has_bias = take.real() != 0.0;
  const Six bias = take.all<Six>();
  if (has_bias) state.expect(bias, nullptr);
  return state;
}

void take_patch(Take& take, Patch& patch) {
  for (int bodies = take.whole(); bodies > 0; --bodies) patch.states.add(take_body(take));
  for (int contacts = take.whole(); contacts > 0; --contacts) {
    const int a = take.whole(), b = take.whole();
    const Three point = take.all<Three>(), normal = take.all<Three>();
    const double gap = take.real();
    const Contact contact = make_contact(a, b, patch.states.data(), point, gap, contact_axes(normal));
    patch.impulses.add({contact, take.all<Three>()});
    patch.contacts.add(contact);
  }
  patch.mu = take.real();
  patch.e = take.real();
}

void put_matrix(Put& put, const Dense& A) {
  for (int i = 0; i < A.rows(); ++i) {
    for (int j = 0; j < A.columns(); ++j) put.real(A[i][j]);
  }
}

void put_twists(Put& put, const Patch& patch) {
  for (const BodyState& state : patch.states) {
    put.all(state.nu);
    put.all(state.issued);
  }
}

void operators(const double* in, double* out) {
  Take take{in};
  Put put{out};
  Patch patch;
  take_patch(take, patch);
  const int count = patch.contacts.size();
  const Contact* contacts = patch.contacts.data();
  const BodyState* states = patch.states.data();
  Delassus delassus(patch.memory);
  delassus.reserve(count);
  approach_velocities(contacts, count, states, put.out);
  put.out += 3 * count;
  put_matrix(put, delassus.find_operator(contacts, count, states));
  put.all(find_mobility(contacts[0], states));
  const Dense* H = delassus.find_held_operator(contacts, count, states);
  Rows alone;
  put.real(H != nullptr);
  put.real(find_held_mobility(contacts[0], states, alone));
  if (H != nullptr) put_matrix(put, *H);
  put.all(alone);
}

void passivity(const double* in, double* out) {
  Take take{in};
  Put put{out};
  Patch patch;
  take_patch(take, patch);
  Passivity passivity(patch.memory);
  put.real(passivity.enforce(patch.impulses, patch.states.data()));
  for (const auto& [contact, P] : patch.impulses) {
    put.real(contact.a);
    put.real(contact.b);
    put.real(contact.gap);
    put.all(P);
  }
}

void energy_split(const double* in, double* out) {
  Take take{in};
  Put put{out};
  Patch patch;
  take_patch(take, patch);
  const int count = patch.impulses.size();
  Buffer<Booked> booked(patch.memory);
  Buffer<Loss> losses(patch.memory);
  booked.resize(count);
  losses.resize(count);
  book_impulses(patch.impulses.data(), count, patch.states.data(), booked.data());
  EnergySplit split(patch.memory);
  split.split_losses(booked.data(), count, patch.states.data(), patch.mu, patch.e, losses.data());
  for (const Loss& loss : losses) put.all(loss);
}

void self_stress(const double* in, double* out) {
  Take take{in};
  Put put{out};
  Patch patch;
  take_patch(take, patch);
  SelfStress self_stress(patch.memory);
  self_stress.remove(patch.impulses.data(), patch.impulses.size(), patch.states.data(), patch.mu);
  for (const Impulse& impulse : patch.impulses) put.all(impulse.P);
  put_twists(put, patch);
}

// The response to the contacts, twice, with what the first left; and all that a substep does with its impulses.
void response(const double* in, double* out) {
  Take take{in};
  Put put{out};
  Patch patch;
  take_patch(take, patch);
  const int count = patch.contacts.size();
  Detector detector(patch.memory);
  const ContactProblem problem{nullptr, 0, patch.states.data(), detector, patch.mu, patch.e};
  ContactCaches caches(patch.memory);
  caches.work.renew(patch.states.size(), 0.1);
  ContactSolution solution(patch.memory);
  PgsResponse pgs(patch.memory);
  for (int i = 0; i < 2; ++i) {
    pgs.solve(patch.contacts.data(), count, problem, caches, solution);
    put.real(solution.residual);
    put.real(solution.sweeps);
    for (const Impulse& impulse : solution.impulses) put.all(impulse.P);
    for (BodyState& state : patch.states) {
      if (!state.fixed) state.set_twist(state.nu + state.nu_received);
    }
  }
  Passivity passivity(patch.memory);
  SelfStress self_stress(patch.memory);
  Buffer<Booked> booked(patch.memory);
  booked.resize(count);
  put.real(passivity.enforce(solution.impulses, patch.states.data()));
  book_impulses(solution.impulses.data(), count, patch.states.data(), booked.data());
  self_stress.remove(solution.impulses.data(), count, patch.states.data(), patch.mu);
  for (const Impulse& impulse : solution.impulses) put.all(impulse.P);
  put_twists(put, patch);
}

// A body as it is within a step: both poses, twists, inertia; 104 numbers.
BodyState take_moving_body(Take& take) {
  BodyState state;
  Matrix inverse{};
  state.start_at({}, {}, {}, inverse);
  state.applied = take.all<Pose>();
  state.predicted = take.all<Pose>();
  const Six nu = take.all<Six>();
  take.matrix(state.M_inverse);
  state.has_velocity_bias = take.real() != 0.0;
  state.velocity_bias = take.all<Six>();
  state.has_scheme_error = take.real() != 0.0;
  state.scheme_error = take.all<Six>();
  state.fixed = take.real() != 0.0;
  state.has_held = take.real() != 0.0;
  state.held = take.all<Rows>();
  state.set_twist(nu);
  return state;
}

// One substep from bodies, contacts and impulses of the substep before, as a running model had them.
void substep(const double* in, double* out) {
  Take take{in};
  Put put{out};
  Patch patch;
  ContactCaches caches(patch.memory);
  for (int bodies = take.whole(); bodies > 0; --bodies) patch.states.add(take_moving_body(take));
  for (int contacts = take.whole(); contacts > 0; --contacts) {
    const int a = take.whole(), b = take.whole();
    const Three point = take.all<Three>();
    const double gap = take.real();
    patch.contacts.add(make_contact(a, b, patch.states.data(), point, gap, take.all<Rows>()));
  }
  for (int starts = take.whole(); starts > 0; --starts) {
    const int a = take.whole(), b = take.whole();
    const Three place = take.all<Three>(), P = take.all<Three>();
    caches.warm_starts.rows().add({a, b, place, P});
  }
  const double mu = take.real(), e = take.real();
  const int count = patch.contacts.size();
  caches.work = StepWork(take.real());
  Detector detector(patch.memory);
  const ContactProblem problem{nullptr, 0, patch.states.data(), detector, mu, e};
  ContactSolution solution(patch.memory);
  PgsResponse pgs(patch.memory);
  pgs.solve(patch.contacts.data(), count, problem, caches, solution);
  put.real(solution.residual);
  put.real(solution.sweeps);
  Passivity passivity(patch.memory);
  EnergySplit split(patch.memory);
  SelfStress self_stress(patch.memory);
  Buffer<Booked> booked(patch.memory);
  Buffer<Loss> losses(patch.memory);
  booked.resize(count);
  losses.resize(count);
  put.real(passivity.enforce(solution.impulses, patch.states.data()));
  for (const Impulse& impulse : solution.impulses) put.all(impulse.P);
  book_impulses(solution.impulses.data(), count, patch.states.data(), booked.data());
  split.split_losses(booked.data(), count, patch.states.data(), mu, e, losses.data());
  for (const Loss& loss : losses) put.all(loss);
  self_stress.remove(solution.impulses.data(), count, patch.states.data(), mu);
  for (const Impulse& impulse : solution.impulses) put.all(impulse.P);
  put_twists(put, patch);
}

// in: W, v, mu, e, whether any motion is held, H
void losses(const double* in, double* out) {
  Take take{in};
  const Rows W = take.all<Rows>();
  const Three v = take.all<Three>();
  const double mu = take.real(), e = take.real(), holds = take.real();
  const Rows H = take.all<Rows>();
  Put{out}.all(estimate_losses(W, v, mu, e, holds != 0.0 ? &H : nullptr));
}

// The state of caches goes to others and back; in: pairs, and of each a, b, carrier, a place and an impulse
void caches(const double* in, double* out) {
  Take take{in};
  Memory memory;
  ContactCaches given(memory), restored(memory);
  Buffer<unsigned char> bytes(memory);
  for (int pairs = take.whole(); pairs > 0; --pairs) {
    const int a = take.whole(), b = take.whole(), carrier = take.whole();
    const Three place = take.all<Three>(), P = take.all<Three>();
    Impulse impulse{{}, P};
    impulse.contact.a = a;
    impulse.contact.b = b;
    impulse.contact.r_a = place;
    given.last_normals.set({a, b}, {carrier, place});
    given.warm_starts.keep_impulses(&impulse, 1);
  }
  ByteWriter counter;
  given.get_state(counter);
  bytes.resize(static_cast<int>(counter.size()));
  ByteWriter writer(bytes.data(), counter.size());
  given.get_state(writer);
  bool is_refused = true;
  for (size_t size = 0; size < counter.size(); ++size) {
    ByteReader damaged(bytes.data(), size);
    is_refused = is_refused && !restored.set_state(damaged);
  }
  ByteReader reader(bytes.data(), counter.size());
  Put put{out};
  put.real(is_refused && restored.set_state(reader) && reader.left() == 0);
  restored.forget_parted([](int, int b) { return b != 1; });
  for (const auto& [a, b, place, P] : restored.warm_starts.rows()) {
    const LastNormal* last = restored.last_normals.find({a, b});
    put.real(a);
    put.real(b);
    put.real(last->carrier);
    put.all(last->normal);
    put.all(place);
    put.all(P);
  }
}

constexpr Named KERNELS[] = {{"operators", operators},     {"passivity", passivity}, {"energy_split", energy_split},
                             {"self_stress", self_stress}, {"response", response},   {"losses", losses},
                             {"caches", caches},           {"substep", substep}};

}  // namespace

SHIPCOLLISION_EXPORT bool shipcollision_evaluate_impulses(const char* name, const double* in, size_t ins, double* out,
                                                          size_t outs, size_t count) {
  return evaluate(KERNELS, name, in, ins, out, outs, count);
}
