#include "folder.hpp"

#include <string.h>

#if defined(_WIN32)
#include <io.h>
#include <wchar.h>

#include "wide_path.hpp"
#else
#include <dirent.h>
#endif

namespace shipcollision {
namespace {

constexpr size_t MOST_NAMES = 64;  // a message has no room for more
constexpr size_t LONGEST_NAME = 64;

// A few short names in order.
class Names {
 public:
  void add(const char* file, const char* suffix) {
    const size_t size = strlen(file), end = strlen(suffix);
    if (size <= end || size - end >= LONGEST_NAME || strcmp(file + size - end, suffix) != 0) return;
    if (count_ == MOST_NAMES) return;
    char name[LONGEST_NAME] = {};
    memcpy(name, file, size - end);
    size_t place = count_++;
    for (; place > 0 && strcmp(name, names_[place - 1]) < 0; --place) {
      memcpy(names_[place], names_[place - 1], LONGEST_NAME);
    }
    memcpy(names_[place], name, LONGEST_NAME);
  }

  void put(Text& text) const {
    for (size_t i = 0; i < count_; ++i) text << (i == 0 ? "" : ", ") << names_[i];
  }

 private:
  char names_[MOST_NAMES][LONGEST_NAME];
  size_t count_ = 0;
};

}  // namespace

void list_folder(const char* folder, const char* suffix, Text& names) {
  Names found;
#if defined(_WIN32)
  wchar_t wide[LONGEST_PATH + 1];
  _wfinddata64_t entry;
  if (!widen(folder, wide) || wcslen(wide) + 2 > LONGEST_PATH) return;
  wcscat(wide, L"\\*");
  const intptr_t search = _wfindfirst64(wide, &entry);
  if (search == -1) return;
  do {
    char name[2 * LONGEST_NAME];
    if (narrow(entry.name, name, sizeof name)) found.add(name, suffix);
  } while (_wfindnext64(search, &entry) == 0);
  _findclose(search);
#else
  DIR* opened = opendir(folder);
  if (opened == nullptr) return;
  while (const dirent* entry = readdir(opened)) found.add(entry->d_name, suffix);
  closedir(opened);
#endif
  found.put(names);
}

bool is_folder(const char* path) {
#if defined(_WIN32)
  wchar_t wide[LONGEST_PATH + 1];
  _wfinddata64_t entry;
  if (!widen(path, wide) || wcslen(wide) + 2 > LONGEST_PATH) return false;
  wcscat(wide, L"\\*");
  const intptr_t search = _wfindfirst64(wide, &entry);
  if (search == -1) return false;
  _findclose(search);
#else
  DIR* opened = opendir(path);
  if (opened == nullptr) return false;
  closedir(opened);
#endif
  return true;
}

}  // namespace shipcollision
