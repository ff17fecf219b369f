// Products and linear systems of many contacts: the twin of shipcollision_fmu/collision/dynamics/small_blocks.py.
//
// One thread computes them here, whatever their size. Hence there are no blocks, and pivots are sought in all rows.
#pragma once

#include "../../numbers/dense.hpp"

namespace shipcollision {

// W x.
inline void multiply(const Dense& W, const double* x, double* product) {
  for (int i = 0; i < W.rows(); ++i) product[i] = dot(W[i], x, W.columns());
}

// Turns b into x with A x = b, and changes A. False for a singular matrix.
bool solve_system(Dense& A, double* b);

}  // namespace shipcollision
