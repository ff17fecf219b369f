// Polynomial x^32 + x^26 + x^23 + x^22 + x^16 + x^12 + x^11 + x^10 + x^8 + x^7 + x^5 + x^4 + x^2 + x + 1, its bits in
// reverse order.
#include "crc32.hpp"

namespace shipcollision {
namespace {

constexpr uint32_t POLYNOMIAL = 0xedb88320;

struct Table {
  uint32_t of[256];
};

constexpr Table make_table() {
  Table table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t rest = i;
    for (int bit = 0; bit < 8; ++bit) rest = rest & 1 ? rest >> 1 ^ POLYNOMIAL : rest >> 1;
    table.of[i] = rest;
  }
  return table;
}

constexpr Table TABLE = make_table();

}  // namespace

uint32_t crc32(const void* bytes, size_t size) {
  const unsigned char* at = static_cast<const unsigned char*>(bytes);
  uint32_t rest = 0xffffffff;
  for (size_t i = 0; i < size; ++i) rest = rest >> 8 ^ TABLE.of[(rest ^ at[i]) & 0xff];
  return ~rest;
}

}  // namespace shipcollision
