// The plain C interface of the library: what Python calls through ctypes, and what the tests of the parts call.
#include <stddef.h>

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
