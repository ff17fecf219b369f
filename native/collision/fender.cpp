#include "fender.hpp"

namespace shipcollision {
namespace {

const double SINGULAR = 1e-9;  // share of the larger eigenvalue, below which a direction cannot be pushed

// Takes off P the share of the slip along the direction (c, s), in which W is `mobility`.
void stop_along(double c, double s, double mobility, const double (&slip)[2], double (&P)[2]) {
  const double along = (c * slip[0] + s * slip[1]) / mobility;
  P[0] -= c * along;
  P[1] -= s * along;
}

}  // namespace

bool build_fender(const char* name, const Fender& values, bool& has_fender, Text& why) {
  const auto& [stiffness, damping, thickness] = values;
  has_fender = stiffness != 0.0 || damping != 0.0 || thickness != 0.0;
  const bool are_finite = isfinite(stiffness) && isfinite(damping) && isfinite(thickness);
  if (!has_fender || (are_finite && stiffness > 0.0 && damping >= 0.0 && thickness > 0.0)) return true;
  why << name << ": stiffness = " << stiffness << " N/m, damping = " << damping << " N s/m, thickness = " << thickness
      << " m is no fender: stiffness and thickness must be positive, damping not negative; all 0 for none";
  return false;
}

Fender combine_in_series(const Fender& one, const Fender& other) {
  const double share = other.stiffness / (one.stiffness + other.stiffness);
  const double damping = one.damping + other.damping;
  return {one.stiffness * share, damping > 0.0 ? one.damping * other.damping / damping : 0.0,
          one.thickness + other.thickness};
}

Compression compress_fender(const Fender& fender, double compression, double rate, double W_nn, double stored,
                            double h) {
  if (W_nn <= 0.0) return {0.0, stored, 0.0};
  const double k = min(fender.stiffness, 1.0 / (W_nn * h * h)), c = fender.damping;
  double P = max(0.0, h * (k * compression + c * rate) / (1.0 + W_nn * h * c));
  double after = rate - W_nn * P;
  double taken = P * (rate - 0.5 * W_nn * P);
  double damped = max(0.0, min(P, h * c * after) * 0.5 * (rate + after));
  if (stored + taken - damped < 0.0) {  // more than was put into the spring: it returns what it has
    const double root = sqrt(rate * rate + 2.0 * W_nn * stored);
    P = rate < 0.0 ? 2.0 * stored / (root - rate) : (root + rate) / W_nn;
    after = rate - W_nn * P;
    taken = P * (rate - 0.5 * W_nn * P);
    damped = 0.0;
  }
  const double kept =
      max(0.0, min(stored + taken - damped, 0.5 * k * compression * max(0.0, compression + h * after)));
  return {P, kept, stored + taken - kept};
}

// By the eigenvectors of W: one Jacobi rotation makes a matrix of two diagonal.
void solve_friction(const Rows& W, const double (&slip)[2], double mu, double P_n, double (&P_t)[2]) {
  const double a = W[1][1], b = W[2][1], d = W[2][2];
  double c = 1.0, s = 0.0, t = 0.0;
  if (b != 0.0) {
    const double ratio = 0.5 * (d - a) / b;
    t = copysign(1.0, ratio) / (abs(ratio) + sqrt(1.0 + ratio * ratio));
    c = 1.0 / sqrt(1.0 + t * t);
    s = t * c;
  }
  const double first = a - t * b, second = d + t * b, least = SINGULAR * max(abs(first), abs(second));
  P_t[0] = P_t[1] = 0.0;
  if (abs(first) > least) stop_along(c, -s, first, slip, P_t);
  if (abs(second) > least) stop_along(s, c, second, slip, P_t);
  const double size = hypot(P_t[0], P_t[1]);
  if (size <= mu * P_n) return;
  P_t[0] *= mu * P_n / size;
  P_t[1] *= mu * P_n / size;
}

}  // namespace shipcollision
