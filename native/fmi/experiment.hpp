// The experiment that a host has set up: the twin of shipcollision_fmu/fmi/experiment.py.
#pragma once

#include "../numbers/text.hpp"

namespace shipcollision {

// Start, stop and present time of an instance [s]: a value whose bytes may be kept.
class Experiment {
 public:
  // A warning about a stop that is none, or nothing.
  void set_up(double start, bool has_stop, double stop, Text& warning);
  // A warning, once, about a step that does not begin where the last one ended. False for one that ends after the stop.
  bool check_step(double t, double h, Text& warning, Text& why) const;
  // The step was made, and its warning given.
  void finish_step(double t, double h, bool is_warned);

  double time = 0.0;  // end of the last step; before the first step the start

  template <typename Writer>
  void save(Writer& bytes) const {
    bytes.value(time), bytes.value(stop_), bytes.value(latest_), bytes.value(begun_), bytes.value(warned_);
  }
  template <typename Reader>
  bool restore(Reader& bytes) {
    return bytes.value(time) && bytes.value(stop_) && bytes.value(latest_) && bytes.flag(begun_) && bytes.flag(warned_);
  }

 private:
  double stop_ = 0.0;
  double latest_ = __builtin_inf();  // the stop, rounding allowed for
  bool begun_ = false;               // time is known from the host
  bool warned_ = false;
};

}  // namespace shipcollision
