// Relative velocities at the contacts, and the Delassus operator W: the twin of
// shipcollision_fmu/collision/dynamics/delassus.py.
#pragma once

#include "../../numbers/dense.hpp"
#include "contact.hpp"

namespace shipcollision {

// v (3k) [m/s], the mean expected over the step, in contact axes.
void approach_velocities(const Contact* contacts, int count, const BodyState* states, double* v);

// The operators of contacts, each in memory of its own.
class Delassus {
 public:
  explicit Delassus(Memory& memory) : W_(memory), H_(memory), moved_(memory), vertical_(memory) {}

  // Room for so many contacts; false without memory.
  bool reserve(int contacts);

  // W (3k, 3k) [1/kg] in contact axes.
  const Dense& find_operator(const Contact* contacts, int count, const BodyState* states);
  // H (3k, 3k) [1/kg] in contact axes; null where no motion is held.
  const Dense* find_held_operator(const Contact* contacts, int count, const BodyState* states);

 private:
  // Of a contact, in its axes: G of either body with its sign, and that times M^-1.
  struct Moved {
    Jacobian G_a, G_b, moved_a, moved_b;
  };
  // Of a contact: z down, and the vertical velocity g of it for each body, and D g.
  struct Vertical {
    bool holds_a, holds_b;
    Three down, g_a, g_b, moved_a, moved_b;
  };

  Dense W_, H_;
  Buffer<Moved> moved_;
  Buffer<Vertical> vertical_;
};

// W of one contact alone [1/kg], in contact axes: what a unit impulse does to its relative velocity.
Rows find_mobility(const Contact& contact, const BodyState* states);
// H of one contact alone; false where no motion is held.
bool find_held_mobility(const Contact& contact, const BodyState* states, Rows& H);

}  // namespace shipcollision
