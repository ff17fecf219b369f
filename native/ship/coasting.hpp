// The motion of a ship on which nothing acts: the twin of shipcollision_fmu/ship/coasting.py.
#pragma once

#include "frames.hpp"

namespace shipcollision {

// Position of CO [m] and attitude [rad] in n, velocity [m/s] and rate [rad/s] in b.
struct Motion {
  Three position, attitude, velocity, rate;
};

Motion coast(const Motion& before, const Three& r_bg, double h);

// Velocity of CG [m/s] and angular velocity [rad/s], both in n; turns: whether the latter is not zero.
struct BodyMotion {
  Three velocity, omega;
  bool turns;
};

// The pose after h [s].
Pose coast_pose(const Pose& pose, const BodyMotion& motion, const Three& r_bg, double h);

}  // namespace shipcollision
