// The table of variables: the twin of shipcollision_fmu/fmi/variables.py, read from the resources of an FMU.
#pragma once

#include <stddef.h>

#include "../files.hpp"
#include "../numbers/line_reader.hpp"
#include "../numbers/text.hpp"
#include "model.hpp"

namespace shipcollision {

enum class Causality : unsigned char { parameter, input, output };

// One scalar variable.
struct Variable {
  const char* name;
  const char* path;
  int index;  // -1: the path ends at the value itself
  Kind kind;
  Causality causality;
  bool is_preset;  // the start value is of this FMU alone
  bool has_start;
  int whole_start;  // of an Integer, a Boolean, and an Enumeration (from 1)
  double real_start;
  const char* string_start;
  const char** items;
  size_t item_count;
};

// A variable of FMI 3.0: its elements are entries of Variables::elements().
struct ArrayVariable {
  const char* name;
  unsigned first;
  unsigned size;
};

// The file resources/variables.txt: shipcollision_fmu/fmi/builder/native_variables.py says what is in it.
class Variables {
 public:
  Variables() = default;
  ~Variables();
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;

  bool read(const char* path, Text& why);

  const char* fmu() const { return fmu_; }
  int fmi() const { return fmi_; }
  const char* tag() const { return tag_; }
  const char* build() const { return build_; }
  const char* token() const { return token_; }
  const char* const* ships() const { return ships_; }
  int ship_count() const { return ship_count_; }
  const Variable* scalars() const { return scalars_; }
  unsigned scalar_count() const { return scalar_count_; }
  // Of FMI 3.0; without them each scalar is a variable.
  const ArrayVariable* arrays() const { return arrays_; }
  unsigned array_count() const { return array_count_; }
  const unsigned* elements() const { return elements_; }

 private:
  bool confirm_digest(size_t& size) const;
  bool read_lines(LineReader& lines, Text& why);
  bool read_head(LineReader& lines, Text& why);
  bool read_ships(LineReader& lines);
  bool read_presets(LineReader& lines);
  size_t count_texts();
  bool allocate(size_t scalars);
  bool read_scalar(LineReader& lines, Variable& scalar);
  bool read_start(LineReader& lines, Variable& scalar);
  bool read_items(LineReader& lines, Variable& scalar);
  bool read_array(LineReader& lines, ArrayVariable& array);

  FileContent file_;
  const char* fmu_ = "";
  int fmi_ = 0;
  const char* tag_ = "";
  const char* build_ = "";
  const char* token_ = "";
  const char** ships_ = nullptr;
  int ship_count_ = 0;
  Variable* scalars_ = nullptr;
  unsigned scalar_count_ = 0;
  const char** items_ = nullptr;
  size_t item_count_ = 0;
  ArrayVariable* arrays_ = nullptr;
  unsigned array_count_ = 0;
  unsigned* elements_ = nullptr;
  unsigned element_count_ = 0;
};

}  // namespace shipcollision
