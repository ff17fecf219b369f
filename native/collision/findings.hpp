// What can be found wrong with the wiring of a ship: the twin of shipcollision_fmu/collision/findings.py.
#pragma once

#include "../numbers/text.hpp"

namespace shipcollision {

// Codes of the findings, in the order of the table; none: nothing was found.
enum class Finding {
  none,
  not_connected,
  no_velocity,
  unit_of_the_velocity,
  frame_of_the_velocity,
  other_velocity,
  attitude_in_degrees,
  no_rate,
  rate_in_degrees,
  other_rate,
  overlap_at_the_start,
  impulse_not_applied,
  impulse_applied_not_returned,
  force_without_effect,
  other_mass,
  no_motion
};

// What was measured, for the message.
struct Measured {
  double moved = 0.0, given = 0.0, off = 0.0, yaw = 0.0, overlap = 0.0, duration = 0.0, share = 0.0, mass = 0.0;
  const char* unit = "";
  const char* other = "";
};

// A finding about a ship.
struct Found {
  Finding finding = Finding::none;
  Measured measured;
};

// The warning in one line.
void describe_finding(const Found& found, const char* ship, Text& said);

}  // namespace shipcollision
