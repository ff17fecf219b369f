#include "chord.hpp"

namespace shipcollision {

Chord find_chord(const Pose& pose, const Three& position, const Three& attitude, const Three& r_bg, const Six& nu,
                 double H) {
  const Rows turn = turn_back(pose.R, rotation_rows(attitude[0], attitude[1], attitude[2]));
  const Three angles = rotation_vector_of(turn);
  const Three rate{{angles[0] / H, angles[1] / H, angles[2] / H}};
  const Three way = rotate_back(pose.R, position - pose.x) + rotate(turn, r_bg) - r_bg;
  const Three arm = cross(rate, r_bg);
  const Three velocity = Three{{way[0] / H, way[1] / H, way[2] / H}} - arm;
  const Three omega = last_three(nu);
  const Three omega_then = rotate_back(turn, omega);
  const Three v_g = rotate_back(turn, first_three(nu) + cross(omega, r_bg));
  return {join(velocity, rate), join(v_g - cross(omega_then, r_bg), omega_then)};
}

Three rotation_vector_of(const Rows& R) {
  const Three axis{{R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]}};
  const double s = 0.5 * norm(axis);
  double factor;
  if (R[0][0] + R[1][1] + R[2][2] < 1.0) {  // more than a quarter turn; about half a turn the axis is lost
    factor = 0.5 * (PI - asin(min(1.0, s))) / max(s, 1e-9);
  } else {
    factor = s < 1e-9 ? 0.5 : 0.5 * asin(min(1.0, s)) / s;
  }
  return factor * axis;
}

Rows turn_back(const Rows& R, const Rows& Q) {
  Rows turned;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) turned.at[i][j] = R[0][i] * Q[0][j] + R[1][i] * Q[1][j] + R[2][i] * Q[2][j];
  }
  return turned;
}

}  // namespace shipcollision
