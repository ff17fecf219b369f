// Lists that keep their memory: no memory is asked for once they have been as long as they get.
#pragma once

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

namespace shipcollision {

// Whether memory was there so far, for all buffers of a model. The model asks after a step, and refuses the step then.
struct Memory {
  bool is_exhausted = false;
};

// Values of a type whose bytes may be copied. References to entries hold until the next one is added.
template <typename T>
class Buffer {
 public:
  static_assert(__is_trivially_copyable(T), "bytes are copied");

  explicit Buffer(Memory& memory) : memory_(&memory) {}
  ~Buffer() { free(entries_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  int size() const { return size_; }
  bool is_empty() const { return size_ == 0; }
  T* data() { return entries_; }
  const T* data() const { return entries_; }
  T& operator[](int i) { return entries_[i]; }
  const T& operator[](int i) const { return entries_[i]; }
  T* begin() { return entries_; }
  T* end() { return entries_ + size_; }
  const T* begin() const { return entries_; }
  const T* end() const { return entries_ + size_; }
  T& last() { return entries_[size_ - 1]; }

  // Keeps the memory.
  void clear() { size_ = 0; }
  // Keeps the first `size` entries of more.
  void cut(int size) { size_ = size < size_ ? size : size_; }

  // False without memory; the list is then as it was, and the model is told.
  bool add(const T& entry) {
    const T copy = entry;  // it may be one of the list, which moves
    if (size_ == room_ && !reserve(size_ + 1)) return false;
    entries_[size_++] = copy;
    return true;
  }
  bool add(const T* entries, int count) {  // of another list
    if (!reserve(size_ + count)) return false;
    if (count > 0) memcpy(entries_ + size_, entries, static_cast<size_t>(count) * sizeof(T));
    size_ += count;
    return true;
  }
  // To that size; entries that were not there before are of any value.
  bool resize(int size) {
    if (!reserve(size)) return false;
    size_ = size;
    return true;
  }
  bool fill(int size, const T& entry) {
    const T copy = entry;
    if (!resize(size)) return false;
    for (int i = 0; i < size; ++i) entries_[i] = copy;
    return true;
  }
  // Room for so many.
  bool reserve(int size) {
    if (size <= room_) return true;
    int room = room_ > 0 ? room_ : FIRST_ROOM;
    while (room < size && room < (1 << 29)) room *= 2;
    void* grown = room < size ? nullptr : realloc(static_cast<void*>(entries_), static_cast<size_t>(room) * sizeof(T));
    if (grown == nullptr) {
      memory_->is_exhausted = true;
      return false;
    }
    entries_ = static_cast<T*>(grown);
    room_ = room;
    return true;
  }
  void remove(int i) {
    --size_;
    memmove(static_cast<void*>(entries_ + i), entries_ + i + 1, static_cast<size_t>(size_ - i) * sizeof(T));
  }

 private:
  // What the contacts of two or three pairs need: most steps ask for no more than the first that had a contact.
  static constexpr int FIRST_ROOM = sizeof(T) < 64 ? 512 / static_cast<int>(sizeof(T)) : 8;

  Memory* memory_;
  T* entries_ = nullptr;
  int size_ = 0;
  int room_ = 0;
};

}  // namespace shipcollision
