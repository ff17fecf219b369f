// Friction of ships whose heave and pitch are held: the twin of shipcollision_fmu/collision/solvers/held_motions.py.
#pragma once

#include "gauss_seidel.hpp"

namespace shipcollision {

// W + H_tt [1/kg], the slip H_tn P_n [m/s], and impulses [N s] to start from, if there are any.
struct HeldFriction {
  explicit HeldFriction(Memory& memory) : W(memory), slip(memory), start(memory), met(memory), found(memory) {}

  bool reserve(int contacts);

  Dense W;
  Vector slip, start;
  bool has_start = false;
  Vector met, found;  // what the rounds work on
};

// The operator and the slip that friction meets: `friction`, which comes with a start or without.
void yield_to_friction(const Dense& W, const double* v, double mu, const Dense& H, GaussSeidel& gauss_seidel,
                       WorkLimit& work, HeldFriction& friction);

}  // namespace shipcollision
