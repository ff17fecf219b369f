#include "text.hpp"

#include "decimal.hpp"

namespace shipcollision {
namespace {

constexpr int FEWEST_BELOW = -4;  // Python writes 0.0001 and 1e-05
constexpr int MOST_BEFORE = 16;   // and 1e+15 as 1000000000000000.0, 1e+16 as 1e+16

constexpr char GAP[] = "...";
constexpr size_t GAP_SIZE = sizeof GAP - 1;
constexpr size_t AT_ONCE = 100;  // bytes that are left out beyond need; fewer make a text of a million bytes slow

bool is_continuation(char character) { return (character & 0xc0) == 0x80; }

// Bytes of the character of UTF-8 at `text`, or 0 where none begins: RFC 3629, section 4. Control characters count as
// none, for a message is one line.
size_t find_size(const char* text) {
  const unsigned char* at = reinterpret_cast<const unsigned char*>(text);
  if (at[0] < 0x80) return at[0] < 0x20 ? 0 : 1;
  const size_t size = at[0] < 0xc2 ? 0 : at[0] < 0xe0 ? 2 : at[0] < 0xf0 ? 3 : at[0] < 0xf5 ? 4 : 0;
  if (size == 0) return 0;
  const unsigned char least = at[0] == 0xe0 ? 0xa0 : at[0] == 0xf0 ? 0x90 : 0x80;  // longer than need be
  const unsigned char most = at[0] == 0xed ? 0x9f : at[0] == 0xf4 ? 0x8f : 0xbf;   // half of UTF-16, or beyond Unicode
  if (at[1] < least || at[1] > most) return 0;
  for (size_t i = 2; i < size; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  return size;
}

}  // namespace

void Text::clear() {
  size_ = 0;
  kept_ = 0;
  characters_[0] = '\0';
}

// A whole character.
void Text::put(const char* character, size_t size) {
  if (size_ + size > CAPACITY) make_room(size);
  for (size_t i = 0; i < size; ++i) characters_[size_++] = character[i];
  characters_[size_] = '\0';
}

// Leaves out whole characters in the middle, so that so many bytes more are within the capacity.
void Text::make_room(size_t size) {
  if (kept_ == 0) {
    kept_ = CAPACITY / 2;
    while (is_continuation(characters_[kept_])) --kept_;
    __builtin_memcpy(characters_ + kept_, GAP, GAP_SIZE);
  }
  char* after = characters_ + kept_ + GAP_SIZE;
  const char* next = after + (size_ + size - CAPACITY) + AT_ONCE;
  while (is_continuation(*next)) ++next;
  while (next < characters_ + size_) *after++ = *next++;
  size_ = static_cast<size_t>(after - characters_);
}

// The character at `next`, or the byte there where none begins, and moves on to what follows it.
void Text::put_character(const char*& next) {
  const size_t size = find_size(next);
  if (size > 0) {
    put(next, size);
    next += size;
    return;
  }
  put_byte(*next++);
}

// A byte in hexadecimal digits.
void Text::put_byte(char byte) {
  static const char hexadecimal[] = "0123456789abcdef";
  put('\\');
  put('x');
  put(hexadecimal[byte >> 4 & 15]);
  put(hexadecimal[byte & 15]);
}

Text& Text::operator<<(const char* words) {
  while (*words != '\0') put_character(words);
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

// A number of 0.d times the last decimal's unit is rounded to one unit or none.
Text& Text::fixed_number(double number, int decimals) {
  if (put_special(number)) return *this;
  Decimal decimal = round_to_decimal(number, MOST_DIGITS);
  const int digits = decimal.point + decimals;
  if (digits == 0 && decimal.count > 0 && (decimal.digits[0] > '5' || (decimal.digits[0] == '5' && decimal.count > 1))) {
    decimal = {"1", 1, decimal.point + 1};
  } else if (digits <= 0) {
    decimal = {"", 0, 0};
  } else if (digits < MOST_DIGITS) {
    decimal = round_to_decimal(number, digits);
  }
  const int point = decimal.count == 0 ? 0 : decimal.point;
  if (point <= 0) put('0');
  for (int i = 0; i < point; ++i) put(i < decimal.count ? decimal.digits[i] : '0');
  if (decimals > 0) put('.');
  for (int i = point; i < point + decimals; ++i) put(i >= 0 && i < decimal.count ? decimal.digits[i] : '0');
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
  bool has_single = false, has_double = false;
  for (const char* c = words; *c != '\0'; ++c) {
    has_single = has_single || *c == '\'';
    has_double = has_double || *c == '"';
  }
  const char mark = has_single && !has_double ? '"' : '\'';
  put(mark);
  while (*words != '\0') {
    const char c = *words;
    if (c == mark || c == '\\') {
      put('\\');
      put(c);
    } else if (c == '\n' || c == '\r' || c == '\t') {
      *this << (c == '\n' ? "\\n" : c == '\r' ? "\\r" : "\\t");
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      put_byte(c);
    } else {
      put_character(words);
      continue;
    }
    ++words;
  }
  put(mark);
  return *this;
}

}  // namespace shipcollision
