// Overlap of two convex solids in plan: the twin of shipcollision_fmu/collision/geometry/plan_overlap.py.
#pragma once

#include "../../ship/frames.hpp"
#include "clipping.hpp"

namespace shipcollision {

struct PlanOverlap {
  double least;   // [m]
  Three normal;   // horizontal, from a to b
  int carrier;    // whose side it is: 0: a, 1: b
};

class PlanOverlaps {
 public:
  explicit PlanOverlaps(Memory& memory) : points_(memory), plans_{Buffer<Point>(memory), Buffer<Point>(memory)} {}

  // Of the corners of either solid in n; some of each.
  PlanOverlap least_overlap(const Buffer<Three>& points_a, const Buffer<Three>& points_b);

 private:
  Buffer<Point> points_, plans_[2];
};

}  // namespace shipcollision
