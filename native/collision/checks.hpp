// Refusals of the collision model: the twin of shipcollision_fmu/collision/checks.py.
#pragma once

#include "bodies.hpp"

namespace shipcollision {

constexpr double MAXIMUM_FRICTION = 10.0;
constexpr double ABSURD_SPEED = 1e3;
constexpr double ABSURD_PLACE = 1e9;

// False on a parameter out of its range, and on a response that stays with Python.
bool check_parameters(const CollisionParameters& p, Text& why);
// False on a time, a step or a ship's state that is not finite, or absurd.
bool check_step(double t, double H, const Bodies& bodies, const CollisionInputs& inputs, Text& why);
bool check_states(double t, const Bodies& bodies, const CollisionInputs& inputs, Text& why);
// False where the impulse that is pending is absurd. nu: the twist with it; applied: impulse_applied, which made it so.
bool check_pending(double t, const Body& body, const Six& nu, const Six& applied, Text& why);

}  // namespace shipcollision
