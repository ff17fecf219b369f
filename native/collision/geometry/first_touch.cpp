#include "first_touch.hpp"

namespace shipcollision {
namespace {

constexpr int MOST_ADVANCES = 24;
constexpr int MOST_HALVINGS = 40;
constexpr double TURN = 0.05;
constexpr int MOST_TURNS = 64;

double find_separation(const Three& normal, const HullPart& part_a, const HullPart& part_b, const Pose& at_a,
                       const Pose& at_b) {
  const Three in_a = rotate_back(at_a.R, normal), in_b = rotate_back(at_b.R, normal);
  double most = dot(part_a.corners[0], in_a), least = dot(part_b.corners[0], in_b);
  for (int i = 1; i < part_a.corner_count; ++i) most = max(most, dot(part_a.corners[i], in_a));
  for (int i = 1; i < part_b.corner_count; ++i) least = min(least, dot(part_b.corners[i], in_b));
  return dot(normal, at_b.x - at_a.x) + least - most;
}

// An axis that stays, or that turns with a hull.
struct Axis {
  const MovingHull* carrier;
  Three normal;

  Three at(double tau) const { return carrier == nullptr ? normal : rotate(carrier->pose_at(tau).R, normal); }
};

// A pair of convex parts in motion.
class Parts {
 public:
  Parts(PlacedHulls& narrow_phase, const MovingHull& a, const MovingHull& b, int i, int j)
      : narrow_phase_(narrow_phase), a_(a), b_(b), i_(i), j_(j), part_a_(a.hull->part(i)), part_b_(b.hull->part(j)) {}

  bool find_first_touch(double begin, double end, double speed, double growth, const LastNormal* carried,
                        double& touch) const {
    touch = begin;
    for (int i = 0; i < MOST_ADVANCES; ++i) {
      Closest closest;
      narrow_phase_.place(a_.index, a_.pose_at(touch));
      narrow_phase_.place(b_.index, b_.pose_at(touch));
      if (!narrow_phase_.closest_of_parts(a_.index, i_, b_.index, j_, speed * (end - touch) + TOUCH, closest)) {
        return false;
      }
      const double gap = closest.gap;
      if (gap <= 0.0 && (touch > begin || (touch > 0.0 && carried == nullptr))) return true;
      if (gap <= 0.0) return touch_on(begin, end, closest.normal, max(2.0 * TOUCH, growth + gap), carried, touch);
      if (!reach(touch, end, {nullptr, closest.normal}, gap + 0.5 * TOUCH, touch)) return false;
    }
    return true;
  }

 private:
  // When the overlap along the normal has grown so far.
  bool touch_on(double begin, double end, const Three& normal, double growth, const LastNormal* carried,
                double& touch) const {
    if (carried == nullptr) return reach(begin, end, {nullptr, normal}, growth, touch);
    return reach(begin, end, {carried->carrier == 0 ? &a_ : &b_, carried->normal}, growth, touch);
  }

  double separation(const Axis& axis, double tau) const {
    return find_separation(axis.at(tau), part_a_, part_b_, a_.pose_at(tau), b_.pose_at(tau));
  }

  // The first time after `begin` at which the separation along the axis has fallen by `way`; false: not by `end`.
  bool reach(double begin, double end, const Axis& axis, double way, double& fall) const {
    const double start = separation(axis, begin) - way;
    double low = begin, f_low = way, high = end, f_high = separation(axis, end) - start;
    if (f_high > 0.0) return false;
    double f = f_high;
    int side = 0;
    for (int i = 0; i < MOST_HALVINGS; ++i) {
      if ((side >= 0 && f >= -0.25 * TOUCH) || high - low <= 1e-12 * end) break;
      const double tau = low + (high - low) * f_low / (f_low - f_high);
      f = separation(axis, tau) - start;
      if (f > 0.0) {
        f_high *= side < 0 ? 0.5 : 1.0;
        low = tau;
        f_low = f;
        side = -1;
      } else {
        f_low *= side > 0 ? 0.5 : 1.0;
        high = tau;
        f_high = f;
        side = 1;
      }
    }
    fall = high;
    return true;
  }

  PlacedHulls& narrow_phase_;
  const MovingHull &a_, &b_;
  const int i_, j_;
  const HullPart part_a_, part_b_;
};

}  // namespace

bool find_first_touch(PlacedHulls& narrow_phase, const MovingHull& a, const MovingHull& b, double h, double speed,
                      double growth, const LastNormal* carried, double& touch) {
  const double turns = ceil(h * max(a.turning(), b.turning()) / TURN);
  const int pieces = turns >= MOST_TURNS ? MOST_TURNS : turns >= 1.0 ? static_cast<int>(turns) : 1;
  for (int k = 0; k < pieces; ++k) {
    const double begin = h * k / pieces, end = h * (k + 1) / pieces;
    bool is_found = false;
    for (int i = 0; i < a.hull->part_count(); ++i) {
      for (int j = 0; j < b.hull->part_count(); ++j) {
        const Parts parts(narrow_phase, a, b, i, j);
        double found;
        if (parts.find_first_touch(begin, is_found ? touch : end, speed, growth, carried, found)) {
          touch = found;
          is_found = true;
        }
      }
    }
    if (is_found) return true;
  }
  return false;
}

double gap_before(const Closest& closest, const HullMesh& hull_a, const HullMesh& hull_b, const BodyState& a,
                  const BodyState& b) {
  const HullPart part_a = hull_a.part(closest.part_a), part_b = hull_b.part(closest.part_b);
  const Three& normal = closest.normal;
  const Three turned[2] = {rotate(a.pose_before.R, rotate_back(a.predicted.R, normal)),
                           rotate(b.pose_before.R, rotate_back(b.predicted.R, normal))};
  double before = find_separation(normal, part_a, part_b, a.pose_before, b.pose_before);
  for (const Three& axis : turned) {
    before = max(before, find_separation(axis, part_a, part_b, a.pose_before, b.pose_before));
  }
  return closest.gap + before - find_separation(normal, part_a, part_b, a.predicted, b.predicted);
}

}  // namespace shipcollision
