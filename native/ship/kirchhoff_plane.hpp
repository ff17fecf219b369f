// Kirchhoff's equations in the plane: the twin of shipcollision_fmu/ship/kirchhoff_plane.py.
#pragma once

#include "degrees_of_freedom.hpp"

namespace shipcollision {

struct Four {
  double at[4];

  double operator[](int k) const { return at[k]; }
  double& operator[](int k) { return at[k]; }
};

class KirchhoffPlane {
 public:
  struct Step {
    double dx, dy;
    Four mean, after;
  };

  KirchhoffPlane() = default;
  KirchhoffPlane(const Matrix& M, const Matrix& inverse, double radius);

  Four kick(const Four& nu, double K) const;
  Step step(const Four& nu, const Four& guess, double h) const;

 private:
  Four M_[2], inverse_[4];
  double radius_;
};

}  // namespace shipcollision
