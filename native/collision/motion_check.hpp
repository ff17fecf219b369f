// Whether the state of a ship agrees with itself: the twin of shipcollision_fmu/collision/motion_check.py.
#pragma once

#include "../ship/coasting.hpp"
#include "findings.hpp"

namespace shipcollision {

constexpr double SLOW = 0.5;
constexpr double SLOW_TURN = 0.005;
constexpr double SPEED_ERROR = 0.3;
constexpr double RATE_ERROR = 0.003;
constexpr double SHARE = 0.25;

// A ship as received at t [s]: `Motion` of the twin.
struct TimedMotion {
  double t;
  Motion motion;
};

// What a window shows. speed, rate: whether they were found to be right.
struct Verdict {
  Found found;
  bool speed = false, rate = false;
};

// What the window from start to end shows of the velocity, and if that is right, of the rate.
Verdict judge_motion(const TimedMotion& start, const TimedMotion& end);

}  // namespace shipcollision
