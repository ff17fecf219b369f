#include "kirchhoff_space.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr int MAX_ITERATIONS = 40;
constexpr double CONVERGED = 4e-15;

// d and the columns of E of a twist held for h [s].
void find_exponential(const Six& nu, double h, Three& d, Three (&columns)[3]) {
  const auto& [u, v, w, p, q, r] = nu.at;
  const double a = h * p, b = h * q, c = h * r;
  const double square = a * a + b * b + c * c;
  const double angle = sqrt(square);
  double f, g, k;
  if (angle < 1e-2) {  // the series, exact to rounding; without it, 1 - cos loses digits
    f = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
    g = 0.5 - square / 24.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0));
    k = 1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0));
  } else {
    f = sin(angle) / angle;
    const double half = sin(0.5 * angle) / angle;
    g = 2.0 * (half * half);
    k = (1.0 - f) / square;
  }
  const double x = b * w - c * v, y = c * u - a * w, z = a * v - b * u;  // a x v
  d = {{h * (u + g * x + k * (b * z - c * y)), h * (v + g * y + k * (c * x - a * z)),
        h * (w + g * z + k * (a * y - b * x))}};
  columns[0] = {{1.0 - g * (b * b + c * c), g * a * b + f * c, g * a * c - f * b}};
  columns[1] = {{g * a * b - f * c, 1.0 - g * (a * a + c * c), g * b * c + f * a}};
  columns[2] = {{g * a * c + f * b, g * b * c - f * a, 1.0 - g * (a * a + b * b)}};
}

}  // namespace

KirchhoffSpace::KirchhoffSpace(const Matrix& M, const Matrix& inverse, double radius) : radius_(radius) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      M_[i][j] = M[i][j];
      inverse_[i][j] = inverse[i][j];
    }
  }
}

Six KirchhoffSpace::kick(const Six& nu, const Six& impulse) const {
  Six after;
  for (int i = 0; i < 6; ++i) after[i] = nu[i] + multiply(inverse_[i], impulse);
  return after;
}

Three KirchhoffSpace::kick_oscillation(const Six& nu, const Six& impulse) const {
  return {{nu[2] + multiply(inverse_[2], impulse), nu[3] + multiply(inverse_[3], impulse),
           nu[4] + multiply(inverse_[4], impulse)}};
}

KirchhoffSpace::Step KirchhoffSpace::step(const Six& nu, const Six& guess, double h) const {
  const Six momentum = multiply(M_, nu);
  const auto& [P_x, P_y, P_z, L_x, L_y, L_z] = momentum.at;
  const auto& [u, v, w, p, q, r] = nu.at;
  Step result{};
  Six &mean = result.mean, change{};
  mean = guess;
  double last = 1e300;
  const double limit =
      CONVERGED * (abs(u) + abs(v) + abs(w) + radius_ * (abs(p) + abs(q) + abs(r)));
  for (int i = 0; i < MAX_ITERATIONS; ++i) {
    find_exponential(mean, h, result.d, result.columns);
    const auto& [x, y, z] = result.d.at;
    const auto& [e_x, e_y, e_z] = result.columns;
    const double M_x = L_x - (y * P_z - z * P_y), M_y = L_y - (z * P_x - x * P_z), M_z = L_z - (x * P_y - y * P_x);
    // The change of the momentum, not the momentum: M M^-1 is 1 to rounding only, and energy would drift.
    change = multiply(inverse_, {{
                                    (e_x[0] - 1.0) * P_x + e_x[1] * P_y + e_x[2] * P_z,
                                    e_y[0] * P_x + (e_y[1] - 1.0) * P_y + e_y[2] * P_z,
                                    e_z[0] * P_x + e_z[1] * P_y + (e_z[2] - 1.0) * P_z,
                                    e_x[0] * M_x + e_x[1] * M_y + e_x[2] * M_z - L_x,
                                    e_y[0] * M_x + e_y[1] * M_y + e_y[2] * M_z - L_y,
                                    e_z[0] * M_x + e_z[1] * M_y + e_z[2] * M_z - L_z,
                                }});
    Six next;
    for (int k = 0; k < 6; ++k) next[k] = nu[k] + 0.5 * change[k];
    const double moved =
        abs(next[0] - mean[0]) + abs(next[1] - mean[1]) + abs(next[2] - mean[2]) +
        radius_ * (abs(next[3] - mean[3]) + abs(next[4] - mean[4]) + abs(next[5] - mean[5]));
    mean = next;
    if (moved <= limit || (last <= moved && moved <= 1e3 * limit)) break;
    last = moved;
  }
  for (int k = 0; k < 6; ++k) result.after[k] = nu[k] + change[k];
  return result;
}

}  // namespace shipcollision
