#include "thickness.hpp"

namespace shipcollision {
namespace {

double width_across(const HullPart& part, const Three& normal) {
  double most = dot(part.corners[0], normal), least = most;
  for (int i = 1; i < part.corner_count; ++i) {
    const double height = dot(part.corners[i], normal);
    most = max(most, height);
    least = min(least, height);
  }
  return most - least;
}

}  // namespace

double least_width(const HullMesh& hull) {
  double least = 1e300;
  for (int i = 0; i < hull.part_count(); ++i) {
    const HullPart part = hull.part(i);
    for (int k = 0; k < part.plane_count; ++k) least = min(least, width_across(part, part.planes[k].normal));
  }
  return least;
}

}  // namespace shipcollision
