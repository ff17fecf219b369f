// Closest points of convex hulls, by Bullet: the twin of shipcollision_fmu/collision/geometry/closest_points.py.
//
// Bullet's world has its z axis up. Vectors change between n and w, and between the body axes, by (y, x, -z).
#include "closest_points.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <stdlib.h>
#include <string.h>

#include "../../numbers/foremost.hpp"

namespace shipcollision {

namespace {

// Bullet looks no farther than this beyond the distance asked for [m]. Any positive length gives the same results, a
// larger one takes longer.
constexpr double BREAKING_THRESHOLD = 0.02;

// Bullet fills tables of directions when the first hull is made. This makes one while the library is loaded, by one
// thread, so that two threads that open their first worlds never write there.
__attribute__((constructor)) void fill_tables() { const btConvexHullShape first; }

// The value rounded to the last bit of `by`.
double snap(double value, double by) { return (value + by) - by; }

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
// all.
class QuickHull : public btConvexHullShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  // After the last point.
  void finish() {
    optimizeConvexHull();
    btAlignedObjectArray<btScalar> coordinates;
    for (int i = 0; i < getNumPoints(); ++i) {
      for (int k = 0; k < 3; ++k) coordinates.push_back(getUnscaledPoints()[i][k]);
    }
    if (!foremost_.set_up(&coordinates[0], getNumPoints())) return;
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;  // of Bullet's own type, it would search by itself
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const double* found = foremost_.point(foremost_.find(direction.x(), direction.y(), direction.z()));
    return btVector3(found[0], found[1], found[2]);
  }

  // Largest height of a corner along a direction in b [m].
  double reach_along(const Three& direction) const {
    const btVector3 along = swap_axes(direction.at);
    return localGetSupportVertexWithoutMarginNonVirtual(along).dot(along);
  }

 private:
  mutable Foremost foremost_;  // what it keeps makes the search short, and changes no result
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

  btAlignedObjectArray<QuickHull*> parts;
  btTransform pose = btTransform(btMatrix3x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0));
  int first_part = 0;  // its number among those of all ships
  Pose placed{};       // as it was given
  long long times_placed = 0;
};

// The latest answer for two parts. It holds until one of them is placed elsewhere. What else is kept makes later
// answers short, and changes none of them.
struct PlacedHulls::Answer {
  // Parts that are farther apart than asked for by this [m], along a normal that is kept, are not shown to Bullet. In
  // that range its answers are regular: it takes cores nearer than 1e-6 m for touching.
  static constexpr double SURELY = 2e-6;

  int part_a, part_b;            // among those of all ships
  long long placed_a, placed_b;  // how often the ships were placed by then
  double distance;               // up to which was looked
  bool is_found;
  Closest found;
  Three normal_in_a, normal_in_b;  // of a plane between the parts, as either ship carries it
  double reach_a, reach_b;         // of the parts towards each other along it
  bool has_points;
  Three point_in_a, point_in_b;  // of either part

  // Keeps the normal, and the points if they were found, as the ships carry them.
  void keep(const Ship& one, const QuickHull& of_one, const Ship& other, const QuickHull& of_other,
            const Three& normal) {
    normal_in_a = rotate_back(one.placed.R, normal);
    normal_in_b = rotate_back(other.placed.R, normal);
    reach_a = of_one.reach_along(normal_in_a);
    reach_b = of_other.reach_along(-normal_in_b);
    has_points = is_found;
    if (!is_found) return;
    point_in_a = rotate_back(one.placed.R, found.on_a - one.placed.x);
    point_in_b = rotate_back(other.placed.R, found.on_b - other.placed.x);
  }

  // Distance [m] that the parts surely have where the ships are now; -INFINITE without any.
  double find_sure_distance(const Ship& one, const QuickHull& of_one, const Ship& other,
                            const QuickHull& of_other) const {
    const Three between = other.placed.x - one.placed.x;
    const Three by_a = rotate(one.placed.R, normal_in_a), by_b = rotate(other.placed.R, normal_in_b);
    const double along_a = dot(by_a, between) - reach_a - of_other.reach_along(-rotate_back(other.placed.R, by_a));
    const double along_b = dot(by_b, between) - reach_b - of_one.reach_along(rotate_back(one.placed.R, by_b));
    const double most = max(along_a, along_b) - SURELY;
    return most > 0.0 ? most : -INFINITE;
  }

  // Whether the points that are kept are now nearer to each other than `distance` [m].
  bool has_points_within(const Ship& one, const Ship& other, double distance) const {
    const Three on_a = rotate(one.placed.R, point_in_a), on_b = rotate(other.placed.R, point_in_b);
    return has_points && norm((other.placed.x - one.placed.x) + (on_b - on_a)) < distance;
  }
};

namespace {

// Whether Bullet has found closest points; they may be a little farther apart than `distance`. normal: of the parts, or
// of a plane between them.
bool ask_bullet(const btTransform& pose_a, const QuickHull& part_a, const btTransform& pose_b, const QuickHull& part_b,
                double distance, Closest& found, Three& normal) {
  const double threshold = distance - 2 * MARGIN;
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
  input.m_transformA = pose_a;
  input.m_transformB = pose_b;
  input.m_maximumDistanceSquared = part_a.getMargin() + part_b.getMargin() + BREAKING_THRESHOLD + threshold;
  input.m_maximumDistanceSquared *= input.m_maximumDistanceSquared;
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;
  btGjkPairDetector detector(&part_a, &part_b, &simplex, &penetration);
  OneResult result;
  detector.getClosestPoints(input, result, nullptr);
  // Nearer than where Bullet gives up, its result does not depend on `distance`.
  const bool is_found = result.is_found && result.distance <= threshold + 0.5 * BREAKING_THRESHOLD;
  // Bullet's normals point from B to A.
  const btVector3 towards_a = is_found ? result.normal_on_b : detector.getCachedSeparatingAxis();
  swap_axes(towards_a, normal.at);
  normal = -normal;
  if (!is_found) {
    const double size = norm(normal);
    normal = size > 0.0 ? (1.0 / size) * normal : Three{};
    return false;
  }
  const btVector3 on_a = result.on_b + result.normal_on_b * result.distance;
  swap_axes(on_a, found.on_a.at);
  swap_axes(result.on_b, found.on_b.at);
  for (int i = 0; i < 3; ++i) {
    found.on_a[i] -= MARGIN * normal[i];
    found.on_b[i] += MARGIN * normal[i];
  }
  found.normal = normal;
  found.gap = result.distance + 2 * MARGIN;
  return true;
}

}  // namespace

PlacedHulls::PlacedHulls(int ships, const int* parts, const int* corners, const double* coordinates)
    : ships_(new Ship[static_cast<size_t>(ships)]) {
  for (int ship = 0; ship < ships; ++ship) {
    ships_[ship].first_part = parts_;
    parts_ += parts[ship];
    for (int part = 0; part < parts[ship]; ++part, ++corners) {
      auto* shape = new QuickHull();
      shape->setMargin(MARGIN);
      for (int corner = 0; corner < *corners; ++corner, coordinates += 3) {
        shape->addPoint(swap_axes(coordinates), false);
      }
      shape->finish();
      ships_[ship].parts.push_back(shape);
    }
  }
  answer_bits_ = LEAST_BITS;
  while (1 << answer_bits_ < ANSWERS_OF_PART * parts_ && answer_bits_ < MOST_BITS) ++answer_bits_;
  answers_ = static_cast<Answer*>(calloc(size_t{1} << answer_bits_, sizeof(Answer)));
  for (int i = 0; i < 1 << answer_bits_ && answers_ != nullptr; ++i) answers_[i].part_a = -1;
}

PlacedHulls::~PlacedHulls() {
  free(answers_);
  delete[] ships_;
}

int PlacedHulls::count_parts(int ship) const { return ships_[ship].parts.size(); }

int PlacedHulls::get_corners(int ship, int part, double* coordinates, int capacity) const {
  const btConvexHullShape& shape = *ships_[ship].parts[part];
  const int count = shape.getNumPoints();
  for (int i = 0; i < count && i < capacity; ++i) swap_axes(shape.getUnscaledPoints()[i], coordinates + 3 * i);
  return count;
}

void PlacedHulls::place(int ship, const double x[3], const double R_nb[9]) {
  Ship& moved = ships_[ship];
  if (moved.times_placed > 0 && memcmp(x, moved.placed.x.at, sizeof moved.placed.x) == 0 &&
      memcmp(R_nb, moved.placed.R.at, sizeof moved.placed.R) == 0) {
    return;
  }
  memcpy(moved.placed.x.at, x, sizeof moved.placed.x);
  memcpy(moved.placed.R.at, R_nb, sizeof moved.placed.R);
  ++moved.times_placed;
  double q[4];
  find_quaternion(R_nb, q);
  btTransform& pose = moved.pose;
  for (double& each : q) each = snap(each, SNAP_QUATERNION);
  const double at[3] = {snap(x[0], SNAP_PLACE), snap(x[1], SNAP_PLACE), snap(x[2], SNAP_PLACE)};
  pose.setOrigin(swap_axes(at));
  pose.setRotation(btQuaternion(q[1], q[0], -q[2], q[3]));
}

bool PlacedHulls::closest_of_parts(int a, int part_a, int b, int part_b, double distance, Closest& found) const {
  const Ship &one = ships_[a], &other = ships_[b];
  const int number_a = one.first_part + part_a, number_b = other.first_part + part_b;
  Answer alone;
  alone.part_a = -1;
  Answer& answer = answers_ != nullptr ? find_answer(number_a, number_b) : alone;
  const bool has_normal = answer.part_a == number_a && answer.part_b == number_b;
  const bool is_known = has_normal && answer.placed_a == one.times_placed && answer.placed_b == other.times_placed;
  if (!is_known || !(answer.is_found || distance <= answer.distance)) {
    const QuickHull &of_one = *one.parts[part_a], &of_other = *other.parts[part_b];
    answer.part_a = number_a;
    answer.part_b = number_b;
    answer.placed_a = one.times_placed;
    answer.placed_b = other.times_placed;
    answer.is_found = false;
    answer.distance = has_normal ? answer.find_sure_distance(one, of_one, other, of_other) : -INFINITE;
    if (!(distance <= answer.distance)) {
      Three normal;
      answer.distance = distance;
      answer.is_found = ask_bullet(one.pose, of_one, other.pose, of_other, distance, answer.found, normal);
      answer.found.part_a = part_a;
      answer.found.part_b = part_b;
      answer.keep(one, of_one, other, of_other, normal);
    }
  }
  if (!answer.is_found || !(answer.found.gap <= distance)) return false;
  found = answer.found;
  return true;
}

PlacedHulls::Answer& PlacedHulls::find_answer(int part_a, int part_b) const {
  const unsigned number = static_cast<unsigned>(part_a * parts_ + part_b);
  return answers_[number * 2654435769u >> (32 - answer_bits_)];
}

int PlacedHulls::closest(int a, int b, double distance, Closest* found) const {
  int count = 0;
  for (int i = 0; i < count_parts(a); ++i) {
    for (int j = 0; j < count_parts(b); ++j) count += closest_of_parts(a, i, b, j, distance, found[count]);
  }
  return count;
}

bool PlacedHulls::are_surely_within(int a, int b, double distance) const {
  const Ship &one = ships_[a], &other = ships_[b];
  if (answers_ == nullptr) return false;
  for (int i = 0; i < one.parts.size(); ++i) {
    for (int j = 0; j < other.parts.size(); ++j) {
      const Answer& answer = find_answer(one.first_part + i, other.first_part + j);
      if (answer.part_a == one.first_part + i && answer.part_b == other.first_part + j &&
          answer.has_points_within(one, other, distance)) {
        return true;
      }
    }
  }
  return false;
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
