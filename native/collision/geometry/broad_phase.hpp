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
  explicit BroadPhase(Memory& memory) : latest_(memory), entries_(memory) {}

  // Pairs, sorted, whose rectangles overlap or touch and of which the first is one of the `moving`, which come first.
  void near_pairs(const Buffer<Rectangle>& rectangles, int moving, Buffer<Pair>& pairs);

 private:
  static constexpr int CHAINS_OF_BODY = 4;
  static constexpr int LEAST_BITS = 8;
  static constexpr int MOST_BITS = 20;

  // A body in a cell.
  struct Entry {
    double row, column;
    int body;
    bool is_first_row, is_first_column;  // of the body
    int before;                          // the entry before it in its chain; -1: none
  };

  bool enter_cells(const Buffer<Rectangle>& rectangles, int moving, double size, Buffer<Pair>& pairs);

  Buffer<int> latest_;  // entry of each chain
  Buffer<Entry> entries_;
};

}  // namespace shipcollision
