#include "aclm_fixed_point.hpp"

#include "../../numbers/eigenvalues.hpp"
#include "../dynamics/small_blocks.hpp"
#include "contact_law.hpp"

namespace shipcollision {

namespace {

constexpr int MAX_FIXED_POINTS = 10;
constexpr int MAX_GRADIENT_STEPS = 1000;
constexpr double CLOSER = 1e-3;
constexpr int MOST_ROWS = 96;

// The nearest impulse within the cone.
void project_on_cone(double* P, double mu) {
  const double size = hypot(P[1], P[2]);
  if (size <= mu * P[0]) return;
  const double nearest = max((P[0] + mu * size) / (1.0 + mu * mu), 0.0);
  const double share = mu * nearest / (size > 0.0 ? size : 1.0);
  P[0] = nearest;
  P[1] *= share;
  P[2] *= share;
}

}  // namespace

AclmFixedPoint::AclmFixedPoint(Memory& memory)
    : reduced_(memory), shifted_(memory), ahead_(memory), gradient_(memory), new_(memory), work_(memory) {}

bool AclmFixedPoint::reserve(int contacts) {
  contacts_ = contacts;
  const int size = 3 * contacts, reduced = size <= MOST_ROWS ? size : 0;
  return shifted_.resize(size) && ahead_.resize(size) && gradient_.resize(size) && new_.resize(size) &&
         reduced_.resize(reduced, reduced) && work_.resize(3 * reduced);
}

void AclmFixedPoint::set_operator(const Dense& W) {
  W_ = &W;
  steepest_ = 0.0;
  if (W.rows() <= MOST_ROWS) {
    for (int i = 0; i < W.rows(); ++i) copy_numbers(reduced_[i], W[i], W.rows());
    steepest_ = find_largest_eigenvalue(reduced_, work_.data());
    return;
  }
  for (int i = 0; i < W.rows(); ++i) {
    double sum = 0.0;
    for (int j = 0; j < W.rows(); ++j) sum += abs(W[i][j]);
    steepest_ = max(steepest_, sum);
  }
}

void AclmFixedPoint::solve(const double* v, double mu, double* P, double tolerance, WorkLimit& work) {
  const int size = 3 * contacts_;
  for (int i = 0; i < MAX_FIXED_POINTS; ++i) {
    const double residual = law_residual(*W_, v, mu, P);
    if (residual <= tolerance || work.is_spent()) break;
    multiply(*W_, P, gradient_.data());
    copy_numbers(shifted_.data(), v, size);
    for (int n = 0; n < size; n += 3) {
      shifted_[n] += mu * hypot(v[n + 1] + gradient_[n + 1], v[n + 2] + gradient_[n + 2]);  // its sliding speed
    }
    solve_convex(mu, P, max(CLOSER * residual, 0.1 * tolerance), work);
  }
}

// tolerance [m/s]: change of velocity in a step at which the steps end.
void AclmFixedPoint::solve_convex(double mu, double* P, double tolerance, WorkLimit& work) {
  const int size = 3 * contacts_;
  copy_numbers(ahead_.data(), P, size);
  double t = 1.0;
  for (int i = 0; i < MAX_GRADIENT_STEPS; ++i) {
    multiply(*W_, ahead_.data(), gradient_.data());
    double uphill = 0.0, longest = 0.0;
    for (int n = 0; n < size; n += 3) {
      for (int k = n; k < n + 3; ++k) {
        gradient_[k] += shifted_[k];
        new_[k] = ahead_[k] - gradient_[k] / steepest_;
      }
      project_on_cone(&new_[n], mu);
      for (int k = n; k < n + 3; ++k) {
        uphill += gradient_[k] * (new_[k] - P[k]);
        longest = max(longest, abs(new_[k] - P[k]));
      }
    }
    if (uphill > 0.0) t = 1.0;
    const double t_new = 0.5 * (1.0 + sqrt(1.0 + 4.0 * t * t)), momentum = (t - 1.0) / t_new;
    for (int k = 0; k < size; ++k) {
      ahead_[k] = new_[k] + momentum * (new_[k] - P[k]);
      P[k] = new_[k];
    }
    t = t_new;
    work.spend_gradient_step(contacts_);
    if (longest * steepest_ <= tolerance || work.is_spent()) break;
  }
}

}  // namespace shipcollision
