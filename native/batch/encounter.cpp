#include "encounter.hpp"

#include <string.h>

namespace shipcollision {
namespace {

constexpr size_t STATE_SIZE = 12 * sizeof(double);  // position, attitude, velocity, rate, one after the other

static_assert(offsetof(ShipState, impulse_applied) == STATE_SIZE, "states are copied as a whole");
static_assert(offsetof(ShipOutputs, rudder_angle) == STATE_SIZE, "states are copied as a whole");

bool copy_path(char (&into)[LONGEST_STRING], const char* path, Text& why) {
  if (strnlen(path, LONGEST_STRING) == LONGEST_STRING) {
    why << "the path of a prepared file is too long";
    return false;
  }
  strcpy(into, path);
  return true;
}

void write_words(const Text& text, char (&words)[LONGEST_WORDS]) {
  size_t size = text.size() < LONGEST_WORDS ? text.size() : LONGEST_WORDS - 1;
  while (size < text.size() && size > 0 && (text.get()[size] & 0xC0) == 0x80) --size;  // not within a character
  memcpy(words, text.get(), size);
  words[size] = '\0';
}

// "name: why", as a master says which instance refused.
void name_instance(const char* name, Text& why) {
  const Text said = why;
  why.clear();
  why << name << ": " << said;
}

}  // namespace

Encounters::~Encounters() { clear(); }

void Encounters::clear() {
  for (ShipManoeuvring* ship : ships_) delete ship;
  ships_.clear();
  delete collision_;
  collision_ = nullptr;
}

void Encounters::run(const EncounterCase& given, EncounterRow& row, ShipRow* ships, double* track) {
  Text why;
  memset(static_cast<void*>(&row), 0, sizeof row);
  memset(static_cast<void*>(ships), 0, sizeof(ShipRow) * static_cast<size_t>(given.ship_count));
  row.status = EncounterStatus::refused;
  row.clearance = INFINITE;
  last_contact_ = -1;
  log_.begin(nullptr, 0, nullptr, 0, 0);
  if ((!has_models(given) && !make_models(given, why)) || !initialise(given, why)) {
    write_words(why, row.reason);
    return;
  }
  record(0, row, track);
  row.status = EncounterStatus::done;
  for (int k = 0; k < given.steps; ++k) {
    if (!step(given, k, row, why)) {
      row.status = EncounterStatus::refused;
      write_words(why, row.reason);
      break;
    }
    record(k + 1, row, track);
    row.steps = k + 1;
    if (is_over(given, k + 1)) break;
  }
  row.time = row.steps * given.step;
  fill(row, ships);
}

// -- set-up ------------------------------------------------------------------------------------------------------

bool Encounters::has_models(const EncounterCase& given) const {
  if (collision_ == nullptr || ships_.size() != given.ship_count) return false;
  for (int i = 0; i < given.ship_count; ++i) {
    if (strcmp(collision_->name(i), given.ships[i].name) != 0) return false;
  }
  return true;
}

bool Encounters::make_models(const EncounterCase& given, Text& why) {
  clear();
  Buffer<const char*> names(memory_);
  for (int i = 0; i < given.ship_count; ++i) names.add(given.ships[i].name);
  collision_ = new ShipCollision;
  bool is_made = collision_ != nullptr && !memory_.is_exhausted;
  if (is_made && !collision_->name_ships(names.data(), names.size(), why)) {
    clear();
    return false;
  }
  for (int i = 0; i < given.ship_count && is_made; ++i) {
    ShipManoeuvring* ship = new ShipManoeuvring;
    is_made = ship != nullptr && ships_.add(ship);
    if (!is_made) delete ship;
  }
  is_made = is_made && helms_.fill(given.ship_count, Helm()) && states_.fill(given.ship_count, ShipState()) &&
            before_.fill(given.ship_count, ShipState()) && starts_.fill(given.ship_count, ShipState()) &&
            logged_.resize(given.ship_count);
  if (is_made) return true;
  memory_.is_exhausted = false;
  clear();
  why << "there is no memory for the models";
  return false;
}

bool Encounters::initialise(const EncounterCase& given, Text& why) {
  for (int i = 0; i < given.ship_count; ++i) {
    if (initialise_ship(given, i, why)) continue;
    name_instance(given.ships[i].name, why);
    return false;
  }
  fetch_states();
  for (int i = 0; i < given.ship_count; ++i) {
    starts_[i] = collision_->inputs.ships[i] = states_[i];
    logged_[i].degrees_of_freedom = given.ships[i].degrees_of_freedom;
    memcpy(logged_[i].inverse, given.ships[i].inverse, sizeof logged_[i].inverse);
  }
  if (!set_up_collision(given, why) || !collision_->initialise(why)) {
    name_instance("collision", why);
    return false;
  }
  log_.begin(logged_.data(), logged_.size(), given.headings, given.obstacle_count, given.is_parallel != 0 ? 1 : 0);
  return true;
}

bool Encounters::initialise_ship(const EncounterCase& given, int i, Text& why) {
  const EncounterShip& table = given.ships[i];
  ShipManoeuvring& ship = *ships_[i];
  ShipParameters& p = ship.parameters;
  if (!copy_path(p.ship, table.file, why)) return false;
  p.degrees_of_freedom = table.degrees_of_freedom;
  p.hydrodynamics = table.hydrodynamics != 0;
  p.coasting = static_cast<Coasting>(table.coasting);
  memcpy(p.initial_position, table.start, sizeof p.initial_position);
  memcpy(p.initial_attitude, table.start + 3, sizeof p.initial_attitude);
  memcpy(p.initial_velocity, table.start + 6, sizeof p.initial_velocity);
  memcpy(p.initial_rate, table.start + 9, sizeof p.initial_rate);
  ship.inputs = ShipInputs();
  memcpy(ship.inputs.current, given.surroundings, sizeof ship.inputs.current);
  ship.inputs.wind_speed = given.surroundings[2];
  ship.inputs.wind_direction = given.surroundings[3];
  helms_[i].begin(table.helm);
  helms_[i].give_orders(0, given.step, i, nullptr, ship.inputs);
  return ship.initialise(why);
}

bool Encounters::set_up_collision(const EncounterCase& given, Text& why) {
  CollisionParameters& p = collision_->parameters;
  for (int i = 0; i < given.ship_count; ++i) {
    const EncounterShip& table = given.ships[i];
    CollisionShipParameters& of_ship = p.ships[i];
    if (!copy_path(of_ship.ship, table.file, why)) return false;
    of_ship.degrees_of_freedom = table.degrees_of_freedom;
    of_ship.coasting = static_cast<Coasting>(table.predicted_coasting);
    of_ship.fender = {table.fender[0], table.fender[1], table.fender[2]};
  }
  p.friction = given.friction;
  p.restitution = given.restitution;
  p.substep = given.substep;
  p.minimum_separation_time = given.minimum_separation_time;
  p.clearance_range = given.clearance_range;
  p.response = static_cast<Response>(given.response);
  p.feedback = static_cast<CommonFeedback>(given.feedback);
  return copy_path(p.obstacles, given.obstacles, why);
}

// -- a step ------------------------------------------------------------------------------------------------------

bool Encounters::step(const EncounterCase& given, int k, EncounterRow& row, Text& why) {
  const double h = given.step, t = k * h;
  for (int i = 0; i < ships_.size(); ++i) helms_[i].give_orders(k, h, i, states_.data(), ships_[i]->inputs);
  memcpy(static_cast<void*>(before_.data()), states_.data(), sizeof(ShipState) * static_cast<size_t>(states_.size()));
  memcpy(static_cast<void*>(collision_->inputs.ships.data()), states_.data(),
         sizeof(ShipState) * static_cast<size_t>(states_.size()));
  if (given.is_parallel != 0) send_impulses(given);
  if (!step_collision(t, h, row, why)) return false;
  if (given.is_parallel == 0) send_impulses(given);
  if (!step_ships(t, h, row, why)) return false;
  fetch_states();
  if (collision_->outputs.contact_count > 0) {
    last_contact_ = k + 1;
    log_.add(k, t, h, before_.data(), collision_->outputs);
  }
  log_.follow(k, states_.data());
  if (!memory_.is_exhausted) return true;
  memory_.is_exhausted = false;
  why << "there is no memory for the collisions";
  return false;
}

bool Encounters::step_collision(double t, double h, EncounterRow& row, Text& why) {
  if (!collision_->step(t, h, why)) {
    name_instance("collision", why);
    return false;
  }
  warn("collision", collision_->warning, row);
  return true;
}

bool Encounters::step_ships(double t, double h, EncounterRow& row, Text& why) {
  for (int i = 0; i < ships_.size(); ++i) {
    if (!ships_[i]->warning.is_empty()) warn(collision_->name(i), ships_[i]->warning, row);
    if (ships_[i]->step(t, h, why)) continue;
    name_instance(collision_->name(i), why);
    return false;
  }
  return true;
}

void Encounters::send_impulses(const EncounterCase& given) {
  const CommonFeedback feedback = static_cast<CommonFeedback>(given.feedback);
  for (int i = 0; i < ships_.size(); ++i) {
    const ShipPost& post = collision_->outputs.ships[i];
    if (feedback == CommonFeedback::ledger) memcpy(ships_[i]->inputs.impulse, post.impulse.at, sizeof post.impulse);
    if (feedback == CommonFeedback::force) memcpy(ships_[i]->inputs.force, post.force.at, sizeof post.force);
  }
}

void Encounters::fetch_states() {
  for (int i = 0; i < ships_.size(); ++i) {
    const ShipOutputs& out = ships_[i]->outputs;
    memcpy(static_cast<void*>(&states_[i]), out.position, STATE_SIZE);
    memcpy(states_[i].impulse_applied.at, out.impulse_applied, sizeof out.impulse_applied);
  }
}

// -- what is kept of it ------------------------------------------------------------------------------------------

void Encounters::record(int k, EncounterRow& row, double* track) {
  const CollisionOutputs& out = collision_->outputs;
  if (out.clearance < row.clearance) {
    row.clearance = out.clearance;
    row.nearest_a = out.nearest_ship_a;
    row.nearest_b = out.nearest_ship_b;
  }
  if (track == nullptr) return;
  const size_t count = static_cast<size_t>(states_.size());
  for (size_t i = 0; i < count; ++i) {
    memcpy(track + 12 * (static_cast<size_t>(k) * count + i), &states_[static_cast<int>(i)], STATE_SIZE);
  }
}

// The first warning is kept.
void Encounters::warn(const char* name, const Text& warning, EncounterRow& row) const {
  if (warning.is_empty() || row.warning[0] != '\0') return;
  Text words;
  words << name << ": " << warning;
  write_words(words, row.warning);
}

bool Encounters::is_over(const EncounterCase& given, int k) const {
  return given.separation >= 0.0 && last_contact_ >= 0 && (k - last_contact_) * given.step >= given.separation;
}

void Encounters::fill(EncounterRow& row, ShipRow* ships) const {
  const CollisionOutputs& out = collision_->outputs;
  row.collisions = out.collision_count;
  row.unconverged = out.solver.unconverged;
  row.scaled = out.solver.scaled;
  row.energy = out.energy.dissipated;
  row.energy_normal = out.energy.normal;
  row.energy_tangential = out.energy.tangential;
  row.fender_stored = out.fender.stored;
  row.fender_dissipated = out.fender.dissipated;
  for (int i = 0; i < ships_.size(); ++i) {
    memcpy(ships[i].start, &starts_[i], STATE_SIZE);
    memcpy(ships[i].end, &states_[i], STATE_SIZE);
    ships[i].issued = out.ships[i].impulse;
    ships[i].applied = states_[i].impulse_applied;
  }
}

}  // namespace shipcollision
