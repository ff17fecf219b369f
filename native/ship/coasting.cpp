#include "coasting.hpp"

namespace shipcollision {
namespace {

struct Displacement {
  Three shift, forward, starboard, down;
};

Displacement displace(const Three& v_g, const Three& omega, const Three& r_bg, double h) {
  const double a = h * omega[0], b = h * omega[1], c = h * omega[2];
  const double angle = sqrt(a * a + b * b + c * c);
  const bool is_small = angle < 1e-8;
  const double f = is_small ? 1.0 : sin(angle) / angle;
  const double half = is_small ? 0.5 : sin(0.5 * angle) / angle;
  const double g = is_small ? 0.5 : 2.0 * (half * half);
  const Three forward{{1.0 - g * (b * b + c * c), g * a * b + f * c, g * a * c - f * b}};
  const Three starboard{{g * a * b - f * c, 1.0 - g * (a * a + c * c), g * b * c + f * a}};
  const Three down{{g * a * c + f * b, g * b * c - f * a, 1.0 - g * (a * a + b * b)}};
  const auto& [x, y, z] = r_bg.at;
  const Three shift{{h * v_g[0] + x - (forward[0] * x + starboard[0] * y + down[0] * z),
                     h * v_g[1] + y - (forward[1] * x + starboard[1] * y + down[1] * z),
                     h * v_g[2] + z - (forward[2] * x + starboard[2] * y + down[2] * z)}};
  return {shift, forward, starboard, down};
}

}  // namespace

Motion coast(const Motion& before, const Three& r_bg, double h) {
  const auto& [position, attitude, velocity, rate] = before;
  const auto& [x, y, z] = position.at;
  const auto& [phi, theta, psi] = attitude.at;
  const auto& [u, v, w] = velocity.at;
  const auto& [p, q, r] = rate.at;
  const bool is_straight = p == 0.0 && q == 0.0 && r == 0.0;
  if (is_straight && phi == 0.0 && theta == 0.0) {  // most ships in most steps
    const double c = cos(psi), s = sin(psi);
    return {{{x + (c * (h * u) - s * (h * v)), y + (s * (h * u) + c * (h * v)), z + h * w}}, attitude, velocity, rate};
  }
  const Rows rows = rotation_rows(phi, theta, psi);
  const auto& [row_n, row_e, row_d] = rows.at;
  if (is_straight) {
    const Three shift{{h * u, h * v, h * w}};
    return {{{x + dot(row_n, shift), y + dot(row_e, shift), z + dot(row_d, shift)}}, attitude, velocity, rate};
  }
  const Three arm = cross(rate, r_bg);
  const Three v_g{{u + arm[0], v + arm[1], w + arm[2]}};
  const auto [shift, forward, starboard, down] = displace(v_g, rate, r_bg, h);
  const Three place{{x + dot(row_n, shift), y + dot(row_e, shift), z + dot(row_d, shift)}};
  const Three after{{dot(forward, v_g) - arm[0], dot(starboard, v_g) - arm[1], dot(down, v_g) - arm[2]}};
  if (p == 0.0 && q == 0.0 && phi == 0.0 && theta == 0.0) return {place, {{phi, theta, psi + h * r}}, after, rate};
  const Three low{{dot(row_d, forward), dot(row_d, starboard), dot(row_d, down)}};
  const double expected = psi + h * dot(row_d, rate);  // more than half a turn in h is counted
  const Three turned = find_attitude(low, dot(row_n, forward), dot(row_e, forward), dot(row_n, starboard),
                                     dot(row_e, starboard), expected);
  return {place, turned, after, rate};
}

Pose coast_pose(const Pose& pose, const BodyMotion& motion, const Three& r_bg, double h) {
  const auto& [x, R] = pose;
  if (!motion.turns) return {x + h * motion.velocity, R};
  const auto [shift, forward, starboard, down] =
      displace(rotate_back(R, motion.velocity), rotate_back(R, motion.omega), r_bg, h);
  Pose after{x + rotate(R, shift), {}};
  for (int i = 0; i < 3; ++i) after.R.at[i] = {{dot(R[i], forward), dot(R[i], starboard), dot(R[i], down)}};
  return after;
}

}  // namespace shipcollision
