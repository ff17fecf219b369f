#include "text.hpp"

#include "decimal.hpp"

namespace shipcollision {
namespace {

constexpr int FEWEST_BELOW = -4;  // Python writes 0.0001 and 1e-05
constexpr int MOST_BEFORE = 16;   // and 1e+15 as 1000000000000000.0, 1e+16 as 1e+16

bool is_continuation(char character) { return (character & 0xc0) == 0x80; }

}  // namespace

void Text::clear() {
  size_ = 0;
  is_full_ = false;
  characters_[0] = '\0';
}

void Text::put(char character) {
  if (is_full_) return;
  if (size_ < CAPACITY) {
    characters_[size_++] = character;
  } else {
    is_full_ = true;
    if (is_continuation(character)) {  // the character that it belongs to is left out
      while (is_continuation(characters_[size_ - 1])) --size_;
      --size_;
    }
  }
  characters_[size_] = '\0';
}

Text& Text::operator<<(const char* words) {
  while (*words != '\0') put(*words++);
  return *this;
}

Text& Text::operator<<(long long number) {
  char digits[20];
  int count = 0;
  unsigned long long rest = static_cast<unsigned long long>(number);
  if (number < 0) {
    put('-');
    rest = 0 - rest;
  }
  do {
    digits[count++] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest != 0);
  while (count > 0) put(digits[--count]);
  return *this;
}

Text& Text::operator<<(double number) {
  if (!put_special(number)) put_decimal(find_shortest_decimal(number), MOST_BEFORE, true);
  return *this;
}

Text& Text::short_number(double number, int digits) {
  if (!put_special(number)) put_decimal(round_to_decimal(number, digits), digits, false);
  return *this;
}

// The sign, and all of a number that is not finite.
bool Text::put_special(double number) {
  if (number != number) {
    *this << "nan";
    return true;
  }
  if (__builtin_signbit(number)) put('-');
  if (__builtin_isfinite(number)) return false;
  *this << "inf";
  return true;
}

void Text::put_decimal(const Decimal& decimal, int most_before, bool is_real) {
  const int count = decimal.count, point = count == 0 ? 1 : decimal.point;
  if (point <= FEWEST_BELOW || point > most_before) {
    put(decimal.digits[0]);
    if (count > 1) *this << "." << decimal.digits + 1;
    const int exponent = point - 1, size = exponent < 0 ? -exponent : exponent;
    *this << (exponent < 0 ? "e-" : "e+") << (size < 10 ? "0" : "") << size;
    return;
  }
  if (point <= 0) put('0');
  for (int i = 0; i < point; ++i) put(i < count ? decimal.digits[i] : '0');
  if (count > point) {
    put('.');
    for (int i = point; i < 0; ++i) put('0');
    *this << decimal.digits + (point > 0 ? point : 0);
  } else if (is_real) {
    *this << ".0";
  }
}

Text& Text::list(const double* numbers, size_t count) {
  put('[');
  for (size_t i = 0; i < count; ++i) *this << (i == 0 ? "" : ", ") << numbers[i];
  put(']');
  return *this;
}

Text& Text::quote(const char* words) {
  static const char hexadecimal[] = "0123456789abcdef";
  bool has_single = false, has_double = false;
  for (const char* c = words; *c != '\0'; ++c) {
    has_single = has_single || *c == '\'';
    has_double = has_double || *c == '"';
  }
  const char mark = has_single && !has_double ? '"' : '\'';
  put(mark);
  for (const char* c = words; *c != '\0'; ++c) {
    if (*c == mark || *c == '\\') {
      put('\\');
      put(*c);
    } else if (*c == '\n' || *c == '\r' || *c == '\t') {
      *this << (*c == '\n' ? "\\n" : *c == '\r' ? "\\r" : "\\t");
    } else if (static_cast<unsigned char>(*c) < 0x20 || *c == 0x7f) {
      *this << "\\x";
      put(hexadecimal[*c >> 4]);
      put(hexadecimal[*c & 15]);
    } else {
      put(*c);
    }
  }
  put(mark);
  return *this;
}

}  // namespace shipcollision
