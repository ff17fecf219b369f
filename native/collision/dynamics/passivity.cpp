#include "passivity.hpp"

namespace shipcollision {

namespace {

constexpr double ROUNDING = 1e-9;

int find_most(const Impulse* impulses, int count) {
  int most = -1;
  for (int i = 0; i < count; ++i) {
    const Contact& contact = impulses[i].contact;
    most = contact.a > most ? contact.a : most;
    most = contact.b > most ? contact.b : most;
  }
  return most;
}

}  // namespace

bool ImpulseGroups::find(const Impulse* impulses, int count, const BodyState* states) {
  const int bodies = find_most(impulses, count) + 1;
  count_ = 0;
  if (!root_.resize(bodies) || !group_.resize(count) || !group_of_root_.fill(bodies, -1)) return false;
  for (int body = 0; body < bodies; ++body) root_[body] = body;
  bool is_one_pair = true;
  for (int i = 0; i < count; ++i) {
    const Contact &c = impulses[i].contact, &first = impulses[0].contact;
    is_one_pair = is_one_pair && c.a == first.a && c.b == first.b;
    if (!(states[c.a].fixed || states[c.b].fixed)) root_[find_root(c.b)] = find_root(c.a);
  }
  for (int i = 0; i < count; ++i) {
    const Contact& c = impulses[i].contact;
    int& group = group_of_root_[is_one_pair ? 0 : find_root(states[c.a].fixed ? c.b : c.a)];
    if (group < 0) group = count_++;
    group_[i] = group;
  }
  return true;
}

double Passivity::enforce(Buffer<Impulse>& impulses, const BodyState* states) {
  const int count = impulses.size();
  if (!groups_.find(impulses.data(), count, states) || !passive_.reserve(count)) return 0.0;
  if (!place_.fill(find_most(impulses.data(), count) + 1, -1) || !taken_.reserve(place_.size())) return 0.0;
  passive_.clear();
  double taken_off = 0.0;
  for (int group = 0; group < groups_.count(); ++group) {
    const int first = passive_.size();
    for (int i = 0; i < count; ++i) {
      if (groups_[i] == group) passive_.add(impulses[i]);
    }
    double speed = 0.0;
    const double s = scale(passive_.data() + first, passive_.size() - first, states, speed);
    taken_off = max(taken_off, (1.0 - s) * speed);
    for (int i = first; i < passive_.size() && s != 1.0; ++i) passive_[i].P = s * passive_[i].P;
  }
  for (int i = 0; i < count; ++i) impulses[i] = passive_[i];
  return taken_off;
}

void Passivity::add(int body, const Six& J) {
  if (place_[body] < 0) {
    place_[body] = taken_.size();
    taken_.add({body, J});
  } else {
    taken_[place_[body]].J = taken_[place_[body]].J + J;
  }
}

double Passivity::scale(const Impulse* group, int count, const BodyState* states, double& speed) {
  double work = 0.0, quadratic = 0.0, fastest = 0.0;
  taken_.clear();
  for (int i = 0; i < count; ++i) {
    const auto& [contact, P] = group[i];
    if (is_same(P, Three{})) continue;
    work += dot(P, energy_velocity(contact, states));
    add(contact.a, multiply_back(contact.G_a, -P));
    add(contact.b, multiply_back(contact.G_b, P));
  }
  for (const auto& [body, J] : taken_) {
    const Six change = multiply(states[body].M_inverse, J);
    quadratic += dot(J, change);
    fastest = max(fastest, norm(first_three(change)));
    place_[body] = -1;
  }
  if (quadratic <= 0.0 || work + 0.5 * quadratic <= ROUNDING * (abs(work) + quadratic)) return 1.0;
  speed = fastest;
  return max(0.0, -2.0 * work / quadratic);
}

}  // namespace shipcollision
