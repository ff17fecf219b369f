#include "held_motions.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {
namespace {

constexpr double ROUNDING = 1e-6;
constexpr int ROLL = 3, PITCH = 4;
constexpr const char* NAMES[6] = {"surge velocity", "sway velocity", "heave velocity",
                                  "roll rate",      "pitch rate",    "yaw rate"};

bool refuse(const char* name, double value, int degrees_of_freedom, Text& why) {
  why << "initial " << name << " = ";
  why.short_number(value) << " must be 0 with hydrodynamics = true in " << degrees_of_freedom
                          << " degrees of freedom, which hold it: set it to 0, or degrees_of_freedom = 6";
  return false;
}

}  // namespace

bool project_start(Six& eta, Six& nu, int degrees_of_freedom, Text& warning, Text& why) {
  warning.clear();
  if (degrees_of_freedom == 6) return true;
  for (int k = degrees_of_freedom == 3 ? ROLL : PITCH; k <= PITCH; ++k) {
    if (abs(eta[k]) > ROUNDING) {
      return refuse(k == ROLL ? "roll angle" : "pitch angle", eta[k], degrees_of_freedom, why);
    }
  }
  if (degrees_of_freedom != 4) eta[ROLL] = 0.0;
  eta[PITCH] = 0.0;
  Six nu_l = to_level(nu, eta[ROLL]);
  bool is_held = false, is_lost = false;
  for (int k = 0; k < 6; ++k) {
    if (is_free(degrees_of_freedom, k) || nu_l[k] == 0.0) continue;
    is_held = true;
    if (abs(nu_l[k]) > ROUNDING) {
      if (eta[ROLL] == 0.0) return refuse(NAMES[k], nu_l[k], degrees_of_freedom, why);
      warning << (is_lost ? " and " : "initial ") << NAMES[k] << " = ";
      warning.short_number(nu_l[k]);
      is_lost = true;
    }
    nu_l[k] = 0.0;
  }
  if (is_lost) {
    warning << " in level axes left out: " << degrees_of_freedom
            << " degrees of freedom hold it; the level surge, sway, yaw rate and roll rate are kept";
  }
  if (is_held) nu = from_level(nu_l, eta[ROLL]);
  return true;
}

}  // namespace shipcollision
