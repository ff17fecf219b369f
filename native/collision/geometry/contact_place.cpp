#include "contact_place.hpp"

namespace shipcollision {
namespace {

// Middle of a feature and its slopes along u and v.
struct Plane {
  double u_0, v_0, h_0, along_u, along_v;

  double height(double u, double v) const { return h_0 + (u - u_0) * along_u + (v - v_0) * along_v; }
};

void find_foremost(const Buffer<Three>& points, const Three& direction, double depth, Buffer<Three>& feature) {
  feature.clear();
  if (points.is_empty()) return;
  double most = dot(points[0], direction);
  for (const Three& point : points) most = max(most, dot(point, direction));
  for (const Three& point : points) {
    if (dot(point, direction) >= most - depth) feature.add(point);
  }
}

Plane fit_plane(const Buffer<Three>& feature, const Three& origin, const Rows& axes) {
  const double n = feature.size();
  Three middle = rotate(axes, feature[0] - origin);
  for (int i = 1; i < feature.size(); ++i) middle = middle + rotate(axes, feature[i] - origin);
  const double h_0 = middle[0] / n, u_0 = middle[1] / n, v_0 = middle[2] / n;
  double uu = 0.0, uv = 0.0, vv = 0.0, uh = 0.0, vh = 0.0;
  for (const Three& point : feature) {
    const Three at = rotate(axes, point - origin);
    const double dh = at[0] - h_0, du = at[1] - u_0, dv = at[2] - v_0;
    uu += du * du;
    uv += du * dv;
    vv += dv * dv;
    uh += du * dh;
    vh += dv * dh;
  }
  const double spread = uu + vv, area = uu * vv - uv * uv;
  if (area > 1e-9 * spread * spread) return {u_0, v_0, h_0, (vv * uh - uv * vh) / area, (uu * vh - uv * uh) / area};
  if (spread > 0.0) {
    const double square = spread * spread;
    return {u_0, v_0, h_0, (uu * uh + uv * vh) / square, (uv * uh + vv * vh) / square};
  }
  return {u_0, v_0, h_0, 0.0, 0.0};
}

}  // namespace

int spread(const Point* given, int count, Point (&corners)[MANIFOLD]) {
  if (count <= MANIFOLD) {
    for (int i = 0; i < count; ++i) corners[i] = given[i];
    return count;
  }
  // The first of the least and the last of the largest, as a stable sort has them.
  int low = 0, high = 0, left = 0, right = 0;
  for (int i = 1; i < count; ++i) {
    const auto sum = [given](int k) { return given[k].x + given[k].y; };
    const auto difference = [given](int k) { return given[k].x - given[k].y; };
    if (sum(i) < sum(low)) low = i;
    if (sum(i) >= sum(high)) high = i;
    if (difference(i) < difference(left)) left = i;
    if (difference(i) >= difference(right)) right = i;
  }
  const int chosen[MANIFOLD] = {low, right, high, left};
  Point kept[MANIFOLD];
  int found = 0;
  for (int i : chosen) {
    bool is_new = true;
    for (int k = 0; k < found; ++k) is_new = is_new && !(kept[k].x == given[i].x && kept[k].y == given[i].y);
    if (is_new) kept[found++] = given[i];
  }
  for (int k = 0; k < found; ++k) corners[k] = kept[k];
  return found;
}

void ContactPlaces::find_features(const Buffer<Three>& part_a, const Buffer<Three>& part_b, const Three& normal,
                                  double depth) {
  find_foremost(part_a, normal, depth, feature_a);
  find_foremost(part_b, -normal, depth, feature_b);
}

int ContactPlaces::find_manifold(const Rows& axes, ContactPlace (&places)[MANIFOLD]) {
  if (feature_a.is_empty() || feature_b.is_empty()) return 0;  // without memory
  const Three origin = feature_a[0];
  make_plan(feature_a, origin, axes, plan_a_);
  make_plan(feature_b, origin, axes, plan_b_);
  const Buffer<Point>& common = clipper_.common_points(plan_a_, plan_b_);
  if (common.is_empty()) return 0;
  const Plane plane_a = fit_plane(feature_a, origin, axes), plane_b = fit_plane(feature_b, origin, axes);
  Point corners[MANIFOLD];
  const int count = spread(common.data(), common.size(), corners);
  double least = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto& [u, v] = corners[i];
    const double height_a = plane_a.height(u, v), height_b = plane_b.height(u, v);
    const double gap = height_b - height_a;
    places[i] = {origin + rotate_back(axes, {{0.5 * (height_a + height_b), u, v}}), gap};
    least = i == 0 ? gap : min(least, gap);
  }
  // Tilted within FEATURE_DEPTH, with the true touch at an end that the other does not reach: the nearest is in touch.
  const double shift = max(least, 0.0);
  for (int i = 0; i < count; ++i) places[i].gap -= shift;
  return count;
}

void ContactPlaces::make_plan(const Buffer<Three>& feature, const Three& origin, const Rows& axes,
                              Buffer<Point>& plan) {
  points_.clear();
  for (const Three& point : feature) points_.add({dot(point - origin, axes[1]), dot(point - origin, axes[2])});
  convex_polygon(points_, plan);
}

}  // namespace shipcollision
