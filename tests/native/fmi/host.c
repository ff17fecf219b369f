/* A host in C that knows no Python: it loads an FMU, runs it and prints its Reals.
 *
 *     host LIBRARY FMI TOKEN RESOURCES STEP STEPS REFERENCE ...
 *
 * Prints the values of those references at the start and after each step, a line each, in hexadecimal; what the FMU
 * logs goes to standard error. FMI is 2 or 3, RESOURCES a URI or a path. Ends with 1 when a call answers an error. */

#include <fmi2FunctionTypes.h>
#include <fmi3FunctionTypes.h>

#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 256 };

static void *library;

static void *function(const char *name) {
  void *found = dlsym(library, name);
  if (found == NULL) {
    fprintf(stderr, "no function %s\n", name);
    exit(1);
  }
  return found;
}

static void check(int status, const char *call) {
  if (status <= 1) return;
  fprintf(stderr, "%s: status %d\n", call, status);
  exit(1);
}

static void take_line2(void *environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String format,
                       ...) {
  va_list values;
  (void)environment;
  va_start(values, format);
  fprintf(stderr, "%s %d %s: ", name, (int)status, category);
  vfprintf(stderr, format, values);
  fputc('\n', stderr);
  va_end(values);
}

static void take_line3(void *environment, fmi3Status status, fmi3String category, fmi3String line) {
  (void)environment;
  fprintf(stderr, "%d %s: %s\n", (int)status, category, line);
}

static void print(const double *values, int count) {
  for (int i = 0; i < count; i++) printf("%s%a", i == 0 ? "" : " ", values[i]);
  printf("\n");
}

static void run2(const char *token, const char *resources, double h, int steps, const unsigned *references, int count) {
  static const fmi2CallbackFunctions callbacks = {take_line2, calloc, free, NULL, NULL};
  fmi2GetRealTYPE *get = (fmi2GetRealTYPE *)function("fmi2GetReal");
  fmi2DoStepTYPE *step = (fmi2DoStepTYPE *)function("fmi2DoStep");
  double values[MOST];
  fmi2Component c = ((fmi2InstantiateTYPE *)function("fmi2Instantiate"))("host", fmi2CoSimulation, token, resources,
                                                                         &callbacks, 0, 1);
  if (c == NULL) exit(1);
  check(((fmi2SetupExperimentTYPE *)function("fmi2SetupExperiment"))(c, 0, 0.0, 0.0, 0, 0.0), "setup");
  check(((fmi2EnterInitializationModeTYPE *)function("fmi2EnterInitializationMode"))(c), "enter");
  check(((fmi2ExitInitializationModeTYPE *)function("fmi2ExitInitializationMode"))(c), "exit");
  for (int k = 0; k <= steps; k++) {
    if (k > 0) check(step(c, (k - 1) * h, h, 1), "step");
    check(get(c, references, (size_t)count, values), "get");
    print(values, count);
  }
  check(((fmi2TerminateTYPE *)function("fmi2Terminate"))(c), "terminate");
  ((fmi2FreeInstanceTYPE *)function("fmi2FreeInstance"))(c);
}

static void run3(const char *token, const char *resources, double h, int steps, const unsigned *references, int count) {
  fmi3GetFloat64TYPE *get = (fmi3GetFloat64TYPE *)function("fmi3GetFloat64");
  fmi3DoStepTYPE *step = (fmi3DoStepTYPE *)function("fmi3DoStep");
  double values[MOST], last;
  fmi3Boolean flags[3];
  fmi3Instance c = ((fmi3InstantiateCoSimulationTYPE *)function("fmi3InstantiateCoSimulation"))(
      "host", token, resources, 0, 1, 0, 0, NULL, 0, NULL, take_line3, NULL);
  if (c == NULL) exit(1);
  check(((fmi3EnterInitializationModeTYPE *)function("fmi3EnterInitializationMode"))(c, 0, 0.0, 0.0, 0, 0.0), "enter");
  check(((fmi3ExitInitializationModeTYPE *)function("fmi3ExitInitializationMode"))(c), "exit");
  for (int k = 0; k <= steps; k++) {
    if (k > 0) check(step(c, (k - 1) * h, h, 1, &flags[0], &flags[1], &flags[2], &last), "step");
    for (int i = 0; i < count; i++) check(get(c, &references[i], 1, &values[i], 1), "get");
    print(values, count);
  }
  check(((fmi3TerminateTYPE *)function("fmi3Terminate"))(c), "terminate");
  ((fmi3FreeInstanceTYPE *)function("fmi3FreeInstance"))(c);
}

int main(int count, char **given) {
  unsigned references[MOST];
  if (count < 8 || count - 7 > MOST) {
    fprintf(stderr, "usage: host LIBRARY FMI TOKEN RESOURCES STEP STEPS REFERENCE ...\n");
    return 1;
  }
  library = dlopen(given[1], RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  for (int i = 7; i < count; i++) references[i - 7] = (unsigned)strtoul(given[i], NULL, 10);
  (strcmp(given[2], "2") == 0 ? run2 : run3)(given[3], given[4], strtod(given[5], NULL), atoi(given[6]), references,
                                             count - 7);
  return dlclose(library);
}
