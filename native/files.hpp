// Reading of whole files by their path in UTF-8, on Windows as well.
#pragma once

#include <stddef.h>

#include "numbers/text.hpp"

namespace shipcollision {

// The bytes of a file, and a zero after the last of them.
class FileContent {
 public:
  FileContent() = default;
  ~FileContent();
  FileContent(const FileContent&) = delete;
  FileContent& operator=(const FileContent&) = delete;

  // Reads the file; false for one that is missing, no file (a folder, a pipe), or longer than `limit` bytes. Never waits.
  bool read(const char* path, size_t limit, Text& why);

  char* data() { return bytes_; }
  size_t size() const { return size_; }

 private:
  char* bytes_ = nullptr;
  size_t size_ = 0;
};

// Whether the first line ends in CR: the writers end each line with LF alone.
bool has_other_line_ends(const char* content);

}  // namespace shipcollision
