// Frames and attitudes: the twin of shipcollision_fmu/ship/frames.py.
#pragma once

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

inline double dot(const Three& p, const Three& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

Rows rotation_rows(double phi, double theta, double psi);

// Attitude of the rotation with these columns of the hull's axes in n; psi within half a turn of the expected one.
// low: the third row.
Three find_attitude(const Three& low, double forward_north, double forward_east, double starboard_north,
                    double starboard_east, double expected);

}  // namespace shipcollision
