// The motion of a ship on which nothing acts: the twin of shipcollision_fmu/ship/coasting.py.
#pragma once

#include "frames.hpp"

namespace shipcollision {

// Position of CO [m] and attitude [rad] in n, velocity [m/s] and rate [rad/s] in b.
struct Motion {
  Three position, attitude, velocity, rate;
};

Motion coast(const Motion& before, const Three& r_bg, double h);

}  // namespace shipcollision
