// The law of contact: the twin of shipcollision_fmu/collision/solvers/contact_law.py.
//
// W (3k, 3k), v (3k) and P (3k) hold three rows or numbers for each contact: normal and two tangents.
#pragma once

#include "../../numbers/dense.hpp"

namespace shipcollision {

constexpr int MANY_CONTACTS = 7;

// W of one contact in its principal tangents [1/kg]; h_i = 1 / a_i, zero along a tangent in which no ship moves.
struct ContactBlock {
  double W_nn, w_1, w_2, a_1, a_2, h_1, h_2;
};

// The block of a contact on the diagonal of W, in principal tangents.
ContactBlock make_block(const Dense& W, int contact);

struct Friction {
  double P_1, P_2;
};

// Friction [N s] of maximum dissipation in a disc of that radius [N s].
Friction solve_friction_in_disc(const ContactBlock& W, double v_1, double v_2, double radius);

// The largest approach speed [m/s] among velocities v, `size` numbers; negative where all part, 0 without a contact.
double find_approach(const double* v, int size);

// Velocity [m/s] by which impulses P miss the law of contact; v before, any tangents.
double law_residual(const Dense& W, const double* v, double mu, const double* P);

}  // namespace shipcollision
