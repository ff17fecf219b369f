#include "fender.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {

bool build_fender(const char* name, const Fender& values, bool& has_fender, Text& why) {
  const auto& [stiffness, damping, thickness] = values;
  has_fender = stiffness != 0.0 || damping != 0.0 || thickness != 0.0;
  const bool are_finite = isfinite(stiffness) && isfinite(damping) && isfinite(thickness);
  if (!has_fender || (are_finite && stiffness > 0.0 && damping >= 0.0 && thickness > 0.0)) return true;
  why << name << ": stiffness = " << stiffness << " N/m, damping = " << damping << " N s/m, thickness = " << thickness
      << " m is no fender: stiffness and thickness must be positive, damping not negative; all 0 for none";
  return false;
}

}  // namespace shipcollision
