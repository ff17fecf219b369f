// Frames and attitudes, and the algebra of vectors: the twin of shipcollision_fmu/ship/frames.py.
#pragma once

#include "../numbers/elementary.hpp"

namespace shipcollision {

struct Three {
  double at[3];

  double operator[](int k) const { return at[k]; }
  double& operator[](int k) { return at[k]; }
};

// The rows of a matrix (3, 3).
struct Rows {
  Three at[3];

  const Three& operator[](int k) const { return at[k]; }
};

// What holds where a body is: the place of CO in n [m], and the rows of R_nb.
struct Pose {
  Three x;
  Rows R;
};

inline Three operator+(const Three& p, const Three& q) { return {{p[0] + q[0], p[1] + q[1], p[2] + q[2]}}; }
inline Three operator-(const Three& p, const Three& q) { return {{p[0] - q[0], p[1] - q[1], p[2] - q[2]}}; }
inline Three operator-(const Three& p) { return {{-p[0], -p[1], -p[2]}}; }
inline Three operator*(double factor, const Three& p) { return {{factor * p[0], factor * p[1], factor * p[2]}}; }

inline double dot(const Three& p, const Three& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
inline double norm(const Three& p) { return sqrt(dot(p, p)); }
inline Three cross(const Three& p, const Three& q) {
  return {{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}};
}

inline Three column(const Rows& R, int k) { return {{R[0][k], R[1][k], R[2][k]}}; }
// R v and R' v: from b to n and back, for R = R_nb.
inline Three rotate(const Rows& R, const Three& v) { return {{dot(R[0], v), dot(R[1], v), dot(R[2], v)}}; }
inline Three rotate_back(const Rows& R, const Three& v) {
  return {{dot(column(R, 0), v), dot(column(R, 1), v), dot(column(R, 2), v)}};
}

// Values are compared, so that two zeros are one and nothing equals what is not a number.
inline bool is_same(const Three& p, const Three& q) { return p[0] == q[0] && p[1] == q[1] && p[2] == q[2]; }
inline bool is_same(const Rows& R, const Rows& Q) {
  return is_same(R[0], Q[0]) && is_same(R[1], Q[1]) && is_same(R[2], Q[2]);
}

inline bool is_same(const Pose& p, const Pose& q) { return is_same(p.x, q.x) && is_same(p.R, q.R); }

Rows rotation_rows(double phi, double theta, double psi);

// Attitude of a rotation, psi in (-pi, pi].
Three attitude_from_rotation(const Rows& R_nb);

// Attitude of the rotation with these columns of the hull's axes in n; psi within half a turn of the expected one.
// low: the third row.
Three find_attitude(const Three& low, double forward_north, double forward_east, double starboard_north,
                    double starboard_east, double expected);

}  // namespace shipcollision
