#include "body_state.hpp"

#include <string.h>

#include "chord.hpp"

namespace shipcollision {

void BodyState::start_at(const Three& position, const Three& attitude, const Six& twist, const Matrix& inverse,
                         const Three& centre, const Rows* held_mobility) {
  *this = BodyState{};
  applied = predicted = pose_before = {position, rotation_rows(attitude[0], attitude[1], attitude[2])};
  memcpy(M_inverse, inverse, sizeof M_inverse);
  r_bg = centre;
  has_held = held_mobility != nullptr;
  if (has_held) held = *held_mobility;
  nu_received = twist;
  set_twist(twist);
}

void BodyState::start_wall(const Three& position, double heading) {
  const Matrix nothing{};
  start_at(position, {{0.0, 0.0, heading}}, {}, nothing);
  fixed = true;
}

void BodyState::set_twist(const Six& twist) {
  nu = twist;
  nu_mean = has_velocity_bias ? nu + velocity_bias : nu;
  nu_path = has_path_bias ? nu_mean + path_bias : nu_mean;
  nu_energy = has_scheme_error ? nu + scheme_error : nu;
  has_motion_ = false;
}

void BodyState::expect(const Six& bias, const Six* error) {
  has_velocity_bias = true;
  velocity_bias = bias;
  has_scheme_error = error != nullptr;
  scheme_error = has_scheme_error ? *error : Six{};
  set_twist(nu);
}

void BodyState::follow(const Motion& end, const Six& start, double H) {
  const Chord chord = find_chord(applied, end.position, end.attitude, r_bg, start, H);
  const Six bias = chord.twist - start;
  if (has_velocity_bias) {
    velocity_bias = velocity_bias + bias;
  } else {
    path_bias = bias;
    has_path_bias = true;
  }
  end_gain = join(end.velocity, end.rate) - chord.carried;
  has_end_gain = true;
  set_twist(nu);
}

void BodyState::book(const Six& J) {
  is_issued = true;
  issued = issued + J;
  set_twist(nu + multiply(M_inverse, J));
}

Six BodyState::twist_at_predicted_pose() const {
  const Six carried = carry_twist(predicted.R, nu);
  return has_end_gain ? carried + end_gain : carried;
}

void BodyState::advance(double h, int substeps) {
  for (int i = 0; i < substeps; ++i) {
    pose_before = predicted;
    predicted = predict_pose(h);
  }
}

Pose BodyState::predict_pose(double h) const { return coast_pose(predicted, predicted_motion(), r_bg, h); }

const BodyMotion& BodyState::predicted_motion() const {
  if (!has_motion_) {
    motion_ = motion_of(nu_path);
    has_motion_ = true;
  }
  return motion_;
}

Pose BodyState::pose_after(const Six& twist, double h) const {
  Six path = twist;
  if (has_velocity_bias) path = path + velocity_bias;
  if (has_path_bias) path = path + path_bias;
  return coast_pose(applied, motion_of(path), r_bg, h);
}

void BodyState::apply_at(const Pose& pose, const Matrix& inverse) {
  const Rows& R = pose.R;
  Six twist = carry_twist(R, nu);
  if (has_velocity_bias) velocity_bias = carry_twist(R, velocity_bias);
  if (has_scheme_error) scheme_error = carry_twist(R, scheme_error);
  if (has_end_gain) {
    twist = twist + end_gain;
    path_bias = (has_path_bias ? carry_twist(R, path_bias) : Six{}) - end_gain;
    has_path_bias = true;
    has_end_gain = false;
    end_gain = {};
  }
  applied = pose;
  memcpy(M_inverse, inverse, sizeof M_inverse);
  set_twist(twist);
}

BodyMotion BodyState::motion_of(const Six& twist) const {
  const Three v = first_three(twist), omega = last_three(twist);
  if (is_same(omega, Three{})) return {rotate(applied.R, v), {}, false};
  return {rotate(applied.R, v + cross(omega, r_bg)), rotate(applied.R, omega), true};
}

Six BodyState::carry_twist(const Rows& R, const Six& twist) const {
  if (is_same(R, applied.R)) return twist;
  const Three omega = last_three(twist);
  const Rows back = turn_back(R, applied.R);
  const Three omega_now = rotate(back, omega);
  return join(rotate(back, first_three(twist) + cross(omega, r_bg)) - cross(omega_now, r_bg), omega_now);
}

void advance_bodies(BodyState* states, const int* moving, int count, double h, int substeps) {
  for (int i = 0; i < count; ++i) states[moving[i]].advance(h, substeps);
}

}  // namespace shipcollision
