// Saved states: bytes behind a handle that the host holds, with a digest that shows damage.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "../numbers/text.hpp"

namespace shipcollision {

// One state. The bytes begin with a mark, the size of what follows, and its CRC-32.
struct SavedState {
  SavedState* next;
  SavedState* previous;
  unsigned char* bytes;
  size_t size;
  size_t capacity;
};

constexpr size_t STATE_HEAD = 16;  // bytes of mark, size and digest

// Writes the head before `size - STATE_HEAD` bytes that are there.
void seal_state(unsigned char* bytes, size_t size);
// Whether the bytes were sealed so, all of them and no other.
bool is_sealed(const void* bytes, size_t size);

// The states of an instance. A handle is looked up among them: one that is none of them is refused, never followed.
class SavedStates {
 public:
  SavedStates() = default;
  ~SavedStates();
  SavedStates(const SavedStates&) = delete;
  SavedStates& operator=(const SavedStates&) = delete;

  // A state with room for so many bytes: that of the handle if there is one. Null without memory, or for a handle that
  // is none of these; the old state then stays.
  SavedState* make(void* handle, size_t size, Text& why);
  // The state of a handle, or null.
  SavedState* find(const void* handle, Text& why) const;
  void free(SavedState* state);

 private:
  SavedState* first_ = nullptr;
};

}  // namespace shipcollision
