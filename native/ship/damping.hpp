// Damping of heave, roll and pitch: the twin of shipcollision_fmu/ship/damping.py.
#pragma once

#include "../numbers/elementary.hpp"
#include "seakeeping.hpp"

namespace shipcollision {

class Damping {
 public:
  struct Wrench {
    double Z, K, M;
  };

  Damping() = default;
  explicit Damping(const Seakeeping& sea) : D_33_(sea.D_33), D_44_(sea.D_44), D_44q_(sea.D_44q), D_55_(sea.D_55) {}

  Wrench operator()(double w, double p, double q) const {
    return {-D_33_ * w, -(D_44_ + D_44q_ * abs(p)) * p, -D_55_ * q};
  }

 private:
  double D_33_, D_44_, D_44q_, D_55_;
};

}  // namespace shipcollision
