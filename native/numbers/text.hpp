// A line of text of bounded length, for messages: no memory is allocated and no locale asked. It is UTF-8 always, as FMI
// asks of what is logged: a byte that belongs to no character, as in a path of Linux, is written as \xNN.
#pragma once

#include <stddef.h>

namespace shipcollision {

struct Decimal;

constexpr size_t LONGEST_STRING = 4096;  // bytes of a String variable, its end included: the longest path of Linux

// Of what is longer than the capacity the middle is left out, whole characters, with "..." in its place: a refusal has
// its remedy at the end.
class Text {
 public:
  static constexpr size_t CAPACITY = 2000;

  Text() { clear(); }

  void clear();
  bool is_empty() const { return size_ == 0; }
  const char* get() const { return characters_; }
  size_t size() const { return size_; }

  Text& operator<<(const char* words);  // bytes that are no character, and control characters, in hexadecimal digits
  void end_line() { put('\n'); }
  Text& operator<<(const Text& other) { return *this << other.get(); }
  Text& operator<<(int number) { return *this << static_cast<long long>(number); }
  Text& operator<<(long long number);
  Text& operator<<(double number);                         // as Python's repr: the shortest that reads back the same
  Text& short_number(double number, int digits = 6);       // as Python's format 'g'
  Text& fixed_number(double number, int decimals);         // as Python's format 'f'
  Text& list(const double* numbers, size_t count);         // as Python's repr of a list
  Text& quote(const char* words);                          // as Python's repr of a string, in single quotes

 private:
  void put(char character) { put(&character, 1); }
  void put(const char* character, size_t size);
  void put_character(const char*& next);
  void put_byte(char byte);
  void make_room(size_t size);
  bool put_special(double number);
  void put_decimal(const Decimal& decimal, int most_before, bool is_real);

  char characters_[CAPACITY + 1];
  size_t size_;
  size_t kept_;  // bytes before the gap; 0: nothing is left out
};

}  // namespace shipcollision
