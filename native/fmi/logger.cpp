#include "logger.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

namespace shipcollision {

namespace {

const char* const CATEGORIES[] = {"logEvents", "logStatusError", "logStatusWarning"};
constexpr size_t CATEGORY_COUNT = 3;
// Environment variable; with the value "stderr", what an FMU logs is printed as well.
const char* const STDERR = "SHIPCOLLISION_LOG";

size_t find_category(const char* name) {
  size_t found = 0;
  while (found < CATEGORY_COUNT && (name == nullptr || strcmp(name, CATEGORIES[found]) != 0)) found++;
  return found;
}

}  // namespace

void Logger::open(Forward forward, Function function, void* environment, const char* instance, bool is_on) {
  forward_ = forward;
  function_ = function;
  environment_ = environment;
  size_t size = strnlen(instance, LONGEST_NAME - 1);
  while (size > 0 && (instance[size] & 0xC0) == 0x80) size--;  // whole characters of UTF-8
  memcpy(instance_, instance, size);
  instance_[size] = '\0';
  for (bool& each : is_on_) each = is_on;
  const char* asked = getenv(STDERR);
  is_on_stderr_ = asked != nullptr && strcmp(asked, "stderr") == 0;
}

bool Logger::set_categories(bool is_on, const char* const* categories, size_t count, Text& why) {
  if (count > 0 && categories == nullptr) {
    why << "a null pointer in place of " << static_cast<long long>(count) << " log categories";
    return false;
  }
  bool named[CATEGORY_COUNT] = {count == 0, count == 0, count == 0};
  for (size_t i = 0; i < count; i++) {
    const size_t found = find_category(categories[i]);
    if (found == CATEGORY_COUNT) {
      why.quote(categories[i] == nullptr ? "" : categories[i]) << " is not a log category: one of logEvents, "
                                                               << "logStatusError, logStatusWarning";
      return false;
    }
    named[found] = true;
  }
  for (size_t i = 0; i < CATEGORY_COUNT; i++) is_on_[i] = is_on && named[i];
  return true;
}

void Logger::log(Status status, Category category, const char* line, const char* prefix) const {
  const size_t which = static_cast<size_t>(category);
  if (is_on_[which] && function_ != nullptr) {
    forward_(function_, environment_, instance_, status, CATEGORIES[which], line);
  }
  print(prefix, line);
}

void Logger::log_failure(const char* line) const {
  if (function_ != nullptr) {
    forward_(function_, environment_, instance_, Status::error, CATEGORIES[static_cast<size_t>(Category::error)], line);
  }
  print("", line);
}

void Logger::print(const char* prefix, const char* line) const {
  if (!is_on_stderr_) return;
  Text whole;  // in one piece, as other threads print as well; printf is not in Windows' library
  whole << fmu_ << " " << instance_ << ": " << prefix << line;
  whole.end_line();
  fputs(whole.get(), stderr);
}

}  // namespace shipcollision
