#include "degrees_of_freedom.hpp"

namespace shipcollision {
namespace {

// L of nu = L nu_l.
void find_level_axes(double phi, double theta, Matrix& L) {
  const Rows R_lb = rotation_rows(phi, theta, 0.0);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) L[i][j] = i / 3 == j / 3 ? R_lb[j % 3][i % 3] : 0.0;
  }
  for (int i = 0; i < 3; ++i) L[3 + i][3] = i == 0 ? 1.0 : 0.0;
}

}  // namespace

bool is_free(int degrees_of_freedom, int k) {
  if (degrees_of_freedom == 6) return true;
  return k == 0 || k == 1 || k == 5 || (k == 3 && degrees_of_freedom == 4);
}

void tilt_inverse(const Matrix& upright, int degrees_of_freedom, double phi, double theta, Matrix& tilted) {
  if (degrees_of_freedom == 6 || (phi == 0.0 && theta == 0.0)) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) tilted[i][j] = upright[i][j];
    }
    return;
  }
  Matrix L, half, whole;
  find_level_axes(phi, theta, L);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      half[i][j] = 0.0;
      for (int k = 0; k < 6; ++k) half[i][j] += L[i][k] * upright[k][j];
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      whole[i][j] = 0.0;
      for (int k = 0; k < 6; ++k) whole[i][j] += half[i][k] * L[j][k];
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) tilted[i][j] = 0.5 * (whole[i][j] + whole[j][i]);
  }
}

Six to_level(const Six& nu, double phi) {
  const auto& [u, v, w, p, q, r] = nu.at;
  const double c = cos(phi), s = sin(phi);
  return {{u, c * v - s * w, s * v + c * w, p, c * q - s * r, s * q + c * r}};
}

Six from_level(const Six& nu_l, double phi) { return to_level(nu_l, -phi); }

}  // namespace shipcollision
