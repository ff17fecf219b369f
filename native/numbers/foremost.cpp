#include "foremost.hpp"

namespace shipcollision {
namespace {

constexpr double ROUNDING = 1e-12;  // of heights, as a share of the largest coordinate; more than what they have
constexpr double BORDER = 1e-9;     // by which cells overlap, as a share of the cube's half edge
constexpr int CORNERS = 4;

}  // namespace

bool Foremost::set_up(const double* coordinates, int count) {
  count_ = count;
  if (!coordinates_.add(coordinates, 3 * count)) return false;
  slack_ = ROUNDING * largest_size(coordinates, 3 * count);
  if (count <= FEW || count >= ALL) return true;
  constexpr int CELLS = 6 * PARTS * PARTS;
  if (heights_.resize(CORNERS * count) && pool_.reserve(CELLS * IN_CELL)) cells_.fill(CELLS, {0, 0});
  return true;
}

int Foremost::find_among_all(double x, double y, double z) const {
  int found = 0;
  double most = height(0, x, y, z);
  for (int i = 1; i < count_; ++i) {
    const double other = height(i, x, y, z);
    if (other > most) {
      most = other;
      found = i;
    }
  }
  return found;
}

// A height is linear in the direction: a point that lies behind another one along all corners of a cell does so along
// every direction of the cell.
void Foremost::fill(int cell) {
  const int face = cell / (PARTS * PARTS), i = cell / PARTS % PARTS, k = cell % PARTS;
  int ahead[CORNERS];
  for (int corner = 0; corner < CORNERS; ++corner) {
    const int right = corner % 2, up = corner / 2;
    const double u = 2.0 * (i + right) / PARTS - 1.0 + (right == 1 ? BORDER : -BORDER);
    const double v = 2.0 * (k + up) / PARTS - 1.0 + (up == 1 ? BORDER : -BORDER);
    double d[3];
    d[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
    d[(face / 2 + 1) % 3] = u;
    d[(face / 2 + 2) % 3] = v;
    double* heights = &heights_[corner * count_];
    ahead[corner] = 0;
    for (int p = 0; p < count_; ++p) {
      heights[p] = height(p, d[0], d[1], d[2]);
      if (heights[p] > heights[ahead[corner]]) ahead[corner] = p;
    }
  }
  const int begin = pool_.size();
  for (int p = 0; p < count_; ++p) {
    bool can_be_foremost = true;
    for (const int other : ahead) {
      bool is_behind = true;
      for (int corner = 0; corner < CORNERS; ++corner) {
        const double* heights = &heights_[corner * count_];
        is_behind = is_behind && heights[other] - heights[p] > slack_;
      }
      can_be_foremost = can_be_foremost && !is_behind;
    }
    if (!can_be_foremost) continue;
    if (pool_.size() == 6 * PARTS * PARTS * IN_CELL) {
      pool_.cut(begin);
      cells_[cell] = {0, ALL};
      return;
    }
    pool_.add(static_cast<unsigned short>(p));
  }
  cells_[cell] = {static_cast<unsigned short>(begin), static_cast<unsigned short>(pool_.size() - begin)};
}

}  // namespace shipcollision
