// Pairs of bodies that could touch within a step: the twin of shipcollision_fmu/collision/proximity.py.
#pragma once

#include "bodies.hpp"
#include "geometry/broad_phase.hpp"
#include "geometry/detection.hpp"

namespace shipcollision {

struct NearPair {
  Pair pair;
  double gap;       // between the hulls [m]; where it can close within a substep, any that can
  double approach;  // bound of its speed [m/s]
};

// Least distance between hulls [m], and its pair, numbered from 1; (0, 0) where no hulls are within the range.
struct Clearance {
  double least;
  Pair nearest;
};

class Proximity {
 public:
  // bodies, detector: outlive it.
  Proximity(const Bodies& bodies, Detector& detector, double clearance_range, double substep, Memory& memory);

  // Pairs that could touch, or come within clearance_range, in H [s]. states, has_state: of the ships; one without is
  // taken as received. is_absent: ships that take no part, null for none.
  const Buffer<Pair>& find_candidates(const BodyState* states, const bool* has_state, const ShipState* received,
                                      double H, const bool* is_absent);
  // Candidates whose hulls, or fenders, could touch within H [s]. states: of all bodies.
  const Buffer<NearPair>& find_near(const Buffer<Pair>& candidates, const BodyState* states, double H);
  Clearance measure_clearance(const Buffer<Pair>& candidates, const BodyState* states);

 private:
  struct Bound {
    double distance;
    Pair pair;
  };

  double find_bounds_distance(const Pair& pair, const BodyState* states) const;

  const Bodies& bodies_;
  Detector& detector_;
  double range_, substep_;
  BroadPhase broad_phase_;
  Buffer<Rectangle> obstacles_, rectangles_;
  Buffer<Pair> pairs_;
  Buffer<NearPair> near_;
  Buffer<Bound> bounds_;
};

}  // namespace shipcollision
