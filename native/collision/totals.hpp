// Running totals of a run: the twin of shipcollision_fmu/collision/totals.py.
#pragma once

#include "../numbers/bytes.hpp"
#include "interface.hpp"

namespace shipcollision {

constexpr double CONVERGED = 1e-9;
constexpr double NOTICEABLE = 1e-4;

// Energies [J] and counts since the start; residual (worst) and sweeps (most) of the current step.
class Totals {
 public:
  // Counts a solved substep. taken_off: velocity [m/s], by passivity.
  void add(double residual, int sweeps, double taken_off);
  // Energy lost at a contact of it [J], along and across the normal.
  void add_energy(double along, double across);

  // The warning of the step from t by H [s] if contact was not solved exactly in it for the first time, or nothing.
  void describe_unconverged(double t, double H, Text& said) const;
  // Writes the totals to the outputs, and begins to count the next step.
  void fill(CollisionOutputs& out);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  struct {
    double energy, normal, tangential;
    int unconverged, scaled;
  } since_start_ = {};
  double residual_ = 0.0;
  int sweeps_ = 0;
  int unconverged_in_step_ = 0;
};

}  // namespace shipcollision
