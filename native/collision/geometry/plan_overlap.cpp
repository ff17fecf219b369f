#include "plan_overlap.hpp"

namespace shipcollision {
namespace {

constexpr Point QUARTERS[] = {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};

int count_sides(const Buffer<Point>& plan) { return plan.size() < 2 ? 4 : plan.size(); }

// Unit normal of a side of a counter-clockwise polygon.
Point face_outward(const Buffer<Point>& plan, int side) {
  if (plan.size() < 2) return QUARTERS[side];
  const Point &from = plan[side], &to = plan[side + 1 < plan.size() ? side + 1 : 0];
  const double length = hypot(to.x - from.x, to.y - from.y);
  return {(to.y - from.y) / length, (from.x - to.x) / length};
}

double reach_along(const Point& n, const Buffer<Point>& plan, double sign) {
  double most = -1e300;
  for (const Point& p : plan) most = max(most, sign * (n.x * p.x + n.y * p.y));
  return most;
}

}  // namespace

PlanOverlap PlanOverlaps::least_overlap(const Buffer<Three>& points_a, const Buffer<Three>& points_b) {
  const Buffer<Three>* points[] = {&points_a, &points_b};
  for (int i = 0; i < 2; ++i) {
    points_.clear();
    for (const Three& point : *points[i]) points_.add({point[0], point[1]});
    convex_polygon(points_, plans_[i]);
  }
  PlanOverlap best{1e300, {{1.0, 0.0, 0.0}}, 0};
  for (int carrier = 0; carrier < 2; ++carrier) {
    const Buffer<Point>& plan = plans_[carrier];
    const double sign = carrier == 0 ? 1.0 : -1.0;
    for (int side = 0; side < count_sides(plan); ++side) {
      const Point outward = face_outward(plan, side);
      const Point n{sign * outward.x, sign * outward.y};
      const double overlap = reach_along(n, plans_[0], 1.0) + reach_along(n, plans_[1], -1.0);
      if (overlap < best.least) best = {overlap, {{n.x, n.y, 0.0}}, carrier};
    }
  }
  return best;
}

}  // namespace shipcollision
