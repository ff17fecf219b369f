// Elementary functions without a libm: the bits depend on the rounding of + - * / and sqrt alone.
//
// The method is the same everywhere: reduce the argument, evaluate a polynomial on a short interval, add the large part
// last. Where rounding of the reduced argument would be felt, a second number carries what the first one lost. The
// polynomials are Chebyshev fits of the interval named beside them, computed with 90 digits; the constants in several
// parts are the digits of pi, 2/pi and ln 2. tests/native/numbers/test_elementary.py holds every function to 2 units in
// the last place.
#include "elementary.hpp"

#include <stdint.h>

namespace shipcollision {

namespace {

constexpr double NOT_A_NUMBER = __builtin_nan("");

// A number as an unevaluated sum.
struct Pair {
  double high, low;
};

// a + b without error; any order of magnitudes.
Pair add_exactly(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

// a b without error, while nothing overflows (Dekker 1971: halves of 26 bits).
Pair multiply_exactly(double a, double b) {
  constexpr double SPLIT = 134217729.0;  // 2^27 + 1
  const double a_high = a * SPLIT - (a * SPLIT - a), a_low = a - a_high;
  const double b_high = b * SPLIT - (b * SPLIT - b), b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

template <int COUNT>
double evaluate(const double (&coefficients)[COUNT], double x) {
  double value = coefficients[COUNT - 1];
  for (int i = COUNT - 2; i >= 0; --i) value = value * x + coefficients[i];
  return value;
}

uint64_t to_bits(double x) {
  uint64_t bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  return bits;
}

double from_bits(uint64_t bits) {
  double x;
  __builtin_memcpy(&x, &bits, sizeof x);
  return x;
}

// 2^exponent, for exponents of normal numbers.
double power_of_two(int exponent) { return from_bits(static_cast<uint64_t>(exponent + 1023) << 52); }

constexpr Pair HALF_PI = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

// --- sine, cosine, tangent ------------------------------------------------------------------------------------------

// An angle as quadrant * pi/2 + rest, the rest within pi/4 and good to 100 bits.
struct Reduced {
  int quadrant;
  Pair rest;
};

// Angles below this are reduced by four parts of pi/2, of 32 bits each: their products with the quadrant are exact.
constexpr double LARGE_ANGLE = 0x1p20;

Reduced reduce_moderate(double x) {
  const double turns = floor(x * 0.6366197723675814 + 0.5);
  const double first = x - turns * 0x1.921fb544p+0;
  const Pair second = add_exactly(first, -turns * 0x1.0b4611a6p-34);
  const Pair third = add_exactly(second.high, -turns * 0x1.3198a2ep-69);
  const double left = (second.low + third.low) - turns * 0x1.b839a252049c1p-104;
  const double rest = third.high + left;
  return {static_cast<int>(static_cast<long long>(turns) & 3), {rest, (third.high - rest) + left}};
}

// Two words of zero, then 2/pi in words of 32 bits. The largest double needs 1161 bits of it.
constexpr uint32_t TWO_OVER_PI[] = {
    0,          0,          0xA2F9836E, 0x4E441529, 0xFC2757D1, 0xF534DDC0, 0xDB629599, 0x3C439041, 0xFE5163AB,
    0xDEBBC561, 0xB7246E3A, 0x424DD2E0, 0x06492EEA, 0x09D1921C, 0xFE1DEB1C, 0xB129A73E, 0xE88235F5, 0x2EBB4484,
    0xE99C7026, 0xB45F7E41, 0x3991D639, 0x835339F4, 0x9C845F8B, 0xBDF9283B, 0x1FF897FF, 0xDE05980F, 0xEF2F118B,
    0x5A0A6D1F, 0x6D367ECF, 0x27CB09B7, 0x4F463F66, 0x9E5FEA2D, 0x7527BAC7, 0xEBE5F17B, 0x3D0739F7, 0x8A5292EA,
    0x6BFB5FB1, 0x1F8D5D08, 0x56033046, 0xFC7B6BAB, 0xF0CFBC20};

// Payne and Hanek's method (1983), for x >= LARGE_ANGLE: x = m 2^e with a whole m, and only those 192 bits of 2/pi are
// multiplied which decide on x 2/pi modulo 4.
Reduced reduce_large(double x) {
  constexpr int WORDS = 6;
  const uint64_t bits = to_bits(x);
  const uint64_t mantissa = (bits & 0xFFFFFFFFFFFFFull) | 0x10000000000000ull;
  const int first_bit = static_cast<int>(bits >> 52) - 1075 - 2 + 64;  // e - 2, behind the words of zero
  const uint64_t low = mantissa & 0xFFFFFFFF, high = mantissa >> 32;

  uint32_t window[WORDS];  // the most significant first, as in the table
  for (int i = 0; i < WORDS; ++i) {
    const uint32_t* word = TWO_OVER_PI + first_bit / 32 + i;
    const uint64_t both = static_cast<uint64_t>(word[0]) << 32 | word[1];
    window[i] = static_cast<uint32_t>(both >> (32 - first_bit % 32));
  }
  uint32_t product[WORDS];  // modulo 2^192
  uint64_t carry = 0;
  for (int i = WORDS - 1; i >= 0; --i) {
    const uint64_t by_low = window[i] * low;
    const uint64_t by_high = i + 1 < WORDS ? window[i + 1] * high : 0;
    const uint64_t sum = (by_low & 0xFFFFFFFF) + (by_high & 0xFFFFFFFF) + (carry & 0xFFFFFFFF);
    product[i] = static_cast<uint32_t>(sum);
    carry = (by_low >> 32) + (by_high >> 32) + (carry >> 32) + (sum >> 32);
  }
  // Two bits of quadrant, then the fraction, rounded to the nearest quadrant.
  int quadrant = static_cast<int>(product[0] >> 30);
  const bool is_negative = (product[0] >> 29 & 1) != 0;
  if (is_negative) ++quadrant;
  Pair fraction = {0.0, 0.0};
  double unit = is_negative ? -0x1p-30 : 0x1p-30;
  for (int i = 0; i < WORDS; ++i, unit *= 0x1p-32) {
    uint32_t word = is_negative ? ~product[i] : product[i];
    if (i == 0) word &= 0x3FFFFFFF;
    const Pair sum = add_exactly(fraction.high, word * unit);
    fraction = {sum.high, fraction.low + sum.low};
  }
  const Pair rest = multiply_exactly(fraction.high, HALF_PI.high);
  const double left = rest.low + (fraction.high * HALF_PI.low + fraction.low * HALF_PI.high);
  const double whole = rest.high + left;
  return {quadrant & 3, {whole, (rest.high - whole) + left}};
}

// For finite angles.
Reduced reduce(double x) {
  if (abs(x) <= PI / 4) return {0, {x, 0.0}};
  if (abs(x) < LARGE_ANGLE) return reduce_moderate(x);
  const Reduced reduced = reduce_large(abs(x));
  if (x > 0.0) return reduced;
  return {-reduced.quadrant & 3, {-reduced.rest.high, -reduced.rest.low}};
}

// Within pi/4: sin(r)/r = 1 + z S(z) and cos(r) = 1 - z/2 + z^2 C(z), z = r^2; error 1.2e-20.
constexpr double SINE[] = {-0.16666666666666666,  0.008333333333333331,  -0.0001984126984126504, 2.755731921932058e-06,
                           -2.50521062259944e-08, 1.6058530596645953e-10, -7.586636882825159e-13};
constexpr double COSINE[] = {0.041666666666666664,   -0.0013888888888888887, 2.4801587301584632e-05,
                             -2.755731922139249e-07, 2.0876755787492604e-09, -1.1470460319209511e-11,
                             4.745838412531023e-14};

Pair sine(Pair r) {
  const double z = r.high * r.high;
  const double rest = r.high * z * evaluate(SINE, z) + r.low * (1.0 - 0.5 * z);
  const double value = r.high + rest;
  return {value, (r.high - value) + rest};
}

Pair cosine(Pair r) {
  const double z = r.high * r.high, half = 0.5 * z;
  const double most = 1.0 - half;
  const double rest = ((1.0 - most) - half) + (z * z * evaluate(COSINE, z) - r.high * r.low);
  const double value = most + rest;
  return {value, (most - value) + rest};
}

constexpr double TINY = 0x1p-27;  // below it x^2/2 is less than half a unit in the last place of 1

}  // namespace

double sin(double x) {
  if (!isfinite(x)) return NOT_A_NUMBER;
  if (abs(x) < TINY) return x;
  const Reduced reduced = reduce(x);
  const double value = reduced.quadrant % 2 == 0 ? sine(reduced.rest).high : cosine(reduced.rest).high;
  return reduced.quadrant < 2 ? value : -value;
}

double cos(double x) {
  if (!isfinite(x)) return NOT_A_NUMBER;
  const Reduced reduced = reduce(x);
  const double value = reduced.quadrant % 2 == 0 ? cosine(reduced.rest).high : sine(reduced.rest).high;
  return reduced.quadrant == 0 || reduced.quadrant == 3 ? value : -value;
}

double tan(double x) {
  if (!isfinite(x)) return NOT_A_NUMBER;
  if (abs(x) < TINY) return x;
  const Reduced reduced = reduce(x);
  Pair above = sine(reduced.rest), below = cosine(reduced.rest);
  if (reduced.quadrant % 2 != 0) {
    const Pair former = above;
    above = {-below.high, -below.low};
    below = former;
  }
  const double quotient = above.high / below.high;
  const Pair product = multiply_exactly(quotient, below.high);
  return quotient + ((above.high - product.high) - product.low + above.low - quotient * below.low) / below.high;
}

// --- their inverses -------------------------------------------------------------------------------------------------

// asin(x)/x = 1 + z A(z), z = x^2 up to 1/4; error 1.5e-17.
constexpr double ARC_SINE[] = {
    0.16666666666666669,  0.07499999999998433,  0.04464285714635543,  0.030381944138531247, 0.02237217294214989,
    0.017352392720869973, 0.013971212973552933, 0.011479177415184906, 0.01032281435018578,  0.005457506718640358,
    0.01740087944269402,  -0.014851887071247204, 0.028757851367421566};

double asin(double x) {
  const double size = abs(x);
  if (!(size <= 1.0)) return NOT_A_NUMBER;
  if (size < TINY) return x;
  if (size <= 0.5) {
    const double z = x * x;
    return x + x * z * evaluate(ARC_SINE, z);
  }
  // pi/2 - 2 asin(sqrt((1 - x)/2))
  const double z = 0.5 * (1.0 - size), root = sqrt(z);
  const Pair square = multiply_exactly(root, root);
  const double lost = root > 0.0 ? ((z - square.high) - square.low) / (2.0 * root) : 0.0;
  const Pair difference = add_exactly(HALF_PI.high, -2.0 * root);
  const double rest = difference.low + HALF_PI.low - 2.0 * (root * z * evaluate(ARC_SINE, z) + lost);
  return copysign(difference.high + rest, x);
}

// atan(u)/u = 1 + z T(z), z = u^2 up to 1/256; error 1.3e-19.
constexpr double ARC_TANGENT[] = {-0.3333333333333333, 0.19999999999999762,  -0.1428571428502144,
                                  0.11111110371686315, -0.09090552224889632, 0.07612834254695176};
// atan(k/8)
constexpr Pair ARC_TANGENTS[] = {{0.0, 0.0},
                                 {0.12435499454676144, -3.1253241424539383e-18},
                                 {0.24497866312686414, 1.0698755618734451e-17},
                                 {0.35877067027057225, -2.4623815582638635e-17},
                                 {0.4636476090008061, 2.2698777452961687e-17},
                                 {0.5585993153435624, -5.4556305485916264e-18},
                                 {0.6435011087932844, 1.5834785051444286e-17},
                                 {0.7188299996216245, -2.1478388444456983e-17},
                                 {0.7853981633974483, 3.061616997868383e-17}};

double atan(double x) { return atan2(x, 1.0); }

double atan2(double y, double x) {
  if (x != x || y != y) return NOT_A_NUMBER;
  const bool is_steep = abs(y) > abs(x), is_behind = copysign(1.0, x) < 0.0;
  double larger = max(abs(x), abs(y)), smaller = min(abs(x), abs(y));
  if (larger == INFINITE) {
    smaller = smaller == INFINITE ? 1.0 : 0.0;
    larger = 1.0;
  } else if (larger == 0.0) {
    larger = 1.0;
  } else if (larger > 0x1p1000) {
    larger *= 0x1p-100, smaller *= 0x1p-100;
  } else if (larger < 0x1p-900) {
    larger *= 0x1p100, smaller *= 0x1p100;
  }
  // smaller/larger = tan(a), a = atan(k/8) + atan(u) with |u| <= 1/16.
  const int k = static_cast<int>(8.0 * (smaller / larger) + 0.5);
  const double u = (smaller - 0.125 * k * larger) / (larger + 0.125 * k * smaller);
  const double z = u * u, rest = u * z * evaluate(ARC_TANGENT, z);
  const double sign = is_steep == is_behind ? 1.0 : -1.0;
  const double quarters = is_steep ? 1.0 : is_behind ? 2.0 : 0.0;
  const Pair base = add_exactly(quarters * HALF_PI.high, sign * ARC_TANGENTS[k].high);
  const Pair most = add_exactly(base.high, sign * u);
  const double low = base.low + quarters * HALF_PI.low + sign * ARC_TANGENTS[k].low;
  return copysign(most.high + (most.low + low + sign * rest), y);
}

// --- exponential and logarithm --------------------------------------------------------------------------------------

constexpr Pair LN_2 = {0x1.62e42feep-1, 0x1.a39ef35793c76p-33};  // the first of 32 bits: its product with k is exact
// exp(r) = 1 + r + r^2 E(r), |r| up to ln(2)/2; error 1.4e-18.
constexpr double EXPONENTIAL[] = {0.5,
                                  0.1666666666666667,
                                  0.04166666666666667,
                                  0.008333333333326136,
                                  0.0013888888888883748,
                                  0.00019841269874820627,
                                  2.4801587325547743e-05,
                                  2.7557255400206422e-06,
                                  2.75572736431103e-07,
                                  2.5105217004720745e-08,
                                  2.0914686968086876e-09};

double exp(double x) {
  if (x != x) return x;
  if (x > 709.782712893384) return INFINITE;
  if (x < -745.1332191019412) return 0.0;
  const double k = floor(x * 1.4426950408889634 + 0.5);
  const double high = x - k * LN_2.high, low = k * LN_2.low;
  const double r = high - low, lost = (high - r) - low;
  const double value = 1.0 + (r + (lost + r * r * evaluate(EXPONENTIAL, r)));
  const int exponent = static_cast<int>(k);
  if (exponent > 1023) return value * 2.0 * power_of_two(exponent - 1);
  if (exponent < -1022) return value * power_of_two(exponent + 100) * 0x1p-100;
  return value * power_of_two(exponent);
}

// log((1 + s)/(1 - s)) = 2 s + s z L(z), z = s^2, for quotients within sqrt(1/2) and sqrt(2); error 2.1e-18.
constexpr double LOGARITHM[] = {0.6666666666666666,  0.40000000000000885, 0.28571428570799784, 0.22222222392581045,
                                0.18181795547521137, 0.15386244737621665, 0.13268638369266825, 0.13088034850927555};

double log(double x) {
  if (x == 0.0) return -INFINITE;
  if (!(x > 0.0)) return NOT_A_NUMBER;
  if (x == INFINITE) return x;
  int k = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    k = -54;
  }
  const uint64_t bits = to_bits(x);
  k += static_cast<int>(bits >> 52) - 1023;
  double m = from_bits((bits & 0xFFFFFFFFFFFFFull) | 0x3FF0000000000000ull);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++k;
  }
  const double above = m - 1.0;
  const Pair below = add_exactly(2.0, above);
  const double s = above / below.high;
  const Pair product = multiply_exactly(s, below.high);
  const double lost = ((above - product.high) - product.low - s * below.low) / below.high;
  const Pair most = add_exactly(k * LN_2.high, 2.0 * s);
  const double z = s * s;
  return most.high + (most.low + (2.0 * lost + s * z * evaluate(LOGARITHM, z) + k * LN_2.low));
}

// --- others ---------------------------------------------------------------------------------------------------------

double hypot(double x, double y) {
  double larger = max(abs(x), abs(y)), smaller = min(abs(x), abs(y)), unit = 1.0;
  if (abs(x) == INFINITE || abs(y) == INFINITE) return INFINITE;
  if (x != x || y != y) return NOT_A_NUMBER;
  if (larger > 0x1p500) {
    unit = 0x1p600;
  } else if (larger < 0x1p-450) {
    unit = 0x1p-600;
  }
  larger /= unit, smaller /= unit;
  return sqrt(larger * larger + smaller * smaller) * unit;
}

double round(double x) {
  constexpr double WHOLE = 0x1p52;  // numbers from here on are whole
  if (!(abs(x) < WHOLE)) return x;
  return copysign((abs(x) + WHOLE) - WHOLE, x);
}

}  // namespace shipcollision
