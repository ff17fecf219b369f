#include "propeller.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr double ROTATION = 0.7 * PI;

}  // namespace

Propeller::Propeller(const PreparedShip& ship)
    : D_P(ship.propeller.D_p),
      remaining(1.0 - ship.propeller.t_P),
      unit(ship.rho * (D_P * D_P)),
      x_P_(ship.propeller.x_P * ship.L_pp),
      through_(1.0 - ship.propeller.w_P0),
      C_1_(ship.propeller.C_1),
      plus_(ship.propeller.C_2_plus - 1.0),
      minus_(ship.propeller.C_2_minus - 1.0),
      k_0_(ship.propeller.k_0),
      k_1_(ship.propeller.k_1),
      k_2_(ship.propeller.k_2),
      astern_(ship.propeller.astern_factor),
      series_(ship.series) {}

double Propeller::compute_inflow(double u, double U, double beta, double r) const {
  if (U == 0.0) return 0.0;
  const double beta_P = beta - x_P_ * r / U;
  if (beta_P > 0.0) return u * through_ * (1.0 + (1.0 - exp(-C_1_ * beta_P)) * plus_);
  return u * through_ * (1.0 + (1.0 - exp(C_1_ * beta_P)) * minus_);
}

double Propeller::compute_thrust(double u_P, double n) const {
  const double nD = n * D_P;
  if (nD >= 0.0 && u_P >= 0.0) {
    const double own = (k_0_ * nD + k_1_ * u_P) * nD + k_2_ * u_P * u_P;
    if (own >= 0.0) return unit * own;
  }
  if (n < 0.0 && astern_ != 1.0) {
    const double drag = find_measured(u_P, 0.0);
    return drag + astern_ * (find_measured(u_P, nD) - drag);
  }
  return find_measured(u_P, nD);
}

// The thrust of the series.
double Propeller::find_measured(double u_P, double nD) const {
  const double blade = ROTATION * nD;
  const double place = (atan2(u_P, blade) * (180.0 / PI) + 180.0) * SERIES_PER_DEGREE;
  if (!isfinite(place)) return place;  // Python refuses the step here, the model when it looks at the motion
  const int k = static_cast<int>(min(floor(place), SERIES_ENTRIES - 2.0));
  const double low = series_[k], high = series_[k + 1];
  return unit * (u_P * u_P + blade * blade) * (low + (place - k) * (high - low));
}

}  // namespace shipcollision
