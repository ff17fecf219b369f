// Revolutions of an engine of limited torque: the twin of shipcollision_fmu/manoeuvring/torque_limit.py. The limits are
// tabulated in the prepared ship.
#pragma once

#include "../numbers/elementary.hpp"
#include "../ship/prepared_ship.hpp"

namespace shipcollision {

struct Range {
  double least, most;

  double limit(double n) const { return min(most, max(least, n)); }
};

class TorqueLimit {
 public:
  TorqueLimit() = default;
  // Keeps the table: the ship must last as long.
  TorqueLimit(const TorqueTable& table, double D_P) : n_(table.root / D_P), table_(&table) {}

  // Whether n > 0 [1/s] is within the limit at the surge velocity u [m/s], at a glance.
  bool is_surely_free(double u, double n) const;
  // Least revolutions (astern) and most (ahead) in the inflow u_P [m/s].
  Range find_range(double u_P) const;

 private:
  double n_;
  const TorqueTable* table_;
};

}  // namespace shipcollision
