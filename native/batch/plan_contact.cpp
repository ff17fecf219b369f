#include "plan_contact.hpp"

namespace shipcollision {
namespace {

constexpr double NEAR = 1e-6;
constexpr double FLAT = 2e-3;

// The difference to the nearest whole turn [rad].
double remainder_of_turns(double angle) { return angle - 2.0 * PI * round(angle / (2.0 * PI)); }

InPlan unit(double direction) { return {cos(direction), sin(direction)}; }

const InPlan& corner_after(const Section& polygon, int i) { return polygon[i + 1 < polygon.size() ? i + 1 : 0]; }

// Direction of the outward normal of the edge from corner i to the next.
double edge_normal(const Section& polygon, int i) {
  const InPlan edge = corner_after(polygon, i) - polygon[i];
  return atan2(-edge.x, edge.y);
}

// The corner with the normals of both edges that meet in it.
Place place_at_corner(const Section& polygon, int corner) {
  const double first = edge_normal(polygon, corner > 0 ? corner - 1 : polygon.size() - 1);
  return {polygon[corner], first, first + remainder_of_turns(edge_normal(polygon, corner) - first)};
}

// The point with the normals of its edge, or of both edges that meet in it.
Place place_at(const Section& polygon, const InPlan& point) {
  int nearest = 0;
  double least = INFINITE;
  for (int i = 0; i < polygon.size(); ++i) {
    const double distance = norm(polygon[i] - point);
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  if (least <= NEAR) return place_at_corner(polygon, nearest);
  least = INFINITE;
  for (int i = 0; i < polygon.size(); ++i) {
    const InPlan edge = corner_after(polygon, i) - polygon[i];
    const double along = min(1.0, max(0.0, dot(edge, point - polygon[i]) / dot(edge, edge)));
    const double distance = norm(polygon[i] + along * edge - point);
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  const double direction = edge_normal(polygon, nearest);
  return {point, direction, direction};
}

// Where a turned ship touches, by the corners that reach farthest.
struct Reached {
  InPlan point;
  int corner, count;
};

Reached find_reached(const Section& section, const InPlan& towards) {
  double farthest = -INFINITE;
  for (const InPlan& corner : section) farthest = max(farthest, dot(corner, towards));
  Reached reached{{0.0, 0.0}, 0, 0};
  for (int i = 0; i < section.size(); ++i) {
    if (dot(section[i], towards) < farthest - FLAT) continue;
    reached.point = reached.point + section[i];
    if (reached.count++ == 0) reached.corner = i;
  }
  reached.point = (1.0 / reached.count) * reached.point;
  reached.point = reached.point + (farthest - dot(reached.point, towards)) * towards;
  return reached;
}

}  // namespace

double Place::nearest_normal(double direction) const {
  const double middle = 0.5 * (first + last), half = 0.5 * (last - first);
  return middle + min(half, max(-half, remainder_of_turns(direction - middle)));
}

Place locate_place(const Section& section, double x, bool is_starboard) {
  double foremost = -INFINITE, aftmost = INFINITE;
  for (const InPlan& corner : section) {
    foremost = max(foremost, corner.x);
    aftmost = min(aftmost, corner.x);
  }
  if (x >= foremost - NEAR || x <= aftmost + NEAR) {
    const double end = x >= foremost - NEAR ? foremost : aftmost;
    double low = INFINITE, high = -INFINITE;
    for (const InPlan& corner : section) {
      if (abs(corner.x - end) > NEAR) continue;
      low = min(low, corner.y);
      high = max(high, corner.y);
    }
    return place_at(section, {end, 0.5 * (low + high)});
  }
  const double sign = is_starboard ? 1.0 : -1.0;
  double best = -INFINITE;
  for (int i = 0; i < section.size(); ++i) {
    const InPlan &p = section[i], &q = corner_after(section, i);
    if (min(p.x, q.x) <= x && x <= max(p.x, q.x) && abs(q.x - p.x) > NEAR) {
      best = max(best, sign * (p.y + (x - p.x) / (q.x - p.x) * (q.y - p.y)));
    }
  }
  return place_at(section, {x, sign * best});
}

PlanContact find_contact(const Place& place, const Section& section, double heading) {
  const double direction = place.nearest_normal(heading + PI);
  const InPlan normal = unit(direction), ahead = unit(heading);
  const InPlan towards = {-(ahead.x * normal.x + ahead.y * normal.y), ahead.y * normal.x - ahead.x * normal.y};
  const Reached reached = find_reached(section, towards);
  const InPlan& point = reached.point;
  PlanContact contact;
  contact.position = place.point - InPlan{ahead.x * point.x - ahead.y * point.y, ahead.y * point.x + ahead.x * point.y};
  contact.normals[0] = normal;
  contact.normal_count = 1;
  if (reached.count > 1) return contact;
  const Place corner = place_at_corner(section, reached.corner);  // where the normals of two corners overlap
  const double first = direction + remainder_of_turns(corner.first + heading + PI - direction);
  const double last = direction + remainder_of_turns(corner.last + heading + PI - direction);
  contact.normals[1] = unit(max(first, direction + remainder_of_turns(place.first - direction)));
  contact.normals[2] = unit(min(last, direction + remainder_of_turns(place.last - direction)));
  contact.normal_count = 3;
  return contact;
}

}  // namespace shipcollision
