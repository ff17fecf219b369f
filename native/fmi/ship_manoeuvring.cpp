#include "ship_manoeuvring.hpp"

#include <string.h>

#include "paths.hpp"
#include "variables.hpp"

namespace shipcollision {

namespace {

// In the order of the enumeration Coasting.
const char* const COASTING[] = {"kirchhoff", "free", "straight"};

const Path PARAMETERS[] = {
    {"ship", Kind::string, offsetof(ShipParameters, ship), 0, nullptr, 0},
    {"degrees_of_freedom", Kind::integer, offsetof(ShipParameters, degrees_of_freedom), 0, nullptr, 0},
    {"hydrodynamics", Kind::boolean, offsetof(ShipParameters, hydrodynamics), 0, nullptr, 0},
    REALS(ShipParameters, initial_position),
    REALS(ShipParameters, initial_attitude),
    REALS(ShipParameters, initial_velocity),
    REALS(ShipParameters, initial_rate),
    REAL(ShipParameters, substep),
    {"coasting", Kind::enumeration, offsetof(ShipParameters, coasting), 0, COASTING, 3},
};

const Path INPUTS[] = {
    REAL(ShipInputs, rudder_order),   REAL(ShipInputs, propeller_order), REALS(ShipInputs, current),
    REAL(ShipInputs, wind_speed),     REAL(ShipInputs, wind_direction),  REALS(ShipInputs, impulse),
    REALS(ShipInputs, force),
};

const Path OUTPUTS[] = {
    REALS(ShipOutputs, position),        REALS(ShipOutputs, attitude),
    REALS(ShipOutputs, velocity),        REALS(ShipOutputs, rate),
    REAL(ShipOutputs, rudder_angle),     REAL(ShipOutputs, propeller_speed),
    REALS(ShipOutputs, impulse_applied), REALS(ShipOutputs, hull),
    REALS(ShipOutputs, propeller),       REALS(ShipOutputs, rudder),
    REALS(ShipOutputs, wind),
};

}  // namespace

ShipManoeuvringFmu::ShipManoeuvringFmu(const char* resources) {
  const size_t size = strnlen(resources, LONGEST_STRING - 1);
  memcpy(ship_.directory, resources, size);
  ship_.directory[size] = '\0';
}

bool ShipManoeuvringFmu::find(const char* path, int index, Place& place) {
  return find_in(PARAMETERS, "parameters.", &ship_.parameters, path, index, place) ||
         find_in(INPUTS, "inputs.", &ship_.inputs, path, index, place) ||
         find_in(OUTPUTS, "outputs.", &ship_.outputs, path, index, place);
}

Model* make_model(const Variables& variables, const char* resources, Text& why) {
  if (strcmp(variables.fmu(), "ShipManoeuvring") != 0) return refuse_model(variables, why);
  Model* model = new ShipManoeuvringFmu(resources);
  if (model == nullptr) why << "there is no memory for the model of ShipManoeuvring";
  return model;
}

}  // namespace shipcollision
