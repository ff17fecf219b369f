// The C interface of FMI 3.0 for co-simulation: the twin of shipcollision_fmu/fmi/slave_fmi3.py.
//
// Every function checks its instance and hands the call to it. There is neither event mode nor clock, early return or
// intermediate update; what only they, model exchange and scheduled execution have answers an error.
#include <fmi3Functions.h>

#include "instance.hpp"

namespace shipcollision {
namespace {

Instance* as_instance(fmi3Instance instance) { return static_cast<Instance*>(instance); }

fmi3Status as_fmi(Status status) { return static_cast<fmi3Status>(status); }

void forward(Logger::Function function, void* environment, const char*, Status status, const char* category,
             const char* line) {
  reinterpret_cast<fmi3LogMessageCallback>(function)(environment, as_fmi(status), category, line);
}

Request make_request(fmi3String name, fmi3String token, fmi3String path, fmi3InstanceEnvironment environment,
                     fmi3LogMessageCallback logger, fmi3Boolean is_logging) {
  return {3, name, token, path, forward, reinterpret_cast<Logger::Function>(logger), environment, is_logging};
}

// An answer from an instance, or an error without one.
template <typename Call>
fmi3Status ask(fmi3Instance instance, const Call& call) {
  return instance == nullptr ? fmi3Error : as_fmi(call(*as_instance(instance)));
}

fmi3Status lack(fmi3Instance instance, const char* feature) {
  return ask(instance, [&](Instance& i) { return i.refuse_feature(feature); });
}

// Of a type that no variable has.
fmi3Status lack_type(fmi3Instance instance, const char* type, const fmi3ValueReference references[], size_t count) {
  return ask(instance, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) { return access.refuse_type(type, references, count, why); });
  });
}

template <typename Value>
void answer(Value* place, const Value& value) {
  if (place != nullptr) *place = value;
}

constexpr const char* MODEL_EXCHANGE = "model exchange: it is for co-simulation";
constexpr const char* CLOCKS = "clocks";
constexpr const char* EVENT_MODE = "event mode";
constexpr const char* CONFIGURATION = "structural parameters to configure";

}  // namespace
}  // namespace shipcollision

using namespace shipcollision;

extern "C" {

const char* fmi3GetVersion() { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean is_on, size_t count, const fmi3String categories[]) {
  return ask(c, [&](Instance& i) { return i.set_logging(is_on, categories, count); });
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String path, fmi3Boolean,
                                         fmi3Boolean is_logging, fmi3Boolean has_event_mode, fmi3Boolean,
                                         const fmi3ValueReference[], size_t intermediate_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                         fmi3IntermediateUpdateCallback) {
  const Request request = make_request(name, token, path, environment, logger, is_logging);
  if (has_event_mode) return Instance::refuse_to_make(request, "this FMU has no event mode: instantiate it without");
  if (intermediate_count > 0) {
    return Instance::refuse_to_make(request, "this FMU has no intermediate update: require no variables of it");
  }
  return Instance::make(request);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String path, fmi3Boolean,
                                          fmi3Boolean is_logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback logger) {
  const Request request = make_request(name, token, path, environment, logger, is_logging);
  return Instance::refuse_to_make(request, "this FMU is for co-simulation, not for model exchange");
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String path, fmi3Boolean,
                                               fmi3Boolean is_logging, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback logger, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  const Request request = make_request(name, token, path, environment, logger, is_logging);
  return Instance::refuse_to_make(request, "this FMU is for co-simulation, not for scheduled execution");
}

void fmi3FreeInstance(fmi3Instance c) { delete as_instance(c); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean, fmi3Float64, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop) {
  return ask(c, [&](Instance& i) {
    const Status status = i.set_up_experiment(start, has_stop, stop);
    return status == Status::ok ? i.enter_initialisation() : status;
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return ask(c, [](Instance& i) { return i.exit_initialisation(); });
}

fmi3Status fmi3Terminate(fmi3Instance c) {
  return ask(c, [](Instance& i) { return i.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance c) {
  return ask(c, [](Instance& i) { return i.reset(); });
}

// In time. ------------------------------------------------------------------------------------------------------------

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 t, fmi3Float64 h, fmi3Boolean, fmi3Boolean* event_handling_needed,
                      fmi3Boolean* terminate_simulation, fmi3Boolean* early_return, fmi3Float64* last_successful_time) {
  answer(event_handling_needed, false);
  answer(terminate_simulation, false);
  answer(early_return, false);
  return ask(c, [&](Instance& i) {
    const Status status = i.step(t, h);
    answer(last_successful_time, i.time());
    return status;
  });
}

// Values. -------------------------------------------------------------------------------------------------------------

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 values[],
                          size_t size) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) {
      return access.get_reals(vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Float64 values[],
                          size_t size) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) {
      return access.set_reals(vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int32 values[],
                        size_t size) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) {
      return access.get_integers(Type::integer, vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Int32 values[],
                        size_t size) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) {
      return access.set_integers(Type::integer, vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int64 values[],
                        size_t size) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) {
      return access.get_integers(Type::enumeration, vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Int64 values[],
                        size_t size) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) {
      return access.set_integers(Type::enumeration, vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Boolean values[],
                          size_t size) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) {
      return access.get_booleans(vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Boolean values[],
                          size_t size) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) {
      return access.set_booleans(vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3String values[],
                         size_t size) {
  return ask(c, [&](Instance& i) {
    return i.get([&](VariableAccess& access, Text& why) {
      return access.get_strings(vr, n, values, size, why);
    });
  });
}

fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3String values[],
                         size_t size) {
  return ask(c, [&](Instance& i) {
    return i.set([&](VariableAccess& access, Text& why) {
      return access.set_strings(vr, n, values, size, why);
    });
  });
}

// Values of types that no variable has. -------------------------------------------------------------------------------

fmi3Status fmi3GetFloat32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float32[], size_t) {
  return lack_type(c, "Float32", vr, n);
}

fmi3Status fmi3SetFloat32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Float32[], size_t) {
  return lack_type(c, "Float32", vr, n);
}

fmi3Status fmi3GetInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int8[], size_t) {
  return lack_type(c, "Int8", vr, n);
}

fmi3Status fmi3SetInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Int8[], size_t) {
  return lack_type(c, "Int8", vr, n);
}

fmi3Status fmi3GetUInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3UInt8[], size_t) {
  return lack_type(c, "UInt8", vr, n);
}

fmi3Status fmi3SetUInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3UInt8[], size_t) {
  return lack_type(c, "UInt8", vr, n);
}

fmi3Status fmi3GetInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int16[], size_t) {
  return lack_type(c, "Int16", vr, n);
}

fmi3Status fmi3SetInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Int16[], size_t) {
  return lack_type(c, "Int16", vr, n);
}

fmi3Status fmi3GetUInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3UInt16[], size_t) {
  return lack_type(c, "UInt16", vr, n);
}

fmi3Status fmi3SetUInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3UInt16[], size_t) {
  return lack_type(c, "UInt16", vr, n);
}

fmi3Status fmi3GetUInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3UInt32[], size_t) {
  return lack_type(c, "UInt32", vr, n);
}

fmi3Status fmi3SetUInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3UInt32[], size_t) {
  return lack_type(c, "UInt32", vr, n);
}

fmi3Status fmi3GetUInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3UInt64[], size_t) {
  return lack_type(c, "UInt64", vr, n);
}

fmi3Status fmi3SetUInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3UInt64[], size_t) {
  return lack_type(c, "UInt64", vr, n);
}

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t n, size_t[], fmi3Binary[], size_t) {
  return lack_type(c, "Binary", vr, n);
}

fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const size_t[], const fmi3Binary[],
                         size_t) {
  return lack_type(c, "Binary", vr, n);
}

fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Clock[]) {
  return lack_type(c, "Clock", vr, n);
}

fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Clock[]) {
  return lack_type(c, "Clock", vr, n);
}

// The whole state. ----------------------------------------------------------------------------------------------------

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) {
  return ask(c, [&](Instance& i) { return i.get_state(state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return ask(c, [&](Instance& i) { return i.set_state(state); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state) {
  return ask(c, [&](Instance& i) { return i.free_state(state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t* size) {
  return ask(c, [&](Instance& i) { return i.get_state_size(state, size); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return ask(c, [&](Instance& i) { return i.serialize(state, bytes, size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState* state) {
  return ask(c, [&](Instance& i) { return i.deserialize(bytes, size, state); });
}

// What this FMU does not have. ----------------------------------------------------------------------------------------

fmi3Status fmi3EnterEventMode(fmi3Instance c) { return lack(c, EVENT_MODE); }

fmi3Status fmi3EnterStepMode(fmi3Instance c) { return lack(c, "event mode to leave: it is always in step mode"); }

fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) { return lack(c, CONFIGURATION); }

fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) { return lack(c, CONFIGURATION); }

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                    fmi3Boolean*, fmi3Float64*) {
  return lack(c, EVENT_MODE);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) { return lack(c, EVENT_MODE); }

fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3Int32[],
                                    fmi3Float64[], size_t) {
  return lack(c, "derivatives of outputs");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference[], size_t,
                                        const fmi3ValueReference[], size_t, const fmi3Float64[], size_t,
                                        fmi3Float64[], size_t) {
  return lack(c, "directional derivatives");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
                                    size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t) {
  return lack(c, "adjoint derivatives");
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference, size_t*) {
  return lack(c, "dependencies of single elements");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
                                       fmi3DependencyKind[], size_t) {
  return lack(c, "dependencies of single elements");
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], size_t, fmi3Float64[],
                                  fmi3IntervalQualifier[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[],
                                   fmi3IntervalQualifier[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], size_t, fmi3Float64[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3Float64[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                                   const fmi3UInt64[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3Float64[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                                const fmi3UInt64[]) {
  return lack(c, CLOCKS);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference, fmi3Float64) {
  return lack(c, "scheduled execution: it is for co-simulation");
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return lack(c, MODEL_EXCHANGE);
}

fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64[], size_t) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t*) { return lack(c, MODEL_EXCHANGE); }

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t*) { return lack(c, MODEL_EXCHANGE); }

}  // extern "C"
