// Values as bytes and back, within bounds: what saved states are written and read by. Byte order is the machine's, and
// all machines of ours have the same.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "buffer.hpp"

namespace shipcollision {

// Counts bytes, and writes them where it was given memory for them.
class ByteWriter {
 public:
  ByteWriter() = default;
  ByteWriter(void* bytes, size_t capacity) : bytes_(static_cast<unsigned char*>(bytes)), capacity_(capacity) {}

  size_t size() const { return size_; }

  void put(const void* data, size_t size) {
    if (size_ + size <= capacity_) memcpy(bytes_ + size_, data, size);
    size_ += size;
  }
  template <typename T>
  void value(const T& value) {
    put(&value, sizeof value);
  }
  template <typename... T>
  void values(const T&... each) {
    (value(each), ...);
  }
  void text(const char* text) {
    const uint32_t size = static_cast<uint32_t>(strlen(text));
    value(size);
    put(text, size);
  }
  // The number of entries, and their bytes.
  template <typename T>
  void list(const Buffer<T>& entries) {
    value(entries.size());
    if (!entries.is_empty()) put(entries.data(), static_cast<size_t>(entries.size()) * sizeof(T));
  }
  // Room for bytes that someone else writes; null while only counting.
  unsigned char* room(size_t size) {
    unsigned char* found = size_ + size <= capacity_ ? bytes_ + size_ : nullptr;
    size_ += size;
    return found;
  }

 private:
  unsigned char* bytes_ = nullptr;
  size_t capacity_ = 0;
  size_t size_ = 0;
};

// Reads what a ByteWriter wrote; false, and nothing is read, where that cannot be.
class ByteReader {
 public:
  ByteReader(const void* bytes, size_t size) : next_(static_cast<const unsigned char*>(bytes)), left_(size) {}

  size_t left() const { return left_; }
  const unsigned char* next() const { return next_; }

  const unsigned char* take(size_t size) {
    if (size > left_) return nullptr;
    const unsigned char* found = next_;
    next_ += size;
    left_ -= size;
    return found;
  }
  template <typename T>
  bool value(T& value) {
    const unsigned char* found = take(sizeof value);
    if (found != nullptr) memcpy(&value, found, sizeof value);
    return found != nullptr;
  }
  bool value(bool& value) { return flag(value); }
  template <typename... T>
  bool values(T&... each) {
    return (value(each) && ...);
  }
  bool flag(bool& value) {
    unsigned char read;
    if (!this->value(read) || read > 1) return false;
    value = read == 1;
    return true;
  }
  // False without memory as well.
  template <typename T>
  bool list(Buffer<T>& entries) {
    int count;
    if (!value(count) || count < 0 || static_cast<size_t>(count) > left_ / sizeof(T) || !entries.resize(count)) {
      return false;
    }
    if (count > 0) memcpy(static_cast<void*>(entries.data()), take(static_cast<size_t>(count) * sizeof(T)),
                          static_cast<size_t>(count) * sizeof(T));
    return true;
  }
  // A text shorter than `capacity`, with a zero after it.
  bool text(char* into, size_t capacity) {
    uint32_t size;
    if (!value(size) || size >= capacity) return false;
    const unsigned char* found = take(size);
    if (found == nullptr || memchr(found, '\0', size) != nullptr) return false;
    memcpy(into, found, size);
    into[size] = '\0';
    return true;
  }

 private:
  const unsigned char* next_;
  size_t left_;
};

}  // namespace shipcollision
