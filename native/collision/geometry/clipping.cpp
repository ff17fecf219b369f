#include "clipping.hpp"

#include "../../numbers/elementary.hpp"
#include "../../numbers/sort.hpp"

namespace shipcollision {
namespace {

constexpr double TOUCH = 1e-6;

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double span(const Point& a, const Point& b) { return hypot(b.x - a.x, b.y - a.y); }

bool is_before(const Point& p, const Point& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); }

// Adds a corner to the chain that begins at entry `start` of the polygon.
void extend_chain(Buffer<Point>& polygon, int start, const Point& q) {
  while (polygon.size() - start >= 2) {
    const Point& from = polygon[polygon.size() - 2];
    if (cross(from, polygon.last(), q) > TOUCH * span(from, q)) break;
    polygon.cut(polygon.size() - 1);
  }
  polygon.add(q);
}

// Where the segment p q crosses the line a b.
Point meet(const Point& a, const Point& b, const Point& p, const Point& q) {
  const double s = cross(a, b, p), t = cross(a, b, q);
  const double w = s / (s - t);
  return {p.x + w * (q.x - p.x), p.y + w * (q.y - p.y)};
}

bool is_on_segment(const Point& q, const Buffer<Point>& segment) {
  if (segment.size() == 1) return span(q, segment[0]) <= TOUCH;
  const Point &a = segment[0], &b = segment[1];
  const double length = span(a, b);
  const double along = ((q.x - a.x) * (b.x - a.x) + (q.y - a.y) * (b.y - a.y)) / length;
  return abs(cross(a, b, q)) <= TOUCH * length && -TOUCH <= along && along <= length + TOUCH;
}

}  // namespace

void convex_polygon(Buffer<Point>& points, Buffer<Point>& polygon) {
  sort(points.data(), points.size(), is_before);
  int count = 0;
  for (const Point& p : points) {
    if (count == 0 || is_before(points[count - 1], p)) points[count++] = p;
  }
  points.cut(count);
  polygon.clear();
  if (count < 3) {
    polygon.add(points.data(), count);
    return;
  }
  for (int i = 0; i < count; ++i) extend_chain(polygon, 0, points[i]);
  polygon.cut(polygon.size() - 1);
  const int start = polygon.size();
  for (int i = count - 1; i >= 0; --i) extend_chain(polygon, start, points[i]);
  polygon.cut(polygon.size() - 1);
}

const Buffer<Point>& Clipper::common_points(const Buffer<Point>& first, const Buffer<Point>& second) {
  if (first.size() > second.size()) return common_points(second, first);
  out_.clear();
  if (first.is_empty()) return out_;
  if (second.size() >= 3) {
    clip(first, second);
  } else if (first.size() == 1) {
    if (is_on_segment(first[0], second)) out_.add(first[0]);
  } else {
    cross_segments(first, second);
  }
  return out_;
}

void Clipper::clip(const Buffer<Point>& subject, const Buffer<Point>& polygon) {
  kept_.clear();
  kept_.add(subject.data(), subject.size());
  for (int i = 0; i < polygon.size() && !kept_.is_empty(); ++i) {
    out_.clear();
    out_.add(kept_.data(), kept_.size());
    keep_inside(polygon[i], polygon[i + 1 < polygon.size() ? i + 1 : 0]);
  }
  keep_distinct(kept_);
}

// Keeps of `out_` what does not lie to the right of the side a b.
void Clipper::keep_inside(const Point& a, const Point& b) {
  const double limit = -TOUCH * span(a, b);
  kept_.clear();
  const int count = out_.size();
  const int pairs = count == 2 ? 1 : count;  // a segment has one side, a polygon closes on itself
  for (int i = 0; i < pairs; ++i) {
    const Point &p = out_[i], &q = out_[i + 1 < count ? i + 1 : 0];
    const bool is_inside = cross(a, b, p) >= limit, is_next_inside = cross(a, b, q) >= limit;
    if (is_inside) kept_.add(p);
    if (is_inside != is_next_inside) kept_.add(meet(a, b, p, q));
  }
  if (count == 2 && cross(a, b, out_[1]) >= limit) kept_.add(out_[1]);
}

// The crossing point of two segments, or the ends of their common stretch when they lie on one line.
void Clipper::cross_segments(const Buffer<Point>& first, const Buffer<Point>& second) {
  const Point &a = first[0], &b = first[1], &c = second[0], &d = second[1];
  const double s = cross(a, b, c), t = cross(a, b, d);
  if (max(abs(s), abs(t)) <= TOUCH * max(span(a, b), span(c, d))) {
    kept_.clear();
    for (const Point& q : second) {
      if (is_on_segment(q, first)) kept_.add(q);
    }
    for (const Point& q : first) {
      if (is_on_segment(q, second)) kept_.add(q);
    }
    keep_distinct(kept_);
  } else if (!(s * t > 0.0 || cross(c, d, a) * cross(c, d, b) > 0.0)) {
    out_.add(meet(a, b, c, d));
  }
}

void Clipper::keep_distinct(const Buffer<Point>& points) {
  out_.clear();
  for (const Point& q : points) {
    bool is_new = true;
    for (const Point& other : out_) is_new = is_new && span(q, other) > TOUCH;
    if (is_new) out_.add(q);
  }
}

}  // namespace shipcollision
