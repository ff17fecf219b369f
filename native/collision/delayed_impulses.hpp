// Impulses that come too late: the twin of shipcollision_fmu/collision/delayed_impulses.py.
#pragma once

#include "../numbers/text.hpp"

namespace shipcollision {

// The warning of the step from t by H [s] of two bodies in an open collision, of which a pending impulse takes `speed`
// [m/s] at most, and the thinner is `thin` [m] thick. Nothing, and false, where that is not too late.
bool describe_delayed_impulse(double t, double H, double speed, const char* a, const char* b, double thin, Text& said);

}  // namespace shipcollision
