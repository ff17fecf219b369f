#include "contact.hpp"

namespace shipcollision {

Jacobian point_jacobian(const Rows& R_nb, const Three& r_b) {
  Jacobian G;
  for (int i = 0; i < 3; ++i) G.at[i] = join(R_nb[i], cross(r_b, R_nb[i]));
  return G;
}

Contact make_contact(int a, int b, const BodyState* states, const Three& point, double gap, const Rows& axes) {
  const BodyState &one = states[a], &other = states[b];
  Contact contact{a, b, point, axes[0], axes, gap, one.in_body(point), other.in_body(point), {}, {}, {}};
  const Pose &at_a = one.applied, &at_b = other.applied;
  contact.at = 0.5 * (at_a.x + rotate(at_a.R, contact.r_a) + (at_b.x + rotate(at_b.R, contact.r_b)));
  contact.G_a = point_jacobian(at_a.R, rotate_back(at_a.R, contact.at - at_a.x));
  contact.G_b = point_jacobian(at_b.R, rotate_back(at_b.R, contact.at - at_b.x));
  return contact;
}

Three mean_velocity(const Contact& contact, const BodyState* states) {
  return multiply(contact.G_b, states[contact.b].nu_mean) - multiply(contact.G_a, states[contact.a].nu_mean);
}

Three energy_velocity(const Contact& contact, const BodyState* states) {
  return multiply(contact.G_b, states[contact.b].nu_energy) - multiply(contact.G_a, states[contact.a].nu_energy);
}

void book_impulses(const Impulse* impulses, int count, BodyState* states, Booked* booked) {
  for (int i = 0; i < count; ++i) {
    booked[i].impulse = impulses[i];
    booked[i].before = energy_velocity(impulses[i].contact, states);
  }
  for (int i = 0; i < count; ++i) {
    const auto& [contact, P] = impulses[i];
    if (is_same(P, Three{})) continue;
    if (!states[contact.a].fixed) states[contact.a].book(multiply_back(contact.G_a, -P));
    if (!states[contact.b].fixed) states[contact.b].book(multiply_back(contact.G_b, P));
  }
  for (int i = 0; i < count; ++i) {
    booked[i].after = energy_velocity(impulses[i].contact, states);
    booked[i].lost = -0.5 * dot(impulses[i].P, booked[i].before + booked[i].after);
  }
}

}  // namespace shipcollision
