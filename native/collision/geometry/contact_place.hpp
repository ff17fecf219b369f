// Contact points of two convex parts, given the normal: the twin of shipcollision_fmu/collision/geometry/contact_place.py.
#pragma once

#include "../../ship/frames.hpp"
#include "clipping.hpp"

namespace shipcollision {

constexpr double FEATURE_DEPTH = 0.05;
constexpr int MANIFOLD = 4;

// A point in n, and the gap there [m].
struct ContactPlace {
  Three point;
  double gap;
};

// At most MANIFOLD corners that still span the area, into `corners`, which may be those given.
int spread(const Point* given, int count, Point (&corners)[MANIFOLD]);

// Makes contact points, and keeps memory for them.
class ContactPlaces {
 public:
  explicit ContactPlaces(Memory& memory)
      : feature_a(memory), feature_b(memory), clipper_(memory), points_(memory), plan_a_(memory), plan_b_(memory) {}

  Buffer<Three> feature_a, feature_b;

  // The points of either part that face the other: within `depth` of the foremost along the normal, which points from
  // a to b.
  void find_features(const Buffer<Three>& part_a, const Buffer<Three>& part_b, const Three& normal, double depth);
  // A contact point midway between the features at each common corner; returns how many, 0 when they pass each other.
  int find_manifold(const Rows& axes, ContactPlace (&places)[MANIFOLD]);

 private:
  void make_plan(const Buffer<Three>& feature, const Three& origin, const Rows& axes, Buffer<Point>& plan);

  Clipper clipper_;
  Buffer<Point> points_, plan_a_, plan_b_;
};

}  // namespace shipcollision
