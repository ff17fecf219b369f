// The collision model's own copy of a ship or an obstacle: the twin of shipcollision_fmu/collision/dynamics/body_state.py.
//
// Where Python has None or NOTHING, a flag is false here, and the value is zero.
#pragma once

#include "../../ship/coasting.hpp"
#include "../../ship/degrees_of_freedom.hpp"

namespace shipcollision {

struct BodyState {
  Pose applied;      // the pose of application
  Pose predicted;    // x and R of the twin
  Pose pose_before;  // the predicted pose before it was last advanced
  Six nu;
  Six nu_received;
  Six nu_mean;    // nu + velocity_bias
  Six nu_path;    // nu_mean + path_bias
  Six nu_energy;  // nu + scheme_error
  Matrix M_inverse;
  Three r_bg;
  bool is_issued;  // whether anything was booked, be it zero
  Six issued;
  bool has_velocity_bias, has_scheme_error, has_path_bias, has_end_gain;
  Six velocity_bias, scheme_error, path_bias, end_gain;
  bool fixed;
  bool has_held;
  Rows held;

  // At a pose with the twist nu. Without CG it is CO; without `held_mobility`, no motion is held.
  void start_at(const Three& position, const Three& attitude, const Six& twist, const Matrix& inverse,
                const Three& centre = {}, const Rows* held_mobility = nullptr);
  // An obstacle.
  void start_wall(const Three& position, double heading);

  void set_twist(const Six& twist);
  // What other forces are expected to do: velocity_bias and scheme_error, null for none.
  void expect(const Six& bias, const Six* error);
  // end: where the law leads in H [s]; start: the twist at the pose of application from which it leads there.
  void follow(const Motion& end, const Six& start, double H);
  void book(const Six& J);
  Six twist_at_predicted_pose() const;

  void advance(double h, int substeps = 1);
  Pose predict_pose(double h) const;
  const BodyMotion& predicted_motion() const;
  Pose pose_after(const Six& twist, double h) const;
  void apply_at(const Pose& pose, const Matrix& inverse);
  Three in_body(const Three& p_n) const { return rotate_back(predicted.R, p_n - predicted.x); }

 private:
  BodyMotion motion_of(const Six& twist) const;
  Six carry_twist(const Rows& R, const Six& twist) const;

  mutable bool has_motion_;
  mutable BodyMotion motion_;
};

// Moves the predicted poses of some of the bodies, `count` of them by their numbers.
void advance_bodies(BodyState* states, const int* moving, int count, double h, int substeps = 1);

}  // namespace shipcollision
