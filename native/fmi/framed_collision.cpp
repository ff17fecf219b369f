#include "framed_collision.hpp"

#include <string.h>

namespace shipcollision {
namespace {

bool is_n(const char* frame) { return strcmp(frame, "n") == 0; }

bool check_frame(const char* name, const char* of, const char* frame, Text& why) {
  if (is_n(frame) || strcmp(frame, "b") == 0) return true;
  why << name << "." << of << "_frame = ";
  why.quote(frame) << " must be 'b' (body) or 'n' (north, east, down)";
  return false;
}

Rows rotation(const Three& attitude) { return rotation_rows(attitude[0], attitude[1], attitude[2]); }

}  // namespace

bool FramedCollision::name_ships(const char* const* names, int count, Text& why) {
  if (!collision.name_ships(names, count, why)) return false;
  if (frames.fill(count, Frames()) && in_n_.fill(count, InN()) && chosen_.fill(count, InN()) &&
      given_.fill(count, Given())) {
    return true;
  }
  why << "there is no memory for the ships";
  return false;
}

bool FramedCollision::initialise(Text& why) {
  for (int i = 0; i < frames.size(); ++i) {
    const char* name = collision.name(i);
    if (!check_frame(name, "velocity", frames[i].velocity, why) || !check_frame(name, "force", frames[i].force, why)) {
      return false;
    }
    chosen_[i] = {is_n(frames[i].velocity), is_n(frames[i].force)};
  }
  turn_velocities(chosen_.data());
  const bool is_done = collision.initialise(why);
  put_velocities_back(chosen_.data());
  for (int i = 0; is_done && i < in_n_.size(); ++i) in_n_[i] = chosen_[i];
  return is_done;
}

bool FramedCollision::step(double t, double H, Text& why) {
  turn_velocities(in_n_.data());
  const bool is_done = collision.step(t, H, why);
  put_velocities_back(in_n_.data());
  if (!is_done) return false;
  for (int i = 0; i < in_n_.size(); ++i) {
    if (!in_n_[i].force) continue;
    ShipPost& out = collision.outputs.ships[i];
    const Rows R = rotation(out.attitude);
    const Six& force = out.force;
    out.force = join(rotate(R, {{force[0], force[1], force[2]}}), rotate(R, {{force[3], force[4], force[5]}}));
  }
  return true;
}

void FramedCollision::turn_velocities(const InN* in_n) {
  for (int i = 0; i < given_.size(); ++i) {
    if (!in_n[i].velocity) continue;
    ShipState& ship = collision.inputs.ships[i];
    const Rows R = rotation(ship.attitude);
    given_[i] = {ship.velocity, ship.rate};
    ship.velocity = rotate_back(R, ship.velocity);
    ship.rate = rotate_back(R, ship.rate);
  }
}

void FramedCollision::put_velocities_back(const InN* in_n) {
  for (int i = 0; i < given_.size(); ++i) {
    if (!in_n[i].velocity) continue;
    collision.inputs.ships[i].velocity = given_[i].velocity;
    collision.inputs.ships[i].rate = given_[i].rate;
  }
}

}  // namespace shipcollision
