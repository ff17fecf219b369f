// Block projected Gauss-Seidel: the twin of shipcollision_fmu/collision/solvers/gauss_seidel.py.
#pragma once

#include "aclm_fixed_point.hpp"
#include "aitken.hpp"
#include "alart_curnier.hpp"
#include "one_contact.hpp"

namespace shipcollision {

constexpr double SWEEP_TOLERANCE = 1e-11;

// The residual of the law of contact as a share of the largest approach speed, and the sweeps taken.
struct Solution {
  double residual;
  int sweeps;
};

// The turn of the tangents of a contact to the principal axes of its W_tt.
struct Turn {
  double c, s;
};

Turn find_principal_axes(const Dense& W, int contact);
// W, or numbers of each contact, in turned tangents; and back.
void turn_tangents(const Turn* turns, Dense& W);
void turn_tangents(const Turn* turns, int contacts, double* numbers);
void turn_tangents_back(const Turn* turns, int contacts, double* numbers);
// Sets to zero the rows and columns of tangents along which no ship moves.
void clear_rounding(Dense& W, double* v);

class GaussSeidel {
 public:
  explicit GaussSeidel(Memory& memory);

  // Room for so many contacts; false without memory.
  bool reserve(int contacts);

  // Impulses P (3k) [N s] of a plastic impact. start (3k): of which only the direction counts, or null. scale [m/s]:
  // approach that tolerance and residual are shares of.
  Solution solve(const Dense& W, const double* v, double mu, const double* start, double scale, WorkLimit& work,
                 double* P);

 private:
  void scale_start(const Dense& W, const double* v, const double* start, double* P);
  int sweep(double mu, double scale, WorkLimit& work, double* P);
  double sweep_once(double mu, double* P);
  void solve_together(double mu, double* P, double tolerance, WorkLimit& work);

  int contacts_ = 0;
  Dense W_;  // in principal tangents, as v_
  Vector v_, last_, candidate_, fixed_point_;
  Buffer<Turn> turns_;
  Buffer<ContactBlock> blocks_;
  Buffer<Angle> angles_;
  Aitken aitken_;
  AlartCurnier alart_curnier_;
  AclmFixedPoint aclm_;
};

}  // namespace shipcollision
