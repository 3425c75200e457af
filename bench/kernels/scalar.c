/* Lobes one value at a time. Compiled without vectorisation (CMakeLists.txt). */
#include "bench/kernels/scalar.h"

#include <math.h>
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

/* The paper's form: max(0, c zeta + (1 - zeta))^2, two constants per material. */
INLINE float folded(const burnish_bench_scalar_lobe *lobe, float c) {
    float u = c * lobe->family.zeta + lobe->offset;
    u = positive(u);
    return u * u;
}

INLINE float nothing(const burnish_bench_scalar_lobe *lobe, float c) {
    (void)lobe;
    return c;
}

/* burnish/lobe.h at order 2. */
INLINE float header(const burnish_bench_scalar_lobe *lobe, float c) {
    burnish_lobe family = {lobe->family.zeta, 2};
    return burnish_lobe_at_cosine(family, c);
}

INLINE float schlick_folded(const burnish_bench_scalar_lobe *lobe, float c) {
    c = positive(c);
    return c / (lobe->exponent - (lobe->exponent - 1.0f) * c);
}

INLINE float schlick_unfolded(const burnish_bench_scalar_lobe *lobe, float c) {
    c = positive(c);
    return c / (lobe->exponent - lobe->exponent * c + c);
}

INLINE float schlick_header(const burnish_bench_scalar_lobe *lobe, float c) {
    return burnish_schlick_at_cosine(c, lobe->exponent);
}

/* The exponent as a number that the compiler has to read anew for each value. */
INLINE int exponent_anew(const burnish_bench_scalar_lobe *lobe) {
    int n = lobe->whole_exponent;
    __asm__ volatile("" : "+r"(n));
    return n;
}

/* The paper's W_Q: (zeta (c - 1) + 1)^2, with the test for the zero that it needs. */
INLINE float paper_lobe(int zeta, float c) {
    float u = positive((float)zeta * (c - 1.0f) + 1.0f);
    return u * u;
}

INLINE float paper_w(const burnish_bench_scalar_lobe *lobe, float c) {
    return paper_lobe(exponent_anew(lobe) >> 1, c);
}

INLINE float paper_w_half(const burnish_bench_scalar_lobe *lobe, float c) {
    const int n = exponent_anew(lobe);
    return paper_lobe(((n << 3) - n) >> 4, c);
}

INLINE float paper_schlick(const burnish_bench_scalar_lobe *lobe, float c) {
    const float n = (float)exponent_anew(lobe);
    c = positive(c);
    return c / (n - n * c + c);
}

INLINE float composite(const burnish_composite *lobe, int multiplications, float c) {
    float v = positive(c * lobe->slope + (lobe->top - lobe->slope));
    v = v * v;
    for (int i = 0; i < multiplications - 2; ++i) {
        v = v * (v + lobe->offset[i]);
    }
    return v;
}

INLINE float composite3(const burnish_bench_scalar_lobe *lobe, float c) {
    return composite(&lobe->composite[0], 3, c);
}

INLINE float composite4(const burnish_bench_scalar_lobe *lobe, float c) {
    return composite(&lobe->composite[1], 4, c);
}

INLINE float composite5(const burnish_bench_scalar_lobe *lobe, float c) {
    return composite(&lobe->composite[2], 5, c);
}

INLINE float composite6(const burnish_bench_scalar_lobe *lobe, float c) {
    return composite(&lobe->composite[3], 6, c);
}

/* u^8 by squarings. */
INLINE float order8(const burnish_bench_scalar_lobe *lobe, float c) {
    const float u = folded(lobe, c);
    return (u * u) * (u * u);
}

/* 2^(n log2 c) by polynomials of degree 5 and 3 on the bits: within 0.0011 of cos^33. */
INLINE float fast_power(const burnish_bench_scalar_lobe *lobe, float c) {
    uint32_t bits;
    float m, scale;
    c = positive(c);
    memcpy(&bits, &c, sizeof bits);
    const int32_t exponent = (int32_t)(bits >> 23) - 127;
    bits = (bits & 0x7fffff) | 0x3f800000;
    memcpy(&m, &bits, sizeof m);
    m -= 1;
    float x = 0.05866474f * m - 0.22510303f;
    x = ((x * m + 0.44059903f) * m - 0.71671466f) * m + 1.4426039f;
    x = positive(lobe->exponent * ((float)exponent + x * m) + 125); /* above 2^-126 */
    const int32_t whole = (int32_t)x;
    x -= (float)whole;
    bits = (uint32_t)(whole + 2) << 23;
    memcpy(&scale, &bits, sizeof scale);
    return scale * (((0.07896726f * x + 0.22469316f) * x + 0.69632477f) * x + 0.9999003f);
}

INLINE float library(const burnish_bench_scalar_lobe *lobe, float c) {
    return powf(positive(c), lobe->exponent);
}

#define LOOPS(name)                                                                                \
    static float name##_through(const burnish_bench_scalar_lobe *given, size_t count,              \
                                const float *in, float *out) {                                     \
        const burnish_bench_scalar_lobe lobe = *given;                                             \
        for (size_t i = 0; i < count; ++i) {                                                       \
            out[i] = name(&lobe, in[i]);                                                           \
        }                                                                                          \
        return out[count - 1];                                                                     \
    }                                                                                              \
    static float name##_chain(const burnish_bench_scalar_lobe *given, size_t count,                \
                              const float *in, float *out) {                                       \
        const burnish_bench_scalar_lobe lobe = *given;                                             \
        const volatile float unknown = 0.0f;                                                       \
        const float zero = unknown;                                                                \
        float value = zero;                                                                        \
        for (size_t i = 0; i < count; ++i) {                                                       \
            value = name(&lobe, after(value, in[i], zero));                                        \
        }                                                                                          \
        *out = value;                                                                              \
        return value;                                                                              \
    }

LOOPS(folded)
LOOPS(nothing)
LOOPS(header)
LOOPS(schlick_folded)
LOOPS(schlick_unfolded)
LOOPS(schlick_header)
LOOPS(library)
LOOPS(order8)
LOOPS(composite3)
LOOPS(composite4)
LOOPS(composite5)
LOOPS(composite6)
LOOPS(fast_power)
LOOPS(paper_w)
LOOPS(paper_w_half)
LOOPS(paper_schlick)

const burnish_bench_scalar burnish_bench_scalars[] = {
    {"max(0, c zeta + (1 - zeta))^2", folded_through, folded_chain},
    {"the loop alone (subtracted from the latencies)", nothing_through, nothing_chain},
    {"c / (n - n c + c), as published", schlick_unfolded_through, schlick_unfolded_chain},
    {"c / (n - (n - 1) c)", schlick_folded_through, schlick_folded_chain},
    {"burnish_lobe_at_cosine", header_through, header_chain},
    {"burnish_schlick_at_cosine", schlick_header_through, schlick_header_chain},
    {"the family at order 8", order8_through, order8_chain},
    {"composite:3", composite3_through, composite3_chain},
    {"composite:4", composite4_through, composite4_chain},
    {"composite:5", composite5_through, composite5_chain},
    {"composite:6", composite6_through, composite6_chain},
    {"2^(n log2 c) by polynomials, within 0.0011", fast_power_through, fast_power_chain},
    {"powf", library_through, library_chain},
    {NULL, NULL, NULL},
};

const burnish_bench_scalar burnish_bench_paper[] = {
    {"Schlick, c / (n - n c + c)", paper_schlick_through, paper_schlick_chain},
    {"the loop alone (subtracted from the latencies)", nothing_through, nothing_chain},
    {"W, zeta = n >> 1", paper_w_through, paper_w_chain},
    {"W_0.5, zeta = (8n - n) >> 4", paper_w_half_through, paper_w_half_chain},
    {NULL, NULL, NULL},
};
