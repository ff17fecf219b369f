#include "exchange.hpp"

#include "checks.hpp"

namespace shipcollision {
namespace {

bool is_upright_ahead(const ShipState& ship) {
  return is_same(ship.rate, Three{}) && ship.attitude[0] == 0.0 && ship.attitude[1] == 0.0 && ship.velocity[1] == 0.0 &&
         ship.velocity[2] == 0.0 && ship.position[2] == 0.0;
}

Motion motion_of(const ShipState& ship) { return {ship.position, ship.attitude, ship.velocity, ship.rate}; }

// Lets the state follow the law of its ship through the step, from the twist `start`.
bool follow_law(const Body& body, BodyState& state, const ShipState& received, const Six& start, double H, Text& why) {
  const Motion before{received.position, received.attitude, first_three(start), last_three(start)};
  if (body.coasting.is_straight(before)) return true;
  Motion end;
  if (!body.coast(before, H, end, why)) return false;
  state.follow(end, start, H);
  return true;
}

ReceivedState as_received(double t, double H, const ShipState& ship) {
  return {t, H, ship.position, ship.attitude, ship.nu(), ship.impulse_applied};
}

// The same attitude with psi within half a turn of `psi_near` [rad].
Three unwrap_attitude(const Three& attitude, double psi_near) {
  return {{attitude[0], attitude[1], attitude[2] + 2.0 * PI * round((psi_near - attitude[2]) / (2.0 * PI))}};
}

}  // namespace

ShipExchange::ShipExchange(const Bodies& bodies, const CollisionInputs& inputs, CollisionOutputs& outputs,
                           Memory& memory)
    : bodies_(bodies), inputs_(inputs), outputs_(outputs), ledgers_(memory), last_received_(memory),
      has_last_received_(memory), is_present_(memory), readings_(memory), delayed_speeds_(memory), ends_(memory) {
  const int ships = bodies.ships();
  ledgers_.fill(ships, ImpulseLedger());
  last_received_.fill(ships, {});
  has_last_received_.fill(ships, false);
  is_present_.fill(ships, false);
  readings_.fill(ships, {});
  delayed_speeds_.fill(ships, 0.0);
  ends_.fill(ships, {});
}

bool ShipExchange::receive_active(double t, double H, BodyState* states, Text& why) {
  has_delay_ = false;
  if (has_delayed_speeds_) delayed_speeds_.fill(delayed_speeds_.size(), 0.0);
  has_delayed_speeds_ = false;
  for (const ImpulseLedger& ledger : ledgers_) has_delay_ = has_delay_ || ledger.delay() == Delay::one_step;
  for (int i = 0; i < ledgers_.size(); ++i) {
    is_present_[i] = has_last_received_[i] ||
                     !ledgers_[i].is_quiet(bodies_[i].feedback, inputs_.ships[i].impulse_applied);
    if (is_present_[i] && !receive(i, t, H, states[i], why)) return false;
  }
  return true;
}

bool ShipExchange::receive_others(double t, double H, const bool* is_included, BodyState* states, Text& why) {
  for (int i = 0; i < ledgers_.size(); ++i) {
    if (is_present_[i]) continue;
    is_present_[i] = is_included[i];
    if (!(is_present_[i] ? receive(i, t, H, states[i], why) : coast_absent(i, H, why))) return false;
  }
  return true;
}

// The end of the step of a ship that coasts.
bool ShipExchange::coast_absent(int i, double H, Text& why) {
  const Body& body = bodies_[i];
  const Motion before = motion_of(inputs_.ships[i]);
  if (!body.has_coasting || (body.coasting.keeps_course() && is_upright_ahead(inputs_.ships[i]))) {
    ends_[i] = coast(before, body.r_bg, H);
    return true;
  }
  return body.coast(before, H, ends_[i], why);
}

// State of a ship, corrected by what is pending and by other forces.
bool ShipExchange::receive(int i, double t, double H, BodyState& state, Text& why) {
  const ShipState& received = inputs_.ships[i];
  const Body& body = bodies_[i];
  Matrix M_inverse;
  body.inverse_at(received.attitude, M_inverse);
  const Six as_given = received.nu();
  state.start_at(received.position, received.attitude, as_given, M_inverse, body.r_bg,
                 body.has_held ? &body.held : nullptr);
  Reading& reading = readings_[i];
  reading = ledgers_[i].read(body.feedback, state.applied, as_given, received.impulse_applied, M_inverse,
                             body.hull.reach, H);
  if (body.feedback == Feedback::ledger && !is_zero(reading.pending) &&
      !check_pending(t, body, reading.nu, received.impulse_applied, why)) {
    return false;
  }
  if (reading.delay == Delay::one_step && !is_zero(reading.pending)) {
    delayed_speeds_[i] = norm(first_three(reading.nu - as_given));
    has_delayed_speeds_ = true;
  }
  Six nu = reading.has_deficit ? reading.nu + multiply(M_inverse, reading.deficit) : reading.nu;
  const bool has_forces = has_last_received_[i] && body.feedback == Feedback::ledger;
  if (has_forces && !expect_other_forces(i, t, reading, state, nu, why)) return false;
  state.set_twist(nu);
  if (body.has_coasting && H > 0.0 && !follow_law(body, state, received, reading.nu, H, why)) return false;
  if (reading.delay == Delay::unknown ? has_delay_ : reading.delay == Delay::one_step) {
    const Pose then = state.pose_after(reading.nu, H);
    Matrix inverse_then;
    body.inverse_at(attitude_from_rotation(then.R), inverse_then);
    state.apply_at(then, inverse_then);
  }
  state.nu_received = state.nu;
  return true;
}

bool ShipExchange::expect_other_forces(int i, double t, const Reading& reading, BodyState& state, Six& nu, Text& why) {
  const Body& body = bodies_[i];
  const ReceivedState& before = last_received_[i];
  Matrix inverse_before;
  body.inverse_at(before.attitude, inverse_before);
  OtherForces forces;
  bool found;
  if (!estimate_other_forces(before, as_received(t, 0.0, inputs_.ships[i]), inverse_before, body.r_bg, body.hull.reach,
                             body.has_coasting ? &body.coasting : nullptr, forces, found, why)) {
    return body.refuse_by_name(why);
  }
  if (!found) return true;
  state.expect(forces.velocity_bias, forces.has_scheme_error ? &forces.scheme_error : nullptr);
  // With a one-step delay the impulse meets a ship that has gained velocity.
  if (!is_zero(reading.pending)) nu = nu + forces.velocity_gain;
  return true;
}

// For a ship that adopts its twist after an impulse the law is asked again: it then has the energy that the impulse
// left it.
bool ShipExchange::find_ends(double H, const BodyState* states, Text& why) {
  for (int i = 0; i < ledgers_.size(); ++i) {
    if (!is_present_[i]) continue;
    const BodyState& state = states[i];
    const Body& body = bodies_[i];
    const ShipState& received = inputs_.ships[i];
    Motion& end = ends_[i];
    if (body.has_coasting && body.feedback == Feedback::state && state.has_end_gain && state.is_issued) {
      if (!body.coast({received.position, received.attitude, first_three(state.nu), last_three(state.nu)}, H, end,
                      why)) {
        return false;
      }
    } else {
      const Six nu = state.twist_at_predicted_pose();
      end.velocity = first_three(nu);
      end.rate = last_three(nu);
    }
    end.position = state.predicted.x;
    end.attitude = is_same(state.predicted.R, readings_[i].pose.R)  // it did not turn
                       ? received.attitude
                       : unwrap_attitude(attitude_from_rotation(state.predicted.R), received.attitude[2]);
  }
  return true;
}

void ShipExchange::publish(double t, double H, const BodyState* states, const bool* is_colliding) {
  for (int i = 0; i < ledgers_.size(); ++i) {
    ShipPost& out = outputs_.ships[i];
    const Motion& end = ends_[i];
    out.position = end.position;
    out.attitude = end.attitude;
    out.velocity = end.velocity;
    out.rate = end.rate;
    out.force = {};
    if (!is_present_[i]) continue;
    const BodyState& state = states[i];
    ledgers_[i].close(readings_[i], state.issued, state.nu_received, state.applied);
    out.impulse = ledgers_[i].issued();
    if (state.is_issued) {
      for (int k = 0; k < 6; ++k) out.force[k] = state.issued[k] / H;
    }
    has_last_received_[i] = is_colliding[i];
    if (is_colliding[i]) last_received_[i] = as_received(t, H, inputs_.ships[i]);
  }
}

void ShipExchange::get_state(ByteWriter& bytes) const {
  for (int i = 0; i < ledgers_.size(); ++i) {
    ledgers_[i].get_state(bytes);
    bytes.value(has_last_received_[i]);
    if (has_last_received_[i]) bytes.value(last_received_[i]);
  }
}

bool ShipExchange::set_state(ByteReader& bytes) {
  for (int i = 0; i < ledgers_.size(); ++i) {
    if (!ledgers_[i].set_state(bytes) || !bytes.value(has_last_received_[i]) ||
        (has_last_received_[i] && !bytes.value(last_received_[i]))) {
      return false;
    }
  }
  return true;
}

}  // namespace shipcollision
