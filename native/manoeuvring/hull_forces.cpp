#include "hull_forces.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr double DEGREE = PI / 180.0;
constexpr double C_D = 1.0;
constexpr double BETA[2] = {25.0 * DEGREE, 45.0 * DEGREE};
constexpr double GAMMA[2] = {40.0 * DEGREE, 60.0 * DEGREE};
constexpr double C_N[2] = {1.0, 2.5};
constexpr double C_M = 0.5;

// tan(BETA[0]) (1 - 1e-9) and tan(GAMMA[0]) (1 - 1e-9): below, the cross flow does not count.
constexpr double STEEPEST = 0.4663076576886909;
constexpr double QUICKEST = 0.8390996303381804;

// The yaw damping of the polynomials over that of the cross flow, in the middle of the hand-over.
double match_yaw_damping(double N_r, double N_vvr) {
  const double beta = 0.5 * (BETA[0] + BETA[1]), sine = sin(beta);
  const double matched = (N_r * (cos(beta) - 1.0) - N_vvr * (sine * sine)) / (C_D * sine / 6.0);
  return min(max(matched, C_N[0]), C_N[1]);
}

// 0: the polynomials hold; 1: cross flow alone; smooth between.
double find_cross_flow_share(double u, double v, double s) {
  const double beta = abs(atan2(v, u)), gamma = atan2(abs(s), abs(u));
  if (beta <= BETA[0] && gamma <= GAMMA[0]) return 0.0;
  const double x = max((beta - BETA[0]) / (BETA[1] - BETA[0]), (gamma - GAMMA[0]) / (GAMMA[1] - GAMMA[0]));
  return x >= 1.0 ? 1.0 : x * x * (3.0 - 2.0 * x);
}

}  // namespace

HullForces::HullForces(const PreparedShip& ship)
    : L_(ship.L_pp),
      half_L_(0.5 * ship.L_pp),
      force_(0.5 * ship.rho * ship.L_pp * ship.T),
      moment_(force_ * ship.L_pp),
      table_(ship.manoeuvring),
      X_vr_beyond_(min(table_.X_vr, (C_M - 1.0) * (ship.M_A[1][1] / (force_ * ship.L_pp)))),
      yaw_drag_(C_D * match_yaw_damping(table_.N_r, table_.N_vvr)) {}

Planar HullForces::operator()(double u, double v, double r) const {
  double share = 0.0;
  const double s = half_L_ * r;
  if (!(abs(v) < STEEPEST * u && abs(s) < QUICKEST * u)) {
    share = find_cross_flow_share(u, v, s);
    if (share == 1.0) return compute_cross_flow(u, v, r);
  }
  const double U = hypot(u, v);  // with a share below 1, U > 0 and |r'| < 3.5, or all is at rest
  if (U == 0.0) return {0.0, 0.0, 0.0};
  const double v_1 = v / U, r_1 = r * L_ / U;
  const double vv = v_1 * v_1, vr = v_1 * r_1, rr = r_1 * r_1;
  const ManoeuvringTable& t = table_;
  double X = -t.R_0 + t.X_vv * vv + t.X_vr * vr + t.X_rr * rr + t.X_vvvv * vv * vv;
  double Y =
      t.Y_v * v_1 + t.Y_r * r_1 + t.Y_vvv * vv * v_1 + t.Y_vvr * vv * r_1 + t.Y_vrr * v_1 * rr + t.Y_rrr * rr * r_1;
  double N =
      t.N_v * v_1 + t.N_r * r_1 + t.N_vvv * vv * v_1 + t.N_vvr * vv * r_1 + t.N_vrr * v_1 * rr + t.N_rrr * rr * r_1;
  const double UU = U * U;
  X = force_ * UU * X;
  Y = force_ * UU * Y;
  N = moment_ * UU * N;
  if (share == 0.0) return {X, Y, N};
  const Planar beyond = compute_cross_flow(u, v, r);
  return {X + share * (beyond.X - X), Y + share * (beyond.Y - Y), N + share * (beyond.N - N)};
}

Planar HullForces::compute_cross_flow(double u, double v, double r) const {
  const double rL = r * L_;
  double drag, drag_moment;
  integrate_cross_flow(v, 0.5 * rL, drag, drag_moment);
  const double X = -table_.R_0 * u * abs(u) + X_vr_beyond_ * v * rL;
  const double Y = table_.Y_v * abs(u) * v + table_.Y_r * u * rL - C_D * drag;
  const double N = table_.N_v * u * v + table_.N_r * abs(u) * rL - yaw_drag_ * drag_moment;
  return {force_ * X, force_ * Y, moment_ * N};
}

void integrate_cross_flow(double v, double s, double& drag, double& drag_moment) {
  const double a = abs(v), b = abs(s);
  if (a >= b) {  // the flow comes from one side all along the ship
    const double one = v > 0.0 ? 1.0 : -1.0;
    drag = one * (v * v + s * s / 3.0);
    drag_moment = a * s / 3.0;
    return;
  }
  const double one = s > 0.0 ? 1.0 : -1.0;
  drag = v * (b + v * v / (3.0 * b));
  drag_moment = one * (s * s / 8.0 + v * v / 4.0 - v * v * (v / s) * (v / s) / 24.0);
}

}  // namespace shipcollision
