#include "contact_points.hpp"

#include "../numbers/sort.hpp"

namespace shipcollision {
namespace {

const Numbers* find_numbers(const Buffer<Numbers>& numbers, int a, int b) {
  for (const Numbers& each : numbers) {
    if (each.pair == Pair{a, b}) return &each;
  }
  return nullptr;
}

}  // namespace

bool ContactPoints::are_active() const {
  for (const Point& point : points_) {
    if (point.collision != 0) return true;
  }
  return false;
}

int ContactPoints::latest_scratch() const {
  int latest = 0;
  for (const Point& point : points_) latest = point.scratch > latest ? point.scratch : latest;
  return latest;
}

void ContactPoints::clear() {
  points_.clear();
  parts_.clear();
}

bool ContactPoints::make(const Impulse& impulse, double energy, Point& made) {
  const Contact& c = impulse.contact;
  const int part = parts_.size();
  if (!parts_.reserve(FIRST_PARTS) || !parts_.add({impulse.P, c.normal, c.point, c.r_a, c.r_b, c.at, -1})) return false;
  const double P_n = dot(impulse.P, c.normal);
  made = {c.a, c.b, part, part, c.gap, impulse.P, P_n, impulse.P - P_n * c.normal, energy, 0, 0, {}};
  return true;
}

ContactPoints::Point ContactPoints::merge(const Point& earlier, const Point& later) {
  parts_[earlier.last].next = later.first;
  Point merged = later;
  merged.first = earlier.first;
  merged.P = earlier.P + later.P;
  merged.P_n = earlier.P_n + later.P_n;
  merged.P_t = earlier.P_t + later.P_t;
  merged.energy = earlier.energy + later.energy;
  return merged;
}

int ContactPoints::find_same_place(const Point& added, int count, bool only_free) const {
  int nearest = -1;
  double least = SAME_PLACE;
  for (int k = 0; k < count; ++k) {
    const Point& other = points_[k];
    if (only_free && !is_free_[k]) continue;
    if (other.a != added.a || other.b != added.b || (other.collision > 0) != (added.collision > 0)) continue;
    const double apart = norm(parts_[other.last].r_a - parts_[added.last].r_a);
    if (apart >= least) continue;
    nearest = k;
    least = apart;
  }
  return nearest;
}

void ContactPoints::merge_impulses(const Impulse* impulses, const Loss* losses, int count,
                                   const Buffer<Numbers>& numbers) {
  const int earlier = points_.size();
  if (!is_free_.fill(earlier, true)) return;
  for (int i = 0; i < count; ++i) {
    Point added;
    if (!make(impulses[i], losses[i].normal + losses[i].tangential, added)) return;
    const Numbers* of_pair = find_numbers(numbers, added.a, added.b);
    if (of_pair == nullptr) return;  // there was no memory for it
    added.collision = of_pair->collision;
    added.scratch = of_pair->scratch;
    added.impact = of_pair->impact;
    const int k = find_same_place(added, earlier, true);
    if (k < 0) {
      points_.add(added);
    } else {
      points_[k] = merge(points_[k], added);
      is_free_[k] = false;
    }
  }
}

void ContactPoints::merge_contact_point(const Impulse& impulse, double energy) {
  Point added;
  if (!make(impulse, energy, added)) return;
  const int k = find_same_place(added, points_.size(), false);
  if (k < 0) {
    points_.add(added);
  } else {
    points_[k] = merge(points_[k], added);
  }
}

void ContactPoints::fit(int most) {
  const int count = points_.size();
  if (count <= most) return;
  const auto is_smaller = [](const Point& p, const Point& q) { return norm(p.P) < norm(q.P); };
  const auto is_larger = [](const Point& p, const Point& q) { return norm(p.P) > norm(q.P); };
  sort_stably(points_.data(), count, is_smaller);
  of_pairs_.clear();
  for (const Point& point : points_) {
    int k = 0;
    for (; k < of_pairs_.size(); ++k) {
      const Point& other = of_pairs_[k];
      if (other.a == point.a && other.b == point.b && (other.collision > 0) == (point.collision > 0)) break;
    }
    if (k < of_pairs_.size()) {
      of_pairs_[k] = merge(of_pairs_[k], point);
    } else if (!of_pairs_.add(point)) {
      return;
    }
  }
  sort_stably(of_pairs_.data(), of_pairs_.size(), is_larger);
  of_pairs_.cut(most);
  points_.clear();
  points_.add(of_pairs_.data(), of_pairs_.size());
}

// The centre of pressure, without pressure the latest place.
ContactPoints::Located ContactPoints::locate(const Point& point) const {
  const Part& latest = parts_[point.last];
  if (point.first == point.last) return {latest.place, latest.r_a, latest.r_b};
  double total = 0.0;
  for (int k = point.first; k >= 0; k = parts_[k].next) total += max(dot(parts_[k].P, parts_[k].normal), 0.0);
  if (!(total > 0.0)) return {latest.place, latest.r_a, latest.r_b};
  Located found{};
  for (int k = point.first; k >= 0; k = parts_[k].next) {
    const Part& part = parts_[k];
    const double share = max(dot(part.P, part.normal), 0.0) / total;
    found.place = found.place + share * part.place;
    found.r_a = found.r_a + share * part.r_a;
    found.r_b = found.r_b + share * part.r_b;
  }
  return found;
}

// Moment of the impulses on body b about a place, in n [N m s].
Three ContactPoints::measure_couple(const Point& point, const Three& place) const {
  Three couple{};
  for (int k = point.first; k >= 0; k = parts_[k].next) {
    const Three arm = parts_[k].at - place, P = parts_[k].P;
    couple[0] = couple[0] + arm[1] * P[2] - arm[2] * P[1];
    couple[1] = couple[1] + arm[2] * P[0] - arm[0] * P[2];
    couple[2] = couple[2] + arm[0] * P[1] - arm[1] * P[0];
  }
  return couple;
}

void ContactPoints::fill(Buffer<ContactOutput>& outputs) const {
  for (int k = 0; k < outputs.size(); ++k) {
    if (k < points_.size()) {
      fill_one(points_[k], outputs[k]);
    } else if (outputs[k].ship_a != 0) {
      outputs[k] = {};
    }
  }
}

void ContactPoints::fill_one(const Point& point, ContactOutput& out) const {
  const Located located = locate(point);
  out.point = located.place;
  out.normal = parts_[point.last].normal;
  out.r_a = located.r_a;
  out.r_b = located.r_b;
  out.impulse = point.P;
  out.couple = measure_couple(point, located.place);
  out.gap = point.gap;
  out.impulse_normal = point.P_n;
  out.impulse_tangential = norm(point.P_t);
  out.energy = point.energy;
  out.ship_a = point.a + 1;
  out.ship_b = point.b + 1;
  out.collision = point.collision;
  out.scratch = point.scratch;
  out.start = point.impact.time;
  out.first = point.impact.point;
  out.closing_speed = point.impact.closing_speed;
  out.angle = point.impact.angle;
}

}  // namespace shipcollision
