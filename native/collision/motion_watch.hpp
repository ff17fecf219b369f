// Watch over what a ship model gives as its motion: the twin of shipcollision_fmu/collision/motion_watch.py.
#pragma once

#include "../numbers/bytes.hpp"
#include "interface.hpp"
#include "motion_check.hpp"

namespace shipcollision {

constexpr int CHANGES = 8;
constexpr int LEAST_CHANGES = 3;
constexpr double DURATION = 1.0;
constexpr int PATIENCE = 32;
constexpr int PAUSE = 128;
constexpr int LONGEST_PAUSE = 512;
constexpr int LONGEST_STRIDE = 64;
constexpr int WINDOWS = 2;
constexpr int STILL_STEPS = 50;
constexpr double STILL = 15.0;

// Watch over the motion of a ship, until it was found to be right.
class MotionWatch {
 public:
  bool is_done() const { return is_done_; }
  void end() { is_done_ = true; }
  double next() const { return next_; }

  // What is found in the step of H [s] from t [s]. is_settled: whether no impulse is pending.
  Found look(const ShipState& ship, bool is_settled, double t, double H);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  Found judge(const TimedMotion& now, double H);
  Found judge_still(const ShipState& ship, double t, double H);
  void rest(double t, double H, int steps);

  double next_ = -INFINITE;
  double still_since_ = -INFINITE;
  TimedMotion start_{};
  Three position_{};
  bool has_start_ = false;
  bool has_position_ = false;
  bool speed_ = false;
  bool rate_ = false;
  bool is_done_ = false;
  int stride_ = 1;
  int pause_ = PAUSE;
  int changes_ = -2;
  int idle_ = 0;
  int windows_ = 0;
  Finding suspicion_ = Finding::none;
};

}  // namespace shipcollision
