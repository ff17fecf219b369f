// A ship as `shipcollision prepare` writes it: reads what shipcollision_fmu/manoeuvring/prepared_ship.py writes.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "../memory.hpp"
#include "../numbers/text.hpp"
#include "degrees_of_freedom.hpp"
#include "frames.hpp"
#include "hull/solid.hpp"
#include "seakeeping.hpp"
#include "tables.hpp"
#include "windage.hpp"

namespace shipcollision {

constexpr int SERIES_PER_DEGREE = 4;
constexpr int SERIES_ENTRIES = 360 * SERIES_PER_DEGREE + 1;
constexpr int TORQUE_WIDEST = 8;
constexpr int TORQUE_PER_UNIT = 8;
constexpr int TORQUE_ENTRIES = 2 * TORQUE_WIDEST * TORQUE_PER_UNIT + 1;

// Limits of the revolutions by the engine's torque, as tabulated by manoeuvring/torque_limit.py.
struct TorqueTable {
  double root, per_speed;
  double most[TORQUE_ENTRIES], least[TORQUE_ENTRIES];
};

// All numbers of a ship. What the ship does not have is left as it was, and has_... is false.
struct PreparedShip : OnHeap {
  Text name;     // in quotes, as messages have it
  Text warning;  // what is suspicious
  double L_pp, L_oa, B, T, mass, rho;
  Three r_bg;
  Matrix M, M_A, inverse_3, inverse_4, inverse_6;
  Windage windage;
  Text seakeeping_refusal;  // why there is no seakeeping
  Seakeeping seakeeping;
  bool has_manoeuvring, has_propeller, has_series, has_torque, has_rudder, has_engine;
  ManoeuvringTable manoeuvring;
  PropellerTable propeller;
  Text series_refusal;  // why there is no series
  double series[SERIES_ENTRIES];
  TorqueTable torque;
  RudderTable rudder;
  EngineTable engine;
  Text hull_refusal;  // why there is no hull, where it was asked for
  uint32_t checksum;  // of its file

  // Inverse of the free block of M; degrees_of_freedom: 3, 4 or 6.
  const Matrix& inverse(int degrees_of_freedom) const {
    return degrees_of_freedom == 3 ? inverse_3 : degrees_of_freedom == 4 ? inverse_4 : inverse_6;
  }
};

// Reads the content of a prepared file, which ends with a zero after `size` bytes and is changed. `file` names it in
// messages. False for a file that is damaged, of another kind or of another version; the ship is then of no use.
// hull: null where it is of no interest.
bool read_prepared_ship(char* content, size_t size, const char* file, PreparedShip& ship, Text& why,
                        HullMesh* hull = nullptr);

// Reads a ship by its name among those in `directory`/ships, or by the path of its file: text with the suffix .ship or
// a path separator. A relative path is looked for in `directory`, then in the current folder.
bool load_prepared_ship(const char* name_or_path, const char* directory, PreparedShip& ship, Text& why,
                        HullMesh* hull = nullptr);

}  // namespace shipcollision
