// Free and held motions: the twin of shipcollision_fmu/ship/degrees_of_freedom.py.
#pragma once

namespace shipcollision {

struct Six {
  double at[6];

  double operator[](int k) const { return at[k]; }
  double& operator[](int k) { return at[k]; }
};

using Matrix = double[6][6];

bool is_free(int degrees_of_freedom, int k);

// L upright L^T of a ship at an attitude; upright itself where nothing tilts. No matrix product of a library: its last
// bits would be those of the machine.
void tilt_inverse(const Matrix& upright, int degrees_of_freedom, double phi, double theta, Matrix& tilted);

Six to_level(const Six& nu, double phi);
Six from_level(const Six& nu_l, double phi);

}  // namespace shipcollision
