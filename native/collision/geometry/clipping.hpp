// Common corners of two plane features: the twin of shipcollision_fmu/collision/geometry/clipping.py.
#pragma once

#include "../../numbers/buffer.hpp"

namespace shipcollision {

struct Point {
  double x, y;
};

// Convex hull of plane points, counter-clockwise. Sorts the points.
void convex_polygon(Buffer<Point>& points, Buffer<Point>& polygon);

// Corners of the intersection of two convex sets given by their corners, none when they do not overlap.
class Clipper {
 public:
  explicit Clipper(Memory& memory) : kept_(memory), out_(memory) {}

  // The answer holds until the next call.
  const Buffer<Point>& common_points(const Buffer<Point>& first, const Buffer<Point>& second);

 private:
  void clip(const Buffer<Point>& subject, const Buffer<Point>& polygon);
  void keep_inside(const Point& a, const Point& b);
  void cross_segments(const Buffer<Point>& first, const Buffer<Point>& second);
  void keep_distinct(const Buffer<Point>& points);

  Buffer<Point> kept_, out_;
};

}  // namespace shipcollision
