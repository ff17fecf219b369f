#include "totals.hpp"

namespace shipcollision {

void Totals::add(double residual, int sweeps, double taken_off) {
  residual_ = max(residual_, residual);
  sweeps_ = sweeps > sweeps_ ? sweeps : sweeps_;
  if (residual > CONVERGED) {
    ++unconverged_in_step_;
    ++since_start_.unconverged;
  }
  if (taken_off > NOTICEABLE) ++since_start_.scaled;
}

void Totals::add_energy(double along, double across) {
  since_start_.energy += along + across;
  since_start_.normal += along;
  since_start_.tangential += across;
}

void Totals::describe_unconverged(double t, double H, Text& said) const {
  if (unconverged_in_step_ == 0 || since_start_.unconverged > unconverged_in_step_) return;
  said << "contact was not solved to ";
  said.short_number(CONVERGED) << " of the approach " << unconverged_in_step_ << " times in the step from t = ";
  said.short_number(t) << " s by ";
  said.short_number(H) << " s, at worst to ";
  said.short_number(residual_, 2) << ": its impulses are less exact (solver.residual); later ones are counted in "
                                     "solver.unconverged";
}

void Totals::fill(CollisionOutputs& out) {
  out.energy = {since_start_.energy, since_start_.normal, since_start_.tangential};
  out.solver = {residual_, sweeps_, since_start_.unconverged, since_start_.scaled};
  residual_ = 0.0;
  sweeps_ = unconverged_in_step_ = 0;
}

void Totals::get_state(ByteWriter& bytes) const { bytes.value(since_start_); }

bool Totals::set_state(ByteReader& bytes) {
  residual_ = 0.0;
  sweeps_ = unconverged_in_step_ = 0;
  return bytes.value(since_start_);
}

}  // namespace shipcollision
