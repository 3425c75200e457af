/* Every lobe over a vector, and over an array. */
#ifndef BURNISH_SHADING_LOBE_SIMD_H
#define BURNISH_SHADING_LOBE_SIMD_H

#include <string.h>

#include "shading/shader.h"
#include "simd/vector_math.h"

/* From this many bytes of output on, stores go past the caches: nobody finds such an array in
 * them afterwards. */
enum { STREAM_BYTES = 8 << 20 };

/* Floats that input is prefetched ahead: the processor's own prefetcher stops at each page.
 * bench/NOTES.md has the figures. */
enum { STREAM_AHEAD = 512 };

/* Whether a lobe is a polynomial in a base, which is linear in the cosine and clamped. */
BURNISH_INLINE int lobe_has_base(int body) {
    return body == BURNISH_LOBE_BODY_SQUARE || body == BURNISH_LOBE_BODY_SQUARES ||
           body == BURNISH_LOBE_BODY_COMPOSITE;
}

/* The base at the peak. */
BURNISH_INLINE vf lobe_top(int body, const burnish_lobe_constants *lobe) {
    return vf_set(body == BURNISH_LOBE_BODY_COMPOSITE ? lobe->top : 1.0f);
}

/* The lobe from its base: u^m by squarings, or the products of a composite. */
BURNISH_INLINE vf lobe_of_base(int body, const burnish_lobe_constants *lobe, vf u) {
    u = vf_mul(u, u);
    for (int k = 1; body != BURNISH_LOBE_BODY_SQUARE && k < lobe->squarings; ++k) {
        vf factor = u;
        if (body == BURNISH_LOBE_BODY_COMPOSITE) {
            factor = vf_add(u, vf_set(lobe->offset[k - 1]));
        }
        u = vf_mul(u, factor);
    }
    return u;
}

/* c^n for a whole n: squarings, and a multiplication for each of n's bits but one. */
BURNISH_INLINE vf lobe_multiply(vf c, uint32_t n) {
    for (; !(n & 1); n >>= 1) {
        c = vf_mul(c, c);
    }
    vf result = c;
    while (n >>= 1) {
        c = vf_mul(c, c);
        if (n & 1) {
            result = vf_mul(result, c);
        }
    }
    return result;
}

/* A lobe without a base at a cosine, as burnish/lobe.h and burnish/kernels.h define it. */
BURNISH_INLINE vf lobe_of_cosine(int body, const burnish_lobe_constants *lobe, vf cosine) {
    const vf one = vf_set(1.0f), exponent = vf_set(lobe->exponent);
    vf c, lambda;
    switch (body) {
    case BURNISH_LOBE_BODY_POWER:
        return vector_power(cosine, exponent);
    case BURNISH_LOBE_BODY_MULTIPLY:
        c = vector_saturate(cosine);
        return lobe_multiply(vf_and_mask(vf_greater(c, vf_set(lobe->least)), c), lobe->whole);
    case BURNISH_LOBE_BODY_SCHLICK:
        c = vector_saturate(cosine);
        lambda = vf_mul(exponent, vf_sub(one, c));
        return vector_saturate(vf_div(c, vf_add(c, lambda)));
    case BURNISH_LOBE_BODY_GAUSSIAN:
        lambda = vf_max(vf_sub(one, cosine), vf_set(0.0f));
        return vf_and_mask(vf_greater(cosine, vf_set(-0x1.fffffep127f)),
                           vf_min(vector_exp2(vf_mul(vf_set(lobe->slope), lambda)), one));
    case BURNISH_LOBE_BODY_GX:
        c = vector_saturate(cosine);
        lambda = vf_mul(vf_sub(one, c), vf_add(one, c));
        c = vf_mul(c, c);
        return vector_saturate(vf_div(c, vf_add(c, vf_mul(vf_set(lobe->slope), lambda))));
    default:
        return vf_set(0.0f);
    }
}

BURNISH_INLINE vf lobe_of(int body, int from_lambda, const burnish_lobe_constants *lobe, vf x) {
    const vf one = vf_set(1.0f);
    if (lobe_has_base(body)) {
        const vf lambda = from_lambda ? x : vf_sub(one, x), top = lobe_top(body, lobe);
        const vf u = vf_sub(top, vf_mul(vf_set(lobe->zeta), lambda));
        return lobe_of_base(body, lobe, vf_min(vf_max(u, vf_set(0.0f)), top));
    }
    return lobe_of_cosine(body, lobe, from_lambda ? vf_sub(one, x) : x);
}

/* Fewer points than a vector has. */
BURNISH_INLINE void lobe_rest(int body, int from_lambda, const burnish_lobe_constants *lobe,
                              size_t count, const float *in, float *out) {
    float block[LANES];
    memset(block, 0, sizeof block);
    memcpy(block, in, count * sizeof *in);
    vf_store(block, lobe_of(body, from_lambda, lobe, vf_load(block)));
    memcpy(out, block, count * sizeof *out);
}

BURNISH_INLINE void lobe_array(int body, int from_lambda, const burnish_lobe_constants *given,
                               size_t count, const float *in, float *out) {
    const burnish_lobe_constants lobe = *given; /* which no store can change */
    size_t i = 0;
    if (count >= STREAM_BYTES / sizeof *out) {
        const size_t vector = LANES * sizeof *out;
        i = (vector - (uintptr_t)out % vector) % vector / sizeof *out;
        lobe_rest(body, from_lambda, &lobe, i, in, out);
        for (; i + LANES <= count; i += LANES) {
            if (LANES > 1) {
                __builtin_prefetch(in + (i + STREAM_AHEAD < count ? i + STREAM_AHEAD : i));
            }
            vf_stream(out + i, lobe_of(body, from_lambda, &lobe, vf_load(in + i)));
        }
        vector_fence();
    }
    for (; LANES > 1 && i + 2 * LANES <= count; i += 2 * LANES) {
        vf a = vf_load(in + i), b = vf_load(in + i + LANES);
        vf_store(out + i, lobe_of(body, from_lambda, &lobe, a));
        vf_store(out + i + LANES, lobe_of(body, from_lambda, &lobe, b));
    }
    for (; i + LANES <= count; i += LANES) {
        vf_store(out + i, lobe_of(body, from_lambda, &lobe, vf_load(in + i)));
    }
    if (i < count) {
        lobe_rest(body, from_lambda, &lobe, count - i, in + i, out + i);
    }
}

#endif
