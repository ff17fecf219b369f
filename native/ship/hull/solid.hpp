// The convex parts of a hull: the twin of shipcollision_fmu/ship/hull/solid.py, without its surface.
#pragma once

#include "../../numbers/buffer.hpp"
#include "../frames.hpp"

namespace shipcollision {

// A point p is inside where normal . p <= offset.
struct HalfSpace {
  Three normal;
  double offset;
};

struct HullPart {
  const Three* corners;
  int corner_count;
  const HalfSpace* planes;
  int plane_count;
  int first_plane;  // its number among those of the hull
};

// Convex parts in b about CO. Fill it part by part: corners, planes, then end_part().
class HullMesh {
 public:
  HullMesh() = default;

  double reach = 0.0;   // no point of the hull is farther from CO [m]
  double extent = 0.0;  // least extent of the hull along the axes of b [m]

  int part_count() const { return ends_.size(); }
  int corner_count() const { return corners_.size(); }
  int plane_count() const { return planes_.size(); }
  const Three* corners() const { return corners_.data(); }
  HullPart part(int i) const {
    const End begin = i > 0 ? ends_[i - 1] : End{0, 0};
    return {corners_.data() + begin.corners, ends_[i].corners - begin.corners, planes_.data() + begin.planes,
            ends_[i].planes - begin.planes, begin.planes};
  }

  // False without memory.
  bool add_corner(const Three& corner) { return corners_.add(corner); }
  bool add_plane(const HalfSpace& plane) { return planes_.add(plane); }
  bool end_part() { return ends_.add({corners_.size(), planes_.size()}); }
  void clear() {
    corners_.clear();
    planes_.clear();
    ends_.clear();
  }

 private:
  struct End {
    int corners, planes;
  };

  Memory memory_;
  Buffer<Three> corners_{memory_};
  Buffer<HalfSpace> planes_{memory_};
  Buffer<End> ends_{memory_};
};

}  // namespace shipcollision
