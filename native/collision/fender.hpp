// The law of a fender: the twin of shipcollision_fmu/collision/fender.py.
#pragma once

#include "../numbers/text.hpp"

namespace shipcollision {

struct Fender {
  double stiffness, damping, thickness;  // [N/m], [N s/m], [m]
};

// The fender of three values, `has_fender` false for all zero. False for values of no fender.
bool build_fender(const char* name, const Fender& values, bool& has_fender, Text& why);

}  // namespace shipcollision
