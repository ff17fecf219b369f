// How often the library asked for memory: its own calls alone, for the names are not exported.
#include <stdlib.h>

#include "../../../native/export.hpp"

#ifdef __GLIBC__

extern "C" void* __libc_malloc(size_t size);
extern "C" void* __libc_calloc(size_t count, size_t size);
extern "C" void* __libc_realloc(void* at, size_t size);

namespace {

long requests = 0;

}  // namespace

extern "C" void* malloc(size_t size) {
  ++requests;
  return __libc_malloc(size);
}

extern "C" void* calloc(size_t count, size_t size) {
  ++requests;
  return __libc_calloc(count, size);
}

extern "C" void* realloc(void* at, size_t size) {
  ++requests;
  return __libc_realloc(at, size);
}

SHIPCOLLISION_EXPORT long shipcollision_count_requests() { return requests; }

#endif
