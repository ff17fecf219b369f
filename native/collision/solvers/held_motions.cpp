#include "held_motions.hpp"

#include "poisson_restitution.hpp"

namespace shipcollision {

namespace {

constexpr int ROUNDS = 2;
constexpr double SLIP_TOLERANCE = 1e-9;

// The largest of H_tn as a share of the largest on the diagonal of W.
double find_share(const Dense& W, const Dense& H) {
  double largest = 0.0, stiffest = W[0][0];
  for (int n = 0; n < W.rows(); ++n) {
    stiffest = max(stiffest, W[n][n]);
    for (int m = 0; m < W.rows() && n % 3 != 0; m += 3) largest = max(largest, abs(H[n][m]));
  }
  return largest / stiffest;
}

}  // namespace

bool HeldFriction::reserve(int contacts) {
  const int size = 3 * contacts;
  return W.resize(size, size) && slip.resize(size) && start.resize(size) && met.resize(size) && found.resize(size);
}

void yield_to_friction(const Dense& W, const double* v, double mu, const Dense& H, GaussSeidel& gauss_seidel,
                       WorkLimit& work, HeldFriction& friction) {
  const int size = W.rows();
  for (int n = 0; n < size; ++n) {
    for (int m = 0; m < size; ++m) friction.W[n][m] = n % 3 != 0 && m % 3 != 0 ? H[n][m] + W[n][m] : W[n][m];
  }
  fill_zeros(friction.slip.data(), size);
  const double share = find_share(W, H);
  if (!(mu > 0.0 && share > SLIP_TOLERANCE)) return;
  const double approach = max(LEAST_REBOUNDING_APPROACH, find_approach(v, size));
  double met_friction = 0.0;
  const double scale = approach * max(1.0, SLIP_TOLERANCE / (share * SWEEP_TOLERANCE));
  for (int round = 0; round < ROUNDS; ++round) {
    if (!work.is_spent() || !friction.has_start) {
      for (int n = 0; n < size; ++n) friction.met[n] = v[n] + friction.slip[n];
      gauss_seidel.solve(friction.W, friction.met.data(), met_friction,
                         friction.has_start ? friction.start.data() : nullptr, scale, work, friction.found.data());
      copy_numbers(friction.start.data(), friction.found.data(), size);
      friction.has_start = true;
    }
    for (int n = 0; n < size; ++n) {
      double slip = 0.0;
      for (int m = 0; m < size && n % 3 != 0; m += 3) slip += H[n][m] * friction.start[m];
      friction.slip[n] = slip;
    }
    met_friction = mu;
  }
}

}  // namespace shipcollision
