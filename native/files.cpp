#include "files.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

namespace shipcollision {

namespace {

#if defined(_WIN32)

constexpr size_t LONGEST_PATH = 4096;
constexpr size_t LONGEST_SHORT_PATH = 240;  // longer paths need a prefix, which switches off the old limit of 260

// UTF-8 as UTF-16; false for what is no UTF-8, and for a path that is too long.
bool widen(const char* path, wchar_t* wide) {
  const unsigned char* next = reinterpret_cast<const unsigned char*>(path);
  size_t size = 0;
  const bool is_long = strlen(path) > LONGEST_SHORT_PATH && path[0] != '\0' && path[1] == ':';
  if (is_long) {
    for (const char* prefix = "\\\\?\\"; *prefix != '\0'; prefix++) wide[size++] = static_cast<wchar_t>(*prefix);
  }
  while (*next) {
    unsigned code = *next++;
    const int more = code < 0x80 ? 0 : code < 0xC2 ? -1 : code < 0xE0 ? 1 : code < 0xF0 ? 2 : code < 0xF5 ? 3 : -1;
    if (more < 0 || size + 3 > LONGEST_PATH) return false;
    code &= more == 0 ? 0x7F : 0x3F >> more;
    for (int i = 0; i < more; i++) {
      if ((*next & 0xC0) != 0x80) return false;
      code = code << 6 | (*next++ & 0x3F);
    }
    if (is_long && code == '/') code = '\\';
    if (code >= 0x10000) {
      wide[size++] = static_cast<wchar_t>(0xD800 + ((code - 0x10000) >> 10));
      code = 0xDC00 + ((code - 0x10000) & 0x3FF);
    }
    wide[size++] = static_cast<wchar_t>(code);
  }
  wide[size] = L'\0';
  return true;
}

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
