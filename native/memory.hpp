// Objects on the heap whose `new` answers null where there is no memory: there are no exceptions to say so.
#pragma once

#include <stddef.h>
#include <stdlib.h>

namespace shipcollision {

// The base of such classes. What they inherit from elsewhere must not have its own `new`.
struct OnHeap {
  static void* operator new(size_t size) noexcept { return malloc(size); }
  static void operator delete(void* memory) { free(memory); }
};

}  // namespace shipcollision
