#include "saved_state.hpp"

#include <stdlib.h>
#include <string.h>

#include "../numbers/crc32.hpp"

namespace shipcollision {

namespace {

const char MARK[8] = {'S', 'H', 'I', 'P', 'S', 'T', '0', '1'};

}  // namespace

void seal_state(unsigned char* bytes, size_t size) {
  const uint32_t inside = static_cast<uint32_t>(size - STATE_HEAD);
  const uint32_t digest = crc32(bytes + STATE_HEAD, inside);
  memcpy(bytes, MARK, 8);
  memcpy(bytes + 8, &inside, 4);
  memcpy(bytes + 12, &digest, 4);
}

bool is_sealed(const void* bytes, size_t size) {
  const unsigned char* data = static_cast<const unsigned char*>(bytes);
  uint32_t inside, digest;
  if (data == nullptr || size < STATE_HEAD || memcmp(data, MARK, 8) != 0) return false;
  memcpy(&inside, data + 8, 4);
  memcpy(&digest, data + 12, 4);
  return inside == size - STATE_HEAD && crc32(data + STATE_HEAD, inside) == digest;
}

SavedStates::~SavedStates() {
  while (first_ != nullptr) free(first_);
}

SavedState* SavedStates::make(void* handle, size_t size, Text& why) {
  SavedState* state = handle == nullptr ? static_cast<SavedState*>(calloc(1, sizeof(SavedState))) : find(handle, why);
  if (handle != nullptr && state == nullptr) return nullptr;
  if (state != nullptr && state->capacity < size) {
    unsigned char* larger = static_cast<unsigned char*>(malloc(size));
    if (larger != nullptr) {
      ::free(state->bytes);
      state->bytes = larger;
      state->capacity = size;
    }
  }
  if (state == nullptr || state->capacity < size) {
    why << "there is no memory for a state of " << static_cast<long long>(size) << " bytes";
    if (handle == nullptr) ::free(state);
    return nullptr;
  }
  state->size = size;
  if (handle == nullptr) {
    state->next = first_;
    if (first_ != nullptr) first_->previous = state;
    first_ = state;
  }
  return state;
}

SavedState* SavedStates::find(const void* handle, Text& why) const {
  SavedState* state = first_;
  while (state != nullptr && state != handle) state = state->next;
  if (state == nullptr) {
    why << (handle == nullptr ? "a null pointer is no saved state"
                              : "this is no saved state of this instance: it was freed, or another instance saved it; "
                                "serialize a state to take it to another instance");
  }
  return state;
}

void SavedStates::free(SavedState* state) {
  (state->previous == nullptr ? first_ : state->previous->next) = state->next;
  if (state->next != nullptr) state->next->previous = state->previous;
  ::free(state->bytes);
  ::free(state);
}

}  // namespace shipcollision
