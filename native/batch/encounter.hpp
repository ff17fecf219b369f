// Whole encounters: the master's loop over the ship models and the collision model, in one call.
//
// The loop is that of shipcollision_fmu/cosim/master.py and simulate.py, and so are the numbers.
#pragma once

#include <stdint.h>

#include "../collision/model.hpp"
#include "../manoeuvring/model.hpp"
#include "collision_log.hpp"
#include "helm.hpp"

namespace shipcollision {

// A ship, as Python fills it. file: prepared; coasting, predicted_coasting: numbers of Coasting, for the ship and for
// what the collision model expects of it; fender: stiffness, damping, thickness; start: the 12 states.
struct EncounterShip {
  const char* name;
  const char* file;
  int32_t degrees_of_freedom, hydrodynamics, coasting, predicted_coasting;
  double fender[3];
  double start[12];
  double inverse[36];
  HelmTable helm;
};

// An encounter, as Python fills it. surroundings: current (north, east), wind speed and direction; obstacles: the path
// of a prepared file, empty for none; separation: seconds without contact after which it ends, negative for never.
struct EncounterCase {
  const EncounterShip* ships;
  const char* obstacles;
  const double* headings;  // of the obstacles [rad]
  int32_t ship_count, obstacle_count;
  double surroundings[4];
  double friction, restitution, substep, minimum_separation_time, clearance_range;
  int32_t response, feedback, is_parallel, steps;
  double step, separation;
};

enum class EncounterStatus : int32_t { done, refused };

constexpr size_t LONGEST_WORDS = 240;

// What Python reads: see shipcollision_fmu/batch/encounter_columns.py.
struct EncounterRow {
  EncounterStatus status;
  int32_t steps, collisions, unconverged, scaled, nearest_a, nearest_b, unused;
  double time, clearance;
  double energy, energy_normal, energy_tangential, fender_stored, fender_dissipated;
  char reason[LONGEST_WORDS], warning[LONGEST_WORDS];
};

struct ShipRow {
  double start[12], end[12];
  Six issued, applied;
};

class Encounters : public OnHeap {
 public:
  Encounters() = default;
  ~Encounters();
  Encounters(const Encounters&) = delete;
  Encounters& operator=(const Encounters&) = delete;

  // Runs one encounter. ships: a row for each; track: 12 numbers of each ship at each communication point, null where
  // it is of no interest. Of a refused one, row and ships hold what was so far. Models are kept for the next encounter
  // of ships of the same names.
  void run(const EncounterCase& given, EncounterRow& row, ShipRow* ships, double* track);

  const Buffer<CollisionRow>& collisions() const { return log_.rows(); }

 private:
  bool has_models(const EncounterCase& given) const;
  bool make_models(const EncounterCase& given, Text& why);
  void clear();
  bool initialise(const EncounterCase& given, Text& why);
  bool initialise_ship(const EncounterCase& given, int i, Text& why);
  bool set_up_collision(const EncounterCase& given, Text& why);
  bool step(const EncounterCase& given, int k, EncounterRow& row, Text& why);
  bool step_collision(double t, double h, EncounterRow& row, Text& why);
  bool step_ships(double t, double h, EncounterRow& row, Text& why);
  void send_impulses(const EncounterCase& given);
  void fetch_states();
  void record(int k, EncounterRow& row, double* track);
  void warn(const char* name, const Text& warning, EncounterRow& row) const;
  bool is_over(const EncounterCase& given, int k) const;
  void fill(EncounterRow& row, ShipRow* ships) const;

  Memory memory_;
  ShipCollision* collision_ = nullptr;
  Buffer<ShipManoeuvring*> ships_{memory_};
  Buffer<Helm> helms_{memory_};
  Buffer<ShipState> states_{memory_};  // as received from the ships
  Buffer<ShipState> before_{memory_};  // at the start of the step
  Buffer<ShipState> starts_{memory_};
  Buffer<LoggedShip> logged_{memory_};
  CollisionLog log_{memory_};
  int last_contact_ = -1;  // communication point after the last step with contact
};

}  // namespace shipcollision
