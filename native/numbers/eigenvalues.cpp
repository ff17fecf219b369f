#include "eigenvalues.hpp"

namespace shipcollision {

namespace {

constexpr double ROUNDING = 0x1p-53;

// Householder's reduction to a matrix with a diagonal and one beside it. reflected: room for a row.
void make_tridiagonal(Dense& A, double* diagonal, double* beside, double* reflected) {
  const int n = A.rows();
  for (int k = 0; k + 2 < n; ++k) {
    double* u = A[k];  // the row, and by symmetry the column, that is reflected to one entry
    const double largest = largest_size(u + k + 1, n - k - 1);
    beside[k] = u[k + 1];
    if (largest_size(u + k + 2, n - k - 2) <= 0.0) continue;
    for (int i = k + 1; i < n; ++i) u[i] /= largest;
    const double size = copysign(sqrt(dot(u + k + 1, u + k + 1, n - k - 1)), u[k + 1]);
    u[k + 1] += size;
    const double half = size * u[k + 1];  // u'u / 2
    beside[k] = -size * largest;
    double along = 0.0;
    for (int i = k + 1; i < n; ++i) {
      reflected[i] = dot(A[i] + k + 1, u + k + 1, n - k - 1) / half;
      along += reflected[i] * u[i];
    }
    along /= 2.0 * half;
    for (int i = k + 1; i < n; ++i) reflected[i] -= along * u[i];
    for (int i = k + 1; i < n; ++i) {
      double* row = A[i];
      for (int j = k + 1; j < n; ++j) row[j] -= u[i] * reflected[j] + reflected[i] * u[j];
    }
  }
  if (n > 1) beside[n - 2] = A[n - 2][n - 1];
  for (int i = 0; i < n; ++i) diagonal[i] = A[i][i];
}

// Whether an eigenvalue is larger than x (Sturm).
bool is_exceeded(const double* diagonal, const double* beside, int n, double x, double least) {
  double pivot = x - diagonal[0];
  for (int i = 1; i < n; ++i) {
    if (pivot < 0.0) return true;
    pivot = x - diagonal[i] - beside[i - 1] * beside[i - 1] / max(pivot, least);
  }
  return pivot < 0.0;
}

void exchange(double& p, double& q) {
  const double kept = p;
  p = q;
  q = kept;
}

// Takes off a row what it has along a unit row.
void take_off(double* row, const double* unit, int columns) {
  const double along = dot(row, unit, columns);
  for (int j = 0; j < columns; ++j) row[j] -= along * unit[j];
}

}  // namespace

double find_largest_eigenvalue(Dense& A, double* work) {
  const int n = A.rows();
  if (n == 0) return 0.0;
  double *diagonal = work, *beside = work + n;
  make_tridiagonal(A, diagonal, beside, work + 2 * n);
  double low = diagonal[0], high = -INFINITE, scale = 0.0;
  for (int i = 0; i < n; ++i) {
    const double reach = (i > 0 ? abs(beside[i - 1]) : 0.0) + (i + 1 < n ? abs(beside[i]) : 0.0);
    low = max(low, diagonal[i]);
    high = max(high, diagonal[i] + reach);
    scale = max(scale, abs(diagonal[i]) + reach);
  }
  while (high - low > 2.0 * ROUNDING * scale) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    if (is_exceeded(diagonal, beside, n, middle, ROUNDING * ROUNDING * scale)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return high;
}

int orthonormalise_rows(Dense& A, double least) {
  const int n = A.rows(), columns = A.columns();
  double limit = 0.0;
  for (int k = 0; k < n; ++k) {
    int longest = k;
    double square = dot(A[k], A[k], columns);
    for (int i = k + 1; i < n; ++i) {
      const double other = dot(A[i], A[i], columns);
      if (!(other > square)) continue;
      longest = i;
      square = other;
    }
    double* row = A[k];
    for (int j = 0; j < columns && longest != k; ++j) exchange(row[j], A[longest][j]);
    for (int i = 0; i < k; ++i) take_off(row, A[i], columns);  // once more, of what rounding left
    const double size = sqrt(dot(row, row, columns));
    if (k == 0) limit = least * size;
    if (!(size > limit)) return k;
    for (int j = 0; j < columns; ++j) row[j] /= size;
    for (int i = k + 1; i < n; ++i) take_off(A[i], row, columns);
  }
  return n;
}

}  // namespace shipcollision
