// The foremost of some points along a direction, without looking at all of them.
#pragma once

#include "dense.hpp"

namespace shipcollision {

// Directions are sorted into the cells of a cube around the points. Which points can be foremost along a direction of a
// cell is found when the cell is first asked for, and kept: the answer depends on points and direction alone.
class Foremost {
 public:
  // x, y, z of each point, to be called once. False without memory for them: find() then must not be called. Without
  // memory for more, it looks at all points.
  bool set_up(const double* coordinates, int count);

  // The lowest number of those with the largest of d'p, summed in the order of x, y and z.
  int find(double x, double y, double z) {
    const int cell = find_cell(x, y, z);
    if (cell < 0) return find_among_all(x, y, z);
    if (cells_[cell].count == 0) fill(cell);
    const Cell& of = cells_[cell];
    if (of.count == ALL) return find_among_all(x, y, z);
    const unsigned short* numbers = pool_.data() + of.begin;
    int found = numbers[0];
    double most = height(found, x, y, z);
    for (int i = 1; i < of.count; ++i) {
      const double other = height(numbers[i], x, y, z);
      if (other > most) {
        most = other;
        found = numbers[i];
      }
    }
    return found;
  }

  const double* point(int i) const { return coordinates_.data() + 3 * i; }

 private:
  static constexpr int PARTS = 9;    // of an edge of the cube; odd, so that its axes are inside of cells
  static constexpr int FEW = 16;     // points that are looked at one by one
  static constexpr int ALL = 65535;
  static constexpr int IN_CELL = 6;  // numbers that a cell may have in the mean

  struct Cell {
    unsigned short begin, count;  // in pool_; 0 for one not yet asked for, ALL for all points
  };

  // -1 for a direction that has none.
  int find_cell(double x, double y, double z) const {
    if (cells_.is_empty()) return -1;
    const double a = abs(x), b = abs(y), c = abs(z);
    int face;
    double along, u, v;
    if (a >= b && a >= c) {
      face = x < 0.0 ? 1 : 0, along = a, u = y, v = z;
    } else if (b >= c) {
      face = y < 0.0 ? 3 : 2, along = b, u = z, v = x;
    } else {
      face = z < 0.0 ? 5 : 4, along = c, u = x, v = y;
    }
    if (!(along > 1e-100 && along < 1e100)) return -1;
    const double share = 0.5 * PARTS / along;
    const int i = static_cast<int>(u * share + 0.5 * PARTS), k = static_cast<int>(v * share + 0.5 * PARTS);
    return (face * PARTS + (i < PARTS ? i : PARTS - 1)) * PARTS + (k < PARTS ? k : PARTS - 1);
  }
  double height(int i, double x, double y, double z) const {
    const double* p = coordinates_.data() + 3 * i;
    return p[0] * x + p[1] * y + p[2] * z;
  }
  int find_among_all(double x, double y, double z) const;
  void fill(int cell);

  Memory memory_;
  Buffer<double> coordinates_{memory_}, heights_{memory_};
  Buffer<Cell> cells_{memory_};
  Buffer<unsigned short> pool_{memory_};
  int count_ = 0;
  double slack_ = 0.0;
};

}  // namespace shipcollision
