/* The least that an FMU of FMI 2.0 can be: Reals in an array, inputs passed on to outputs. What a host and its calls
 * cost by themselves is measured with it (benchmarks/fmi_layer.py). INPUTS and OUTPUTS are given by the compiler. */
#include <fmi2FunctionTypes.h>
#include <stdlib.h>

typedef struct {
  double values[INPUTS + OUTPUTS]; /* outputs first, as in our tables */
} Instance;

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean is_logging) {
  (void)name, (void)type, (void)guid, (void)location, (void)functions, (void)visible, (void)is_logging;
  return calloc(1, sizeof(Instance));
}

void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean a, fmi2Real b, fmi2Real d, fmi2Boolean e, fmi2Real f) {
  (void)c, (void)a, (void)b, (void)d, (void)e, (void)f;
  return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2Terminate(fmi2Component c) { return c ? fmi2OK : fmi2Error; }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Real values[]) {
  for (size_t i = 0; i < count; i++) {
    if (references[i] >= INPUTS + OUTPUTS) return fmi2Error;
    values[i] = ((Instance *)c)->values[references[i]];
  }
  return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Real values[]) {
  for (size_t i = 0; i < count; i++) {
    if (references[i] < OUTPUTS || references[i] >= INPUTS + OUTPUTS) return fmi2Error;
    ((Instance *)c)->values[references[i]] = values[i];
  }
  return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean no_set_state) {
  double *values = ((Instance *)c)->values;
  (void)t, (void)h, (void)no_set_state;
  for (int i = 0; i < OUTPUTS; i++) values[i] = values[OUTPUTS + i % INPUTS];
  return fmi2OK;
}

/* What hosts look up, and the benchmark does not call. */
#define LACK(name) \
  fmi2Status fmi2##name(void) { return fmi2Error; }
LACK(SetDebugLogging) LACK(Reset) LACK(GetInteger) LACK(GetBoolean) LACK(GetString) LACK(SetInteger) LACK(SetBoolean)
LACK(SetString) LACK(GetFMUstate) LACK(SetFMUstate) LACK(FreeFMUstate) LACK(SerializedFMUstateSize)
LACK(SerializeFMUstate) LACK(DeSerializeFMUstate) LACK(GetDirectionalDerivative) LACK(SetRealInputDerivatives)
LACK(GetRealOutputDerivatives) LACK(CancelStep) LACK(GetStatus) LACK(GetRealStatus) LACK(GetIntegerStatus)
LACK(GetBooleanStatus) LACK(GetStringStatus)
