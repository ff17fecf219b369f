// The C interface of FMI 2.0 for co-simulation: the twin of shipcollision_fmu/fmi/slave.py.
//
// Every function checks its instance and hands the call to it. What only model exchange has answers an error.
#include <fmi2Functions.h>

#include "instance.hpp"

namespace shipcollision {
namespace {

Instance* as_instance(fmi2Component component) { return static_cast<Instance*>(component); }

fmi2Status as_fmi(Status status) { return static_cast<fmi2Status>(status); }

// FMI 2.0's logger takes a printf format: a lone percent sign would read the host's memory.
void forward(Logger::Function function, void* environment, const char* instance, Status status, const char* category,
             const char* line) {
  char format[2 * Text::CAPACITY + 1];
  size_t size = 0;
  for (; *line != '\0' && size + 2 < sizeof format; line++) {
    format[size++] = *line;
    if (*line == '%') format[size++] = '%';
  }
  format[size] = '\0';
  reinterpret_cast<fmi2CallbackLogger>(function)(environment, instance, as_fmi(status), category, format);
}

Request make_request(fmi2String name, fmi2String guid, fmi2String location, const fmi2CallbackFunctions* functions,
                     fmi2Boolean is_logging) {
  const bool has_logger = functions != nullptr && functions->logger != nullptr;
  return {2,
          name,
          guid,
          location,
          forward,
          has_logger ? reinterpret_cast<Logger::Function>(functions->logger) : nullptr,
          functions == nullptr ? nullptr : functions->componentEnvironment,
          is_logging != fmi2False};
}

// An answer from an instance, or an error without one.
template <typename Call>
fmi2Status ask(fmi2Component component, const Call& call) {
  Instance* instance = as_instance(component);
  return instance == nullptr ? fmi2Error : as_fmi(call(*instance));
}

fmi2Status lack(fmi2Component component, const char* feature) {
  return ask(component, [&](Instance& instance) { return instance.refuse_feature(feature); });
}

constexpr const char* MODEL_EXCHANGE = "model exchange: it is for co-simulation";

// A status is there at any time, since a step never is still running.
template <typename Value>
fmi2Status answer_status(fmi2Component component, Value* value, const Value& answer, bool is_known) {
  return ask(component, [&](Instance& instance) {
    if (value == nullptr) return instance.refuse_null("a value");
    if (!is_known) return Status::discard;
    *value = answer;
    return Status::ok;
  });
}

}  // namespace
}  // namespace shipcollision

using namespace shipcollision;

extern "C" {

const char* fmi2GetTypesPlatform() { return fmi2TypesPlatform; }

const char* fmi2GetVersion() { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean is_on, size_t count, const fmi2String categories[]) {
  return ask(c, [&](Instance& i) { return i.set_logging(is_on != fmi2False, categories, count); });
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                              const fmi2CallbackFunctions* functions, fmi2Boolean, fmi2Boolean is_logging) {
  const Request request = make_request(name, guid, location, functions, is_logging);
  if (type != fmi2CoSimulation) return Instance::refuse_to_make(request, "this FMU is for co-simulation alone");
  return Instance::make(request);
}

void fmi2FreeInstance(fmi2Component c) { delete as_instance(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean has_stop,
                               fmi2Real stop) {
  return ask(c, [&](Instance& i) { return i.set_up_experiment(start, has_stop != fmi2False, stop); });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return ask(c, [](Instance& i) { return i.enter_initialisation(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return ask(c, [](Instance& i) { return i.exit_initialisation(); });
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return ask(c, [](Instance& i) { return i.terminate(); });
}

fmi2Status fmi2Reset(fmi2Component c) {
  return ask(c, [](Instance& i) { return i.reset(); });
}

// Values. -------------------------------------------------------------------------------------------------------------

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real values[]) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) { return access.get_reals(vr, n, values, n, why); });
  });
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer values[]) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) {
      return access.get_integers(Type::integer_or_enumeration, vr, n, values, n, why);
    });
  });
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean values[]) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) { return access.get_booleans(vr, n, values, n, why); });
  });
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String values[]) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) { return access.get_strings(vr, n, values, n, why); });
  });
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real values[]) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) { return access.set_reals(vr, n, values, n, why); });
  });
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer values[]) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) {
      return access.set_integers(Type::integer_or_enumeration, vr, n, values, n, why);
    });
  });
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean values[]) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) { return access.set_booleans(vr, n, values, n, why); });
  });
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String values[]) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) { return access.set_strings(vr, n, values, n, why); });
  });
}

// The whole state. ----------------------------------------------------------------------------------------------------

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return ask(c, [&](Instance& i) { return i.get_state(state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return ask(c, [&](Instance& i) { return i.set_state(state); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return ask(c, [&](Instance& i) { return i.free_state(state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size) {
  return ask(c, [&](Instance& i) { return i.get_state_size(state, size); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  return ask(c, [&](Instance& i) { return i.serialize(state, reinterpret_cast<unsigned char*>(bytes), size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state) {
  return ask(c, [&](Instance& i) { return i.deserialize(reinterpret_cast<const unsigned char*>(bytes), size, state); });
}

// In time. ------------------------------------------------------------------------------------------------------------

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean) {
  return ask(c, [&](Instance& i) { return i.step(t, h); });
}

fmi2Status fmi2CancelStep(fmi2Component c) {
  return lack(c, "step to cancel: it has ended when doStep returns");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status* value) {
  const fmi2Status last = c == nullptr ? fmi2Error : as_fmi(as_instance(c)->last_step());
  return answer_status(c, value, last, kind == fmi2DoStepStatus);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  const fmi2Real time = c == nullptr ? 0.0 : as_instance(c)->time();
  return answer_status(c, value, time, kind == fmi2LastSuccessfulTime);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind, fmi2Integer* value) {
  return answer_status(c, value, 0, false);
}

// A discarded step is a fault of the inputs or of the step: the host should not take it for an end as planned.
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* value) {
  return answer_status(c, value, fmi2False, kind == fmi2Terminated);
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String* value) {
  static const char nothing[] = "";
  return answer_status<fmi2String>(c, value, nothing, kind == fmi2PendingStatus);
}

// What this FMU does not have. ----------------------------------------------------------------------------------------

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2ValueReference[],
                                        size_t, const fmi2Real[], fmi2Real[]) {
  return lack(c, "directional derivatives");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                       const fmi2Real[]) {
  return lack(c, "derivatives of inputs: they are held over the step");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                        fmi2Real[]) {
  return lack(c, "derivatives of outputs");
}

fmi2Status fmi2EnterEventMode(fmi2Component c) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo*) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean, fmi2Boolean*, fmi2Boolean*) {
  return lack(c, MODEL_EXCHANGE);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real[], size_t) { return lack(c, MODEL_EXCHANGE); }

}  // extern "C"
