// What a symmetric matrix, and the rows of any matrix, are made of.
#pragma once

#include "dense.hpp"

namespace shipcollision {

// The largest eigenvalue of a symmetric matrix, which is changed. work: three numbers for each row.
double find_largest_eigenvalue(Dense& A, double* work);

// Makes of the rows of a matrix orthonormal ones, which come first and span what they spanned; returns how many they
// are. A row of which no more than the share `least` of the longest is left depends on the others (Gram and Schmidt,
// the longest first).
int orthonormalise_rows(Dense& A, double least);

}  // namespace shipcollision
