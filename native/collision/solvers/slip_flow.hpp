// The slip flow of one contact: the twin of shipcollision_fmu/collision/solvers/slip_flow.py.
//
// Without its integration, which the response closed_form alone needs.
#pragma once

#include "../../numbers/elementary.hpp"

namespace shipcollision {

constexpr double INVARIANT = 1e-14;

// With w = (w_1, w_2), n = (n_1, n_2), A = diag(A_1, A_2) and friction mu.
struct SlipFlow {
  double w_1, w_2, n_1, n_2, A_1, A_2, mu;

  // Bound of the change of the slip's size and direction per normal impulse.
  double rate() const { return hypot(w_1, w_2) + mu * max(A_1, A_2); }
  // Change of the slip's size per normal impulse.
  double growth(double angle) const;
  // Direction (c, s) in which slip starts from rest when friction cannot hold the contact.
  void solve_reslip(double& c, double& s) const;
};

}  // namespace shipcollision
