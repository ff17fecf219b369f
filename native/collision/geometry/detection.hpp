// Contacts of two hulls: the twin of shipcollision_fmu/collision/geometry/detection.py.
#pragma once

#include "../dynamics/contact.hpp"
#include "broad_phase.hpp"
#include "compound_hull.hpp"
#include "contact_place.hpp"
#include "first_touch.hpp"
#include "plan_overlap.hpp"

namespace shipcollision {

constexpr double SHALLOW = 0.5;
constexpr double SHALLOW_SHARE = 0.25;
constexpr double FAST = 0.05;

// The last shallow normals of some pairs.
class LastNormals {
 public:
  struct Row {
    Pair pair;
    LastNormal last;
  };

  explicit LastNormals(Memory& memory) : rows_(memory) {}

  // Null without one. It holds until the next change.
  const LastNormal* find(const Pair& pair) const;
  void set(const Pair& pair, const LastNormal& last);
  void remove(const Pair& pair);
  void clear() { rows_.clear(); }

  const Buffer<Row>& rows() const { return rows_; }

 private:
  Buffer<Row> rows_;
};

// Contacts and clearance between hulls, which outlive it. What a call returns depends on its arguments alone.
class Detector {
 public:
  explicit Detector(Memory& memory);
  ~Detector();
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;

  // To be called once. False without memory.
  bool set_up(const HullMesh* const* hulls, int count);

  // Least distance [m] between two hulls, negative in overlap, at most `cap`.
  double clearance(const Pair& pair, const BodyState* states, double cap);
  bool touching(const Pair& pair, const BodyState* states) { return clearance(pair, states, MARGIN) <= 0.0; }
  // Whether two hulls are apart and nearer than `distance` [m], where that is known without measuring; false says
  // nothing.
  bool are_surely_within(const Pair& pair, const BodyState* states, double distance);
  // Least width [m] of the thinner of two hulls.
  double thickness(const Pair& pair) const { return min(widths_[pair.a], widths_[pair.b]); }

  // Time [s] after the predicted poses at which two hulls first touch within h [s]; false: they do not.
  bool first_touch(const Pair& pair, const BodyState* states, double h, double speed, const LastNormals& last_normals,
                   double& touch);
  // Whether two hulls, apart before they were last advanced, have met along another normal than that of their closest
  // points now.
  bool misses_first_touch(const Pair& pair, const BodyState* states);

  // Adds the contact points of two hulls, gap <= 0. Updates `last_normals` while the overlap is shallow.
  void contacts(const Pair& pair, const BodyState* states, LastNormals& last_normals, Buffer<Contact>& found);
  // One contact at the middle of what is nearer than `distance`, with the least gap; false: nothing is.
  bool facing(const Pair& pair, double distance, const BodyState* states, const LastNormals& last_normals,
              Contact& found);

 private:
  // Where was asked last for what touches.
  struct Lately {
    Pair pair;
    Pose a, b;
  };

  void find_touching(const Pair& pair, const BodyState* states);
  void find_closest(const Pair& pair, const BodyState* states, double distance);
  bool is_shallow(const Pair& pair, const Closest& deepest, const BodyState* states,
                  const LastNormals& last_normals) const;
  double find_shallow(const Pair& pair) const { return min(SHALLOW, SHALLOW_SHARE * thickness(pair)); }
  double find_scale(const Pair& pair) const { return min(scales_[pair.a], scales_[pair.b]); }
  LastNormal find_plan_normal(const Pair& pair, const BodyState* states);
  void collect_corners(const Pair& pair, bool of_b, const BodyState* states, Buffer<Three>& corners);
  void find_features(const Pair& pair, const Closest& closest, const Three& normal, const BodyState* states,
                     double depth);
  void add_contacts(const Pair& pair, const Closest& closest, const Rows& axes, const BodyState* states,
                    bool may_be_inside, Buffer<Contact>& found);
  bool is_inside(const Contact& contact, const Closest& closest, const BodyState* states) const;

  Memory& memory_;
  Buffer<CompoundHull*> hulls_;
  Buffer<double> widths_, scales_;
  PlacedHulls* narrow_phase_ = nullptr;
  int most_parts_ = 0;
  bool has_lately_ = false;
  Lately lately_{};
  Buffer<Closest> lately_touching_, near_, touching_;
  Buffer<Contact> hidden_;
  Buffer<Three> in_a_, in_b_, part_;
  ContactPlaces places_;
  PlanOverlaps plans_;
  Support support_;
};

}  // namespace shipcollision
