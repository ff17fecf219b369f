// The collision model: the twin of shipcollision_fmu/collision/model.py.
#pragma once

#include "../memory.hpp"
#include "../numbers/bytes.hpp"
#include "geometry/broad_phase.hpp"
#include "interface.hpp"

namespace shipcollision {

// Name the ships, fill parameters and inputs, then initialise(), then step(t, H) again and again. Calls that can be
// refused return false and say why; everything is then as it was.
class ShipCollision : public OnHeap {
 private:
  Memory memory_;  // before what needs it

 public:
  ShipCollision();
  ~ShipCollision();
  ShipCollision(const ShipCollision&) = delete;
  ShipCollision& operator=(const ShipCollision&) = delete;

  // To be called once, before all else.
  bool name_ships(const char* const* names, int count, Text& why);
  int ship_count() const { return names_.size(); }
  const char* name(int ship) const { return names_[ship]; }

  char directory[LONGEST_STRING] = "";  // where prepared ships are looked for
  CollisionParameters parameters{memory_};
  CollisionInputs inputs{memory_};
  CollisionOutputs outputs{memory_};
  Text warning;  // what was not as it should be in the last step

  // Takes in of which ships any state was ever set. Without a call all ships are there.
  void note_state_set(int ship, bool is_set) { is_absent_[ship] = !is_set; }

  // Prepared files stay read while the parameters that name them do. After this call initialise() reads them again.
  void forget_files() { has_old_files_ = true; }
  bool initialise(Text& why);
  bool step(double t, double H, Text& why);

  // Checksums of the files that were read: of each ship, then of the obstacles. To be called after initialise().
  uint32_t file_checksum(int file) const;

  // A line about each collision that began in the last step.
  int event_count() const;
  const char* event(int i) const;

  // What the outputs do not show, as bytes; size 0 before initialise().
  size_t state_size() const;
  void get_state(void* bytes, size_t size) const;
  bool set_state(const void* bytes, size_t size, Text& why);
  // The same for bytes that this model itself gave since initialise(), with unchanged parameters of its ships. It asks
  // for no memory. False for other bytes; the model must then be initialised again.
  bool rewind(const void* bytes, size_t size);

 private:
  struct World;
  struct Run;

  bool prepare(World*& prepared, Text& why);
  Run* begin_run(World& world, Text& why);
  void keep(World* world, Run* run);
  void give_up(World* world, Run* run);
  bool receive(Run& run, double t, double H, Text& why);
  bool take_substeps(Run& run, double t, double H, Text& why);
  bool finish(Run& run, double H, Text& why);
  void respond(Run& run, double t, const Pair* pairs, int count);
  void book(Run& run);
  void advance_others(Run& run, double H);
  void warn_of_delay(const Run& run, double t, double H);
  void warn(const Text& said);
  void publish(Run& run, double t, double H);
  void publish_contacts(Run& run);
  bool has_memory(const char* what, Text& why);

  Buffer<char> letters_{memory_};
  Buffer<const char*> names_{memory_};
  Buffer<bool> is_absent_{memory_};
  bool has_old_files_ = false;
  World* world_ = nullptr;
  Run* run_ = nullptr;
  mutable Text event_;
};

}  // namespace shipcollision
