// Memory that ends at every request one after the other, and how many are made once there was enough; glibc alone.
#include <stdio.h>
#include <stdlib.h>

#include "patches.hpp"

extern "C" void* __libc_realloc(void*, size_t);

namespace {

long requests = 0, granted = 0;

}  // namespace

extern "C" void* realloc(void* at, size_t size) {
  return requests++ < granted ? __libc_realloc(at, size) : nullptr;
}

using namespace shipcollision;

int main() {
  long needed = -1;
  for (long n = 0; n < 1000 && needed < 0; ++n) {
    requests = 0;
    granted = n;
    Memory memory;
    Substep substep(memory);
    Random random{5};
    bool is_done = true;
    for (int i = 0; i < 6 && is_done; ++i) is_done = substep.draw(random, 5, 3) && substep.answer(memory);
    if (is_done == memory.is_exhausted || is_done != (requests <= n)) return 1;
    if (!is_done) continue;
    needed = requests;
    for (int i = 0; i < 200; ++i) {
      if (!substep.draw(random, 2 + i % 4, 1 + i % 3) || !substep.answer(memory)) return 2;
    }
    if (substep.caches.warm_starts.rows().size() == 0) return 3;
    printf("%ld requests, %ld later\n", needed, requests - needed);
  }
  return 0;
}
