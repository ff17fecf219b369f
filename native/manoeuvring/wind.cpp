#include "wind.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr double RHO_AIR = 1.225;

}  // namespace

WindForces::WindForces(const Windage& w, double L_oa)
    : X_bow_(0.5 * RHO_AIR * w.A_Fw * w.C_Dl_bow),
      X_stern_(0.5 * RHO_AIR * w.A_Fw * w.C_Dl_stern),
      Y_(0.5 * RHO_AIR * w.A_Lw * w.C_Dt),
      delta_(w.delta),
      s_K_(w.kappa * w.s_H),
      s_L_(w.s_L),
      L_(L_oa) {}

WindForces::Wrench WindForces::operator()(double u, double v) const {
  const double V = hypot(u, v);
  if (V == 0.0) return {0.0, 0.0, 0.0, 0.0};
  const double along = u >= 0.0 ? X_bow_ : X_stern_;
  const double sin_cos = u / V * (v / V);
  const double c = 1.0 - 2.0 * delta_ * (1.0 - along / Y_) * sin_cos * sin_cos;
  const double Y = -Y_ * V * v / c;
  const double gamma = atan2(abs(v), u);
  return {-along * V * u / c, Y, s_K_ * Y, (s_L_ - 0.18 * (gamma - 0.5 * PI) * L_) * Y};
}

}  // namespace shipcollision
