// What a symmetric matrix, and the rows of any matrix, are made of.
#pragma once

#include "dense.hpp"

namespace shipcollision {

// The largest eigenvalue of a symmetric matrix, which is changed. work: three numbers for each row.
double find_largest_eigenvalue(Dense& A, double* work);

// Turns the rows of a matrix among each other until they are orthogonal (one-sided Jacobi): their lengths are then the
// singular values of the matrix, in any order, and the rows span what they spanned.
void orthogonalise_rows(Dense& A);

}  // namespace shipcollision
