#include "wide_path.hpp"

#if defined(_WIN32)

#include <stdlib.h>
#include <string.h>
#include <wchar.h>

namespace shipcollision {
namespace {

constexpr size_t LONGEST_SHORT_PATH = 240;  // longer ones need a prefix, which switches off the old limit of 260
constexpr wchar_t VERBATIM[] = L"\\\\?\\";      // with it Windows takes a path as it is: no / and no ..
constexpr wchar_t VERBATIM_SHARE[] = L"\\\\?\\UNC\\";
constexpr wchar_t DEVICE[] = L"\\\\.\\";

bool is_surrogate(unsigned code, unsigned begin) { return (code & 0xFC00) == begin; }

bool begins(const wchar_t* path, const wchar_t* with) { return wcsncmp(path, with, wcslen(with)) == 0; }

// UTF-8 as UTF-16, with Windows' own separators.
bool decode(const char* path, wchar_t* wide) {
  const unsigned char* next = reinterpret_cast<const unsigned char*>(path);
  size_t size = 0;
  while (*next) {
    unsigned code = *next++;
    const int more = code < 0x80 ? 0 : code < 0xC2 ? -1 : code < 0xE0 ? 1 : code < 0xF0 ? 2 : code < 0xF5 ? 3 : -1;
    if (more < 0 || size + 3 > LONGEST_PATH) return false;
    code &= more == 0 ? 0x7F : 0x3F >> more;
    for (int i = 0; i < more; i++) {
      if ((*next & 0xC0) != 0x80) return false;
      code = code << 6 | (*next++ & 0x3F);
    }
    if (code == '/') code = '\\';
    if (code >= 0x10000) {
      wide[size++] = static_cast<wchar_t>(0xD800 + ((code - 0x10000) >> 10));
      code = 0xDC00 + ((code - 0x10000) & 0x3FF);
    }
    wide[size++] = static_cast<wchar_t>(code);
  }
  wide[size] = L'\0';
  return size > 0;
}

// Puts the prefix in place of the first characters.
bool begin_with(const wchar_t* prefix, size_t dropped, wchar_t* wide) {
  const size_t size = wcslen(wide) - dropped, length = wcslen(prefix);
  if (length + size > LONGEST_PATH) return false;
  memmove(wide + length, wide + dropped, (size + 1) * sizeof(wchar_t));
  memcpy(wide, prefix, length * sizeof(wchar_t));
  return true;
}

}  // namespace

bool widen(const char* path, wchar_t* wide) {
  wchar_t given[LONGEST_PATH + 1];
  if (!decode(path, given)) return false;
  if (begins(given, VERBATIM)) {
    memcpy(wide, given, (wcslen(given) + 1) * sizeof(wchar_t));
    return true;
  }
  if (_wfullpath(wide, given, LONGEST_PATH + 1) == nullptr) return false;
  if (wcslen(wide) <= LONGEST_SHORT_PATH || begins(wide, DEVICE) || begins(wide, VERBATIM)) return true;
  return begins(wide, L"\\\\") ? begin_with(VERBATIM_SHARE, 2, wide) : begin_with(VERBATIM, 0, wide);
}

bool narrow(const wchar_t* wide, char* path, size_t capacity) {
  size_t size = 0;
  while (*wide) {
    unsigned code = static_cast<unsigned>(*wide++);
    if (is_surrogate(code, 0xD800) && is_surrogate(static_cast<unsigned>(*wide), 0xDC00)) {
      code = 0x10000 + ((code & 0x3FF) << 10) + (static_cast<unsigned>(*wide++) & 0x3FF);
    }
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    if (size + static_cast<size_t>(more) + 2 > capacity) return false;
    constexpr unsigned LEADS[] = {0, 0xC0, 0xE0, 0xF0};
    path[size++] = static_cast<char>(LEADS[more] | code >> 6 * more);
    for (int k = more - 1; k >= 0; k--) path[size++] = static_cast<char>(0x80 | (code >> 6 * k & 0x3F));
  }
  path[size] = '\0';
  return true;
}

}  // namespace shipcollision

#endif
