// The bodies of the collision model: the twin of shipcollision_fmu/collision/bodies.py.
#pragma once

#include "../ship/coasting_law.hpp"
#include "../ship/hull/solid.hpp"
#include "dynamics/body_state.hpp"
#include "fender.hpp"
#include "geometry/broad_phase.hpp"
#include "interface.hpp"
#include "prepared_obstacles.hpp"

namespace shipcollision {

struct Body {
  static void* operator new(size_t size) noexcept { return malloc(size); }
  static void operator delete(void* memory) { free(memory); }

  Text name;
  HullMesh hull;  // its reach counts from CO
  int degrees_of_freedom = 0;  // 0 for an obstacle
  Matrix upright_inverse{};
  bool has_held = false;
  Rows held{};
  Three r_bg{};
  bool has_fender = false;
  Fender fender{};
  double fender_thickness = 0.0;  // 0 without one
  bool has_coasting = false;      // else straight
  CoastingLaw coasting;
  Feedback feedback = Feedback::prescribed;  // an obstacle never answers
  bool is_wall = false;
  BodyState wall{};
  Rectangle rectangle{};  // where an obstacle stands

  // M^-1 in the free degrees of freedom at an attitude [rad].
  void inverse_at(const Three& attitude, Matrix& inverse) const {
    tilt_inverse(upright_inverse, degrees_of_freedom, attitude[0], attitude[1], inverse);
  }
  // The motion after H [s] by the law of the ship. False where it refuses it, with the name of the ship in front.
  bool coast(const Motion& before, double H, Motion& after, Text& why) const {
    return coasting.coast(before, H, after, why) || refuse_by_name(why);
  }
  bool refuse_by_name(Text& why) const;
  // Bound [m/s] of the speed of any point of the hull, in the mean over the step.
  double largest_speed(const BodyState& state) const {
    if (state.fixed) return 0.0;
    return norm(first_three(state.nu_path)) + norm(last_three(state.nu_path)) * hull.reach;
  }
};

// The ships in the order of the build, then the obstacles.
class Bodies {
 public:
  explicit Bodies(Memory& memory) : memory_(memory), bodies_(memory), checksums_(memory) {}
  ~Bodies() { clear(); }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  // What the parameters ask for. names, feedbacks: of the ships; files are looked for in `directory` first.
  bool prepare(const char* const* names, const CollisionParameters& parameters, const Feedback* feedbacks,
               const char* directory, Text& why);

  int size() const { return bodies_.size(); }
  int ships() const { return ships_; }
  // Checksums of the files: of each ship, then of the obstacles, 0 without any.
  const Buffer<uint32_t>& checksums() const { return checksums_; }
  Body& operator[](int i) { return *bodies_[i]; }
  const Body& operator[](int i) const { return *bodies_[i]; }

 private:
  void clear();
  Body* add(Text& why);
  bool add_ship(const char* name, const CollisionShipParameters& parameters, Feedback feedback, const char* directory,
                PreparedShip& ship, Text& why);
  bool add_wall(PreparedObstacles& obstacles, Text& why);

  Memory& memory_;
  Buffer<Body*> bodies_;
  Buffer<uint32_t> checksums_;
  int ships_ = 0;
};

}  // namespace shipcollision
