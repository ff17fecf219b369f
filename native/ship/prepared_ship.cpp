#include "prepared_ship.hpp"

#include <stdint.h>
#include <string.h>

#include "../files.hpp"
#include "../folder.hpp"
#include "../numbers/crc32.hpp"
#include "../numbers/elementary.hpp"
#include "../numbers/line_reader.hpp"

namespace shipcollision {
namespace {

constexpr char FORMAT[] = "shipcollision prepared ship ";
constexpr char VERSION[] = "1";
constexpr size_t LONGEST_FILE = size_t{64} << 20;  // bytes; a hull of ten thousand vertices has one million

constexpr char SUFFIX[] = ".ship";
constexpr size_t LONGEST_FOLDER = 4200, LONGEST_PATH = 4400;  // bytes; no system opens a path of more than 4096

constexpr char CHECKSUM[] = "crc32 ";
constexpr size_t LAST_LINE = sizeof CHECKSUM - 1 + 8 + 1;  // eight digits and the end of the line

bool starts_with(const char* text, const char* begin) { return strncmp(text, begin, strlen(begin)) == 0; }

bool ends_with(const char* text, const char* end) {
  const size_t size = strlen(text), length = strlen(end);
  return size >= length && strcmp(text + size - length, end) == 0;
}

// Reads line by line what prepared_ship.py has written; after a line that is not as expected, nothing more.
class Lines {
 public:
  Lines(char* content, size_t size) : reader_(content, size) { reader_.next_line(); }

  bool is_good() const { return expected_ == nullptr; }
  // The key that was expected in the line that is wrong, and the number of that line.
  const char* expected() const { return expected_; }
  int number() const { return number_; }
  void refuse(const char* key) { expected_ = key; }

  void read_text(const char* key, Text& text) {
    if (begin(key) && !take_text(text)) refuse(key);
  }

  template <typename Numbers>
  void read(const char* key, Numbers& numbers) {
    if (begin(key) && !take_numbers(numbers)) refuse(key);
  }

  // The same of what a ship need not have: its numbers, `none`, or `refused` and a text where there is room for one.
  template <typename Numbers>
  bool read_if_there(const char* key, Numbers& numbers, Text* refusal = nullptr) {
    if (!begin(key)) return false;
    if (reader_.word("none")) {
      if (!reader_.is_end_of_line()) refuse(key);
      return false;
    }
    if (refusal != nullptr && reader_.word("refused")) {
      if (!take_text(*refusal) || refusal->is_empty()) refuse(key);
      return false;
    }
    const bool is_read = take_numbers(numbers);
    if (!is_read) refuse(key);
    return is_read;
  }

 private:
  // Goes to the first value of the next line, which must have this key.
  bool begin(const char* key) {
    if (!is_good()) return false;
    ++number_;
    if (reader_.next_line() && reader_.word(key)) return true;
    refuse(key);
    return false;
  }

  template <typename Numbers>
  bool take_numbers(Numbers& numbers) {
    static_assert(sizeof numbers % sizeof(double) == 0, "real numbers alone");
    char* into = reinterpret_cast<char*>(&numbers);
    for (size_t i = 0; i < sizeof numbers; i += sizeof(double)) {
      double number;
      if (!reader_.real(number) || !isfinite(number)) return false;
      memcpy(into + i, &number, sizeof number);
    }
    return reader_.is_end_of_line();
  }

  bool take_text(Text& text) {
    const char* words;
    text.clear();
    if (!reader_.text(words)) return false;
    text << words;
    return reader_.is_end_of_line();
  }

  LineReader reader_;
  int number_ = 1;
  const char* expected_ = nullptr;
};

bool check_first_line(const char* content, size_t size, const char* file, Text& why) {
  const size_t length = sizeof FORMAT - 1;
  if (size < length || !starts_with(content, FORMAT)) {
    why << file << " is no prepared ship: write one with `shipcollision prepare SHIP`";
    return false;
  }
  const char* version = content + length;
  size_t digits = 0;
  while (version[digits] >= '0' && version[digits] <= '9' && digits < 6) ++digits;
  if (version[digits] == '\n' && digits > 0 && !(digits == strlen(VERSION) && starts_with(version, VERSION))) {
    why << file << " is a prepared ship of version ";
    for (size_t i = 0; i < digits; ++i) {
      const char digit[2] = {version[i], '\0'};
      why << digit;
    }
    why << ", this FMU reads version " << VERSION
        << ": prepare the ship with the shipcollision that built the FMU, or build the FMU again";
    return false;
  }
  return true;
}

void put_checksum(Text& text, uint32_t checksum) {
  for (int shift = 28; shift >= 0; shift -= 4) {
    const char digit[2] = {"0123456789abcdef"[checksum >> shift & 15], '\0'};
    text << digit;
  }
}

bool check_checksum(const char* content, size_t size, const char* file, Text& why) {
  const bool is_long_enough = size > LAST_LINE && content[size - LAST_LINE - 1] == '\n';
  const char* last = is_long_enough ? content + size - LAST_LINE : content;
  if (!is_long_enough || !starts_with(last, CHECKSUM)) {
    why << file << " is damaged: its last line must be its checksum, `crc32` and eight digits; prepare the ship again";
    return false;
  }
  Text computed, stated;
  put_checksum(computed, crc32(content, size - LAST_LINE));
  for (size_t i = 0; i < 8; ++i) {
    const char digit[2] = {last[sizeof CHECKSUM - 1 + i], '\0'};
    stated << digit;
  }
  if (strcmp(computed.get(), stated.get()) != 0 || last[LAST_LINE - 1] != '\n') {
    why << file << " is damaged: its checksum is " << computed << ", must be ";
    why.quote(stated.get()) << "; prepare the ship again";
    return false;
  }
  return true;
}

struct Size {
  double L_pp, L_oa, B, T, mass, rho;
};

void read_body(Lines& lines, PreparedShip& ship) {
  Size size{};
  lines.read_text("name", ship.name);
  lines.read_text("warning", ship.warning);
  lines.read("size", size);
  lines.read("r_bg", ship.r_bg);
  lines.read("M", ship.M);
  lines.read("M_A", ship.M_A);
  lines.read("inverse_3", ship.inverse_3);
  lines.read("inverse_4", ship.inverse_4);
  lines.read("inverse_6", ship.inverse_6);
  lines.read("windage", ship.windage);
  ship.seakeeping_refusal.clear();
  lines.read_if_there("seakeeping", ship.seakeeping, &ship.seakeeping_refusal);
  ship.L_pp = size.L_pp;
  ship.L_oa = size.L_oa;
  ship.B = size.B;
  ship.T = size.T;
  ship.mass = size.mass;
  ship.rho = size.rho;
}

void read_machines(Lines& lines, PreparedShip& ship) {
  double root_and_per_speed[2] = {};
  ship.series_refusal.clear();
  ship.has_torque = false;
  ship.has_manoeuvring = lines.read_if_there("manoeuvring", ship.manoeuvring);
  ship.has_propeller = lines.read_if_there("propeller", ship.propeller);
  ship.has_series = lines.read_if_there("series", ship.series, &ship.series_refusal);
  if (ship.has_propeller != (ship.has_series || !ship.series_refusal.is_empty())) lines.refuse("series");
  if (ship.series_refusal.is_empty() && lines.read_if_there("torque", root_and_per_speed)) {
    lines.read("most", ship.torque.most);
    lines.read("least", ship.torque.least);
    ship.torque.root = root_and_per_speed[0];
    ship.torque.per_speed = root_and_per_speed[1];
    ship.has_torque = true;
  }
  ship.has_rudder = lines.read_if_there("rudder", ship.rudder);
  ship.has_engine = lines.read_if_there("engine", ship.engine);
}

}  // namespace

bool read_prepared_ship(char* content, size_t size, const char* file, PreparedShip& ship, Text& why) {
  why.clear();
  if (!check_first_line(content, size, file, why) || !check_checksum(content, size, file, why)) return false;
  Lines lines(content, size - LAST_LINE);
  read_body(lines, ship);
  read_machines(lines, ship);
  if (!lines.is_good()) {
    why << file << " is damaged: line " << lines.number() << " must be the key ";
    why.quote(lines.expected()) << " with its values; prepare the ship again";
    return false;
  }
  return true;
}

namespace {

bool is_path(const char* text) {
  return ends_with(text, SUFFIX) || ends_with(text, ".toml") || strpbrk(text, "/\\") != nullptr;
}

bool is_absolute(const char* path) {
  return path[0] == '/' || path[0] == '\\' || (path[0] != '\0' && path[1] == ':');
}

// Reads FOLDER/NAME SUFFIX; false for one that cannot be read, or whose path is too long.
bool read_below(const char* folder, const char* name, const char* suffix, FileContent& content) {
  char path[LONGEST_PATH];
  Text unread;
  const char* const parts[] = {folder, folder[0] == '\0' || ends_with(folder, "/") ? "" : "/", name, suffix};
  size_t size = 0;
  for (const char* part : parts) {
    const size_t more = strlen(part);
    if (size + more >= sizeof path) return false;
    memcpy(path + size, part, more);
    size += more;
  }
  path[size] = '\0';
  return content.read(path, LONGEST_FILE, unread);
}

bool load_by_path(const char* path, const char* directory, PreparedShip& ship, Text& why) {
  FileContent content;
  const bool is_below = directory[0] != '\0' && !is_absolute(path);
  if ((is_below && read_below(directory, path, "", content)) || read_below("", path, "", content)) {
    return read_prepared_ship(content.data(), content.size(), path, ship, why);
  }
  why << "ship file " << path << " does not exist or cannot be read: give the path of a prepared ship";
  if (!is_absolute(path)) {
    why << " (looked for in ";
    if (is_below) why << directory << " and ";
    why << "the current folder)";
  }
  return false;
}

bool load_by_name(const char* name, const char* directory, PreparedShip& ship, Text& why) {
  char folder[LONGEST_FOLDER];
  Text file, names;
  FileContent content;
  file << name << SUFFIX;
  const size_t size = strnlen(directory, sizeof folder - sizeof "/ships");
  memcpy(folder, directory, size);
  strcpy(folder + size, size == 0 ? "ships" : "/ships");
  if (read_below(folder, name, SUFFIX, content)) {
    return read_prepared_ship(content.data(), content.size(), file.get(), ship, why);
  }
  why << "unknown ship ";
  why.quote(name) << ":";
  list_folder(folder, SUFFIX, names);
  if (!names.is_empty()) why << " known: " << names << "; or";
  why << " give the path of a prepared ship, which `shipcollision prepare SHIP` writes";
  return false;
}

}  // namespace

bool load_prepared_ship(const char* name_or_path, const char* directory, PreparedShip& ship, Text& why) {
  why.clear();
  if (name_or_path[0] == '\0') {
    why << "ship = '' is no ship: give a name or the path of a prepared ship";
    return false;
  }
  if (ends_with(name_or_path, ".toml")) {
    why << "ship file " << name_or_path << ": a native FMU reads no TOML; write a prepared ship with `shipcollision "
        << "prepare " << name_or_path << "` and give its path";
    return false;
  }
  return is_path(name_or_path) ? load_by_path(name_or_path, directory, ship, why)
                               : load_by_name(name_or_path, directory, ship, why);
}

}  // namespace shipcollision
