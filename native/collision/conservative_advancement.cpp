#include "conservative_advancement.hpp"

#include "solvers/work_limit.hpp"

namespace shipcollision {
namespace {

constexpr int MAXIMUM_SUBSTEPS = 10000;
constexpr double MOST_PAIR_SUBSTEPS = 10000.0;
constexpr double USUAL_SUBSTEP = 0.01;
constexpr int LEAST_TOUCHES = 4;
constexpr int NEVER = 1000000000;
constexpr int MOST_TOUCHES = 40;
constexpr int MOST_EXAMINED = 120;

// `count`, or the fewer substeps of a step of H [s] that so many pairs near each other leave.
int limit_substeps(int count, double H, int near) {
  const double most = max(MOST_PAIR_SUBSTEPS * max(1.0, H / STEP) / near, ceil(H / USUAL_SUBSTEP - 1e-9));
  return count <= most ? count : static_cast<int>(most);
}

int find_most_touches(int near) {
  const int touches = near > 0 ? MOST_EXAMINED / near : MOST_TOUCHES;
  return touches < LEAST_TOUCHES ? LEAST_TOUCHES : touches > MOST_TOUCHES ? MOST_TOUCHES : touches;
}

}  // namespace

bool divide_into_substeps(double H, double substep, int& count, double& h, Text& why) {
  if (!(H / substep <= MAXIMUM_SUBSTEPS)) {
    why << "a step of ";
    why.short_number(H) << " s takes ";
    why.short_number(H / substep, 3) << " substeps of ";
    why.short_number(substep) << " s, at most " << MAXIMUM_SUBSTEPS
                              << " where hulls are near: take shorter steps, or a longer substep";
    return false;
  }
  const int n = static_cast<int>(max(1.0, round(H / substep)));
  if (abs(H - n * substep) <= 1e-6 * substep) {
    count = n;
    h = substep;
    return true;
  }
  count = static_cast<int>(ceil(H / substep));
  h = H / count;
  return true;
}

ConservativeAdvancement::ConservativeAdvancement(const Bodies& bodies, Detector& detector, Memory& memory)
    : bodies_(bodies), detector_(detector), entries_(memory), moving_(memory), examined_(memory), pairs_(memory),
      fast_(memory), missed_(memory), reached_(memory) {}

bool ConservativeAdvancement::begin(double H, double substep, BodyState* states, LastNormals& last_normals,
                                    const Buffer<NearPair>& near, Text& why) {
  if (!divide_into_substeps(H, substep, requested_, h_, why)) return false;
  count_ = limit_substeps(requested_, H, near.size());
  if (count_ < requested_) h_ = H / count_;
  H_ = H;
  states_ = states;
  last_normals_ = &last_normals;
  has_fenders_ = false;
  touched = false;
  most_touches_ = touches_left = find_most_touches(near.size());
  pending_substeps_ = 0;
  stop_ = Stop::over;
  is_stopped_ = false;
  list_moving(near);
  entries_.clear();
  for (const auto& [pair, gap, approach] : near) {
    const bool is_fendered = has_fender(pair);
    has_fenders_ = has_fenders_ || is_fendered;
    Entry entry{pair, true, approach, 0, FAST * detector_.thickness(pair) / h_, gap > 0.0, false};
    if (!is_fendered) entry.due = count_free_substeps(entry, gap);
    entries_.add(entry);
  }
  return true;
}

void ConservativeAdvancement::list_moving(const Buffer<NearPair>& near) {
  moving_.clear();
  for (const NearPair& each : near) {
    const int both[] = {each.pair.a, each.pair.b};
    for (int body : both) {
      bool is_new = !states_[body].fixed;
      for (int other : moving_) is_new = is_new && other != body;
      if (is_new) moving_.add(body);
    }
  }
}

bool ConservativeAdvancement::has_fender(const Pair& pair) const {
  return bodies_[pair.a].has_fender || bodies_[pair.b].has_fender;
}

const Buffer<Pair>& ConservativeAdvancement::pairs_due(int substep) {
  ++pending_substeps_;
  for (Entry& entry : entries_) entry.is_due = entry.due <= substep;
  examine(false);
  return pairs_;
}

// Examines the pairs that are due at this substep, or all.
void ConservativeAdvancement::examine(bool all) {
  pairs_.clear();
  for (Entry& entry : entries_) {
    entry.is_due = entry.is_due || all;
    if (entry.is_due) pairs_.add(entry.pair);
  }
}

void ConservativeAdvancement::advance(int substep) {
  touched = false;
  substep_ = substep;
  passed_ = 0.0;
  is_stopped_ = false;
  examined_.clear();
  for (int i = 0; i < entries_.size(); ++i) {
    if (entries_[i].is_due) examined_.add(i);
  }
  if (has_fenders_) forget_approach();
  find_fast();
  bool is_touched;
  if (!fast_.is_empty()) {
    --pending_substeps_;
    advance_pending();
    is_touched = advance_to_touch(h_, touch_);
  } else {
    advance_pending();
    is_touched = return_to_missed_touch(h_, touch_);
  }
  stop_ = is_touched ? Stop::touch : Stop::end;
}

bool ConservativeAdvancement::next(double& moment, const Buffer<Pair>*& pairs) {
  if (is_stopped_ && stop_ == Stop::touch) {  // go on from the touch
    forget_approach();
    examine(true);
    stop_ = advance_to_touch(h_ - passed_, touch_) ? Stop::touch : Stop::end;
  } else if (is_stopped_ && stop_ == Stop::end) {
    reschedule();
    stop_ = Stop::over;
  }
  if (stop_ == Stop::over) return false;
  is_stopped_ = true;
  pairs = &pairs_;
  if (stop_ == Stop::touch) {
    --touches_left;
    passed_ += touch_;
    moment = substep_ * h_ + passed_;
  } else {
    moment = (substep_ + 1) * h_;
  }
  return true;
}

// Moves the near bodies to the first touch within the rest [s] of a substep, else by the rest.
bool ConservativeAdvancement::advance_to_touch(double rest, double& touch) {
  find_fast();
  const bool is_touched = touches_left > 0 && find_first_touch(fast_, rest, touch);
  advance_bodies(states_, moving_.data(), moving_.size(), is_touched ? touch : rest);
  double missed;
  if (!return_to_missed_touch(is_touched ? touch : rest, missed)) return is_touched;
  touch = missed;
  return true;
}

// Moves the near bodies back to the first touch of slow pairs, if it was missed in the last motion, of `moved` [s].
bool ConservativeAdvancement::return_to_missed_touch(double moved, double& touch) {
  find_missed();
  if (missed_.is_empty() || touches_left == 0 || !reached_.resize(moving_.size())) return false;
  for (int i = 0; i < moving_.size(); ++i) {
    BodyState& state = states_[moving_[i]];
    reached_[i] = state.predicted;
    state.predicted = state.pose_before;
  }
  int count = 0;
  for (const FastPair& each : missed_) {
    if (!detector_.touching(each.pair, states_)) missed_[count++] = {each.pair, find_relative_speed(each.pair)};
  }
  missed_.cut(count);
  if (find_first_touch(missed_, moved, touch)) {
    advance_bodies(states_, moving_.data(), moving_.size(), touch);
    return true;
  }
  for (int i = 0; i < moving_.size(); ++i) states_[moving_[i]].predicted = reached_[i];
  return false;
}

// Examined pairs that were apart and whose normal now cannot be that of the touch.
void ConservativeAdvancement::find_missed() {
  missed_.clear();
  for (const Entry& entry : entries_) {
    if (entry.is_due && entry.is_apart && last_normals_->find(entry.pair) == nullptr &&
        detector_.misses_first_touch(entry.pair, states_)) {
      missed_.add({entry.pair, 0.0});
    }
  }
}

// Examined pairs that may come so near within a substep that their first touch is looked for.
void ConservativeAdvancement::find_fast() {
  fast_.clear();
  for (Entry& entry : entries_) {
    if (!entry.is_due || !(find_approach_speed(entry) > entry.fast)) continue;
    const double speed = find_relative_speed(entry.pair);
    if (speed > entry.fast) fast_.add({entry.pair, speed});
  }
}

bool ConservativeAdvancement::find_first_touch(const Buffer<FastPair>& pairs, double rest, double& touch) {
  bool is_found = false;
  for (const auto& [pair, speed] : pairs) {
    double found;
    if (!detector_.first_touch(pair, states_, is_found ? touch : rest, speed, *last_normals_, found)) continue;
    touch = found;
    is_found = true;
  }
  return is_found;
}

void ConservativeAdvancement::advance_pending() {
  advance_bodies(states_, moving_.data(), moving_.size(), h_, pending_substeps_);
  pending_substeps_ = 0;
}

// Sets when the pairs examined at the substep are due again.
void ConservativeAdvancement::reschedule() {
  if (touched) {
    forget_approach();
    for (Entry& entry : entries_) entry.due = substep_ + 1;
  } else if (!has_fenders_) {
    const double rest = (count_ - 1 - substep_) * h_;
    for (int i : examined_) {
      Entry& entry = entries_[i];
      const double approach = find_approach_speed(entry);
      if (detector_.are_surely_within(entry.pair, states_, min(rest, h_) * approach)) {
        last_normals_->remove(entry.pair);
        entry.due = substep_ + 1;
        entry.is_apart = true;
        continue;
      }
      const double gap = detector_.clearance(entry.pair, states_, rest * approach);
      const int free = count_free_substeps(entry, gap);
      entry.due = free >= NEVER ? NEVER : substep_ + 1 + free;
      entry.is_apart = entry.is_apart || gap > 0.0;
    }
  }
}

void ConservativeAdvancement::describe_limited(double t, Text& text) const {
  text << entries_.size() << " pairs of hulls are near each other in the step from t = ";
  text.short_number(t) << " s by ";
  text.short_number(H_) << " s, which has " << count_ << " substeps in place of " << requested_
                        << ": take a longer substep, or shorter steps";
}

void ConservativeAdvancement::describe_exhausted(double t, Text& text) const {
  text << "fast or thin bodies touched " << most_touches_ << " times in the step from t = ";
  text.short_number(t) << " s by ";
  text.short_number(H_) << " s; later touches in it may be missed: take shorter steps";
}

void ConservativeAdvancement::finish() {
  if (pending_substeps_ == count_) {
    advance_bodies(states_, moving_.data(), moving_.size(), H_);
  } else {
    advance_pending();
  }
}

// Bound [m/s] of the relative speed of any two points of the hulls.
double ConservativeAdvancement::find_relative_speed(const Pair& pair) const {
  Three velocity{};
  double turning = 0.0;
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? pair.a : pair.b;
    if (states_[body].fixed) continue;
    const BodyMotion& motion = states_[body].predicted_motion();
    velocity = side == 0 ? velocity + motion.velocity : velocity - motion.velocity;
    if (motion.turns) turning += 2.0 * bodies_[body].hull.reach * norm(motion.omega);
  }
  return norm(velocity) + turning;
}

// Substeps in which a gap [m] cannot close.
int ConservativeAdvancement::count_free_substeps(Entry& entry, double gap) {
  if (gap <= 0.0) return 0;
  last_normals_->remove(entry.pair);
  const double approach = h_ * find_approach_speed(entry);
  return approach > 0.0 ? static_cast<int>(min(gap / approach, double{NEVER})) : NEVER;
}

// Bound [m/s] of the speed at which two hulls come nearer.
double ConservativeAdvancement::find_approach_speed(Entry& entry) {
  if (!entry.has_approach) {
    const auto& [a, b] = entry.pair;
    entry.approach = bodies_[a].largest_speed(states_[a]) + bodies_[b].largest_speed(states_[b]);
    entry.has_approach = true;
  }
  return entry.approach;
}

void ConservativeAdvancement::forget_approach() {
  for (Entry& entry : entries_) entry.has_approach = false;
}

}  // namespace shipcollision
