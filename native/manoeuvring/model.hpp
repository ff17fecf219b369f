// The motion of one ship: the twin of shipcollision_fmu/manoeuvring/model.py.
#pragma once

#include <stdint.h>

#include "../memory.hpp"
#include "../numbers/text.hpp"
#include "interface.hpp"

namespace shipcollision {

// Fill parameters and inputs, then initialise(), then step(t, h) again and again. Calls that can be refused return
// false and say why; everything is then as it was.
class ShipManoeuvring : public OnHeap {
 public:
  struct State;  // the whole state: a value without pointers, whose bytes may be kept

  ShipManoeuvring();
  ~ShipManoeuvring();
  ShipManoeuvring(const ShipManoeuvring&) = delete;
  ShipManoeuvring& operator=(const ShipManoeuvring&) = delete;

  char directory[LONGEST_STRING] = "";  // where prepared ships are looked for
  ShipParameters parameters;
  ShipInputs inputs;
  ShipOutputs outputs;
  Text warning;  // what was not as it should be at the start, until the first step

  bool initialise(Text& why);
  bool step(double t, double h, Text& why);

  // Checksum of the ship's file. To be called after initialise().
  uint32_t file_checksum() const;

  // The state as bytes; size 0 before initialise().
  static size_t state_size();
  size_t get_state(void* bytes) const;
  bool set_state(const void* bytes, size_t size, Text& why);

 private:
  struct SetUp;

  // The set-up for the parameters, this model's own while they are unchanged.
  bool prepare(SetUp*& prepared, Text& why) const;
  void keep(SetUp* prepared);
  // Where there is no memory for a state, false; what was prepared for it is then given up.
  bool reserve_state(SetUp* prepared, Text& why);
  void give_up(SetUp* prepared) const;
  bool find_start(const SetUp& set_up, State& start, Text& warned, Text& why) const;
  void publish(const State& state);

  SetUp* set_up_;
  State* state_;
};

}  // namespace shipcollision
