// How two bodies answer contact: the twin of shipcollision_fmu/collision/responses.py.
//
// Only the response pgs; closed_form and bullet stay with Python.
#pragma once

#include "contact_problem.hpp"
#include "dynamics/delassus.hpp"
#include "solvers/held_motions.hpp"
#include "solvers/poisson_restitution.hpp"

namespace shipcollision {

class PgsResponse {
 public:
  explicit PgsResponse(Memory& memory);

  // All contacts of all pairs solved together. Without memory there are no impulses.
  void respond(const ContactProblem& problem, ContactCaches& caches, ContactSolution& solution);
  // The same of contacts that are given.
  void solve(const Contact* contacts, int count, const ContactProblem& problem, ContactCaches& caches,
             ContactSolution& solution);

 private:
  bool reserve(int contacts);

  Buffer<Contact> contacts_;
  Vector velocity_, P_;
  Delassus delassus_;
  HeldFriction held_;
  GaussSeidel gauss_seidel_;
  PoissonImpact poisson_;
};

}  // namespace shipcollision
