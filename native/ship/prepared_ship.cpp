#include "prepared_ship.hpp"

#include <string.h>

#include "../files.hpp"
#include "../folder.hpp"
#include "prepared_lines.hpp"

namespace shipcollision {
namespace {

constexpr PreparedKind KIND = {"shipcollision prepared ship ", "2", "prepared ship", "SHIP", "prepare the ship"};

constexpr char SUFFIX[] = ".ship";
constexpr size_t LONGEST_FOLDER = 4200;  // bytes; no system opens a path of more than 4096

bool ends_with(const char* text, const char* end) {
  const size_t size = strlen(text), length = strlen(end);
  return size >= length && strcmp(text + size - length, end) == 0;
}

struct Size {
  double L_pp, L_oa, B, T, mass, rho;
};

void read_body(PreparedLines& lines, PreparedShip& ship) {
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

void read_machines(PreparedLines& lines, PreparedShip& ship) {
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

bool read_prepared_ship(char* content, size_t size, const char* file, PreparedShip& ship, Text& why, HullMesh* hull) {
  why.clear();
  if (!check_prepared(KIND, content, size, file, ship.checksum, why)) return false;
  PreparedLines lines(content, size);
  read_body(lines, ship);
  read_machines(lines, ship);
  ship.hull_refusal.clear();
  if (hull != nullptr) lines.read_hull(*hull, &ship.hull_refusal);
  return lines.check(KIND, file, why);
}

namespace {

bool is_path(const char* text) {
  return ends_with(text, SUFFIX) || ends_with(text, ".toml") || strpbrk(text, "/\\") != nullptr;
}

bool load_by_path(const char* path, const char* directory, PreparedShip& ship, Text& why, HullMesh* hull) {
  FileContent content;
  const bool is_below = directory[0] != '\0' && !is_absolute(path);
  if (read_prepared_file(path, directory, content)) {
    return read_prepared_ship(content.data(), content.size(), path, ship, why, hull);
  }
  if (is_prepared_folder(path, directory)) {
    why << "ship file " << path << " is a folder: give the path of a prepared ship";
    return false;
  }
  why << "ship file " << path << " does not exist or cannot be read: give the path of a prepared ship";
  if (!is_absolute(path)) {
    why << " (looked for in ";
    if (is_below) why << directory << " and ";
    why << "the current folder)";
  }
  return false;
}

bool load_by_name(const char* name, const char* directory, PreparedShip& ship, Text& why, HullMesh* hull) {
  char folder[LONGEST_FOLDER];
  Text file, names;
  FileContent content;
  file << name << SUFFIX;
  const size_t size = strnlen(directory, sizeof folder - sizeof "/ships");
  memcpy(folder, directory, size);
  strcpy(folder + size, size == 0 ? "ships" : "/ships");
  if (read_below(folder, name, SUFFIX, content)) {
    return read_prepared_ship(content.data(), content.size(), file.get(), ship, why, hull);
  }
  why << "unknown ship ";
  why.quote(name) << ":";
  list_folder(folder, SUFFIX, names);
  if (!names.is_empty()) why << " known: " << names << "; or";
  why << " give the path of a prepared ship, which `shipcollision prepare SHIP` writes";
  return false;
}

}  // namespace

bool load_prepared_ship(const char* name_or_path, const char* directory, PreparedShip& ship, Text& why,
                        HullMesh* hull) {
  why.clear();
  if (name_or_path[0] == '\0') {
    why << "ship = '' is no ship: give a name or the path of a prepared ship";
    return false;
  }
  if (ends_with(name_or_path, ".toml")) {
    const char* quotes = strpbrk(name_or_path, " \t&;()'") == nullptr ? "" : "\"";
    why << "ship file " << name_or_path << ": a native FMU reads no TOML; write a prepared ship with `shipcollision "
        << "prepare " << quotes << name_or_path << quotes << "` and give its path";
    return false;
  }
  return is_path(name_or_path) ? load_by_path(name_or_path, directory, ship, why, hull)
                               : load_by_name(name_or_path, directory, ship, why, hull);
}

}  // namespace shipcollision
