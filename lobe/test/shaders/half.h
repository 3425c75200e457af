/* Half precision, for half.glsl. A float has more than twice a half's digits: an operation on floats,
 * rounded to half, is the correctly rounded operation on halves. */
#ifndef TEST_SHADERS_HALF_H
#define TEST_SHADERS_HALF_H

#include <cmath>
#include <cstdint>

/* x rounded to the nearest half, halves to even; subnormal ones are kept, 65520 and more are
 * infinite. */
static inline float half_round(float x) {
    int exponent;
    if (!(std::fabs(x) < 65520.0f)) {
        return std::isnan(x) ? x : std::copysign(INFINITY, x);
    }
    std::frexp(x, &exponent);
    const int last = exponent - 11 < -24 ? -24 : exponent - 11; /* of the last digit */
    return std::ldexp(std::rint(std::ldexp(x, -last)), last);
}

struct float16_t {
    float value;
    explicit float16_t(float x) : value(half_round(x)) {}
};

static inline float16_t half_of_bits(int bits) {
    const int exponent = bits >> 10 & 31, fraction = bits & 1023;
    const float value = exponent == 0    ? std::ldexp((float)fraction, -24)
                        : exponent == 31 ? (fraction ? NAN : INFINITY)
                                         : std::ldexp((float)(1024 + fraction), exponent - 25);
    return float16_t(bits & 0x8000 ? -value : value);
}

static inline float16_t operator-(float16_t a, float16_t b) {
    return float16_t(a.value - b.value);
}
static inline float16_t operator*(float16_t a, float16_t b) {
    return float16_t(a.value * b.value);
}
static inline float16_t clamp(float16_t x, float16_t low, float16_t high) {
    return !(x.value > low.value) ? low : x.value < high.value ? x : high;
}

#endif
