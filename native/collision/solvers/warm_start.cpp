#include "warm_start.hpp"

namespace shipcollision {

namespace {

constexpr double SAME_PLACE = 2.0;

}  // namespace

void WarmStarts::guess_impulses(const Contact* contacts, int count, double* P) const {
  for (int i = 0; i < count; ++i) {
    Three guess{};
    for (const WarmStart& row : rows_) {
      if (row.a != contacts[i].a || row.b != contacts[i].b) continue;
      if (!(norm(contacts[i].r_a - row.place) < SAME_PLACE)) continue;
      guess = rotate(contacts[i].axes, row.P);
      break;
    }
    for (int k = 0; k < 3; ++k) P[3 * i + k] = guess[k];
  }
}

void WarmStarts::keep_impulses(const Impulse* impulses, int count) {
  forget_parted([=](int a, int b) {
    for (int i = 0; i < count; ++i) {
      const Contact& contact = impulses[i].contact;
      if (contact.a == a && contact.b == b && !is_same(impulses[i].P, Three{})) return false;
    }
    return true;
  });
  for (int i = 0; i < count; ++i) {
    const auto& [contact, P] = impulses[i];
    if (!is_same(P, Three{})) rows_.add({contact.a, contact.b, contact.r_a, P});
  }
}

}  // namespace shipcollision
