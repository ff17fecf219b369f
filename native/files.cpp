#include "files.hpp"

#include <stdlib.h>
#include <string.h>

#include "wide_path.hpp"

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#else
#include <errno.h>
#include <fcntl.h>
#include <unistd.h>
#endif

namespace shipcollision {

namespace {

constexpr size_t LARGEST_READ = size_t{1} << 20;  // bytes at once: Windows takes an int

#if defined(_WIN32)

int open_file(const char* path) {
  wchar_t wide[LONGEST_PATH + 1];
  return widen(path, wide) ? _wopen(wide, _O_RDONLY | _O_BINARY | _O_NOINHERIT) : -1;
}

bool is_on_disk(int file) {
  struct _stat64 status;
  return _fstat64(file, &status) == 0 && (status.st_mode & _S_IFMT) == _S_IFREG;
}

long long read_some(int file, char* bytes, size_t size) { return _read(file, bytes, static_cast<unsigned>(size)); }

void close_file(int file) { _close(file); }

#else

// Of a pipe that nobody writes to, the opening would not end, and the reading of a terminal would not either.
int open_file(const char* path) { return open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC); }

// What has no place to read from is a pipe, a socket or a terminal.
bool is_on_disk(int file) { return lseek(file, 0, SEEK_CUR) == 0; }

long long read_some(int file, char* bytes, size_t size) {
  for (;;) {
    const ssize_t got = read(file, bytes, size);
    if (got >= 0 || errno != EINTR) return got;
  }
}

void close_file(int file) { close(file); }

#endif

// Reads until the end or one byte beyond the limit; the file's stated size is not trusted.
bool read_all(int file, size_t limit, char*& bytes, size_t& size) {
  size_t capacity = 0;
  while (size <= limit) {
    if (size == capacity) {
      capacity = capacity == 0 ? 65536 : 2 * capacity;
      if (capacity > limit + 1) capacity = limit + 1;
      char* larger = static_cast<char*>(realloc(bytes, capacity + 1));
      if (larger == nullptr) return false;
      bytes = larger;
    }
    const size_t left = capacity - size;
    const long long got = read_some(file, bytes + size, left < LARGEST_READ ? left : LARGEST_READ);
    if (got < 0) return false;
    if (got == 0) break;
    size += static_cast<size_t>(got);
  }
  bytes[size] = '\0';
  return true;
}

}  // namespace

bool has_other_line_ends(const char* content) { return content[strcspn(content, "\r\n")] == '\r'; }

FileContent::~FileContent() { free(bytes_); }

bool FileContent::read(const char* path, size_t limit, Text& why) {
  const int file = open_file(path);
  if (file < 0) {
    why << path << " cannot be opened: it is missing, or may not be read";
    return false;
  }
  size_ = 0;
  const bool is_read = is_on_disk(file) && read_all(file, limit, bytes_, size_);
  close_file(file);
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
