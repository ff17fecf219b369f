// Decimal digits of a double, exact, without a locale or libc.
#pragma once

namespace shipcollision {

constexpr int MOST_DIGITS = 17;

// 0.d_1 d_2 ... d_count times 10^point, d_1 and d_count not zero; of zero no digit is left.
struct Decimal {
  char digits[MOST_DIGITS + 1];
  int count;
  int point;
};

// The shortest digits that read back as x, and of these the nearest to it. x: finite, its sign is left out.
Decimal find_shortest_decimal(double x);
// x rounded half to even to at most MOST_DIGITS digits.
Decimal round_to_decimal(double x, int digits);

}  // namespace shipcollision
