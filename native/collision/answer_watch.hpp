// Watch over how a ship model answers impulses: the twin of shipcollision_fmu/collision/answer_watch.py.
#pragma once

#include "../numbers/bytes.hpp"
#include "bodies.hpp"
#include "findings.hpp"

namespace shipcollision {

constexpr int DOUBTS = 2;
constexpr int DEADLINE_STEPS = 10;
constexpr double DEADLINE = 1.0;
constexpr double LONGEST_WATCH = 3.0;
constexpr double LEAST_CHANGE = 0.05;
constexpr double OTHER_ACCELERATION = 0.5;
constexpr double LIGHTEST = 3.0;
constexpr double CERTAIN = 30.0;
constexpr double NO_ANSWER = 0.1;

// Watch over the answer of a ship, until it was found to be right.
class AnswerWatch {
 public:
  explicit AnswerWatch(bool is_done = false) : is_done_(is_done) {}

  bool is_done() const { return is_done_; }
  void end() { is_done_ = true; }
  bool is_waiting() const { return has_t_ && !is_done_; }

  // What is found at t [s]. issued: cumulative, as of now.
  Found look(const ShipState& ship, const Body& body, const Six& issued, double t);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  Found judge(const ShipState& ship, const Body& body, double T, const Six& issued);
  bool measure_share(const ShipState& ship, const Body& body, const Six& J, double T, double& share) const;

  double t_ = 0.0;  // of the impulse that is watched
  double share_ = 0.0;
  Six nu_{}, applied_{}, issued_{}, known_{};
  bool has_t_ = false;
  bool counts_ = false;
  bool is_done_;
  int steps_ = 0;
  int doubts_ = 0;
};

}  // namespace shipcollision
