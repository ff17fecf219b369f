// The wind on the ship above the water: the twin of shipcollision_fmu/manoeuvring/wind.py.
#pragma once

#include "../ship/windage.hpp"

namespace shipcollision {

class WindForces {
 public:
  // X, Y [N] and K, N [N m] about CO.
  struct Wrench {
    double X, Y, K, N;
  };

  WindForces() = default;
  WindForces(const Windage& windage, double L_oa);

  // At the ship's velocity u, v [m/s] relative to the air.
  Wrench operator()(double u, double v) const;

 private:
  double X_bow_, X_stern_, Y_, delta_, s_K_, s_L_, L_;
};

}  // namespace shipcollision
