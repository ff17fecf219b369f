#include "coasting_law.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr double FINEST = 0.1;
constexpr double FINEST_OSCILLATION = 0.1;
constexpr int MAXIMUM_SUBSTEPS = 10000;

// nu_l = (u, v, w, phi_dot, theta_dot, psi_dot) of a twist in b.
Six level_motion(const Three& velocity, const Three& rate, double phi, double theta) {
  if (phi == 0.0 && theta == 0.0) return {{velocity[0], velocity[1], velocity[2], rate[0], rate[1], rate[2]}};
  const double s_phi = sin(phi), c_phi = cos(phi), s_theta = sin(theta), c_theta = cos(theta);
  const double below = s_phi * velocity[1] + c_phi * velocity[2];
  const double under = s_phi * rate[1] + c_phi * rate[2];
  const double ahead = c_theta * rate[0] + s_theta * under;
  return {{c_theta * velocity[0] + s_theta * below, c_phi * velocity[1] - s_phi * velocity[2],
           c_theta * below - s_theta * velocity[0], ahead / c_theta, c_phi * rate[1] - s_phi * rate[2],
           c_theta * under - s_theta * rate[0] + ahead * tan(theta)}};
}

// The inverse of level_motion.
void tilt_motion(const Six& nu_l, double phi, double theta, Three& velocity, Three& rate) {
  const auto& [u, v, w, p, q, r] = nu_l.at;
  if (phi == 0.0 && theta == 0.0) {
    velocity = {{u, v, w}};
    rate = {{p, q, r}};
    return;
  }
  const double s_phi = sin(phi), c_phi = cos(phi), s_theta = sin(theta), c_theta = cos(theta);
  const double below = c_theta * w + s_theta * u;
  velocity = {{c_theta * u - s_theta * w, c_phi * v + s_phi * below, c_phi * below - s_phi * v}};
  const double under = c_theta * r;
  rate = {{p - s_theta * r, c_phi * q + s_phi * under, c_phi * under - s_phi * q}};
}

// Rows of the product of a matrix and the one of these columns.
Rows turn(const Rows& rows, const Three (&columns)[3]) {
  Rows turned;
  for (int i = 0; i < 3; ++i) {
    turned.at[i] = {{dot(rows[i], columns[0]), dot(rows[i], columns[1]), dot(rows[i], columns[2])}};
  }
  return turned;
}

}  // namespace

bool CoastingLaw::set_up(const PreparedShip& ship, int degrees_of_freedom, Coasting law, Text& why) {
  has_sea_ = law == Coasting::kirchhoff && degrees_of_freedom != 3;
  if (has_sea_ && !set_up_sea(ship, degrees_of_freedom, why)) return false;
  if (law == Coasting::straight) {
    kind_ = Kind::straight;
    keeps_course_ = true;
    centre_ = ship.r_bg;
  } else if (degrees_of_freedom == 6) {
    set_up_space(ship);
  } else {
    set_up_plane(ship, degrees_of_freedom);
  }
  return true;
}

bool CoastingLaw::set_up_sea(const PreparedShip& ship, int degrees_of_freedom, Text& why) {
  if (!ship.seakeeping_refusal.is_empty()) {
    why << ship.seakeeping_refusal << "; or let it coast without buoyancy, coasting = 'straight'";
    return false;
  }
  const Seakeeping& sea = ship.seakeeping;
  const Matrix& inverse = ship.inverse(degrees_of_freedom);
  restoring_ = Restoring(sea);
  damping_ = Damping(sea);
  fastest_ = sqrt(max(max(sea.K_33 * inverse[2][2], sea.K_44 * inverse[3][3]), sea.K_55 * inverse[4][4]));
  return true;
}

void CoastingLaw::set_up_plane(const PreparedShip& ship, int degrees_of_freedom) {
  const Matrix &M = ship.M, &inverse = ship.inverse(degrees_of_freedom);
  kind_ = Kind::plane;
  radius_ = sqrt(M[5][5] / M[0][0]);
  rolls_ = degrees_of_freedom == 4;
  plane_ = KirchhoffPlane(M, inverse, radius_);
  roll_mobility_ = inverse[3][3];
  keeps_course_ = M[0][1] == 0.0;
  centre_ = {{M[1][5] / M[1][1], -M[0][5] / M[0][0], 0.0}};
  is_isotropic_ = degrees_of_freedom == 3 && M[0][0] == M[1][1] && keeps_course_;
}

void CoastingLaw::set_up_space(const PreparedShip& ship) {
  const Matrix& M = ship.M;
  kind_ = Kind::space;
  roll_radius_ = sqrt(M[3][3] / M[0][0]);
  radius_ = sqrt(min(M[4][4], M[5][5]) / M[0][0]);
  space_ = KirchhoffSpace(M, ship.inverse(6), roll_radius_);
  keeps_course_ = M[0][1] == 0.0 && M[0][2] == 0.0;
  centre_ = ship.r_bg;
}

bool CoastingLaw::coast(const Motion& before, double h, Motion& after, Text& why) const {
  switch (kind_) {
    case Kind::plane: return coast_in_plane(before, h, after, why);
    case Kind::space: return coast_in_space(before, h, after, why);
    case Kind::straight: after = shipcollision::coast(before, centre_, h);
  }
  return true;
}

bool CoastingLaw::is_straight(const Motion& motion) const {
  const auto& [position, attitude, velocity, rate] = motion;
  const bool turns = rate[0] != 0.0 || rate[1] != 0.0 || rate[2] != 0.0;
  const bool is_upright = attitude[0] == 0.0 && attitude[1] == 0.0;
  if (turns) return false;
  switch (kind_) {
    case Kind::plane: return (velocity[1] == 0.0 || is_isotropic_) && keeps_course_ && is_upright;
    case Kind::space:
      return velocity[1] == 0.0 && velocity[2] == 0.0 && keeps_course_ &&
             (!has_sea_ || (position[2] == 0.0 && is_upright));
    case Kind::straight: break;
  }
  return true;
}

bool CoastingLaw::coast_in_plane(const Motion& before, double h, Motion& after, Text& why) const {
  const auto& [position, attitude, velocity, rate] = before;
  Motion moved = before;
  auto& [x, y, z] = moved.position.at;
  auto& [phi, theta, psi] = moved.attitude.at;
  const bool goes_ahead =
      velocity[1] == 0.0 && rate[0] == 0.0 && rate[1] == 0.0 && rate[2] == 0.0 && keeps_course_;
  if (phi == 0.0 && theta == 0.0 && (is_isotropic_ || goes_ahead)) {
    after = shipcollision::coast(before, centre_, h);  // an isotropic body moves as if there were no water
    return true;
  }
  const Six level = level_motion(velocity, rate, phi, theta);
  const auto& [u, v, w, p, q, r] = level.at;
  int n;
  if (!count(h, abs(r) + (abs(u) + abs(v)) / radius_, n, why)) return false;
  const double dt = h / n;
  Four nu{{u, v, rolls_ ? p : 0.0, r}};
  if (has_sea_) nu = kick(nu, phi, 0.5 * dt);
  Four mean = nu;
  for (int k = 1; k <= n; ++k) {
    const double c = cos(psi), s = sin(psi);
    const KirchhoffPlane::Step step = plane_.step(nu, mean, dt);
    mean = step.mean;
    nu = step.after;
    x = x + c * step.dx - s * step.dy;
    y = y + s * step.dx + c * step.dy;
    psi += dt * mean[3];
    phi += dt * mean[2];
    if (has_sea_) nu = kick(nu, phi, k < n ? dt : 0.5 * dt);
  }
  if (!rolls_) phi += h * p;
  theta += h * q;
  after.position = {{x, y, z + h * w}};
  after.attitude = moved.attitude;
  tilt_motion({{nu[0], nu[1], w, rolls_ ? nu[2] : p, q, nu[3]}}, phi, theta, after.velocity, after.rate);
  return true;
}

bool CoastingLaw::coast_in_space(const Motion& before, double h, Motion& after, Text& why) const {
  if (is_straight(before)) {
    after = shipcollision::coast(before, centre_, h);
    return true;
  }
  const auto& [position, attitude, velocity, rate] = before;
  const auto& [u, v, w] = velocity.at;
  const auto& [p, q, r] = rate.at;
  const double speed = abs(u) / radius_ + (abs(v) + abs(w)) / roll_radius_;
  int n;
  if (!count(h, abs(p) + abs(q) + abs(r) + speed, n, why)) return false;
  const double dt = h / n;
  Three place = position;
  auto& [x, y, z] = place.at;
  Six nu{{u, v, w, p, q, r}};
  Rows rows = rotation_rows(attitude[0], attitude[1], attitude[2]);
  if (has_sea_) nu = kick(nu, z, rows[2], 0.5 * dt);
  Six mean = nu;
  double turned = 0.0;
  for (int k = 1; k <= n; ++k) {
    const KirchhoffSpace::Step step = space_.step(nu, mean, dt);
    mean = step.mean;
    nu = step.after;
    const auto& [dx, dy, dz] = step.d.at;
    x = x + rows[0][0] * dx + rows[0][1] * dy + rows[0][2] * dz;
    y = y + rows[1][0] * dx + rows[1][1] * dy + rows[1][2] * dz;
    z = z + rows[2][0] * dx + rows[2][1] * dy + rows[2][2] * dz;
    turned += dt * (rows[2][0] * mean[3] + rows[2][1] * mean[4] + rows[2][2] * mean[5]);
    rows = turn(rows, step.columns);
    if (has_sea_) nu = kick(nu, z, rows[2], k < n ? dt : 0.5 * dt);
  }
  after.position = place;
  after.attitude =
      find_attitude(rows[2], rows[0][0], rows[1][0], rows[0][1], rows[1][1], attitude[2] + turned);
  after.velocity = {{nu[0], nu[1], nu[2]}};
  after.rate = {{nu[3], nu[4], nu[5]}};
  return true;
}

// Number of substeps of h [s]; turning: rate of change of the direction of the motion [rad/s].
bool CoastingLaw::count(double h, double turning, int& n, Text& why) const {
  double need = h * turning / FINEST;
  if (has_sea_) need = max(need, h * fastest_ / FINEST_OSCILLATION);
  if (!(need <= MAXIMUM_SUBSTEPS)) {
    why << "a step of ";
    why.short_number(h) << " s takes ";
    why.short_number(need, 3) << " substeps of a ship that coasts, at most " << MAXIMUM_SUBSTEPS
                              << ": take shorter steps, or coasting = 'straight'";
    return false;
  }
  n = static_cast<int>(max(1.0, ceil(need - 1e-9)));
  return true;
}

// nu after dt [s] of restoring and damping in roll, by the midpoint rule.
Four CoastingLaw::kick(const Four& nu, double phi, double dt) const {
  const double moment = restoring_.compute_roll_moment(sin(phi), cos(phi)), p = nu[2];
  const double half = p + 0.5 * dt * roll_mobility_ * (moment + damping_(0.0, p, 0.0).K);
  return plane_.kick(nu, dt * (moment + damping_(0.0, half, 0.0).K));
}

// nu after dt [s] of restoring and damping, by the midpoint rule. down: the third row of R_nb.
Six CoastingLaw::kick(const Six& nu, double z, const Three& down, double dt) const {
  const double s_theta = -down[0], c_theta = max(hypot(down[1], down[2]), 1e-9);
  const Six force = restoring_(z, down[1] / c_theta, down[2] / c_theta, s_theta, c_theta);
  const auto& [X, Y, Z, K, M, N] = force.at;
  const double half = 0.5 * dt;
  const Damping::Wrench first = damping_(nu[2], nu[3], nu[4]);
  const Three mid = space_.kick_oscillation(
      nu, {{half * X, half * Y, half * (Z + first.Z), half * (K + first.K), half * (M + first.M), half * N}});
  const Damping::Wrench second = damping_(mid[0], mid[1], mid[2]);
  return space_.kick(nu, {{dt * X, dt * Y, dt * (Z + second.Z), dt * (K + second.K), dt * (M + second.M), dt * N}});
}

}  // namespace shipcollision
