/* The contenders over a vector and over arrays, compiled once for each instruction set with its
 * flags: BURNISH_BENCH_ISA is its word, and BURNISH_VECTOR_... chooses the vector type. */
#include "bench/kernels/isa.h"

#define CONTENDERS_OF_(word) burnish_bench_contenders_##word
#define CONTENDERS_OF(word) CONTENDERS_OF_(word)

#if defined(BURNISH_VECTOR_SCALAR) || (defined(BURNISH_VECTOR_SSE2) && defined(__SSE2__)) ||       \
    (defined(BURNISH_VECTOR_AVX2) && defined(__AVX2__)) ||                                         \
    (defined(BURNISH_VECTOR_AVX512) && defined(__AVX512F__)) ||                                    \
    (defined(BURNISH_VECTOR_NEON) && defined(__aarch64__))

#include <math.h>
#include <stddef.h>

#include "bench/kernels/isa_ops.h"
#include "shading/lobe_simd.h"

/* log2 of m in [1, 2) minus RAMP (m - 1), degree 6 by Remez exchange, 1.85e-6 absolute; times n. */
BURNISH_INLINE vf bench_log2(vf m, vf n, float ramp) {
    vf p = vf_mul(n, vf_set(-0.0256910885f));
    p = bench_fma(p, m, vf_mul(n, vf_set(0.2751487678f)));
    p = bench_fma(p, m, vf_mul(n, vf_set(-1.2669182495f)));
    p = bench_fma(p, m, vf_mul(n, vf_set(3.2865287511f)));
    p = bench_fma(p, m, vf_mul(n, vf_set(-5.3419891824f)));
    p = bench_fma(p, m, vf_mul(n, vf_set(6.1129631161f - ramp)));
    return bench_fma(p, m, vf_mul(n, vf_set(-3.0400402698f + ramp)));
}

/* max(0, c)^n: the products of n and constants leave the loop. */
#if defined(BURNISH_VECTOR_AVX512)
BURNISH_INLINE vf bench_pow(vf c, vf n) {
    c = vf_max(c, vf_set(0.0f));
    vf m = _mm512_getmant_ps(c, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_zero);
    vf y = bench_fma(n, _mm512_getexp_ps(c), bench_log2(m, n, 0.0f));
    y = vf_max(y, vf_set(-125.0f)); /* subnormal results would be 20 times as slow */
    vf r = _mm512_reduce_ps(y, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); /* y - floor(y) */
    vf p = vf_set(0.0780245227f);
    p = bench_fma(p, r, vf_set(0.2260671554f));
    p = bench_fma(p, r, vf_set(0.6958335405f));
    p = bench_fma(p, r, vf_set(0.9999252186f));
    return _mm512_scalef_ps(p, y); /* p 2^floor(y) */
}
#else
BURNISH_INLINE vf bench_pow(vf c, vf n) {
    const vf rounder = vf_set(12582912.0f); /* 1.5 * 2^23: its last bits take the integer */
    c = vf_max(c, vf_set(0x1p-126f));
    vf bits = vf_from_int(vi_sub(vf_bits(c), vi_set(0x3f800000))); /* 2^23 (exponent + m - 1) */
    vf y = bench_fma(bits, vf_mul(n, vf_set(0x1p-23f)), bench_log2(bench_mantissa(c), n, 1.0f));
    y = vf_max(y, vf_set(-126.0f));
    vf shifted = vf_add(y, rounder);
    vf r = vf_sub(y, vf_sub(shifted, rounder));
    vf p = vf_set(0.0551716691f);
    p = bench_fma(p, r, vf_set(0.2426111221f));
    p = bench_fma(p, r, vf_set(0.6932609855f));
    p = bench_fma(p, r, vf_set(0.9999280735f));
    return vf_from_bits(vi_add(vf_bits(p), vi_shl(vf_bits(shifted), 23)));
}
#endif

BURNISH_INLINE vf bench_libm(vf c, vf n) {
    float bases[LANES], exponents[LANES];
    vf_store(bases, c);
    vf_store(exponents, n);
    for (int i = 0; i < LANES; ++i) {
        bases[i] = powf(bases[i], exponents[i]);
    }
    return vf_load(bases);
}

/* A contender at a cosine; `constants` is part of a burnish_bench_shader. */
BURNISH_INLINE vf bench_lobe(int kind, const burnish_lobe_constants *constants, vf cosine) {
    typedef vf vector_powf(vf, vf);
    const burnish_bench_shader *given =
        (const burnish_bench_shader *)(const void *)((const char *)constants -
                                                     offsetof(burnish_bench_shader, shader.lobe));
    const vf n = vf_set(constants->exponent);
    vf c = vf_max(cosine, vf_set(0.0f));
    switch (kind) {
    case BURNISH_BENCH_SCHLICK:
        return vf_div(c, bench_fma(vf_set(1.0f - constants->exponent), c, n));
    case BURNISH_BENCH_SQUARINGS: /* below that cosine powers are subnormal: 20 times as slow */
        c = vf_max(cosine, vf_set(0x1.2p-4f));
        /* fall through */
    case BURNISH_BENCH_SQUARINGS_PLAIN:
        for (int k = 0; k < 5; ++k) {
            c = vf_mul(c, c);
        }
        return c;
    case BURNISH_BENCH_TABLE:
        c = vf_mul(vf_min(c, vf_set(1.0f)), vf_set((float)(BURNISH_BENCH_TABLE_SIZE - 1)));
        return bench_gather(given->table, bench_round(c));
    case BURNISH_BENCH_VECTOR_POW:
        return bench_pow(cosine, n);
    case BURNISH_BENCH_LIBRARY:
        return ((vector_powf *)given->library)(c, n);
    case BURNISH_BENCH_LIBM:
        return bench_libm(c, n);
    default:
        return cosine;
    }
}

/* The library's lighting kernel with a contender as its lobe. */
#define lobe_of_cosine bench_lobe
#include "shading/shade_simd.h"
#undef lobe_of_cosine

BURNISH_INLINE void bench_array(int kind, const burnish_bench_shader *given, size_t count,
                                const float *in, float *out) {
    const burnish_bench_shader shader = *given; /* a copy: no store can change it */
    const burnish_lobe_constants *lobe = &shader.shader.lobe;
    for (size_t i = 0; i + 2 * LANES <= count; i += 2 * LANES) {
        vf a = vf_load(in + i), b = vf_load(in + i + LANES);
        if (kind == BURNISH_BENCH_STREAM_COPY) {
            __builtin_prefetch(in + (i + STREAM_AHEAD < count ? i + STREAM_AHEAD : i));
            vf_stream(out + i, a);
            vf_stream(out + i + LANES, b);
        } else {
            vf_store(out + i, bench_lobe(kind, lobe, a));
            vf_store(out + i + LANES, bench_lobe(kind, lobe, b));
        }
    }
    if (kind == BURNISH_BENCH_STREAM_COPY) {
        vector_fence();
    }
}

BURNISH_INLINE vf bench_root(int kind, vf x) {
    const vf half = vf_mul(vf_set(0.5f), x), plain = vf_set(1.5f);
    vf y;
    switch (kind) {
    case BURNISH_BENCH_ROOT_IEEE:
        return vf_div(vf_set(1.0f), bench_sqrt(x));
    case BURNISH_BENCH_ROOT_TUNED:
        y = vf_from_bits(vi_sub(vi_set(0x5f200000), vi_shr(vf_bits(x), 1)));
        y = vf_mul(y, vf_sub(vf_set(0x1.ae91e4p+0f),
                             vf_mul(vf_set(0x1.686c5ap-1f), vf_mul(vf_mul(x, y), y))));
        return vf_mul(y, vf_sub(vf_set(0x1.800006p+0f), vf_mul(vf_mul(half, y), y)));
    case BURNISH_BENCH_ROOT_NEWTON:
        y = vf_from_bits(vi_sub(vi_set(0x5f3759df), vi_shr(vf_bits(x), 1)));
        for (int k = 0; k < 3; ++k) {
            y = vf_mul(y, vf_sub(plain, vf_mul(vf_mul(half, y), y)));
        }
        return y;
    default:
        return vector_inverse_sqrt(x);
    }
}

BURNISH_INLINE void bench_roots(int kind, size_t count, const float *in, float *out) {
    for (size_t i = 0; i + 2 * LANES <= count; i += 2 * LANES) {
        vf a = vf_load(in + i), b = vf_load(in + i + LANES);
        vf_store(out + i, bench_root(kind, a));
        vf_store(out + i + LANES, bench_root(kind, b));
    }
}

#define LOBE_FUNCTION(name, kind)                                                                  \
    static void lobe_##name(const burnish_bench_shader *shader, size_t count, const float *in,     \
                            float *out) {                                                          \
        bench_array(kind, shader, count, in, out);                                                 \
    }
#define SHADE_FUNCTION(name, kind, geometry)                                                       \
    static void shade_##name##_##geometry(const burnish_bench_shader *restrict shader,             \
                                          const burnish_kernels_points *restrict points,           \
                                          size_t count, uint8_t *restrict rgba) {                  \
        const shade_kernel kernel = {kind, BURNISH_SHADE_##geometry, BURNISH_SHADE_RGBA8, 3};      \
        shade_array(kernel, &shader->shader, points, count, (shade_colors){rgba, NULL});           \
    }
#define LOBE_AND_SHADE_FUNCTIONS(name, kind)                                                       \
    LOBE_FUNCTION(name, kind)                                                                      \
    SHADE_FUNCTION(name, kind, DISTANT)                                                            \
    SHADE_FUNCTION(name, kind, GENERAL)
#define ROOT_FUNCTION(name, kind)                                                                  \
    static void root_##name(size_t count, const float *in, float *out) {                           \
        bench_roots(kind, count, in, out);                                                         \
    }

LOBE_AND_SHADE_FUNCTIONS(schlick, BURNISH_BENCH_SCHLICK)
LOBE_FUNCTION(squarings, BURNISH_BENCH_SQUARINGS)
LOBE_FUNCTION(squarings_plain, BURNISH_BENCH_SQUARINGS_PLAIN)
LOBE_AND_SHADE_FUNCTIONS(table, BURNISH_BENCH_TABLE)
LOBE_AND_SHADE_FUNCTIONS(vector_pow, BURNISH_BENCH_VECTOR_POW)
LOBE_AND_SHADE_FUNCTIONS(library, BURNISH_BENCH_LIBRARY)
LOBE_FUNCTION(libm, BURNISH_BENCH_LIBM)
LOBE_FUNCTION(copy, BURNISH_BENCH_COPY)
LOBE_FUNCTION(stream_copy, BURNISH_BENCH_STREAM_COPY)
ROOT_FUNCTION(ours, BURNISH_BENCH_ROOT_OURS)
ROOT_FUNCTION(ieee, BURNISH_BENCH_ROOT_IEEE)
ROOT_FUNCTION(tuned, BURNISH_BENCH_ROOT_TUNED)
ROOT_FUNCTION(newton, BURNISH_BENCH_ROOT_NEWTON)

#define SHADE_ROW(name)                                                                            \
    { shade_##name##_DISTANT, shade_##name##_GENERAL }

static const burnish_bench_contenders CONTENDERS = {
    .libmvec = BENCH_LIBMVEC,
    .sleef = BENCH_SLEEF,
    .lobe = {[BURNISH_BENCH_INDEX(BURNISH_BENCH_SCHLICK)] = lobe_schlick,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_SQUARINGS)] = lobe_squarings,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_SQUARINGS_PLAIN)] = lobe_squarings_plain,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_TABLE)] = lobe_table,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_VECTOR_POW)] = lobe_vector_pow,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_LIBRARY)] = lobe_library,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_LIBM)] = lobe_libm,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_COPY)] = lobe_copy,
             [BURNISH_BENCH_INDEX(BURNISH_BENCH_STREAM_COPY)] = lobe_stream_copy},
    .shade = {[BURNISH_BENCH_INDEX(BURNISH_BENCH_SCHLICK)] = SHADE_ROW(schlick),
              [BURNISH_BENCH_INDEX(BURNISH_BENCH_TABLE)] = SHADE_ROW(table),
              [BURNISH_BENCH_INDEX(BURNISH_BENCH_VECTOR_POW)] = SHADE_ROW(vector_pow),
              [BURNISH_BENCH_INDEX(BURNISH_BENCH_LIBRARY)] = SHADE_ROW(library)},
    .root = {[BURNISH_BENCH_ROOT_OURS] = root_ours,
             [BURNISH_BENCH_ROOT_IEEE] = root_ieee,
             [BURNISH_BENCH_ROOT_TUNED] = root_tuned,
             [BURNISH_BENCH_ROOT_NEWTON] = root_newton},
};

const burnish_bench_contenders *CONTENDERS_OF(BURNISH_BENCH_ISA)(void) {
    return &CONTENDERS;
}

#else

const burnish_bench_contenders *CONTENDERS_OF(BURNISH_BENCH_ISA)(void) {
    return NULL;
}

#endif
