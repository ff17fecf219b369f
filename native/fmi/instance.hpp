// An instance of an FMU in every version of FMI: the twin of shipcollision_fmu/fmi/slave_base.py.
//
// A call that is refused answers an error, logs one line and changes nothing: the host may correct it and go on. A step
// that the model cannot make is discarded, and the state before the step stays. There is no fatal status. Unlike the
// Python FMU, whose wrapper cannot refuse most calls, nothing is put off until the next step.
#pragma once

#include <stddef.h>

#include "../manoeuvring/interface.hpp"
#include "../memory.hpp"
#include "experiment.hpp"
#include "floating_point.hpp"
#include "logger.hpp"
#include "model.hpp"
#include "saved_state.hpp"
#include "variable_access.hpp"
#include "variables.hpp"

namespace shipcollision {

// Phases of an instance, between which FMI has one way: reset or a restored state lead back.
enum class Phase : unsigned char { instantiated, initialising, running, terminated };

// What a host says when it makes an instance; FMI has more, which has no meaning here.
struct Request {
  int fmi;
  const char* name;
  const char* token;
  const char* resources;
  Logger::Forward forward;
  Logger::Function logger;
  void* environment;
  bool is_logging;
};

class Instance : public OnHeap {
 public:
  // A new instance, or null and a line to the logger.
  static Instance* make(const Request& request);
  // A line to the logger about an instance that cannot be, and null.
  static Instance* refuse_to_make(const Request& request, const char* why);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  Status set_logging(bool is_on, const char* const* categories, size_t count);

  // In time. The stop time is as the host gives it; a start that is not finite is refused.
  Status set_up_experiment(double start, bool has_stop, double stop);
  Status enter_initialisation();
  Status exit_initialisation();
  Status terminate();
  Status reset();
  Status step(double t, double h);
  Status last_step() const { return last_step_; }
  double time() const { return experiment_.time; }
  Phase phase() const { return phase_; }

  // Values: get([&](VariableAccess& access, Text& why) { return access.get_reals(..., why); })
  template <typename Call>
  Status get(const Call& call) {
    FloatingPoint standard;
    Text why;
    return call(access_, why) ? Status::ok : refuse_get(why);
  }
  template <typename Call>
  Status set(const Call& call) {
    Text why;
    return check_settable(why) && call(access_, why) ? Status::ok : refuse(why);
  }

  // The whole state.
  Status get_state(void** handle);
  Status set_state(void* handle);
  Status free_state(void** handle);
  Status get_state_size(void* handle, size_t* size);
  Status serialize(void* handle, unsigned char* bytes, size_t size);
  Status deserialize(const unsigned char* bytes, size_t size, void** handle);

  // What this FMU does not have, by its name in words.
  Status refuse_feature(const char* feature);
  Status refuse_null(const char* what);
  Status refuse(const Text& why);
  Status warn(const Text& line);

 private:
  explicit Instance(const Request& request);
  bool open(const Request& request, Text& why);
  bool confirm_request(const Request& request, Text& why) const;
  bool refuse_phase(Text& why) const;
  bool check_settable(Text& why) const;
  Status refuse_get(const Text& why);
  void pass_on(const Text& warning);
  void save(ByteWriter& bytes) const;
  bool restore(const unsigned char* bytes, size_t size, Text& why);

  Logger logger_;
  Variables variables_;
  VariableAccess access_;
  Model* model_ = nullptr;
  Experiment experiment_;
  SavedStates states_;
  Phase phase_ = Phase::instantiated;
  Status last_step_ = Status::ok;
  Text unanswered_;  // why the last get was refused
};

}  // namespace shipcollision
