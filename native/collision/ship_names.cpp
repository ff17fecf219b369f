#include "ship_names.hpp"

#include <string.h>

namespace shipcollision {
namespace {

const char* const RESERVED[] = {"clearance", "clearance_range", "contact",   "diagnosis", "energy",
                                "feedback",  "fender",          "friction",  "impact",    "minimum_separation_time",
                                "nearest",   "obstacles",       "response",  "restitution", "scratch",
                                "solver",    "substep",         "time"};

bool is_reserved(const char* name) {
  for (const char* reserved : RESERVED) {
    if (strcmp(name, reserved) == 0) return true;
  }
  return false;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

const char* describe_name_fault(const char* name) {
  return is_reserved(name)
             ? "is no name for a ship, since variables of ShipCollision have it: take another"
             : "is no name for a ship, whose FMI variables begin with it: take letters, digits and '_', no digit first";
}

bool is_identifier(const char* name) {
  if (!is_letter(*name)) return false;
  while (is_letter(*name) || is_digit(*name)) ++name;
  return *name == '\0';
}

bool is_ship_name(const char* name) { return is_identifier(name) && !is_reserved(name); }

bool check_ship_names(const char* const* names, int count, Text& why) {
  if (count == 0) {
    why << "ships = () must be a tuple of one or more names, such as ('own', 'target')";
    return false;
  }
  for (int i = 0; i < count; ++i) {
    if (!is_ship_name(names[i])) {
      why << "ships: ";
      why.quote(names[i]) << " " << describe_name_fault(names[i]);
      return false;
    }
    for (int k = 0; k < i; ++k) {
      if (strcmp(names[i], names[k]) != 0) continue;
      why << "ships: ";
      why.quote(names[i]) << " is there twice: give each ship a name of its own";
      return false;
    }
  }
  return true;
}

}  // namespace shipcollision
