// A digest of what detection answers for random motions of the hulls of prepared ships, the same on every platform.
//
//   detect COUNT A.ship B.ship ...
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../../../native/collision/geometry/detection.hpp"
#include "../../../../native/ship/prepared_ship.hpp"

using namespace shipcollision;

namespace {

struct Random {
  uint64_t seed = 7;

  // From -1 to 1.
  double draw() {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(seed >> 12) / 2251799813685248.0 - 1.0;
  }
};

struct Digest {
  uint64_t hash = 14695981039346656037u;
  int contacts = 0, touches = 0;

  template <typename Numbers>
  void add(const Numbers& numbers) {
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&numbers);
    for (size_t i = 0; i < sizeof numbers; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  }
};

BodyState draw_state(Random& random, double spread, double height) {
  const Three position{{spread * random.draw(), spread * random.draw(), height * random.draw()}};
  const double tilt = 0.05 * random.draw();
  const Three attitude{{tilt, 0.3 * tilt, 3.0 * random.draw()}};
  const Six nu{{6.0 * random.draw(), 2.0 * random.draw(), 0.1 * random.draw(), 0.02 * random.draw(), tilt,
                0.1 * random.draw()}};
  const Matrix inverse{};
  BodyState state;
  state.start_at(position, attitude, nu, inverse, {{3.0 * random.draw(), 0.0, 1.0}});
  return state;
}

void detect(Detector& detector, const Pair& pair, BodyState* states, LastNormals& last_normals,
            Buffer<Contact>& contacts, Digest& digest) {
  last_normals.clear();
  for (int step = 0; step < 3; ++step) {
    double touch = -1.0;
    digest.touches += detector.first_touch(pair, states, 2.0, 40.0, last_normals, touch);
    digest.add(touch);
    states[pair.a].advance(0.5);
    states[pair.b].advance(0.5);
    digest.add(detector.clearance(pair, states, 50.0));
    digest.add(detector.misses_first_touch(pair, states));
    contacts.clear();
    detector.contacts(pair, states, last_normals, contacts);
    for (const Contact& contact : contacts) {
      digest.add(contact.gap);
      digest.add(contact.axes);
      digest.add(contact.at);
      digest.add(contact.G_b);
    }
    digest.contacts += contacts.size();
  }
}

}  // namespace

int main(int arguments, char** values) {
  Memory memory;
  const int count = arguments - 2;
  if (count < 2) return 2;
  PreparedShip* ship = new PreparedShip;
  HullMesh* hulls = new HullMesh[static_cast<size_t>(count)];
  Buffer<const HullMesh*> pointers(memory);
  Text why;
  for (int i = 0; i < count; ++i) {
    if (!load_prepared_ship(values[2 + i], "", *ship, why, &hulls[i])) return puts(why.get()), 3;
    pointers.add(&hulls[i]);
  }
  Detector detector(memory);
  if (!detector.set_up(pointers.data(), count)) return 4;
  Random random;
  Digest digest;
  Buffer<BodyState> states(memory);
  Buffer<Contact> contacts(memory);
  LastNormals last_normals(memory);
  for (int k = atoi(values[1]); k > 0; --k) {
    const int a = static_cast<int>(0.5 * (random.draw() + 1.0) * (count - 1));
    const Pair pair{a, a + 1 + static_cast<int>(0.5 * (random.draw() + 1.0) * (count - 1 - a))};
    const double spread = 0.3 * (hulls[pair.a].reach + hulls[pair.b].reach);
    states.clear();
    for (int i = 0; i < count; ++i) states.add(draw_state(random, spread, 1.0));
    detect(detector, pair, states.data(), last_normals, contacts, digest);
  }
  printf("%016llx %d contacts, %d touches\n", static_cast<unsigned long long>(digest.hash), digest.contacts,
         digest.touches);
  return memory.is_exhausted ? 5 : 0;
}
