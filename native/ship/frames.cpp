#include "frames.hpp"

namespace shipcollision {

Rows rotation_rows(double phi, double theta, double psi) {
  const double cphi = cos(phi), sphi = sin(phi), cth = cos(theta), sth = sin(theta), cpsi = cos(psi), spsi = sin(psi);
  return {{{{cpsi * cth, cpsi * sth * sphi - spsi * cphi, spsi * sphi + cpsi * cphi * sth}},
           {{spsi * cth, cpsi * cphi + sphi * sth * spsi, sth * spsi * cphi - cpsi * sphi}},
           {{-sth, cth * sphi, cth * cphi}}}};
}

Three attitude_from_rotation(const Rows& R_nb) {
  const double pitch = asin(min(1.0, max(-1.0, -R_nb[2][0])));
  if (hypot(R_nb[2][1], R_nb[2][2]) < 1e-12) return {{0.0, pitch, atan2(-R_nb[0][1], R_nb[1][1])}};
  return {{atan2(R_nb[2][1], R_nb[2][2]), pitch, atan2(R_nb[1][0], R_nb[0][0])}};
}

Three find_attitude(const Three& low, double forward_north, double forward_east, double starboard_north,
                    double starboard_east, double expected) {
  const double pitch = asin(min(1.0, max(-1.0, -low[0])));
  const bool is_on_end = hypot(low[1], low[2]) < 1e-12;  // roll and yaw are one angle; call it yaw
  const double roll = is_on_end ? 0.0 : atan2(low[1], low[2]);
  const double yaw = is_on_end ? atan2(-starboard_north, starboard_east) : atan2(forward_east, forward_north);
  return {{roll, pitch, yaw + 2 * PI * round((expected - yaw) / (2 * PI))}};
}

}  // namespace shipcollision
