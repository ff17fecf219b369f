#include "variable_access.hpp"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../manoeuvring/interface.hpp"
#include "../numbers/elementary.hpp"

namespace shipcollision {

namespace {

const char* const NAMES_FMI2[] = {"Real", "Integer", "Boolean", "String", "Enumeration"};
const char* const NAMES_FMI3[] = {"Float64", "Int32", "Boolean", "String", "Enumeration"};

bool is_of(Kind kind, Type type) {
  if (type == Type::integer_or_enumeration) return kind == Kind::integer || kind == Kind::enumeration;
  return static_cast<unsigned char>(kind) == static_cast<unsigned char>(type);
}

double& as_real(void* address) { return *static_cast<double*>(address); }
char* as_string(void* address) { return static_cast<char*>(address); }

// An int, or an enumeration, which is as large as one but another type.
int read_int(const void* address) {
  int number;
  memcpy(&number, address, sizeof number);
  return number;
}

void write_int(void* address, int number) { memcpy(address, &number, sizeof number); }

// A host's Boolean may hold any byte: it is looked at as such.
template <typename Boolean>
bool is_true(const Boolean* value) {
  Boolean none{};
  return memcmp(value, &none, sizeof none) != 0;
}

bool are_same(const char* const* items, size_t count, const char* const* others, size_t other_count) {
  if (count != other_count) return false;
  for (size_t i = 0; i < count; i++) {
    if (strcmp(items[i], others[i]) != 0) return false;
  }
  return true;
}

}  // namespace

VariableAccess::~VariableAccess() {
  free(is_set_);
  free(cells_);
  free(places_);
  free(entries_);
  free(fresh_);
  free(parameters_);
}

bool VariableAccess::connect(const Variables& variables, Model& model, double* time, Text& why) {
  variables_ = &variables;
  model_ = &model;
  const size_t count = variables.scalar_count();
  const bool is_fmi3 = variables.fmi() == 3;
  entry_count_ = is_fmi3 ? variables.array_count() + 1 : count;
  is_set_ = static_cast<bool*>(calloc(count + 1, sizeof(bool)));
  cells_ = static_cast<Cell*>(calloc(count + 1, sizeof(Cell)));
  places_ = static_cast<Cell*>(calloc(count + 1, sizeof(Cell)));
  entries_ = static_cast<Entry*>(calloc(entry_count_ + 1, sizeof(Entry)));
  if (is_set_ == nullptr || cells_ == nullptr || places_ == nullptr || entries_ == nullptr) {
    why << variables.fmu() << ": there is no memory for its variables";
    return false;
  }
  for (size_t i = 0; i < count; i++) {
    if (!connect_scalar(variables.scalars()[i], model, cells_[i], why)) return false;
  }
  cells_[count] = {time, nullptr};
  make_entries();
  write_start_values();
  forget_set();
  ByteWriter values;
  put_values(values, false);
  fresh_size_ = values.size();
  fresh_ = static_cast<unsigned char*>(malloc(fresh_size_ + 1));
  for (size_t i = 0; i < count; i++) {
    if (cells_[i].variable->causality != Causality::parameter) continue;
    parameters_capacity_ += cells_[i].variable->kind == Kind::string ? LONGEST_STRING + 4 : sizeof(double);
  }
  parameters_ = static_cast<unsigned char*>(malloc(parameters_capacity_ + 1));
  if (fresh_ == nullptr || parameters_ == nullptr) {
    why << variables.fmu() << ": there is no memory for its values";
    return false;
  }
  ByteWriter fresh(fresh_, fresh_size_);
  put_values(fresh, false);
  return true;
}

bool VariableAccess::connect_scalar(const Variable& variable, Model& model, Cell& cell, Text& why) {
  Place place;
  if (!model.find(variable.path, variable.index, place) || place.kind != variable.kind ||
      (place.kind == Kind::enumeration &&
       !are_same(place.items, place.item_count, variable.items, variable.item_count))) {
    why << variables_->fmu() << ": this library has no variable " << variable.name << " (" << variable.path
        << ") as its table has it: build the FMU again";
    return false;
  }
  cell = {place.address, &variable};
  return true;
}

void VariableAccess::make_entries() {
  const Variable* scalars = variables_->scalars();
  if (variables_->fmi() == 2) {
    for (unsigned i = 0; i < entry_count_; i++) {
      entries_[i] = {i, 1, scalars[i].kind, scalars[i].causality, false};
      places_[i] = cells_[i];
    }
    return;
  }
  const unsigned count = variables_->scalar_count();
  entries_[0] = {count, 1, Kind::real, Causality::output, true};
  places_[count] = cells_[count];
  for (unsigned i = 0; i < variables_->array_count(); i++) {
    const ArrayVariable& array = variables_->arrays()[i];
    const unsigned* elements = variables_->elements() + array.first;
    entries_[i + 1] = {array.first, array.size, scalars[elements[0]].kind, scalars[elements[0]].causality, false};
    for (unsigned j = 0; j < array.size; j++) places_[array.first + j] = cells_[elements[j]];
  }
}

// Reading. ------------------------------------------------------------------------------------------------------------

bool VariableAccess::get_reals(const Reference* references, size_t count, double* values, size_t size, Text& why) {
  if (!resolve_get(Type::real, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    const Cell* place = places_ + entry.first;
    for (unsigned j = 0; j < entry.size; j++) *values++ = as_real(place[j].address);
  }
  return true;
}

template <typename Integer>
bool VariableAccess::get_integers(Type type, const Reference* references, size_t count, Integer* values, size_t size,
                                  Text& why) {
  if (!resolve_get(type, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    const int first = entry.kind == Kind::enumeration ? 1 : 0;
    for (unsigned j = 0; j < entry.size; j++) *values++ = read_int(places_[entry.first + j].address) + first;
  }
  return true;
}

template <typename Boolean>
bool VariableAccess::get_booleans(const Reference* references, size_t count, Boolean* values, size_t size, Text& why) {
  if (!resolve_get(Type::boolean, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    for (unsigned j = 0; j < entry.size; j++) {
      *values++ = *static_cast<const bool*>(places_[entry.first + j].address) ? 1 : 0;
    }
  }
  return true;
}

bool VariableAccess::get_strings(const Reference* references, size_t count, const char** values, size_t size,
                                 Text& why) {
  if (!resolve_get(Type::string, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    for (unsigned j = 0; j < entry.size; j++) *values++ = as_string(places_[entry.first + j].address);
  }
  return true;
}

// Writing. ------------------------------------------------------------------------------------------------------------

bool VariableAccess::set_reals(const Reference* references, size_t count, const double* values, size_t size,
                               Text& why) {
  if (!resolve_set(Type::real, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    const Cell* place = places_ + entry.first;
    for (unsigned j = 0; j < entry.size; j++) {
      as_real(place[j].address) = *values++;
      note_set(place[j]);
    }
  }
  note_written();
  return true;
}

template <typename Integer>
bool VariableAccess::set_integers(Type type, const Reference* references, size_t count, const Integer* values,
                                  size_t size, Text& why) {
  if (!resolve_set(type, references, count, values, size, why)) return false;
  const Integer* next = values;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    for (unsigned j = 0; entry.kind == Kind::enumeration && j < entry.size; j++) {
      const Cell& place = places_[entry.first + j];
      if (next[j] < 1 || static_cast<uint64_t>(next[j]) > place.variable->item_count) {
        return refuse_item(place, next[j], why);
      }
    }
    next += entry.size;
  }
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    const int first = entry.kind == Kind::enumeration ? 1 : 0;
    for (unsigned j = 0; j < entry.size; j++) {
      write_int(places_[entry.first + j].address, static_cast<int>(*values++) - first);
    }
  }
  note_written();
  return true;
}

template <typename Boolean>
bool VariableAccess::set_booleans(const Reference* references, size_t count, const Boolean* values, size_t size,
                                  Text& why) {
  if (!resolve_set(Type::boolean, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    for (unsigned j = 0; j < entry.size; j++) {
      *static_cast<bool*>(places_[entry.first + j].address) = is_true(values++);
    }
  }
  note_written();
  return true;
}

bool VariableAccess::set_strings(const Reference* references, size_t count, const char* const* values, size_t size,
                                 Text& why) {
  if (!resolve_set(Type::string, references, count, values, size, why)) return false;
  for (size_t i = 0; i < size; i++) {
    if (values[i] == nullptr) {
      why << name() << ": a null pointer is not a string";
      return false;
    }
    if (strnlen(values[i], LONGEST_STRING) == LONGEST_STRING) {
      why << name() << ": a string has more than " << static_cast<long long>(LONGEST_STRING - 1)
          << " bytes, the longest that a variable can hold";
      return false;
    }
  }
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    for (unsigned j = 0; j < entry.size; j++) {  // the host may give back the very string that it got
      memmove(as_string(places_[entry.first + j].address), *values, strlen(*values) + 1);
      values++;
    }
  }
  note_written();
  return true;
}

// What may be asked for. ----------------------------------------------------------------------------------------------

bool VariableAccess::resolve(Type type, const Reference* references, size_t count, const void* values, size_t size,
                             Text& why) const {
  if (count > 0 && (references == nullptr || values == nullptr)) {
    why << name() << ": a null pointer in place of value references or values";
    return false;
  }
  size_t needed = 0;
  for (size_t i = 0; i < count; i++) {
    const Reference reference = references[i];
    if (reference >= entry_count_ || !is_of(entries_[reference].kind, type)) {
      return refuse_reference(reference, type_name(type), why);
    }
    needed += entries_[reference].size;
  }
  if (needed != size) {
    why << name() << ": " << static_cast<long long>(size) << " values for " << static_cast<long long>(needed)
        << " variables";
    return false;
  }
  return true;
}

bool VariableAccess::resolve_get(Type type, const Reference* references, size_t count, const void* values, size_t size,
                                 Text& why) {
  if (!resolve(type, references, count, values, size, why)) return false;
  if (!is_dirty_) return true;
  for (size_t i = 0; i < count; i++) {
    const Entry& entry = entries_[references[i]];
    if (entry.causality == Causality::output && !entry.is_time) return compute_outputs(why);
  }
  return true;
}

bool VariableAccess::resolve_set(Type type, const Reference* references, size_t count, const void* values, size_t size,
                                 Text& why) const {
  if (variables_->fmi() == 2 && references != nullptr) {  // as in Python: an output is refused as such first
    for (size_t i = 0; i < count; i++) {
      if (references[i] < entry_count_ && !check_settable(entries_[references[i]], why)) return false;
    }
  }
  if (!resolve(type, references, count, values, size, why)) return false;
  for (size_t i = 0; i < count; i++) {
    if (!check_settable(entries_[references[i]], why)) return false;
  }
  return true;
}

bool VariableAccess::check_settable(const Entry& entry, Text& why) const {
  if (entry.is_time) {
    why << name() << ": time (value reference 0) is the independent variable: it is only read";
    return false;
  }
  if (entry.causality == Causality::input || (entry.causality == Causality::parameter && !is_running_)) return true;
  const char* variable = places_[entry.first].variable->name;
  if (entry.causality == Causality::output) {
    why << name() << ": " << variable << " is an output and cannot be set";
  } else {
    why << name() << ": parameter " << variable << " is fixed since initialisation; reset to set it";
  }
  return false;
}

bool VariableAccess::refuse_reference(Reference reference, const char* called, Text& why) const {
  why << name() << ": ";
  if (reference >= entry_count_) {
    why << "value reference " << static_cast<long long>(reference) << " is unknown; it has 0 to "
        << static_cast<long long>(entry_count_) - 1;
  } else {
    why << name_of(reference) << " (value reference " << static_cast<long long>(reference) << ") is "
        << type_name(entries_[reference].kind) << ", not " << called;
  }
  return false;
}

bool VariableAccess::refuse_type(const char* called, const Reference* references, size_t count, Text& why) const {
  if (count == 0) return true;
  if (references != nullptr && references[0] < entry_count_) return refuse_reference(references[0], called, why);
  why << name() << " has no variables of type " << called;
  return false;
}

bool VariableAccess::refuse_item(const Cell& cell, long long value, Text& why) const {
  const Variable& variable = *cell.variable;
  why << name() << ": " << variable.name << " = " << value << " is not one of ";
  for (size_t i = 0; i < variable.item_count; i++) {
    why << (i == 0 ? "" : ", ") << static_cast<long long>(i + 1) << " (" << variable.items[i] << ")";
  }
  return false;
}

const char* VariableAccess::name_of(Reference reference) const {
  if (variables_->fmi() == 2) return variables_->scalars()[reference].name;
  return reference == 0 ? "time" : variables_->arrays()[reference - 1].name;
}

const char* VariableAccess::type_name(Kind kind) const {
  return (variables_->fmi() == 2 ? NAMES_FMI2 : NAMES_FMI3)[static_cast<unsigned char>(kind)];
}

const char* VariableAccess::type_name(Type type) const {
  return type_name(type == Type::integer_or_enumeration ? Kind::integer : static_cast<Kind>(type));
}

void VariableAccess::note_written() {
  if (!is_running_) is_dirty_ = true;
}

void VariableAccess::note_set(const Cell& cell) {
  bool& is_set = is_set_[cell.variable - variables_->scalars()];
  if (is_set || !model_->asks_for_inputs_set()) return;
  is_set = true;
  model_->note_input_set(cell.variable->path);
}

void VariableAccess::note_all_set() {
  model_->forget_inputs_set();
  for (size_t i = 0; i < variables_->scalar_count(); i++) {
    if (is_set_[i]) model_->note_input_set(cells_[i].variable->path);
  }
}

// As freshly made: what the FMU has start values of its own for was set.
void VariableAccess::forget_set() {
  for (size_t i = 0; i < variables_->scalar_count(); i++) {
    is_set_[i] = model_->asks_for_inputs_set() && cells_[i].variable->is_preset;
  }
  note_all_set();
}

// In time. ------------------------------------------------------------------------------------------------------------

bool VariableAccess::compute_outputs(Text& why) {
  if (!model_->initialise(why)) return false;
  ByteWriter parameters(parameters_, parameters_capacity_);
  put_values(parameters, true);
  parameters_size_ = parameters.size();
  is_read_ = true;
  is_dirty_ = false;
  return true;
}

bool VariableAccess::initialise(Text& why) {
  if (is_dirty_ && !compute_outputs(why)) return false;
  is_running_ = true;
  return true;
}

bool VariableAccess::step(double t, double h, Text& why) {
  if (!isfinite(t) || !isfinite(h) || !(h > 0.0)) {
    why << name() << ": no step from t = " << t << " s by " << h << " s: both must be finite and the step > 0";
    return false;
  }
  return model_->step(t, h, why);
}

void VariableAccess::reset() {
  ByteReader fresh(fresh_, fresh_size_);
  take_values(fresh, false);
  forget_set();
  model_->forget_files();
  parameters_size_ = 0;
  is_read_ = false;
  is_dirty_ = true;
  is_running_ = false;
}

// The whole state. ----------------------------------------------------------------------------------------------------

void VariableAccess::save(ByteWriter& bytes) const {
  bytes.value(is_dirty_);
  bytes.value(is_read_);
  bytes.value(static_cast<uint32_t>(parameters_size_));
  bytes.put(parameters_, parameters_size_);
  const size_t files = is_read_ ? model_->file_count() : 0;
  bytes.value(static_cast<uint32_t>(files * sizeof(uint32_t)));
  for (size_t i = 0; i < files; i++) bytes.value(model_->file(i).checksum);
  const size_t size = is_read_ ? model_->state_size() : 0;
  bytes.value(static_cast<uint32_t>(size));
  if (unsigned char* room = bytes.room(size); room != nullptr && size > 0) model_->get_state(room);
  put_values(bytes, false);
  bytes.put(is_set_, variables_->scalar_count());
}

bool VariableAccess::restore(ByteReader& bytes, bool is_running, Text& why) {
  ByteWriter counted;
  save(counted);
  unsigned char* before = static_cast<unsigned char*>(malloc(counted.size() + 1));
  if (before == nullptr) {
    why << name() << ": there is no memory to restore a state";
    return false;
  }
  ByteWriter written(before, counted.size());
  save(written);
  const bool was_running = is_running_, is_restored = write_all(bytes, is_running, true, why);
  if (!is_restored) {
    ByteReader again(before, counted.size());
    Text ignored;
    write_all(again, was_running, false, ignored);  // files of its own may have changed since, too
  }
  free(before);
  return is_restored;
}

bool VariableAccess::write_all(ByteReader& bytes, bool is_running, bool checks_files, Text& why) {
  bool is_dirty = true, is_read = false;
  uint32_t parameters_size = 0, files_size = 0, state_size = 0;
  bool is_right = bytes.flag(is_dirty) && bytes.flag(is_read) && bytes.value(parameters_size);
  is_right = is_right && (is_dirty ? !is_running : is_read);  // outputs follow from parameters that were read
  const unsigned char* parameters = is_right ? bytes.take(parameters_size) : nullptr;
  is_right = parameters != nullptr && parameters_size <= parameters_capacity_ && bytes.value(files_size);
  const unsigned char* files = is_right ? bytes.take(files_size) : nullptr;
  is_right = files != nullptr && bytes.value(state_size);
  const unsigned char* state = is_right ? bytes.take(state_size) : nullptr;
  if (state == nullptr) {
    why << name() << ": this saved state cannot be read";
    return false;
  }
  if (is_read) {
    if (!read_again(parameters, parameters_size, why) || (checks_files && !check_files(files, files_size, why)) ||
        !model_->set_state(state, state_size, why)) {
      return false;
    }
  }
  if (!take_values(bytes, false) || !take_set(bytes)) {
    why << name() << ": the values of this saved state cannot be read";
    return false;
  }
  is_read_ = is_read;
  if (!is_read) parameters_size_ = 0;
  is_dirty_ = is_dirty;
  is_running_ = is_running;
  return true;
}

bool VariableAccess::take_set(ByteReader& bytes) {
  for (size_t i = 0; i < variables_->scalar_count(); i++) {
    if (!bytes.flag(is_set_[i])) return false;
  }
  note_all_set();
  return true;
}

// What the model derives from its parameters is not in its state: it reads them again, with harmless inputs.
bool VariableAccess::read_again(const unsigned char* parameters, size_t size, Text& why) {
  const bool is_same = is_read_ && size == parameters_size_ && memcmp(parameters, parameters_, size) == 0;
  ByteReader fresh(fresh_, fresh_size_), read(parameters, size);
  if ((!is_same && !take_values(fresh, false)) || !take_values(read, true) || read.left() > 0) {
    why << name() << ": the parameters of this saved state cannot be read";
    return false;
  }
  return is_same || compute_outputs(why);
}

// Whether the model has read the files of these checksums.
bool VariableAccess::check_files(const unsigned char* checksums, size_t size, Text& why) const {
  if (size != model_->file_count() * sizeof(uint32_t)) {
    why << name() << ": the files of this saved state cannot be read";
    return false;
  }
  for (size_t i = 0; i < model_->file_count(); i++) {
    const ReadFile file = model_->file(i);
    if (memcmp(checksums + i * sizeof(uint32_t), &file.checksum, sizeof(uint32_t)) == 0) continue;
    why << name() << ": the file that ";
    if (file.ship != nullptr) why << file.ship << ".";
    why << file.parameter << " = ";
    why.quote(file.value) << " names is not that of the saved state: give the file of then, or initialise without "
                          << "this state";
    return false;
  }
  return true;
}

void VariableAccess::write_start_values() {
  for (size_t i = 0; i < variables_->scalar_count(); i++) {
    const Variable& variable = *cells_[i].variable;
    void* address = cells_[i].address;
    if (!variable.has_start) continue;
    switch (variable.kind) {
      case Kind::real: as_real(address) = variable.real_start; break;
      case Kind::integer: write_int(address, variable.whole_start); break;
      case Kind::boolean: *static_cast<bool*>(address) = variable.whole_start != 0; break;
      case Kind::enumeration: write_int(address, variable.whole_start - 1); break;
      case Kind::string: memcpy(address, variable.string_start, strlen(variable.string_start) + 1); break;
    }
  }
}

void VariableAccess::put_values(ByteWriter& bytes, bool parameters_alone) const {
  for (size_t i = 0; i < variables_->scalar_count(); i++) {
    const Variable& variable = *cells_[i].variable;
    const void* address = cells_[i].address;
    if (parameters_alone && variable.causality != Causality::parameter) continue;
    switch (variable.kind) {
      case Kind::real: bytes.put(address, sizeof(double)); break;
      case Kind::integer:
      case Kind::enumeration: bytes.put(address, sizeof(int)); break;
      case Kind::boolean: bytes.put(address, sizeof(bool)); break;
      case Kind::string: bytes.text(static_cast<const char*>(address)); break;
    }
  }
}

bool VariableAccess::take_values(ByteReader& bytes, bool parameters_alone) const {
  for (size_t i = 0; i < variables_->scalar_count(); i++) {
    const Variable& variable = *cells_[i].variable;
    void* address = cells_[i].address;
    if (parameters_alone && variable.causality != Causality::parameter) continue;
    int number = 0;
    switch (variable.kind) {
      case Kind::real:
        if (!bytes.value(as_real(address))) return false;
        break;
      case Kind::integer:
      case Kind::enumeration:
        if (!bytes.value(number)) return false;
        if (variable.kind == Kind::enumeration && (number < 0 || static_cast<size_t>(number) >= variable.item_count)) {
          return false;
        }
        write_int(address, number);
        break;
      case Kind::boolean:
        if (!bytes.flag(*static_cast<bool*>(address))) return false;
        break;
      case Kind::string:
        if (!bytes.text(as_string(address), LONGEST_STRING)) return false;
        break;
    }
  }
  return true;
}

// What the two versions of FMI ask for.
using Reference = VariableAccess::Reference;
template bool VariableAccess::get_integers(Type, const Reference*, size_t, int32_t*, size_t, Text&);
template bool VariableAccess::get_integers(Type, const Reference*, size_t, int64_t*, size_t, Text&);
template bool VariableAccess::set_integers(Type, const Reference*, size_t, const int32_t*, size_t, Text&);
template bool VariableAccess::set_integers(Type, const Reference*, size_t, const int64_t*, size_t, Text&);
template bool VariableAccess::get_booleans(const Reference*, size_t, int*, size_t, Text&);
template bool VariableAccess::get_booleans(const Reference*, size_t, bool*, size_t, Text&);
template bool VariableAccess::set_booleans(const Reference*, size_t, const int*, size_t, Text&);
template bool VariableAccess::set_booleans(const Reference*, size_t, const bool*, size_t, Text&);

}  // namespace shipcollision
