// A digest of a whole encounter, the same on every platform: of all that the model gives and keeps after each step.
//
//   collide STEPS SHIP...      prepared files; each ship heads for the origin, and takes its impulses at once
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "collision/model.hpp"
#include "numbers/elementary.hpp"

using namespace shipcollision;

namespace {

constexpr double H = 0.1;

uint64_t hash = 14695981039346656037u;

void add(const void* data, size_t size) {
  const unsigned char* bytes = static_cast<const unsigned char*>(data);
  for (size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
}

int refuse(const Text& why) {
  printf("%s\n", why.get());
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  const int steps = atoi(arguments[1]), ships = count - 2;
  const char* names[] = {"a", "b", "c", "d", "e", "f"};
  Text why;
  ShipCollision model;
  if (!model.name_ships(names, ships, why)) return refuse(why);
  for (int i = 0; i < ships; ++i) {
    strcpy(model.parameters.ships[i].ship, arguments[2 + i]);
    model.parameters.ships[i].coasting = Coasting::free;
    const double angle = 2.0 * PI * i / ships, away = 170.0 + 12.0 * i;
    ShipState& ship = model.inputs.ships[i];
    ship.position = {{-away * shipcollision::cos(angle), -away * shipcollision::sin(angle), 0.0}};
    ship.attitude = {{0.02 * i, 0.0, angle + 0.05 * i}};
    ship.velocity = {{4.0 + 0.5 * i, 0.2 * i, 0.0}};
    ship.rate = {{0.0, 0.0, 0.002 * i}};
  }
  if (!model.initialise(why)) return refuse(why);
  Memory memory;
  Buffer<unsigned char> state(memory);
  int touched = 0;
  for (int step = 0; step < steps; ++step) {
    if (!model.step(step * H, H, why)) return refuse(why);
    const CollisionOutputs& out = model.outputs;
    touched += out.contact_count > 0;
    add(&out.clearance, sizeof out.clearance);
    add(&out.energy, sizeof out.energy);
    for (int i = 0; i < ships; ++i) {
      add(&out.ships[i], sizeof out.ships[i]);
      ShipState& ship = model.inputs.ships[i];
      ship.position = out.ships[i].position;
      ship.attitude = out.ships[i].attitude;
      ship.velocity = out.ships[i].velocity;
      ship.rate = out.ships[i].rate;
      ship.impulse_applied = out.ships[i].impulse;
    }
    if (!state.resize(static_cast<int>(model.state_size()))) return 1;
    model.get_state(state.data(), static_cast<size_t>(state.size()));
    add(state.data(), static_cast<size_t>(state.size()));
  }
  printf("%016llx %d steps in contact, %d collisions\n", static_cast<unsigned long long>(hash), touched,
         model.outputs.collision_count);
  return 0;
}
