// What a symmetric matrix, and the rows of any matrix, are made of.
#pragma once

#include "dense.hpp"

namespace shipcollision {

// The largest eigenvalue of a symmetric matrix, which is changed. work: three numbers for each row.
double find_largest_eigenvalue(Dense& A, double* work);

// Makes of the rows of a matrix orthonormal ones, which come first and span what they spanned, and returns how many they
// are. Rows count as dependent when no more than the share `least` of the longest is left of them (Gram and Schmidt, the
// longest first).
int orthonormalise_rows(Dense& A, double least);

}  // namespace shipcollision
