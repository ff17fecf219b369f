#include "variables.hpp"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "../manoeuvring/interface.hpp"
#include "../numbers/crc32.hpp"

namespace shipcollision {

namespace {

// Bytes of the file; the largest table, of a collision between dozens of ships, has some hundred thousand.
constexpr size_t LARGEST_FILE = 1 << 24;
constexpr size_t DIGEST_SIZE = 15;   // "crc32 0123abcd\n"
constexpr size_t SHORTEST_LINE = 8;  // bytes of a line of the table: bounds what a false count can ask for

const char* const KINDS[] = {"Real", "Integer", "Boolean", "String", "Enumeration"};
const char* const CAUSALITIES[] = {"parameter", "input", "output"};
const char* const VARIABILITIES[] = {"fixed", "continuous", "discrete"};
const char* const TRUTHS[] = {"false", "true"};

bool read_int(LineReader& lines, long long least, long long most, int& number) {
  long long read;
  if (!lines.whole(read) || read < least || read > most) return false;
  number = static_cast<int>(read);
  return true;
}

// A limit, which nothing here needs, or a minus sign in its place.
bool pass_limit(LineReader& lines) {
  double real;
  long long whole;
  return lines.word("-") || lines.whole(whole) || lines.real(real);
}

bool read_text(LineReader& lines, const char* key, const char*& text) {
  return lines.next_line() && lines.word(key) && lines.text(text) && lines.is_end_of_line();
}

bool read_count(LineReader& lines, const char* key, int most, int& count) {
  return lines.next_line() && lines.word(key) && read_int(lines, 0, most, count) && lines.is_end_of_line();
}

bool refuse_memory(Text& why) {
  why << " (there is no memory for it)";
  return false;
}

}  // namespace

Variables::~Variables() {
  free(ships_);
  free(scalars_);
  free(items_);
  free(arrays_);
  free(elements_);
}

bool Variables::read(const char* path, Text& why) {
  if (!file_.read(path, LARGEST_FILE, why)) {
    why << "; the host must pass the folder `resources` of the unpacked FMU";
    return false;
  }
  size_t size = file_.size();
  LineReader first(file_.data(), size);
  if (strncmp(file_.data(), "shipcollision variables ", 24) == 0 && has_other_line_ends(file_.data())) {
    why << path << " is damaged: its line ends were changed, as git and editors of Windows do; unpack the FMU again";
    return false;
  }
  int version;
  if (!first.next_line() || !first.word("shipcollision") || !first.word("variables") ||
      !read_int(first, 1, INT_MAX, version)) {
    why << path << " is not the table of variables of an FMU: unpack the FMU again";
    return false;
  }
  if (version != 2) {
    why << path << " has version " << version
        << " of its format, and this library reads version 2: build the FMU again";
    return false;
  }
  if (!confirm_digest(size)) {
    why << path << " is damaged: unpack the FMU again";
    return false;
  }
  LineReader lines(file_.data(), size);
  Text reason;
  if (!read_lines(lines, reason)) {
    why << path << ", line " << lines.line() << ", cannot be read" << reason << ": build the FMU again";
    return false;
  }
  return true;
}

// Whether the last line is the digest of all before, which is `size` bytes then.
bool Variables::confirm_digest(size_t& size) const {
  FileContent& file = const_cast<FileContent&>(file_);
  if (size < DIGEST_SIZE || memchr(file.data(), '\0', size) != nullptr) return false;
  const char* last = file.data() + size - DIGEST_SIZE;
  if (memcmp(last, "crc32 ", 6) != 0 || last[DIGEST_SIZE - 1] != '\n' || (last > file.data() && last[-1] != '\n')) {
    return false;
  }
  unsigned long digest = 0;
  for (int i = 6; i < 14; i++) {
    const char c = last[i];
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'))) return false;
    digest = digest << 4 | static_cast<unsigned long>(c <= '9' ? c - '0' : c - 'a' + 10);
  }
  size -= DIGEST_SIZE;
  return crc32(file.data(), size) == digest;
}

bool Variables::read_lines(LineReader& lines, Text& why) {
  ships_ = static_cast<const char**>(calloc(count_texts() + 1, sizeof(const char*)));
  if (ships_ == nullptr) return refuse_memory(why);
  if (!read_head(lines, why)) return false;
  const int most = static_cast<int>(file_.size() / SHORTEST_LINE);
  int count;
  if (!read_count(lines, "scalars", most, count)) return false;
  if (!allocate(static_cast<size_t>(count))) return refuse_memory(why);
  for (; scalar_count_ < static_cast<unsigned>(count); scalar_count_++) {
    if (!lines.next_line() || !read_scalar(lines, scalars_[scalar_count_]) || !lines.is_end_of_line()) return false;
  }
  if (!read_presets(lines)) return false;
  int arrays;
  if (!read_count(lines, "references", count, arrays)) return false;
  for (; array_count_ < static_cast<unsigned>(arrays); array_count_++) {
    if (!lines.next_line() || !read_array(lines, arrays_[array_count_])) return false;
  }
  return !lines.next_line();
}

bool Variables::read_head(LineReader& lines, Text& why) {
  if (!lines.next_line()) return false;  // its words were read before
  if (!read_text(lines, "fmu", fmu_)) return false;
  if (!lines.next_line() || !lines.word("fmi") || !read_int(lines, 2, 3, fmi_) || !lines.is_end_of_line()) {
    why << " (FMI 2 or 3)";
    return false;
  }
  return read_text(lines, "tag", tag_) && read_text(lines, "build", build_) && read_text(lines, "token", token_) &&
         read_ships(lines);
}

bool Variables::read_ships(LineReader& lines) {
  if (!lines.next_line() || !lines.word("ships")) return false;
  while (!lines.is_end_of_line()) {
    if (!lines.text(ships_[ship_count_])) return false;
    ship_count_++;
  }
  return true;
}

// No more texts than that are in the file.
size_t Variables::count_texts() {
  size_t quotes = 0;
  for (size_t i = 0; i < file_.size(); i++) quotes += file_.data()[i] == '"' ? 1 : 0;
  return quotes / 2;
}

bool Variables::allocate(size_t scalars) {
  scalars_ = static_cast<Variable*>(calloc(scalars + 1, sizeof(Variable)));
  arrays_ = static_cast<ArrayVariable*>(calloc(scalars + 1, sizeof(ArrayVariable)));
  elements_ = static_cast<unsigned*>(calloc(scalars + 1, sizeof(unsigned)));
  items_ = static_cast<const char**>(calloc(count_texts() + 1, sizeof(const char*)));
  return scalars_ != nullptr && arrays_ != nullptr && elements_ != nullptr && items_ != nullptr;
}

bool Variables::read_scalar(LineReader& lines, Variable& scalar) {
  size_t kind, causality, variability;
  if (!lines.one_of(KINDS, 5, kind) || !lines.one_of(CAUSALITIES, 3, causality) ||
      !lines.one_of(VARIABILITIES, 3, variability) || !lines.text(scalar.name) || !lines.text(scalar.path)) {
    return false;
  }
  scalar.kind = static_cast<Kind>(kind);
  scalar.causality = static_cast<Causality>(causality);
  scalar.index = -1;
  if (!lines.word("-") && !read_int(lines, 0, INT_MAX, scalar.index)) return false;
  return read_start(lines, scalar) && pass_limit(lines) && pass_limit(lines) && read_items(lines, scalar);
}

bool Variables::read_start(LineReader& lines, Variable& scalar) {
  scalar.has_start = false;
  scalar.string_start = "";
  if (lines.word("-")) return true;
  scalar.has_start = true;
  size_t truth;
  switch (scalar.kind) {
    case Kind::real: return lines.real(scalar.real_start);
    case Kind::integer: return read_int(lines, INT_MIN, INT_MAX, scalar.whole_start);
    case Kind::enumeration: return read_int(lines, 1, INT_MAX, scalar.whole_start);
    case Kind::string: return lines.text(scalar.string_start) && strlen(scalar.string_start) < LONGEST_STRING;
    case Kind::boolean: break;
  }
  if (!lines.one_of(TRUTHS, 2, truth)) return false;
  scalar.whole_start = static_cast<int>(truth);
  return true;
}

bool Variables::read_items(LineReader& lines, Variable& scalar) {
  scalar.items = items_ + item_count_;
  scalar.item_count = 0;
  while (!lines.is_end_of_line()) {
    if (!lines.text(items_[item_count_])) return false;
    item_count_++;
    scalar.item_count++;
  }
  if (scalar.kind != Kind::enumeration) return scalar.item_count == 0;
  return scalar.item_count > 0 && (!scalar.has_start || static_cast<size_t>(scalar.whole_start) <= scalar.item_count);
}

bool Variables::read_presets(LineReader& lines) {
  if (!lines.next_line() || !lines.word("presets")) return false;
  while (!lines.is_end_of_line()) {
    int scalar;
    if (!read_int(lines, 0, static_cast<long long>(scalar_count_) - 1, scalar)) return false;
    scalars_[scalar].is_preset = true;
  }
  return true;
}

// The elements are different scalars of one kind and causality.
bool Variables::read_array(LineReader& lines, ArrayVariable& array) {
  if (!lines.text(array.name)) return false;
  array.first = element_count_;
  array.size = 0;
  while (!lines.is_end_of_line()) {
    int scalar;
    if (element_count_ == scalar_count_ || !read_int(lines, 0, static_cast<long long>(scalar_count_) - 1, scalar)) {
      return false;
    }
    elements_[element_count_++] = static_cast<unsigned>(scalar);
    array.size++;
    const Variable &first = scalars_[elements_[array.first]], &last = scalars_[scalar];
    if (last.kind != first.kind || last.causality != first.causality) return false;
  }
  return array.size > 0;
}

Model* refuse_model(const Variables& variables, Text& why) {
  why << "this library cannot make the model " << variables.fmu() << ": build the FMU again";
  return nullptr;
}

}  // namespace shipcollision
