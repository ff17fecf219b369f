// How a ship moves between impulses when no manoeuvring model moves it: the twin of
// shipcollision_fmu/ship/coasting_law.py. One class serves the three laws, which Python has in a class each.
#pragma once

#include "../numbers/text.hpp"
#include "coasting.hpp"
#include "damping.hpp"
#include "kirchhoff_plane.hpp"
#include "kirchhoff_space.hpp"
#include "prepared_ship.hpp"
#include "restoring.hpp"

namespace shipcollision {

enum class Coasting { kirchhoff, free, straight };

class CoastingLaw {
 public:
  // False for a ship that does not float upright.
  bool set_up(const PreparedShip& ship, int degrees_of_freedom, Coasting law, Text& why);

  // The motion after h [s]. False for a step that is too long for the motion.
  bool coast(const Motion& before, double h, Motion& after, Text& why) const;
  // Whether the ship goes straight on without turning.
  bool is_straight(const Motion& motion) const;
  // A ship that goes ahead, upright, goes straight on.
  bool keeps_course() const { return keeps_course_; }

 private:
  enum class Kind { straight, plane, space };

  bool set_up_sea(const PreparedShip& ship, int degrees_of_freedom, Text& why);
  void set_up_plane(const PreparedShip& ship, int degrees_of_freedom);
  void set_up_space(const PreparedShip& ship);
  bool coast_in_plane(const Motion& before, double h, Motion& after, Text& why) const;
  bool coast_in_space(const Motion& before, double h, Motion& after, Text& why) const;
  bool count(double h, double turning, int& n, Text& why) const;
  Four kick(const Four& nu, double phi, double dt) const;
  Six kick(const Six& nu, double z, const Three& down, double dt) const;

  Kind kind_;
  bool keeps_course_;
  bool has_sea_;
  Restoring restoring_;
  Damping damping_;
  double fastest_;  // oscillation [rad/s]
  Three centre_;    // of the straight motion
  KirchhoffPlane plane_;
  KirchhoffSpace space_;
  double radius_, roll_radius_;  // of gyration [m]
  bool rolls_, is_isotropic_;
  double roll_mobility_;
};

}  // namespace shipcollision
