// What the language asks of its library, made of malloc and free: no library of C++ is linked.
#include <stdlib.h>

void* operator new(size_t size) { return malloc(size); }
void* operator new[](size_t size) { return malloc(size); }
void operator delete(void* memory) noexcept { free(memory); }
void operator delete[](void* memory) noexcept { free(memory); }
void operator delete(void* memory, size_t) noexcept { free(memory); }
void operator delete[](void* memory, size_t) noexcept { free(memory); }

// Called only by a destructor of a class that is half made: never.
extern "C" void __cxa_pure_virtual() { abort(); }
