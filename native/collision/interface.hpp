// Inputs, parameters and outputs of the collision model: the twin of shipcollision_fmu/collision/interface.py.
//
// Ships and contacts are added once, when the model is made, and stay at their place: the access layer of fmi/ keeps
// their addresses.
#pragma once

#include "../numbers/buffer.hpp"
#include "../ship/coasting_law.hpp"

namespace shipcollision {

constexpr int LEAST_POINTS = 8;
constexpr int POINTS_PER_SHIP = 4;
constexpr int MOST_POINTS = 64;

// Number of contact points in the outputs of a model of so many ships.
inline int contact_point_count(int ships) {
  const int count = POINTS_PER_SHIP * ships;
  return count < LEAST_POINTS ? LEAST_POINTS : count > MOST_POINTS ? MOST_POINTS : count;
}

// In the order of the items of their variables.
enum class Response { pgs, closed_form, bullet };
enum class CommonFeedback { ledger, force, state, none };
enum class Feedback { common, ledger, force, state, none, prescribed };

struct FenderParameters {
  double stiffness = 0.0;
  double damping = 0.0;
  double thickness = 0.0;
};

// ShipParameters of the twin; the ship model has others of this name.
struct CollisionShipParameters {
  char ship[LONGEST_STRING] = "kvlcc2";
  int degrees_of_freedom = 6;
  Coasting coasting = Coasting::kirchhoff;
  FenderParameters fender;
  Feedback feedback = Feedback::common;
  char feedback_name[LONGEST_STRING] = "";
};

struct CollisionParameters {
  explicit CollisionParameters(Memory& memory) : ships(memory) {}

  Buffer<CollisionShipParameters> ships;
  double friction = 0.3;
  double restitution = 0.0;
  double substep = 0.01;
  double minimum_separation_time = 10.0;
  double clearance_range = 200.0;
  Response response = Response::pgs;
  CommonFeedback feedback = CommonFeedback::ledger;
  char obstacles[LONGEST_STRING] = "";  // the path of a prepared file; empty for none
};

struct ShipState {
  Three position{};
  Three attitude{};
  Three velocity{};
  Three rate{};
  Six impulse_applied{};

  Six nu() const { return join(velocity, rate); }
};

struct ShipPost {
  Three position{};
  Three attitude{};
  Three velocity{};
  Three rate{};
  Six impulse{};
  Six force{};
};

struct ContactOutput {
  Three point{};
  Three normal{};
  Three r_a{};
  Three r_b{};
  Three impulse{};
  Three couple{};
  double gap = 0.0;
  double impulse_normal = 0.0;
  double impulse_tangential = 0.0;
  double energy = 0.0;
  int ship_a = 0;
  int ship_b = 0;
  int collision = 0;
  int scratch = 0;
  double start = 0.0;
  Three first{};
  double closing_speed = 0.0;
  double angle = 0.0;
};

// Before a collision begins, and where a fender acts, all is zero.
struct Impact {
  double time = 0.0;
  Three point{};
  double closing_speed = 0.0;
  double angle = 0.0;
  int ship_a = 0;
  int ship_b = 0;
};

struct EnergyOutput {
  double dissipated = 0.0;
  double normal = 0.0;
  double tangential = 0.0;
};

struct FenderOutput {
  double stored = 0.0;
  double dissipated = 0.0;
};

struct SolverOutput {
  double residual = 0.0;
  int sweeps = 0;
  int unconverged = 0;
  int scaled = 0;
};

struct DiagnosisOutput {
  int code = 0;
  int ship = 0;
  int count = 0;
  char text[LONGEST_STRING] = "";
};

struct CollisionInputs {
  explicit CollisionInputs(Memory& memory) : ships(memory) {}

  Buffer<ShipState> ships;
};

struct CollisionOutputs {
  explicit CollisionOutputs(Memory& memory) : ships(memory), contacts(memory) {}

  Buffer<ShipPost> ships;
  Buffer<ContactOutput> contacts;
  bool contact_active = false;
  int contact_count = 0;
  int collision_count = 0;
  Impact impact;
  int scratch_id = 0;
  EnergyOutput energy;
  FenderOutput fender;
  double clearance = 0.0;
  int nearest_ship_a = 0;
  int nearest_ship_b = 0;
  SolverOutput solver;
  DiagnosisOutput diagnosis;
};

}  // namespace shipcollision
