#include "work_limit.hpp"

namespace shipcollision {

namespace {

constexpr double FOUR_SHIPS = 30000.0;
constexpr double FURTHER_SHIP = 15000.0;
constexpr double SHARE = 0.4;

}  // namespace

void StepWork::renew(int ships, double H) {
  left_ = (FOUR_SHIPS + FURTHER_SHIP * max(0.0, ships - 4.0)) * max(1.0, H / STEP);
}

WorkLimit StepWork::lend() const { return {SHARE * left_}; }

void StepWork::settle(const WorkLimit& lent) {
  if (left_ < INFINITE) left_ = max(0.0, left_ - max(0.0, SHARE * left_ - lent.left));
}

}  // namespace shipcollision
