#include "rudder.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {

Rudder::Rudder(const PreparedShip& ship) {
  const RudderTable& table = ship.rudder;
  const double L = ship.L_pp, D_p = ship.propeller.D_p;
  normal_ = 0.5 * ship.rho * table.A_R * table.f_alpha;
  x_ = 1.0 - table.t_R;
  y_ = 1.0 + table.a_H;
  n_ = (table.x_R + table.a_H * table.x_H) * L;
  l_R_ = table.l_R * L;
  gamma_plus_ = table.gamma_R_plus;
  gamma_minus_ = table.gamma_R_minus;
  epsilon_ = table.epsilon;
  kappa_ = table.kappa;
  eta_ = min(1.0, D_p / table.H_R);
  race_ = 8.0 / (PI * ship.rho * (D_p * D_p));
}

Planar Rudder::operator()(double U, double beta, double r, double u_P, double thrust, double delta) const {
  const double U_beta_R = U * beta - l_R_ * r;
  const double v_R = U_beta_R * (U_beta_R < 0.0 ? gamma_minus_ : gamma_plus_);
  const double speed = abs(u_P);
  const double raced = sqrt(max(0.0, u_P * u_P + race_ * thrust));  // far behind the propeller
  const double in_race = u_P + kappa_ * (raced - speed);
  const double squared = eta_ * in_race * abs(in_race) + (1.0 - eta_) * u_P * speed;
  const double u_R = copysign(epsilon_ * sqrt(abs(squared)), squared);
  const double sin_delta = sin(delta), cos_delta = cos(delta);
  const double F_N = normal_ * hypot(u_R, v_R) * (u_R * sin_delta - v_R * cos_delta);
  return {-x_ * F_N * sin_delta, -y_ * F_N * cos_delta, -n_ * F_N * cos_delta};
}

}  // namespace shipcollision
