#include "ship_collision.hpp"

#include <string.h>

#include "paths.hpp"
#include "variables.hpp"

namespace shipcollision {

namespace {

// In the order of the enumerations of collision/interface.hpp and of Coasting.
const char* const COASTING[] = {"kirchhoff", "free", "straight"};
const char* const RESPONSES[] = {"pgs", "closed_form", "bullet"};
const char* const COMMON_FEEDBACKS[] = {"ledger", "force", "state", "none"};
const char* const SHIP_FEEDBACKS[] = {"common", "ledger", "force", "state", "none", "prescribed"};


const Path SHIP_PARAMETERS[] = {
    STRING(CollisionShipParameters, ship),
    INTEGER(CollisionShipParameters, degrees_of_freedom),
    REAL(CollisionShipParameters, fender.stiffness),
    REAL(CollisionShipParameters, fender.damping),
    REAL(CollisionShipParameters, fender.thickness),
    {"coasting", Kind::enumeration, offsetof(CollisionShipParameters, coasting), 0, COASTING, 3},
    {"feedback", Kind::enumeration, offsetof(CollisionShipParameters, feedback), 0, SHIP_FEEDBACKS, 6},
    STRING(CollisionShipParameters, feedback_name),
};

const Path FRAMES[] = {STRING(Frames, velocity), STRING(Frames, force)};

const Path PARAMETERS[] = {
    REAL(CollisionParameters, friction),
    REAL(CollisionParameters, restitution),
    REAL(CollisionParameters, substep),
    REAL(CollisionParameters, minimum_separation_time),
    REAL(CollisionParameters, clearance_range),
    {"response", Kind::enumeration, offsetof(CollisionParameters, response), 0, RESPONSES, 3},
    {"feedback", Kind::enumeration, offsetof(CollisionParameters, feedback), 0, COMMON_FEEDBACKS, 4},
    STRING(CollisionParameters, obstacles),
};

const Path SHIP_INPUTS[] = {
    REALS(ShipState, position),
    REALS(ShipState, attitude),
    REALS(ShipState, velocity),
    REALS(ShipState, rate),
};

const Path SHIP_APPLIED[] = {REALS(ShipState, impulse_applied)};

const Path SHIP_OUTPUTS[] = {
    REALS(ShipPost, position), REALS(ShipPost, attitude), REALS(ShipPost, velocity),
    REALS(ShipPost, rate),     REALS(ShipPost, impulse),  REALS(ShipPost, force),
};

const Path CONTACTS[] = {
    REALS(ContactOutput, point),
    REALS(ContactOutput, normal),
    REALS(ContactOutput, r_a),
    REALS(ContactOutput, r_b),
    REALS(ContactOutput, impulse),
    REALS(ContactOutput, couple),
    REAL(ContactOutput, gap),
    REAL(ContactOutput, impulse_normal),
    REAL(ContactOutput, impulse_tangential),
    REAL(ContactOutput, energy),
    INTEGER(ContactOutput, ship_a),
    INTEGER(ContactOutput, ship_b),
    INTEGER(ContactOutput, collision),
    INTEGER(ContactOutput, scratch),
    REAL(ContactOutput, start),
    REALS(ContactOutput, first),
    REAL(ContactOutput, closing_speed),
    REAL(ContactOutput, angle),
};

const Path OUTPUTS[] = {
    {"contact_active", Kind::boolean, offsetof(CollisionOutputs, contact_active), 0, nullptr, 0},
    INTEGER(CollisionOutputs, contact_count),
    INTEGER(CollisionOutputs, collision_count),
    REAL(CollisionOutputs, impact.time),
    REALS(CollisionOutputs, impact.point),
    REAL(CollisionOutputs, impact.closing_speed),
    REAL(CollisionOutputs, impact.angle),
    INTEGER(CollisionOutputs, impact.ship_a),
    INTEGER(CollisionOutputs, impact.ship_b),
    INTEGER(CollisionOutputs, scratch_id),
    REAL(CollisionOutputs, energy.dissipated),
    REAL(CollisionOutputs, energy.normal),
    REAL(CollisionOutputs, energy.tangential),
    REAL(CollisionOutputs, fender.stored),
    REAL(CollisionOutputs, fender.dissipated),
    REAL(CollisionOutputs, clearance),
    INTEGER(CollisionOutputs, nearest_ship_a),
    INTEGER(CollisionOutputs, nearest_ship_b),
    REAL(CollisionOutputs, solver.residual),
    INTEGER(CollisionOutputs, solver.sweeps),
    INTEGER(CollisionOutputs, solver.unconverged),
    INTEGER(CollisionOutputs, solver.scaled),
    INTEGER(CollisionOutputs, diagnosis.code),
    INTEGER(CollisionOutputs, diagnosis.ship),
    INTEGER(CollisionOutputs, diagnosis.count),
    STRING(CollisionOutputs, diagnosis.text),
};

constexpr char RECEIVED[] = "inputs.ships.";

}  // namespace

bool ShipCollisionFmu::set_up(const Variables& variables, const char* resources, Text& why) {
  char(&directory)[LONGEST_STRING] = framed_.collision.directory;
  const size_t size = strnlen(resources, LONGEST_STRING - 1);
  memcpy(directory, resources, size);
  directory[size] = '\0';
  return framed_.name_ships(variables.ships(), variables.ship_count(), why);
}

bool ShipCollisionFmu::find(const char* path, int index, Place& place) {
  ShipCollision& collision = framed_.collision;
  CollisionParameters& parameters = collision.parameters;
  CollisionOutputs& outputs = collision.outputs;
  ShipState* received = collision.inputs.ships.data();
  const int ships = collision.ship_count(), contacts = outputs.contacts.size();
  return find_in_list(SHIP_INPUTS, RECEIVED, received, ships, path, index, place) ||
         find_in_list(SHIP_APPLIED, RECEIVED, received, ships, path, index, place) ||
         find_in_list(SHIP_OUTPUTS, "outputs.ships.", outputs.ships.data(), ships, path, index, place) ||
         find_in_list(SHIP_PARAMETERS, "parameters.ships.", parameters.ships.data(), ships, path, index, place) ||
         find_in_list(CONTACTS, "outputs.contacts.", outputs.contacts.data(), contacts, path, index, place) ||
         find_in_list(FRAMES, "frames.", framed_.frames.data(), ships, path, index, place) ||
         find_in(PARAMETERS, "parameters.", &parameters, path, index, place) ||
         find_in(OUTPUTS, "outputs.", &outputs, path, index, place);
}

void ShipCollisionFmu::forget_inputs_set() {
  for (int i = 0; i < framed_.collision.ship_count(); ++i) framed_.collision.note_state_set(i, false);
}

// A ship of whose state nothing was set is absent.
void ShipCollisionFmu::note_input_set(const char* path) {
  int ship;
  const char* part = find_entry(RECEIVED, path, framed_.collision.ship_count(), ship);
  for (const Path& of_state : SHIP_INPUTS) {
    if (part != nullptr && strcmp(part, of_state.path) == 0) framed_.collision.note_state_set(ship, true);
  }
}

ReadFile ShipCollisionFmu::file(size_t i) const {
  const ShipCollision& collision = framed_.collision;
  const int file = static_cast<int>(i);
  const uint32_t checksum = collision.file_checksum(file);
  if (file == collision.ship_count()) return {nullptr, "obstacles", collision.parameters.obstacles, checksum};
  return {collision.name(file), "ship", collision.parameters.ships[file].ship, checksum};
}

Model* make_model(const Variables& variables, const char* resources, Text& why) {
  if (strcmp(variables.fmu(), "ShipCollision") != 0) return refuse_model(variables, why);
  ShipCollisionFmu* model = new ShipCollisionFmu;
  if (model == nullptr) {
    why << "there is no memory for the model of ShipCollision";
    return nullptr;
  }
  if (model->set_up(variables, resources, why)) return model;
  delete model;
  return nullptr;
}

}  // namespace shipcollision
