// Closest points of convex hulls, by Bullet: the twin of shipcollision_fmu/collision/geometry/closest_points.py.
//
// Bullet's world has its z axis up. Vectors change between n and w, and between the body axes, by (y, x, -z).
#include "closest_points.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <string.h>

#include "../../numbers/foremost.hpp"

namespace shipcollision {

namespace {

// Bullet looks no farther than this beyond the distance asked for [m]. Any positive length gives the same results, a
// larger one takes longer.
constexpr double BREAKING_THRESHOLD = 0.02;

// Of the latest answers that are kept: how many for each part, and the logarithms of the least and the largest number.
constexpr int ANSWERS_OF_PART = 4;
constexpr int LEAST_BITS = 4;
constexpr int MOST_BITS = 12;

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
    foremost_.set_up(&coordinates[0], getNumPoints());
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;  // of Bullet's own type, it would search by itself
  }

  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    return getUnscaledPoints()[foremost_.find(direction.x(), direction.y(), direction.z())];
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

// The latest answer for two parts. It holds until one of them is placed elsewhere.
struct PlacedHulls::Answer {
  int part_a, part_b;             // among those of all ships
  long long placed_a, placed_b;  // how often the ships were placed by then
  double distance;               // up to which was looked
  bool is_found;
  Closest found;
};

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
  answers_ = new Answer[size_t{1} << answer_bits_]();
  for (int i = 0; i < 1 << answer_bits_; ++i) answers_[i].part_a = -1;
}

PlacedHulls::~PlacedHulls() {
  delete[] answers_;
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
  pose.setOrigin(swap_axes(x));
  pose.setRotation(btQuaternion(q[1], q[0], -q[2], q[3]));
}

bool PlacedHulls::closest_of_parts(int a, int part_a, int b, int part_b, double distance, Closest& found) const {
  const Ship &one = ships_[a], &other = ships_[b];
  const int number_a = one.first_part + part_a, number_b = other.first_part + part_b;
  Answer& answer = find_answer(number_a, number_b);
  const bool is_known = answer.placed_a == one.times_placed && answer.placed_b == other.times_placed &&
                        answer.part_a == number_a && answer.part_b == number_b &&
                        (answer.is_found || distance <= answer.distance);
  if (!is_known) {
    answer = {number_a, number_b, one.times_placed, other.times_placed, distance, false, {}};
    answer.is_found = ask_bullet(a, part_a, b, part_b, distance, answer.found);
  }
  if (!answer.is_found || !(answer.found.gap <= distance)) return false;
  found = answer.found;
  return true;
}

PlacedHulls::Answer& PlacedHulls::find_answer(int part_a, int part_b) const {
  const unsigned number = static_cast<unsigned>(part_a * parts_ + part_b);
  return answers_[number * 2654435769u >> (32 - answer_bits_)];
}

// Whether Bullet has found closest points; they may be a little farther apart than `distance`.
bool PlacedHulls::ask_bullet(int a, int part_a, int b, int part_b, double distance, Closest& found) const {
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
  // Nearer than where Bullet gives up, its result does not depend on `distance`.
  if (!result.is_found || !(result.distance <= threshold + 0.5 * BREAKING_THRESHOLD)) return false;
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
