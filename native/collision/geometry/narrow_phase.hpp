// What the narrow phase answers: the twin of shipcollision_fmu/collision/geometry/narrow_phase.py.
#pragma once

#include "../../ship/frames.hpp"

namespace shipcollision {

// Bullet's collision margin [m], as in the Python twin; it is taken off again. Without it Bullet returns wrong normals
// for faces that lie flat on each other.
constexpr double MARGIN = 0.001;

// Added and taken off again, they round places [m] to 2^-33 and quaternions to 2^-40, as Bullet is shown them.
constexpr double SNAP_PLACE = 786432.0;
constexpr double SNAP_QUATERNION = 6144.0;

// Closest points of two convex parts: on_a, on_b in n [m], normal from a to b, gap [m] (< 0: overlap).
struct Closest {
  Three on_a, on_b, normal;
  double gap;
  int part_a;
  int part_b;
};

}  // namespace shipcollision
