// Names of the ships of a collision model: the twin of shipcollision_fmu/collision/ship_names.py.
#pragma once

#include "../numbers/text.hpp"

namespace shipcollision {

// What a message says of a name that is_ship_name refuses.
const char* describe_name_fault(const char* name);
bool is_identifier(const char* name);
bool is_ship_name(const char* name);

// False for no names, for a name that no ship may have, and for two equal names.
bool check_ship_names(const char* const* names, int count, Text& why);

}  // namespace shipcollision
