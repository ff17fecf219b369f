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

// Of a cell, the number of the chain that its entries are in. Different cells may share one.
int find_chain(double row, double column, int bits) {
  const auto r = static_cast<unsigned long long>(static_cast<long long>(row));
  const auto c = static_cast<unsigned long long>(static_cast<long long>(column));
  return static_cast<int>((r * 0x9e3779b97f4a7c15ull + c * 0xc2b2ae3d27d4eb4full) >> (64 - bits));
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
  if (enter_cells(rectangles, moving, find_cell_size(rectangles, moving), pairs)) {
    sort(pairs.data(), pairs.size(),
         [](const Pair& p, const Pair& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
  }
}

// Enters the bodies in their cells, one after the other, and compares each with those that are in a cell already. False
// without memory.
bool BroadPhase::enter_cells(const Buffer<Rectangle>& rectangles, int moving, double size, Buffer<Pair>& pairs) {
  int bits = LEAST_BITS;
  while (1 << bits < CHAINS_OF_BODY * rectangles.size() && bits < MOST_BITS) ++bits;
  entries_.clear();
  if (!latest_.fill(1 << bits, -1)) return false;
  for (int i = 0; i < rectangles.size(); ++i) {
    const Rectangle& r = rectangles[i];
    const double row = floor(r.north_from / size), column = floor(r.east_from / size);
    const int rows = count_cells(row, floor(r.north_to / size)), columns = count_cells(column, floor(r.east_to / size));
    for (int m = 0; m < rows; ++m) {
      for (int n = 0; n < columns; ++n) {
        const Entry entry{row + m, column + n, i, m == 0, n == 0, -1};
        int& latest = latest_[find_chain(entry.row, entry.column, bits)];
        for (int k = latest; k >= 0; k = entries_[k].before) {
          const Entry& other = entries_[k];
          if (other.row != entry.row || other.column != entry.column || other.body >= moving) continue;
          // Of the cells that both are in, the first alone counts.
          const bool is_first_row = entry.is_first_row || other.is_first_row;
          const bool is_first_column = entry.is_first_column || other.is_first_column;
          if (is_first_row && is_first_column && meet(rectangles[other.body], r)) pairs.add({other.body, i});
        }
        const int before = latest;
        if (!entries_.add(entry)) return false;
        entries_.last().before = before;
        latest = entries_.size() - 1;
      }
    }
  }
  return true;
}

}  // namespace shipcollision
