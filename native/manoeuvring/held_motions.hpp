// The start of a ship with held motions: the twin of shipcollision_fmu/manoeuvring/held_motions.py.
#pragma once

#include "../numbers/text.hpp"
#include "../ship/degrees_of_freedom.hpp"

namespace shipcollision {

// Takes the held motions out of a start; the warning says what a heeled ship has lost by it. False, and why, for a held
// angle, and for a held velocity of an upright ship.
bool project_start(Six& eta, Six& nu, int degrees_of_freedom, Text& warning, Text& why);

}  // namespace shipcollision
