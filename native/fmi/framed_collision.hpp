// The collision model for ship models that give their velocity, or take a force, in n: the twin of
// shipcollision_fmu/fmi/framed_collision.py.
#pragma once

#include "../collision/model.hpp"

namespace shipcollision {

// Frame of a ship's velocity and rate, and that of its force and moment: "b" or "n".
struct Frames {
  char velocity[LONGEST_STRING] = "b";
  char force[LONGEST_STRING] = "b";
};

// A collision model with the parameter `frames`, one for each ship.
class FramedCollision {
 public:
  FramedCollision() = default;
  FramedCollision(const FramedCollision&) = delete;
  FramedCollision& operator=(const FramedCollision&) = delete;

  ShipCollision collision;

 private:
  Memory memory_;  // before what needs it

 public:
  Buffer<Frames> frames{memory_};

  bool name_ships(const char* const* names, int count, Text& why);
  // False for a frame that is neither b nor n as well.
  bool initialise(Text& why);
  bool step(double t, double H, Text& why);

 private:
  struct InN {
    bool velocity;
    bool force;
  };
  struct Given {
    Three velocity;
    Three rate;
  };

  // The inputs in b for as long as the model reads them; then again as the host has set them.
  void turn_velocities(const InN* in_n);
  void put_velocities_back(const InN* in_n);

  Buffer<InN> in_n_{memory_};
  Buffer<InN> chosen_{memory_};
  Buffer<Given> given_{memory_};
};

}  // namespace shipcollision
