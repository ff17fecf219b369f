// What a model must have to be an FMU: the twin of the protocol Model in shipcollision_fmu/fmi/variable_access.py.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "../memory.hpp"
#include "../numbers/text.hpp"

namespace shipcollision {

enum class Kind : unsigned char { real, integer, boolean, string, enumeration };

// Where a value lies in a model: a double, int, bool, char[LONGEST_STRING], or an int that counts the items from 0.
struct Place {
  void* address = nullptr;
  Kind kind = Kind::real;
  const char* const* items = nullptr;  // of an enumeration
  size_t item_count = 0;
};

// A file that a model has read. ship: whose parameter names it, null for one that is of no ship; value: of the parameter.
struct ReadFile {
  const char* ship;
  const char* parameter;
  const char* value;
  uint32_t checksum;
};

// A model in time. What can be refused answers false and says why; everything is then as it was.
class Model : public OnHeap {
 public:
  virtual ~Model() = default;

  // The value at the path of a line of the table ("outputs.position"), entry `index` of the list there, or -1.
  virtual bool find(const char* path, int index, Place& place) = 0;

  // For a model that asks which Reals the host ever set, by their paths: none so far, and one more.
  virtual bool asks_for_inputs_set() const { return false; }
  virtual void forget_inputs_set() {}
  virtual void note_input_set(const char* /*path*/) {}

  // Files that initialise() has read; asked for after it alone.
  virtual size_t file_count() const { return 0; }
  virtual ReadFile file(size_t) const { return {}; }
  // The next initialise() reads files that an earlier one read, too: they may have changed.
  virtual void forget_files() {}
  // Reads parameters and start values, computes the outputs of the start. May be called again.
  virtual bool initialise(Text& why) = 0;
  virtual bool step(double t, double h, Text& why) = 0;

  // What parameters, inputs and outputs do not hold, as bytes. They are asked for after initialise() alone.
  virtual size_t state_size() const = 0;
  virtual void get_state(void* bytes) const = 0;
  virtual bool set_state(const void* bytes, size_t size, Text& why) = 0;

  // What was not as it should be at the start or in the last step, in one line, or nothing.
  virtual const Text& warning() const = 0;
  // What happened in the last step that people should read, a line each.
  virtual size_t event_count() const { return 0; }
  virtual const char* event(size_t) const { return ""; }
};

class Variables;

// A model for the FMU of that table, which finds its files in the folder `resources`. Null, and why, for another FMU's
// table, and when there is no memory. The library of each FMU has the one model that the FMU is named after.
Model* make_model(const Variables& variables, const char* resources, Text& why);
// Refuses the table of another FMU.
Model* refuse_model(const Variables& variables, Text& why);

}  // namespace shipcollision
