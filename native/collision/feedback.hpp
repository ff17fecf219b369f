// How each ship shows what it has applied: the twin of shipcollision_fmu/collision/feedback.py.
#pragma once

#include "interface.hpp"

namespace shipcollision {

constexpr size_t COMMON_FEEDBACK_COUNT = 4;
constexpr size_t SHIP_FEEDBACK_COUNT = 6;

// In the order of the enumerations; the first of a ship is the start value.
extern const char* const COMMON_FEEDBACKS[COMMON_FEEDBACK_COUNT];
extern const char* const SHIP_FEEDBACKS[SHIP_FEEDBACK_COUNT];

// The feedback of a ship, never `common`. False for an unknown one, and for two that differ.
bool choose_feedback(const char* name, const CollisionShipParameters& ship, CommonFeedback common, Feedback& chosen,
                     Text& why);

}  // namespace shipcollision
