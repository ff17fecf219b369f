// The collision model through the plain C interface. Received states, posts and contact points are read and filled in
// place.
#include <string.h>

#include "collision/model.hpp"
#include "export.hpp"

namespace {

using namespace shipcollision;

ShipCollision& model_of(void* collision) { return *static_cast<ShipCollision*>(collision); }

bool answer(bool is_done, const Text& why, char* message, size_t capacity) {
  if (capacity > 0) {
    const size_t size = why.size() < capacity ? why.size() : capacity - 1;
    memcpy(message, why.get(), size);
    message[size] = '\0';
  }
  return is_done;
}

// False for a text that is too long.
bool copy_text(char (&into)[LONGEST_STRING], const char* text) {
  const size_t size = strnlen(text, LONGEST_STRING);
  if (size == LONGEST_STRING) return false;
  memcpy(into, text, size + 1);
  return true;
}

}  // namespace

// A model of these ships, whose prepared files are looked for in `directory`; shipcollision_free_collision frees it.
// Null, and why in `message`, for a refusal.
SHIPCOLLISION_EXPORT void* shipcollision_make_collision(const char* const* names, int count, const char* directory,
                                                        char* message, size_t capacity) {
  Text why;
  ShipCollision* collision = new ShipCollision;
  if (collision == nullptr) {
    why << "there is no memory for the collision model";
  } else if (!copy_text(collision->directory, directory)) {
    why << "the path of the folder is too long";
  } else if (collision->name_ships(names, count, why)) {
    return collision;
  }
  delete collision;
  answer(false, why, message, capacity);
  return nullptr;
}

SHIPCOLLISION_EXPORT void shipcollision_free_collision(void* collision) {
  delete static_cast<ShipCollision*>(collision);
}

// coasting, feedback: counted as the items of the variables; fender: stiffness, damping, thickness. False for texts that
// are too long.
SHIPCOLLISION_EXPORT bool shipcollision_set_collision_ship(void* collision, int ship, const char* file,
                                                           int degrees_of_freedom, int coasting, const double* fender,
                                                           int feedback, const char* feedback_name) {
  CollisionShipParameters& of_ship = model_of(collision).parameters.ships[ship];
  of_ship.degrees_of_freedom = degrees_of_freedom;
  of_ship.coasting = static_cast<Coasting>(coasting);
  of_ship.fender = {fender[0], fender[1], fender[2]};
  of_ship.feedback = static_cast<Feedback>(feedback);
  return copy_text(of_ship.ship, file) && copy_text(of_ship.feedback_name, feedback_name);
}

// numbers: friction, restitution, substep, minimum separation time, clearance range; obstacles: path of a prepared file.
SHIPCOLLISION_EXPORT bool shipcollision_set_collision_parameters(void* collision, const double* numbers, int response,
                                                                 int feedback, const char* obstacles) {
  CollisionParameters& parameters = model_of(collision).parameters;
  parameters.friction = numbers[0];
  parameters.restitution = numbers[1];
  parameters.substep = numbers[2];
  parameters.minimum_separation_time = numbers[3];
  parameters.clearance_range = numbers[4];
  parameters.response = static_cast<Response>(response);
  parameters.feedback = static_cast<CommonFeedback>(feedback);
  return copy_text(parameters.obstacles, obstacles);
}

SHIPCOLLISION_EXPORT void shipcollision_note_collision_state_set(void* collision, int ship, bool is_set) {
  model_of(collision).note_state_set(ship, is_set);
}

// Of each ship 18 numbers: position, attitude, velocity, rate, impulse_applied.
SHIPCOLLISION_EXPORT void* shipcollision_collision_inputs(void* collision) {
  return model_of(collision).inputs.ships.data();
}

// Of each ship 24 numbers: position, attitude, velocity, rate, impulse, force.
SHIPCOLLISION_EXPORT void* shipcollision_collision_posts(void* collision) {
  return model_of(collision).outputs.ships.data();
}

// As ContactOutput in collision/interface.hpp, and how many.
SHIPCOLLISION_EXPORT void* shipcollision_collision_contacts(void* collision) {
  return model_of(collision).outputs.contacts.data();
}

SHIPCOLLISION_EXPORT int shipcollision_collision_contact_count(void* collision) {
  return model_of(collision).outputs.contacts.size();
}

// The other outputs, in the order of CollisionOutputs, but for the text of the first finding, which is answered.
SHIPCOLLISION_EXPORT const char* shipcollision_collision_outputs(void* collision, double* numbers) {
  const CollisionOutputs& out = model_of(collision).outputs;
  const Impact& impact = out.impact;
  const double all[] = {1.0 * out.contact_active,
                        1.0 * out.contact_count,
                        1.0 * out.collision_count,
                        impact.time,
                        impact.point[0],
                        impact.point[1],
                        impact.point[2],
                        impact.closing_speed,
                        impact.angle,
                        1.0 * impact.ship_a,
                        1.0 * impact.ship_b,
                        1.0 * out.scratch_id,
                        out.energy.dissipated,
                        out.energy.normal,
                        out.energy.tangential,
                        out.fender.stored,
                        out.fender.dissipated,
                        out.clearance,
                        1.0 * out.nearest_ship_a,
                        1.0 * out.nearest_ship_b,
                        out.solver.residual,
                        1.0 * out.solver.sweeps,
                        1.0 * out.solver.unconverged,
                        1.0 * out.solver.scaled,
                        1.0 * out.diagnosis.code,
                        1.0 * out.diagnosis.ship,
                        1.0 * out.diagnosis.count};
  memcpy(numbers, all, sizeof all);
  return out.diagnosis.text;
}

SHIPCOLLISION_EXPORT const char* shipcollision_collision_warning(void* collision) {
  return model_of(collision).warning.get();
}

SHIPCOLLISION_EXPORT int shipcollision_collision_event_count(void* collision) {
  return model_of(collision).event_count();
}

SHIPCOLLISION_EXPORT const char* shipcollision_collision_event(void* collision, int i) {
  return model_of(collision).event(i);
}

// False, and why in `message`, for a refusal; everything is then as it was.
SHIPCOLLISION_EXPORT bool shipcollision_initialise_collision(void* collision, char* message, size_t capacity) {
  Text why;
  return answer(model_of(collision).initialise(why), why, message, capacity);
}

SHIPCOLLISION_EXPORT bool shipcollision_step_collision(void* collision, double t, double H, char* message,
                                                       size_t capacity) {
  Text why;
  return answer(model_of(collision).step(t, H, why), why, message, capacity);
}

SHIPCOLLISION_EXPORT size_t shipcollision_collision_state_size(void* collision) {
  return model_of(collision).state_size();
}

SHIPCOLLISION_EXPORT void shipcollision_get_collision_state(void* collision, void* bytes, size_t size) {
  model_of(collision).get_state(bytes, size);
}

SHIPCOLLISION_EXPORT bool shipcollision_set_collision_state(void* collision, const void* bytes, size_t size,
                                                            char* message, size_t capacity) {
  Text why;
  return answer(model_of(collision).set_state(bytes, size, why), why, message, capacity);
}
