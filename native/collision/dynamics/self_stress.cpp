#include "self_stress.hpp"

#include "../../numbers/eigenvalues.hpp"

namespace shipcollision {

namespace {

constexpr double STILL = 1e-7;
constexpr double RANK = 1e-12;
constexpr double ROUNDING = 1e-9;

bool is_sticking(const Impulse& impulse, const BodyState* states) {
  const auto& [contact, P] = impulse;
  if (dot(P, contact.normal) <= 0.0) return false;
  const Three v = rotate(contact.axes, mean_velocity(contact, states));
  return hypot(v[1], v[2]) <= STILL;
}

bool is_of_pair(const Impulse& impulse, const Contact& first) {
  return impulse.contact.a == first.a && impulse.contact.b == first.b;
}

}  // namespace

void SelfStress::remove(Impulse* impulses, int count, BodyState* states, double mu) {
  if (mu == 0.0 || !reserve(count) || count < 2) return;
  for (int first = 0; first < count; ++first) {
    if (is_done_[first]) continue;
    members_.clear();
    sticking_.clear();
    for (int k = first; k < count; ++k) {
      if (is_of_pair(impulses[k], impulses[first].contact)) members_.add(k);
    }
    for (const int k : members_) is_done_[k] = 1;
    if (members_.size() < 2) continue;
    for (const int k : members_) {
      if (is_sticking(impulses[k], states)) sticking_.add(k);
    }
    if (sticking_.size() < 2 || !split_anew(impulses, states, mu)) continue;
    book_change(impulses, states, false);
    book_change(impulses, states, true);
    for (int i = 0; i < sticking_.size(); ++i) impulses[sticking_[i]].P = split_[i];
  }
}

bool SelfStress::reserve(int contacts) {
  return is_done_.fill(contacts, 0) && members_.reserve(contacts) && sticking_.reserve(contacts) &&
         twists_.resize(12, 2 * contacts) && root_.resize(2 * contacts) && T_.resize(2 * contacts) &&
         least_.resize(2 * contacts) && N_.resize(contacts) && split_.resize(contacts);
}

// Impulses in n of the contacts that stick, with friction that moves the bodies alike and the least sum |T_k|^2 / N_k.
bool SelfStress::split_anew(const Impulse* impulses, const BodyState* states, double mu) {
  const int contacts = sticking_.size();
  bool has_second = false;
  for (int i = 0; i < contacts; ++i) {
    const auto& [contact, P] = impulses[sticking_[i]];
    const Three in_axes = rotate(contact.axes, P);
    N_[i] = in_axes[0];
    T_[2 * i] = in_axes[1];
    T_[2 * i + 1] = in_axes[2];
    root_[2 * i] = root_[2 * i + 1] = sqrt(N_[i]);
    has_second = has_second || in_axes[2] != 0.0;
  }
  for (int i = 0; i < contacts && !has_second; ++i) root_[2 * i + 1] = 0.0;  // friction in one direction stays in it
  if (!find_twists_of_friction(impulses, states)) return false;
  find_least();
  const double share = find_largest_share(mu);
  for (int i = 0; i < contacts; ++i) {
    const Contact& contact = impulses[sticking_[i]].contact;
    const double t_1 = T_[2 * i] + share * (least_[2 * i] - T_[2 * i]);
    const double t_2 = T_[2 * i + 1] + share * (least_[2 * i + 1] - T_[2 * i + 1]);
    split_[i] = N_[i] * contact.normal + t_1 * contact.axes[1] + t_2 * contact.axes[2];
  }
  return true;
}

// Changes of the twists of the bodies that can move, per friction impulse (t1, t2), times the root of the load there.
// Rates are multiplied by the largest arm, to be velocities as well. False where no body can move.
bool SelfStress::find_twists_of_friction(const Impulse* impulses, const BodyState* states) {
  const int contacts = sticking_.size();
  const Contact& first = impulses[sticking_[0]].contact;
  const int bodies[] = {first.a, first.b};
  int rows = 0;
  for (const int body : bodies) rows += states[body].fixed ? 0 : 6;
  twists_.resize(rows, 2 * contacts);
  int row = 0;
  for (int end = 0; end < 2; ++end) {
    if (states[bodies[end]].fixed) continue;
    double arm = 1.0;
    for (int i = 0; i < 2 * contacts; ++i) {
      const Contact& contact = impulses[sticking_[i / 2]].contact;
      const Six G = multiply_back(end == 0 ? contact.G_a : contact.G_b, contact.axes[1 + i % 2]);
      arm = max(arm, largest_size(G.at + 3, 3));
      const Six change = multiply(states[bodies[end]].M_inverse, G);
      for (int k = 0; k < 6; ++k) twists_[row + k][i] = root_[i] * change[k];
    }
    for (int k = 3; k < 6; ++k) {
      for (int i = 0; i < 2 * contacts; ++i) twists_[row + k][i] *= arm;
    }
    row += 6;
  }
  return rows > 0;
}

// least = root V'V (T / root), with V orthonormal rows of what moves a ship.
void SelfStress::find_least() {
  const int size = twists_.columns();
  const int rank = orthonormalise_rows(twists_, RANK);
  fill_zeros(least_.data(), size);
  for (int k = 0; k < rank; ++k) {
    const double* V = twists_[k];
    double along = 0.0;
    for (int i = 0; i < size; ++i) along += root_[i] > 0.0 ? V[i] * (T_[i] / root_[i]) : 0.0;
    for (int i = 0; i < size; ++i) least_[i] += along * V[i];
  }
  for (int i = 0; i < size; ++i) least_[i] *= root_[i];
}

// Largest s up to 1 for which T + s (least - T) stays in every cone, or where T is outside, no farther outside.
double SelfStress::find_largest_share(double mu) const {
  double share = 1.0;
  for (int i = 0; i < sticking_.size(); ++i) {
    const double a = T_[2 * i], b = T_[2 * i + 1], c = least_[2 * i], d = least_[2 * i + 1];
    const double limit = max(mu * N_[i], hypot(a, b));
    if (!(hypot(c, d) > limit)) continue;
    const double d_1 = c - a, d_2 = d - b;
    const double dd = d_1 * d_1 + d_2 * d_2, td = a * d_1 + b * d_2, rest = a * a + b * b - limit * limit;
    share = min(share, max(0.0, (-td + sqrt(max(0.0, td * td - dd * rest))) / dd));
  }
  return share;
}

// Books the difference of the impulses on a body, unless it is rounding: no motion is held then.
void SelfStress::book_change(const Impulse* impulses, BodyState* states, bool of_b) {
  Six change{}, whole{};
  for (int i = 0; i < sticking_.size(); ++i) {
    const auto& [contact, P] = impulses[sticking_[i]];
    const Jacobian& G = of_b ? contact.G_b : contact.G_a;
    change = change + multiply_back(G, split_[i] - P);
    for (int k = 0; k < 6; ++k) {
      for (int m = 0; m < 3; ++m) whole[k] += abs(P[m]) * abs(G[m][k]);
    }
  }
  const Contact& first = impulses[sticking_[0]].contact;
  BodyState& state = states[of_b ? first.b : first.a];
  bool is_rounding = true;
  for (int k = 0; k < 6; ++k) is_rounding = is_rounding && !(abs(change[k]) > ROUNDING * whole[k]);
  if (!state.fixed && !is_rounding) state.book(of_b ? change : Six{} - change);
}

}  // namespace shipcollision
