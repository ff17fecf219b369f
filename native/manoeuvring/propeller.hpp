// The propeller: the twin of shipcollision_fmu/manoeuvring/propeller.py. The series is tabulated in the prepared ship.
#pragma once

#include "../ship/prepared_ship.hpp"

namespace shipcollision {

class Propeller {
 public:
  double D_P, remaining, unit;

  Propeller() = default;
  // Keeps the ship's series: the ship must last as long.
  explicit Propeller(const PreparedShip& ship);

  double compute_inflow(double u, double U, double beta, double r) const;
  double compute_thrust(double u_P, double n) const;

 private:
  double find_measured(double u_P, double nD) const;

  double x_P_, through_, C_1_, plus_, minus_, k_0_, k_1_, k_2_, astern_;
  const double* series_;
};

}  // namespace shipcollision
