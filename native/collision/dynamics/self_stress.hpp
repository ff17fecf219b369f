// Friction of a patch without self-stress: the twin of shipcollision_fmu/collision/dynamics/self_stress.py.
#pragma once

#include "../../numbers/dense.hpp"
#include "contact.hpp"

namespace shipcollision {

class SelfStress {
 public:
  explicit SelfStress(Memory& memory)
      : is_done_(memory), members_(memory), sticking_(memory), twists_(memory), root_(memory), T_(memory),
        least_(memory), N_(memory), split_(memory) {}

  // Splits anew the friction of every patch of sticking contacts. states: after the impulses have been booked; what the
  // held motions no longer take is booked. As they were without memory.
  void remove(Impulse* impulses, int count, BodyState* states, double mu);

 private:
  bool reserve(int contacts);
  bool split_anew(const Impulse* impulses, const BodyState* states, double mu);
  bool find_twists_of_friction(const Impulse* impulses, const BodyState* states);
  void find_least();
  double find_largest_share(double mu) const;
  void book_change(const Impulse* impulses, BodyState* states, bool of_b);

  Buffer<unsigned char> is_done_;
  Buffer<int> members_, sticking_;
  Dense twists_;
  Vector root_, T_, least_, N_;
  Buffer<Three> split_;
};

}  // namespace shipcollision
