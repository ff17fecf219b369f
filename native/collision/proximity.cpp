#include "proximity.hpp"

#include "../numbers/sort.hpp"

namespace shipcollision {
namespace {

constexpr double REACH_MARGIN = 0.1;

bool is_zero(const ShipState& ship) {
  const Three nothing{};
  return is_same(ship.position, nothing) && is_same(ship.attitude, nothing) && is_same(ship.velocity, nothing) &&
         is_same(ship.rate, nothing);
}

Rectangle widen(const Rectangle& r, double by) {
  return {r.north_from - by, r.north_to + by, r.east_from - by, r.east_to + by};
}

}  // namespace

Proximity::Proximity(const Bodies& bodies, Detector& detector, double clearance_range, double substep, Memory& memory)
    : bodies_(bodies), detector_(detector), range_(clearance_range), substep_(substep), broad_phase_(memory),
      obstacles_(memory), rectangles_(memory), pairs_(memory), near_(memory), bounds_(memory) {
  for (int i = bodies.ships(); i < bodies.size(); ++i) {
    obstacles_.add(widen(bodies[i].rectangle, 0.5 * clearance_range + bodies[i].fender_thickness));
  }
}

// Ships that are all zero have not been received yet, and do not collide with each other.
const Buffer<Pair>& Proximity::find_candidates(const BodyState* states, const bool* has_state,
                                               const ShipState* received, double H, const bool* is_absent) {
  rectangles_.clear();
  for (int i = 0; i < bodies_.ships(); ++i) {
    const Body& body = bodies_[i];
    const ShipState& ship = received[i];
    const double speed = has_state[i] ? body.largest_speed(states[i])
                                      : norm(ship.velocity) + norm(ship.rate) * body.hull.reach;
    const Three& x = has_state[i] ? states[i].predicted.x : ship.position;
    const double d = body.fender_thickness + H * speed + (0.5 * range_ + body.hull.reach);
    rectangles_.add({x[0] - d, x[0] + d, x[1] - d, x[1] + d});
  }
  rectangles_.add(obstacles_.data(), obstacles_.size());
  broad_phase_.near_pairs(rectangles_, bodies_.ships(), pairs_);
  int count = 0;
  for (const Pair& pair : pairs_) {
    const bool is_of_ships = pair.b < bodies_.ships();
    if (is_absent != nullptr && (is_absent[pair.a] || (is_of_ships && is_absent[pair.b]))) continue;
    if (is_of_ships && is_zero(received[pair.a]) && is_zero(received[pair.b])) continue;
    pairs_[count++] = pair;
  }
  pairs_.cut(count);
  return pairs_;
}

const Buffer<NearPair>& Proximity::find_near(const Buffer<Pair>& candidates, const BodyState* states, double H) {
  near_.clear();
  for (const Pair& pair : candidates) {
    const Body &one = bodies_[pair.a], &other = bodies_[pair.b];
    const double speed_a = one.largest_speed(states[pair.a]), speed_b = other.largest_speed(states[pair.b]);
    const double most =
        REACH_MARGIN + (one.fender_thickness + H * speed_a) + (other.fender_thickness + H * speed_b);
    if (find_bounds_distance(pair, states) > most) continue;
    // No substep is shorter, but for one that is the whole step.
    const double soon = min(H, 0.5 * substep_) * (speed_a + speed_b);
    const bool is_soon = detector_.are_surely_within(pair, states, soon);
    const double gap = is_soon ? 0.5 * soon : detector_.clearance(pair, states, most);
    if (gap < most) near_.add({pair, gap, speed_a + speed_b});
  }
  return near_;
}

// Pairs with the nearest bounds are measured first: their distances soon exclude the others.
Clearance Proximity::measure_clearance(const Buffer<Pair>& candidates, const BodyState* states) {
  Clearance found{range_, {0, 0}};
  bounds_.clear();
  for (const Pair& pair : candidates) bounds_.add({find_bounds_distance(pair, states), pair});
  sort(bounds_.data(), bounds_.size(), [](const Bound& p, const Bound& q) {
    if (p.distance != q.distance) return p.distance < q.distance;
    return p.pair.a < q.pair.a || (p.pair.a == q.pair.a && p.pair.b < q.pair.b);
  });
  for (const auto& [bound, pair] : bounds_) {
    if (bound >= found.least) break;
    const double gap = detector_.clearance(pair, states, found.least);
    if (gap < found.least) found = {gap, {pair.a + 1, pair.b + 1}};
  }
  return found;
}

// Horizontal distance [m] of the bounds of two hulls, never more than that of the hulls.
double Proximity::find_bounds_distance(const Pair& pair, const BodyState* states) const {
  const Body &one = bodies_[pair.a], &other = bodies_[pair.b];
  const Three& x = states[pair.a].predicted.x;
  if (states[pair.b].fixed) {
    const Rectangle& r = other.rectangle;
    return hypot(max(max(r.north_from - x[0], 0.0), x[0] - r.north_to),
                 max(max(r.east_from - x[1], 0.0), x[1] - r.east_to)) -
           one.hull.reach;
  }
  const Three& y = states[pair.b].predicted.x;
  return hypot(y[0] - x[0], y[1] - x[1]) - one.hull.reach - other.hull.reach;
}

}  // namespace shipcollision
