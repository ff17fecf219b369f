// One contact, exactly: the twin of shipcollision_fmu/collision/solvers/one_contact.py.
#pragma once

#include "../../ship/frames.hpp"
#include "contact_law.hpp"

namespace shipcollision {

// The angle of friction [rad] of a contact that slides.
struct Angle {
  bool is_known = false;
  double value = 0.0;
};

// Impulse (P_n, P_1, P_2) [N s] of one contact with the velocity v [m/s] before. angle: from which the search starts,
// unknown for against the slip before; then the angle of friction, unknown unless the contact slides.
Three solve_one_contact(const ContactBlock& W, const Three& v, double mu, Angle& angle);

}  // namespace shipcollision
