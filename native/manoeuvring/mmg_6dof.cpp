#include "mmg_6dof.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

// The upper triangle of the block of the even or the odd rows and columns, row by row.
void take_upper(const Matrix& M, int first, double (&upper)[6]) {
  int k = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) upper[k++] = M[2 * i + first][2 * j + first];
  }
}

void take_block(const Matrix& M, int first, double (&block)[3][3]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) block[i][j] = M[2 * i + first][2 * j + first];
  }
}

double multiply(const double (&row)[3], double a, double b, double c) { return row[0] * a + row[1] * b + row[2] * c; }

}  // namespace

bool Mmg6Dof::set_up(const PreparedShip& ship, int degrees_of_freedom, Text& why) {
  if (!set_up_base(ship, why)) return false;
  if (!ship.seakeeping_refusal.is_empty()) {
    why << ship.seakeeping_refusal;
    return false;
  }
  const Seakeeping& sea = ship.seakeeping;
  surge_ = 6;
  count_ = 12;
  level_ = degrees_of_freedom == 4;
  restoring_ = Restoring(sea);
  damping_ = Damping(sea);
  z_H_ = sea.z_H;
  z_P_ = sea.z_P;
  z_R_ = sea.z_R;
  const double a_H = ship.has_rudder ? ship.rudder.a_H : 0.0;
  if (1.0 + a_H == 0.0) {
    why << "ship " << ship.name << ": [rudder] a_H = " << a_H << " leaves the rudder no sway force";
    return false;
  }
  z_RY_ = (sea.z_R + a_H * sea.z_H) / (1.0 + a_H);  // where rudder and the force it calls up on the hull act

  const Matrix& inverse = ship.inverse(degrees_of_freedom);
  take_upper(ship.M, 0, M_even_);
  take_upper(ship.M, 1, M_odd_);
  take_block(inverse, 0, even_);
  take_block(inverse, 1, odd_);
  munk_[0] = ship.M_A[1][1] - ship.M_A[0][0];
  munk_[1] = ship.M_A[1][3];
  shortest_time =
      1.0 / sqrt(max(max(sea.K_33 * inverse[2][2], sea.K_44 * inverse[3][3]), sea.K_55 * inverse[4][4]));
  return true;
}

Forces Mmg6Dof::compute_forces(const Six& eta, const Six& nu, const Machines& machines,
                               const Surroundings& around) const {
  const double D = eta[2], phi = eta[3], psi = eta[5];
  const Angles angles = find_angles(phi, eta[4], psi);
  const Three current = find_current(angles, around);
  const Six moved = level_ ? to_level(nu, phi) : nu;
  const auto& [u, v, w, p, q, r] = moved.at;
  const double u_r = u - current[0], v_r = v - current[1], w_r = w - current[2];
  const Wrenches wrenches = compute_wrenches(u_r, v_r, p, q, r, machines.rudder_angle, machines.propeller_speed);
  const Damping::Wrench damp = damping_(w_r, p, q);
  Six G{};
  if (level_) {
    G[3] = restoring_.compute_roll_moment(angles.s_phi, angles.c_phi);
  } else {
    G = restoring_(D, angles.s_phi, angles.c_phi, angles.s_theta, angles.c_theta);
  }
  const auto& [X, Y, Z, K, M, N] = wrenches.hull.at;
  const WindForces::Wrench wind = compute_wind(u, v, psi, around);
  Forces forces;
  forces.hull = {{X + G[0], Y + G[1], Z + G[2] + damp.Z, K + G[3] + damp.K, M + G[4] + damp.M, N + G[5]}};
  forces.propeller = wrenches.propeller;
  forces.rudder = wrenches.rudder;
  forces.wind = {{wind.X, wind.Y, 0.0, wind.K, 0.0, wind.N}};
  if (level_) {
    forces.hull = from_level(forces.hull, phi);
    forces.propeller = from_level(forces.propeller, phi);
    forces.rudder = from_level(forces.rudder, phi);
    forces.wind = from_level(forces.wind, phi);
  }
  return forces;
}

Integrated Mmg6Dof::pack(const Six& eta, const Six& nu) const {
  const Six moved = level_ ? to_level(nu, eta[3]) : nu;
  Integrated x;
  for (int k = 0; k < 6; ++k) {
    x[k] = eta[k];
    x[6 + k] = moved[k];
  }
  return x;
}

void Mmg6Dof::unpack(const Integrated& x, Six& eta, Six& nu) const {
  for (int k = 0; k < 6; ++k) {
    eta[k] = x[k];
    nu[k] = x[6 + k];
  }
  if (level_) nu = from_level(nu, eta[3]);
}

double Mmg6Dof::find_inflow(const Integrated& x, const Surroundings& around) const {
  const double u = x[6], v = x[7], p = x[9], q = x[10], r = x[11];
  const Three current = find_current(find_angles(x[3], x[4], x[5]), around);
  const double u_H = u - current[0] + z_H_ * q, v_H = v - current[1] - z_H_ * p;
  return propeller_.compute_inflow(u_H, hypot(u_H, v_H), atan2(-v_H, abs(u_H)), r);
}

Integrated Mmg6Dof::find_derivative(const Integrated& x, double delta, double n, const Surroundings& around) const {
  const double D = x[2], phi = x[3], psi = x[5];
  const double u = x[6], v = x[7], w = x[8], p = x[9], q = x[10], r = x[11];
  const Angles angles = find_angles(phi, x[4], psi);
  const auto& [s_phi, c_phi, s_theta, c_theta, s_psi, c_psi] = angles;
  const Three current = find_current(angles, around);
  const auto& [u_c, v_c, w_c] = current.at;
  const double u_r = u - u_c, v_r = v - v_c, w_r = w - w_c;

  // Forces.
  const Wrenches wrenches = compute_wrenches(u_r, v_r, p, q, r, delta, n);
  const Six &hull = wrenches.hull, &propeller = wrenches.propeller, &rudder = wrenches.rudder;
  const Damping::Wrench damp = damping_(w_r, p, q);
  const Six external = level_ ? to_level(around.external, phi) : around.external;
  Six force{{hull[0] + propeller[0] + rudder[0] + external[0], hull[1] + rudder[1] + external[1], damp.Z + external[2],
             hull[3] + rudder[3] + damp.K + external[3], hull[4] + propeller[4] + rudder[4] + damp.M + external[4],
             hull[5] + rudder[5] + external[5]}};
  if (around.wind_north != 0.0 || around.wind_east != 0.0) {
    const WindForces::Wrench wind = compute_wind(u, v, psi, around);
    force[0] += wind.X;
    force[1] += wind.Y;
    force[3] += wind.K;
    force[5] += wind.N;
  }
  add_inertia_forces(u_r, v_r, w_r, p, q, r, force);

  if (level_) {
    const double X = force[0], Y = force[1], N = force[5];
    const double K = force[3] + restoring_.compute_roll_moment(s_phi, c_phi);
    return {{u * c_psi - v * s_psi, u * s_psi + v * c_psi, 0.0, p, 0.0, r, even_[0][0] * X + r * v_c,
             multiply(odd_[0], Y, K, N) - r * u_c, 0.0, multiply(odd_[1], Y, K, N), 0.0, multiply(odd_[2], Y, K, N)}};
  }

  const Six G = restoring_(D, s_phi, c_phi, s_theta, c_theta);
  for (int k = 0; k < 6; ++k) force[k] += G[k];
  const auto& [X, Y, Z, K, M, N] = force.at;
  const double turning = (q * s_phi + r * c_phi) / c_theta;         // psi_dot
  const double ahead = u * c_theta + (v * s_phi + w * c_phi) * s_theta;  // in the vertical plane of the heading
  const double abeam = v * c_phi - w * s_phi;
  return {{
      ahead * c_psi - abeam * s_psi,
      ahead * s_psi + abeam * c_psi,
      (v * s_phi + w * c_phi) * c_theta - u * s_theta,
      p + turning * s_theta,
      q * c_phi - r * s_phi,
      turning,
      multiply(even_[0], X, Z, M) + r * v_c - q * w_c,
      multiply(odd_[0], Y, K, N) + p * w_c - r * u_c,
      multiply(even_[1], X, Z, M) + q * u_c - p * v_c,
      multiply(odd_[1], Y, K, N),
      multiply(even_[2], X, Z, M),
      multiply(odd_[2], Y, K, N),
  }};
}

// Adds - C(nu_r) nu_r, with the Munk moment in yaw put back.
void Mmg6Dof::add_inertia_forces(double u, double v, double w, double p, double q, double r, Six& force) const {
  const auto& [m_11, m_13, m_15, m_33, m_35, m_55] = M_even_;
  const auto& [m_22, m_24, m_26, m_44, m_46, m_66] = M_odd_;
  const double P_x = m_11 * u + m_13 * w + m_15 * q, P_y = m_22 * v + m_24 * p + m_26 * r;
  const double P_z = m_13 * u + m_33 * w + m_35 * q, L_x = m_24 * v + m_44 * p + m_46 * r;
  const double L_y = m_15 * u + m_35 * w + m_55 * q, L_z = m_26 * v + m_46 * p + m_66 * r;
  force[0] += r * P_y - q * P_z;
  force[1] += p * P_z - r * P_x;
  force[2] += q * P_x - p * P_y;
  force[3] += r * L_y - q * L_z + w * P_y - v * P_z;
  force[4] += p * L_z - r * L_x + u * P_z - w * P_x;
  force[5] += q * L_x - p * L_y + v * P_x - u * P_y + u * (munk_[0] * v + munk_[1] * p);
}

Mmg6Dof::Angles Mmg6Dof::find_angles(double phi, double theta, double psi) const {
  return {sin(phi), cos(phi), level_ ? 0.0 : sin(theta), level_ ? 1.0 : cos(theta), sin(psi), cos(psi)};
}

// Velocity of the water in b [m/s].
Three Mmg6Dof::find_current(const Angles& angles, const Surroundings& around) const {
  const double north = around.current_north, east = around.current_east;
  if (north == 0.0 && east == 0.0) return {{0.0, 0.0, 0.0}};
  const auto& [s_phi, c_phi, s_theta, c_theta, s_psi, c_psi] = angles;
  const double ahead = north * c_psi + east * s_psi, abeam = east * c_psi - north * s_psi;
  if (level_) return {{ahead, abeam, 0.0}};
  return {{ahead * c_theta, ahead * s_theta * s_phi + abeam * c_phi, ahead * s_theta * c_phi - abeam * s_phi}};
}

// Wrenches of hull, propeller and rudder, at velocities of CO relative to the water.
Mmg6Dof::Wrenches Mmg6Dof::compute_wrenches(double u, double v, double p, double q, double r, double delta,
                                            double n) const {
  const double u_H = u + z_H_ * q, v_H = v - z_H_ * p;
  const auto [X, Y, N] = hull_(u_H, v_H, r);
  Wrenches wrenches{};
  wrenches.hull = {{X, Y, 0.0, -z_H_ * Y, z_H_ * X, N}};
  if (!is_steered()) return wrenches;
  const double U = hypot(u_H, v_H), beta = atan2(-v_H, abs(u_H));
  const double u_P = propeller_.compute_inflow(u_H, U, beta, r);
  const double thrust = propeller_.compute_thrust(u_P, n);
  const double X_P = propeller_.remaining * thrust;
  const Planar rudder = rudder_(U, beta, r, u_P, thrust, delta);
  wrenches.propeller = {{X_P, 0.0, 0.0, 0.0, z_P_ * X_P, 0.0}};
  wrenches.rudder = {{rudder.X, rudder.Y, 0.0, -z_RY_ * rudder.Y, z_R_ * rudder.X, rudder.N}};
  return wrenches;
}

}  // namespace shipcollision
