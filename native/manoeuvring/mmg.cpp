#include "mmg.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

// The entry of M that is farthest from zero, on its scale, of those that couple motions in the plane of symmetry with
// others; false where all are zero.
bool find_asymmetry(const Matrix& M, int& row, int& column) {
  double most = 0.0;
  for (int i = 0; i < 6; i += 2) {
    for (int j = 1; j < 6; j += 2) {
      const double odd = abs(M[i][j]) / sqrt(M[i][i] * M[j][j]);
      if (odd > most) {
        most = odd;
        row = i;
        column = j;
      }
    }
  }
  return most > 0.0;
}

}  // namespace

bool Mmg::set_up_base(const PreparedShip& ship, Text& why) {
  if (!ship.has_manoeuvring) {
    why << "ship " << ship.name
        << " has no [manoeuvring], so it can only coast: set hydrodynamics = false or add it";
    return false;
  }
  int i = 0, j = 0;
  if (find_asymmetry(ship.M, i, j)) {
    why << "ship " << ship.name << " is not symmetric to its centreline (M[" << i << "][" << j << "] = ";
    why.short_number(ship.M[i][j])
        << ", must be 0 with hydrodynamics = true): put CG on the centreline, r_bg = [x, 0, z]";
    return false;
  }
  if (!ship.series_refusal.is_empty()) {
    why << ship.series_refusal;
    return false;
  }
  steering = make_steering_gear(ship);
  engine = make_engine(ship);
  propelled = ship.has_propeller;
  hull_ = HullForces(ship);
  wind_ = WindForces(ship.windage, ship.L_oa);
  if (propelled) propeller_ = Propeller(ship);
  has_torque_limit_ = propelled && ship.has_torque;
  if (has_torque_limit_) torque_limit_ = TorqueLimit(ship.torque, propeller_.D_P);
  has_rudder_ = propelled && ship.has_rudder;
  if (has_rudder_) rudder_ = Rudder(ship);
  return true;
}

double Mmg::limit_revolutions(const Six& eta, const Six& nu, double n, const Surroundings& around) const {
  if (!has_torque_limit_) return n;
  return torque_limit_.find_range(find_inflow(pack(eta, nu), around)).limit(n);
}

void Mmg::advance(Six& eta, Six& nu, Machines& machines, const Orders& orders, const Surroundings& around, double h,
                  int substeps) const {
  const double dt = h / substeps;
  auto [delta, n, gear] = machines;
  const bool is_still = around.current_north == 0.0 && around.current_east == 0.0;
  Integrated x = pack(eta, nu);
  for (int i = 0; i < substeps; ++i) {
    const double delta_mid = steering.follow(delta, orders.rudder_angle, 0.5 * dt);
    const double delta_end = steering.follow(delta, orders.rudder_angle, dt);
    Gear half = gear;
    double n_mid = engine.follow(n, half, orders.propeller_speed, 0.5 * dt);
    double n_end = engine.follow(n, gear, orders.propeller_speed, dt);
    if (has_torque_limit_ && !(is_still && n >= 0.0 && n_end >= 0.0 &&
                               torque_limit_.is_surely_free(x[surge_], max(n, n_end)))) {
      const Range range = torque_limit_.find_range(find_inflow(x, around));
      n = range.limit(n);
      n_mid = range.limit(n_mid);
      n_end = range.limit(n_end);
    }
    const Integrated a = find_derivative(x, delta, n, around);
    const Integrated b = find_derivative(add_scaled(x, a, 0.5 * dt), delta_mid, n_mid, around);
    const Integrated c = find_derivative(add_scaled(x, b, 0.5 * dt), delta_mid, n_mid, around);
    const Integrated d = find_derivative(add_scaled(x, c, dt), delta_end, n_end, around);
    Integrated mean;
    for (int k = 0; k < count_; ++k) mean[k] = (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0;
    x = add_scaled(x, mean, dt);
    delta = delta_end;
    n = n_end;
  }
  unpack(x, eta, nu);
  machines = {delta, n, gear};
}

WindForces::Wrench Mmg::compute_wind(double u, double v, double psi, const Surroundings& around) const {
  const double north = around.wind_north, east = around.wind_east;
  if (north == 0.0 && east == 0.0) return {0.0, 0.0, 0.0, 0.0};
  const double c = cos(psi), s = sin(psi);
  return wind_(u - (north * c + east * s), v - (east * c - north * s));
}

Integrated Mmg::add_scaled(const Integrated& x, const Integrated& k, double dt) const {
  Integrated sum;
  for (int i = 0; i < count_; ++i) sum[i] = x[i] + dt * k[i];
  return sum;
}

}  // namespace shipcollision
