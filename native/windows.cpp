// What a library for Windows asks of its start-up code, so that none is linked: building MinGW's takes two minutes.
// The functions of C come from Windows' own library (ucrtbase.dll), which starts itself. Start-up code would also run
// the constructors of global objects: there are none, and the compiler's option -Wglobal-constructors holds that.
#ifdef _WIN32

// Says to the linker that floating-point numbers are used.
extern "C" int _fltused = 0;

// Called at loading and at the start and end of threads: nothing to do. One is success. Zig before 0.15 asks for the
// second name.
extern "C" int __stdcall DllMainCRTStartup(void*, unsigned long, void*) { return 1; }
extern "C" int __stdcall _DllMainCRTStartup(void*, unsigned long, void*) { return 1; }

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
