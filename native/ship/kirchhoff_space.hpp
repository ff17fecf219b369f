// Kirchhoff's equations in space: the twin of shipcollision_fmu/ship/kirchhoff_space.py.
#pragma once

#include "degrees_of_freedom.hpp"
#include "frames.hpp"

namespace shipcollision {

class KirchhoffSpace {
 public:
  struct Step {
    Three d;
    Three columns[3];
    Six mean, after;
  };

  KirchhoffSpace() = default;
  KirchhoffSpace(const Matrix& M, const Matrix& inverse, double radius);

  Six kick(const Six& nu, const Six& impulse) const;
  // w, p and q after an impulse.
  Three kick_oscillation(const Six& nu, const Six& impulse) const;
  Step step(const Six& nu, const Six& guess, double h) const;

 private:
  Matrix M_, inverse_;
  double radius_;
};

}  // namespace shipcollision
