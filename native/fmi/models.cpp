// Which models the library has: the twin of the table FMUS in shipcollision_fmu/fmi/builder/package.py.
#include <string.h>

#include "model.hpp"
#include "ship_manoeuvring.hpp"

namespace shipcollision {

Model* make_model(const char* fmu, const char* resources) {
  if (strcmp(fmu, "ShipManoeuvring") == 0) return new ShipManoeuvringFmu(resources);
  return nullptr;
}

}  // namespace shipcollision
