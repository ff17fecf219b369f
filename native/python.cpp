// The plain C interface of the library: what Python calls through ctypes, and what the tests of the parts call.
#include <stddef.h>

#include "collision/geometry/closest_points.hpp"
#include "export.hpp"
#include "numbers/elementary.hpp"

namespace {

struct Function {
  const char* name;
  double (*of_one)(double);
  double (*of_two)(double, double);
};

constexpr Function FUNCTIONS[] = {
    {"sin", shipcollision::sin, nullptr},     {"cos", shipcollision::cos, nullptr},
    {"tan", shipcollision::tan, nullptr},     {"asin", shipcollision::asin, nullptr},
    {"atan", shipcollision::atan, nullptr},   {"exp", shipcollision::exp, nullptr},
    {"log", shipcollision::log, nullptr},     {"round", shipcollision::round, nullptr},
    {"floor", shipcollision::floor, nullptr}, {"ceil", shipcollision::ceil, nullptr},
    {"atan2", nullptr, shipcollision::atan2}, {"hypot", nullptr, shipcollision::hypot},
};

bool is_same(const char* a, const char* b) {
  for (; *a != '\0' && *a == *b; ++a, ++b) {
  }
  return *a == *b;
}

}  // namespace

// Number of the signatures below: one more after a change (shipcollision_fmu/toolchain/load.py).
SHIPCOLLISION_EXPORT int shipcollision_interface() { return 2; }

// results[i] = f(x[i]) or f(x[i], y[i]) of the elementary function f of that name; false without one.
SHIPCOLLISION_EXPORT bool shipcollision_elementary(const char* name, const double* x, const double* y, double* results,
                                                   size_t count) {
  for (const Function& function : FUNCTIONS) {
    if (!is_same(function.name, name)) continue;
    for (size_t i = 0; i < count; ++i) {
      results[i] = function.of_one != nullptr ? function.of_one(x[i]) : function.of_two(x[i], y[i]);
    }
    return true;
  }
  return false;
}

// Hulls of some ships: see PlacedHulls, whose arguments these are. Nothing is checked here.
using shipcollision::Closest;
using shipcollision::PlacedHulls;

SHIPCOLLISION_EXPORT PlacedHulls* shipcollision_hulls_open(int ships, const int* parts, const int* corners,
                                                           const double* coordinates) {
  return new PlacedHulls(ships, parts, corners, coordinates);
}

SHIPCOLLISION_EXPORT void shipcollision_hulls_close(PlacedHulls* hulls) { delete hulls; }

// pose: x, y, z of CO in n [m], then the rows of R_nb.
SHIPCOLLISION_EXPORT void shipcollision_hulls_place(PlacedHulls* hulls, int ship, const double* pose) {
  hulls->place(ship, pose, pose + 3);
}

SHIPCOLLISION_EXPORT int shipcollision_hulls_closest(const PlacedHulls* hulls, int a, int b, double distance,
                                                     Closest* found) {
  return hulls->closest(a, b, distance, found);
}

SHIPCOLLISION_EXPORT int shipcollision_hulls_closest_of_parts(const PlacedHulls* hulls, int a, int part_a, int b,
                                                              int part_b, double distance, Closest* found) {
  return hulls->closest_of_parts(a, part_a, b, part_b, distance, *found);
}

SHIPCOLLISION_EXPORT double shipcollision_hulls_gap(const PlacedHulls* hulls, int a, int b, double cap) {
  return hulls->gap(a, b, cap);
}

SHIPCOLLISION_EXPORT int shipcollision_hulls_corners(const PlacedHulls* hulls, int ship, int part, double* coordinates,
                                                     int capacity) {
  return hulls->get_corners(ship, part, coordinates, capacity);
}
