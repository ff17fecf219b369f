// Bodies, their distances and the schedule of a step.
#include "../../../native/collision/bodies.hpp"
#include "../../../native/collision/conservative_advancement.hpp"
#include "kernels.hpp"

using namespace shipcollision;

namespace {

Memory memory;

struct World {
  Bodies bodies{memory};
  Detector detector{memory};
};

World* world = nullptr;

}  // namespace

const Bodies& shipcollision::get_kernel_bodies() { return world->bodies; }

namespace {

// in: number of a body, an attitude, a velocity and rate
void body(const double* in, double* out) {
  Take take{in};
  Put put{out};
  const Body& body = world->bodies[take.whole()];
  const Motion before{{}, take.all<Three>(), take.all<Three>(), take.all<Three>()};
  Matrix inverse;
  body.inverse_at(before.attitude, inverse);
  BodyState state;
  state.start_at({}, before.attitude, join(before.velocity, before.rate), inverse);
  put.all(inverse);
  put.all(body.held);
  put.all(body.r_bg);
  put.real(body.hull.reach);
  put.real(body.degrees_of_freedom);
  put.real(body.fender_thickness);
  put.real(body.has_fender ? body.fender.stiffness : 0.0);
  put.real(body.largest_speed(state));
  put.all(body.rectangle);
  put.all(body.is_wall ? body.wall.predicted : Pose{});
  Motion after{};
  Text why;
  put.real(body.has_coasting && body.coasting.coast(before, 0.1, after, why));
  put.all(after);
}

// in: H, substep, whether each of the ships has a state and is absent, their received states
void schedule(const double* in, double* out) {
  Take take{in};
  Put put{out};
  const Bodies& bodies = world->bodies;
  const double H = take.real(), substep = take.real();
  bool has_state[16], is_absent[16];
  for (int i = 0; i < bodies.ships(); ++i) has_state[i] = take.real() != 0.0;
  for (int i = 0; i < bodies.ships(); ++i) is_absent[i] = take.real() != 0.0;
  Buffer<ShipState> received(memory);
  Buffer<BodyState> states(memory);
  for (int i = 0; i < bodies.ships(); ++i) {
    const Motion motion = take.all<Motion>();
    received.add({motion.position, motion.attitude, motion.velocity, motion.rate, {}});
    BodyState state;
    Matrix inverse;
    bodies[i].inverse_at(motion.attitude, inverse);
    state.start_at(motion.position, motion.attitude, received[i].nu(), inverse, bodies[i].r_bg);
    states.add(state);
  }
  for (int i = bodies.ships(); i < bodies.size(); ++i) states.add(bodies[i].wall);
  Proximity proximity(bodies, world->detector, 150.0, 0.0, memory);  // without a substep all are measured
  const Buffer<Pair>& candidates =
      proximity.find_candidates(states.data(), has_state, received.data(), H, is_absent);
  put.real(candidates.size());
  for (const Pair& pair : candidates) put.real(100 * pair.a + pair.b);
  const Buffer<NearPair>& near = proximity.find_near(candidates, states.data(), H);
  put.real(near.size());
  for (const auto& [pair, gap, approach] : near) {
    put.real(100 * pair.a + pair.b);
    put.real(gap);
    put.real(approach);
  }
  const Clearance before = proximity.measure_clearance(candidates, states.data());
  put.real(before.least);
  put.real(100 * before.nearest.a + before.nearest.b);
  if (near.is_empty()) return;
  LastNormals last_normals(memory);
  ConservativeAdvancement advancement(bodies, world->detector, memory);
  Buffer<Contact> contacts(memory);
  Text why;
  if (!advancement.begin(H, substep, states.data(), last_normals, near, why)) return;
  put.real(advancement.count());
  put.real(advancement.h());
  for (int i = 0; i < advancement.count(); ++i) {
    if (advancement.pairs_due(i).is_empty()) continue;
    advancement.advance(i);
    double moment;
    const Buffer<Pair>* pairs;
    while (advancement.next(moment, pairs)) {
      double examined = 0.0;
      for (const Pair& pair : *pairs) {
        examined = 3.0 * examined + 10 * pair.a + pair.b;
        contacts.clear();
        world->detector.contacts(pair, states.data(), last_normals, contacts);
        if (contacts.is_empty()) continue;
        examined += 1e4;
        if (i % 3 != 0) continue;
        for (int each = 0; each < 2; ++each) {  // what stands for a response
          BodyState& state = states[each == 0 ? pair.a : pair.b];
          if (!state.fixed) state.set_twist(Six{} - state.nu);
        }
        advancement.touched = true;
      }
      put.real(moment);
      put.real(examined);
    }
  }
  advancement.finish();
  put.real(advancement.touches_left);
  for (const BodyState& state : states) put.all(state.predicted);
  put.real(last_normals.rows().size());
}

constexpr Named KERNELS[] = {{"body", body}, {"schedule", schedule}};

}  // namespace

SHIPCOLLISION_EXPORT bool shipcollision_evaluate_bodies(const char* name, const double* in, size_t ins, double* out,
                                                        size_t outs, size_t count) {
  return evaluate(KERNELS, name, in, ins, out, outs, count) && !memory.is_exhausted;
}

// The bodies of the kernels. ships: the path of the prepared file of each; numbers: of each its degrees of freedom, law,
// feedback, and its fender. Writes why they are refused, or nothing.
SHIPCOLLISION_EXPORT void shipcollision_open_bodies(const char* const* names, const char* const* ships, int count,
                                                    const double* numbers, const char* obstacles, char* message) {
  CollisionParameters* parameters = new CollisionParameters(memory);
  Buffer<Feedback> feedbacks(memory);
  for (int i = 0; i < count; ++i, numbers += 6) {
    CollisionShipParameters ship;
    strcpy(ship.ship, ships[i]);
    ship.degrees_of_freedom = static_cast<int>(numbers[0]);
    ship.coasting = static_cast<Coasting>(static_cast<int>(numbers[1]));
    feedbacks.add(static_cast<Feedback>(static_cast<int>(numbers[2])));
    ship.fender = {numbers[3], numbers[4], numbers[5]};
    parameters->ships.add(ship);
  }
  strcpy(parameters->obstacles, obstacles);
  delete world;
  world = new World;
  Text why;
  Buffer<const HullMesh*> hulls(memory);
  if (world->bodies.prepare(names, *parameters, feedbacks.data(), "", why)) {
    for (int i = 0; i < world->bodies.size(); ++i) hulls.add(&world->bodies[i].hull);
    world->detector.set_up(hulls.data(), hulls.size());
  }
  delete parameters;
  strcpy(message, why.get());
}
