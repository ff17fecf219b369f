#include "checks.hpp"

namespace shipcollision {
namespace {

bool check_bounds(const char* name, double value, double high, const char* remedy, Text& why) {
  if (0.0 <= value && value <= high) return true;
  why << name << " = " << value << " is outside 0 to ";
  why.short_number(high) << ": give " << remedy;
  return false;
}

bool check_positive(const char* name, double value, const char* usual, Text& why) {
  if (isfinite(value) && value > 0.0) return true;
  why << name << " = " << value << " must be a positive number: leave it out, or give e.g. " << usual;
  return false;
}

double sum(const Three& p) { return p[0] + p[1] + p[2]; }

bool refuse_not_finite(const char* name, const ShipState& state, double t, Text& why) {
  const struct {
    const char* quantity;
    const double* values;
    int count;
  } quantities[] = {{"position", state.position.at, 3},
                    {"attitude", state.attitude.at, 3},
                    {"velocity", state.velocity.at, 3},
                    {"rate", state.rate.at, 3},
                    {"impulse_applied", state.impulse_applied.at, 6}};
  for (const auto& [quantity, values, count] : quantities) {
    bool is_finite = true;
    for (int k = 0; k < count; ++k) is_finite = is_finite && isfinite(values[k]);
    if (is_finite) continue;
    why << name << "." << quantity << " = ";
    why.list(values, static_cast<size_t>(count)) << " at t = " << t
                                                 << " s is not finite: check the ship model's output";
    return false;
  }
  return true;  // their sum is too large alone
}

bool refuse_absurd(const char* name, const char* quantity, double value, const char* unit, double limit, double t,
                   Text& why) {
  why << name << "." << quantity << " is ";
  why.short_number(value) << " " << unit << " at t = " << t << " s, above ";
  why.short_number(limit) << " " << unit
                          << ": check the signal and its unit, and after an impact the mass of the ship model (kg)";
  return false;
}

// Without overflow for any finite numbers.
double length(const Three& p) { return hypot(hypot(p[0], p[1]), p[2]); }

bool check_state(const Body& body, const ShipState& state, double t, Text& why) {
  const Six& J = state.impulse_applied;
  const double all = sum(state.position) + sum(state.attitude) + sum(state.velocity) + sum(state.rate) +
                     (J[0] + J[1] + J[2] + J[3] + J[4] + J[5]);
  const char* name = body.name.get();
  if (!isfinite(all) && !refuse_not_finite(name, state, t, why)) return false;
  const double speed = length(state.velocity), tip = length(state.rate) * body.hull.reach;
  const double place = length(state.position);
  if (speed > ABSURD_SPEED) return refuse_absurd(name, "velocity", speed, "m/s", ABSURD_SPEED, t, why);
  if (tip > ABSURD_SPEED) return refuse_absurd(name, "rate", tip, "m/s at the ship's ends", ABSURD_SPEED, t, why);
  if (place > ABSURD_PLACE) return refuse_absurd(name, "position", place, "m from the origin", ABSURD_PLACE, t, why);
  return true;
}

}  // namespace

bool check_parameters(const CollisionParameters& p, Text& why) {
  const char* const responses[] = {"pgs", "closed_form", "bullet"};
  if (!check_bounds("friction", p.friction, MAXIMUM_FRICTION, "Coulomb's coefficient, 0.1 to 0.6 for steel", why) ||
      !check_bounds("restitution", p.restitution, 1.0,
                    "the share of the approach that comes back, 0 for ships that crush", why) ||
      !check_positive("substep", p.substep, "0.01 s", why) ||
      !check_positive("minimum_separation_time", p.minimum_separation_time, "10 s", why) ||
      !check_positive("clearance_range", p.clearance_range, "200 m", why)) {
    return false;
  }
  if (p.response == Response::pgs) return true;
  why << "response = ";
  why.quote(responses[static_cast<int>(p.response)])
      << " needs Python: take response 'pgs', or the FMU that runs Python";
  return false;
}

bool check_step(double t, double H, const Bodies& bodies, const CollisionInputs& inputs, Text& why) {
  if (isfinite(t) && isfinite(H) && H > 0.0) return check_states(t, bodies, inputs, why);
  why << "a step from t = " << t << " s by " << H << " s cannot be made: both must be finite and the step positive";
  return false;
}

bool check_states(double t, const Bodies& bodies, const CollisionInputs& inputs, Text& why) {
  for (int i = 0; i < bodies.ships(); ++i) {
    if (!check_state(bodies[i], inputs.ships[i], t, why)) return false;
  }
  return true;
}

bool check_pending(double t, const Body& body, const Six& nu, const Six& applied, Text& why) {
  const double speed = max(length(first_three(nu)), length(last_three(nu)) * body.hull.reach);
  if (speed <= ABSURD_SPEED) return true;
  const char* name = body.name.get();
  why << name << ".impulse_applied = ";
  why.list(applied.at, 6) << " at t = " << t << " s leaves an impulse pending that would move the ship at ";
  why.short_number(speed) << " m/s, above ";
  why.short_number(ABSURD_SPEED) << " m/s: return the part of " << name
                                 << ".impulse that the ship has applied, at first zero";
  return false;
}

}  // namespace shipcollision
