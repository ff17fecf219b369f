// Matrices of a size set at run time, by rows. They keep their memory as lists do, and sums have one order.
#pragma once

#include "buffer.hpp"
#include "elementary.hpp"

namespace shipcollision {

using Vector = Buffer<double>;

class Dense {
 public:
  explicit Dense(Memory& memory) : entries_(memory) {}

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double* operator[](int i) { return entries_.data() + static_cast<size_t>(i) * static_cast<size_t>(columns_); }
  const double* operator[](int i) const {
    return entries_.data() + static_cast<size_t>(i) * static_cast<size_t>(columns_);
  }

  // To that size, with entries of any value. False without memory; the matrix is then as it was.
  bool resize(int rows, int columns) {
    const long long size = static_cast<long long>(rows) * columns;
    const int entries = size > __INT_MAX__ ? __INT_MAX__ : static_cast<int>(size);
    if (!entries_.reserve(FIRST_ROOM) || !entries_.resize(entries)) return false;
    rows_ = rows;
    columns_ = columns;
    return true;
  }
  void clear() {
    const size_t size = static_cast<size_t>(entries_.size());
    if (size > 0) memset(entries_.data(), 0, size * sizeof(double));
  }
  bool copy(const Dense& other) {
    if (!resize(other.rows_, other.columns_)) return false;
    const size_t size = static_cast<size_t>(entries_.size());
    if (size > 0) memcpy(entries_.data(), other.entries_.data(), size * sizeof(double));
    return true;
  }

 private:
  static constexpr int FIRST_ROOM = 24 * 24;  // eight contacts

  Vector entries_;
  int rows_ = 0, columns_ = 0;
};

// p'q of n numbers, in four sums that run beside each other.
inline double dot(const double* p, const double* q, int n) {
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
  int i = 0;
  for (; i + 3 < n; i += 4) {
    a += p[i] * q[i];
    b += p[i + 1] * q[i + 1];
    c += p[i + 2] * q[i + 2];
    d += p[i + 3] * q[i + 3];
  }
  for (; i < n; ++i) a += p[i] * q[i];
  return (a + c) + (b + d);
}

inline double largest_size(const double* numbers, int n) {
  double largest = 0.0;
  for (int i = 0; i < n; ++i) largest = max(largest, abs(numbers[i]));
  return largest;
}

inline bool are_finite(const double* numbers, int n) {
  for (int i = 0; i < n; ++i) {
    if (!isfinite(numbers[i])) return false;
  }
  return true;
}

inline void copy_numbers(double* into, const double* from, int n) {
  if (n > 0) memcpy(into, from, static_cast<size_t>(n) * sizeof(double));
}
inline void fill_zeros(double* numbers, int n) {
  if (n > 0) memset(numbers, 0, static_cast<size_t>(n) * sizeof(double));
}

}  // namespace shipcollision
