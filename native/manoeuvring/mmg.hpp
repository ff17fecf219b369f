// The base of the MMG model: the twin of shipcollision_fmu/manoeuvring/mmg.py.
#pragma once

#include "../numbers/text.hpp"
#include "../ship/degrees_of_freedom.hpp"
#include "../ship/prepared_ship.hpp"
#include "actuators.hpp"
#include "hull_forces.hpp"
#include "propeller.hpp"
#include "rudder.hpp"
#include "torque_limit.hpp"
#include "wind.hpp"

namespace shipcollision {

// Values held over a step: velocities of water and air, towards north and east [m/s]; external force and moment about CO
// in b [N, N m].
struct Surroundings {
  double current_north = 0.0, current_east = 0.0, wind_north = 0.0, wind_east = 0.0;
  Six external{};
};

struct Orders {
  double rudder_angle, propeller_speed;
};

struct Machines {
  double rudder_angle = 0.0, propeller_speed = 0.0;
  Gear gear;
};

// Wrenches about CO in b by origin [N, N m].
struct Forces {
  Six hull{}, propeller{}, rudder{}, wind{};
};

// The integrated quantities, of which 3 degrees of freedom use six.
struct Integrated {
  double at[12];

  double operator[](int k) const { return at[k]; }
  double& operator[](int k) { return at[k]; }
};

// One ship's equations of motion: what is common to 3, 4 and 6 degrees of freedom. The ship must last as long.
class Mmg {
 public:
  Actuator steering;
  Engine engine;
  bool propelled = false;
  double shortest_time = __builtin_inf();  // 1/w of the fastest free oscillation [s]

  Mmg() = default;
  Mmg(const Mmg&) = delete;
  Mmg& operator=(const Mmg&) = delete;

  virtual Forces compute_forces(const Six& eta, const Six& nu, const Machines& machines,
                                const Surroundings& around) const = 0;
  double limit_revolutions(const Six& eta, const Six& nu, double n, const Surroundings& around) const;
  // eta, nu and the machines after h [s] in equal substeps. A motion that diverges ends in numbers that are not finite.
  void advance(Six& eta, Six& nu, Machines& machines, const Orders& orders, const Surroundings& around, double h,
               int substeps) const;

 protected:
  ~Mmg() = default;

  // False for a ship that can only coast.
  bool set_up_base(const PreparedShip& ship, Text& why);
  bool is_steered() const { return propelled && has_rudder_; }
  WindForces::Wrench compute_wind(double u, double v, double psi, const Surroundings& around) const;

  virtual Integrated pack(const Six& eta, const Six& nu) const = 0;
  virtual void unpack(const Integrated& x, Six& eta, Six& nu) const = 0;
  virtual Integrated find_derivative(const Integrated& x, double delta, double n, const Surroundings& around) const = 0;
  virtual double find_inflow(const Integrated& x, const Surroundings& around) const = 0;

  int surge_ = 0;  // place of u among the integrated quantities
  int count_ = 0;  // of these
  HullForces hull_;
  Propeller propeller_;
  Rudder rudder_;

 private:
  Integrated add_scaled(const Integrated& x, const Integrated& k, double dt) const;

  bool has_rudder_ = false, has_torque_limit_ = false;
  WindForces wind_;
  TorqueLimit torque_limit_;
};

}  // namespace shipcollision
