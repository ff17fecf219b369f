// Which bodies could come near each other: the twin of shipcollision_fmu/collision/geometry/broad_phase.py.
#pragma once

#include "../../numbers/buffer.hpp"

namespace shipcollision {

struct Rectangle {
  double north_from, north_to, east_from, east_to;  // [m]
};

// Numbers of two bodies, a < b.
struct Pair {
  int a, b;
};

inline bool operator==(const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; }

class BroadPhase {
 public:
  explicit BroadPhase(Memory& memory) : cells_(memory) {}

  // Pairs, sorted, whose rectangles overlap or touch and of which the first is one of the `moving`, which come first.
  void near_pairs(const Buffer<Rectangle>& rectangles, int moving, Buffer<Pair>& pairs);

 private:
  struct Cell {
    double row, column;
    int body;
  };

  void fill_cells(const Buffer<Rectangle>& rectangles, double size);

  Buffer<Cell> cells_;
};

}  // namespace shipcollision
