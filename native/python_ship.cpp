// The ship model through the plain C interface. Parameters, inputs and outputs are structs that the caller fills and
// reads in place.
#include <string.h>

#include "export.hpp"
#include "manoeuvring/model.hpp"

namespace {

using shipcollision::ShipManoeuvring;
using shipcollision::Text;

ShipManoeuvring& model_of(void* ship) { return *static_cast<ShipManoeuvring*>(ship); }

bool answer(bool is_done, const Text& why, char* message, size_t capacity) {
  if (capacity > 0) {
    const size_t size = why.size() < capacity ? why.size() : capacity - 1;
    memcpy(message, why.get(), size);
    message[size] = '\0';
  }
  return is_done;
}

}  // namespace

// A ship whose prepared file is looked for in `directory`; shipcollision_free_ship frees it.
SHIPCOLLISION_EXPORT void* shipcollision_make_ship(const char* directory) {
  if (strlen(directory) >= shipcollision::LONGEST_STRING) return nullptr;
  ShipManoeuvring* ship = new ShipManoeuvring;
  if (ship != nullptr) strcpy(ship->directory, directory);
  return ship;
}

SHIPCOLLISION_EXPORT void shipcollision_free_ship(void* ship) { delete static_cast<ShipManoeuvring*>(ship); }

SHIPCOLLISION_EXPORT void* shipcollision_ship_parameters(void* ship) { return &model_of(ship).parameters; }

SHIPCOLLISION_EXPORT void* shipcollision_ship_inputs(void* ship) { return &model_of(ship).inputs; }

SHIPCOLLISION_EXPORT void* shipcollision_ship_outputs(void* ship) { return &model_of(ship).outputs; }

SHIPCOLLISION_EXPORT const char* shipcollision_ship_warning(void* ship) { return model_of(ship).warning.get(); }

// False, and why in `message`, for a refusal; everything is then as it was.
SHIPCOLLISION_EXPORT bool shipcollision_initialise_ship(void* ship, char* message, size_t capacity) {
  Text why;
  return answer(model_of(ship).initialise(why), why, message, capacity);
}

SHIPCOLLISION_EXPORT bool shipcollision_step_ship(void* ship, double t, double h, char* message, size_t capacity) {
  Text why;
  return answer(model_of(ship).step(t, h, why), why, message, capacity);
}

SHIPCOLLISION_EXPORT size_t shipcollision_ship_state_size() { return ShipManoeuvring::state_size(); }

SHIPCOLLISION_EXPORT size_t shipcollision_get_ship_state(void* ship, void* bytes) {
  return model_of(ship).get_state(bytes);
}

SHIPCOLLISION_EXPORT bool shipcollision_set_ship_state(void* ship, const void* bytes, size_t size, char* message,
                                                       size_t capacity) {
  Text why;
  return answer(model_of(ship).set_state(bytes, size, why), why, message, capacity);
}
