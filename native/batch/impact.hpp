// Impacts alone: two ships are placed so that they just touch, and the collision model answers the contact.
//
// Each case is one step of the collision model, of INSTANT, from the model's first state. Nothing is left of the case
// before, so that the rows are the same in any order.
#pragma once

#include <stdint.h>

#include "../collision/model.hpp"
#include "plan_contact.hpp"

namespace shipcollision {

// A case, as Python fills it. angle_deg, at: as for an encounter; speeds in b [m/s], yaw rates [rad/s]; heading_deg of
// the target.
struct ImpactCase {
  double angle_deg, at;
  double own_speed, own_sway, own_yaw_rate;
  double target_speed, target_sway, target_yaw_rate;
  double heading_deg;
  double friction, restitution;
  int32_t is_starboard, unused;
};

enum class ImpactStatus : int32_t { done, out_of_range, not_closing, no_contact, refused };

constexpr size_t LONGEST_REASON = 240;

// What Python reads: see shipcollision_fmu/batch/impact_columns.py.
struct ImpactRow {
  ImpactStatus status;
  int32_t contacts;
  Three own_position, target_position;
  double own_heading, target_heading;
  Three point, own_point, target_point, normal;
  Six own_before, own_after, target_before, target_after;
  Six own_impulse, target_impulse;
  Three impulse;
  double impulse_normal, impulse_tangential;
  Three relative_velocity;
  double closing_speed, angle;
  double energy, energy_normal, energy_tangential;
  double offset, residual;
  char reason[LONGEST_REASON];
};

// A ship: its prepared file, degrees of freedom, length over all, the middle of it forward of CO [m], and its section
// at the height of contact.
struct ImpactShip {
  const char* file;
  int degrees_of_freedom;
  double L_oa, middle;
  const InPlan* section;
  int corner_count;
};

class Impacts : public OnHeap {
 public:
  // To be called once, before run().
  bool prepare(const ImpactShip& own, const ImpactShip& target, Text& why);

  // A row for each case; of a case that is refused, the status and the reason alone.
  void run(const ImpactCase* cases, size_t count, ImpactRow* rows);

 private:
  struct Placed;

  bool is_ready(const ImpactShip& own, const ImpactShip& target);
  ImpactStatus answer(const ImpactCase& given, ImpactRow& row, Text& why);
  ImpactStatus place(const ImpactCase& given, Placed& placed, Text& why) const;
  ImpactStatus finish(const Placed& placed, ImpactRow& row, Text& why) const;
  bool touch(const Placed& placed, double overlap, Text& why);
  void fill(const Placed& placed, ImpactRow& row) const;
  void give_state(int ship, const InPlan& position, double heading, const Three& motion);

  Memory memory_;
  ShipCollision collision_;
  Section own_section_{memory_}, target_section_{memory_};
  double L_oa_ = 0.0, middle_ = 0.0;  // of the target
  Buffer<unsigned char> first_state_{memory_};
};

}  // namespace shipcollision
