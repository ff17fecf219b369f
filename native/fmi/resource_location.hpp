// The folder of an FMU's resources, from what a host gives as its place: the twin, seen from the FMU, of
// shipcollision_fmu/fmi/builder/resource_uri.py.
#pragma once

#include <stddef.h>

#include "../numbers/text.hpp"

namespace shipcollision {

enum class Platform { posix, windows };

#if defined(_WIN32)
constexpr Platform THIS_PLATFORM = Platform::windows;
#else
constexpr Platform THIS_PLATFORM = Platform::posix;
#endif

// Writes the path without a separator at its end. `location` is a URI (file:/place, file:///place,
// file://localhost/place, percent-encoded) or a path as it is. False for a location that is none, is elsewhere, or is
// too long.
bool find_resources(const char* location, char* path, size_t capacity, Text& why, Platform platform = THIS_PLATFORM);

}  // namespace shipcollision
