// Random bodies that touch, and all that a substep does with their contacts.
#include <stdint.h>

#include "../../../../native/collision/dynamics/contact_frame.hpp"
#include "../../../../native/collision/dynamics/self_stress.hpp"
#include "../../../../native/collision/responses.hpp"
#include "../../../../native/collision/solvers/energy_split.hpp"

namespace shipcollision {

struct Random {
  uint64_t seed;

  // From -1 to 1.
  double draw() {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(seed >> 12) / 2251799813685248.0 - 1.0;
  }
  Three draw(double x, double y, double z) { return {{x * draw(), y * draw(), z * draw()}}; }
};

// What one substep is solved and booked with.
struct Substep {
  static constexpr int MOST_BODIES = 5;

  explicit Substep(Memory& memory)
      : contacts(memory), booked(memory), losses(memory), detector(memory), caches(memory),
        solution(memory), pgs(memory), passivity(memory), split(memory), self_stress(memory) {}

  // A row of bodies, of which the last may be an obstacle. False without memory.
  bool draw(Random& random, int bodies, int contacts_of_pair) {
    for (int i = 0; i < bodies; ++i) draw_body(random, states[i], i > 0 && random.draw() > 0.5 && i + 1 == bodies);
    contacts.clear();
    for (int a = 0; a + 1 < bodies; ++a) {
      const Three across = random.draw(1.0, 1.0, 0.1), middle = random.draw(100.0, 15.0, 5.0);
      const Rows axes = contact_axes((1.0 / norm(across)) * across);
      for (int i = 0; i < contacts_of_pair; ++i) {
        const Three point = middle + random.draw(3.0, 3.0, 6.0);
        if (!contacts.add(make_contact(a, a + 1, states, point, -0.01, axes))) return false;
      }
    }
    friction = 0.5 + 0.5 * random.draw();
    restitution = random.draw() > 0.0 ? 0.3 : 0.0;
    caches.work.renew(bodies, 0.1);
    return true;
  }

  // False without memory.
  bool answer(Memory& memory) {
    const ContactProblem problem{nullptr, 0, states, detector, friction, restitution};
    const int count = contacts.size();
    pgs.solve(contacts.data(), count, problem, caches, solution);
    passivity.enforce(solution.impulses, states);
    if (memory.is_exhausted || !booked.resize(count) || !losses.resize(count)) return false;
    book_impulses(solution.impulses.data(), count, states, booked.data());
    split.split_losses(booked.data(), count, states, friction, restitution, losses.data());
    self_stress.remove(solution.impulses.data(), count, states, friction);
    return !memory.is_exhausted;
  }

  static void draw_body(Random& random, BodyState& state, bool is_fixed) {
    Matrix inverse{};
    const double mass = 1e7 * exp(2.0 * random.draw());
    for (int factor = 0; factor < 8 && !is_fixed; ++factor) {
      double row[6];
      for (int i = 0; i < 6; ++i) row[i] = (i < 3 ? 1.0 : 0.02) * random.draw();
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) inverse[i][j] += row[i] * row[j] / mass;
      }
    }
    Rows held{};
    for (int i = 0; i < 3; ++i) held.at[i][i] = (i == 0 ? 1.0 : 1e-3) / mass;
    // One after the other: compilers differ in the order of arguments.
    const Three velocity = random.draw(4.0, 1.0, 0.0), rate = random.draw(0.01, 0.0, 0.02);
    const Three position = random.draw(5.0, 5.0, 1.0), attitude = random.draw(0.1, 0.02, 3.0);
    const bool holds = !is_fixed && random.draw() > 0.0;
    state.start_at(position, attitude, is_fixed ? Six{} : join(velocity, rate), inverse, {}, holds ? &held : nullptr);
    state.fixed = is_fixed;
  }

  BodyState states[MOST_BODIES];
  double friction, restitution;
  Buffer<Contact> contacts;
  Buffer<Booked> booked;
  Buffer<Loss> losses;
  Detector detector;
  ContactCaches caches;
  ContactSolution solution;
  PgsResponse pgs;
  Passivity passivity;
  EnergySplit split;
  SelfStress self_stress;
};

}  // namespace shipcollision
