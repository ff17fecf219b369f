#include "broad_phase.hpp"

#include "../../numbers/elementary.hpp"
#include "../../numbers/sort.hpp"

namespace shipcollision {
namespace {

constexpr int FEW = 64;
constexpr int MOST_CELLS = 1000;

bool meet(const Rectangle& one, const Rectangle& other) {
  return one.north_from <= other.north_to && other.north_from <= one.north_to && one.east_from <= other.east_to &&
         other.east_from <= one.east_to;
}

double longest_side(const Rectangle& r) { return max(r.north_to - r.north_from, r.east_to - r.east_from); }

double find_cell_size(const Buffer<Rectangle>& rectangles, int moving) {
  double size = moving > 0 ? longest_side(rectangles[0]) : 1.0, longest = 0.0;
  for (int i = 0; i < rectangles.size(); ++i) {
    const double side = longest_side(rectangles[i]);
    if (i < moving) size = max(size, side);
    longest = max(longest, side);
  }
  return max(max(size, longest / sqrt(static_cast<double>(MOST_CELLS))), 1e-6);
}

// Number of cells from one place to the other, never more than any rectangle has.
int count_cells(double from, double to) { return static_cast<int>(min(to - from, double{MOST_CELLS})) + 1; }

}  // namespace

void BroadPhase::near_pairs(const Buffer<Rectangle>& rectangles, int moving, Buffer<Pair>& pairs) {
  pairs.clear();
  if (rectangles.size() <= FEW) {
    for (int a = 0; a < moving; ++a) {
      for (int b = a + 1; b < rectangles.size(); ++b) {
        if (meet(rectangles[a], rectangles[b])) pairs.add({a, b});
      }
    }
    return;
  }
  fill_cells(rectangles, find_cell_size(rectangles, moving));
  for (int i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (cell.body >= moving) continue;
    for (int k = i + 1; k < cells_.size() && cells_[k].row == cell.row && cells_[k].column == cell.column; ++k) {
      if (meet(rectangles[cell.body], rectangles[cells_[k].body])) pairs.add({cell.body, cells_[k].body});
    }
  }
  sort(pairs.data(), pairs.size(), [](const Pair& p, const Pair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
  int count = 0;
  for (const Pair& pair : pairs) {
    if (count == 0 || !(pairs[count - 1] == pair)) pairs[count++] = pair;
  }
  pairs.cut(count);
}

void BroadPhase::fill_cells(const Buffer<Rectangle>& rectangles, double size) {
  cells_.clear();
  for (int i = 0; i < rectangles.size(); ++i) {
    const Rectangle& r = rectangles[i];
    const double row = floor(r.north_from / size), column = floor(r.east_from / size);
    const int rows = count_cells(row, floor(r.north_to / size)), columns = count_cells(column, floor(r.east_to / size));
    for (int m = 0; m < rows; ++m) {
      for (int n = 0; n < columns; ++n) cells_.add({row + m, column + n, i});
    }
  }
  sort(cells_.data(), cells_.size(), [](const Cell& p, const Cell& q) {
    if (p.row != q.row) return p.row < q.row;
    if (p.column != q.column) return p.column < q.column;
    return p.body < q.body;
  });
}

}  // namespace shipcollision
