#include "compound_hull.hpp"

#include "../../numbers/sort.hpp"
#include "../dynamics/contact_frame.hpp"

namespace shipcollision {
namespace {

constexpr double FLAT = 1e-3;
constexpr double STEP = 0.02;
constexpr double JOINT = 0.01;
constexpr double DEEPEST = 1.0;

constexpr double SAME_NORMAL = 1.0 - 0.5 * (FLAT * FLAT);

double reach_along(const HullPart& part, const Three& direction) {
  double most = dot(part.corners[0], direction);
  for (int i = 1; i < part.corner_count; ++i) most = max(most, dot(part.corners[i], direction));
  return most;
}

// Height above which a corner lies in a plane; at least the foremost one does.
double least_height_on(const HullPart& part, const Three& normal) { return reach_along(part, normal) - 1e-4; }

Three find_middle(const HullPart& part, const Three& normal) {
  const double least = least_height_on(part, normal);
  Three sum{};
  int count = 0;
  for (int i = 0; i < part.corner_count; ++i) {
    if (dot(part.corners[i], normal) < least) continue;
    sum = count == 0 ? part.corners[i] : sum + part.corners[i];
    ++count;
  }
  return {{sum[0] / count, sum[1] / count, sum[2] / count}};
}

bool do_both_support(const Closest& closest, const CompoundHull& one, const CompoundHull& other, const BodyState& a,
                     const BodyState& b) {
  return one.supports(closest.part_a, a.in_body(closest.on_a), rotate_back(a.predicted.R, closest.normal)) &&
         other.supports(closest.part_b, b.in_body(closest.on_b), -rotate_back(b.predicted.R, closest.normal));
}

}  // namespace

CompoundHull::CompoundHull(const HullMesh& hull, Memory& memory)
    : hull_(hull), is_whole_(hull.part_count() == 1), middles_(memory), outer_(memory) {
  is_whole_ = is_whole_ || !middles_.reserve(hull.plane_count()) || !outer_.reserve(hull.plane_count());
  if (is_whole_) return;
  for (int i = 0; i < hull.part_count(); ++i) {
    const HullPart part = hull.part(i);
    for (int k = 0; k < part.plane_count; ++k) middles_.add(find_middle(part, part.planes[k].normal));
  }
  for (int i = 0; i < hull.part_count(); ++i) {
    for (int k = 0; k < hull.part(i).plane_count; ++k) outer_.add(can_be_touched(i, k));
  }
}

bool CompoundHull::supports(int part, const Three& p, const Three& direction) const {
  if (is_whole_) return true;
  const HullPart own = hull_.part(part);
  int face = 0;
  for (int k = 1; k < own.plane_count; ++k) {
    if (dot(own.planes[k].normal, direction) > dot(own.planes[face].normal, direction)) face = k;
  }
  if (dot(own.planes[face].normal, direction) >= SAME_NORMAL) {
    return !covers(part, move_off_the_rim(part, face, p), direction);
  }
  const double reach = dot(direction, p) + JOINT;
  for (int other = 0; other < hull_.part_count(); ++other) {
    if (other != part && holds(other, p, JOINT) && reach_along(hull_.part(other), direction) > reach) return false;
  }
  return true;
}

bool CompoundHull::covers(int part, const Three& p, const Three& direction) const {
  if (is_whole_) return false;
  const Three before = p + STEP * direction;
  for (int other = 0; other < hull_.part_count(); ++other) {
    if (other != part && holds(other, before, -0.1 * STEP)) return true;
  }
  return false;
}

bool CompoundHull::holds(int part, const Three& p, double margin) const {
  const HullPart own = hull_.part(part);
  for (int k = 0; k < own.plane_count; ++k) {
    if (!(dot(own.planes[k].normal, p) <= own.planes[k].offset + margin)) return false;
  }
  return true;
}

Three CompoundHull::move_off_the_rim(int part, int face, const Three& p) const {
  const Three inwards = middles_[hull_.part(part).first_plane + face] - p;
  return p + min(0.5, STEP / max(norm(inwards), STEP)) * inwards;
}

// Whether some place of a face is not covered: the middle, or half way to a corner, or near it.
bool CompoundHull::can_be_touched(int part, int k) const {
  const HullPart own = hull_.part(part);
  const Three& normal = own.planes[k].normal;
  const Three& middle = middles_[own.first_plane + k];
  const double least = least_height_on(own, normal);
  if (!covers(part, middle, normal)) return true;
  for (int i = 0; i < own.corner_count; ++i) {
    const Three& corner = own.corners[i];
    if (dot(corner, normal) < least) continue;
    if (!covers(part, 0.5 * (middle + corner), normal)) return true;
    if (!covers(part, 0.1 * middle + 0.9 * corner, normal)) return true;
  }
  return false;
}

void Support::select_supported(Buffer<Closest>& touching, const CompoundHull& one, const CompoundHull& other,
                               const BodyState& a, const BodyState& b) {
  if (one.is_whole() && other.is_whole()) return;
  found_.clear();
  for (const Closest& closest : touching) {
    Closest found;
    if (find_supported(closest, one, other, a, b, found)) found_.add(found);
  }
  if (!found_.is_empty()) {
    touching.clear();
    touching.add(found_.data(), found_.size());
  }
  sort_stably(touching.data(), touching.size(), [](const Closest& p, const Closest& q) { return p.gap < q.gap; });
}

// The closest point itself if both hulls support it, or its replacement; false without one.
bool Support::find_supported(const Closest& closest, const CompoundHull& one, const CompoundHull& other,
                             const BodyState& a, const BodyState& b, Closest& found) {
  found = closest;
  if (do_both_support(closest, one, other, a, b)) return true;
  place_part(one.hull().part(closest.part_a), a, in_a_);
  place_part(other.hull().part(closest.part_b), b, in_b_);
  find_outer_faces(closest, one, other, a, b);
  for (const auto& [normal, depth] : faces_) {
    if (depth > DEEPEST) break;
    ContactPlace places[MANIFOLD];
    places_.find_features(in_a_, in_b_, normal, FEATURE_DEPTH);
    const int count = places_.find_manifold(contact_axes(normal), places);
    for (int i = 0; i < count; ++i) {
      const auto& [point, gap] = places[i];
      const Three half = 0.5 * gap * normal;
      found = {point - half, point + half, normal, -depth, closest.part_a, closest.part_b};
      if (gap <= 0.0 && do_both_support(found, one, other, a, b)) return true;
    }
  }
  return false;
}

// The outer faces of both parts with the overlap along them, by the overlap.
void Support::find_outer_faces(const Closest& closest, const CompoundHull& one, const CompoundHull& other,
                               const BodyState& a, const BodyState& b) {
  faces_.clear();
  for (int side = 0; side < 2; ++side) {
    const CompoundHull& compound = side == 0 ? one : other;
    const BodyState& state = side == 0 ? a : b;
    const int number = side == 0 ? closest.part_a : closest.part_b;
    const HullPart part = compound.hull().part(number);
    for (int k = 0; k < part.plane_count; ++k) {
      if (!compound.is_outer(number, k)) continue;
      const Three outward = rotate(state.predicted.R, part.planes[k].normal);
      const Three normal = side == 0 ? outward : -outward;
      // The foremost corners of its own part lie in the plane.
      const double own = part.planes[k].offset + dot(outward, state.predicted.x);
      double least = 1e300;
      for (const Three& corner : side == 0 ? in_b_ : in_a_) least = min(least, dot(outward, corner));
      faces_.add({normal, own - least});
    }
  }
  sort_stably(faces_.data(), faces_.size(), [](const Face& p, const Face& q) { return p.depth < q.depth; });
}

void Support::merge_coplanar(Buffer<Contact>& contacts, int begin) {
  groups_.clear();
  kept_.clear();
  int groups = 0;
  for (int i = begin; i < contacts.size(); ++i) {
    int group = groups;
    for (int k = begin; k < i && group == groups; ++k) {
      // The first of a group stands for it.
      bool is_first = true;
      for (int m = begin; m < k; ++m) is_first = is_first && groups_[m - begin] != groups_[k - begin];
      const Contact& first = contacts[k];
      if (is_first && abs(dot(first.normal, contacts[i].point - first.point)) <= FEATURE_DEPTH &&
          dot(first.normal, contacts[i].normal) >= SAME_NORMAL) {
        group = groups_[k - begin];
      }
    }
    if (!groups_.add(group)) return;
    if (group == groups) ++groups;
  }
  for (int group = 0; group < groups; ++group) keep_outline(contacts, begin, group);
  contacts.cut(begin);
  contacts.add(kept_.data(), kept_.size());
}

void Support::keep_outline(const Buffer<Contact>& contacts, int begin, int group) {
  const Contact* first = nullptr;
  points_.clear();
  Rows axes{};
  for (int i = begin; i < contacts.size(); ++i) {
    if (groups_[i - begin] != group) continue;
    if (first == nullptr) {
      first = &contacts[i];
      axes = contact_axes(first->normal);
    }
    points_.add({dot(axes[1], contacts[i].point), dot(axes[2], contacts[i].point)});
  }
  convex_polygon(points_, outline_);
  Point corners[MANIFOLD];
  const int count = spread(outline_.data(), outline_.size(), corners);
  for (int k = 0; k < count; ++k) {
    for (int i = begin; i < contacts.size(); ++i) {
      if (groups_[i - begin] != group) continue;
      const Three& point = contacts[i].point;
      if (dot(axes[1], point) == corners[k].x && dot(axes[2], point) == corners[k].y) {
        kept_.add(contacts[i]);
        break;  // of two at one place, the first
      }
    }
  }
}

void place_part(const HullPart& part, const BodyState& state, Buffer<Three>& placed) {
  const auto& [x, R] = state.predicted;
  placed.clear();
  for (int i = 0; i < part.corner_count; ++i) placed.add(x + rotate(R, part.corners[i]));
}

}  // namespace shipcollision
