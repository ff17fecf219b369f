// All contacts at once as a sequence of convex problems: the twin of
// shipcollision_fmu/collision/solvers/aclm_fixed_point.py.
#pragma once

#include "../../numbers/dense.hpp"
#include "work_limit.hpp"

namespace shipcollision {

class AclmFixedPoint {
 public:
  explicit AclmFixedPoint(Memory& memory);

  // Room for so many contacts; false without memory.
  bool reserve(int contacts);
  // The operator of the calls that follow, which is kept by reference.
  void set_operator(const Dense& W);

  // Updates the impulses P (3k) [N s]: mostly to a smaller residual. tolerance [m/s]: at which the updates end.
  void solve(const double* v, double mu, double* P, double tolerance, WorkLimit& work);

 private:
  void solve_convex(double mu, double* P, double tolerance, WorkLimit& work);

  int contacts_ = 0;
  const Dense* W_ = nullptr;
  double steepest_ = 0.0;  // largest eigenvalue of W [1/kg], or a bound of it where its system is large
  Dense reduced_;
  Vector shifted_, ahead_, gradient_, new_, work_;
};

}  // namespace shipcollision
