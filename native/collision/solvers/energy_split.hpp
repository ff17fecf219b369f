// The energy that contact loses, along the normal and by friction: the twin of
// shipcollision_fmu/collision/solvers/energy_split.py.
#pragma once

#include "../dynamics/passivity.hpp"
#include "impact_process.hpp"

namespace shipcollision {

class EnergySplit {
 public:
  explicit EnergySplit(Memory& memory)
      : groups_(memory), impulses_(memory), is_done_(memory), group_(memory), pair_(memory) {}

  // Energy lost at each impulse [J]. False without memory; `losses` has room for as many as `booked`.
  bool split_losses(const Booked* booked, int count, const BodyState* states, double friction, double restitution,
                    Loss* losses);

 private:
  void split_by_process(const Booked* booked, const BodyState* states, double mu, double e, Loss* losses);
  Loss estimate_pair(const Booked* booked, const BodyState* states, double mu, double e) const;
  void reduce(const Booked* booked, Contact& contact, Three& v) const;

  ImpulseGroups groups_;
  Buffer<Impulse> impulses_;
  Buffer<unsigned char> is_done_;
  Buffer<int> group_, pair_;  // numbers of impulses
};

}  // namespace shipcollision
