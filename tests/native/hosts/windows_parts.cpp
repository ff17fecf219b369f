// Parts of native/ that Windows alone has, in a program for it: paths, and large frames of functions.
//
//     windows_parts PATH...     prints each path as it is opened, "none" for one that cannot be; then "frames"
#include <stdio.h>

#include <windows.h>

#include "../../../native/wide_path.hpp"

namespace {

// Functions that touch one end of a frame that is larger than the page which Windows extends a stack by.
template <int SIZE>
[[gnu::noinline]] int use_frame(int a, int b, int c, int d, int e) {
  volatile char frame[SIZE];
  frame[0] = static_cast<char>(a);
  return frame[0] + b + c + d + e;  // all registers of arguments are as before
}

[[gnu::noinline]] int use_frame_of(size_t size) {
  volatile char* frame = static_cast<volatile char*>(__builtin_alloca(size));
  frame[0] = 1;
  return frame[0];
}

// On a stack that nobody has used yet.
DWORD WINAPI use_frames(void* which) {
  int sum = 0;
  switch (reinterpret_cast<size_t>(which)) {
    case 0: return use_frame<4095>(1, 2, 3, 4, 5);
    case 1: return use_frame<4096>(1, 2, 3, 4, 5);
    case 2: return use_frame<4097>(1, 2, 3, 4, 5);
    case 3: return use_frame<8192>(1, 2, 3, 4, 5);
    case 4: return use_frame<40000>(1, 2, 3, 4, 5);
    case 5: return use_frame<700000>(1, 2, 3, 4, 5);
    default:
      for (size_t size = 1; size <= 20000; size++) sum += use_frame_of(size);
      return sum == 20000 ? 15 : 0;
  }
}

}  // namespace

int main(int count, char** given) {
  static wchar_t wide[shipcollision::LONGEST_PATH + 1];
  static char path[4 * shipcollision::LONGEST_PATH];
  for (int i = 1; i < count; i++) {
    const bool is_path = shipcollision::widen(given[i], wide) && shipcollision::narrow(wide, path, sizeof path);
    printf("%s\n", is_path ? path : "none");
  }
  for (size_t which = 0; which < 7; which++) {
    DWORD sum = 0;
    HANDLE thread = CreateThread(nullptr, 1 << 20, use_frames, reinterpret_cast<void*>(which),
                                 STACK_SIZE_PARAM_IS_A_RESERVATION, nullptr);
    WaitForSingleObject(thread, INFINITE);
    GetExitCodeThread(thread, &sum);
    CloseHandle(thread);
    if (sum != 15) return 1;
  }
  printf("frames\n");
  return 0;
}
