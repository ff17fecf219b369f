#include "motion_watch.hpp"

namespace shipcollision {
namespace {

int at_most(int number, int most) { return number < most ? number : most; }

}  // namespace

Found MotionWatch::look(const ShipState& ship, bool is_settled, double t, double H) {
  if (!is_settled) {
    rest(t, H, pause_);
    return {};
  }
  if (has_position_ && is_same(ship.position, position_)) {
    ++idle_;
    return changes_ < 0 || idle_ > PATIENCE ? judge_still(ship, t, H) : Found{};
  }
  still_since_ = has_position_ || still_since_ == INFINITE ? INFINITE : t;
  idle_ = 0;
  position_ = ship.position;
  has_position_ = true;
  next_ = t;
  ++changes_;
  const TimedMotion now{t, {ship.position, ship.attitude, ship.velocity, ship.rate}};
  if (changes_ == 0) {
    start_ = now;
    has_start_ = true;
  } else if (has_start_ && (changes_ >= CHANGES || (changes_ >= LEAST_CHANGES && t - start_.t >= DURATION))) {
    return judge(now, H);
  }
  return {};
}

Found MotionWatch::judge(const TimedMotion& now, double H) {
  const Verdict verdict = judge_motion(start_, now);
  const Finding finding = verdict.found.finding;
  speed_ = speed_ || verdict.speed;
  rate_ = rate_ || verdict.rate;
  is_done_ = speed_ && rate_;
  windows_ = finding == suspicion_ ? windows_ + 1 : 1;
  suspicion_ = finding;
  if (finding == Finding::none) {
    rest(now.t, H, pause_);
    pause_ = at_most(2 * pause_, LONGEST_PAUSE);
    return {};
  }
  if (windows_ >= WINDOWS) return verdict.found;
  start_ = now;  // the next window begins at once
  changes_ = 0;
  return {};
}

// What is found of a ship whose position has not changed since the last look, and look again after a stride.
Found MotionWatch::judge_still(const ShipState& ship, double t, double H) {
  const double u = ship.velocity[0], v = ship.velocity[1];
  if (u * u + v * v <= SLOW * SLOW) {
    still_since_ = still_since_ == INFINITE ? INFINITE : t;
  } else if (t - still_since_ >= STILL && t - still_since_ >= STILL_STEPS * H) {
    Found found;
    found.finding = Finding::no_motion;
    found.measured.given = hypot(u, v);
    found.measured.duration = t - still_since_;
    return found;
  }
  rest(t, H, stride_);
  position_ = ship.position;
  has_position_ = true;
  stride_ = at_most(2 * stride_, LONGEST_STRIDE);
  return {};
}

// Leaves the window, and looks again after so many steps of H [s]; half a step less for rounding.
void MotionWatch::rest(double t, double H, int steps) {
  has_start_ = has_position_ = false;
  changes_ = -2;
  idle_ = 0;
  next_ = t + (steps - 0.5) * H;
}

void MotionWatch::get_state(ByteWriter& bytes) const {
  bytes.values(next_, still_since_, start_, position_, has_start_, has_position_, speed_, rate_, is_done_, stride_,
               pause_, changes_, idle_, windows_, suspicion_);
}

bool MotionWatch::set_state(ByteReader& bytes) {
  return bytes.values(next_, still_since_, start_, position_, has_start_, has_position_, speed_, rate_, is_done_,
                      stride_, pause_, changes_, idle_, windows_, suspicion_);
}

}  // namespace shipcollision
