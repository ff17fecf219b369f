// The lines of prepared files: reads what shipcollision_fmu/ship/prepared_lines.py writes.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "../files.hpp"
#include "../memory.hpp"
#include "../numbers/line_reader.hpp"
#include "../numbers/text.hpp"
#include "hull/solid.hpp"

namespace shipcollision {

// A kind of prepared file, and words for its messages.
struct PreparedKind {
  const char* format;    // begin of the first line, up to the version
  const char* version;   // which is read
  const char* name;      // what the file is
  const char* argument;  // of `shipcollision prepare`
  const char* what;      // is prepared
};

bool is_absolute(const char* path);
// Reads FOLDER/NAME SUFFIX; false for one that cannot be read, or whose path is too long.
bool read_below(const char* folder, const char* name, const char* suffix, FileContent& content);
// Reads the file of a path; a relative one is looked for in `directory`, then in the current folder.
bool read_prepared_file(const char* path, const char* directory, FileContent& content);

// Whether there is a folder, and no file, where read_prepared_file() looks.
bool is_prepared_folder(const char* path, const char* directory);

// Whether a file is of that kind and version, and as it was written. It ends with a zero after `size` bytes. checksum:
// that of its content.
bool check_prepared(const PreparedKind& kind, const char* content, size_t size, const char* file, uint32_t& checksum,
                    Text& why);

// Reads line by line what was written; after a line that is not as expected, nothing more. The content is changed.
class PreparedLines : public OnHeap {
 public:
  // content: a whole file that was checked.
  PreparedLines(char* content, size_t size);

  // False, and why, after a line that was not as expected.
  bool check(const PreparedKind& kind, const char* file, Text& why) const;
  bool is_good() const { return expected_ == nullptr; }
  void refuse(const char* key) { expected_ = key; }

  void read_text(const char* key, Text& text) {
    if (begin(key) && !take_text(text)) refuse(key);
  }

  // A whole number from 0 to `most`; 0 where it is not.
  int read_count(const char* key, long long most);

  template <typename Numbers>
  void read(const char* key, Numbers& numbers) {
    if (begin(key) && !(take_numbers(numbers) && reader_.is_end_of_line())) refuse(key);
  }

  // The same of what need not be there: its numbers, `none`, or `refused` and a text where there is room for one.
  template <typename Numbers>
  bool read_if_there(const char* key, Numbers& numbers, Text* refusal = nullptr) {
    if (!begin(key)) return false;
    if (reader_.word("none")) {
      if (!reader_.is_end_of_line()) refuse(key);
      return false;
    }
    if (refusal != nullptr && reader_.word("refused")) {
      if (!take_text(*refusal) || refusal->is_empty()) refuse(key);
      return false;
    }
    const bool is_read = take_numbers(numbers) && reader_.is_end_of_line();
    if (!is_read) refuse(key);
    return is_read;
  }

  // The parts of a hull, or why there is none where there is room for that.
  void read_hull(HullMesh& hull, Text* refusal = nullptr);

 private:
  // Goes to the first value of the next line, which must have this key.
  bool begin(const char* key);
  bool take_text(Text& text);
  void read_parts(int count, HullMesh& hull);

  template <typename Numbers>
  bool take_numbers(Numbers& numbers) {
    static_assert(sizeof numbers % sizeof(double) == 0, "real numbers alone");
    char* into = reinterpret_cast<char*>(&numbers);
    for (size_t i = 0; i < sizeof numbers; i += sizeof(double)) {
      double number;
      if (!take_real(number)) return false;
      memcpy(into + i, &number, sizeof number);
    }
    return true;
  }
  bool take_real(double& number);

  LineReader reader_;
  int number_ = 1;
  const char* expected_ = nullptr;  // the key of the line that is wrong
};

}  // namespace shipcollision
