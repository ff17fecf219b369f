// Free and held motions: the twin of shipcollision_fmu/ship/degrees_of_freedom.py.
#pragma once

#include "frames.hpp"

namespace shipcollision {

struct Six {
  double at[6];

  double operator[](int k) const { return at[k]; }
  double& operator[](int k) { return at[k]; }
};

using Matrix = double[6][6];

inline Six operator+(const Six& p, const Six& q) {
  return {{p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3], p[4] + q[4], p[5] + q[5]}};
}
inline Six operator-(const Six& p, const Six& q) {
  return {{p[0] - q[0], p[1] - q[1], p[2] - q[2], p[3] - q[3], p[4] - q[4], p[5] - q[5]}};
}
inline Six operator*(double factor, const Six& p) {
  return {{factor * p[0], factor * p[1], factor * p[2], factor * p[3], factor * p[4], factor * p[5]}};
}
inline double dot(const Six& p, const Six& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3] + p[4] * q[4] + p[5] * q[5];
}
inline double multiply(const double (&row)[6], const Six& p) {
  return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] * p[3] + row[4] * p[4] + row[5] * p[5];
}
inline Six multiply(const Matrix& rows, const Six& p) {
  return {{multiply(rows[0], p), multiply(rows[1], p), multiply(rows[2], p), multiply(rows[3], p), multiply(rows[4], p),
           multiply(rows[5], p)}};
}

// Velocity and angular velocity of a twist, and back.
inline Three first_three(const Six& p) { return {{p[0], p[1], p[2]}}; }
inline Three last_three(const Six& p) { return {{p[3], p[4], p[5]}}; }
inline Six join(const Three& p, const Three& q) { return {{p[0], p[1], p[2], q[0], q[1], q[2]}}; }

inline bool is_same(const Six& p, const Six& q) {
  return is_same(first_three(p), first_three(q)) && is_same(last_three(p), last_three(q));
}
inline bool is_zero(const Six& p) { return is_same(p, Six{}); }

bool is_free(int degrees_of_freedom, int k);

// L upright L^T of a ship at an attitude; upright itself where nothing tilts. No matrix product of a library: its last
// bits would be those of the machine.
void tilt_inverse(const Matrix& upright, int degrees_of_freedom, double phi, double theta, Matrix& tilted);

Six to_level(const Six& nu, double phi);
Six from_level(const Six& nu_l, double phi);

}  // namespace shipcollision
