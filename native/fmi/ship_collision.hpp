// The collision model as an FMU: the twin of shipcollision_fmu/fmi/ship_collision.py.
#pragma once

#include "framed_collision.hpp"
#include "model.hpp"

namespace shipcollision {

// The paths of the table lead to parameters, inputs and outputs of the collision model, and to frames.
class ShipCollisionFmu : public Model {
 public:
  // To be called once, before all else.
  bool set_up(const Variables& variables, const char* resources, Text& why);

  bool find(const char* path, int index, Place& place) override;
  bool asks_for_inputs_set() const override { return true; }
  void forget_inputs_set() override;
  void note_input_set(const char* path) override;
  size_t file_count() const override { return static_cast<size_t>(framed_.collision.ship_count()) + 1; }
  ReadFile file(size_t i) const override;
  void forget_files() override { framed_.collision.forget_files(); }
  bool initialise(Text& why) override { return framed_.initialise(why); }
  bool step(double t, double h, Text& why) override { return framed_.step(t, h, why); }
  size_t state_size() const override { return framed_.collision.state_size(); }
  void get_state(void* bytes) const override { framed_.collision.get_state(bytes, state_size()); }
  bool set_state(const void* bytes, size_t size, Text& why) override {
    return framed_.collision.set_state(bytes, size, why);
  }
  const Text& warning() const override { return framed_.collision.warning; }
  size_t event_count() const override { return static_cast<size_t>(framed_.collision.event_count()); }
  const char* event(size_t i) const override { return framed_.collision.event(static_cast<int>(i)); }

 private:
  FramedCollision framed_;
};

}  // namespace shipcollision
