// What a library for Windows asks of its start-up code, so that none is linked: building MinGW's takes two minutes.
// The functions of C come from Windows' own library (ucrtbase.dll), which starts itself.
#ifdef _WIN32

// Says to the linker that floating-point numbers are used.
extern "C" int _fltused = 0;

// Constructors of global objects, as the linker lists them: -1, the constructors, 0.
extern "C" void (*__CTOR_LIST__[])();

// Called at loading (reason 1) and unloading, and at the start and end of threads. One is success. Zig before 0.15 asks
// for the second name.
extern "C" int __stdcall DllMainCRTStartup(void*, unsigned long reason, void*) {
  if (reason == 1) {
    int count = 0;
    while (__CTOR_LIST__[count + 1] != nullptr) ++count;
    for (; count > 0; --count) __CTOR_LIST__[count]();
  }
  return 1;
}
extern "C" int __stdcall _DllMainCRTStartup(void* library, unsigned long reason, void* reserved) {
  return DllMainCRTStartup(library, reason, reserved);
}

// Called by functions with more than a page of local variables, with their size in rax. It touches every page below the
// stack pointer once, in order, since Windows extends a stack by the next page only. No register may change.
__asm__(
    ".globl ___chkstk_ms\n"
    "___chkstk_ms:\n"
    "  pushq %rax\n"
    "  pushq %rcx\n"
    "  leaq 24(%rsp), %rcx\n"  // the caller's stack pointer
    "1:\n"
    "  cmpq $4096, %rax\n"
    "  jbe 2f\n"
    "  subq $4096, %rcx\n"
    "  orb $0, (%rcx)\n"
    "  subq $4096, %rax\n"
    "  jmp 1b\n"
    "2:\n"
    "  subq %rax, %rcx\n"
    "  orb $0, (%rcx)\n"
    "  popq %rcx\n"
    "  popq %rax\n"
    "  ret\n");

#endif
