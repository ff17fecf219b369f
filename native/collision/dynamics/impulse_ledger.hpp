// The impulse ledger of one ship: the twin of shipcollision_fmu/collision/dynamics/impulse_ledger.py.
#pragma once

#include "../../numbers/bytes.hpp"
#include "../interface.hpp"
#include "body_state.hpp"

namespace shipcollision {

constexpr double RANGE = 0.1;

enum class Delay { unknown, none, one_step };

// The ledger of a ship at the start of a step, balanced with the state received.
struct Reading {
  Pose pose;        // received
  Six nu;           // with the pending impulse
  Six applied;      // as received
  Six applied_n;    // wrench applied so far
  Six pending;      // in b
  Six deficit;      // in b; zero without one
  bool has_deficit;
  Delay delay;
  bool is_out_of_range;  // the ship moves too far in a step to carry a deficit over
};

// Impulses in b about CO; wrenches in n, linear and about the origin of n.
class ImpulseLedger {
 public:
  const Six& issued() const { return issued_; }
  // Nothing pending, no deficit, nothing just issued.
  bool is_settled() const { return is_settled_; }
  Delay delay() const { return delay_; }

  // Whether the balance may be skipped. applied: impulse_applied as received.
  bool is_quiet(Feedback feedback, const Six& applied) const {
    return is_settled_ && (feedback != Feedback::ledger || is_same(applied, issued_));
  }
  // The balance with the state received at the start of a step of H [s]. reach: of the hull from CO [m].
  Reading read(Feedback feedback, const Pose& pose, const Six& nu, const Six& applied, const Matrix& M_inverse,
               double reach, double H) const;
  // Enters the impulse J that contact gave in the step. pose: of application; nu: twist at the start.
  void close(const Reading& reading, const Six& J, const Six& nu, const Pose& pose);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  Six infer_pending(const Six& nu, const Matrix& M_inverse) const;

  Six issued_{}, last_issued_{};  // in all, and by the last step; the latter is zero where rounding lost it
  Six nu_{};                      // twist at the start of the last step, pending included
  Six applied_{};
  Pose pose_{{}, {{{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}}}};
  Six issued_n_{}, applied_n_{};
  double size_[2] = {};  // of all that was issued: linear, angular
  Delay delay_ = Delay::unknown;
  bool is_settled_ = true;
};

}  // namespace shipcollision
