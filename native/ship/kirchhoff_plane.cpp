#include "kirchhoff_plane.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr int MAX_ITERATIONS = 30;
constexpr double CONVERGED = 2e-15;

constexpr int PLANE[4] = {0, 1, 3, 5};

Four take_four(const Matrix& M, int row, bool rolls) {
  Four four;
  for (int k = 0; k < 4; ++k) four[k] = rolls || (row != 3 && PLANE[k] != 3) ? M[row][PLANE[k]] : 0.0;
  return four;
}

}  // namespace

KirchhoffPlane::KirchhoffPlane(const Matrix& M, const Matrix& inverse, double radius) : radius_(radius) {
  const bool rolls = inverse[3][3] != 0.0;
  for (int i = 0; i < 2; ++i) M_[i] = take_four(M, PLANE[i], rolls);
  for (int i = 0; i < 4; ++i) inverse_[i] = take_four(inverse, PLANE[i], rolls);
}

Four KirchhoffPlane::kick(const Four& nu, double K) const {
  const double a = inverse_[0][2], b = inverse_[1][2], c = inverse_[2][2], d = inverse_[3][2];
  return {{nu[0] + a * K, nu[1] + b * K, nu[2] + c * K, nu[3] + d * K}};
}

KirchhoffPlane::Step KirchhoffPlane::step(const Four& nu, const Four& guess, double h) const {
  const auto& [u, v, p, r] = nu.at;
  const Four &a = M_[0], &b = M_[1];
  const double P_x = a[0] * u + a[1] * v + a[2] * p + a[3] * r;
  const double P_y = b[0] * u + b[1] * v + b[2] * p + b[3] * r;
  Four mean = guess;
  auto& [U, V, W, Q] = mean.at;
  Four after;
  double dx = 0.0, dy = 0.0, last = 1e300;
  const double limit = CONVERGED * (abs(u) + abs(v) + radius_ * (abs(p) + abs(r)));
  for (int i = 0; i < MAX_ITERATIONS; ++i) {
    const double half = 0.5 * h * Q;
    const double s = sin(half), c = cos(half);
    const double sine = 2.0 * s * c, versine = 2.0 * s * s;  // of h Q
    const bool turns = abs(half) > 1e-5;
    const double f = turns ? sine / Q : h * (1.0 - half * half / 1.5), g = turns ? versine / Q : h * half;
    dx = f * U - g * V;
    dy = g * U + f * V;
    // The change of the momentum, not the momentum: M M^-1 is 1 to rounding only, and energy would drift.
    const double X = sine * P_y - versine * P_x, Y = -sine * P_x - versine * P_y, N = dy * P_x - dx * P_y;
    for (int k = 0; k < 4; ++k) {
      after[k] = nu[k] + (inverse_[k][0] * X + inverse_[k][1] * Y + inverse_[k][3] * N);
    }
    const double U1 = 0.5 * (u + after[0]), V1 = 0.5 * (v + after[1]), W1 = 0.5 * (p + after[2]),
                 Q1 = 0.5 * (r + after[3]);
    const double change = abs(U1 - U) + abs(V1 - V) + radius_ * (abs(W1 - W) + abs(Q1 - Q));
    if (change <= limit || (change >= last && change <= 1e3 * limit)) break;
    U = U1;
    V = V1;
    W = W1;
    Q = Q1;
    last = change;
  }
  return {dx, dy, mean, after};
}

}  // namespace shipcollision
