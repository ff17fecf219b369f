// Reals as Python's float.hex() writes them: exact, and the same in every locale.
#pragma once

namespace shipcollision {

// Reads a real at `text` and moves on to what follows it. False for other text, and `text` stays.
bool read_hexadecimal(const char*& text, double& number);

}  // namespace shipcollision
