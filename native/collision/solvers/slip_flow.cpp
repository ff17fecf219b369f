#include "slip_flow.hpp"

namespace shipcollision {

double SlipFlow::growth(double angle) const {
  const double c = cos(angle), s = sin(angle);
  return w_1 * c + w_2 * s - mu * (A_1 * c * c + A_2 * s * s);
}

void SlipFlow::solve_reslip(double& c, double& s) const {
  double g = max(max(abs(w_1) - mu * A_1, abs(w_2) - mu * A_2), 0.0), x = 0.0, y = 0.0, size = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double b_1 = g + mu * A_1, b_2 = g + mu * A_2;
    x = w_1 != 0.0 ? w_1 / b_1 : 0.0;
    y = w_2 != 0.0 ? w_2 / b_2 : 0.0;
    size = hypot(x, y);
    const double slope = (w_1 != 0.0 ? x * x / b_1 : 0.0) + (w_2 != 0.0 ? y * y / b_2 : 0.0);
    const double step = size * size * (size - 1.0) / slope;
    if (step <= 1e-16 * g) break;
    g += step;
  }
  c = x / size;
  s = y / size;
}

}  // namespace shipcollision
