// Steering gear and engine: the twin of shipcollision_fmu/manoeuvring/actuators.py.
#pragma once

#include "../numbers/elementary.hpp"
#include "../ship/prepared_ship.hpp"

namespace shipcollision {

struct Gear {
  double side = 0.0;    // that the engine runs or last ran to: 1 ahead, -1 astern, 0 not yet
  double waited = 0.0;  // how long the reversal has lasted [s]
};

struct Actuator {
  double least = 0.0, most = 0.0, rate = 0.0;

  double limit(double order) const { return min(most, max(least, order)); }

  double follow(double value, double order, double time) const {
    const double target = limit(order), reach = rate * time;
    return value + min(reach, max(-reach, target - value));
  }
};

struct Engine {
  Actuator speed;
  double reversal_delay = 0.0;

  double limit(double order) const { return speed.limit(order); }
  Gear find_gear(double n) const { return {n != 0.0 ? copysign(1.0, n) : 0.0, 0.0}; }
  // The propeller speed after `time` [s] under the order; the gear is moved on.
  double follow(double n, Gear& gear, double order, double time) const;
};

Actuator make_steering_gear(const PreparedShip& ship);
Engine make_engine(const PreparedShip& ship);

}  // namespace shipcollision
