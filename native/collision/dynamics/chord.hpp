// The chord of a motion: the twin of shipcollision_fmu/collision/dynamics/chord.py.
#pragma once

#include "../../ship/degrees_of_freedom.hpp"

namespace shipcollision {

struct Chord {
  Six twist;    // about CO in b at the start
  Six carried;  // the twist at the start, in b at the end
};

// From `pose` to a position [m] and an attitude [rad] in H [s]; r_bg: CG in b [m]; nu: the twist at the start.
Chord find_chord(const Pose& pose, const Three& position, const Three& attitude, const Three& r_bg, const Six& nu,
                 double H);

// Rotation vector [rad] of a rotation by less than half a turn.
Three rotation_vector_of(const Rows& R);

// R' Q.
Rows turn_back(const Rows& R, const Rows& Q);

}  // namespace shipcollision
