// What the files kernels_*.cpp share: parts of native/collision by name, numbers in and numbers out.
#include <string.h>

#include "../../../native/collision/bodies.hpp"
#include "../../../native/export.hpp"

namespace shipcollision {

struct Named {
  const char* name;
  void (*kernel)(const double* in, double* out);
};

// `count` evaluations of the kernel of that name, `ins` numbers in and `outs` out of each. False for an unknown name.
template <size_t COUNT>
bool evaluate(const Named (&kernels)[COUNT], const char* name, const double* in, size_t ins, double* out, size_t outs,
              size_t count) {
  for (const Named& named : kernels) {
    if (strcmp(named.name, name) != 0) continue;
    for (size_t i = 0; i < count; ++i) named.kernel(in + i * ins, out + i * outs);
    return true;
  }
  return false;
}

// Takes numbers from a row one after the other, and puts them.
struct Take {
  const double* in;

  double real() { return *in++; }
  int whole() { return static_cast<int>(*in++); }
  template <typename Numbers>
  Numbers all() {
    Numbers numbers;
    static_assert(sizeof numbers % sizeof(double) == 0, "real numbers alone");
    memcpy(static_cast<void*>(&numbers), in, sizeof numbers);
    in += sizeof numbers / sizeof(double);
    return numbers;
  }
  void matrix(Matrix& numbers) {
    memcpy(numbers, in, sizeof numbers);
    in += 36;
  }
};

struct Put {
  double* out;

  void real(double number) { *out++ = number; }
  template <typename Numbers>
  void all(const Numbers& numbers) {
    static_assert(sizeof numbers % sizeof(double) == 0, "real numbers alone");
    memcpy(out, &numbers, sizeof numbers);
    out += sizeof numbers / sizeof(double);
  }
};

// A body: position, attitude, nu, M_inverse, r_bg, and whether it is fixed; 52 numbers.
inline BodyState take_state(Take& take) {
  const Three position = take.all<Three>(), attitude = take.all<Three>();
  const Six nu = take.all<Six>();
  Matrix inverse;
  take.matrix(inverse);
  BodyState state;
  state.start_at(position, attitude, nu, inverse, take.all<Three>());
  state.fixed = take.real() != 0.0;
  return state;
}

// Those that were opened last.
const Bodies& get_kernel_bodies();

}  // namespace shipcollision
