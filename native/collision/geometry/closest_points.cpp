// Closest points of convex hulls, by Bullet: the twin of shipcollision_fmu/collision/geometry/closest_points.py.
//
// Bullet's world has its z axis up. Vectors change between n and w, and between the body axes, by (y, x, -z).
#include "closest_points.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "../../numbers/sort.hpp"

namespace shipcollision {

namespace {

// Bullet looks no farther than this beyond the distance asked for [m]. Any positive length gives the same results, a
// larger one takes longer.
constexpr double BREAKING_THRESHOLD = 0.02;

// Bullet fills tables of directions when the first hull is made. This makes one while the library is loaded, by one
// thread, so that two threads that open their first worlds never write there.
__attribute__((constructor)) void fill_tables() { const btConvexHullShape first; }

btVector3 swap_axes(const double v[3]) { return btVector3(v[1], v[0], -v[2]); }

void swap_axes(const btVector3& v, double swapped[3]) {
  swapped[0] = v.y();
  swapped[1] = v.x();
  swapped[2] = -v.z();
}

// Unit quaternion, w >= 0, of a rotation matrix: the twin of frames.quaternion.
void find_quaternion(const double R[9], double q[4]) {
  const double xx = R[0], xy = R[1], xz = R[2], yx = R[3], yy = R[4], yz = R[5], zx = R[6], zy = R[7], zz = R[8];
  const double trace = xx + yy + zz;
  const double yy_zz = yy >= zz ? yy : zz;
  if (trace >= (xx >= yy_zz ? xx : yy_zz)) {
    q[0] = zy - yz, q[1] = xz - zx, q[2] = yx - xy, q[3] = 1.0 + trace;
  } else if (xx >= yy_zz) {
    q[0] = 1.0 - trace + 2.0 * xx, q[1] = yx + xy, q[2] = zx + xz, q[3] = zy - yz;
  } else if (yy >= zz) {
    q[0] = xy + yx, q[1] = 1.0 - trace + 2.0 * yy, q[2] = zy + yz, q[3] = xz - zx;
  } else {
    q[0] = xz + zx, q[1] = yz + zy, q[2] = 1.0 - trace + 2.0 * zz, q[3] = yx - xy;
  }
  double size = __builtin_sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (q[3] < 0.0) size = -size;
  for (int i = 0; i < 4; ++i) q[i] /= size;
}

// A convex hull that finds the point that Bullet's would find, the foremost of the lowest number, without looking at
// all: points are in groups, and most groups lie behind the point that was foremost last.
class GroupedHull : public btConvexHullShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  // After the last point.
  void finish() {
    optimizeConvexHull();
    for (int i = 0; i < getNumPoints(); ++i) order_.push_back(i);
    group(0, getNumPoints());
    for (int i = 0; i < order_.size(); ++i) points_.push_back(getUnscaledPoints()[order_[i]]);
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;  // of Bullet's own type, it would search by itself
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const btVector3 along = direction.absolute();
    int found = last_;
    btScalar most = points_[found].dot(direction);
    for (int i = 0; i < groups_.size(); ++i) {
      const Group& group = groups_[i];
      if (group.middle.dot(direction) + group.half.dot(along) < most) continue;
      for (int k = group.begin; k < group.end; ++k) {
        const btScalar height = points_[k].dot(direction);
        if (height > most || (height == most && order_[k] < order_[found])) {
          most = height;
          found = k;
        }
      }
    }
    last_ = found;
    return points_[found];
  }

 private:
  static constexpr int LARGEST_GROUP = 12;

  struct Group {
    btVector3 middle, half;  // of a box around its points
    int begin, end;          // in points_
  };

  // Parts what is too large in two along its longest side.
  void group(int begin, int end) {
    const btVector3* corners = getUnscaledPoints();
    btVector3 low = corners[order_[begin]], high = low;
    for (int i = begin + 1; i < end; ++i) {
      low.setMin(corners[order_[i]]);
      high.setMax(corners[order_[i]]);
    }
    if (end - begin <= LARGEST_GROUP) {
      const btVector3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
      // A little more than the points need, so that rounding leaves none outside.
      groups_.push_back({middle, half + 1e-13 * (middle.absolute() + half), begin, end});
      return;
    }
    const int axis = (high - low).maxAxis();
    sort(&order_[begin], end - begin, [corners, axis](int p, int q) {
      return corners[p][axis] != corners[q][axis] ? corners[p][axis] < corners[q][axis] : p < q;
    });
    const int half = (begin + end) / 2;
    group(begin, half);
    group(half, end);
  }

  btAlignedObjectArray<Group> groups_;
  btAlignedObjectArray<int> order_;  // number of each entry of points_
  btAlignedObjectArray<btVector3> points_;
  mutable int last_ = 0;  // what was found last; it makes the search short, and changes no result
};

struct OneResult : btDiscreteCollisionDetectorInterface::Result {
  bool is_found = false;
  btVector3 normal_on_b;
  btVector3 on_b;
  btScalar distance = 0.0;

  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal, const btVector3& point, btScalar depth) override {
    is_found = true;
    normal_on_b = normal;
    on_b = point;
    distance = depth;
  }
};

}  // namespace

struct PlacedHulls::Ship {
  BT_DECLARE_ALIGNED_ALLOCATOR();

  ~Ship() {
    for (int i = 0; i < parts.size(); ++i) delete parts[i];
  }

  btAlignedObjectArray<GroupedHull*> parts;
  btTransform pose = btTransform(btMatrix3x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0));
};

PlacedHulls::PlacedHulls(int ships, const int* parts, const int* corners, const double* coordinates)
    : ships_(new Ship[static_cast<size_t>(ships)]) {
  for (int ship = 0; ship < ships; ++ship) {
    for (int part = 0; part < parts[ship]; ++part, ++corners) {
      auto* shape = new GroupedHull();
      shape->setMargin(MARGIN);
      for (int corner = 0; corner < *corners; ++corner, coordinates += 3) {
        shape->addPoint(swap_axes(coordinates), false);
      }
      shape->finish();
      ships_[ship].parts.push_back(shape);
    }
  }
}

PlacedHulls::~PlacedHulls() { delete[] ships_; }

int PlacedHulls::count_parts(int ship) const { return ships_[ship].parts.size(); }

int PlacedHulls::get_corners(int ship, int part, double* coordinates, int capacity) const {
  const btConvexHullShape& shape = *ships_[ship].parts[part];
  const int count = shape.getNumPoints();
  for (int i = 0; i < count && i < capacity; ++i) swap_axes(shape.getUnscaledPoints()[i], coordinates + 3 * i);
  return count;
}

void PlacedHulls::place(int ship, const double x[3], const double R_nb[9]) {
  double q[4];
  find_quaternion(R_nb, q);
  btTransform& pose = ships_[ship].pose;
  pose.setOrigin(swap_axes(x));
  pose.setRotation(btQuaternion(q[1], q[0], -q[2], q[3]));
}

bool PlacedHulls::closest_of_parts(int a, int part_a, int b, int part_b, double distance, Closest& found) const {
  const btConvexHullShape* shape_a = ships_[a].parts[part_a];
  const btConvexHullShape* shape_b = ships_[b].parts[part_b];
  const double threshold = distance - 2 * MARGIN;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
  input.m_transformA = ships_[a].pose;
  input.m_transformB = ships_[b].pose;
  input.m_maximumDistanceSquared = shape_a->getMargin() + shape_b->getMargin() + BREAKING_THRESHOLD + threshold;
  input.m_maximumDistanceSquared *= input.m_maximumDistanceSquared;
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;
  btGjkPairDetector detector(shape_a, shape_b, &simplex, &penetration);
  OneResult result;
  detector.getClosestPoints(input, result, nullptr);
  if (!result.is_found || !(result.distance <= threshold)) return false;
  const btVector3 on_a = result.on_b + result.normal_on_b * result.distance;
  double from_b[3];
  swap_axes(result.normal_on_b, from_b);  // Bullet's normal points from B to A
  swap_axes(on_a, found.on_a.at);
  swap_axes(result.on_b, found.on_b.at);
  for (int i = 0; i < 3; ++i) {
    found.normal[i] = -from_b[i];
    found.on_a[i] -= MARGIN * found.normal[i];
    found.on_b[i] += MARGIN * found.normal[i];
  }
  found.gap = result.distance + 2 * MARGIN;
  found.part_a = part_a;
  found.part_b = part_b;
  return true;
}

int PlacedHulls::closest(int a, int b, double distance, Closest* found) const {
  int count = 0;
  for (int i = 0; i < count_parts(a); ++i) {
    for (int j = 0; j < count_parts(b); ++j) count += closest_of_parts(a, i, b, j, distance, found[count]);
  }
  return count;
}

double PlacedHulls::gap(int a, int b, double cap) const {
  double least = cap;
  Closest found;
  for (int i = 0; i < count_parts(a); ++i) {
    for (int j = 0; j < count_parts(b); ++j) {
      if (closest_of_parts(a, i, b, j, least, found)) least = found.gap;
    }
  }
  return least;
}

}  // namespace shipcollision
