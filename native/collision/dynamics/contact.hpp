// A contact point, the velocities there, and the booking of an impulse: the twin of
// shipcollision_fmu/collision/dynamics/contact.py.
#pragma once

#include "body_state.hpp"

namespace shipcollision {

// Rows of G (3, 6): the velocity of a point in n is G nu, and an impulse P in n is G' P in b about CO.
struct Jacobian {
  Six at[3];

  const Six& operator[](int k) const { return at[k]; }
};

inline Three multiply(const Jacobian& G, const Six& nu) { return {{dot(G[0], nu), dot(G[1], nu), dot(G[2], nu)}}; }
inline Six multiply_back(const Jacobian& G, const Three& P) {
  Six J;
  for (int i = 0; i < 6; ++i) J[i] = G[0][i] * P[0] + G[1][i] * P[1] + G[2][i] * P[2];
  return J;
}

struct Contact {
  int a, b;  // numbers of the bodies
  Three point, normal;
  Rows axes;
  double gap;
  Three r_a, r_b, at;
  Jacobian G_a, G_b;
};

// The impulse P [N s], in n, on body b; body a takes -P.
struct Impulse {
  Contact contact;
  Three P;
};

// An impulse, the relative velocities in n before and after all impulses of its instant, and the energy lost [J].
struct Booked {
  Impulse impulse;
  Three before, after;
  double lost;
};

// G of the point r_b, in b from CO.
Jacobian point_jacobian(const Rows& R_nb, const Three& r_b);

// The contact at `point` (in n, predicted poses) of bodies a and b. axes: those of the normal.
Contact make_contact(int a, int b, const BodyState* states, const Three& point, double gap, const Rows& axes);

// Velocity of b relative to a, in n, in the mean over the step; and without what other forces may add.
Three mean_velocity(const Contact& contact, const BodyState* states);
Three energy_velocity(const Contact& contact, const BodyState* states);

// Adds the impulses of one instant to the twists and to what is issued. Obstacles take none. booked: as many.
void book_impulses(const Impulse* impulses, int count, BodyState* states, Booked* booked);

}  // namespace shipcollision
