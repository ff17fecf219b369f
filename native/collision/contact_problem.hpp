// What a response is given, and what it gives: the twin of shipcollision_fmu/collision/contact_problem.py.
#pragma once

#include "../numbers/bytes.hpp"
#include "geometry/detection.hpp"
#include "solvers/warm_start.hpp"
#include "solvers/work_limit.hpp"

namespace shipcollision {

// Bodies within reach of each other, at one substep. friction, restitution: of every pair.
struct ContactProblem {
  const Pair* pairs;
  int count;
  const BodyState* states;
  Detector& detector;
  double friction, restitution;
};

// residual: by how much the law of contact is missed, as a share of the approach.
struct ContactSolution {
  explicit ContactSolution(Memory& memory) : impulses(memory) {}

  Buffer<Impulse> impulses;
  double residual = 0.0;
  int sweeps = 0;

  // Whether the contacts part, or rest since an earlier substep: nothing was solved.
  bool moves_nothing() const {
    bool is_nothing = sweeps == 0 && residual == 0.0;
    for (const Impulse& impulse : impulses) is_nothing = is_nothing && is_same(impulse.P, Three{});
    return is_nothing;
  }
};

// What is carried from substep to substep. work is no part of the state.
struct ContactCaches {
  explicit ContactCaches(Memory& memory) : last_normals(memory), warm_starts(memory) {}

  // Drops the impulses of the pairs that are not near each other in this communication step. is_near(a, b).
  template <typename IsNear>
  void forget_parted(IsNear is_near) {
    warm_starts.forget_parted(is_near);
  }

  void get_state(ByteWriter& bytes) const;
  // False, with caches of any content, where the bytes are no state.
  bool set_state(ByteReader& bytes);

  LastNormals last_normals;
  WarmStarts warm_starts;
  StepWork work;
};

}  // namespace shipcollision
