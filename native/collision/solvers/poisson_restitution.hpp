// Poisson's restitution of a whole patch: the twin of shipcollision_fmu/collision/solvers/poisson_restitution.py.
#pragma once

#include "gauss_seidel.hpp"

namespace shipcollision {

constexpr double LEAST_REBOUNDING_APPROACH = 1e-3;

class PoissonImpact {
 public:
  // gauss_seidel: of the same model, with room for as many contacts.
  PoissonImpact(Memory& memory, GaussSeidel& gauss_seidel);

  // Room for so many contacts; false without memory.
  bool reserve(int contacts);

  // Impulses P (3k) [N s] with restitution e. slip (3k): what compression adds to the slip by motions that are held, or
  // null.
  Solution solve(const Dense& W, const double* v, double mu, double e, const double* start, const double* slip,
                 WorkLimit& work, double* P);

 private:
  void add_restitution(const Dense& W, double mu, double e, WorkLimit& work);
  double sweep_once(double mu);

  int contacts_ = 0;
  GaussSeidel& gauss_seidel_;
  Dense W_;  // in principal tangents, as v_
  Vector met_, v_, after_, compression_, whole_, impulses_, last_;
  Buffer<Turn> turns_;
  Buffer<ContactBlock> blocks_;
  Aitken aitken_;
};

}  // namespace shipcollision
