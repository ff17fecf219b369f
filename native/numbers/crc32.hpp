// The checksum of zlib and PNG.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace shipcollision {

uint32_t crc32(const void* bytes, size_t size);

}  // namespace shipcollision
