#include "answer_watch.hpp"

namespace shipcollision {
namespace {

constexpr double HEAVIEST = 1.0 / 3.0;

Found find_other_mass(double share) {
  Found found;
  found.finding = Finding::other_mass;
  found.measured.share = share;
  found.measured.mass = share > 0.0 ? 1.0 / share : INFINITE;
  return found;
}

Found find_late(Finding finding, double T, double share) {
  Found found;
  found.finding = finding;
  found.measured.duration = T;
  found.measured.share = share;
  return found;
}

}  // namespace

Found AnswerWatch::look(const ShipState& ship, const Body& body, const Six& issued, double t) {
  const Six before = known_;
  if (!is_same(issued, before)) {
    known_ = issued;
    if (!has_t_) {
      has_t_ = true;
      t_ = t;
      steps_ = doubts_ = 0;
      share_ = 0.0;
      counts_ = false;
      nu_ = ship.nu();
      applied_ = ship.impulse_applied;
      issued_ = before;
      return {};
    }
  }
  if (!has_t_) return {};
  ++steps_;
  const Found found = judge(ship, body, t - t_, before);
  if (is_done_) has_t_ = false;
  return found;
}

// What T [s] after the first impulse shows. issued: all that the ship can have received.
Found AnswerWatch::judge(const ShipState& ship, const Body& body, double T, const Six& issued) {
  const bool by_ledger = body.feedback == Feedback::ledger;
  const bool has_applied = by_ledger && !is_same(ship.impulse_applied, applied_);
  const bool may_judge = has_applied || !by_ledger;
  double share;
  const bool counts =
      measure_share(ship, body, has_applied ? ship.impulse_applied - applied_ : issued - issued_, T, share);
  if (counts) {
    share_ = max(share, share_);
    counts_ = true;
    if (may_judge && HEAVIEST <= share && share <= LIGHTEST) {
      is_done_ = true;
      return {};
    }
    doubts_ = has_applied || share > LIGHTEST ? doubts_ + 1 : 0;
    if ((doubts_ >= DOUBTS || share > CERTAIN) && may_judge) return find_other_mass(share);
  }
  if (!(steps_ >= DEADLINE_STEPS && T >= DEADLINE)) return {};
  if (by_ledger && !has_applied) {
    return find_late(share_ > HEAVIEST ? Finding::impulse_applied_not_returned : Finding::impulse_not_applied, T, 0.0);
  }
  if (counts && !by_ledger) {
    return share_ < NO_ANSWER ? find_late(Finding::force_without_effect, T, share) : find_other_mass(share);
  }
  if (T >= LONGEST_WATCH) has_t_ = false;
  return {};
}

// The share of M^-1 J that the ship shows since the impulse, and whether it is large enough to count.
bool AnswerWatch::measure_share(const ShipState& ship, const Body& body, const Six& J, double T, double& share) const {
  Matrix inverse;
  body.inverse_at(ship.attitude, inverse);
  const Six predicted = multiply(inverse, J);
  const double whole = dot(J, predicted);
  share = 0.0;
  if (whole <= 0.0 || norm(first_three(predicted)) < LEAST_CHANGE + OTHER_ACCELERATION * T) return false;
  share = dot(J, ship.nu() - nu_) / whole;
  return true;
}

void AnswerWatch::get_state(ByteWriter& bytes) const {
  bytes.values(t_, share_, nu_, applied_, issued_, known_, has_t_, counts_, is_done_, steps_, doubts_);
}

bool AnswerWatch::set_state(ByteReader& bytes) {
  return bytes.values(t_, share_, nu_, applied_, issued_, known_, has_t_, counts_, is_done_, steps_, doubts_);
}

}  // namespace shipcollision
