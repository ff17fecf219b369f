#include "helm.hpp"

namespace shipcollision {
namespace {

// The difference to the nearest whole turn [rad].
double remainder_of_turns(double angle) { return angle - 2.0 * PI * round(angle / (2.0 * PI)); }

InPlan plan_position(const ShipState& ship) { return {ship.position[0], ship.position[1]}; }

InPlan plan_velocity(const ShipState& ship) {
  const double c = cos(ship.attitude[2]), s = sin(ship.attitude[2]);
  return {ship.velocity[0] * c - ship.velocity[1] * s, ship.velocity[0] * s + ship.velocity[1] * c};
}

bool is_too_near(const Evasion& evasion, const ShipState& own, const ShipState& other) {
  const InPlan way = plan_position(other) - plan_position(own);
  if (evasion.distance > 0.0) return hypot(way.x, way.y) <= evasion.distance;
  const InPlan velocity = plan_velocity(other) - plan_velocity(own);
  const double square = dot(velocity, velocity);
  const double time = square > 0.0 ? -dot(way, velocity) / square : 0.0;
  return 0.0 <= time && time <= evasion.time_to_closest;
}

// Heading to steer [rad]; leg: that to which it belongs, counted from 0.
double follow_line_of_sight(const Route& route, const ShipState& own, int& leg) {
  const InPlan at = plan_position(own);
  for (;;) {
    const InPlan &start = route.points[leg], &end = route.points[leg + 1];
    const double bearing = atan2(end.y - start.y, end.x - start.x);
    const double c = cos(bearing), s = sin(bearing);
    const double to_go = (end.x - at.x) * c + (end.y - at.y) * s;
    if (to_go >= route.acceptance || leg + 1 == route.waypoint_count) {
      return bearing - atan2((at.y - start.y) * c - (at.x - start.x) * s, route.lookahead);
    }
    ++leg;
  }
}

double steer_heading(const Autopilot& autopilot, double heading, double& integral, const ShipState& own, double h) {
  const double error = remainder_of_turns(heading - own.attitude[2]);
  const double limit = autopilot.rudder_limit;
  const double order =
      autopilot.gain * error + autopilot.integral_gain * integral - autopilot.rate_gain * own.rate[2];
  if (abs(order) < limit) integral += error * h;  // beyond the limit the integral would only wind up
  return min(limit, max(-limit, order));
}

}  // namespace

void Helm::begin(const HelmTable& table) {
  *this = Helm();
  table_ = table;
  is_on_route_ = table.route != nullptr;
}

void Helm::load(int k) {
  while (next_order_ < table_.order_count && table_.orders[next_order_].k <= k) {
    rudder_ = table_.orders[next_order_].rudder;
    revolutions_ = table_.orders[next_order_++].revolutions;
  }
  while (next_heading_ < table_.heading_count && table_.headings[next_heading_].k <= k) {
    const HeadingOrder& order = table_.headings[next_heading_++];
    has_heading_ = order.is_given != 0;
    heading_ = order.heading;
    is_on_route_ = false;
    integral_ = 0.0;
  }
}

void Helm::give_orders(int k, double h, int ship, const ShipState* states, ShipInputs& inputs) {
  load(k);
  inputs.rudder_order = rudder_;
  inputs.propeller_order = revolutions_;
  if (table_.autopilot != nullptr && states != nullptr) steer(h, states[ship], states, inputs);
}

void Helm::steer(double h, const ShipState& own, const ShipState* states, ShipInputs& inputs) {
  if (const Evasion* evasion = table_.evasion; evasion != nullptr) {
    is_evading_ = is_evading_ || is_too_near(*evasion, own, states[evasion->of]);
    if (is_evading_) {
      inputs.rudder_order = evasion->rudder;
      if (evasion->has_revolutions != 0) inputs.propeller_order = evasion->revolutions;
      return;
    }
  }
  bool has_heading = has_heading_;
  double heading = heading_;
  if (is_on_route_ && table_.route != nullptr) {
    heading = follow_line_of_sight(*table_.route, own, leg_);
    has_heading = true;
  }
  if (has_heading) inputs.rudder_order = steer_heading(*table_.autopilot, heading, integral_, own, h);
}

}  // namespace shipcollision
