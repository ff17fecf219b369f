// Access to a model through value references: the twin of shipcollision_fmu/fmi/variable_access.py.
//
// Values of both versions of FMI are read and written here. In FMI 2.0 a value reference is a scalar of the table; in
// FMI 3.0 it is an array of them, and 0 is the time. A refused call answers false, says why and changes nothing.
#pragma once

#include <stddef.h>

#include "../numbers/text.hpp"
#include "../numbers/bytes.hpp"
#include "model.hpp"
#include "variables.hpp"

namespace shipcollision {

// Types of values that a host asks for, by the kind of variable they belong to.
enum class Type : unsigned char { real, integer, boolean, string, enumeration, integer_or_enumeration };

class VariableAccess {
 public:
  using Reference = unsigned;

  VariableAccess() = default;
  ~VariableAccess();
  VariableAccess(const VariableAccess&) = delete;
  VariableAccess& operator=(const VariableAccess&) = delete;

  // Finds the place of every variable in the model and gives it its start value. `time` is the variable 0 of FMI 3.0.
  bool connect(const Variables& variables, Model& model, double* time, Text& why);

  // Reading. Outputs are computed first, if they do not yet follow from what was set. Strings are valid until the next
  // call. `size` is the number of values that the host has room for.
  bool get_reals(const Reference* references, size_t count, double* values, size_t size, Text& why);
  template <typename Integer>
  bool get_integers(Type type, const Reference* references, size_t count, Integer* values, size_t size, Text& why);
  template <typename Boolean>
  bool get_booleans(const Reference* references, size_t count, Boolean* values, size_t size, Text& why);
  bool get_strings(const Reference* references, size_t count, const char** values, size_t size, Text& why);

  // Writing: all of a call or nothing.
  bool set_reals(const Reference* references, size_t count, const double* values, size_t size, Text& why);
  template <typename Integer>
  bool set_integers(Type type, const Reference* references, size_t count, const Integer* values, size_t size,
                    Text& why);
  template <typename Boolean>
  bool set_booleans(const Reference* references, size_t count, const Boolean* values, size_t size, Text& why);
  bool set_strings(const Reference* references, size_t count, const char* const* values, size_t size, Text& why);

  bool is_running() const { return is_running_; }
  bool initialise(Text& why);
  bool step(double t, double h, Text& why);
  // As freshly made.
  void reset();

  // The whole state as bytes, but for whether it is running, which whoever saves it knows. Restoring answers false, and
  // leaves everything, for what cannot be read.
  void save(ByteWriter& bytes) const;
  bool restore(ByteReader& bytes, bool is_running, Text& why);

  // Refuses references to values of a type that no variable has.
  bool refuse_type(const char* called, const Reference* references, size_t count, Text& why) const;
  const char* name() const { return variables_->fmu(); }

 private:
  struct Cell {
    void* address;
    const Variable* variable;
  };
  struct Entry {  // a value reference: its cells are entries of cells_
    unsigned first;
    unsigned size;
    Kind kind;
    Causality causality;
    bool is_time;
  };

  bool connect_scalar(const Variable& variable, Model& model, Cell& cell, Text& why);
  void make_entries();
  bool resolve(Type type, const Reference* references, size_t count, const void* values, size_t size, Text& why) const;
  bool resolve_get(Type type, const Reference* references, size_t count, const void* values, size_t size, Text& why);
  bool resolve_set(Type type, const Reference* references, size_t count, const void* values, size_t size,
                   Text& why) const;
  bool check_settable(const Entry& entry, Text& why) const;
  bool refuse_reference(Reference reference, const char* called, Text& why) const;
  bool refuse_item(const Cell& cell, long long value, Text& why) const;
  const char* name_of(Reference reference) const;
  const char* type_name(Kind kind) const;
  const char* type_name(Type type) const;
  void note_written();
  void note_set(const Cell& cell);
  void note_all_set();
  bool compute_outputs(Text& why);

  void write_start_values();
  void forget_set();
  bool take_set(ByteReader& bytes);
  void put_values(ByteWriter& bytes, bool parameters_alone) const;
  bool take_values(ByteReader& bytes, bool parameters_alone) const;
  bool write_all(ByteReader& bytes, bool is_running, bool checks_files, Text& why);
  bool read_again(const unsigned char* parameters, size_t size, Text& why);
  bool check_files(const unsigned char* checksums, size_t size, Text& why) const;

  const Variables* variables_ = nullptr;
  Model* model_ = nullptr;
  bool* is_set_ = nullptr;       // in the order of the table: Reals that were ever set, if the model asks
  Cell* cells_ = nullptr;        // in the order of the table
  Cell* places_ = nullptr;       // in the order of the entries
  Entry* entries_ = nullptr;     // by value reference
  size_t entry_count_ = 0;
  unsigned char* fresh_ = nullptr;       // all values of a fresh model
  size_t fresh_size_ = 0;
  unsigned char* parameters_ = nullptr;  // the parameters that the model last read
  size_t parameters_capacity_ = 0;
  size_t parameters_size_ = 0;
  bool is_read_ = false;                 // the model has read parameters
  bool is_dirty_ = true;                 // outputs do not yet follow from what was set
  bool is_running_ = false;              // initialised: parameters are fixed
};

}  // namespace shipcollision
