#include "experiment.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {

namespace {

// Share of the span, or of the stop time, by which a step may end late. Smaller: hosts that add up their steps lose the
// last one. Larger: a host with very small steps makes one too many.
constexpr double ROUNDING = 1e-9;
// Share of a step by which it may begin early or late. Smaller: hosts that count whole nanoseconds are warned.
constexpr double GAP = 1e-3;

}  // namespace

void Experiment::set_up(double start, bool has_stop, double stop, Text& warning) {
  time = start;
  begun_ = true;
  if (has_stop && !(stop > start)) {
    warning << "stop time ";
    warning.short_number(stop) << " s is not after the start time ";
    warning.short_number(start) << " s and is ignored";
    has_stop = false;
  }
  stop_ = has_stop ? stop : 0.0;
  latest_ = has_stop ? stop + ROUNDING * max(stop - start, abs(stop)) : __builtin_inf();
}

bool Experiment::check_step(double t, double h, Text& warning, Text& why) const {
  if (t + h > latest_) {
    why << "a step from t = ";
    why.short_number(t) << " s by ";
    why.short_number(h) << " s ends after the stop time ";
    why.short_number(stop_) << " s of the experiment: end there, or set the experiment up without a stop time";
    return false;
  }
  if (warned_ || !begun_ || abs(t - time) <= GAP * h) return true;
  warning << "a step begins at t = ";
  warning.short_number(t) << " s, but the last one ended at ";
  warning.short_number(time) << " s: ships and collision then lose count of the time; step from where the last step "
                             << "ended, or restore a state";
  return true;
}

void Experiment::finish_step(double t, double h, bool is_warned) {
  warned_ = warned_ || is_warned;
  time = t + h;
  begun_ = true;
}

}  // namespace shipcollision
