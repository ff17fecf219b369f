#include "other_forces.hpp"

#include "chord.hpp"

namespace shipcollision {
namespace {

constexpr double ROUNDING = 1e-9;

// Mean velocity of CO and mean angular velocity over a step, and both at its end, in b at the start.
struct Coasted {
  Three mean, omega_mean, end, omega_end;
};

Three divide(const Three& p, double H) { return {{p[0] / H, p[1] / H, p[2] / H}}; }

// exp(skew(w)) v: v turned by |w| [rad] about w.
Three turn_about(const Three& w, const Three& v) {
  const double angle = norm(w);
  const double a = angle < 1e-8 ? 1.0 : sin(angle) / angle;
  const double half = angle < 1e-8 ? 0.0 : sin(0.5 * angle) / angle;
  const double b = angle < 1e-8 ? 0.5 : 2.0 * (half * half);
  const Three once = cross(w, v);
  return v + a * once + b * cross(w, once);
}

Coasted coast_straight(const Six& start, const Three& r_bg, double H) {
  const Three omega = last_three(start), v_g = first_three(start) + cross(omega, r_bg), turn = H * omega;
  return {v_g + divide(r_bg - turn_about(turn, r_bg), H), omega, v_g - turn_about(turn, cross(omega, r_bg)), omega};
}

bool coast_by_law(const CoastingLaw& law, const ReceivedState& before, const Six& start, const Rows& R, double H,
                  Coasted& coasted, Text& why) {
  Motion end;
  if (!law.coast({before.position, before.attitude, first_three(start), last_three(start)}, H, end, why)) return false;
  const Rows turn = turn_back(R, rotation_rows(end.attitude[0], end.attitude[1], end.attitude[2]));
  coasted = {divide(rotate_back(R, end.position - before.position), H), divide(rotation_vector_of(turn), H),
             rotate(turn, end.velocity), rotate(turn, end.rate)};
  return true;
}

double largest_speed(const Six& nu, double reach) { return norm(first_three(nu)) + reach * norm(last_three(nu)); }

// Whether the step from t by H [s] ends at `end`.
bool is_next(double t, double H, double end) {
  const double sum = t + H;
  return abs(sum - end) <= max(1e-9 * max(abs(sum), abs(end)), 1e-6 * H);
}

}  // namespace

bool estimate_other_forces(const ReceivedState& before, const ReceivedState& now, const Matrix& M_inverse,
                           const Three& r_bg, double reach, const CoastingLaw* coasting, OtherForces& forces,
                           bool& found, Text& why) {
  const double H = before.H;
  found = false;
  if (!is_next(before.t, H, now.t)) return true;  // the host went elsewhere in time
  const Six start = before.nu + multiply(M_inverse, now.applied - before.applied);
  const Rows R = rotation_rows(before.attitude[0], before.attitude[1], before.attitude[2]);
  const Rows turn = turn_back(R, rotation_rows(now.attitude[0], now.attitude[1], now.attitude[2]));
  const Three way = rotate_back(R, now.position - before.position);
  Coasted coasted;
  if (coasting == nullptr) {
    coasted = coast_straight(start, r_bg, H);
  } else if (!coast_by_law(*coasting, before, start, R, H, coasted, why)) {
    return false;
  }
  forces.velocity_bias =
      join(divide(way, H) - coasted.mean, divide(rotation_vector_of(turn), H) - coasted.omega_mean);
  forces.velocity_gain = join(rotate(turn, first_three(now.nu)) - coasted.end,
                              rotate(turn, last_three(now.nu)) - coasted.omega_end);
  const double gain_speed = largest_speed(forces.velocity_gain, reach);
  const double speed = max(largest_speed(forces.velocity_bias, reach), gain_speed);
  if (!(ROUNDING < speed && speed <= MAX_ACCELERATION * H)) return true;
  found = true;
  forces.scheme_error = forces.velocity_bias - 0.5 * forces.velocity_gain;
  forces.has_scheme_error = largest_speed(forces.scheme_error, reach) > EXACT * gain_speed;
  return true;
}

}  // namespace shipcollision
