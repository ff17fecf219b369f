// Elementary functions made of + - * / sqrt and floor alone: every platform gives the same bits, which no libm does.
#pragma once

namespace shipcollision {

constexpr double PI = 3.141592653589793;
constexpr double INFINITE = __builtin_inf();

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double atan(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double hypot(double x, double y);

inline double sqrt(double x) { return __builtin_sqrt(x); }
inline double abs(double x) { return __builtin_fabs(x); }
inline double copysign(double x, double sign) { return __builtin_copysign(x, sign); }
inline bool isfinite(double x) { return __builtin_isfinite(x); }
// Without the compiler's own floor, which calls libm on processors before SSE 4.1.
inline double floor(double x) {
  if (!(abs(x) < 0x1p52)) return x;  // whole, infinite or not a number
  const double whole = static_cast<double>(static_cast<long long>(x));
  return copysign(whole > x ? whole - 1.0 : whole, x);
}
inline double ceil(double x) { return -floor(-x); }
// Python's min, max and round (half to even).
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return b > a ? b : a; }
double round(double x);

}  // namespace shipcollision
