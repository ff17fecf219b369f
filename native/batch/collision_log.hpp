// The collisions of an encounter, from the contact points of each step: the numbers of events.json, as
// shipcollision_fmu/results/collision_events.py and velocity_gains.py compute them.
#pragma once

#include <stdint.h>

#include "../collision/interface.hpp"

namespace shipcollision {

// What Python reads: see shipcollision_fmu/batch/encounter_columns.py. Bodies are numbered from 1, ships first.
struct CollisionRow {
  int32_t number, ship_a, ship_b, contacts;
  double start, end;
  Three point, a_point, b_point, relative_velocity;
  double closing_speed, angle;
  Three impulse;
  double energy;
  Six a_before, a_after, b_before, b_after;
  Three a_gain, b_gain;
};

// A ship, as the log needs it: its degrees of freedom, and the inverse of its inertia while it is upright.
struct LoggedShip {
  int degrees_of_freedom;
  Matrix inverse;
};

class CollisionLog {
 public:
  explicit CollisionLog(Memory& memory)
      : ships_(memory), headings_(memory), rows_(memory), openings_(memory), issued_(memory) {}

  // headings [rad]: of the obstacles. delay: steps after which a ship has applied an impulse.
  void begin(const LoggedShip* ships, int ship_count, const double* headings, int obstacle_count, int delay);
  // The contact points of step k, of H [s] from t [s]; without any it need not be called. before: states of the ships
  // at its start.
  void add(int k, double t, double H, const ShipState* before, const CollisionOutputs& outputs);
  // The states of the ships after step k.
  void follow(int k, const ShipState* after);

  const Buffer<CollisionRow>& rows() const { return rows_; }

 private:
  // Steps in which a collision began and last had contact; the largest impulse in the first of them.
  struct Opening {
    int first, last;
    double strongest;
    bool is_b_ship;
  };

  bool is_ship(int body) const { return body <= ships_.size(); }
  CollisionRow* open(const ContactOutput& contact, int k, const ShipState* before);
  void begin_at(const ContactOutput& contact, double t, const ShipState* before, CollisionRow& row) const;
  void add_gains(const ShipState* before, const CollisionOutputs& outputs);
  void add_gain(int ship, int number, const Three& gain);
  Three find_gain(int ship, const ShipState& state, const Six& wrench) const;

  Buffer<LoggedShip> ships_;
  Buffer<double> headings_;
  Buffer<CollisionRow> rows_;
  Buffer<Opening> openings_;  // of each row
  Buffer<Six> issued_;        // after the last step with contact
  int delay_ = 0;
};

}  // namespace shipcollision
