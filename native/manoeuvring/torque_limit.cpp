#include "torque_limit.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {

bool TorqueLimit::is_surely_free(double u, double n) const {
  constexpr int AT_REST = TORQUE_WIDEST * TORQUE_PER_UNIT;
  if (!(u >= 0.0)) return false;
  const double place = u * table_->per_speed;
  const int k = place >= 0.0 && place < AT_REST ? static_cast<int>(place) : place < 0.0 ? 0 : AT_REST;
  return n <= n_ * table_->most[AT_REST + k];
}

Range TorqueLimit::find_range(double u_P) const {
  double inflow = u_P / table_->root, scale = n_;
  if (!(-TORQUE_WIDEST < inflow && inflow < TORQUE_WIDEST)) {
    scale *= abs(inflow) / TORQUE_WIDEST;
    inflow = inflow > 0.0 ? TORQUE_WIDEST : -TORQUE_WIDEST;
  }
  const double place = (inflow + TORQUE_WIDEST) * TORQUE_PER_UNIT;
  const int k = static_cast<int>(min(floor(place), TORQUE_ENTRIES - 2.0));
  const double share = place - k;
  const double *least = table_->least + k, *most = table_->most + k;
  return {scale * (least[0] + share * (least[1] - least[0])), scale * (most[0] + share * (most[1] - most[0]))};
}

}  // namespace shipcollision
