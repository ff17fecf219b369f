#include "hexadecimal.hpp"

#include <stdint.h>

namespace shipcollision {
namespace {

constexpr int DIGITS = 13;  // after the point: 52 bits

int read_digit(char character) {
  if (character >= '0' && character <= '9') return character - '0';
  if (character >= 'a' && character <= 'f') return character - 'a' + 10;
  return -1;
}

// The digits after the point, as an integer of 52 bits.
bool read_fraction(const char*& at, uint64_t& fraction) {
  fraction = 0;
  if (*at != '.') return true;
  ++at;
  int count = 0;
  for (int digit; (digit = read_digit(*at)) >= 0; ++at, ++count) {
    if (count == DIGITS) return false;
    fraction = fraction << 4 | static_cast<uint64_t>(digit);
  }
  fraction <<= 4 * (DIGITS - count);
  return count > 0;
}

bool read_exponent(const char*& at, int& exponent) {
  if (*at++ != 'p') return false;
  const bool is_negative = *at == '-';
  if (*at != '-' && *at != '+') return false;
  ++at;
  const char* begin = at;
  exponent = 0;
  for (; *at >= '0' && *at <= '9' && at - begin < 4; ++at) exponent = 10 * exponent + (*at - '0');
  if (is_negative) exponent = -exponent;
  return at != begin;
}

}  // namespace

bool read_hexadecimal(const char*& text, double& number) {
  const char* at = text;
  const bool is_negative = *at == '-';
  if (is_negative) ++at;
  if (at[0] != '0' || at[1] != 'x' || (at[2] != '0' && at[2] != '1')) return false;
  const bool is_normal = at[2] == '1';
  at += 3;
  uint64_t fraction;
  int exponent;
  if (!read_fraction(at, fraction) || !read_exponent(at, exponent)) return false;
  const bool is_zero = !is_normal && fraction == 0;
  if (is_normal ? exponent < -1022 || exponent > 1023 : !is_zero && exponent != -1022) return false;
  uint64_t bits = fraction | static_cast<uint64_t>(is_negative) << 63;
  if (is_normal) bits |= static_cast<uint64_t>(exponent + 1023) << 52;
  __builtin_memcpy(&number, &bits, sizeof number);
  text = at;
  return true;
}

}  // namespace shipcollision
