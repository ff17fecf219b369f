// Which pair of bodies is examined at which substep: the twin of shipcollision_fmu/collision/conservative_advancement.py.
#pragma once

#include "proximity.hpp"

namespace shipcollision {

// Substeps of communication steps, the pairs due at each, and the motion of the bodies up to it. For each step begin(),
// for each substep pairs_due() and, where some are, advance() and next() until it answers false; then finish().
class ConservativeAdvancement {
 public:
  // bodies, detector: outlive it.
  ConservativeAdvancement(const Bodies& bodies, Detector& detector, Memory& memory);

  // A step of H [s]. near: pairs that could touch within it; states, last_normals: used until finish(). False for too
  // many substeps.
  bool begin(double H, double substep, BodyState* states, LastNormals& last_normals, const Buffer<NearPair>& near,
             Text& why);
  int count() const { return count_; }
  double h() const { return h_; }

  // Pairs to be examined at the end of a substep, counted from 0. Call it for every substep in turn.
  const Buffer<Pair>& pairs_due(int substep);
  // Begins to move the near bodies through a substep for which pairs are due.
  void advance(int substep);
  // Moves them to the next first touch or to the end; false after the end. moment: time [s] since the start of the
  // step; pairs: to be examined there. Twists may change in between: set `touched` then.
  bool next(double& moment, const Buffer<Pair>*& pairs);
  // Moves the near bodies to the end of the communication step.
  void finish();

  bool touched = false;
  int touches_left = 0;
  // The warning of the step from t [s] if it has fewer substeps than were asked for.
  bool is_limited() const { return count_ < requested_; }
  void describe_limited(double t, Text& text) const;
  // The warning of the step from t [s] if it had more first touches than are looked for.
  void describe_exhausted(double t, Text& text) const;

 private:
  struct Entry {
    Pair pair;
    bool has_approach;
    double approach;  // bound [m/s] until twists change
    int due;
    double fast;      // speed limit [m/s]
    bool is_apart;    // when last measured
    bool is_due;      // at this substep
  };
  struct FastPair {
    Pair pair;
    double speed;
  };
  enum class Stop { touch, end, over };

  void list_moving(const Buffer<NearPair>& near);
  bool has_fender(const Pair& pair) const;
  void examine(bool all);
  bool advance_to_touch(double rest, double& touch);
  bool return_to_missed_touch(double moved, double& touch);
  void find_missed();
  void find_fast();
  bool find_first_touch(const Buffer<FastPair>& pairs, double rest, double& touch);
  void advance_pending();
  void reschedule();
  double find_relative_speed(const Pair& pair) const;
  int count_free_substeps(Entry& entry, double gap);
  double find_approach_speed(Entry& entry);
  void forget_approach();

  const Bodies& bodies_;
  Detector& detector_;
  BodyState* states_ = nullptr;
  LastNormals* last_normals_ = nullptr;
  double H_ = 0.0, h_ = 0.0;
  int count_ = 0, requested_ = 0;
  bool has_fenders_ = false;
  int most_touches_ = 0;
  int pending_substeps_ = 0;  // by which the predicted poses lag
  int substep_ = 0;
  double passed_ = 0.0;
  Stop stop_ = Stop::over;
  double touch_ = 0.0;
  bool is_stopped_ = false;
  Buffer<Entry> entries_;
  Buffer<int> moving_, examined_;  // bodies; entries examined at the substep as it began
  Buffer<Pair> pairs_;             // examined at the present stop
  Buffer<FastPair> fast_, missed_;
  Buffer<Pose> reached_;
};

// Number and length [s] of the substeps of H [s]: of `substep` exactly where H is a multiple of it, else of H / n.
bool divide_into_substeps(double H, double substep, int& count, double& h, Text& why);

}  // namespace shipcollision
