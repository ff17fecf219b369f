// Axes of a contact: the twin of shipcollision_fmu/collision/dynamics/contact_frame.py.
#pragma once

#include "../../ship/frames.hpp"

namespace shipcollision {

// Rows (normal, t1, t2): from n to contact axes.
inline Rows contact_axes(const Three& normal) {
  const auto& [x, y, z] = normal.at;
  Three t1;
  if (abs(z) < 0.9) {
    const double size = hypot(x, y);
    t1 = {{y / size, -x / size, 0.0}};
  } else {
    const double size = hypot(y, z);
    t1 = {{0.0, z / size, -y / size}};
  }
  return {{normal, t1, cross(normal, t1)}};
}

}  // namespace shipcollision
