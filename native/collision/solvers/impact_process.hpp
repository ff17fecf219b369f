// The impact process of one contact: the twin of shipcollision_fmu/collision/solvers/impact_process.py.
//
// Only what the split of the energy needs; the response closed_form, which follows the path itself, stays with Python.
#pragma once

#include "../../ship/frames.hpp"

namespace shipcollision {

// Energy lost along the normal and by friction [J].
struct Loss {
  double normal, tangential;
};

// Of an impact of one contact with v [m/s] before. W, in contact axes; H: what held motions add to the slip, or null.
Loss estimate_losses(const Rows& W, const Three& v, double mu, double e, const Rows* H);

}  // namespace shipcollision
