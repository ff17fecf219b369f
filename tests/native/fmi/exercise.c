/* A host in C that misuses the FMI layer, linked with it so that sanitizers watch both.
 *
 *     exercise calls     RESOURCES2 RESOURCES3 SEED COUNT [REFERENCES]     sequences of random calls, in both versions
 *     exercise locations RESOURCES3 FOLDER     SEED COUNT     random resource locations, and damaged tables
 *     exercise threads   RESOURCES2 RESOURCES3 SEED COUNT [INPUT2 INPUT3]     instances in two threads at once;
 *                        three inputs, which are one array in FMI 3.0, get the values of a vector
 *     exercise growth    RESOURCES2 RESOURCES3 STEPS INSTANCES [INPUT2 OUTPUT2 WORD2]     memory after the first tenth
 *                        and at the end [kB]; three inputs are moved, three outputs read, a text set if there is one
 *     exercise rounding  RESOURCES2            a host that flushes small numbers to zero and rounds down
 *
 * Random calls are in any order, with any reference, value, size and handle, null pointers among them; arrays are as
 * long as is said, since no library can know better. After them a state of before must come back, to the bit, and
 * after each refused call nothing may have changed. The process ends with 0, or with 1 and a line. */

#include <fmi2Functions.h>
#include <fmi3Functions.h>

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef TOKEN
#error "give -DTOKEN: the guid and instantiation token of the FMUs"
#endif

enum { ROOM = 64, STATES = 4, LARGEST_STATE = 70000 };

static int reference_count = 22; /* some of them are no variable */

/* Random numbers: xorshift64*. ------------------------------------------------------------------------------------ */

typedef struct {
  uint64_t state;
} Random;

static uint64_t draw(Random *random) {
  random->state ^= random->state >> 12;
  random->state ^= random->state << 25;
  random->state ^= random->state >> 27;
  return random->state * UINT64_C(2685821657736338717);
}

static int below(Random *random, int n) { return (int)((draw(random) >> 33) % (unsigned)n); }

static Random start(uint64_t seed) {
  Random random = {seed * UINT64_C(0x9E3779B97F4A7C15) + 1};
  for (int i = 0; i < 8; i++) draw(&random);
  return random;
}

static void fail(const char *what, uint64_t seed) {
  printf("seed %llu: %s\n", (unsigned long long)seed, what);
  fflush(stdout);
  _Exit(1);
}

/* Instances of both versions. -------------------------------------------------------------------------------------- */

typedef struct {
  int fmi;
  void *component;
  long lines;
  char last[512];
} Host;

static void take_line2(void *environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String format,
                       ...) {
  Host *host = environment;
  va_list values;
  (void)name, (void)status, (void)category;
  va_start(values, format);
  vsnprintf(host->last, sizeof host->last, format, values);
  va_end(values);
  host->lines++;
}

static void take_line3(void *environment, fmi3Status status, fmi3String category, fmi3String line) {
  Host *host = environment;
  (void)status, (void)category;
  snprintf(host->last, sizeof host->last, "%s", line);
  host->lines++;
}

static void open_host(Host *host, int fmi, const char *resources, int is_logging) {
  static _Thread_local fmi2CallbackFunctions functions;
  char location[4200];
  host->fmi = fmi;
  host->last[0] = '\0';
  if (fmi == 2) {
    functions = (fmi2CallbackFunctions){take_line2, NULL, NULL, NULL, host};
    snprintf(location, sizeof location, "file://%s", resources);
    host->component = fmi2Instantiate("one", fmi2CoSimulation, TOKEN, location, &functions, 0, is_logging);
  } else {
    host->component =
        fmi3InstantiateCoSimulation("one", TOKEN, resources, 0, is_logging, 0, 0, NULL, 0, host, take_line3, NULL);
  }
  if (host->component == NULL) fail(host->last, 0);
}

static void close_host(Host *host) {
  if (host->fmi == 2) fmi2FreeInstance(host->component);
  else fmi3FreeInstance(host->component);
  host->component = NULL;
}

static int get_state(Host *host, void **state) {
  return host->fmi == 2 ? (int)fmi2GetFMUstate(host->component, state) : (int)fmi3GetFMUState(host->component, state);
}

static int set_state(Host *host, void *state) {
  return host->fmi == 2 ? (int)fmi2SetFMUstate(host->component, state) : (int)fmi3SetFMUState(host->component, state);
}

static int free_state(Host *host, void **state) {
  return host->fmi == 2 ? (int)fmi2FreeFMUstate(host->component, state) : (int)fmi3FreeFMUState(host->component, state);
}

static int size_of(Host *host, void *state, size_t *size) {
  return host->fmi == 2 ? (int)fmi2SerializedFMUstateSize(host->component, state, size)
                        : (int)fmi3SerializedFMUStateSize(host->component, state, size);
}

static int to_bytes(Host *host, void *state, void *bytes, size_t size) {
  return host->fmi == 2 ? (int)fmi2SerializeFMUstate(host->component, state, bytes, size)
                        : (int)fmi3SerializeFMUState(host->component, state, bytes, size);
}

static int from_bytes(Host *host, const void *bytes, size_t size, void **state) {
  return host->fmi == 2 ? (int)fmi2DeSerializeFMUstate(host->component, bytes, size, state)
                        : (int)fmi3DeserializeFMUState(host->component, bytes, size, state);
}

static int step(Host *host, double t, double h) {
  fmi3Boolean flags[3];
  double last;
  return host->fmi == 2
             ? (int)fmi2DoStep(host->component, t, h, 1)
             : (int)fmi3DoStep(host->component, t, h, 1, &flags[0], &flags[1], &flags[2], &last);
}

static int reset(Host *host) {
  return host->fmi == 2 ? (int)fmi2Reset(host->component) : (int)fmi3Reset(host->component);
}

static int begin(Host *host, double beginning, double end) {
  if (host->fmi == 2) {
    const int status = fmi2SetupExperiment(host->component, 0, 0.0, beginning, 1, end);
    if (status > 1) return status;
    return fmi2EnterInitializationMode(host->component) > 1 ? 3 : (int)fmi2ExitInitializationMode(host->component);
  }
  const int status = fmi3EnterInitializationMode(host->component, 0, 0.0, beginning, 1, end);
  return status > 1 ? status : (int)fmi3ExitInitializationMode(host->component);
}

/* The whole instance as bytes, without a trace in it. */
static size_t snapshot(Host *host, unsigned char *bytes, uint64_t seed) {
  void *state = NULL;
  size_t size = 0;
  if (get_state(host, &state) != 0 || size_of(host, state, &size) != 0 || size > LARGEST_STATE) fail("no state", seed);
  if (to_bytes(host, state, bytes, size) != 0 || free_state(host, &state) != 0 || state != NULL) fail("no bytes", seed);
  return size;
}

/* Random calls. ---------------------------------------------------------------------------------------------------- */

static const double REALS[] = {0.0, -0.0, 1.0, -1.0, NAN, INFINITY, -INFINITY, 1e300, 5e-324, 1e9, 0.05, 3.5};
static const double STEPS[] = {0.1, 0.1, 0.1, 0.05, 0.0, -0.1, NAN, INFINITY, 1e-300, 1e300};
static const char *const STRINGS[] = {"", "good", "bad", "bang", "doubt", "%s%n%d%", "../..", "Schiff \xc3\xa4", NULL,
                                      "\n\t\"'\\", "start", "kcs", "buoy", "kvlcc2"};
static const char *const CATEGORIES[] = {"logEvents", "logStatusError", "logStatusWarning", "logAll", "", NULL};

typedef struct {
  Host *host;
  Random random;
  void *states[STATES];
  unsigned references[ROOM];
  size_t count, size;
} Fuzz;

#define PICK(fuzz, list) ((list)[below(&(fuzz)->random, (int)(sizeof(list) / sizeof(list)[0]))])
#define MAYBE(fuzz, value) (below(&(fuzz)->random, 20) == 0 ? NULL : (value))

static void choose_references(Fuzz *fuzz) {
  fuzz->count = (size_t)below(&fuzz->random, 5);
  fuzz->size = fuzz->count;
  for (size_t i = 0; i < fuzz->count; i++) {
    fuzz->references[i] = (unsigned)below(&fuzz->random, reference_count);
    if (below(&fuzz->random, 30) == 0) fuzz->references[i] = (unsigned)draw(&fuzz->random);
  }
  if (fuzz->host->fmi == 3) fuzz->size = (size_t)below(&fuzz->random, 9);
}

static int values2(Fuzz *fuzz) {
  void *c = fuzz->host->component;
  const unsigned *r = MAYBE(fuzz, fuzz->references);
  double reals[ROOM];
  int whole[ROOM];
  const char *strings[ROOM];
  const size_t n = fuzz->count;
  for (int i = 0; i < ROOM; i++) {
    reals[i] = PICK(fuzz, REALS), whole[i] = below(&fuzz->random, 6) - 1, strings[i] = PICK(fuzz, STRINGS);
  }
  switch (below(&fuzz->random, 8)) {
    case 0: return fmi2GetReal(c, r, n, MAYBE(fuzz, reals));
    case 1: return fmi2GetInteger(c, r, n, MAYBE(fuzz, whole));
    case 2: return fmi2GetBoolean(c, r, n, MAYBE(fuzz, whole));
    case 3: return fmi2GetString(c, r, n, MAYBE(fuzz, strings));
    case 4: return fmi2SetReal(c, r, n, MAYBE(fuzz, reals));
    case 5: return fmi2SetInteger(c, r, n, MAYBE(fuzz, whole));
    case 6: return fmi2SetBoolean(c, r, n, MAYBE(fuzz, whole));
    default: return fmi2SetString(c, r, n, MAYBE(fuzz, strings));
  }
}

static int values3(Fuzz *fuzz) {
  void *c = fuzz->host->component;
  const unsigned *r = MAYBE(fuzz, fuzz->references);
  double reals[ROOM];
  int32_t whole[ROOM];
  int64_t longs[ROOM];
  unsigned char bytes[ROOM];
  const char *strings[ROOM];
  const size_t n = fuzz->count, size = fuzz->size;
  for (int i = 0; i < ROOM; i++) {
    reals[i] = PICK(fuzz, REALS), whole[i] = below(&fuzz->random, 6) - 1, strings[i] = PICK(fuzz, STRINGS);
    longs[i] = below(&fuzz->random, 9) == 0 ? (int64_t)draw(&fuzz->random) : whole[i];
    bytes[i] = (unsigned char)whole[i];
  }
  switch (below(&fuzz->random, 16)) {
    case 0: return fmi3GetFloat64(c, r, n, MAYBE(fuzz, reals), size);
    case 1: return fmi3GetInt32(c, r, n, MAYBE(fuzz, whole), size);
    case 2: return fmi3GetInt64(c, r, n, MAYBE(fuzz, longs), size);
    case 3: return fmi3GetBoolean(c, r, n, MAYBE(fuzz, (fmi3Boolean *)(void *)bytes), size);
    case 4: return fmi3GetString(c, r, n, MAYBE(fuzz, strings), size);
    case 5: return fmi3SetFloat64(c, r, n, MAYBE(fuzz, reals), size);
    case 6: return fmi3SetInt32(c, r, n, MAYBE(fuzz, whole), size);
    case 7: return fmi3SetInt64(c, r, n, MAYBE(fuzz, longs), size);
    case 8: return fmi3SetBoolean(c, r, n, MAYBE(fuzz, (fmi3Boolean *)(void *)bytes), size);
    case 9: return fmi3SetString(c, r, n, MAYBE(fuzz, strings), size);
    case 10: return fmi3GetFloat32(c, r, n, NULL, size);
    case 11: return fmi3SetUInt8(c, r, n, bytes, size);
    case 12: return fmi3GetBinary(c, r, n, NULL, NULL, size);
    case 13: return fmi3SetBinary(c, r, n, NULL, NULL, size);
    case 14: return fmi3GetClock(c, r, n, NULL);
    default: return fmi3SetClock(c, r, n, NULL);
  }
}

static int life2(Fuzz *fuzz) {
  void *c = fuzz->host->component;
  fmi2Boolean boolean;
  double real;
  const char *text;
  int status;
  switch (below(&fuzz->random, 22)) {
    case 0: return fmi2SetupExperiment(c, 1, PICK(fuzz, REALS), PICK(fuzz, REALS), 1, PICK(fuzz, REALS));
    case 1: return fmi2EnterInitializationMode(c);
    case 2: return fmi2ExitInitializationMode(c);
    case 3: return fmi2Terminate(c);
    case 4: return fmi2Reset(c);
    case 5: return fmi2SetDebugLogging(c, below(&fuzz->random, 2), (size_t)below(&fuzz->random, 4),
                                       MAYBE(fuzz, &CATEGORIES[below(&fuzz->random, 3)]));
    case 6: return fmi2CancelStep(c);
    case 7: return fmi2GetStatus(c, (fmi2StatusKind)below(&fuzz->random, 5), MAYBE(fuzz, (fmi2Status *)&status));
    case 8: return fmi2GetRealStatus(c, (fmi2StatusKind)below(&fuzz->random, 5), MAYBE(fuzz, &real));
    case 9: return fmi2GetIntegerStatus(c, (fmi2StatusKind)below(&fuzz->random, 5), MAYBE(fuzz, &status));
    case 10: return fmi2GetBooleanStatus(c, (fmi2StatusKind)below(&fuzz->random, 5), MAYBE(fuzz, &boolean));
    case 11: return fmi2GetStringStatus(c, (fmi2StatusKind)below(&fuzz->random, 5), MAYBE(fuzz, &text));
    case 12: return fmi2GetDirectionalDerivative(c, NULL, 1, NULL, 1, NULL, NULL);
    case 13: return fmi2SetRealInputDerivatives(c, NULL, 1, NULL, NULL);
    case 14: return fmi2GetRealOutputDerivatives(c, NULL, 1, NULL, NULL);
    case 15: return fmi2EnterEventMode(c);
    case 16: return fmi2NewDiscreteStates(c, NULL);
    case 17: return fmi2EnterContinuousTimeMode(c);
    case 18: return fmi2CompletedIntegratorStep(c, 1, NULL, NULL);
    case 19: return fmi2SetTime(c, 1.0);
    case 20: return fmi2SetContinuousStates(c, NULL, 3);
    default: return fmi2GetDerivatives(c, NULL, 3);
  }
}

static int life3(Fuzz *fuzz) {
  void *c = fuzz->host->component;
  switch (below(&fuzz->random, 22)) {
    case 0: return fmi3EnterInitializationMode(c, 1, PICK(fuzz, REALS), PICK(fuzz, REALS), 1, PICK(fuzz, REALS));
    case 1: return fmi3ExitInitializationMode(c);
    case 2: return fmi3Terminate(c);
    case 3: return fmi3Reset(c);
    case 4: return fmi3SetDebugLogging(c, below(&fuzz->random, 2), (size_t)below(&fuzz->random, 4),
                                       MAYBE(fuzz, &CATEGORIES[below(&fuzz->random, 3)]));
    case 5: return fmi3EnterEventMode(c);
    case 6: return fmi3EnterStepMode(c);
    case 7: return fmi3EnterConfigurationMode(c);
    case 8: return fmi3ExitConfigurationMode(c);
    case 9: return fmi3UpdateDiscreteStates(c, NULL, NULL, NULL, NULL, NULL, NULL);
    case 10: return fmi3EvaluateDiscreteStates(c);
    case 11: return fmi3GetOutputDerivatives(c, NULL, 1, NULL, NULL, 1);
    case 12: return fmi3GetDirectionalDerivative(c, NULL, 1, NULL, 1, NULL, 1, NULL, 1);
    case 13: return fmi3GetAdjointDerivative(c, NULL, 1, NULL, 1, NULL, 1, NULL, 1);
    case 14: return fmi3GetNumberOfVariableDependencies(c, 1, NULL);
    case 15: return fmi3GetIntervalDecimal(c, NULL, 1, NULL, NULL);
    case 16: return fmi3GetShiftFraction(c, NULL, 1, NULL, NULL);
    case 17: return fmi3ActivateModelPartition(c, 1, 0.0);
    case 18: return fmi3CompletedIntegratorStep(c, 1, NULL, NULL);
    case 19: return fmi3SetTime(c, 1.0);
    case 20: return fmi3GetContinuousStates(c, NULL, 3);
    default: return fmi3DoStep(c, 0.0, 0.1, 1, NULL, NULL, NULL, NULL);
  }
}

static uint32_t crc32(const unsigned char *bytes, size_t size) {
  uint32_t rest = 0xFFFFFFFF;
  for (size_t i = 0; i < size; i++) {
    rest ^= bytes[i];
    for (int bit = 0; bit < 8; bit++) rest = rest & 1 ? rest >> 1 ^ 0xEDB88320 : rest >> 1;
  }
  return ~rest;
}

/* Another value somewhere, mostly near the beginning, and a digest that is right. */
static void forge(Fuzz *fuzz, unsigned char *bytes, size_t size) {
  const size_t span = below(&fuzz->random, 2) ? size : 160;
  for (int i = 1 + below(&fuzz->random, 3); i > 0; i--) {
    bytes[16 + (size_t)below(&fuzz->random, (int)(span - 16))] = (unsigned char)draw(&fuzz->random);
  }
  const uint32_t digest = crc32(bytes + 16, size - 16);
  memcpy(bytes + 12, &digest, 4);
}

static void damage(Fuzz *fuzz, unsigned char *bytes, size_t *size) {
  switch (below(&fuzz->random, 6)) {
    case 4:
    case 5: forge(fuzz, bytes, *size); break;
    case 0: *size = (size_t)below(&fuzz->random, (int)*size); break;
    case 1: bytes[below(&fuzz->random, (int)*size)] ^= (unsigned char)(1 << below(&fuzz->random, 8)); break;
    case 2:
      for (size_t i = 0; i < *size; i++) bytes[i] = (unsigned char)draw(&fuzz->random);
      break;
    default: break;
  }
}

static int states(Fuzz *fuzz) {
  Host *host = fuzz->host;
  void **state = &fuzz->states[below(&fuzz->random, STATES)];
  void *odd = below(&fuzz->random, 4) ? *state : (void *)&fuzz->random;
  size_t size = 0;
  static _Thread_local unsigned char bytes[LARGEST_STATE];
  switch (below(&fuzz->random, 6)) {
    case 0: return get_state(host, MAYBE(fuzz, state));
    case 1: return set_state(host, odd);
    case 2: return free_state(host, MAYBE(fuzz, state));
    case 3: return size_of(host, odd, MAYBE(fuzz, &size));
    case 4: return to_bytes(host, odd, MAYBE(fuzz, bytes), (size_t)below(&fuzz->random, LARGEST_STATE));
    default: break;
  }
  const size_t whole = snapshot(host, bytes, 0);
  size = whole;
  damage(fuzz, bytes, &size);
  return from_bytes(host, MAYBE(fuzz, bytes), size, MAYBE(fuzz, state));
}

static int any_call(Fuzz *fuzz) {
  const int which = below(&fuzz->random, 10);
  if (which < 5) {
    choose_references(fuzz);
    return fuzz->host->fmi == 2 ? values2(fuzz) : values3(fuzz);
  }
  if (which < 7) return step(fuzz->host, PICK(fuzz, REALS), PICK(fuzz, STEPS));
  if (which < 8) return states(fuzz);
  return fuzz->host->fmi == 2 ? life2(fuzz) : life3(fuzz);
}

static void run_sequence(Host *host, uint64_t seed) {
  Fuzz fuzz = {host, start(seed), {NULL}, {0}, 0, 0};
  static _Thread_local unsigned char before[LARGEST_STATE], after[LARGEST_STATE], kept[LARGEST_STATE];
  if (reset(host) != 0) fail("reset", seed);
  if (below(&fuzz.random, 4) && begin(host, 0.0, 1e6) > 1) fail("begin", seed);
  const size_t kept_size = snapshot(host, kept, seed);
  const int calls = 1 + below(&fuzz.random, 24);
  for (int i = 0; i < calls; i++) {
    const size_t size = snapshot(host, before, seed);
    const int status = any_call(&fuzz);
    if (status < 0 || status > 3) fail("a status that is none of ok, warning, discard and error", seed);
    if (status < 2) continue;
    if (snapshot(host, after, seed) != size || memcmp(before, after, size) != 0) fail("a refusal changed it", seed);
  }
  void *state = NULL;
  if (from_bytes(host, kept, kept_size, &state) != 0 || set_state(host, state) != 0) fail("restore", seed);
  if (snapshot(host, after, seed) != kept_size || memcmp(kept, after, kept_size) != 0) fail("another state", seed);
  if (free_state(host, &state) != 0) fail("free", seed);
  for (int i = 0; i < STATES; i++) {
    if (below(&fuzz.random, 2) && free_state(host, &fuzz.states[i]) != 0) fail("free", seed);
  }
}

static void exercise_calls(const char *const *resources, uint64_t seed, int count) {
  Host host = {0, NULL, 0, ""};
  for (int i = 0; i < count; i++) {
    Random random = start(seed + (uint64_t)i);
    if (host.component != NULL && below(&random, 5) == 0) close_host(&host); /* states that were not freed go with it */
    if (host.component == NULL) {
      const int fmi = 2 + below(&random, 2);
      open_host(&host, fmi, resources[fmi - 2], below(&random, 5) > 0);
    }
    run_sequence(&host, seed + (uint64_t)i);
  }
  if (host.component != NULL) close_host(&host);
  printf("%d sequences, %ld lines\n", count, host.lines);
}

/* Resource locations and tables. ----------------------------------------------------------------------------------- */

static int try_location(Random *random, const char *location, char *line) {
  Host host = {2, NULL, 0, ""};
  fmi2CallbackFunctions functions = {take_line2, NULL, NULL, NULL, &host};
  if (below(random, 2)) {
    host.component = fmi2Instantiate("one", fmi2CoSimulation, TOKEN, location, &functions, 0, 0);
  } else {
    host.component = fmi3InstantiateCoSimulation("one", TOKEN, location, 0, 0, 0, 0, NULL, 0, &host, take_line3, NULL);
    host.fmi = 3;
  }
  const int is_made = host.component != NULL;
  if (is_made) close_host(&host);
  if (is_made == (host.lines == 1)) fail(location, 0); /* either an instance or one line */
  strcpy(line, host.last);
  return is_made;
}

static void choose_location(Random *random, const char *resources, char *location) {
  static const char *const BEGINS[] = {"file://", "file:", "file:///", "FILE://localhost", "file://x", "", "http://"};
  static const char PIECES[] = "/%2F%zz%00%25 \\:?#&+;[]\xc3\xa4\xff%C3%A4..~|C:";
  int size = sprintf(location, "%s%s", BEGINS[below(random, 7)], below(random, 3) ? resources : "");
  for (int i = below(random, 12); i > 0; i--) {
    const int at = below(random, size + 1);
    const char piece = PIECES[below(random, (int)sizeof PIECES - 1)];
    if (below(random, 2) && size > 0) {
      location[below(random, size)] = piece;
    } else {
      memmove(location + at + 1, location + at, (size_t)(size - at) + 1);
      location[at] = piece;
      size++;
    }
  }
  if (below(random, 20) == 0) {
    memset(location + size, 'x', 7000);
    location[size + 7000] = '\0';
  }
}

static size_t read_table(const char *folder, char *text, size_t room) {
  char path[4200];
  snprintf(path, sizeof path, "%s/variables.txt", folder);
  FILE *file = fopen(path, "rb");
  if (file == NULL) fail(path, 0);
  const size_t size = fread(text, 1, room, file);
  fclose(file);
  return size;
}

static void write_table(const char *folder, const char *text, size_t size) {
  char path[4200];
  snprintf(path, sizeof path, "%s/variables.txt", folder);
  FILE *file = fopen(path, "wb");
  if (file == NULL || fwrite(text, 1, size, file) != size || fclose(file) != 0) fail(path, 0);
}

/* A table with some of its bytes or lines changed, mostly with a digest that is right. */
static size_t choose_table(Random *random, const char *from, size_t size, char *text) {
  static const char *const WORDS[] = {"-", "\"\"", "0x1.8p+1", "99999999999", "-1", "\"", "\\", "Real", "Enumeration",
                                      "references", "4294967296", "true", " 0", "\n", "nan", " 18 18 18"};
  memcpy(text, from, size);
  for (int i = 1 + below(random, 4); i > 0; i--) {
    const size_t at = (size_t)below(random, (int)size);
    const char *word = WORDS[below(random, 16)];
    const size_t length = strlen(word);
    switch (below(random, 4)) {
      case 0: text[at] = (char)draw(random); break;
      case 1: size = at + 1; break;
      case 2:
        if (at + length < size) memcpy(text + at, word, length);
        break;
      default:
        memmove(text + at + length, text + at, size - at);
        memcpy(text + at, word, length);
        size += length;
    }
  }
  if (below(random, 5) == 0) return size;
  if (size >= 15 && memcmp(text + size - 15, "crc32 ", 6) == 0) size -= 15;
  if (text[size - 1] != '\n') text[size++] = '\n';
  return size + (size_t)sprintf(text + size, "crc32 %08x\n", crc32((unsigned char *)text, size));
}

static void exercise_locations(const char *resources, const char *folder, uint64_t seed, int count) {
  static char original[1 << 16], text[1 << 17], location[1 << 14], line[512];
  const size_t size = read_table(resources, original, sizeof original);
  int made = 0, read = 0;
  for (int i = 0; i < count; i++) {
    Random random = start(seed + (uint64_t)i);
    choose_location(&random, resources, location);
    made += try_location(&random, location, line);
    write_table(folder, text, choose_table(&random, original, size, text));
    read += try_location(&random, folder, line);
  }
  printf("%d locations, %d with an instance; %d tables, %d with one\n", count, made, count, read);
}

/* Threads. --------------------------------------------------------------------------------------------------------- */

typedef struct {
  const char *const *resources;
  uint64_t seed;
  int count;
  unsigned input2, input3;
  unsigned char *bytes; /* how the last instance ends */
  size_t size;
} Work;

static void *work(void *given) {
  Work *work = given;
  const unsigned push2[3] = {work->input2, work->input2 + 1, work->input2 + 2}, push3[1] = {work->input3};
  for (int i = 0; i < work->count; i++) {
    Host host = {0, NULL, 0, ""};
    void *state = NULL;
    Random random = start(work->seed + (uint64_t)i);
    open_host(&host, 2 + i % 2, work->resources[i % 2], 1);
    if (begin(&host, 0.0, 1e6) != 0) fail(host.last, work->seed);
    for (int k = 0; k < 50; k++) {
      const double push[3] = {(double)below(&random, 9), 1.0, -1.0};
      const int status = host.fmi == 2 ? (int)fmi2SetReal(host.component, push2, 3, push)
                                       : (int)fmi3SetFloat64(host.component, push3, 1, push, 3);
      if (status != 0 || step(&host, k * 0.1, 0.1) != 0) fail(host.last, work->seed);
      if (k == 20 && get_state(&host, &state) != 0) fail(host.last, work->seed);
      if (k == 40 && set_state(&host, state) != 0) fail(host.last, work->seed);
      step(&host, NAN, 0.1); /* a line */
    }
    work->size = snapshot(&host, work->bytes, work->seed);
    close_host(&host);
  }
  return NULL;
}

static void exercise_threads(const char *const *resources, uint64_t seed, int count, unsigned input2, unsigned input3) {
  static unsigned char bytes[3][LARGEST_STATE];
  Work works[3];
  pthread_t threads[2];
  for (int i = 0; i < 3; i++) works[i] = (Work){resources, seed, count, input2, input3, bytes[i], 0};
  for (int i = 0; i < 2; i++) {
    if (pthread_create(&threads[i], NULL, work, &works[i]) != 0) fail("no thread", seed);
  }
  for (int i = 0; i < 2; i++) pthread_join(threads[i], NULL);
  work(&works[2]); /* alone */
  for (int i = 0; i < 2; i++) {
    if (works[i].size != works[2].size || memcmp(bytes[i], bytes[2], works[2].size) != 0) fail("another end", seed);
  }
  printf("2 threads, %d instances each\n", count);
}

/* Growth. ---------------------------------------------------------------------------------------------------------- */

static long resident(void) {
  long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (file == NULL || fscanf(file, "%*s %ld", &pages) != 1) fail("no /proc/self/statm", 0);
  fclose(file);
  return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

static void exercise_growth(const char *const *resources, long steps, long instances, unsigned input, unsigned output,
                            int word) {
  const unsigned PUSH[3] = {input, input + 1, input + 2}, PLACE[3] = {output, output + 1, output + 2};
  const unsigned WORD[1] = {(unsigned)word};
  static const char *const WORDS[] = {"start", "bang", "doubt", "a longer word than the others"};
  Host host = {0, NULL, 0, ""};
  void *state = NULL;
  long first = 0, refused = 0;
  open_host(&host, 2, resources[0], 1);
  if (begin(&host, 0.0, 1e9) != 0) fail(host.last, 0);
  for (long k = 0; k < steps; k++) {
    double values[3] = {(double)(k % 7), k % 1000 == 999 ? NAN : 0.0, 0.0};
    fmi2SetReal(host.component, PUSH, 3, values);
    if (word >= 0) fmi2SetString(host.component, WORD, 1, &WORDS[k % 4]);
    refused += step(&host, (double)k * 0.1, 0.1) != 0;
    fmi2GetReal(host.component, PLACE, 3, values);
    if (k % 10 == 0) get_state(&host, &state);
    if (k % 50 == 0) set_state(&host, state);
    if (k % 100 == 0) free_state(&host, &state);
    if (k == steps / 10) first = resident();
  }
  const long after_steps = resident();
  close_host(&host);
  printf("%ld steps, %ld refused: %ld to %ld kB\n", steps, refused, first, after_steps);
  for (long i = 0; i < instances; i++) {
    open_host(&host, 2 + (int)(i % 2), resources[i % 2], 1);
    begin(&host, 0.0, 1.0);
    state = NULL;
    get_state(&host, &state); /* freed with the instance */
    close_host(&host);
    if (i == instances / 10) first = resident();
  }
  printf("%ld instances: %ld to %ld kB\n", instances, first, resident());
}

/* Rounding. -------------------------------------------------------------------------------------------------------- */

#if defined(__x86_64__)
static void exercise_rounding(const char *resources) {
  static const unsigned GAIN[1] = {13}, PUSH[1] = {7};
  static const unsigned WORDS[] = {0x1F80, 0xFFC0, 0x3F80, 0x0000}; /* standard; to zero, flushed; down; all stop */
  const unsigned INEXACT = 0x20; /* what happened to the host */
  static unsigned char bytes[2][LARGEST_STATE];
  size_t size = 0;
  for (int i = 0; i < 4; i++) {
    Host host = {0, NULL, 0, ""};
    const double tiny = 3e-310, push = 1.0 / 3.0, zero = 0.0;
    open_host(&host, 2, resources, 1);
    fmi2SetReal(host.component, GAIN, 1, &tiny);
    __builtin_ia32_ldmxcsr(WORDS[i] | INEXACT);
    const int begun = begin(&host, 0.0, 1e6);
    fmi2SetReal(host.component, PUSH, 1, &zero);
    int made = step(&host, 0.0, 0.25);
    fmi2SetReal(host.component, PUSH, 1, &push);
    made += step(&host, 0.25, 0.1);
    made += step(&host, NAN, 0.1) == 2 ? 0 : 1;
    const unsigned word = __builtin_ia32_stmxcsr();
    __builtin_ia32_ldmxcsr(0x1F80);
    if (begun != 0 || made != 0) fail(host.last, (uint64_t)i);
    if ((word & ~0x3FU) != WORDS[i] || !(word & INEXACT)) fail("the host's rounding was changed", (uint64_t)i);
    const size_t found = snapshot(&host, bytes[i > 0], (uint64_t)i);
    if (i > 0 && (found != size || memcmp(bytes[0], bytes[1], size) != 0)) fail("other bits", (uint64_t)i);
    size = found;
    close_host(&host);
  }
  printf("4 control words\n");
}
#else
static void exercise_rounding(const char *resources) {
  (void)resources;
  printf("4 control words\n");
}
#endif

int main(int count, char **given) {
  if (count < 3) fail("usage: exercise COMMAND RESOURCES ...", 0);
  const char *const resources[2] = {given[2], count > 3 ? given[3] : ""};
  const long first = count > 4 ? atol(given[4]) : 0, second = count > 5 ? atol(given[5]) : 0;
  const int third = count > 6 ? atoi(given[6]) : -1, fourth = count > 7 ? atoi(given[7]) : 6;
  const unsigned input2 = third < 0 ? 7 : (unsigned)third, input3 = (unsigned)fourth;
  const unsigned output2 = count > 7 ? (unsigned)fourth : 0;
  const int word2 = count > 8 ? atoi(given[8]) : 12;
  if (third > 0) reference_count = third;
  if (strcmp(given[1], "calls") == 0) exercise_calls(resources, (uint64_t)first, (int)second);
  else if (strcmp(given[1], "locations") == 0) exercise_locations(given[2], given[3], (uint64_t)first, (int)second);
  else if (strcmp(given[1], "threads") == 0) exercise_threads(resources, (uint64_t)first, (int)second, input2, input3);
  else if (strcmp(given[1], "growth") == 0) exercise_growth(resources, first, second, input2, output2, word2);
  else if (strcmp(given[1], "rounding") == 0) exercise_rounding(given[2]);
  else fail("no such command", 0);
  return 0;
}
