#include "one_contact.hpp"

namespace shipcollision {

namespace {

constexpr double ROUNDING = 1e-14;
constexpr double LAST_STEP = 1e-9;

bool solve_stick(const ContactBlock& W, const Three& v, double mu, Three& P) {
  if ((W.h_1 == 0.0 && v[1] != 0.0) || (W.h_2 == 0.0 && v[2] != 0.0)) return false;
  const double rest = W.W_nn - W.w_1 * W.w_1 * W.h_1 - W.w_2 * W.w_2 * W.h_2;
  if (rest <= ROUNDING * W.W_nn) return false;
  P[0] = (W.w_1 * W.h_1 * v[1] + W.w_2 * W.h_2 * v[2] - v[0]) / rest;
  P[1] = -(v[1] + W.w_1 * P[0]) * W.h_1;
  P[2] = -(v[2] + W.w_2 * P[0]) * W.h_2;
  return hypot(P[1], P[2]) <= mu * P[0];
}

// From an angle to that of the solution, and its impulse. False where Newton's method does not find one.
bool solve_slide(const ContactBlock& W, const Three& v, double mu, double& angle, Three& P) {
  double across = 0.0, along = 0.0;
  for (int i = 0; i < 15; ++i) {
    const double c = cos(angle), s = sin(angle), W_eff = W.W_nn + mu * (W.w_1 * c + W.w_2 * s);
    if (W_eff <= 1e-3 * W.W_nn) return false;
    const double P_n = -v[0] / W_eff;
    P = {{P_n, mu * P_n * c, mu * P_n * s}};
    const double slip_1 = v[1] + W.w_1 * P_n + W.a_1 * P[1], slip_2 = v[2] + W.w_2 * P_n + W.a_2 * P[2];
    across = s * slip_1 - c * slip_2;
    along = c * slip_1 + s * slip_2;
    const double grown = -P_n * mu * (W.w_2 * c - W.w_1 * s) / W_eff;  // dP_n / dangle
    const double d_1 = W.w_1 * grown + W.a_1 * mu * (grown * c - P_n * s);
    const double d_2 = W.w_2 * grown + W.a_2 * mu * (grown * s + P_n * c);
    const double slope = along + s * d_1 - c * d_2;
    if (slope == 0.0) return false;
    const double step = -across / slope;
    if (abs(step) <= LAST_STEP) {
      if (along > 0.0) return false;
      P = {{P_n + grown * step, P[1] + mu * (grown * c - P_n * s) * step, P[2] + mu * (grown * s + P_n * c) * step}};
      angle += step;
      return true;
    }
    angle += abs(step) <= 0.5 ? step : copysign(0.5, step);
  }
  return along < 0.0 && abs(across) <= 1e-12 * norm(v);
}

double find_approach(const ContactBlock& W, const Three& v, double mu, double P_n, Friction& friction) {
  friction = solve_friction_in_disc(W, v[1] + W.w_1 * P_n, v[2] + W.w_2 * P_n, mu * P_n);
  return v[0] + W.W_nn * P_n + W.w_1 * friction.P_1 + W.w_2 * friction.P_2;
}

Three solve_bracketed(const ContactBlock& W, const Three& v, double mu, Angle& angle) {
  Friction friction;
  const double stopped = ROUNDING * v[0];
  double low = 0.0, f_low = v[0], high = -0.125 * v[0] / W.W_nn, f_high = find_approach(W, v, mu, high, friction);
  int tries = 0;
  for (; tries < 200 && !(f_high >= stopped); ++tries) {
    low = high;
    f_low = f_high;
    high *= 2.0;
    f_high = find_approach(W, v, mu, high, friction);
  }
  if (tries == 200) {  // none of the ships moves along any direction of the cone
    angle = {};
    return {{-v[0] / W.W_nn, 0.0, 0.0}};
  }
  for (int k = 0; k < 200; ++k) {
    const double middle = k % 3 == 2 ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
    if (!(low < middle && middle < high)) break;
    const double f_middle = find_approach(W, v, mu, middle, friction);
    if (f_middle < stopped) {
      low = middle;
      f_low = f_middle;
    } else {
      high = middle;
      f_high = max(f_middle, 0.0);
    }
  }
  const double P_n = -f_low < f_high ? low : high;
  find_approach(W, v, mu, P_n, friction);
  angle = {true, atan2(friction.P_2, friction.P_1)};
  return {{P_n, friction.P_1, friction.P_2}};
}

}  // namespace

Three solve_one_contact(const ContactBlock& W, const Three& v, double mu, Angle& angle) {
  const Angle start = angle;
  angle = {};
  if (v[0] >= 0.0) return {{0.0, 0.0, 0.0}};
  Three P;
  if (solve_stick(W, v, mu, P)) return P;
  if (mu == 0.0) return {{-v[0] / W.W_nn, 0.0, 0.0}};
  angle = {true, start.is_known ? start.value : atan2(-v[2], -v[1])};
  return solve_slide(W, v, mu, angle.value, P) ? P : solve_bracketed(W, v, mu, angle);
}

}  // namespace shipcollision
