// A digest of what random patches are answered with, the same on every platform.
//
//   answer COUNT
#include <stdio.h>
#include <stdlib.h>

#include "patches.hpp"

using namespace shipcollision;

namespace {

uint64_t hash = 14695981039346656037u;

template <typename Numbers>
void add(const Numbers& numbers) {
  const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&numbers);
  for (size_t i = 0; i < sizeof numbers; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
}

}  // namespace

int main(int, char** arguments) {
  const int count = atoi(arguments[1]);
  Memory memory;
  Substep substep(memory);
  Random random{11};
  int answered = 0, together = 0;
  for (int i = 0; i < count; ++i) {
    const int bodies = 2 + i % 4;
    if (!substep.draw(random, bodies, 1 + i % 3) || !substep.answer(memory)) return 1;
    answered += substep.solution.sweeps > 0;
    together += substep.solution.sweeps >= 30 || substep.contacts.size() >= MANY_CONTACTS;
    add(substep.solution.residual);
    for (const Impulse& impulse : substep.solution.impulses) add(impulse.P);
    for (const Loss& loss : substep.losses) add(loss);
    for (int body = 0; body < bodies; ++body) add(substep.states[body].nu);
  }
  printf("%016llx %d answered, %d together\n", static_cast<unsigned long long>(hash), answered, together);
  return 0;
}
