// What an instance tells its host: a line with a status, in the categories that the model description declares.
#pragma once

#include <stddef.h>

#include "../numbers/text.hpp"

namespace shipcollision {

// As both versions of FMI number them.
enum class Status : int { ok = 0, warning = 1, discard = 2, error = 3, fatal = 4 };

// The twins of LOG_CATEGORIES in shipcollision_fmu/fmi/slave_base.py.
enum class Category : unsigned char { events, error, warning };

class Logger {
 public:
  // The host's function behind the form of its version of FMI. `function` is what the host gave, never null here.
  using Function = void (*)();
  using Forward = void (*)(Function function, void* environment, const char* instance, Status status,
                           const char* category, const char* line);

  // function may be null: then nobody listens. Names longer than some hundred bytes are cut.
  void open(Forward forward, Function function, void* environment, const char* instance, bool is_on);
  void name_fmu(const char* fmu) { fmu_ = fmu; }

  // All categories, or those named. Refuses a name that is no category, and changes nothing then.
  bool set_categories(bool is_on, const char* const* categories, size_t count, Text& why);

  // The line to the host, if it listens, and to stderr, if the user asks for it; `marked` is the line for stderr.
  void log(Status status, Category category, const char* line, const char* prefix = "") const;
  // The same whether or not logging is on: why there is no instance.
  void log_failure(const char* line) const;

 private:
  void print(const char* prefix, const char* line) const;

  static constexpr size_t LONGEST_NAME = 256;

  Forward forward_ = nullptr;
  Function function_ = nullptr;
  void* environment_ = nullptr;
  const char* fmu_ = "FMU";
  char instance_[LONGEST_NAME] = "";
  bool is_on_[3] = {false, false, false};
  bool is_on_stderr_ = false;
};

}  // namespace shipcollision
