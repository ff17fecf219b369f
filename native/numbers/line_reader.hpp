// Fields of a text file line by line: words, whole numbers, exact reals and quoted text, parted by single spaces.
#pragma once

#include <stddef.h>

namespace shipcollision {

// Reads a text that ends with a zero, which it changes: quoted text is decoded in place. Every call but next_line()
// reads one field of the present line; where the line has another one there, it answers false and reads nothing.
class LineReader {
 public:
  LineReader(char* text, size_t size) : next_(text), end_(text + size) {}

  // Goes to the next line; false at the end of the text. Counts from 1.
  bool next_line();
  int line() const { return line_; }
  bool is_end_of_line() const { return next_ == line_end_; }

  bool word(const char* expected);
  // Position of the word in a list of `count` words.
  bool one_of(const char* const* words, size_t count, size_t& found);
  bool whole(long long& number);
  // As float.hex() writes it: the same bits.
  bool real(double& number);
  // In double quotes, in place; never with a zero inside.
  bool text(const char*& text);

 private:
  size_t field_size() const;
  bool take(size_t size);

  char* next_;
  char* end_;
  char* line_end_ = nullptr;
  int line_ = 0;
};

}  // namespace shipcollision
