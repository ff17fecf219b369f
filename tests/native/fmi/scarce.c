/* A host in C that has no memory left, from the Nth request on:
 *
 *     scarce LIBRARY GUID RESOURCES       FMI 2.0
 *
 * N counts from 0 until nothing fails. Each call is then refused or made; where it is refused, it is made as soon as
 * there is memory again. It prints how often that was, and ends with 1 and a line where it was not so. */

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);

static long left = -1; /* requests that are granted; below 0: all */

static int is_refused(void) {
  if (left > 0) left--;
  return left == 0;
}

/* These stand before those of the C library. */
void *malloc(size_t size) { return is_refused() ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return is_refused() ? NULL : __libc_calloc(count, size); }
void *realloc(void *memory, size_t size) { return is_refused() ? NULL : __libc_realloc(memory, size); }

static void *library;

#define CALL(NAME) ((fmi2##NAME##TYPE *)dlsym(library, "fmi2" #NAME))

static void die(const char *what, long n) {
  left = -1;
  fprintf(stderr, "after %ld requests: %s\n", n, what);
  exit(1);
}

static void hear(fmi2ComponentEnvironment to, fmi2String who, fmi2Status status, fmi2String category, fmi2String text,
                 ...) {
  (void)to, (void)who, (void)status, (void)category, (void)text;
}

static const fmi2CallbackFunctions CALLBACKS = {hear, NULL, NULL, NULL, NULL};
static void *instance, *state;
static fmi2Byte bytes[65536];
static size_t size;

static int exit_initialisation(void) { return CALL(ExitInitializationMode)(instance); }
static int step(void) { return CALL(DoStep)(instance, 0.0, 0.1, 1); }
static int get_state(void) { return CALL(GetFMUstate)(instance, &state); }
static int set_state(void) { return CALL(SetFMUstate)(instance, state); }
static int read_state(void) { return CALL(DeSerializeFMUstate)(instance, bytes, size, &state); }

/* How often a call was refused, 0 or 1: with memory it is made. */
static int ask(int (*call)(void), const char *what, long n) {
  if (call() == 0) return 0;
  const long before = left;
  left = -1;
  if (call() != 0) die(what, n);
  left = before;
  return 1;
}

static int open_instance(char **given) {
  instance = CALL(Instantiate)("one", fmi2CoSimulation, given[2], given[3], &CALLBACKS, 0, 1);
  if (instance != NULL) return 0;
  left = -1;
  instance = CALL(Instantiate)("one", fmi2CoSimulation, given[2], given[3], &CALLBACKS, 0, 1);
  if (instance == NULL) die("no instance", 0);
  left = 0;
  return 1;
}

static void close_instance(void) {
  CALL(FreeInstance)(instance);
  instance = state = NULL;
}

int main(int count, char **given) {
  if (count != 4 || (library = dlopen(given[1], RTLD_NOW)) == NULL) die("usage: scarce LIBRARY GUID RESOURCES", 0);
  int total = 0, refused;
  long n = 0;
  do {
    left = ++n;
    refused = open_instance(given);
    CALL(SetupExperiment)(instance, 0, 0.0, 0.0, 0, 0.0);
    CALL(EnterInitializationMode)(instance);
    refused += ask(exit_initialisation, "cannot be initialised", n) + ask(step, "no step", n);
    refused += ask(get_state, "no state", n) + ask(set_state, "state not set", n);
    if (CALL(SerializedFMUstateSize)(instance, state, &size) != 0 || size > sizeof bytes) die("no size", n);
    if (CALL(SerializeFMUstate)(instance, state, bytes, size) != 0) die("no bytes", n);
    close_instance();
    refused += open_instance(given);
    refused += ask(read_state, "bytes not read", n) + ask(set_state, "state not set elsewhere", n);
    refused += ask(step, "no step after it", n);
    close_instance();
    total += refused;
  } while (refused > 0);
  printf("%d refused, %ld requests\n", total, n);
  return 0;
}
