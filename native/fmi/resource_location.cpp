#include "resource_location.hpp"

#include <string.h>

namespace shipcollision {

namespace {

constexpr size_t SCHEME_SIZE = 5;  // "file:"

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool begins(const char* text, const char* with) {
  for (; *with; text++, with++) {
    if (lower(*text) != *with) return false;
  }
  return true;
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return lower(c) >= 'a' && lower(c) <= 'f' ? lower(c) - 'a' + 10 : -1;
}

// "http://": a scheme of at least two letters, since C:// is a drive.
bool has_scheme(const char* location) {
  size_t size = 0;
  while (is_letter(location[size])) size++;
  return size > 1 && begins(location + size, "://");
}

bool copy(const char* from, char* path, size_t capacity) {
  const size_t size = strlen(from);
  if (size >= capacity) return false;
  memcpy(path, from, size + 1);
  return true;
}

// %20 and the like as bytes. A percent sign without two digits is one: hosts that encode nothing.
bool decode(const char* from, char* path, size_t capacity) {
  size_t size = 0;
  while (*from) {
    char c = *from++;
    if (c == '%' && digit(from[0]) >= 0 && digit(from[1]) >= 0) {
      c = static_cast<char>(16 * digit(from[0]) + digit(from[1]));
      from += 2;
    }
    if (c == '\0' || size + 1 >= capacity) return false;
    path[size++] = c;
  }
  path[size] = '\0';
  return true;
}

// The path of a URI: what follows its authority, which must be this machine.
bool pass_authority(const char*& rest, Platform platform) {
  if (!begins(rest, "//")) return true;
  const char* authority = rest + 2;
  const size_t size = strcspn(authority, "/");
  if (platform == Platform::windows && size == 2 && is_letter(authority[0]) && authority[1] == ':') {
    rest = authority;  // file://C:/place: wrong, and common
    return true;
  }
  if (size == 0 || (size == 9 && begins(authority, "localhost"))) {
    rest = authority + size;
    return true;
  }
  return platform == Platform::windows;  // \\machine\share
}

// "/C:/place" -> "C:/place"
void drop_slash_of_drive(char* path) {
  if (path[0] == '/' && is_letter(path[1]) && (path[2] == ':' || path[2] == '|')) {
    memmove(path, path + 1, strlen(path));
    path[1] = ':';
  }
}

void drop_last_separators(char* path, Platform platform) {
  size_t size = strlen(path);
  while (size > 1 && (path[size - 1] == '/' || (platform == Platform::windows && path[size - 1] == '\\'))) {
    path[--size] = '\0';
  }
}

}  // namespace

bool find_resources(const char* location, char* path, size_t capacity, Text& why, Platform platform) {
  if (location == nullptr || *location == '\0') {
    why << "the host gives no resource location: give the URI or the path of the FMU's folder resources";
    return false;
  }
  const bool is_uri = begins(location, "file:");
  const char* rest = is_uri ? location + SCHEME_SIZE : location;
  if ((!is_uri && has_scheme(location)) || (is_uri && !pass_authority(rest, platform))) {
    why.quote(location) << " is not on this machine: give the resource location as file:///PATH";
    return false;
  }
  if (!(is_uri ? decode(rest, path, capacity) : copy(rest, path, capacity)) || path[0] == '\0') {
    why.quote(location) << " cannot be a resource location: it is too long, or no path";
    return false;
  }
  if (is_uri && platform == Platform::windows) drop_slash_of_drive(path);
  drop_last_separators(path, platform);
  return true;
}

}  // namespace shipcollision
