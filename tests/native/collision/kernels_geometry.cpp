// The parts of native/collision/geometry.
#include "../../../native/collision/geometry/detection.hpp"
#include "../../../native/collision/geometry/plan_overlap.hpp"
#include "../../../native/collision/geometry/thickness.hpp"
#include "../../../native/collision/dynamics/contact_frame.hpp"
#include "../../../native/numbers/foremost.hpp"
#include "kernels.hpp"

using namespace shipcollision;

namespace {

Memory memory;

struct World {
  HullMesh* hulls = nullptr;
  int count = 0;
  Detector* detector = nullptr;

  void close() {
    delete detector;
    delete[] hulls;
    detector = nullptr;
    hulls = nullptr;
  }
};

World world;

void take_points(Take& take, Buffer<Point>& points) {
  const int count = take.whole();
  points.clear();
  for (int i = 0; i < count; ++i) points.add(take.all<Point>());
}

void put_points(double* out, const Buffer<Point>& points) {
  Put put{out};
  put.real(points.size());
  for (const Point& point : points) put.all(point);
}

// in: how many points, and they; how many directions, and they
void foremost(const double* in, double* out) {
  Take take{in};
  const int points = take.whole();
  Foremost numbers;
  numbers.set_up(take.in, points);
  take.in += 3 * points;
  for (int left = take.whole(); left > 0; --left) {
    const Three along = take.all<Three>();
    *out++ = numbers.find(along[0], along[1], along[2]);
  }
}

void polygon(const double* in, double* out) {
  Take take{in};
  Buffer<Point> points(memory), corners(memory);
  take_points(take, points);
  convex_polygon(points, corners);
  put_points(out, corners);
}

// in: 12 points and their number, 12 and theirs
void corners(const double* in, double* out) {
  Take first{in}, second{in + 25};
  Buffer<Point> points(memory), one(memory), other(memory);
  Clipper clipper(memory);
  take_points(first, points);
  convex_polygon(points, one);
  take_points(second, points);
  convex_polygon(points, other);
  put_points(out, clipper.common_points(one, other));
}

// in: depth, a normal, then 12 points in space of either feature and their number
void manifold(const double* in, double* out) {
  Take take{in};
  const double depth = take.real();
  const Three normal = take.all<Three>();
  Buffer<Three> parts[2] = {Buffer<Three>(memory), Buffer<Three>(memory)};
  for (int i = 0; i < 2; ++i) {
    take.in = in + 4 + 37 * i;
    for (int count = take.whole(); count > 0; --count) parts[i].add(take.all<Three>());
  }
  ContactPlaces maker(memory);
  maker.find_features(parts[0], parts[1], normal, depth);
  ContactPlace places[MANIFOLD];
  const int count = maker.find_manifold(contact_axes(normal), places);
  Put put{out};
  put.real(count);
  for (int i = 0; i < count; ++i) {
    put.all(places[i].point);
    put.real(places[i].gap);
  }
  PlanOverlaps plans(memory);
  const PlanOverlap plan = plans.least_overlap(parts[0], parts[1]);
  put.out = out + 17;
  put.real(plan.least);
  put.all(plan.normal);
  put.real(plan.carrier);
}

// in: number of rectangles, of those that move, the rectangles
void near(const double* in, double* out) {
  Take take{in};
  const int count = take.whole(), moving = take.whole();
  Buffer<Rectangle> rectangles(memory);
  for (int i = 0; i < count; ++i) rectangles.add(take.all<Rectangle>());
  Buffer<Pair> pairs(memory);
  BroadPhase(memory).near_pairs(rectangles, moving, pairs);
  Put put{out};
  put.real(pairs.size());
  for (const Pair& pair : pairs) {
    put.real(pair.a);
    put.real(pair.b);
  }
}

void width(const double* in, double* out) { out[0] = least_width(world.hulls[Take{in}.whole()]); }

void put_last(Put& put, const LastNormals& last_normals, const Pair& pair) {
  const LastNormal* last = last_normals.find(pair);
  put.real(last == nullptr ? -1.0 : last->carrier);
  put.all(last == nullptr ? Three{} : last->normal);
}

// in: numbers of two hulls, time of a first motion, time to look ahead, bound of the speed, distance, carrier and last
// normal, the two bodies
void detection(const double* in, double* out) {
  Take take{in};
  const Pair pair{take.whole(), take.whole()};
  const double moved = take.real(), ahead = take.real(), speed = take.real(), distance = take.real();
  const int carrier = take.whole();
  const Three normal = take.all<Three>();
  LastNormals last_normals(memory);
  if (carrier >= 0) last_normals.set(pair, {carrier, normal});
  Buffer<BodyState> states(memory);
  states.resize(world.count);
  states[pair.a] = take_state(take);
  states[pair.b] = take_state(take);
  states[pair.a].advance(moved);
  states[pair.b].advance(moved);
  Detector& detector = *world.detector;
  Put put{out};
  put.real(detector.clearance(pair, states.data(), distance));
  put.real(detector.touching(pair, states.data()));
  double touch = -1.0;
  if (!detector.first_touch(pair, states.data(), ahead, speed, last_normals, touch)) touch = -1.0;
  put.real(touch);
  put.real(detector.misses_first_touch(pair, states.data()));
  Contact facing;
  put.real(detector.facing(pair, distance, states.data(), last_normals, facing));
  put.all(put.out[-1] != 0.0 ? facing.point : Three{});
  put.all(put.out[-4] != 0.0 ? facing.normal : Three{});
  Buffer<Contact> contacts(memory);
  detector.contacts(pair, states.data(), last_normals, contacts);
  put_last(put, last_normals, pair);
  put.real(contacts.size());
  for (int i = 0; i < contacts.size() && i < 16; ++i) {
    put.all(contacts[i].point);
    put.all(contacts[i].normal);
    put.real(contacts[i].gap);
  }
}

constexpr Named KERNELS[] = {{"foremost", foremost}, {"polygon", polygon}, {"corners", corners},    {"manifold", manifold},
                             {"near", near},         {"width", width},     {"detection", detection}};

}  // namespace

SHIPCOLLISION_EXPORT bool shipcollision_evaluate_geometry(const char* name, const double* in, size_t ins, double* out,
                                                          size_t outs, size_t count) {
  return evaluate(KERNELS, name, in, ins, out, outs, count) && !memory.is_exhausted;
}

// The hulls of the kernels: their numbers of parts and extents; of each part, how many corners and planes, and these.
SHIPCOLLISION_EXPORT void shipcollision_set_hulls(int count, const int* parts, const double* extents, const int* sizes,
                                                  const Three* corners, const HalfSpace* planes) {
  world.close();
  world.count = count;
  world.hulls = new HullMesh[static_cast<size_t>(count)];
  Buffer<const HullMesh*> hulls(memory);
  for (int i = 0; i < count; ++i) {
    world.hulls[i].extent = extents[i];
    for (int k = 0; k < parts[i]; ++k, sizes += 2) {
      for (int m = 0; m < sizes[0]; ++m) world.hulls[i].add_corner(*corners++);
      for (int m = 0; m < sizes[1]; ++m) world.hulls[i].add_plane(*planes++);
      world.hulls[i].end_part();
    }
    hulls.add(&world.hulls[i]);
  }
  world.detector = new Detector(memory);
  world.detector->set_up(hulls.data(), count);
}
