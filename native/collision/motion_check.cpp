#include "motion_check.hpp"

namespace shipcollision {
namespace {

constexpr double KNOT = 3600.0 / 1852.0;
constexpr double KILOMETRE_PER_HOUR = 3.6;
constexpr double DEGREE = PI / 180.0;

struct Plane {
  double n, e;
};

double size_of(const Plane& v) { return hypot(v.n, v.e); }
double distance(const Plane& a, const Plane& b) { return hypot(a.n - b.n, a.e - b.e); }

// The difference to the nearest whole turn [rad].
double remainder_of_turns(double angle) { return angle - 2.0 * PI * round(angle / (2.0 * PI)); }

Plane velocity_in_n(const Motion& motion) {
  const double roll = motion.attitude[0], pitch = motion.attitude[1], yaw = motion.attitude[2];
  const auto& [u, v, w] = motion.velocity.at;
  const double ahead = u * cos(pitch) + (v * sin(roll) + w * cos(roll)) * sin(pitch);
  const double abeam = v * cos(roll) - w * sin(roll);
  return {ahead * cos(yaw) - abeam * sin(yaw), ahead * sin(yaw) + abeam * cos(yaw)};
}

// Mean of the two velocities, in the plane of n.
Plane mean_velocity(const Motion& start, const Motion& end) {
  const Plane first = velocity_in_n(start), last = velocity_in_n(end);
  return {0.5 * (first.n + last.n), 0.5 * (first.e + last.e)};
}

double heading_rate(const Motion& motion) {
  const double roll = motion.attitude[0], pitch = motion.attitude[1];
  return (motion.rate[1] * sin(roll) + motion.rate[2] * cos(roll)) / max(cos(pitch), 0.1);
}

Motion in_degrees(const Motion& motion) {
  Motion turned = motion;
  turned.attitude = DEGREE * motion.attitude;
  return turned;
}

Finding explain_velocity(const Motion& start, const Motion& end, const Plane& moved, const Plane& given) {
  const double speed = size_of(moved);
  if (size_of(given) < 0.05 * speed) return Finding::no_velocity;
  const struct {  // of equal distances the first by its name
    double distance;
    Finding finding;
  } hypotheses[] = {
      {distance(moved, mean_velocity(in_degrees(start), in_degrees(end))), Finding::attitude_in_degrees},
      {distance(moved, {0.5 * (start.velocity[0] + end.velocity[0]), 0.5 * (start.velocity[1] + end.velocity[1])}),
       Finding::frame_of_the_velocity},
      {distance(moved, {given.n / KNOT, given.e / KNOT}), Finding::unit_of_the_velocity},
      {distance(moved, {given.n / KILOMETRE_PER_HOUR, given.e / KILOMETRE_PER_HOUR}), Finding::unit_of_the_velocity}};
  int nearest = 0;
  for (int k = 1; k < 4; ++k) {
    if (hypotheses[k].distance < hypotheses[nearest].distance) nearest = k;
  }
  return hypotheses[nearest].distance < 0.1 * SPEED_ERROR + 0.05 * speed ? hypotheses[nearest].finding
                                                                         : Finding::other_velocity;
}

Finding explain_rate(double turned, double rate) {
  if (abs(rate) < 0.05 * abs(turned)) {
    return abs(turned * DEGREE - rate) < SHARE * abs(rate) ? Finding::attitude_in_degrees : Finding::no_rate;
  }
  return abs(turned / DEGREE - rate) < SHARE * abs(rate) ? Finding::rate_in_degrees : Finding::other_rate;
}

}  // namespace

Verdict judge_motion(const TimedMotion& first, const TimedMotion& last) {
  const Motion &start = first.motion, &end = last.motion;
  const double T = last.t - first.t;
  const Plane moved{(end.position[0] - start.position[0]) / T, (end.position[1] - start.position[1]) / T};
  const Plane given = mean_velocity(start, end);
  const double off = distance(moved, given), fast = max(size_of(moved), size_of(given));
  Verdict verdict;
  Measured& measured = verdict.found.measured;
  measured.yaw = end.attitude[2];
  if (fast > SLOW && off > SPEED_ERROR + SHARE * fast) {
    measured.moved = size_of(moved);
    measured.given = hypot(end.velocity[0], end.velocity[1]);
    measured.off = off;
    measured.unit = size_of(given) < 2.5 * size_of(moved) ? "knots" : "km/h";
    verdict.found.finding = explain_velocity(start, end, moved, given);
    return verdict;
  }
  const bool is_right = fast > SLOW && abs(remainder_of_turns(end.attitude[2])) > 0.15;
  const double turned = remainder_of_turns(end.attitude[2] - start.attitude[2]) / T;
  const double rate = 0.5 * (heading_rate(start) + heading_rate(end));
  const double fast_turn = max(abs(turned), abs(rate));
  if (fast_turn > SLOW_TURN && abs(turned - rate) > RATE_ERROR + SHARE * fast_turn) {
    measured.moved = turned;
    measured.given = rate;
    verdict.found.finding = explain_rate(turned, rate);
    return verdict;
  }
  verdict.speed = is_right;
  verdict.rate = fast_turn > SLOW_TURN;
  return verdict;
}

}  // namespace shipcollision
