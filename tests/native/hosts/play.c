/* A host in C that plays a script: calls of FMI 2.0 or 3.0 on one instance, one a line; it needs nothing but libc.
 *
 *     play 2|3 LIBRARY TOKEN RESOURCES < SCRIPT
 *
 *     real|integer|boolean|string REFERENCE VALUE...   set; Reals as the 16 hexadecimal digits of their bits
 *     begin START                                      through initialisation
 *     step TIME LENGTH                                 Reals as well
 *     get REFERENCE COUNT                              prints Reals by their bits
 *     state                                            prints the digest of the serialised state
 *     save, restore                                    one state, from its bytes
 *     end
 *
 * The same source is compiled for Linux, Windows and ARM, and prints the same there if the library's bits are the same.
 * windows_start.c begins it on Windows.
 * What the instance logs goes to standard error. A status above 1 ends the program with 1 and a line. */

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2FunctionTypes.h"
#include "fmi3FunctionTypes.h"

#ifdef _WIN32
#include <windows.h>
static void *load(const char *path) {
  wchar_t wide[4096];
  MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 4096);
  return (void *)LoadLibraryW(wide);
}
static void *find(void *library, const char *name) { return (void *)GetProcAddress((HMODULE)library, name); }
#else
#include <dlfcn.h>
static void *load(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *find(void *library, const char *name) { return dlsym(library, name); }
#endif

enum { MOST = 64, LONGEST = 8192 };

static int fmi;
static void *library, *instance;
static char *bytes; /* of the saved state */
static size_t size;

static void die(const char *what, const char *which) {
  fprintf(stderr, "error: %s: %s\n", what, which);
  exit(1);
}

static void check(int status, const char *what) {
  if (status > 1) die("refused", what);
}

/* The function of the version in use: fmi2NAME or fmi3NAME. */
static void *function(const char *name) {
  char whole[100];
  snprintf(whole, sizeof whole, "fmi%d%s", fmi, name);
  void *found = find(library, whole);
  if (!found) die("no function", whole);
  return found;
}

#define FMI2(NAME) ((fmi2##NAME##TYPE *)function(#NAME))
#define FMI3(NAME) ((fmi3##NAME##TYPE *)function(#NAME))

static void hear2(fmi2ComponentEnvironment to, fmi2String who, fmi2Status status, fmi2String category, fmi2String text,
                  ...) {
  va_list values;
  (void)to;
  va_start(values, text);
  fprintf(stderr, "[%s %d %s] ", who, (int)status, category ? category : "");
  vfprintf(stderr, text, values);
  fputc('\n', stderr);
  va_end(values);
}

static void hear3(fmi3InstanceEnvironment to, fmi3Status status, fmi3String category, fmi3String text) {
  (void)to;
  fprintf(stderr, "[%d %s] %s\n", (int)status, category ? category : "", text);
}

static double from_bits(const char *digits) {
  uint64_t bits = strtoull(digits, NULL, 16);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static void print(const double *values, size_t count) {
  for (size_t i = 0; i < count; i++) {
    uint64_t bits;
    memcpy(&bits, &values[i], sizeof bits);
    printf(i ? " %016llx" : "%016llx", (unsigned long long)bits);
  }
  printf("\n");
}

static void instantiate(const char *token, const char *resources) {
  static const fmi2CallbackFunctions callbacks = {hear2, calloc, free, NULL, NULL};
  if (fmi == 2)
    instance = FMI2(Instantiate)("host", fmi2CoSimulation, token, resources, &callbacks, fmi2False, fmi2True);
  else
    instance = FMI3(InstantiateCoSimulation)("host", token, resources, fmi3False, fmi3True, fmi3False, fmi3False, NULL,
                                             0, NULL, hear3, NULL);
  if (!instance) die("cannot instantiate", resources);
}

static void begin(double start) {
  if (fmi == 2) {
    check(FMI2(SetupExperiment)(instance, fmi2False, 0.0, start, fmi2False, 0.0), "setup");
    check(FMI2(EnterInitializationMode)(instance), "enter");
    check(FMI2(ExitInitializationMode)(instance), "exit");
  } else {
    check(FMI3(EnterInitializationMode)(instance, fmi3False, 0.0, start, fmi3False, 0.0), "enter");
    check(FMI3(ExitInitializationMode)(instance), "exit");
  }
}

static void step(double t, double h) {
  fmi3Boolean event, terminate, early;
  fmi3Float64 last;
  if (fmi == 2)
    check(FMI2(DoStep)(instance, t, h, fmi2True), "step");
  else
    check(FMI3(DoStep)(instance, t, h, fmi3True, &event, &terminate, &early, &last), "step");
}

static void set(const char *kind, unsigned reference, int count, char **words) {
  double reals[MOST];
  int32_t integers[MOST];
  fmi2Boolean booleans2[MOST];
  fmi3Boolean booleans3[MOST];
  const char *strings[MOST];
  for (int i = 0; i < count; i++) {
    reals[i] = from_bits(words[i]);
    integers[i] = atoi(words[i]);
    booleans2[i] = booleans3[i] = atoi(words[i]) != 0;
    strings[i] = words[i];
  }
  int status = 3;
  switch (kind[0]) {
    case 'r':
      status = fmi == 2 ? (int)FMI2(SetReal)(instance, &reference, 1, reals)
                        : (int)FMI3(SetFloat64)(instance, &reference, 1, reals, count);
      break;
    case 'i':
      status = fmi == 2 ? (int)FMI2(SetInteger)(instance, &reference, 1, integers)
                        : (int)FMI3(SetInt32)(instance, &reference, 1, integers, count);
      break;
    case 'b':
      status = fmi == 2 ? (int)FMI2(SetBoolean)(instance, &reference, 1, booleans2)
                        : (int)FMI3(SetBoolean)(instance, &reference, 1, booleans3, count);
      break;
    case 's':
      status = fmi == 2 ? (int)FMI2(SetString)(instance, &reference, 1, strings)
                        : (int)FMI3(SetString)(instance, &reference, 1, strings, count);
      break;
  }
  check(status, kind);
}

static void get(unsigned reference, size_t count) {
  double values[MOST];
  check(fmi == 2 ? (int)FMI2(GetReal)(instance, &reference, 1, values)
                 : (int)FMI3(GetFloat64)(instance, &reference, 1, values, count),
        "get");
  print(values, count);
}

static void save(void) {
  void *state = NULL;
  free(bytes);
  if (fmi == 2) {
    check(FMI2(GetFMUstate)(instance, &state), "get state");
    check(FMI2(SerializedFMUstateSize)(instance, state, &size), "size");
    check(FMI2(SerializeFMUstate)(instance, state, bytes = malloc(size), size), "serialise");
    check(FMI2(FreeFMUstate)(instance, &state), "free state");
  } else {
    check(FMI3(GetFMUState)(instance, &state), "get state");
    check(FMI3(SerializedFMUStateSize)(instance, state, &size), "size");
    check(FMI3(SerializeFMUState)(instance, state, (fmi3Byte *)(bytes = malloc(size)), size), "serialise");
    check(FMI3(FreeFMUState)(instance, &state), "free state");
  }
  if (state) die("state handle", "is not null after it was freed");
}

static void restore(void) {
  void *state = NULL;
  if (fmi == 2) {
    check(FMI2(DeSerializeFMUstate)(instance, bytes, size, &state), "deserialise");
    check(FMI2(SetFMUstate)(instance, state), "set state");
    check(FMI2(FreeFMUstate)(instance, &state), "free state");
  } else {
    check(FMI3(DeserializeFMUState)(instance, (const fmi3Byte *)bytes, size, &state), "deserialise");
    check(FMI3(SetFMUState)(instance, state), "set state");
    check(FMI3(FreeFMUState)(instance, &state), "free state");
  }
}

/* FNV-1a of the state's bytes. */
static void digest(void) {
  uint64_t hash = 0xcbf29ce484222325u;
  save();
  for (size_t i = 0; i < size; i++) hash = (hash ^ (unsigned char)bytes[i]) * 0x100000001b3u;
  printf("%016llx\n", (unsigned long long)hash);
}

static void play(char *line) {
  char *words[MOST + 2];
  int count = 0;
  for (char *word = strtok(line, " \n"); word && count < MOST + 2; word = strtok(NULL, " \n")) words[count++] = word;
  if (!count) return;
  if (!strcmp(words[0], "begin")) begin(from_bits(words[1]));
  else if (!strcmp(words[0], "step")) step(from_bits(words[1]), from_bits(words[2]));
  else if (!strcmp(words[0], "get")) get((unsigned)atoi(words[1]), (size_t)atoi(words[2]));
  else if (!strcmp(words[0], "state")) digest();
  else if (!strcmp(words[0], "save")) save();
  else if (!strcmp(words[0], "restore")) restore();
  else set(words[0], (unsigned)atoi(words[1]), count - 2, words + 2);
}

int main(int count, char **given) {
  static char line[LONGEST];
  if (count != 5) die("usage", "play 2|3 LIBRARY TOKEN RESOURCES < SCRIPT");
  fmi = atoi(given[1]);
  library = load(given[2]);
  if (!library) die("cannot load", given[2]);
  instantiate(given[3], given[4]);
  while (fgets(line, sizeof line, stdin)) play(line);
  if (fmi == 2) {
    check(FMI2(Terminate)(instance), "terminate");
    FMI2(FreeInstance)(instance);
  } else {
    check(FMI3(Terminate)(instance), "terminate");
    FMI3(FreeInstance)(instance);
  }
  free(bytes);
  return 0;
}
