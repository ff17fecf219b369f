#include "line_reader.hpp"

#include <string.h>

#include "hexadecimal.hpp"

namespace shipcollision {

namespace {

// The number, or false where it is not all decimal digits, or beyond `limit`.
bool read_digits(const char* text, size_t size, long long limit, long long& number) {
  if (size == 0) return false;
  number = 0;
  for (size_t i = 0; i < size; i++) {
    if (text[i] < '0' || text[i] > '9') return false;
    number = 10 * number + (text[i] - '0');
    if (number > limit) return false;
  }
  return true;
}

char unescape(char character) {
  switch (character) {
    case 'n': return '\n';
    case 'r': return '\r';
    case 't': return '\t';
    case '\\':
    case '"': return character;
    default: return '\0';
  }
}

}  // namespace

bool LineReader::next_line() {
  if (line_end_ != nullptr) next_ = line_end_ < end_ ? line_end_ + 1 : end_;
  if (next_ == end_) return false;
  void* found = memchr(next_, '\n', static_cast<size_t>(end_ - next_));
  line_end_ = found == nullptr ? end_ : static_cast<char*>(found);
  line_++;
  return true;
}

size_t LineReader::field_size() const {
  size_t size = 0;
  while (next_ + size < line_end_ && next_[size] != ' ') size++;
  return size;
}

bool LineReader::take(size_t size) {
  next_ += size;
  if (next_ < line_end_) next_++;
  return true;
}

bool LineReader::word(const char* expected) {
  size_t found;
  return one_of(&expected, 1, found);
}

bool LineReader::one_of(const char* const* words, size_t count, size_t& found) {
  const size_t size = field_size();
  for (size_t i = 0; i < count; i++) {
    if (strlen(words[i]) == size && memcmp(words[i], next_, size) == 0) {
      found = i;
      return take(size);
    }
  }
  return false;
}

bool LineReader::whole(long long& number) {
  const size_t size = field_size();
  const size_t sign = size > 0 && next_[0] == '-' ? 1 : 0;
  long long read;
  if (!read_digits(next_ + sign, size - sign, 1LL << 53, read)) return false;
  number = sign ? -read : read;
  return take(size);
}

bool LineReader::real(double& number) {
  const size_t size = field_size();
  const size_t sign = size > 0 && next_[0] == '-' ? 1 : 0;
  const char* text = next_;
  if (size - sign == 3 && memcmp(text + sign, "inf", 3) == 0) {
    number = sign ? -__builtin_inf() : __builtin_inf();
  } else if (size == 3 && memcmp(text, "nan", 3) == 0) {
    number = __builtin_nan("");
  } else if (!read_hexadecimal(text, number) || text != next_ + size) {
    return false;
  }
  return take(size);
}

bool LineReader::text(const char*& text) {
  if (next_ == line_end_ || *next_ != '"') return false;
  // Two passes, so that nothing is changed where the text is not right.
  const char* from = next_ + 1;
  while (from < line_end_ && *from != '"') {
    if (*from == '\0' || (*from == '\\' && (from + 1 == line_end_ || unescape(from[1]) == '\0'))) return false;
    from += *from == '\\' ? 2 : 1;
  }
  if (from >= line_end_ || (from + 1 < line_end_ && from[1] != ' ')) return false;
  text = next_ + 1;
  char* into = next_ + 1;
  const char* close = from;
  for (from = next_ + 1; from < close; from++) {
    if (*from == '\\') from++, *into++ = unescape(*from);
    else *into++ = *from;
  }
  *into = '\0';
  return take(static_cast<size_t>(close + 1 - next_));
}

}  // namespace shipcollision
