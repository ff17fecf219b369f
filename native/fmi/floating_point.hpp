// How the processor rounds, as this library needs it: a host may have set it to flush small numbers to zero, to round
// otherwise, or to stop at a NaN.
#pragma once

#include <stdint.h>

namespace shipcollision {

// While it lives, the processor rounds to nearest, keeps small numbers and stops at nothing; then as before.
class FloatingPoint {
 public:
  FloatingPoint() : before_(get()) {
    if (is_other()) set(STANDARD);
  }
  ~FloatingPoint() {
    if (is_other()) set(before_);
  }
  FloatingPoint(const FloatingPoint&) = delete;
  FloatingPoint& operator=(const FloatingPoint&) = delete;

 private:
#if defined(__x86_64__)
  using Word = uint32_t;
  static constexpr Word STANDARD = 0x1F80;  // MXCSR: all exceptions masked, no flags raised
  static constexpr Word FLAGS = 0x3F;       // what happened so far
  static Word get() { return __builtin_ia32_stmxcsr(); }
  static void set(Word word) { __builtin_ia32_ldmxcsr(word); }
#elif defined(__aarch64__)
  using Word = uint64_t;
  static constexpr Word STANDARD = 0;  // FPCR
  static constexpr Word FLAGS = 0;     // they are in another register
  static Word get() {
    Word word;
    __asm__ volatile("mrs %0, fpcr" : "=r"(word));
    return word;
  }
  static void set(Word word) { __asm__ volatile("msr fpcr, %0" : : "r"(word) : "memory"); }
#else
#error "this processor's floating-point control word is not known here: add its two instructions"
#endif

  bool is_other() const { return (before_ & ~FLAGS) != STANDARD; }

  Word before_;
};

}  // namespace shipcollision
