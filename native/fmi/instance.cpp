#include "instance.hpp"

#include <string.h>

#include "../numbers/elementary.hpp"
#include "resource_location.hpp"

namespace shipcollision {

namespace {

const char* const PHASES[] = {"instantiated", "initialising", "running", "terminated"};
const char* const TABLE = "/variables.txt";

const char* name_of(Phase phase) { return PHASES[static_cast<unsigned char>(phase)]; }

}  // namespace

// Making. -------------------------------------------------------------------------------------------------------------

Instance::Instance(const Request& request) {
  logger_.open(request.forward, request.logger, request.environment, request.name == nullptr ? "" : request.name,
               request.is_logging);
}

Instance::~Instance() { delete model_; }

Instance* Instance::make(const Request& request) {
  Instance* made = new Instance(request);
  if (made == nullptr) return refuse_to_make(request, "there is no memory for an instance");
  FloatingPoint standard;
  Text why;
  if (made->open(request, why)) return made;
  made->logger_.log_failure(why.get());
  delete made;
  return nullptr;
}

Instance* Instance::refuse_to_make(const Request& request, const char* why) {
  Logger logger;
  logger.open(request.forward, request.logger, request.environment, request.name == nullptr ? "" : request.name, false);
  logger.log_failure(why);
  return nullptr;
}

bool Instance::open(const Request& request, Text& why) {
  char path[LONGEST_STRING + 32];
  if (request.name == nullptr) {
    why << "the host gives the instance no name";
    return false;
  }
  if (!find_resources(request.resources, path, LONGEST_STRING, why)) return false;
  const size_t size = strlen(path);
  memcpy(path + size, TABLE, strlen(TABLE) + 1);
  if (!variables_.read(path, why)) return false;
  path[size] = '\0';
  logger_.name_fmu(variables_.fmu());
  if (!confirm_request(request, why)) return false;
  model_ = make_model(variables_, path, why);
  if (model_ == nullptr) return false;
  return access_.connect(variables_, *model_, &experiment_.time, why);
}

bool Instance::confirm_request(const Request& request, Text& why) const {
  if (variables_.fmi() != request.fmi) {
    why << variables_.fmu() << " was built for FMI " << variables_.fmi() << " and is called by FMI " << request.fmi;
    return false;
  }
  const char* called = request.fmi == 3 ? "instantiation token" : "guid";
  if (request.token == nullptr || strcmp(request.token, variables_.token()) != 0) {
    why << variables_.fmu() << ": the host's " << called << " is ";
    if (request.token == nullptr) {
      why << "missing";
    } else {
      why.quote(request.token);
    }
    why << ", and this FMU has ";
    why.quote(variables_.token()) << ": library and model description are of different builds";
    return false;
  }
  return true;
}

// Log. ----------------------------------------------------------------------------------------------------------------

Status Instance::set_logging(bool is_on, const char* const* categories, size_t count) {
  Text why;
  return logger_.set_categories(is_on, categories, count, why) ? Status::ok : refuse(why);
}

Status Instance::refuse(const Text& why) {
  logger_.log(Status::error, Category::error, why.get());
  return Status::error;
}

Status Instance::warn(const Text& line) {
  logger_.log(Status::warning, Category::warning, line.get(), "warning: ");
  return Status::ok;
}

Status Instance::refuse_feature(const char* feature) {
  Text why;
  why << access_.name() << " has no " << feature;
  return refuse(why);
}

Status Instance::refuse_null(const char* what) {
  Text why;
  why << access_.name() << ": a null pointer in place of " << what;
  return refuse(why);
}

// During initialisation a host asks for dozens of variables, one by one: the reason is logged once.
Status Instance::refuse_get(const Text& why) {
  const bool is_known = !access_.is_running() && strcmp(why.get(), unanswered_.get()) == 0;
  unanswered_ = why;
  return is_known ? Status::error : refuse(why);
}

void Instance::pass_on(const Text& warning) {
  if (!warning.is_empty()) warn(warning);
}

// In time. ------------------------------------------------------------------------------------------------------------

Status Instance::set_up_experiment(double start, bool has_stop, double stop) {
  FloatingPoint standard;
  Text why;
  if (phase_ != Phase::instantiated) {
    why << "the experiment cannot be set up: the instance is " << name_of(phase_) << "; reset it";
    return refuse(why);
  }
  if (!isfinite(start)) {
    why << "the experiment cannot start at " << start << " s: give a finite start time";
    return refuse(why);
  }
  Text warning;
  experiment_.set_up(start, has_stop, stop, warning);
  pass_on(warning);
  return Status::ok;
}

Status Instance::enter_initialisation() {
  if (phase_ != Phase::instantiated) {
    Text why;
    why << "initialisation cannot be entered: the instance is " << name_of(phase_) << "; reset it";
    return refuse(why);
  }
  phase_ = Phase::initialising;
  return Status::ok;
}

Status Instance::exit_initialisation() {
  FloatingPoint standard;
  Text why, line;
  if (phase_ != Phase::initialising) {
    why << "initialisation is not entered: the instance is " << name_of(phase_);
  } else if (access_.initialise(why)) {
    phase_ = Phase::running;
    pass_on(model_->warning());
    return Status::ok;
  }
  line << access_.name() << " cannot be initialised: " << why;
  return refuse(line);
}

Status Instance::terminate() {
  if (phase_ != Phase::running) {
    Text why;
    why << access_.name() << " cannot be terminated: the instance is " << name_of(phase_);
    return refuse(why);
  }
  phase_ = Phase::terminated;
  return Status::ok;
}

Status Instance::reset() {
  access_.reset();
  experiment_ = Experiment();
  phase_ = Phase::instantiated;
  last_step_ = Status::ok;
  unanswered_.clear();
  return Status::ok;
}

Status Instance::step(double t, double h) {
  FloatingPoint standard;
  Text why;
  if (phase_ != Phase::running) {
    refuse_phase(why);
    return refuse(why);
  }
  Text gap;
  if (!experiment_.check_step(t, h, gap, why)) return last_step_ = refuse(why);  // FMI: an error, not a discarded step
  if (!access_.step(t, h, why)) {
    logger_.log(Status::error, Category::error, why.get());
    return last_step_ = Status::discard;
  }
  experiment_.finish_step(t, h, !gap.is_empty());
  pass_on(gap);
  for (size_t i = 0; i < model_->event_count(); i++) logger_.log(Status::ok, Category::events, model_->event(i));
  pass_on(model_->warning());
  return last_step_ = Status::ok;
}

bool Instance::refuse_phase(Text& why) const {
  why << access_.name();
  if (phase_ == Phase::terminated) {
    why << " is terminated at t = ";
    why.short_number(experiment_.time) << " s: reset it or restore a state";
  } else {
    why << " is not initialised: initialise it before its first step";
  }
  return false;
}

bool Instance::check_settable(Text& why) const { return phase_ != Phase::terminated || refuse_phase(why); }

// The whole state. ----------------------------------------------------------------------------------------------------

void Instance::save(ByteWriter& bytes) const {
  bytes.text(variables_.tag());
  bytes.text(variables_.build());
  bytes.value(phase_);
  experiment_.save(bytes);
  access_.save(bytes);
}

Status Instance::get_state(void** handle) {
  if (handle == nullptr) return refuse_null("a handle");
  ByteWriter counted;
  save(counted);
  Text why;
  const size_t size = STATE_HEAD + counted.size();
  SavedState* state = states_.make(*handle, size, why);
  if (state == nullptr) return refuse(why);
  ByteWriter bytes(state->bytes + STATE_HEAD, size - STATE_HEAD);
  save(bytes);
  seal_state(state->bytes, size);
  *handle = state;
  return Status::ok;
}

Status Instance::set_state(void* handle) {
  FloatingPoint standard;
  Text why;
  SavedState* state = states_.find(handle, why);
  if (state == nullptr || !restore(state->bytes + STATE_HEAD, state->size - STATE_HEAD, why)) return refuse(why);
  unanswered_.clear();
  last_step_ = Status::ok;
  return Status::ok;
}

bool Instance::restore(const unsigned char* bytes, size_t size, Text& why) {
  ByteReader reader(bytes, size);
  char tag_read[256], build_read[256];
  if (!reader.text(tag_read, sizeof tag_read) || !reader.text(build_read, sizeof build_read)) {
    why << access_.name() << ": this saved state cannot be read";
    return false;
  }
  if (strcmp(tag_read, variables_.tag()) != 0) {
    why << access_.name() << ": this is not a saved state of it (of ";
    why.quote(tag_read) << ", want ";
    why.quote(variables_.tag()) << ")";
    return false;
  }
  if (strcmp(build_read, variables_.build()) != 0) {
    why << access_.name() << ": this state was saved by another build of shipcollision_fmu (" << build_read
        << "; this one is " << variables_.build() << "): a state can be restored only in the build that saved it";
    return false;
  }
  Phase phase;
  Experiment experiment;
  if (!reader.value(phase) || phase > Phase::terminated || !experiment.restore(reader)) {
    why << access_.name() << ": this saved state cannot be read";
    return false;
  }
  if (!access_.restore(reader, phase >= Phase::running, why)) return false;
  phase_ = phase;
  experiment_ = experiment;
  return true;
}

Status Instance::free_state(void** handle) {
  if (handle == nullptr || *handle == nullptr) return Status::ok;  // as FMI says: nothing to free
  Text why;
  SavedState* state = states_.find(*handle, why);
  if (state == nullptr) return refuse(why);
  states_.free(state);
  *handle = nullptr;
  return Status::ok;
}

Status Instance::get_state_size(void* handle, size_t* size) {
  if (size == nullptr) return refuse_null("a size");
  Text why;
  const SavedState* state = states_.find(handle, why);
  if (state == nullptr) return refuse(why);
  *size = state->size;
  return Status::ok;
}

Status Instance::serialize(void* handle, unsigned char* bytes, size_t size) {
  Text why;
  SavedState* state = states_.find(handle, why);
  if (state == nullptr) return refuse(why);
  if (bytes == nullptr) return refuse_null("room for bytes");
  if (size < state->size) {
    why << access_.name() << ": " << static_cast<long long>(size) << " bytes are too few for a state of "
        << static_cast<long long>(state->size);
    return refuse(why);
  }
  memcpy(bytes, state->bytes, state->size);
  return Status::ok;
}

Status Instance::deserialize(const unsigned char* bytes, size_t size, void** handle) {
  if (handle == nullptr) return refuse_null("a handle");
  Text why;
  if (!is_sealed(bytes, size)) {
    why << access_.name() << ": bytes that are no state, or damaged ones";
    return refuse(why);
  }
  SavedState* state = states_.make(*handle, size, why);
  if (state == nullptr) return refuse(why);
  memcpy(state->bytes, bytes, size);
  *handle = state;
  return Status::ok;
}

}  // namespace shipcollision
