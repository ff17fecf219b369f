// The rudder behind the propeller: the twin of shipcollision_fmu/manoeuvring/rudder.py.
#pragma once

#include "hull_forces.hpp"

namespace shipcollision {

class Rudder {
 public:
  Rudder() = default;
  explicit Rudder(const PreparedShip& ship);

  // At the angle delta [rad] in the race of `thrust` [N].
  Planar operator()(double U, double beta, double r, double u_P, double thrust, double delta) const;

 private:
  double normal_, x_, y_, n_, l_R_, gamma_plus_, gamma_minus_, epsilon_, kappa_, eta_, race_;
};

}  // namespace shipcollision
