#include "gauss_seidel.hpp"

#include "../dynamics/small_blocks.hpp"

namespace shipcollision {

namespace {

constexpr int MAX_SWEEPS = 30;
constexpr int LEAST_SWEEPS = 8;
constexpr int LEAST_NEWTON_STEPS = 6;
constexpr int MAX_SWEEPS_OF_MANY = 2;
constexpr int MAX_ROUNDS = 20;
constexpr double IMMOBILE = 1e-9;

}  // namespace

Turn find_principal_axes(const Dense& W, int contact) {
  const int n = 3 * contact + 1;
  const double angle = 0.5 * atan2(2.0 * W[n][n + 1], W[n][n] - W[n + 1][n + 1]);
  return {cos(angle), sin(angle)};
}

void turn_tangents(const Turn* turns, int contacts, double* numbers) {
  for (int i = 0; i < contacts; ++i) {
    double &x = numbers[3 * i + 1], &y = numbers[3 * i + 2];
    const double turned = turns[i].c * x + turns[i].s * y;
    y = turns[i].c * y - turns[i].s * x;
    x = turned;
  }
}

void turn_tangents_back(const Turn* turns, int contacts, double* numbers) {
  for (int i = 0; i < contacts; ++i) {
    double &x = numbers[3 * i + 1], &y = numbers[3 * i + 2];
    const double turned = turns[i].c * x - turns[i].s * y;
    y = turns[i].c * y + turns[i].s * x;
    x = turned;
  }
}

void turn_tangents(const Turn* turns, Dense& W) {
  const int contacts = W.rows() / 3;
  for (int i = 0; i < contacts; ++i) {
    double *x = W[3 * i + 1], *y = W[3 * i + 2];
    for (int j = 0; j < W.columns(); ++j) {
      const double turned = turns[i].c * x[j] + turns[i].s * y[j];
      y[j] = turns[i].c * y[j] - turns[i].s * x[j];
      x[j] = turned;
    }
  }
  for (int n = 0; n < W.rows(); ++n) turn_tangents(turns, contacts, W[n]);
}

void clear_rounding(Dense& W, double* v) {
  const int size = W.rows();
  double largest = 0.0;
  for (int n = 0; n < size; ++n) largest = n == 0 ? W[n][n] : max(largest, W[n][n]);
  const double least = IMMOBILE * largest;
  for (int n = 0; n < size; ++n) {
    if (n % 3 == 0 || W[n][n] > least) continue;
    fill_zeros(W[n], size);
    for (int i = 0; i < size; ++i) W[i][n] = 0.0;
    if (abs(v[n]) <= IMMOBILE * largest_size(v, size)) v[n] = 0.0;
  }
}

GaussSeidel::GaussSeidel(Memory& memory)
    : W_(memory), v_(memory), last_(memory), candidate_(memory), fixed_point_(memory), turns_(memory), blocks_(memory),
      angles_(memory), aitken_(memory), alart_curnier_(memory), aclm_(memory) {}

bool GaussSeidel::reserve(int contacts) {
  contacts_ = contacts;
  const int size = 3 * contacts;
  return W_.resize(size, size) && v_.resize(size) && last_.resize(size) && candidate_.resize(size) &&
         fixed_point_.resize(size) && turns_.resize(contacts) && blocks_.resize(contacts) &&
         angles_.resize(contacts) && aitken_.start(size) && alart_curnier_.reserve(contacts) && aclm_.reserve(contacts);
}

Solution GaussSeidel::solve(const Dense& W, const double* v, double mu, const double* start, double scale,
                            WorkLimit& work, double* P) {
  const int size = 3 * contacts_;
  const double approach = find_approach(v, size);
  fill_zeros(P, size);
  if (approach <= SWEEP_TOLERANCE * scale) return {max(0.0, approach) / scale, 0};
  for (int n = 0; n < size; ++n) copy_numbers(W_[n], W[n], size);
  copy_numbers(v_.data(), v, size);
  for (int i = 0; i < contacts_; ++i) turns_[i] = find_principal_axes(W, i);
  turn_tangents(turns_.data(), W_);
  turn_tangents(turns_.data(), contacts_, v_.data());
  clear_rounding(W_, v_.data());
  for (int i = 0; i < contacts_; ++i) {
    blocks_[i] = make_block(W_, i);
    angles_[i] = {};
  }
  int sweeps = 1;
  if (contacts_ == 1) {
    const Three alone = solve_one_contact(blocks_[0], {{v_[0], v_[1], v_[2]}}, mu, angles_[0]);
    copy_numbers(P, alone.at, 3);
  } else {
    scale_start(W, v, start, P);
    sweeps = sweep(mu, scale, work, P);
  }
  const double residual = law_residual(W_, v_.data(), mu, P) / scale;
  turn_tangents_back(turns_.data(), contacts_, P);
  return {residual, sweeps};
}

// The start in principal axes, of the size that dissipates most energy; zero if there is none.
void GaussSeidel::scale_start(const Dense& W, const double* v, const double* start, double* P) {
  const int size = 3 * contacts_;
  if (start == nullptr) return;
  multiply(W, start, P);
  const double share = max(0.0, -dot(start, v, size)) / dot(start, P, size);
  for (int n = 0; n < size; ++n) P[n] = isfinite(share) ? share * start[n] : 0.0;
  turn_tangents(turns_.data(), contacts_, P);
}

// Sweeps taken.
int GaussSeidel::sweep(double mu, double scale, WorkLimit& work, double* P) {
  const bool are_many = contacts_ >= MANY_CONTACTS;
  const int most = are_many ? MAX_SWEEPS_OF_MANY : MAX_SWEEPS;
  const double tolerance = SWEEP_TOLERANCE * scale, kept = 0.5 * work.left;  // kept for Newton's method
  aitken_.start(3 * contacts_);
  for (int sweeps = 1;; ++sweeps) {
    copy_numbers(last_.data(), P, 3 * contacts_);
    work.spend_sweep(contacts_);
    if (sweep_once(mu, P) <= tolerance) return sweeps;
    if (sweeps >= (work.left < kept && !are_many ? LEAST_SWEEPS : most)) {
      if (are_many) work.reserve_newton_steps(LEAST_NEWTON_STEPS, contacts_);
      solve_together(mu, P, tolerance, work);
      return sweeps;
    }
    aitken_.extrapolate(P, last_.data());
  }
}

// Solves one contact after the other, and gives the largest change of a contact's velocity by its own impulse [m/s].
double GaussSeidel::sweep_once(double mu, double* P) {
  const int size = 3 * contacts_;
  double change = 0.0;
  for (int i = 0; i < contacts_; ++i) {
    const int n = 3 * i;
    Three v;  // without the contact's own impulse
    for (int k = 0; k < 3; ++k) {
      const double* row = W_[n + k];
      v[k] = v_[n + k] + (dot(row, P, n) + dot(row + n + 3, P + n + 3, size - n - 3));
    }
    const ContactBlock& W = blocks_[i];
    const Three found = solve_one_contact(W, v, mu, angles_[i]);
    const double d = found[0] - P[n], d_1 = found[1] - P[n + 1], d_2 = found[2] - P[n + 2];
    copy_numbers(P + n, found.at, 3);
    change = max(change, abs(W.W_nn * d + W.w_1 * d_1 + W.w_2 * d_2));
    change = max(change, max(abs(W.w_1 * d + W.a_1 * d_1), abs(W.w_2 * d + W.a_2 * d_2)));
  }
  return change;
}

// From P to impulses with a residual of at most `tolerance` [m/s] by the methods that solve all contacts together, or
// the best that were found.
void GaussSeidel::solve_together(double mu, double* P, double tolerance, WorkLimit& work) {
  const int size = 3 * contacts_;
  fill_zeros(fixed_point_.data(), size);
  if (law_residual(W_, v_.data(), mu, P) > law_residual(W_, v_.data(), mu, fixed_point_.data())) fill_zeros(P, size);
  alart_curnier_.solve(W_, v_.data(), mu, P, tolerance, work);
  double least = law_residual(W_, v_.data(), mu, P);
  for (int round = 0; round < MAX_ROUNDS && !(least <= tolerance || work.is_spent()); ++round) {
    if (round == 0) aclm_.set_operator(W_);
    aclm_.solve(v_.data(), mu, fixed_point_.data(), tolerance, work);
    copy_numbers(candidate_.data(), fixed_point_.data(), size);
    alart_curnier_.solve(W_, v_.data(), mu, candidate_.data(), tolerance, work);
    const double residual = law_residual(W_, v_.data(), mu, candidate_.data());
    if (residual < least) {
      copy_numbers(P, candidate_.data(), size);
      least = residual;
    }
  }
}

}  // namespace shipcollision
