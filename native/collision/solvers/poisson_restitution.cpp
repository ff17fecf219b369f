#include "poisson_restitution.hpp"

#include "../dynamics/small_blocks.hpp"

namespace shipcollision {

namespace {

constexpr double NO_REBOUND = 1e-12;
constexpr int MAX_SWEEPS = 200;

// v + W P.
void find_velocities_after(const Dense& W, const double* v, const double* P, double* after) {
  multiply(W, P, after);
  for (int n = 0; n < W.rows(); ++n) after[n] += v[n];
}

}  // namespace

PoissonImpact::PoissonImpact(Memory& memory, GaussSeidel& gauss_seidel)
    : gauss_seidel_(gauss_seidel), W_(memory), met_(memory), v_(memory), after_(memory), compression_(memory),
      whole_(memory), impulses_(memory), last_(memory), turns_(memory), blocks_(memory), aitken_(memory) {}

bool PoissonImpact::reserve(int contacts) {
  contacts_ = contacts;
  const int size = 3 * contacts;
  bool is_there = W_.resize(size, size) && turns_.resize(contacts) && blocks_.resize(contacts) && aitken_.start(size);
  Vector* const vectors[] = {&met_, &v_, &after_, &compression_, &whole_, &impulses_, &last_};
  for (Vector* vector : vectors) {
    is_there = is_there && vector->resize(size);
  }
  return is_there;
}

Solution PoissonImpact::solve(const Dense& W, const double* v, double mu, double e, const double* start,
                              const double* slip, WorkLimit& work, double* P) {
  const int size = 3 * contacts_;
  const double approach = find_approach(v, size);
  const double scale = max(approach, LEAST_REBOUNDING_APPROACH);
  for (int n = 0; n < size; ++n) met_[n] = slip == nullptr ? v[n] : v[n] + slip[n];
  const Solution plastic = gauss_seidel_.solve(W, met_.data(), mu, start, scale, work, P);
  if (e <= NO_REBOUND || approach < LEAST_REBOUNDING_APPROACH || largest_size(P, size) == 0.0) return plastic;
  copy_numbers(compression_.data(), P, size);
  for (int n = 0; n < size && slip != nullptr; ++n) met_[n] += e * slip[n];
  add_restitution(W, mu, e, work);
  multiply(W, whole_.data(), after_.data());
  double gained = 0.0;
  for (int n = 0; n < size; ++n) gained += whole_[n] * (v[n] + 0.5 * after_[n]);
  if (gained > 0.0) {
    for (int n = 0; n < size; ++n) whole_[n] = (1.0 + e) * compression_[n];
  }
  find_velocities_after(W, met_.data(), whole_.data(), after_.data());
  const Solution last = gauss_seidel_.solve(W, after_.data(), mu, nullptr, scale, work, P);
  for (int n = 0; n < size; ++n) P[n] += whole_[n];
  return {max(plastic.residual, last.residual), plastic.sweeps + last.sweeps};
}

// The compression and its restitution, with friction that stops the slip if it can.
void PoissonImpact::add_restitution(const Dense& W, double mu, double e, WorkLimit& work) {
  const int size = 3 * contacts_;
  for (int n = 0; n < size; ++n) copy_numbers(W_[n], W[n], size);
  find_velocities_after(W, met_.data(), compression_.data(), v_.data());
  for (int i = 0; i < contacts_; ++i) turns_[i] = find_principal_axes(W, i);
  turn_tangents(turns_.data(), W_);
  turn_tangents(turns_.data(), contacts_, v_.data());
  clear_rounding(W_, v_.data());
  for (int n = 0; n < size; ++n) impulses_[n] = e * compression_[n];
  turn_tangents(turns_.data(), contacts_, impulses_.data());
  for (int i = 0; i < contacts_; ++i) blocks_[i] = make_block(W_, i);
  multiply(W_, impulses_.data(), after_.data());
  const double tolerance = SWEEP_TOLERANCE * (largest_size(v_.data(), size) + largest_size(after_.data(), size));
  const double kept = 0.5 * work.left;
  aitken_.start(size);
  for (int sweeps = 0; sweeps < MAX_SWEEPS; ++sweeps) {
    copy_numbers(last_.data(), impulses_.data(), size);
    const double change = sweep_once(mu);
    work.spend_sweep(contacts_);
    if (change <= tolerance || work.left < kept || sweeps == MAX_SWEEPS - 1) break;
    aitken_.extrapolate(impulses_.data(), last_.data());
  }
  turn_tangents_back(turns_.data(), contacts_, impulses_.data());
  for (int n = 0; n < size; ++n) whole_[n] = compression_[n] + impulses_[n];
}

double PoissonImpact::sweep_once(double mu) {
  const int size = 3 * contacts_;
  double change = 0.0;
  for (int i = 0; i < contacts_; ++i) {
    const int n = 3 * i;
    const ContactBlock& block = blocks_[i];
    const double p_1 = impulses_[n + 1], p_2 = impulses_[n + 2];
    const double f_1 = dot(W_[n + 1], impulses_.data(), size), f_2 = dot(W_[n + 2], impulses_.data(), size);
    const Friction found = solve_friction_in_disc(block, v_[n + 1] + f_1 - block.a_1 * p_1,
                                                  v_[n + 2] + f_2 - block.a_2 * p_2, mu * impulses_[n]);
    impulses_[n + 1] = found.P_1;
    impulses_[n + 2] = found.P_2;
    change = max(change, max(abs(block.a_1 * (found.P_1 - p_1)), abs(block.a_2 * (found.P_2 - p_2))));
  }
  return change;
}

}  // namespace shipcollision
