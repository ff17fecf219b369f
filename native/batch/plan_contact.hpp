// Positions in which two upright hulls touch at a given place, in plan: the twin of
// shipcollision_fmu/encounters/plan_contact.py, from which the sections come.
#pragma once

#include "../numbers/buffer.hpp"
#include "../numbers/elementary.hpp"

namespace shipcollision {

// A point or a direction in plan: x forward and y starboard, or north and east.
struct InPlan {
  double x, y;
};

inline InPlan operator+(const InPlan& p, const InPlan& q) { return {p.x + q.x, p.y + q.y}; }
inline InPlan operator-(const InPlan& p, const InPlan& q) { return {p.x - q.x, p.y - q.y}; }
inline InPlan operator*(double factor, const InPlan& p) { return {factor * p.x, factor * p.y}; }
inline double dot(const InPlan& p, const InPlan& q) { return p.x * q.x + p.y * q.y; }
inline double norm(const InPlan& p) { return sqrt(dot(p, p)); }

// Of a hull at the height of contact, in b: corners by rising angle.
using Section = Buffer<InPlan>;

// A point of a section, and the directions of its first and last outward normal, rising [rad].
struct Place {
  InPlan point;
  double first, last;

  double nearest_normal(double direction) const;
};

// A position in which the other ship touches the struck ship, in the struck ship's b: its CO, and outward normals of the
// contact. The first normal is that along which they touch; the others bound those that both hulls have there.
struct PlanContact {
  InPlan position;
  InPlan normals[3];
  int normal_count;
};

// The boundary's point at x forward of CO [m] on a side; beyond an end, the middle of that end.
Place locate_place(const Section& section, double x, bool is_starboard);

// The position in which the bow of a ship of this section and heading [rad], relative to the struck ship, faces the
// place most.
PlanContact find_contact(const Place& place, const Section& section, double heading);

}  // namespace shipcollision
