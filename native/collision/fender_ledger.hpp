// Energy in the fenders of a run, and one substep of the compressed ones: the twin of
// shipcollision_fmu/collision/fender_ledger.py.
#pragma once

#include "contact_points.hpp"
#include "contact_problem.hpp"
#include "proximity.hpp"

namespace shipcollision {

// A pair with a fender between it, and that fender.
struct FenderPair {
  Pair pair;
  Fender fender;
};

void select_fenders(const Bodies& bodies, const Buffer<NearPair>& near, Buffer<FenderPair>& fenders);

class FenderLedger {
 public:
  explicit FenderLedger(Memory& memory) : stored_(memory) {}

  // Stored now, and dissipated so far, in all of them [J].
  FenderOutput energy() const;
  // One substep of h [s] of these fenders, one after the other. Adds to the points those of the fenders.
  void press(const Buffer<FenderPair>& fenders, Detector& detector, const LastNormals& last_normals, BodyState* states,
             double friction, double h, ContactPoints& points);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  struct Stored {
    Pair pair;
    double energy;
  };

  Stored* find(const Pair& pair);
  void release(const Pair& pair);
  void press_one(const Fender& fender, const Contact& contact, BodyState* states, double friction, double h,
                 ContactPoints& points);

  Buffer<Stored> stored_;
  double dissipated_ = 0.0;
};

}  // namespace shipcollision
