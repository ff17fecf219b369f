#include "impulse_ledger.hpp"

namespace shipcollision {
namespace {

constexpr double ROUNDING = 1e-12;
constexpr double SHOWS = 1e-6;

bool is_beyond_range(const Six& nu, double reach, double H) {
  return H * (norm(last_three(nu)) + norm(first_three(nu)) / reach) > RANGE;
}

double largest(const Three& p) { return max(max(abs(p[0]), abs(p[1])), abs(p[2])); }

Six wrench_in_n(const Pose& pose, const Six& J) {
  const Three linear = rotate(pose.R, first_three(J));
  return join(linear, rotate(pose.R, last_three(J)) + cross(pose.x, linear));
}

Six wrench_in_b(const Pose& pose, const Six& wrench) {
  const Three linear = first_three(wrench);
  return join(rotate_back(pose.R, linear), rotate_back(pose.R, last_three(wrench) - cross(pose.x, linear)));
}

}  // namespace

Reading ImpulseLedger::read(Feedback feedback, const Pose& pose, const Six& nu, const Six& applied,
                            const Matrix& M_inverse, double reach, double H) const {
  Reading reading{pose, nu, applied, applied_n_, {}, {}, false, Delay::none, false};
  if (feedback != Feedback::ledger) {
    const bool shows = feedback == Feedback::force || feedback == Feedback::state;
    if (shows) reading.pending = infer_pending(nu, M_inverse);
    if (!is_zero(reading.pending)) reading.nu = nu + multiply(M_inverse, reading.pending);
    return reading;
  }
  reading.delay = delay_;
  if (is_quiet(feedback, applied)) {
    reading.is_out_of_range = is_beyond_range(nu, reach, H);
    return reading;
  }
  const Six newly_applied = applied - applied_;
  reading.pending = issued_ - applied;
  const bool is_pending = !is_zero(reading.pending);
  if (is_pending) reading.nu = nu + multiply(M_inverse, reading.pending);
  reading.is_out_of_range = is_beyond_range(reading.nu, reach, H);
  if (!is_zero(newly_applied)) reading.applied_n = applied_n_ + wrench_in_n(pose_, newly_applied);
  if (norm(first_three(last_issued_)) > SHOWS * size_[0] || norm(last_three(last_issued_)) > SHOWS * size_[1]) {
    const Six moved = multiply(M_inverse, last_issued_);
    const bool is_late = dot(moved, reading.pending) > 0.5 * dot(moved, last_issued_);  // less is rounding of the host
    reading.delay = is_late ? Delay::one_step : Delay::none;
  }
  Six deficit = issued_n_ - reading.applied_n;
  if (is_pending) deficit = deficit - wrench_in_n(pose, reading.pending);
  reading.has_deficit = !reading.is_out_of_range && !(largest(first_three(deficit)) <= ROUNDING * size_[0] &&
                                                      largest(last_three(deficit)) <= ROUNDING * size_[1]);
  if (reading.has_deficit) reading.deficit = wrench_in_b(pose, deficit);
  return reading;
}

void ImpulseLedger::close(const Reading& reading, const Six& J, const Six& nu, const Pose& pose) {
  if (reading.is_out_of_range) issued_n_ = reading.applied_n + wrench_in_n(reading.pose, reading.pending);
  const bool in_contact = !is_zero(J);
  if (in_contact) {
    const Six wrench = wrench_in_n(pose, J);
    const double linear = norm(first_three(wrench));
    issued_n_ = issued_n_ + wrench;
    size_[0] += linear;
    size_[1] += norm(last_three(J)) + norm(pose.x) * linear;
  }
  const bool is_issuing = in_contact || reading.has_deficit;
  Six last_issued{};
  if (is_issuing) {
    Six deficit = reading.deficit;
    if (reading.has_deficit && !is_same(pose, reading.pose)) {
      deficit = wrench_in_b(pose, wrench_in_n(reading.pose, deficit));
    }
    const Six out = J + deficit, before = issued_;
    issued_ = issued_ + out;
    if (!is_same(issued_, before)) last_issued = out;
  }
  last_issued_ = last_issued;
  nu_ = nu;
  is_settled_ = !is_issuing && is_zero(reading.pending);
  pose_ = reading.pose;
  applied_ = reading.applied;
  applied_n_ = reading.applied_n;
  delay_ = reading.delay;
}

// Of a ship that does not return impulse_applied: the impulse of the last step, unless the received velocity shows more
// than half of it.
Six ImpulseLedger::infer_pending(const Six& nu, const Matrix& M_inverse) const {
  if (is_zero(last_issued_)) return last_issued_;
  const double change = dot(last_issued_, nu - nu_), whole = dot(last_issued_, multiply(M_inverse, last_issued_));
  return change > 0.5 * whole ? Six{} : last_issued_;
}

void ImpulseLedger::get_state(ByteWriter& bytes) const {
  bytes.values(issued_, last_issued_, nu_, applied_, pose_, issued_n_, applied_n_, size_, delay_, is_settled_);
}

bool ImpulseLedger::set_state(ByteReader& bytes) {
  return bytes.values(issued_, last_issued_, nu_, applied_, pose_, issued_n_, applied_n_, size_, delay_, is_settled_);
}

}  // namespace shipcollision
