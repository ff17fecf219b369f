#include "delassus.hpp"

namespace shipcollision {

namespace {

constexpr double ON_END = 1e-12;

Six times(double factor, const Six& p) {
  Six product;
  for (int i = 0; i < 6; ++i) product[i] = factor * p[i];
  return product;
}

// sign axes G: rows of G in contact axes.
Jacobian turn(const Rows& axes, const Jacobian& G, double sign) {
  Jacobian turned;
  for (int i = 0; i < 3; ++i) {
    turned.at[i] = times(sign, times(axes[i][0], G[0]) + times(axes[i][1], G[1]) + times(axes[i][2], G[2]));
  }
  return turned;
}

Jacobian multiply(const Jacobian& G, const Matrix& inverse) {
  Jacobian product;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 6; ++j) {
      double sum = 0.0;
      for (int k = 0; k < 6; ++k) sum += G[i][k] * inverse[k][j];
      product.at[i][j] = sum;
    }
  }
  return product;
}

// The vertical velocity of a place for heave, roll and pitch of a body.
Three find_vertical_velocity(const Three& at, const BodyState& state) {
  const double c_x = state.applied.R[0][0], s_x = state.applied.R[1][0];  // heading times cos(trim)
  const double north = at[0] - state.applied.x[0], east = at[1] - state.applied.x[1];
  const double on_end = max(hypot(c_x, s_x), ON_END);
  return {{1.0, c_x * east - s_x * north, -(c_x * north + s_x * east) / on_end}};
}

Three find_down(const Contact& contact) { return column(contact.axes, 2); }

}  // namespace

void approach_velocities(const Contact* contacts, int count, const BodyState* states, double* v) {
  for (int i = 0; i < count; ++i) {
    const Three velocity = rotate(contacts[i].axes, mean_velocity(contacts[i], states));
    copy_numbers(v + 3 * i, velocity.at, 3);
  }
}

bool Delassus::reserve(int contacts) {
  const int size = 3 * contacts;
  return W_.resize(size, size) && H_.resize(size, size) && moved_.resize(contacts) && vertical_.resize(contacts);
}

const Dense& Delassus::find_operator(const Contact* contacts, int count, const BodyState* states) {
  for (int i = 0; i < count; ++i) {
    const Contact& c = contacts[i];
    Moved& moved = moved_[i];
    moved.G_a = turn(c.axes, c.G_a, -1.0);
    moved.G_b = turn(c.axes, c.G_b, 1.0);
    moved.moved_a = multiply(moved.G_a, states[c.a].M_inverse);
    moved.moved_b = multiply(moved.G_b, states[c.b].M_inverse);
  }
  W_.clear();
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j <= i; ++j) {
      const Contact &c = contacts[i], &d = contacts[j];
      const Moved &moved = moved_[i], &other = moved_[j];
      if (c.a != d.a && c.a != d.b && c.b != d.a && c.b != d.b) continue;
      for (int p = 0; p < 3; ++p) {
        for (int q = 0; q < 3; ++q) {
          double w = 0.0;
          if (c.a == d.a) w += dot(moved.moved_a[p], other.G_a[q]);
          if (c.a == d.b) w += dot(moved.moved_a[p], other.G_b[q]);
          if (c.b == d.a) w += dot(moved.moved_b[p], other.G_a[q]);
          if (c.b == d.b) w += dot(moved.moved_b[p], other.G_b[q]);
          W_[3 * i + p][3 * j + q] = w;
        }
      }
    }
  }
  for (int n = 0; n < 3 * count; ++n) {  // of the blocks on the diagonal, the mean of both halves
    for (int m = 0; m < n; ++m) W_[n][m] = W_[m][n] = n / 3 == m / 3 ? 0.5 * (W_[n][m] + W_[m][n]) : W_[n][m];
  }
  return W_;
}

const Dense* Delassus::find_held_operator(const Contact* contacts, int count, const BodyState* states) {
  bool is_any_held = false;
  for (int i = 0; i < count; ++i) {
    const Contact& c = contacts[i];
    const BodyState &a = states[c.a], &b = states[c.b];
    Vertical& vertical = vertical_[i];
    vertical = {a.has_held, b.has_held, find_down(c), {}, {}, {}, {}};
    if (a.has_held) {
      vertical.g_a = -find_vertical_velocity(c.at, a);
      vertical.moved_a = rotate_back(a.held, vertical.g_a);
    }
    if (b.has_held) {
      vertical.g_b = find_vertical_velocity(c.at, b);
      vertical.moved_b = rotate_back(b.held, vertical.g_b);
    }
    is_any_held = is_any_held || a.has_held || b.has_held;
  }
  if (!is_any_held) return nullptr;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const Contact &c = contacts[i], &d = contacts[j];
      const Vertical &one = vertical_[i], &other = vertical_[j];
      double mobility = 0.0;
      if (c.a == d.a && one.holds_a) mobility += dot(one.moved_a, other.g_a);
      if (c.a == d.b && one.holds_a) mobility += dot(one.moved_a, other.g_b);
      if (c.b == d.a && one.holds_b) mobility += dot(one.moved_b, other.g_a);
      if (c.b == d.b && one.holds_b) mobility += dot(one.moved_b, other.g_b);
      for (int p = 0; p < 3; ++p) {
        for (int q = 0; q < 3; ++q) H_[3 * i + p][3 * j + q] = one.down[p] * mobility * other.down[q];
      }
    }
  }
  return &H_;
}

Rows find_mobility(const Contact& contact, const BodyState* states) {
  const Jacobian G_a = turn(contact.axes, contact.G_a, 1.0), G_b = turn(contact.axes, contact.G_b, 1.0);
  const Jacobian moved_a = multiply(G_a, states[contact.a].M_inverse);
  const Jacobian moved_b = multiply(G_b, states[contact.b].M_inverse);
  Rows W;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) W.at[i][j] = dot(moved_a[i], G_a[j]) + dot(moved_b[i], G_b[j]);
  }
  return W;
}

bool find_held_mobility(const Contact& contact, const BodyState* states, Rows& H) {
  const Three down = find_down(contact);
  double mobility = 0.0;
  bool is_any_held = false;
  const BodyState* const bodies[] = {&states[contact.a], &states[contact.b]};
  for (const BodyState* body : bodies) {
    const BodyState& state = *body;
    if (!state.has_held) continue;
    const Three g = find_vertical_velocity(contact.at, state);
    mobility += dot(rotate_back(state.held, g), g);
    is_any_held = true;
  }
  for (int i = 0; i < 3; ++i) H.at[i] = (down[i] * mobility) * down;
  return is_any_held;
}

}  // namespace shipcollision
