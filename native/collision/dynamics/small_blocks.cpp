#include "small_blocks.hpp"

namespace shipcollision {

namespace {

void swap(double* p, double* q, int n) {
  for (int i = 0; i < n; ++i) {
    const double kept = p[i];
    p[i] = q[i];
    q[i] = kept;
  }
}

int find_pivot(const Dense& A, int column) {
  int pivot = column;
  for (int i = column + 1; i < A.rows(); ++i) {
    if (abs(A[i][column]) > abs(A[pivot][column])) pivot = i;
  }
  return pivot;
}

}  // namespace

bool solve_system(Dense& A, double* b) {
  const int n = A.rows();
  for (int k = 0; k < n; ++k) {
    const int pivot = find_pivot(A, k);
    if (A[pivot][k] == 0.0) return false;
    if (pivot != k) {
      swap(A[k] + k, A[pivot] + k, n - k);
      swap(b + k, b + pivot, 1);
    }
    const double* top = A[k];
    for (int i = k + 1; i < n; ++i) {
      double* row = A[i];
      if (row[k] == 0.0) continue;
      const double factor = row[k] / top[k];
      for (int j = k + 1; j < n; ++j) row[j] -= factor * top[j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) b[k] = (b[k] - dot(A[k] + k + 1, b + k + 1, n - k - 1)) / A[k][k];
  return true;
}

}  // namespace shipcollision
