// Digits by exact integer arithmetic, after Steele and White (1990), How to print floating-point numbers accurately.
//
//   x = R/S        M_plus/S, M_minus/S: half the distance to the next double above and below
#include "decimal.hpp"

#include <stdint.h>

namespace shipcollision {
namespace {

constexpr int WORDS = 40;  // 1280 bits: the largest integer here is below 10^324 2^55; fewer bits overflow in silence

class Integer {
 public:
  explicit Integer(uint64_t value = 0) {
    for (uint32_t& word : words_) word = 0;
    words_[0] = static_cast<uint32_t>(value);
    words_[1] = static_cast<uint32_t>(value >> 32);
  }

  void multiply(uint32_t factor) {
    uint64_t carry = 0;
    for (uint32_t& word : words_) {
      carry += static_cast<uint64_t>(word) * factor;
      word = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
  }

  void shift(int bits) {
    const int whole = bits / 32, part = bits % 32;
    for (int i = WORDS - 1; i >= 0; --i) {
      const uint64_t high = i >= whole ? words_[i - whole] : 0, low = i > whole ? words_[i - whole - 1] : 0;
      words_[i] = static_cast<uint32_t>(((high << 32 | low) << part) >> 32);
    }
  }

  void add(const Integer& other) {
    uint64_t carry = 0;
    for (int i = 0; i < WORDS; ++i) {
      carry += static_cast<uint64_t>(words_[i]) + other.words_[i];
      words_[i] = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
  }

  void subtract(const Integer& other) {
    uint64_t borrow = 0;
    for (int i = 0; i < WORDS; ++i) {
      const uint64_t difference = static_cast<uint64_t>(words_[i]) - other.words_[i] - borrow;
      words_[i] = static_cast<uint32_t>(difference);
      borrow = difference >> 63;
    }
  }

  // -1, 0 or 1: less, equal, more.
  int compare(const Integer& other) const {
    for (int i = WORDS - 1; i >= 0; --i) {
      if (words_[i] != other.words_[i]) return words_[i] < other.words_[i] ? -1 : 1;
    }
    return 0;
  }

 private:
  uint32_t words_[WORDS];
};

int compare_sum(Integer a, const Integer& b, const Integer& c) {
  a.add(b);
  return a.compare(c);
}

int compare_double(Integer a, const Integer& b) {
  a.shift(1);
  return a.compare(b);
}

struct Fraction {
  Integer R, S, M_plus, M_minus;
  bool is_even;  // then a decimal in the middle of two doubles reads as this one
  int point;     // at most that of the decimal
};

Fraction take_apart(double x) {
  uint64_t bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  uint64_t mantissa = bits & ((uint64_t{1} << 52) - 1);
  int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  const bool is_narrow_below = mantissa == 0 && exponent > 1;  // the doubles below a power of two are nearer
  if (exponent != 0) {
    mantissa |= uint64_t{1} << 52;
  } else {
    exponent = 1;
  }
  exponent -= 1075;
  const int more = is_narrow_below ? 2 : 1;
  Fraction f{Integer(mantissa), Integer(1), Integer(1), Integer(1), (mantissa & 1) == 0, 0};
  f.R.shift(more + (exponent > 0 ? exponent : 0));
  f.S.shift(more - (exponent < 0 ? exponent : 0));
  f.M_plus.shift(more - 1 + (exponent > 0 ? exponent : 0));
  f.M_minus.shift(exponent > 0 ? exponent : 0);

  int length = 64;
  while (mantissa >> (length - 1) == 0) --length;
  // x >= 2^(length - 1 + exponent); log10(2) is between 30102/100000 and 30103/100000.
  const int power = length - 1 + exponent;
  f.point = power >= 0 ? power * 30102 / 100000 : -(-power * 30103 / 100000) - 1;
  for (int i = 0; i < f.point; ++i) f.S.multiply(10);
  for (int i = 0; i > f.point; --i) {
    f.R.multiply(10);
    f.M_plus.multiply(10);
    f.M_minus.multiply(10);
  }
  return f;
}

// The next digit; R becomes the remainder.
int take_digit(Fraction& f) {
  f.R.multiply(10);
  int digit = 0;
  while (f.R.compare(f.S) >= 0) {
    f.R.subtract(f.S);
    ++digit;
  }
  return digit;
}

void put_digit(Decimal& decimal, int digit) { decimal.digits[decimal.count++] = static_cast<char>('0' + digit); }

void finish(Decimal& decimal) {
  while (decimal.count > 0 && decimal.digits[decimal.count - 1] == '0') --decimal.count;
  decimal.digits[decimal.count] = '\0';
}

void round_up(Decimal& decimal) {
  while (decimal.count > 0 && decimal.digits[decimal.count - 1] == '9') --decimal.count;
  if (decimal.count == 0) {
    put_digit(decimal, 1);
    ++decimal.point;
  } else {
    ++decimal.digits[decimal.count - 1];
  }
}

}  // namespace

Decimal find_shortest_decimal(double x) {
  Decimal decimal{{}, 0, 0};
  x = __builtin_fabs(x);
  if (x == 0.0) return decimal;
  Fraction f = take_apart(x);
  const int touches = f.is_even ? 0 : 1;
  while (compare_sum(f.R, f.M_plus, f.S) >= touches) {
    f.S.multiply(10);
    ++f.point;
  }
  decimal.point = f.point;
  for (;;) {
    int digit = take_digit(f);
    f.M_plus.multiply(10);
    f.M_minus.multiply(10);
    const bool is_low = f.R.compare(f.M_minus) <= -touches, is_high = compare_sum(f.R, f.M_plus, f.S) >= touches;
    if (!is_low && !is_high) {
      put_digit(decimal, digit);
      continue;
    }
    const int half = compare_double(f.R, f.S);
    if (!is_low || (is_high && (half > 0 || (half == 0 && digit % 2 == 1)))) ++digit;
    put_digit(decimal, digit);
    finish(decimal);
    return decimal;
  }
}

Decimal round_to_decimal(double x, int digits) {
  Decimal decimal{{}, 0, 0};
  x = __builtin_fabs(x);
  if (x == 0.0) return decimal;
  Fraction f = take_apart(x);
  while (f.R.compare(f.S) >= 0) {
    f.S.multiply(10);
    ++f.point;
  }
  decimal.point = f.point;
  int digit = 0;
  while (decimal.count < digits) {
    digit = take_digit(f);
    put_digit(decimal, digit);
  }
  const int half = compare_double(f.R, f.S);
  if (half > 0 || (half == 0 && digit % 2 == 1)) round_up(decimal);
  finish(decimal);
  return decimal;
}

}  // namespace shipcollision
