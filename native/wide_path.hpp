// Paths for Windows, which has them in UTF-16.
#pragma once

#if defined(_WIN32)

#include <stddef.h>

namespace shipcollision {

constexpr size_t LONGEST_PATH = 4096;

// The path in full, from UTF-8, into LONGEST_PATH + 1 characters of UTF-16, as Windows opens it however long it is; false
// for what is no UTF-8, and for a path that is too long.
bool widen(const char* path, wchar_t* wide);
// UTF-16 as UTF-8; false where `capacity` bytes, the end included, are too few.
bool narrow(const wchar_t* wide, char* path, size_t capacity);

}  // namespace shipcollision

#endif
