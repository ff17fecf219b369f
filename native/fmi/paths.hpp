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

// The same for paths that begin with `prefix`; those of the lines go on from there.
template <size_t COUNT>
bool find_in(const Path (&paths)[COUNT], const char* prefix, void* base, const char* path, int index, Place& place) {
  const size_t size = strlen(prefix);
  return strncmp(path, prefix, size) == 0 && find_path(paths, COUNT, base, path + size, index, place);
}

// The rest of a path behind `prefix`, the number of an entry of a list of `count`, and a dot: null for another path.
inline const char* find_entry(const char* prefix, const char* path, int count, int& entry) {
  const size_t size = strlen(prefix);
  if (strncmp(path, prefix, size) != 0) return nullptr;
  const char* next = path + size;
  const char* const number = next;
  entry = 0;
  while (*next >= '0' && *next <= '9' && entry < count) entry = 10 * entry + (*next++ - '0');
  return next > number && entry < count && *next == '.' ? next + 1 : nullptr;
}

// The value at a path within an entry of a list of structures: PREFIX NUMBER . REST.
template <typename Structure, size_t COUNT>
bool find_in_list(const Path (&paths)[COUNT], const char* prefix, Structure* entries, int count, const char* path,
                  int index, Place& place) {
  int entry;
  const char* rest = find_entry(prefix, path, count, entry);
  return rest != nullptr && find_path(paths, COUNT, entries + entry, rest, index, place);
}

#define REAL(structure, member) {#member, Kind::real, offsetof(structure, member), 0, nullptr, 0}
#define REALS(structure, member) \
  {#member, Kind::real, offsetof(structure, member), sizeof(structure::member) / sizeof(double), nullptr, 0}
#define INTEGER(structure, member) {#member, Kind::integer, offsetof(structure, member), 0, nullptr, 0}
#define STRING(structure, member) {#member, Kind::string, offsetof(structure, member), 0, nullptr, 0}

}  // namespace shipcollision
