// Velocity that other forces add to a ship within a step: the twin of
// shipcollision_fmu/collision/dynamics/other_forces.py.
#pragma once

#include "../../ship/coasting_law.hpp"

namespace shipcollision {

constexpr double MAX_ACCELERATION = 2.0;
constexpr double EXACT = 0.005;

// A ship as received at the start t [s] of a step of H [s].
struct ReceivedState {
  double t, H;
  Three position, attitude;
  Six nu, applied;
};

// What other forces did to a ship in a step, in b at its start. has_scheme_error: false for a ship model that
// integrates exactly.
struct OtherForces {
  Six velocity_bias, velocity_gain, scheme_error;
  bool has_scheme_error;
};

// Other forces in the step that `before` began and `now` ended; found: whether there are any to be measured. M_inverse:
// at the attitude before; r_bg: CG in b [m]; reach: of the hull from CO [m]; coasting: null for the straight law. False
// where the law refuses the motion.
bool estimate_other_forces(const ReceivedState& before, const ReceivedState& now, const Matrix& M_inverse,
                           const Three& r_bg, double reach, const CoastingLaw* coasting, OtherForces& forces,
                           bool& found, Text& why);

}  // namespace shipcollision
