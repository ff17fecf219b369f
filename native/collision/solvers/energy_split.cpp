#include "energy_split.hpp"

#include "../dynamics/contact_frame.hpp"
#include "../dynamics/delassus.hpp"

namespace shipcollision {

namespace {

constexpr double SAME_DIRECTION = 1e-4;
constexpr double STOPPED = 1e-6;

bool is_none(const Booked& booked) { return is_same(booked.impulse.P, Three{}); }

bool is_same_pair(const Booked& one, const Booked& other) {
  return one.impulse.contact.a == other.impulse.contact.a && one.impulse.contact.b == other.impulse.contact.b;
}

// The losses of a pair whose slips keep their direction at all contacts; false if one does not.
bool split_straight(const Booked* booked, int count, Loss* losses) {
  double along = 0.0, across = 0.0;
  for (int i = 0; i < count; ++i) {
    const Booked& b = booked[i];
    losses[i] = {b.lost, 0.0};
    if (is_none(b)) continue;
    const Three& normal = b.impulse.contact.normal;
    const Three before = b.before - dot(normal, b.before) * normal, after = b.after - dot(normal, b.after) * normal;
    const double slip = norm(before), left = norm(after);
    if (min(slip, left) <= STOPPED * max(slip, left) ||
        dot(before, after) < (1.0 - SAME_DIRECTION) * slip * left) {
      return false;
    }
    const double lost = -0.5 * dot(b.impulse.P, before + after);
    losses[i] = {b.lost - lost, lost};
    along += b.lost - lost;
    across += lost;
  }
  return along >= 0.0 && across >= 0.0;
}

void add(Jacobian& sum, double share, const Jacobian& G) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 6; ++j) sum.at[i][j] += share * G[i][j];
  }
}

}  // namespace

bool EnergySplit::split_losses(const Booked* booked, int count, const BodyState* states, double friction,
                               double restitution, Loss* losses) {
  if (!impulses_.resize(count) || !is_done_.fill(count, 0) || !group_.reserve(count) || !pair_.reserve(count) ||
      !groups_.reserve(count)) {
    return false;
  }
  bool are_none = true, is_one_pair = true;
  for (int i = 0; i < count; ++i) {
    losses[i] = {booked[i].lost, 0.0};
    are_none = are_none && is_none(booked[i]);
    is_one_pair = is_one_pair && is_same_pair(booked[i], booked[0]);
  }
  if (friction == 0.0 || are_none) return true;
  if (is_one_pair && split_straight(booked, count, losses)) return true;
  for (int i = 0; i < count; ++i) impulses_[i] = booked[i].impulse;
  if (!groups_.find(impulses_.data(), count, states)) return false;
  for (int group = 0; group < groups_.count(); ++group) {
    group_.clear();
    for (int i = 0; i < count; ++i) {
      if (groups_[i] == group) group_.add(i);
    }
    split_by_process(booked, states, friction, restitution, losses);
  }
  return true;
}

// The losses of a group of pairs, in the ratio of their impact processes.
void EnergySplit::split_by_process(const Booked* booked, const BodyState* states, double mu, double e, Loss* losses) {
  Loss whole{0.0, 0.0};
  for (const int first : group_) {
    if (is_done_[first]) continue;
    pair_.clear();
    for (const int i : group_) {
      if (!is_same_pair(booked[i], booked[first])) continue;
      is_done_[i] = 1;
      if (!is_none(booked[i])) pair_.add(i);
    }
    const Loss loss = estimate_pair(booked, states, mu, e);
    whole = {whole.normal + loss.normal, whole.tangential + loss.tangential};
  }
  const double share = whole.tangential > 0.0 ? whole.tangential / (whole.normal + whole.tangential) : 0.0;
  for (const int i : group_) losses[i] = {(1.0 - share) * booked[i].lost, share * booked[i].lost};
}

// Of the impulses of a pair.
Loss EnergySplit::estimate_pair(const Booked* booked, const BodyState* states, double mu, double e) const {
  if (pair_.is_empty()) return {0.0, 0.0};
  Contact contact;
  Three v;
  reduce(booked, contact, v);
  Rows H;
  const bool holds = find_held_mobility(contact, states, H);
  Loss loss =
      estimate_losses(find_mobility(contact, states), rotate(contact.axes, v), mu, e, holds ? &H : nullptr);
  if (!holds) return loss;
  Three sum{};
  for (const int i : pair_) sum = sum + booked[i].impulse.P;
  const Three P = rotate(contact.axes, sum);
  const double half = 0.5 * (P[1] * (P[1] * H[1][1] + P[2] * H[2][1]) + P[2] * (P[1] * H[1][2] + P[2] * H[2][2]));
  loss.tangential += half;
  return loss;
}

// The contact of the resultant, and the velocity there before: weighted by the normal impulses.
void EnergySplit::reduce(const Booked* booked, Contact& contact, Three& v) const {
  const Booked& first = booked[pair_[0]];
  contact = first.impulse.contact;
  v = first.before;
  double whole = 0.0;
  for (const int i : pair_) whole += dot(booked[i].impulse.P, booked[i].impulse.contact.normal);
  if (pair_.size() == 1 || whole <= 0.0) return;
  contact.at = v = {};
  contact.G_a = contact.G_b = {};
  Three normal{};
  bool have_same_axes = true;
  for (const int i : pair_) {
    const auto& [c, P] = booked[i].impulse;
    const double weight = dot(P, c.normal), share = weight / whole;
    contact.at = contact.at + share * c.at;
    v = v + share * booked[i].before;
    add(contact.G_a, share, c.G_a);
    add(contact.G_b, share, c.G_b);
    normal = normal + weight * c.normal;
    have_same_axes = have_same_axes && is_same(c.axes, first.impulse.contact.axes);
  }
  if (have_same_axes) return;
  contact.axes = contact_axes((1.0 / norm(normal)) * normal);
  contact.normal = contact.axes[0];
}

}  // namespace shipcollision
