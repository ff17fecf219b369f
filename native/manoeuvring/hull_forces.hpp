// Forces of the water on the bare hull: the twin of shipcollision_fmu/manoeuvring/hull_forces.py.
#pragma once

#include "../ship/prepared_ship.hpp"

namespace shipcollision {

// X, Y [N] and N [N m] about midship.
struct Planar {
  double X, Y, N;
};

class HullForces {
 public:
  HullForces() = default;
  explicit HullForces(const PreparedShip& ship);

  Planar operator()(double u, double v, double r) const;

 private:
  Planar compute_cross_flow(double u, double v, double r) const;

  double L_, half_L_, force_, moment_;
  ManoeuvringTable table_;
  double X_vr_beyond_, yaw_drag_;
};

// Means of w|w| and of (x/L) w|w| over the length, w = v + s xi [m2/s2].
void integrate_cross_flow(double v, double s, double& drag, double& drag_moment);

}  // namespace shipcollision
