#include "collision_log.hpp"

namespace shipcollision {
namespace {

Rows rotation_of(const ShipState& state) {
  return rotation_rows(state.attitude[0], state.attitude[1], state.attitude[2]);
}

// exp(skew(w)) v: the vector turned by |w| [rad] about w.
Three turn(const Three& w, const Three& v) {
  const double angle = norm(w);
  const double half = sin(0.5 * angle);
  const double a = angle < 1e-8 ? 1.0 : sin(angle) / angle;
  const double b = angle < 1e-8 ? 0.5 : 2.0 * (half / angle) * (half / angle);
  return v + a * cross(w, v) + b * cross(w, cross(w, v));
}

// A point in n at `since` [s] after the state, in b of the hull in its pose by then.
Three place_in_hull(const ShipState& state, double since, const Three& point) {
  const Rows R = rotation_of(state);
  const Three x = state.position + since * rotate(R, state.velocity);
  return turn(-since * state.rate, rotate_back(R, point - x));
}

Three velocity_at(const ShipState& state, const Three& place) {
  return rotate(rotation_of(state), state.velocity + cross(state.rate, place));
}

bool has_point_before(const CollisionOutputs& outputs, int ship, int number, int end) {
  for (int i = 0; i < end; ++i) {
    const ContactOutput& contact = outputs.contacts[i];
    if ((contact.ship_a == ship || contact.ship_b == ship) && contact.collision == number) return true;
  }
  return false;
}

// Impulse of a collision's contact points on a ship, in b about CO.
Six wrench_on(int ship, int number, const ShipState& state, const CollisionOutputs& outputs) {
  const Rows R = rotation_of(state);
  Six total{};
  for (int i = 0; i < outputs.contact_count; ++i) {
    const ContactOutput& contact = outputs.contacts[i];
    if (contact.collision != number || (contact.ship_a != ship && contact.ship_b != ship)) continue;
    const bool is_a = contact.ship_a == ship;
    const Three P = rotate_back(R, is_a ? -contact.impulse : contact.impulse);
    total = total + join(P, cross(is_a ? contact.r_a : contact.r_b, P));
  }
  return total;
}

}  // namespace

void CollisionLog::begin(const LoggedShip* ships, int ship_count, const double* headings, int obstacle_count,
                         int delay) {
  ships_.clear();
  headings_.clear();
  rows_.clear();
  openings_.clear();
  ships_.add(ships, ship_count);
  headings_.add(headings, obstacle_count);
  issued_.fill(ship_count, Six{});
  delay_ = delay;
}

void CollisionLog::add(int k, double t, double H, const ShipState* before, const CollisionOutputs& outputs) {
  for (int i = 0; i < outputs.contact_count; ++i) {
    const ContactOutput& contact = outputs.contacts[i];
    if (contact.collision <= 0) continue;  // a fender acts, which is no collision
    CollisionRow* row = open(contact, k, before);
    if (row == nullptr) return;  // there is no memory
    Opening& opening = openings_[static_cast<int>(row - rows_.data())];
    const double strength = hypot(contact.impulse_normal, contact.impulse_tangential);
    if (opening.first == k && strength > opening.strongest) {
      opening.strongest = strength;
      begin_at(contact, t, before, *row);
    }
    row->contacts = row->contacts + 1;
    row->impulse = row->impulse + contact.impulse;
    row->energy += contact.energy;
    row->end = t + H;
    opening.last = k;
  }
  add_gains(before, outputs);
}

// The row of a contact point's collision; null without memory.
CollisionRow* CollisionLog::open(const ContactOutput& contact, int k, const ShipState* before) {
  for (CollisionRow& row : rows_) {
    if (row.number == contact.collision) return &row;
  }
  CollisionRow row{};
  row.number = contact.collision;
  row.ship_a = contact.ship_a;
  row.ship_b = contact.ship_b;
  row.start = contact.start;
  row.point = contact.first;
  row.closing_speed = contact.closing_speed;
  row.angle = contact.angle;
  row.a_before = is_ship(contact.ship_a) ? before[contact.ship_a - 1].nu() : Six{};
  row.b_before = is_ship(contact.ship_b) ? before[contact.ship_b - 1].nu() : Six{};
  if (!openings_.add({k, k, -1.0, is_ship(contact.ship_b)}) || !rows_.add(row)) return nullptr;
  return &rows_.last();
}

// What the strongest contact point of the first step decides: the first point in both hulls, and how it moves.
void CollisionLog::begin_at(const ContactOutput& contact, double t, const ShipState* before, CollisionRow& row) const {
  const int bodies[2] = {contact.ship_a, contact.ship_b};
  Three places[2] = {contact.r_a, contact.r_b}, velocities[2];
  for (int i = 0; i < 2; ++i) {
    ShipState state;
    if (is_ship(bodies[i])) {
      state = before[bodies[i] - 1];
      places[i] = place_in_hull(state, contact.start - t, contact.first);
    } else {
      state.attitude[2] = headings_[bodies[i] - ships_.size() - 1];
    }
    velocities[i] = velocity_at(state, places[i]);
  }
  row.a_point = places[0];
  row.b_point = places[1];
  row.relative_velocity = velocities[0] - velocities[1];
}

// A ship in one collision gains what was issued in the step; in several, from each what its contact points give.
void CollisionLog::add_gains(const ShipState* before, const CollisionOutputs& outputs) {
  for (int i = 0; i < ships_.size(); ++i) {
    const int ship = i + 1;
    int several = 0;
    for (int k = 0; k < outputs.contact_count; ++k) {
      const ContactOutput& contact = outputs.contacts[k];
      if (contact.ship_a != ship && contact.ship_b != ship) continue;
      several += !has_point_before(outputs, ship, contact.collision, k);
    }
    for (int k = 0; k < outputs.contact_count; ++k) {
      const ContactOutput& contact = outputs.contacts[k];
      if (contact.ship_a != ship && contact.ship_b != ship) continue;
      if (has_point_before(outputs, ship, contact.collision, k)) continue;
      const Six wrench = several > 1 ? wrench_on(ship, contact.collision, before[i], outputs)
                                     : outputs.ships[i].impulse - issued_[i];
      add_gain(ship, contact.collision, find_gain(i, before[i], wrench));
    }
    issued_[i] = outputs.ships[i].impulse;
  }
}

Three CollisionLog::find_gain(int ship, const ShipState& state, const Six& wrench) const {
  Matrix tilted;
  tilt_inverse(ships_[ship].inverse, ships_[ship].degrees_of_freedom, state.attitude[0], state.attitude[1], tilted);
  return rotate(rotation_of(state), first_three(multiply(tilted, wrench)));
}

void CollisionLog::add_gain(int ship, int number, const Three& gain) {
  for (CollisionRow& row : rows_) {
    if (row.number != number) continue;
    Three& of_ship = row.ship_a == ship ? row.a_gain : row.b_gain;
    of_ship = of_ship + gain;
  }
}

void CollisionLog::follow(int k, const ShipState* after) {
  for (int i = 0; i < rows_.size(); ++i) {
    CollisionRow& row = rows_[i];
    if (k > openings_[i].last + delay_) continue;
    row.a_after = after[row.ship_a - 1].nu();
    if (openings_[i].is_b_ship) row.b_after = after[row.ship_b - 1].nu();
  }
}

}  // namespace shipcollision
