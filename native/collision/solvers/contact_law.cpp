#include "contact_law.hpp"

namespace shipcollision {

ContactBlock make_block(const Dense& W, int contact) {
  const int n = 3 * contact;
  const double a_1 = W[n + 1][n + 1], a_2 = W[n + 2][n + 2];
  return {W[n][n], W[n][n + 1], W[n][n + 2], a_1, a_2, a_1 > 0.0 ? 1.0 / a_1 : 0.0, a_2 > 0.0 ? 1.0 / a_2 : 0.0};
}

Friction solve_friction_in_disc(const ContactBlock& W, double v_1, double v_2, double radius) {
  const double size = hypot(v_1, v_2);
  if (size == 0.0 || radius <= 0.0) return {0.0, 0.0};
  double P_1 = -v_1 * W.h_1, P_2 = -v_2 * W.h_2, length = 0.0;
  const bool can_stick = (W.h_1 > 0.0 || v_1 == 0.0) && (W.h_2 > 0.0 || v_2 == 0.0);
  if (can_stick && hypot(P_1, P_2) <= radius) return {P_1, P_2};
  const double stiffest = max(W.a_1, W.a_2);
  double g = max(max(0.0, size / radius - stiffest), max(abs(v_1) / radius - W.a_1, abs(v_2) / radius - W.a_2));
  if (g > 1e18 * stiffest) return {-v_1 / size * radius, -v_2 / size * radius};
  for (int i = 0; i < 60; ++i) {
    const double b_1 = W.a_1 + g, b_2 = W.a_2 + g;
    P_1 = v_1 != 0.0 ? -v_1 / b_1 : 0.0;
    P_2 = v_2 != 0.0 ? -v_2 / b_2 : 0.0;
    const double square = P_1 * P_1 + P_2 * P_2;
    length = sqrt(square);
    const double bend = (P_1 != 0.0 ? P_1 * P_1 / b_1 : 0.0) + (P_2 != 0.0 ? P_2 * P_2 / b_2 : 0.0);
    const double step = (length / radius - 1.0) * square / bend;
    g += step;
    if (abs(step) <= 1e-15 * g) break;
  }
  const double share = radius / length;
  return {P_1 * share, P_2 * share};
}

double find_approach(const double* v, int size) {
  double least = size > 0 ? v[0] : 0.0;
  for (int n = 3; n < size; n += 3) least = min(least, v[n]);
  return -least;
}

double law_residual(const Dense& W, const double* v, double mu, const double* P) {
  const int size = W.rows();
  double worst = 0.0;
  for (int n = 0; n < size; n += 3) {
    double after[3];
    for (int i = 0; i < 3; ++i) after[i] = v[n + i] + dot(W[n + i], P, size);
    if (!are_finite(after, 3)) return INFINITE;
    const double stiffest = max(W[n + 1][n + 1], W[n + 2][n + 2]), rho = stiffest != 0.0 ? stiffest : 1.0;
    const double x = P[n + 1] - after[1] / rho, y = P[n + 2] - after[2] / rho;
    const double length = hypot(x, y), radius = mu * max(P[n], 0.0);
    const double share = length > radius ? radius / length : 1.0;
    const double along = abs(min(P[n] * W[n][n], after[0]));
    worst = max(worst, max(along, hypot(P[n + 1] - x * share, P[n + 2] - y * share) * rho));
  }
  return worst;
}

}  // namespace shipcollision
