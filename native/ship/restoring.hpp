// Buoyancy and weight: the twin of shipcollision_fmu/ship/restoring.py.
#pragma once

#include "degrees_of_freedom.hpp"
#include "seakeeping.hpp"

namespace shipcollision {

class Restoring {
 public:
  Restoring() = default;
  explicit Restoring(const Seakeeping& sea);

  double compute_roll_moment(double s_phi, double c_phi) const;
  Six operator()(double D, double s_phi, double c_phi, double s_theta, double c_theta) const;

 private:
  double K_33_, K_44_, K_55_, K_44_BM_, x_F_, tan2_deck_, cos_deck_;
};

}  // namespace shipcollision
