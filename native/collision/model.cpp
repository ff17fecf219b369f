#include "model.hpp"

#include <string.h>

#include "checks.hpp"
#include "conservative_advancement.hpp"
#include "contact_points.hpp"
#include "delayed_impulses.hpp"
#include "diagnosis.hpp"
#include "dynamics/passivity.hpp"
#include "dynamics/self_stress.hpp"
#include "exchange.hpp"
#include "feedback.hpp"
#include "fender_ledger.hpp"
#include "responses.hpp"
#include "ship_names.hpp"
#include "solvers/energy_split.hpp"
#include "totals.hpp"

namespace shipcollision {

// Bodies and their hulls: what is read from files. It is kept while the parameters that it follows from are unchanged.
struct ShipCollision::World : OnHeap {
  explicit World(Memory& memory) : bodies(memory), detector(memory), ships(memory), feedbacks(memory) {}

  bool fill(const char* const* names, const CollisionParameters& p, const char* directory, Memory& memory, Text& why);
  bool follows_from(const CollisionParameters& p) const;

  Bodies bodies;
  Detector detector;
  Buffer<CollisionShipParameters> ships;
  Buffer<Feedback> feedbacks;
  CommonFeedback common = CommonFeedback::ledger;
  char obstacles[LONGEST_STRING] = "";
};

// What changes in time, and memory for a step.
struct ShipCollision::Run : OnHeap {
  static constexpr int ROOM_TO_SAVE = 4096;  // bytes; more than the mechanics of a pair in contact have

  Run(World& world, const CollisionParameters& p, const CollisionInputs& inputs, CollisionOutputs& outputs,
      Memory& memory)
      : world(world), exchange(world.bodies, inputs, outputs, memory),
        proximity(world.bodies, world.detector, p.clearance_range, p.substep, memory), collisions(memory), fenders(memory),
        caches(memory), diagnosis(world.bodies, exchange.ledgers(), inputs, outputs.diagnosis, memory),
        advancement(world.bodies, world.detector, memory), response(memory), passivity(memory), energy_split(memory),
        self_stress(memory), points(memory), solution(memory), states(memory), is_met(memory), is_colliding(memory),
        fender_pairs(memory), answered(memory), contacts(memory), booked(memory), losses(memory), numbers(memory),
        names(memory), saved(memory) {}

  // The part of the state that a step changes before it can fail, and all of it.
  void get_mechanics(ByteWriter& bytes) const;
  bool set_mechanics(ByteReader& bytes);
  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);
  bool save();
  void take_back();

  World& world;
  ShipExchange exchange;
  Proximity proximity;
  Collisions collisions;
  FenderLedger fenders;
  ContactCaches caches;
  Totals totals;
  Diagnosis diagnosis;
  ConservativeAdvancement advancement;
  PgsResponse response;
  Passivity passivity;
  EnergySplit energy_split;
  SelfStress self_stress;

  ContactPoints points;
  ContactSolution solution;
  Buffer<BodyState> states;
  Buffer<bool> is_met, is_colliding;
  Buffer<FenderPair> fender_pairs;
  Buffer<Pair> answered;
  Buffer<Contact> contacts;
  Buffer<Booked> booked;
  Buffer<Loss> losses;
  Buffer<Numbers> numbers;
  Buffer<const char*> names;  // of the bodies
  Buffer<unsigned char> saved;
  const Buffer<Pair>* candidates = nullptr;
  const Buffer<NearPair>* near = nullptr;
};

// -- set-up ------------------------------------------------------------------------------------------------------

ShipCollision::ShipCollision() = default;

ShipCollision::~ShipCollision() {
  delete run_;
  delete world_;
}

bool ShipCollision::name_ships(const char* const* names, int count, Text& why) {
  if (!check_ship_names(names, count, why)) return false;
  for (int i = 0; i < count; ++i) letters_.add(names[i], static_cast<int>(strlen(names[i])) + 1);
  int next = 0;
  for (int i = 0; i < count && !memory_.is_exhausted; ++i) {
    names_.add(letters_.data() + next);
    next += static_cast<int>(strlen(names[i])) + 1;
  }
  parameters.ships.fill(count, CollisionShipParameters());
  inputs.ships.fill(count, ShipState());
  outputs.ships.fill(count, ShipPost());
  outputs.contacts.fill(contact_point_count(count), ContactOutput());
  is_absent_.fill(count, false);
  return has_memory("the ships", why);
}

bool ShipCollision::has_memory(const char* what, Text& why) {
  if (!memory_.is_exhausted) return true;
  memory_.is_exhausted = false;
  why.clear();
  why << "there is no memory for " << what;
  return false;
}

bool ShipCollision::World::fill(const char* const* names, const CollisionParameters& p, const char* directory,
                                Memory& memory, Text& why) {
  Buffer<const HullMesh*> hulls(memory);
  ships.add(p.ships.data(), p.ships.size());
  common = p.feedback;
  memcpy(obstacles, p.obstacles, sizeof obstacles);
  for (int i = 0; i < p.ships.size(); ++i) {
    Feedback chosen;
    if (!choose_feedback(names[i], p.ships[i], p.feedback, chosen, why)) return false;
    feedbacks.add(chosen);
  }
  if (memory.is_exhausted) return true;  // whoever asked looks at it
  if (!bodies.prepare(names, p, feedbacks.data(), directory, why)) return false;
  for (int i = 0; i < bodies.size(); ++i) hulls.add(&bodies[i].hull);
  if (!memory.is_exhausted) detector.set_up(hulls.data(), hulls.size());
  return true;
}

bool ShipCollision::World::follows_from(const CollisionParameters& p) const {
  if (common != p.feedback || strcmp(obstacles, p.obstacles) != 0) return false;
  for (int i = 0; i < ships.size(); ++i) {
    const CollisionShipParameters &own = ships[i], &given = p.ships[i];
    const FenderParameters &fender = own.fender, &other = given.fender;
    if (strcmp(own.ship, given.ship) != 0 || strcmp(own.feedback_name, given.feedback_name) != 0 ||
        own.degrees_of_freedom != given.degrees_of_freedom || own.coasting != given.coasting ||
        own.feedback != given.feedback || fender.stiffness != other.stiffness || fender.damping != other.damping ||
        fender.thickness != other.thickness) {
      return false;
    }
  }
  return true;
}

bool ShipCollision::prepare(World*& prepared, Text& why) {
  if (world_ != nullptr && !has_old_files_ && world_->follows_from(parameters)) {
    prepared = world_;
    return true;
  }
  prepared = new World(memory_);
  if (prepared == nullptr) {
    why << "there is no memory for the bodies";
    return false;
  }
  if (prepared->fill(names_.data(), parameters, directory, memory_, why) && has_memory("the bodies", why)) return true;
  memory_.is_exhausted = false;
  delete prepared;
  return false;
}

ShipCollision::Run* ShipCollision::begin_run(World& world, Text& why) {
  Run* run = new Run(world, parameters, inputs, outputs, memory_);
  if (run == nullptr) {
    why << "there is no memory for the run";
    return nullptr;
  }
  const Bodies& bodies = world.bodies;
  Buffer<Answering> answering(memory_);
  bool has_prescribed = false;
  for (int i = 0; i < bodies.ships(); ++i) {
    has_prescribed = has_prescribed || bodies[i].feedback == Feedback::prescribed;
  }
  for (int i = 0; i < bodies.size(); ++i) {
    const Feedback feedback = bodies[i].feedback;
    answering.add({i < bodies.ships() && feedback == Feedback::none,
                   has_prescribed && feedback == Feedback::prescribed});
    run->names.add(bodies[i].name.get());
    run->states.add(bodies[i].is_wall ? bodies[i].wall : BodyState());
  }
  run->is_met.fill(bodies.size(), false);
  run->is_colliding.fill(bodies.size(), false);
  if (!memory_.is_exhausted) {
    run->collisions.set_up(parameters.minimum_separation_time, answering.data(), answering.size());
  }
  if (has_memory("the run", why)) return run;
  delete run;
  return nullptr;
}

void ShipCollision::keep(World* world, Run* run) {
  delete run_;
  if (world != world_) delete world_;
  world_ = world;
  run_ = run;
  has_old_files_ = false;
}

void ShipCollision::give_up(World* world, Run* run) {
  delete run;
  if (world != world_) delete world;
}

bool ShipCollision::initialise(Text& why) {
  why.clear();
  World* world;
  if (!check_parameters(parameters, why) || !prepare(world, why)) return false;
  Run* run = check_states(0.0, world->bodies, inputs, why) ? begin_run(*world, why) : nullptr;
  if (run == nullptr) {
    give_up(world, nullptr);
    return false;
  }
  run->is_met.fill(run->is_met.size(), true);
  BodyState* states = run->states.data();
  if (!run->exchange.receive_active(0.0, 0.0, states, why) ||
      !run->exchange.receive_others(0.0, 0.0, run->is_met.data(), states, why) ||
      !run->exchange.find_ends(0.0, states, why)) {
    give_up(world, run);
    return false;
  }
  run->candidates = &run->proximity.find_candidates(states, run->exchange.is_present(), inputs.ships.data(), 0.0,
                                                    is_absent_.data());
  if (!has_memory("the pairs", why)) {
    give_up(world, run);
    return false;
  }
  keep(world, run);
  warning.clear();
  outputs.diagnosis = DiagnosisOutput();
  publish(*run, 0.0, 0.0);
  return true;
}

// -- a step ------------------------------------------------------------------------------------------------------

bool ShipCollision::step(double t, double H, Text& why) {
  why.clear();
  if (run_ == nullptr) {
    why << "ShipCollision is not initialised: call initialise() before the first step";
    return false;
  }
  Run& run = *run_;
  if (!check_step(t, H, world_->bodies, inputs, why)) return false;
  warning.clear();
  run.collisions.opened().clear();
  run.points.clear();
  if (!receive(run, t, H, why)) return false;
  if (run.near->is_empty()) {
    run.is_met.fill(run.is_met.size(), false);
    advance_others(run, H);
    if (!finish(run, H, why)) return false;
    run.collisions.close_old(t);
    run.caches.forget_parted([](int, int) { return false; });
  } else {
    if (!run.save()) return has_memory("the state of the step", why);
    if (!take_substeps(run, t, H, why) || !finish(run, H, why)) {
      run.take_back();
      memory_.is_exhausted = false;
      warning.clear();
      return false;
    }
  }
  if (run.exchange.has_delayed_speeds()) warn_of_delay(run, t, H);
  publish(run, t, H);
  const bool has_touched = !run.points.is_empty();
  if (t >= run.diagnosis.due() || has_touched) {
    Text found;
    run.diagnosis.examine(t, H, is_absent_.data(), *run.near, has_touched, found);
    warn(found);
  }
  return true;
}

// States of all bodies, the pairs that may come near each other, and those that could touch.
bool ShipCollision::receive(Run& run, double t, double H, Text& why) {
  BodyState* states = run.states.data();
  if (!run.exchange.receive_active(t, H, states, why)) return false;
  run.candidates = &run.proximity.find_candidates(states, run.exchange.is_present(), inputs.ships.data(), H,
                                                  is_absent_.data());
  run.is_met.fill(run.is_met.size(), false);
  for (const Pair& pair : *run.candidates) run.is_met[pair.a] = run.is_met[pair.b] = true;
  if (!run.exchange.receive_others(t, H, run.is_met.data(), states, why)) return false;
  run.near = &run.proximity.find_near(*run.candidates, states, H);
  return has_memory("the pairs of the step", why);
}

bool ShipCollision::take_substeps(Run& run, double t, double H, Text& why) {
  BodyState* states = run.states.data();
  const Buffer<NearPair>& near = *run.near;
  run.collisions.close_old(t);
  run.caches.forget_parted([&](int a, int b) {
    for (const NearPair& each : near) {
      if (each.pair == Pair{a, b}) return true;
    }
    return false;
  });
  run.is_met.fill(run.is_met.size(), false);
  for (const NearPair& each : near) run.is_met[each.pair.a] = run.is_met[each.pair.b] = true;
  int moving = 0;
  for (int i = 0; i < run.states.size(); ++i) moving += run.is_met[i] && !states[i].fixed;
  run.caches.work.renew(moving, H);
  advance_others(run, H);
  select_fenders(world_->bodies, near, run.fender_pairs);
  ConservativeAdvancement& advancement = run.advancement;
  if (!advancement.begin(H, parameters.substep, states, run.caches.last_normals, near, why)) return false;
  for (int substep = 0; substep < advancement.count(); ++substep) {
    if (advancement.pairs_due(substep).is_empty()) continue;
    run.fenders.press(run.fender_pairs, world_->detector, run.caches.last_normals, states, parameters.friction,
                      advancement.h(), run.points);
    advancement.advance(substep);
    double moment;
    const Buffer<Pair>* examined;
    while (advancement.next(moment, examined)) {
      respond(run, t + moment, examined->data(), examined->size());
      if (run.solution.impulses.is_empty()) continue;
      book(run);
      advancement.touched = true;
    }
  }
  advancement.finish();
  if (advancement.is_limited()) {
    Text limited;
    advancement.describe_limited(t, limited);
    warn(limited);
  }
  if (advancement.touches_left <= 0) {
    Text exhausted;
    advancement.describe_exhausted(t, exhausted);
    warn(exhausted);
  }
  Text unconverged;
  run.totals.describe_unconverged(t, H, unconverged);
  warn(unconverged);
  return has_memory("the contacts of the step", why);
}

// What can still be refused.
bool ShipCollision::finish(Run& run, double H, Text& why) {
  run.points.fit(outputs.contacts.size());
  return run.exchange.find_ends(H, run.states.data(), why) && has_memory("the contact points of the step", why);
}

// Says where a ship may have passed what it hit, since its master applied the impulse one step late.
void ShipCollision::warn_of_delay(const Run& run, double t, double H) {
  Text said;
  run.collisions.find_open_pair([&](const Pair& pair) {
    const double speed = max(run.exchange.delayed_speed(pair.a), run.exchange.delayed_speed(pair.b));
    return describe_delayed_impulse(t, H, speed, run.names[pair.a], run.names[pair.b], world_->detector.thickness(pair),
                                    said);
  });
  warn(said);
}

void ShipCollision::warn(const Text& said) {
  if (said.is_empty()) return;
  if (!warning.is_empty()) warning << "; ";
  warning << said;
}

// Impulses at the contacts of the predicted poses, and the numbers of the collisions that they belong to.
void ShipCollision::respond(Run& run, double t, const Pair* pairs, int count) {
  BodyState* states = run.states.data();
  run.answered.clear();
  run.contacts.clear();
  for (int i = 0; i < count; ++i) {
    if (run.collisions.is_recorded(pairs[i])) {
      world_->detector.contacts(pairs[i], states, run.caches.last_normals, run.contacts);
    } else {
      run.answered.add(pairs[i]);
    }
  }
  const ContactProblem problem{run.answered.data(), run.answered.size(), states, world_->detector, parameters.friction,
                               parameters.restitution};
  run.response.respond(problem, run.caches, run.solution);
  for (const Impulse& impulse : run.solution.impulses) run.contacts.add(impulse.contact);
  run.collisions.register_contacts(t, run.contacts.data(), run.contacts.size(), states, run.numbers);
}

// Books the impulses, scaled to passivity, and the energy that they cost, into the contact points.
void ShipCollision::book(Run& run) {
  BodyState* states = run.states.data();
  Buffer<Impulse>& impulses = run.solution.impulses;
  const int count = impulses.size();
  if (!run.losses.fill(count, Loss{0.0, 0.0})) return;
  if (!run.solution.moves_nothing()) {
    const double taken_off = run.passivity.enforce(impulses, states);
    if (!run.booked.resize(count)) return;
    book_impulses(impulses.data(), count, states, run.booked.data());
    run.energy_split.split_losses(run.booked.data(), count, states, parameters.friction, parameters.restitution,
                                  run.losses.data());
    run.totals.add(run.solution.residual, run.solution.sweeps, taken_off);
    for (const Loss& loss : run.losses) run.totals.add_energy(loss.normal, loss.tangential);
    run.self_stress.remove(impulses.data(), count, states, parameters.friction);
  }
  run.points.merge_impulses(impulses.data(), run.losses.data(), count, run.numbers);
}

// Moves the ships that are not near another on by H [s].
void ShipCollision::advance_others(Run& run, double H) {
  const bool* is_present = run.exchange.is_present();
  for (int i = 0; i < ship_count(); ++i) {
    if (is_present[i] && !run.is_met[i]) run.states[i].advance(H);
  }
}

// -- outputs and state -------------------------------------------------------------------------------------------

void ShipCollision::publish(Run& run, double t, double H) {
  run.is_colliding.fill(run.is_colliding.size(), false);
  run.collisions.mark_bodies_in_collision(run.is_colliding.data());
  run.exchange.publish(t, H, run.states.data(), run.is_colliding.data());
  if (!run.points.is_empty() || outputs.contact_count != 0 || outputs.collision_count != run.collisions.count()) {
    publish_contacts(run);
  }
  run.totals.fill(outputs);
  outputs.fender = run.fenders.energy();
  const Clearance clearance = run.proximity.measure_clearance(*run.candidates, run.states.data());
  outputs.clearance = clearance.least;
  outputs.nearest_ship_a = clearance.nearest.a;
  outputs.nearest_ship_b = clearance.nearest.b;
}

void ShipCollision::publish_contacts(Run& run) {
  run.points.fill(outputs.contacts);
  outputs.contact_active = run.points.are_active();
  outputs.contact_count = run.points.count();
  outputs.scratch_id = run.points.latest_scratch();
  outputs.collision_count = run.collisions.count();
  outputs.impact = run.collisions.latest();
}

uint32_t ShipCollision::file_checksum(int file) const { return world_->bodies.checksums()[file]; }

int ShipCollision::event_count() const { return run_ == nullptr ? 0 : run_->collisions.opened_count(); }

const char* ShipCollision::event(int i) const {
  event_.clear();
  run_->collisions.describe_opened(i, run_->names.data(), event_);
  return event_.get();
}

void ShipCollision::Run::get_mechanics(ByteWriter& bytes) const {
  fenders.get_state(bytes);
  caches.get_state(bytes);
  collisions.get_state(bytes);
  totals.get_state(bytes);
}

bool ShipCollision::Run::set_mechanics(ByteReader& bytes) {
  return fenders.set_state(bytes) && caches.set_state(bytes) && collisions.set_state(bytes) && totals.set_state(bytes);
}

void ShipCollision::Run::get_state(ByteWriter& bytes) const {
  exchange.get_state(bytes);
  get_mechanics(bytes);
  diagnosis.get_state(bytes);
}

bool ShipCollision::Run::set_state(ByteReader& bytes) {
  return exchange.set_state(bytes) && set_mechanics(bytes) && diagnosis.set_state(bytes);
}

// Keeps the part of the state that a step changes before it can fail: ledgers change when nothing can be refused.
bool ShipCollision::Run::save() {
  ByteWriter counted;
  get_mechanics(counted);
  if (!saved.reserve(ROOM_TO_SAVE) || !saved.resize(static_cast<int>(counted.size()))) return false;
  ByteWriter bytes(saved.data(), counted.size());
  get_mechanics(bytes);
  return true;
}

void ShipCollision::Run::take_back() {
  ByteReader bytes(saved.data(), static_cast<size_t>(saved.size()));
  set_mechanics(bytes);
}

size_t ShipCollision::state_size() const {
  if (run_ == nullptr) return 0;
  ByteWriter counted;
  run_->get_state(counted);
  return counted.size();
}

void ShipCollision::get_state(void* bytes, size_t size) const {
  if (run_ == nullptr) return;
  ByteWriter writer(bytes, size);
  run_->get_state(writer);
}

bool ShipCollision::set_state(const void* bytes, size_t size, Text& why) {
  why.clear();
  if (size == 0) {
    delete run_;
    run_ = nullptr;
    return true;
  }
  World* world;
  if (!prepare(world, why)) return false;
  Run* run = begin_run(*world, why);
  ByteReader reader(bytes, size);
  if (run != nullptr && run->set_state(reader) && reader.left() == 0) {
    keep(world, run);
    return true;
  }
  if (run != nullptr && has_memory("the state", why)) {
    why << "the state is not of ShipCollision: give what get_state() returned";
  }
  give_up(world, run);
  return false;
}

bool ShipCollision::rewind(const void* bytes, size_t size) {
  ByteReader reader(bytes, size);
  return run_ != nullptr && run_->set_state(reader) && reader.left() == 0;
}

}  // namespace shipcollision
