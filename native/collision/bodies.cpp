#include "bodies.hpp"

#include <string.h>

#include "../ship/prepared_ship.hpp"

namespace shipcollision {
namespace {

// M^-1 - M_free^-1 in heave, roll and pitch.
Rows find_held_mobility(const PreparedShip& ship, int degrees_of_freedom) {
  const Matrix &whole = ship.inverse(6), &free = ship.inverse(degrees_of_freedom);
  Rows held;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) held.at[i][j] = whole[2 + i][2 + j] - free[2 + i][2 + j];
  }
  return held;
}

// A ship that does not float upright, or whose buoyancy cannot be estimated, is expected to move without buoyancy.
bool predict_coasting(const PreparedShip& ship, const CollisionShipParameters& parameters, Body& body, Text& why) {
  body.has_coasting = parameters.coasting != Coasting::straight;
  Text refusal;
  return !body.has_coasting ||
         body.coasting.set_up(ship, parameters.degrees_of_freedom, parameters.coasting, refusal) ||
         body.coasting.set_up(ship, parameters.degrees_of_freedom, Coasting::free, why);
}

Rectangle find_rectangle(const HullMesh& solid, const BodyState& wall) {
  Rectangle found{1e300, -1e300, 1e300, -1e300};
  for (int i = 0; i < solid.corner_count(); ++i) {
    const Three corner = wall.predicted.x + rotate(wall.predicted.R, solid.corners()[i]);
    found = {min(found.north_from, corner[0]), max(found.north_to, corner[0]), min(found.east_from, corner[1]),
             max(found.east_to, corner[1])};
  }
  return found;
}

}  // namespace

bool Body::refuse_by_name(Text& why) const {
  const Text said = why;
  why.clear();
  why << name << ": " << said;
  return false;
}

bool Bodies::prepare(const char* const* names, const CollisionParameters& parameters, const Feedback* feedbacks,
                     const char* directory, Text& why) {
  clear();
  PreparedShip* ship = new PreparedShip;
  if (ship == nullptr) {
    why << "there is no memory for the ships";
    return false;
  }
  bool is_done = true;
  for (int i = 0; i < parameters.ships.size() && is_done; ++i) {
    is_done = add_ship(names[i], parameters.ships[i], feedbacks[i], directory, *ship, why);
  }
  delete ship;
  if (!is_done) return false;
  ships_ = bodies_.size();
  PreparedObstacles obstacles;
  if (!obstacles.open(parameters.obstacles, directory, why)) return false;
  for (int i = 0; i < obstacles.count(); ++i) {
    if (!add_wall(obstacles, why)) return false;
  }
  checksums_.add(obstacles.checksum());
  return true;
}

void Bodies::clear() {
  for (Body* body : bodies_) delete body;
  bodies_.clear();
  checksums_.clear();
  ships_ = 0;
}

Body* Bodies::add(Text& why) {
  Body* body = new Body;
  if (body != nullptr && bodies_.add(body)) return body;
  delete body;
  memory_.is_exhausted = true;
  why << "there is no memory for the bodies";
  return nullptr;
}

bool Bodies::add_ship(const char* name, const CollisionShipParameters& parameters, Feedback feedback,
                      const char* directory, PreparedShip& ship, Text& why) {
  Body* body = add(why);
  if (body == nullptr) return false;
  Text unread, fender_name;
  if (!load_prepared_ship(parameters.ship, directory, ship, unread, &body->hull)) {
    why << name << ".ship: " << unread;
    return false;
  }
  if (!ship.hull_refusal.is_empty()) {
    why << name << ".ship: " << ship.hull_refusal;
    return false;
  }
  const int free = parameters.degrees_of_freedom;
  if (free != 3 && free != 4 && free != 6) {
    why << name << ".degrees_of_freedom = " << free << " must be 3 (surge, sway, yaw), 4 (and roll) or 6 (all)";
    return false;
  }
  checksums_.add(ship.checksum);
  body->name << name;
  body->degrees_of_freedom = free;
  body->feedback = feedback;
  body->r_bg = ship.r_bg;
  if (feedback != Feedback::prescribed) {  // else no impulse changes its motion
    memcpy(body->upright_inverse, ship.inverse(free), sizeof(Matrix));
    body->has_held = free != 6;
    if (body->has_held) body->held = find_held_mobility(ship, free);
  }
  const FenderParameters& fender = parameters.fender;
  body->fender = {fender.stiffness, fender.damping, fender.thickness};
  fender_name << name << ".fender";
  if (!build_fender(fender_name.get(), body->fender, body->has_fender, why)) return false;
  body->fender_thickness = body->has_fender ? body->fender.thickness : 0.0;
  return predict_coasting(ship, parameters, *body, why);
}

bool Bodies::add_wall(PreparedObstacles& obstacles, Text& why) {
  Obstacle obstacle;
  Body* body = add(why);
  if (body == nullptr || !obstacles.next(obstacle, body->hull, why)) return false;
  for (int i = 0; i < ships_; ++i) {
    if (strcmp(bodies_[i]->name.get(), obstacle.name.get()) != 0) continue;
    why << "obstacles: ";
    why.quote(obstacle.name.get()) << " is the name of a ship: give the obstacle another name";
    return false;
  }
  body->name = obstacle.name;
  body->has_fender = obstacle.has_fender;
  body->fender = obstacle.fender;
  body->fender_thickness = body->has_fender ? body->fender.thickness : 0.0;
  body->is_wall = true;
  body->wall.start_wall(obstacle.position, obstacle.heading);
  body->rectangle = find_rectangle(body->hull, body->wall);
  return true;
}

}  // namespace shipcollision
