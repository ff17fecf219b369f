// All contacts at once by a nonsmooth Newton method: the twin of shipcollision_fmu/collision/solvers/alart_curnier.py.
#pragma once

#include "../../numbers/dense.hpp"
#include "work_limit.hpp"

namespace shipcollision {

class AlartCurnier {
 public:
  explicit AlartCurnier(Memory& memory);

  // Room for so many contacts; false without memory.
  bool reserve(int contacts);

  // Turns the guess P (3k) [N s] into impulses with a residual of at most `tolerance` [m/s], or the best that were found.
  void solve(const Dense& W, const double* v, double mu, double* P, double tolerance, WorkLimit& work);

 private:
  // The equations of a contact at given impulses.
  struct Equation {
    bool touches, slides;
    int place;  // among the contacts that touch
    double unit[2], share;
  };

  bool solve_newton(double mu, double tolerance, WorkLimit& work, int steps);
  void evaluate_equations(const double* P, double mu);
  bool find_step(double mu);
  void add_sliding(const Equation& equation, int contact, double mu);

  int contacts_ = 0;
  int closed_ = 0, sliding_ = 0;  // how many
  Dense weighted_, slope_;
  Vector D_, shifted_, rho_, P_, best_on_way_, inside_, best_, after_, error_, step_, right_;
  Buffer<Equation> equations_;
};

}  // namespace shipcollision
