/* A host in C: the three instances of a packaged encounter, stepped in parallel through the C interface of FMI 2.0.
 *
 *     cc -O2 -o host examples/host.c -ldl     on Linux; on Windows any compiler of C, without -ldl
 *     ./host FOLDER STEP STEPS SHIP SHIP      FOLDER holds SHIP/ and collision/: FMUs of a package, unpacked
 *
 * The FMUs start from the scenario's values, so that no parameter is set here. Where they run Python, docs/guide/hosts.md
 * says what the process needs; native ones need nothing. For real use take the headers of the FMI standard; these are the
 * few declarations used below. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#include <windows.h>
#define LIBRARY "%s/%s/binaries/win64/%s.dll"
static void *load(const char *path) { return (void *)LoadLibraryA(path); }
static void *find(void *library, const char *name) { return (void *)GetProcAddress((HMODULE)library, name); }
static const char *explain(const char *path) { return path; }
#else
#include <dlfcn.h>
#if defined(__aarch64__)
#define LIBRARY "%s/%s/binaries/aarch64-linux/%s.so"
#else
#define LIBRARY "%s/%s/binaries/linux64/%s.so"
#endif
static void *load(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *find(void *library, const char *name) { return dlsym(library, name); }
static const char *explain(const char *path) { return (void)path, dlerror(); }
#endif

typedef void *Component;
typedef int Status; /* 0 ok, 1 warning, 2 discard, 3 error, 4 fatal, 5 pending */
typedef void (*Logger)(void *, const char *, Status, const char *, const char *, ...);
typedef struct {
  Logger logger;
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, Status);
  void *environment;
} Callbacks;

typedef struct {
  char *description; /* modelDescription.xml */
  Component component;
  Status (*get)(Component, const unsigned *, size_t, double *);
  Status (*set)(Component, const unsigned *, size_t, const double *);
  Status (*step)(Component, double, double, int);
  Status (*terminate)(Component);
  void (*release)(Component);
} Slave;

enum { STATE = 12, IMPULSE = 6 };
static const char *const STATES[STATE + IMPULSE] = {
    "position.north", "position.east", "position.down", "attitude.roll", "attitude.pitch", "attitude.yaw",
    "velocity.surge", "velocity.sway", "velocity.heave", "rate.roll", "rate.pitch", "rate.yaw",
    "impulse_applied.surge", "impulse_applied.sway", "impulse_applied.heave",
    "impulse_applied.roll", "impulse_applied.pitch", "impulse_applied.yaw"};
static const char *const IMPULSES[IMPULSE] = {"impulse.surge", "impulse.sway",  "impulse.heave",
                                              "impulse.roll",  "impulse.pitch", "impulse.yaw"};

/* Ends at once: the FMUs' libraries must not be unloaded while they still have instances. */
static void die(const char *what, const char *which) {
  fprintf(stderr, "error: %s: %s\n", what, which);
  _Exit(1);
}

static void check(Status status, const char *what, const char *which) {
  if (status > 1) die(what, which);
}

static void logger(void *environment, const char *name, Status status, const char *category, const char *text, ...) {
  va_list values;
  (void)environment, (void)category;
  va_start(values, text);
  fprintf(stderr, "[%s, status %d] ", name, status);
  vfprintf(stderr, text, values);
  fputc('\n', stderr);
  va_end(values);
}

static char *contents(const char *path) {
  FILE *file = fopen(path, "rb");
  if (!file) die("cannot read", path);
  fseek(file, 0, SEEK_END);
  long size = ftell(file);
  rewind(file);
  char *text = calloc(size + 1, 1);
  if (fread(text, 1, size, file) != (size_t)size) die("cannot read", path);
  fclose(file);
  return text;
}

/* The value of an attribute that follows `mark` in the text; "" when there is none. Good enough for FMUs like these. */
static void attribute(const char *text, const char *mark, char *value, size_t size) {
  const char *found = strstr(text, mark);
  value[0] = '\0';
  if (found) snprintf(value, size, "%.*s", (int)strcspn(found + strlen(mark), "\""), found + strlen(mark));
}

static unsigned reference(const Slave *slave, const char *prefix, const char *name) {
  char mark[200], value[20];
  snprintf(mark, sizeof mark, "name=\"%s%s\" valueReference=\"", prefix, name);
  attribute(slave->description, mark, value, sizeof value);
  if (!value[0]) die("no variable", mark);
  return (unsigned)atoi(value);
}

static void *function(void *library, const char *name) {
  void *found = find(library, name);
  if (!found) die("no function", name);
  return found;
}

static Slave started(const char *folder, const char *name) {
  static Callbacks callbacks = {logger, calloc, free, NULL, NULL};
  Slave slave;
  char path[4096], place[4200], guid[100], model[100];
  snprintf(path, sizeof path, "%s/%s/modelDescription.xml", folder, name);
  slave.description = contents(path);
  attribute(slave.description, "guid=\"", guid, sizeof guid);
  attribute(slave.description, "modelIdentifier=\"", model, sizeof model);
  snprintf(path, sizeof path, LIBRARY, folder, name, model);
  void *library = load(path);
  if (!library) die("cannot load", explain(path));
  Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int);
  Status (*setup)(Component, int, double, double, int, double), (*enter)(Component), (*leave)(Component);
  *(void **)&instantiate = function(library, "fmi2Instantiate");
  *(void **)&setup = function(library, "fmi2SetupExperiment");
  *(void **)&enter = function(library, "fmi2EnterInitializationMode");
  *(void **)&leave = function(library, "fmi2ExitInitializationMode");
  *(void **)&slave.get = function(library, "fmi2GetReal");
  *(void **)&slave.set = function(library, "fmi2SetReal");
  *(void **)&slave.step = function(library, "fmi2DoStep");
  *(void **)&slave.terminate = function(library, "fmi2Terminate");
  *(void **)&slave.release = function(library, "fmi2FreeInstance");
  snprintf(place, sizeof place, "file://%s%s/%s/resources", folder[0] == '/' ? "" : "/", folder, name);
  slave.component = instantiate(name, 1 /* co-simulation */, guid, place, &callbacks, 0, 1 /* with a log */);
  if (!slave.component) die("cannot instantiate", name);
  check(setup(slave.component, 0, 0.0, 0.0, 0, 0.0), "setup", name);
  check(enter(slave.component), "initialisation", name);
  check(leave(slave.component), "initialisation", name);
  return slave;
}

int main(int count, char **given) {
  if (count != 6) die("usage", "host FOLDER STEP STEPS SHIP SHIP");
  const double h = atof(given[2]);
  const int steps = atoi(given[3]);
  Slave collision = started(given[1], "collision"), ships[2];
  unsigned out[2][STATE + IMPULSE], in[2][IMPULSE], taken[2][STATE + IMPULSE], issued[2][IMPULSE];
  double state[2][STATE + IMPULSE], impulse[2][IMPULSE];
  for (int i = 0; i < 2; i++) {
    char prefix[100];
    ships[i] = started(given[1], given[4 + i]);
    snprintf(prefix, sizeof prefix, "%s.", given[4 + i]);
    for (int j = 0; j < STATE + IMPULSE; j++) {
      out[i][j] = reference(&ships[i], "", STATES[j]);
      taken[i][j] = reference(&collision, prefix, STATES[j]);
    }
    for (int j = 0; j < IMPULSE; j++) {
      in[i][j] = reference(&ships[i], "", IMPULSES[j]);
      issued[i][j] = reference(&collision, prefix, IMPULSES[j]);
    }
  }
  for (int k = 0; k < steps; k++) {
    for (int i = 0; i < 2; i++) {
      check(ships[i].get(ships[i].component, out[i], STATE + IMPULSE, state[i]), "get", given[4 + i]);
      check(collision.get(collision.component, issued[i], IMPULSE, impulse[i]), "get", "collision");
    }
    for (int i = 0; i < 2; i++) {
      check(collision.set(collision.component, taken[i], STATE + IMPULSE, state[i]), "set", "collision");
      check(ships[i].set(ships[i].component, in[i], IMPULSE, impulse[i]), "set", given[4 + i]);
    }
    check(collision.step(collision.component, k * h, h, 1), "step", "collision");
    for (int i = 0; i < 2; i++) check(ships[i].step(ships[i].component, k * h, h, 1), "step", given[4 + i]);
  }
  for (int i = 0; i < 2; i++) {
    check(ships[i].get(ships[i].component, out[i], STATE + IMPULSE, state[i]), "get", given[4 + i]);
    printf("%s", given[4 + i]);
    for (int j = 0; j < STATE + IMPULSE; j++) printf(" %.17g", state[i][j]);
    printf("\n");
  }
  for (int i = 0; i < 2; i++) ships[i].terminate(ships[i].component), ships[i].release(ships[i].component);
  collision.terminate(collision.component);
  collision.release(collision.component);
  return 0;
}
