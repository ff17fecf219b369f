// Warm start: the twin of shipcollision_fmu/collision/solvers/warm_start.py.
#pragma once

#include "../../numbers/buffer.hpp"
#include "../dynamics/contact.hpp"

namespace shipcollision {

// Of a pair of ships: a place in b of ship a [m], and the impulse in n [N s] there.
struct WarmStart {
  int a, b;
  Three place, P;
};

class WarmStarts {
 public:
  explicit WarmStarts(Memory& memory) : rows_(memory) {}

  bool is_empty() const { return rows_.is_empty(); }
  // Impulses (3k) [N s] in contact axes to start from; zeros where none is known.
  void guess_impulses(const Contact* contacts, int count, double* P) const;
  // Replaces the impulses of the pairs that have some in this substep; the other pairs keep those they had.
  void keep_impulses(const Impulse* impulses, int count);
  // Drops the impulses of the pairs that are not near each other.
  template <typename IsNear>
  void forget_parted(IsNear is_near) {
    int kept = 0;
    for (const WarmStart& row : rows_) {
      if (is_near(row.a, row.b)) rows_[kept++] = row;
    }
    rows_.cut(kept);
  }

  // The state, and back to it.
  const Buffer<WarmStart>& rows() const { return rows_; }
  Buffer<WarmStart>& rows() { return rows_; }

 private:
  Buffer<WarmStart> rows_;
};

}  // namespace shipcollision
