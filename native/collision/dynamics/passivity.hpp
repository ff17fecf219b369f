// Passivity: the twin of shipcollision_fmu/collision/dynamics/passivity.py.
#pragma once

#include "../../numbers/buffer.hpp"
#include "contact.hpp"

namespace shipcollision {

// Impulses by the groups of bodies that they connect; obstacles connect none.
class ImpulseGroups {
 public:
  explicit ImpulseGroups(Memory& memory) : root_(memory), group_of_root_(memory), group_(memory) {}

  // Room for so many impulses of two bodies. False without memory, here and below.
  bool reserve(int count) { return root_.reserve(2) && group_.reserve(count) && group_of_root_.reserve(2); }
  bool find(const Impulse* impulses, int count, const BodyState* states);
  int count() const { return count_; }
  // The number of the group of an impulse; groups are numbered as they come.
  int operator[](int impulse) const { return group_[impulse]; }

 private:
  int find_root(int body) const {
    while (root_[body] != body) body = root_[body];
    return body;
  }

  Buffer<int> root_, group_of_root_, group_;
  int count_ = 0;
};

class Passivity {
 public:
  explicit Passivity(Memory& memory) : groups_(memory), passive_(memory), place_(memory), taken_(memory) {}

  // Scales impulses that would add energy, and gives the largest velocity [m/s] that a body lost by it. They come group
  // by group after it. As they were without memory.
  double enforce(Buffer<Impulse>& impulses, const BodyState* states);

 private:
  struct Taken {
    int body;
    Six J;
  };

  void add(int body, const Six& J);
  // The factor of a group, and where it is not 1 the largest change of the velocity of CO by it [m/s].
  double scale(const Impulse* group, int count, const BodyState* states, double& speed);

  ImpulseGroups groups_;
  Buffer<Impulse> passive_;
  Buffer<int> place_;  // of each body in taken_, or -1
  Buffer<Taken> taken_;
};

}  // namespace shipcollision
