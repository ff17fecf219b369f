// What a folder holds, for messages.
#pragma once

#include "numbers/text.hpp"

namespace shipcollision {

// Names of the files in a folder that end with `suffix`, without it, sorted and parted by commas; of a folder with very
// many only some, and nothing where none can be read.
void list_folder(const char* folder, const char* suffix, Text& names);
bool is_folder(const char* path);

}  // namespace shipcollision
