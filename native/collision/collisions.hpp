// Collisions and scratches in time: the twin of shipcollision_fmu/collision/collisions.py.
#pragma once

#include "../numbers/bytes.hpp"
#include "dynamics/contact.hpp"
#include "geometry/broad_phase.hpp"
#include "interface.hpp"

namespace shipcollision {

constexpr double SCRATCH_PAUSE = 0.5;

// Of a pair in contact: the collision, the scratch, and the impact with which the collision began.
struct Numbers {
  Pair pair;
  int collision, scratch;
  Impact impact;
};

// How the contacts of a body are answered.
struct Answering {
  bool is_answered_once;  // a model that ignores contact: the impact alone is answered
  bool is_immovable;      // contacts of two of these are merely recorded
};

class Collisions {
 public:
  explicit Collisions(Memory& memory) : opened_(memory), answering_(memory), pairs_(memory), of_pair_(memory) {}

  // Begins a run. answering: of each body. False without memory.
  bool set_up(double minimum_separation_time, const Answering* answering, int bodies);

  // Closes what has been without contact for long enough at time t [s].
  void close_old(double t);
  // Whether the contacts of a pair are merely recorded, and not answered with impulses.
  bool is_recorded(const Pair& pair) const;
  // Opens what begins with these contacts at time t [s]; the numbers of every pair in contact, in the order of theirs.
  // To be called before the impulses of the instant are booked.
  void register_contacts(double t, const Contact* contacts, int count, const BodyState* states,
                         Buffer<Numbers>& numbers);

  // Whether a body is in an open collision with any other: `is_colliding` of each body.
  void mark_bodies_in_collision(bool* is_colliding) const;
  // Calls `visit` with each pair in an open collision until it answers true.
  template <typename Visit>
  void find_open_pair(Visit visit) const {
    for (const State& state : pairs_) {
      if (state.collision != 0 && visit(state.pair)) return;
    }
  }

  int count() const { return count_; }
  const Impact& latest() const { return latest_; }
  // Collisions that opened since the list was last emptied. No part of the state: it is for the log alone.
  Buffer<Impact>& opened() { return opened_; }
  int opened_count() const { return opened_.size(); }
  // A line about one of these; names of the bodies.
  void describe_opened(int i, const char* const* names, Text& said) const;

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  struct State {
    Pair pair;
    int collision;  // number of the open collision, 0: none
    int scratch;
    double last_contact;
    Impact impact;
  };

  const State* find(const Pair& pair) const;
  State* find_or_add(const Pair& pair);

  Buffer<Impact> opened_;
  Buffer<Answering> answering_;
  double separation_ = 0.0;
  Buffer<State> pairs_;
  int count_ = 0;
  int scratches_ = 0;
  Impact latest_;
  Buffer<Contact> of_pair_;
};

// Angle [rad] in 0..pi between the ships' headings, from the horizontal parts of their forward axes.
double heading_angle(const Rows& R_a, const Rows& R_b);

}  // namespace shipcollision
