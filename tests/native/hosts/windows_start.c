/* What a program for Windows asks of MinGW's start-up code and library, which Zig would compile first, in two minutes.
 * The functions of C come from Windows' own library (ucrtbase.dll), and what native/windows.cpp has is linked as well. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <windows.h>
#include <shellapi.h>

enum { LONGEST = 16384, AS_IN_C = 2 /* snprintf returns what it would have written, and ends it with a zero */ };

int main(int count, char **given);

void __main(void) {}

/* The arguments of main are UTF-8, as FMI's strings are. */
void mainCRTStartup(void) {
  int count;
  wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), &count);
  char **given = calloc((size_t)count + 1, sizeof *given);
  for (int i = 0; i < count; i++)
    WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, given[i] = malloc(LONGEST), LONGEST, NULL, NULL);
  exit(main(count, given));
}

int vfprintf(FILE *to, const char *format, va_list values) {
  return __stdio_common_vfprintf(0, to, format, NULL, values);
}

int fprintf(FILE *to, const char *format, ...) {
  va_list values;
  va_start(values, format);
  const int size = vfprintf(to, format, values);
  va_end(values);
  return size;
}

int printf(const char *format, ...) {
  va_list values;
  va_start(values, format);
  const int size = vfprintf(stdout, format, values);
  va_end(values);
  return size;
}

int snprintf(char *to, size_t capacity, const char *format, ...) {
  va_list values;
  va_start(values, format);
  const int size = __stdio_common_vsprintf(AS_IN_C, to, capacity, format, NULL, values);
  va_end(values);
  return size;
}
