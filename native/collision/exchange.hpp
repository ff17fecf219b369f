// The exchange with the ship models: the twin of shipcollision_fmu/collision/exchange.py.
#pragma once

#include "bodies.hpp"
#include "dynamics/impulse_ledger.hpp"
#include "dynamics/other_forces.hpp"

namespace shipcollision {

// Ledgers and last received states of the ships. What the twin does not receive is ABSENT; here `is_present` is false,
// and its state is of any value.
class ShipExchange {
 public:
  // bodies, inputs, outputs: of the model, which outlive it.
  ShipExchange(const Bodies& bodies, const CollisionInputs& inputs, CollisionOutputs& outputs, Memory& memory);

  const ImpulseLedger* ledgers() const { return ledgers_.data(); }
  const bool* is_present() const { return is_present_.data(); }

  // States of the ships that are not quiet, at the start t of a step of H [s]. False where the law of a ship refuses
  // its motion, here and below, and where an impulse pending is absurd.
  bool receive_active(double t, double H, BodyState* states, Text& why);
  // States of the quiet ships that are included as well. The other ships coast.
  bool receive_others(double t, double H, const bool* is_included, BodyState* states, Text& why);

  // By ship, what a pending impulse takes that a parallel master applies now [m/s]; 0 without one.
  bool has_delayed_speeds() const { return has_delayed_speeds_; }
  double delayed_speed(int i) const { return i < delayed_speeds_.size() ? delayed_speeds_[i] : 0.0; }

  // Twists of the ships at the end of the step, which publish() takes.
  bool find_ends(double H, const BodyState* states, Text& why);
  // Closes the ledgers of the step that began at t [s], and fills the outputs. is_colliding: of each body, whether it is
  // in an open collision.
  void publish(double t, double H, const BodyState* states, const bool* is_colliding);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  bool receive(int i, double t, double H, BodyState& state, Text& why);
  bool expect_other_forces(int i, double t, const Reading& reading, BodyState& state, Six& nu, Text& why);
  bool coast_absent(int i, double H, Text& why);

  const Bodies& bodies_;
  const CollisionInputs& inputs_;
  CollisionOutputs& outputs_;
  Buffer<ImpulseLedger> ledgers_;
  Buffer<ReceivedState> last_received_;  // of ships in an open collision
  Buffer<bool> has_last_received_;
  Buffer<bool> is_present_;
  Buffer<Reading> readings_;
  Buffer<double> delayed_speeds_;
  Buffer<Motion> ends_;
  bool has_delayed_speeds_ = false;
  bool has_delay_ = false;
};

}  // namespace shipcollision
