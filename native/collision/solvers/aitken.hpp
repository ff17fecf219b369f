// Aitken's extrapolation: the twin of shipcollision_fmu/collision/solvers/aitken.py.
#pragma once

#include "../../numbers/dense.hpp"

namespace shipcollision {

constexpr double MAX_RATIO = 0.98;

// The steps of one sequence of Gauss-Seidel sweeps.
class Aitken {
 public:
  explicit Aitken(Memory& memory) : step_(memory) {}

  // False without memory. Begins a sequence of `size` impulses.
  bool start(int size) {
    has_step_ = false;
    return step_.resize(size);
  }
  // Moves the impulses P after a sweep, `last` before it, to those from which the next sweep starts.
  void extrapolate(double* P, const double* last) {
    const bool has_before = has_step_;
    const int size = step_.size();
    double square = 0.0, product = 0.0;
    for (int i = 0; i < size; ++i) {
      const double before = step_[i], now = P[i] - last[i];
      if (has_before) {
        square += before * before;
        product += now * before;
      }
      step_[i] = now;
    }
    has_step_ = !(0.0 < product && product < MAX_RATIO * square);
    if (has_step_) return;
    const double ratio = product / square, factor = ratio / (1.0 - ratio);
    for (int i = 0; i < size; ++i) P[i] += factor * step_[i];
  }

 private:
  Vector step_;
  bool has_step_ = false;
};

}  // namespace shipcollision
