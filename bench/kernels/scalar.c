/* Lobes one value at a time. Compiled without vectorisation (CMakeLists.txt). */
#include "bench/kernels/scalar.h"

#include <stdint.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

/* Returns `next`, dependent on `value` through two bit operations with a zero unknown to the
 * compiler. */
INLINE float after(float value, float next, float zero) {
#if defined(__SSE2__)
    __asm__("andps %1, %0" : "+x"(value) : "x"(zero));
    __asm__("orps %1, %0" : "+x"(next) : "x"(value));
#else
    uint32_t bits, mask, wanted;
    memcpy(&bits, &value, sizeof bits);
    memcpy(&mask, &zero, sizeof mask);
    memcpy(&wanted, &next, sizeof wanted);
    wanted |= bits & mask;
    memcpy(&next, &wanted, sizeof next);
#endif
    return next;
}

/* max(0, x) without a branch: with one, the time of a lobe that is 0 for most cosines would be the
 * branch predictor's. */
INLINE float positive(float x) {
#if defined(__SSE2__)
    __asm__("maxss %1, %0" : "+x"(x) : "x"(0.0f));
    return x;
#else
    return x > 0.0f ? x : 0.0f;
#endif
}

INLINE float nothing(int exponent, float c) {
    (void)exponent;
    return c;
}

/* The exponent as a number that the compiler has to read anew for each value. */
INLINE int exponent_anew(int n) {
    __asm__ volatile("" : "+r"(n));
    return n;
}

/* The paper's W_Q: (zeta (c - 1) + 1)^2, with the test for the zero that it needs. */
INLINE float paper_lobe(int zeta, float c) {
    float u = positive((float)zeta * (c - 1.0f) + 1.0f);
    return u * u;
}

INLINE float paper_w(int exponent, float c) {
    return paper_lobe(exponent_anew(exponent) >> 1, c);
}

INLINE float paper_w_half(int exponent, float c) {
    const int n = exponent_anew(exponent);
    return paper_lobe(((n << 3) - n) >> 4, c);
}

INLINE float paper_schlick(int exponent, float c) {
    const float n = (float)exponent_anew(exponent);
    c = positive(c);
    return c / (n - n * c + c);
}

#define LOOPS(name)                                                                                \
    static float name##_through(int exponent, size_t count, const float *in, float *out) {         \
        for (size_t i = 0; i < count; ++i) {                                                       \
            out[i] = name(exponent, in[i]);                                                        \
        }                                                                                          \
        return out[count - 1];                                                                     \
    }                                                                                              \
    static float name##_chain(int exponent, size_t count, const float *in, float *out) {           \
        const volatile float unknown = 0.0f;                                                       \
        const float zero = unknown;                                                                \
        float value = zero;                                                                        \
        for (size_t i = 0; i < count; ++i) {                                                       \
            value = name(exponent, after(value, in[i], zero));                                     \
        }                                                                                          \
        *out = value;                                                                              \
        return value;                                                                              \
    }

LOOPS(nothing)
LOOPS(paper_w)
LOOPS(paper_w_half)
LOOPS(paper_schlick)

const burnish_bench_scalar burnish_bench_paper[] = {
    {"Schlick, c / (n - n c + c)", paper_schlick_through, paper_schlick_chain},
    {"the loop alone (subtracted from the latencies)", nothing_through, nothing_chain},
    {"W, zeta = n >> 1", paper_w_through, paper_w_chain},
    {"W_0.5, zeta = (8n - n) >> 4", paper_w_half_through, paper_w_half_chain},
    {NULL, NULL, NULL},
};
