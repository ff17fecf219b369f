#include "actuators.hpp"

namespace shipcollision {
namespace {

double radians(double degrees) { return degrees * (PI / 180.0); }

}  // namespace

double Engine::follow(double n, Gear& gear, double order, double time) const {
  if (reversal_delay == 0.0) return speed.follow(n, order, time);
  const double target = speed.limit(order), side = gear.side;
  if (target * side >= 0.0) {  // the way it runs, or stop
    gear = {target != 0.0 && side == 0.0 ? copysign(1.0, target) : side, 0.0};
    return speed.follow(n, target, time);
  }
  const double stopping = abs(n) / speed.rate;
  if (time < stopping) {
    gear = {side, 0.0};
    return speed.follow(n, 0.0, time);
  }
  const double waited = gear.waited + (time - stopping);
  if (waited < reversal_delay) {
    gear = {side, waited};
    return 0.0;
  }
  gear = {-side, 0.0};
  return speed.follow(0.0, target, waited - reversal_delay);
}

Actuator make_steering_gear(const PreparedShip& ship) {
  if (!ship.has_rudder) return {};
  const double most = radians(ship.rudder.max_angle_deg);
  return {-most, most, radians(ship.rudder.rate_deg_per_s)};
}

Engine make_engine(const PreparedShip& ship) {
  if (!ship.has_engine) return {};
  const EngineTable& table = ship.engine;
  return {{-table.max_astern_rev_per_s, table.max_rev_per_s, table.rate}, table.reversal_delay};
}

}  // namespace shipcollision
