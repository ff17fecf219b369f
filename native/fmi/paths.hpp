// Where the paths of a table lead in a model: a line for each value or list, and how to look one up.
#pragma once

#include <stddef.h>
#include <string.h>

#include "model.hpp"

namespace shipcollision {

struct Path {
  const char* path;
  Kind kind;
  size_t offset;       // bytes from the beginning of the structure that `find_path` is given
  size_t count;        // values in the list; 0: the path ends at the value itself
  const char* const* items;
  size_t item_count;
};

// The value at the path, entry `index` of the list there, or -1, within the structure at `base`.
inline bool find_path(const Path* paths, size_t path_count, void* base, const char* path, int index, Place& place) {
  for (size_t i = 0; i < path_count; i++) {
    const Path& line = paths[i];
    if (strcmp(line.path, path) != 0) continue;
    if (index < 0 ? line.count != 0 : static_cast<size_t>(index) >= line.count) return false;
    // Lists are of reals alone.
    const size_t offset = line.offset + (index < 0 ? 0 : static_cast<size_t>(index) * sizeof(double));
    place = {static_cast<char*>(base) + offset, line.kind, line.items, line.item_count};
    return true;
  }
  return false;
}

}  // namespace shipcollision
