// Ships from damaged files whose checksums are right, and states of random bytes: nothing may happen but a refusal.
//
//   damage SHIP.ship SCRATCH.ship COUNT
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../../native/manoeuvring/model.hpp"
#include "../../../native/numbers/crc32.hpp"
#include "../../../native/ship/prepared_ship.hpp"

using namespace shipcollision;

namespace {

constexpr size_t LAST_LINE = 15;  // bytes of the checksum's
constexpr size_t HEAD = 9000;     // bytes before the long tables

struct Random {
  uint64_t seed = 7;

  // Below `end`.
  size_t below(size_t end) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return static_cast<size_t>(seed >> 33) % end;
  }
};

size_t read_file(const char* path, char* content, size_t capacity) {
  FILE* file = fopen(path, "rb");
  if (file == nullptr) abort();
  const size_t size = fread(content, 1, capacity, file);
  fclose(file);
  return size;
}

void write_file(const char* path, const char* content, size_t size) {
  FILE* file = fopen(path, "wb");
  if (file == nullptr || fwrite(content, 1, size, file) != size) abort();
  fclose(file);
}

// Another byte, another exponent of a number, another character of those that are there, or some bytes less.
void damage(char* content, size_t size, size_t kind, Random& random) {
  const size_t end = size - LAST_LINE;
  size_t at = random.below(2) == 0 ? random.below(end) : random.below(HEAD < end ? HEAD : end);
  if (kind == 0) {
    content[at] = static_cast<char>(random.below(256));
  } else if (kind == 1) {
    while (at + 3 < end && content[at] != 'p') ++at;
    if (at + 3 >= end) return;
    content[at + 1] = "+-"[random.below(2)];
    content[at + 2] = static_cast<char>('0' + random.below(10));
  } else if (kind == 2) {
    content[at] = "0123456789abcdef -+.px\n\"\\"[random.below(25)];
  } else if (at + 3 < end) {
    memmove(content + at, content + at + random.below(3), end - at - 3);
  }
}

void seal(char* content, size_t size) {
  char line[LAST_LINE + 1];
  snprintf(line, sizeof line, "crc32 %08lx\n", static_cast<unsigned long>(crc32(content, size - LAST_LINE)));
  memcpy(content + size - LAST_LINE, line, LAST_LINE);
}

struct Count {
  int started = 0, refused = 0, steps = 0, hulls = 0;
};

// Reads the hull, and looks at the last of all that it holds.
void read_hull(const char* path, Count& count) {
  PreparedShip* ship = new PreparedShip;
  HullMesh hull;
  Text why;
  if (load_prepared_ship(path, "", *ship, why, &hull) && hull.part_count() > 0) {
    const HullPart last = hull.part(hull.part_count() - 1);
    const double sum = last.corners[last.corner_count - 1][2] + last.planes[last.plane_count - 1].offset;
    count.hulls += isfinite(sum);
  }
  delete ship;
}

void sail(const char* path, bool hydrodynamics, Random& random, Count& count) {
  constexpr int FREEDOMS[] = {3, 4, 6};
  ShipManoeuvring ship;
  Text why;
  strcpy(ship.parameters.ship, path);
  ship.parameters.degrees_of_freedom = FREEDOMS[random.below(3)];
  ship.parameters.hydrodynamics = hydrodynamics;
  ship.parameters.initial_velocity[0] = 5.0;
  ship.inputs.propeller_order = 1.0;
  ship.inputs.rudder_order = 0.3;
  ship.inputs.wind_speed = 5.0;
  ship.inputs.current[0] = hydrodynamics ? 1.0 : 0.0;
  if (!ship.initialise(why)) {
    ++count.refused;
    return;
  }
  ++count.started;
  for (int k = 0; k < 5; ++k) {
    ship.inputs.impulse[1] += 1e7;
    ship.inputs.impulse[3] += 1e7;
    ship.inputs.propeller_order = -ship.inputs.propeller_order;
    if (!ship.step(k, 1.0, why)) break;
    ++count.steps;
  }
  char state[1024];
  const size_t size = ship.get_state(state);
  for (int k = 0; k < 6; ++k) state[random.below(size)] = static_cast<char>(random.below(256));
  if (ship.set_state(state, size, why)) ship.step(5.0, 1.0, why);
}

}  // namespace

int main(int arguments, char** values) {
  static char whole[1 << 20], content[1 << 20];
  if (arguments != 4) return 2;
  const size_t size = read_file(values[1], whole, sizeof whole);
  Random random;
  Count count;
  for (int i = 0; i < atoi(values[3]); ++i) {
    memcpy(content, whole, size);
    for (size_t k = 1 + random.below(4); k > 0; --k) damage(content, size, static_cast<size_t>(i) % 4, random);
    seal(content, size);
    write_file(values[2], content, size);
    sail(values[2], true, random, count);
    sail(values[2], false, random, count);
    read_hull(values[2], count);
  }
  printf("%d started, %d refused, %d steps, %d hulls\n", count.started, count.refused, count.steps, count.hulls);
  return 0;
}
