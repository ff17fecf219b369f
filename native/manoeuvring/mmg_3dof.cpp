#include "mmg_3dof.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

Six make_wrench(double X, double Y, double N) { return {{X, Y, 0.0, 0.0, 0.0, N}}; }

}  // namespace

bool Mmg3Dof::set_up(const PreparedShip& ship, Text& why) {
  if (!set_up_base(ship, why)) return false;
  surge_ = 3;
  count_ = 6;
  m_u_ = ship.M[0][0];
  m_v_ = ship.M[1][1];
  m_vr_ = ship.M[1][5];
  m_r_ = ship.M[5][5];
  determinant_ = m_v_ * m_r_ - m_vr_ * m_vr_;
  return true;
}

Forces Mmg3Dof::compute_forces(const Six& eta, const Six& nu, const Machines& machines,
                               const Surroundings& around) const {
  const double psi = eta[5], u = nu[0], v = nu[1], r = nu[5];
  const WindForces::Wrench wind = compute_wind(u, v, psi, around);
  const double c = cos(psi), s = sin(psi);
  const double north = around.current_north, east = around.current_east;
  const double u_r = u - (north * c + east * s), v_r = v - (east * c - north * s);
  const Planar hull = hull_(u_r, v_r, r);
  Forces forces;
  forces.hull = make_wrench(hull.X, hull.Y, hull.N);
  forces.wind = make_wrench(wind.X, wind.Y, wind.N);
  if (is_steered()) {
    const double U = hypot(u_r, v_r), beta = atan2(-v_r, abs(u_r));
    const double u_P = propeller_.compute_inflow(u_r, U, beta, r);
    const double thrust = propeller_.compute_thrust(u_P, machines.propeller_speed);
    const Planar rudder = rudder_(U, beta, r, u_P, thrust, machines.rudder_angle);
    forces.propeller = make_wrench(propeller_.remaining * thrust, 0.0, 0.0);
    forces.rudder = make_wrench(rudder.X, rudder.Y, rudder.N);
  }
  return forces;
}

Integrated Mmg3Dof::pack(const Six& eta, const Six& nu) const {
  return {{eta[0], eta[1], eta[5], nu[0], nu[1], nu[5]}};
}

void Mmg3Dof::unpack(const Integrated& x, Six& eta, Six& nu) const {
  eta[0] = x[0];
  eta[1] = x[1];
  eta[5] = x[2];
  nu[0] = x[3];
  nu[1] = x[4];
  nu[5] = x[5];
}

double Mmg3Dof::find_inflow(const Integrated& x, const Surroundings& around) const {
  const double psi = x[2], r = x[5], north = around.current_north, east = around.current_east;
  double u = x[3], v = x[4];
  if (north != 0.0 || east != 0.0) {
    const double c = cos(psi), s = sin(psi);
    u = u - (north * c + east * s);
    v = v - (east * c - north * s);
  }
  return propeller_.compute_inflow(u, hypot(u, v), atan2(-v, abs(u)), r);
}

Integrated Mmg3Dof::find_derivative(const Integrated& x, double delta, double n, const Surroundings& around) const {
  const double psi = x[2], u = x[3], v = x[4], r = x[5];
  const double c = cos(psi), s = sin(psi), north = around.current_north, east = around.current_east;
  double u_r = u, v_r = v, u_c = 0.0, v_c = 0.0;
  if (north != 0.0 || east != 0.0) {
    u_c = north * c + east * s;
    v_c = east * c - north * s;
    u_r = u - u_c;
    v_r = v - v_c;
  }

  auto [X, Y, N] = hull_(u_r, v_r, r);
  if (is_steered()) {
    const double U = hypot(u_r, v_r), beta = atan2(-v_r, abs(u_r));
    const double u_P = propeller_.compute_inflow(u_r, U, beta, r);
    const double thrust = propeller_.compute_thrust(u_P, n);
    const Planar rudder = rudder_(U, beta, r, u_P, thrust, delta);
    X = X + propeller_.remaining * thrust + rudder.X;
    Y = Y + rudder.Y;
    N = N + rudder.N;
  }
  X = X + around.external[0];
  Y = Y + around.external[1];
  N = N + around.external[5];
  if (around.wind_north != 0.0 || around.wind_east != 0.0) {
    const WindForces::Wrench wind = compute_wind(u, v, psi, around);
    X = X + wind.X;
    Y = Y + wind.Y;
    N = N + wind.N;
  }

  X += m_v_ * v_r * r + m_vr_ * r * r;
  Y -= m_u_ * u_r * r;
  N -= m_vr_ * u_r * r;
  const double u_dot = X / m_u_;
  const double v_dot = (m_r_ * Y - m_vr_ * N) / determinant_;
  const double r_dot = (m_v_ * N - m_vr_ * Y) / determinant_;
  return {{u * c - v * s, u * s + v * c, r, u_dot + r * v_c, v_dot - r * u_c, r_dot}};
}

}  // namespace shipcollision
