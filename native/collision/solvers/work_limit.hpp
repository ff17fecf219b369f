// The bound on the work of a communication step: the twin of shipcollision_fmu/collision/solvers/work_limit.py.
#pragma once

#include "../../numbers/elementary.hpp"

namespace shipcollision {

constexpr double STEP = 0.1;

// Work that one solve may still do [us, nominal].
struct WorkLimit {
  double left = INFINITE;

  bool is_spent() const { return left <= 0.0; }
  void spend_sweep(int contacts) { left -= contacts * (5.0 + 0.05 * contacts); }
  void spend_newton_step(int contacts, int closed) { left -= count_newton_step(contacts, closed); }
  void spend_residual(int contacts) { left -= 20.0 + 0.5 * contacts; }
  void reserve_newton_steps(int steps, int contacts) {
    left = max(left, steps * count_newton_step(contacts, contacts));
  }
  void spend_gradient_step(int contacts) { left -= 30.0 + 0.006 * (1.0 * contacts * contacts); }

 private:
  static double count_newton_step(double contacts, double closed) {
    return 90.0 + 2.0 * contacts + 0.15 * (closed * closed) + 0.001 * (closed * closed * closed);
  }
};

// Work that all solves of a communication step may still do.
class StepWork {
 public:
  explicit StepWork(double left = INFINITE) : left_(left) {}

  // Begins a step of H [s] in which so many ships are near others.
  void renew(int ships, double H);
  // The share of the next solve.
  WorkLimit lend() const;
  // Takes off what the solve has spent.
  void settle(const WorkLimit& lent);

 private:
  double left_;
};

}  // namespace shipcollision
