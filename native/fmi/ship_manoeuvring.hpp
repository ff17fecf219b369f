// The ship model as an FMU: the twin of shipcollision_fmu/fmi/ship_manoeuvring.py.
#pragma once

#include "../manoeuvring/model.hpp"
#include "model.hpp"

namespace shipcollision {

// The paths of the table lead to parameters, inputs and outputs of the ship model.
class ShipManoeuvringFmu : public Model {
 public:
  explicit ShipManoeuvringFmu(const char* resources);

  bool find(const char* path, int index, Place& place) override;
  bool initialise(Text& why) override { return ship_.initialise(why); }
  bool step(double t, double h, Text& why) override { return ship_.step(t, h, why); }
  size_t file_count() const override { return 1; }
  ReadFile file(size_t) const override { return {nullptr, "ship", ship_.parameters.ship, ship_.file_checksum()}; }
  size_t state_size() const override { return ShipManoeuvring::state_size(); }
  void get_state(void* bytes) const override { ship_.get_state(bytes); }
  bool set_state(const void* bytes, size_t size, Text& why) override { return ship_.set_state(bytes, size, why); }
  const Text& warning() const override { return ship_.warning; }

 private:
  ShipManoeuvring ship_;
};

}  // namespace shipcollision
