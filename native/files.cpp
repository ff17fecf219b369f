#include "files.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wide_path.hpp"

namespace shipcollision {

namespace {

#if defined(_WIN32)

FILE* open(const char* path) {
  wchar_t wide[LONGEST_PATH + 1];
  return widen(path, wide) ? _wfopen(wide, L"rb") : nullptr;
}

#else

FILE* open(const char* path) { return fopen(path, "rb"); }

#endif

// Reads until the end or one byte beyond the limit; the file's stated size is not trusted.
bool read_all(FILE* file, size_t limit, char*& bytes, size_t& size) {
  size_t capacity = 0;
  for (;;) {
    if (size == capacity) {
      capacity = capacity == 0 ? 65536 : 2 * capacity;
      if (capacity > limit + 1) capacity = limit + 1;
      char* larger = static_cast<char*>(realloc(bytes, capacity + 1));
      if (larger == nullptr) return false;
      bytes = larger;
    }
    const size_t got = fread(bytes + size, 1, capacity - size, file);
    size += got;
    if (size > limit) return true;
    if (got == 0) break;
  }
  bytes[size] = '\0';
  return !ferror(file);
}

}  // namespace

FileContent::~FileContent() { free(bytes_); }

bool FileContent::read(const char* path, size_t limit, Text& why) {
  FILE* file = open(path);
  if (file == nullptr) {
    why << path << " cannot be opened: it is missing, or may not be read";
    return false;
  }
  size_ = 0;
  const bool is_read = read_all(file, limit, bytes_, size_);
  fclose(file);
  if (!is_read) {
    why << path << " cannot be read: it is not a file";
    return false;
  }
  if (size_ > limit) {
    why << path << " is longer than " << static_cast<long long>(limit) << " bytes: it is not what it should be";
    return false;
  }
  return true;
}

}  // namespace shipcollision
