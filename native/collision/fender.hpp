// The law of a fender: the twin of shipcollision_fmu/collision/fender.py.
#pragma once

#include "../numbers/text.hpp"
#include "../ship/frames.hpp"

namespace shipcollision {

struct Fender {
  double stiffness, damping, thickness;  // [N/m], [N s/m], [m]
};

// A fender over one substep: normal impulse P [N s], energy stored after it [J], energy dissipated in it [J].
struct Compression {
  double P, stored, dissipated;
};

// The fender of three values, `has_fender` false for all zero. False for values of no fender.
bool build_fender(const char* name, const Fender& values, bool& has_fender, Text& why);

// The fender of two that face each other.
Fender combine_in_series(const Fender& one, const Fender& other);

// One substep of h [s] of a fender compressed by `compression` [m] at `rate` [m/s]. W_nn [1/kg]: what a unit of impulse
// does to the rate; stored [J]: what the ships have put into the spring so far.
Compression compress_fender(const Fender& fender, double compression, double rate, double W_nn, double stored,
                            double h);

// Tangential impulse [N s] that takes the slip [m/s], or as much of it as mu P_n allows; both in the axes of the
// tangents, the last two of a contact. W: of all three axes [1/kg].
void solve_friction(const Rows& W, const double (&slip)[2], double mu, double P_n, double (&P_t)[2]);

}  // namespace shipcollision
