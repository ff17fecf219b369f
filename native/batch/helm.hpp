// The helm of one ship: timed orders and, if it is steered, an autopilot, a route and a late evasion. The twin of
// shipcollision_fmu/cosim/helm.py, autopilot.py, route.py and evasion.py, which have the laws.
#pragma once

#include <stdint.h>

#include "../collision/interface.hpp"
#include "../manoeuvring/interface.hpp"
#include "plan_contact.hpp"

namespace shipcollision {

// As Python fills them: orders and headings by communication point k, rising.
struct RudderOrder {
  int32_t k, unused;
  double rudder, revolutions;
};

struct HeadingOrder {
  int32_t k, is_given;  // not given: the rudder is ordered again
  double heading;
};

struct Autopilot {
  double gain, rate_gain, integral_gain, rudder_limit;
};

// points: the start, then the waypoints.
struct Route {
  const InPlan* points;
  int32_t waypoint_count, unused;
  double lookahead, acceptance;
};

// of: number of the ship to evade, from 0; a distance or a time of zero does not count.
struct Evasion {
  int32_t of, has_revolutions;
  double distance, time_to_closest, rudder, revolutions;
};

// Of a ship; route and evasion are null where there is none, and nothing is steered where all three are.
struct HelmTable {
  const RudderOrder* orders;
  const HeadingOrder* headings;
  const Autopilot* autopilot;  // null: timed orders alone
  const Route* route;
  const Evasion* evasion;
  int32_t order_count, heading_count;
};

class Helm {
 public:
  void begin(const HelmTable& table);
  // Puts the orders of communication point k, of steps of h [s], into the inputs. states: of all ships.
  void give_orders(int k, double h, int ship, const ShipState* states, ShipInputs& inputs);

 private:
  void load(int k);
  void steer(double h, const ShipState& own, const ShipState* states, ShipInputs& inputs);

  HelmTable table_{};
  int next_order_ = 0, next_heading_ = 0;
  double rudder_ = 0.0, revolutions_ = 0.0;  // the timed orders in force
  bool has_heading_ = false, is_on_route_ = false, is_evading_ = false;
  double heading_ = 0.0, integral_ = 0.0;
  int leg_ = 0;
};

}  // namespace shipcollision
