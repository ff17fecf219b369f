// Parameters, inputs and outputs of the ship model: the twin of shipcollision_fmu/manoeuvring/interface.py.
#pragma once

#include <stddef.h>

#include "../ship/coasting_law.hpp"

namespace shipcollision {

struct ShipParameters {
  char ship[LONGEST_STRING] = "kvlcc2";
  int degrees_of_freedom = 6;
  bool hydrodynamics = false;
  double initial_position[3] = {};
  double initial_attitude[3] = {};
  double initial_velocity[3] = {};
  double initial_rate[3] = {};
  double substep = 0.05;
  Coasting coasting = Coasting::kirchhoff;
};

struct ShipInputs {
  double rudder_order = 0.0;
  double propeller_order = 0.0;
  double current[2] = {};
  double wind_speed = 0.0;
  double wind_direction = 0.0;
  double impulse[6] = {};
  double force[6] = {};
};

struct ShipOutputs {
  double position[3] = {};
  double attitude[3] = {};
  double velocity[3] = {};
  double rate[3] = {};
  double rudder_angle = 0.0;
  double propeller_speed = 0.0;
  double impulse_applied[6] = {};
  double hull[6] = {};
  double propeller[6] = {};
  double rudder[6] = {};
  double wind[6] = {};
};

}  // namespace shipcollision
