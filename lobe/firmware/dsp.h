/* Lobes of lobe_q15.h and pixels of shade_q15.h over arrays, two at a time, on processors with Arm's
 * DSP extension: Cortex-M4, M7, M33. Results equal those of the two headers bit for bit, for any
 * lobe, light and shader made by them. The time does not depend on the values: there are no branches
 * for dark pixels. Include it only if __ARM_FEATURE_SIMD32 is defined.
 *
 *     add, sub            modulo 2^16; adds, subs saturate, unsigned unless their name has signed
 *     mean                (a + b + 1) >> 1, unsigned
 *     low, high           lower and upper half of the product
 *     left, right         by 0 .. 16 bits, unsigned
 *     where_zero          b in lanes where a is 0, else 0; where_not_zero the reverse
 */
#ifndef DSP_H
#define DSP_H

#include <arm_acle.h>
#include <stddef.h>

#include "burnish/shade_q15.h"

/* Two lanes of 16 bits in a register. */
typedef uint32_t dsp_pair;
typedef uint32_t __attribute__((may_alias, aligned(2))) dsp_memory;

/* 32-bit results of the lower and the upper lane. */
typedef struct dsp_wide {
    uint32_t low, high;
} dsp_wide;

/* A vector for both lanes: x below y, and z. */
typedef struct dsp_axis {
    uint32_t xy, z;
} dsp_axis;

#define DSP_LOWER(a, b) (((uint32_t)(a)&0xFFFFu) | (uint32_t)(b) << 16)
#define DSP_UPPER(a, b) ((uint32_t)(a) >> 16 | ((uint32_t)(b)&0xFFFF0000u))
/* signed products of the lower and of the upper lanes: smulbb, smultt */
#define DSP_BOTTOM(a, b) ((int32_t)(int16_t)(a) * (int16_t)(b))
#define DSP_TOP(a, b) (((int32_t)(a) >> 16) * ((int32_t)(b) >> 16))

#define DSP_OPERATION(name, expression)                                                            \
    BURNISH_Q15_INLINE dsp_pair dsp_##name(dsp_pair a, dsp_pair b) {                               \
        return expression;                                                                         \
    }

DSP_OPERATION(add, __uadd16(a, b))
DSP_OPERATION(sub, __usub16(a, b))
DSP_OPERATION(adds, __uqadd16(a, b))
DSP_OPERATION(subs, __uqsub16(a, b))
DSP_OPERATION(adds_signed, (uint32_t)__qadd16((int16x2_t)a, (int16x2_t)b))
DSP_OPERATION(subs_signed, (uint32_t)__qsub16((int16x2_t)a, (int16x2_t)b))
/* of a negative b: a - (b + 2^15) stops at -2^15 */
DSP_OPERATION(max_signed, (uint32_t)__qadd16(__qsub16((int16x2_t)a, (int16x2_t)(b ^ 0x80008000u)),
                                             (int16x2_t)(b ^ 0x80008000u)))
DSP_OPERATION(mean, ~__uhadd16(~a, ~b)) /* uhadd rounds down */
DSP_OPERATION(low, DSP_LOWER((a) * (b), (a >> 16) * (b >> 16)))
DSP_OPERATION(high, DSP_UPPER((a & 0xFFFFu) * (b & 0xFFFFu), (a >> 16) * (b >> 16)))
DSP_OPERATION(high_signed, DSP_UPPER(DSP_BOTTOM(a, b), DSP_TOP(a, b)))
/* 1 in lanes that are 0, times 0xFFFF */
DSP_OPERATION(where_zero, __uqsub16(0x10001u, a) * 0xFFFFu & b)
DSP_OPERATION(where_not_zero, ~(__uqsub16(0x10001u, a) * 0xFFFFu) & b)

BURNISH_Q15_INLINE dsp_pair dsp_set(uint16_t x) {
    return x * 0x10001u;
}

BURNISH_Q15_INLINE dsp_pair dsp_left(dsp_pair a, int bits) {
    return a << bits & ((0xFFFFu << bits) & 0xFFFFu) * 0x10001u;
}

BURNISH_Q15_INLINE dsp_pair dsp_right(dsp_pair a, int bits) {
    return a >> bits & (0xFFFFu >> bits) * 0x10001u;
}

BURNISH_Q15_INLINE dsp_axis dsp_axis_of(const int16_t v[3]) {
    dsp_axis axis;
    axis.xy = DSP_LOWER(v[0], v[1]);
    axis.z = (uint16_t)v[2];
    return axis;
}

/* Q30, modulo 2^32, as burnish_q15_dot. smlad: two products and a sum. */
BURNISH_Q15_INLINE dsp_wide dsp_dot(const dsp_pair a[3], const dsp_axis *b) {
    dsp_wide sum;
    sum.low = (uint32_t)__smlad((int16x2_t)DSP_LOWER(a[0], a[1]), (int16x2_t)b->xy,
                                DSP_BOTTOM(a[2], b->z));
    sum.high = (uint32_t)__smlad((int16x2_t)DSP_UPPER(a[0], a[1]), (int16x2_t)b->xy,
                                 ((int32_t)a[2] >> 16) * (int16_t)b->z);
    return sum;
}

/* x limited to 16 bits, signed. GCC's macro __ssat warns under -Wsign-conversion. */
BURNISH_Q15_INLINE uint32_t dsp_limit(int32_t x) {
    return (uint32_t)__builtin_arm_ssat(x, 16);
}

/* floor((dot + 2^14) / 2^15) without overflow */
BURNISH_Q15_INLINE uint32_t dsp_round_dot(uint32_t dot) {
    return __usat((((int32_t)dot >> 14) + 1) >> 1, 16);
}

/* burnish_q15_cosine of a dot product */
BURNISH_Q15_INLINE dsp_pair dsp_cosine(dsp_wide dot) {
    const uint32_t cosine = DSP_LOWER(dsp_round_dot(dot.low), dsp_round_dot(dot.high));
    return __usub16(cosine, __uqsub16(cosine, 0x80008000u));
}

/* floor((1 + 2^-17 - |v|^2) 2^16), limited to a signed lane */
BURNISH_Q15_INLINE dsp_pair dsp_shortfall(const dsp_pair v[3]) {
    const int16x2_t low = (int16x2_t)DSP_LOWER(v[0], v[1]);
    const int16x2_t high = (int16x2_t)DSP_UPPER(v[0], v[1]);
    const uint32_t lower = (uint32_t)__smlad(low, low, DSP_BOTTOM(v[2], v[2]));
    const uint32_t upper = (uint32_t)__smlad(high, high, DSP_TOP(v[2], v[2]));
    return DSP_LOWER(dsp_limit((int32_t)(0x40002000u - lower) >> 14),
                     dsp_limit((int32_t)(0x40002000u - upper) >> 14));
}

/* lambda of burnish_q15_chord: its upper 16 bits, and its lower 8 bits in the upper half of low. From
 * 0x7FFE00 on the differences and the sum saturate; no lobe that burnish_q15_shader_create makes
 * narrow reaches that far. */
BURNISH_Q15_INLINE void dsp_chord(const dsp_pair a[3], const dsp_pair b[3], dsp_pair *top,
                                  dsp_pair *low) {
    uint32_t lower = 16, upper = 16;
    int i;
    for (i = 0; i < 3; ++i) {
        const uint32_t d = dsp_subs_signed(a[i], b[i]);
        lower += (uint32_t)DSP_BOTTOM(d, d) >> 2;
        upper += (uint32_t)DSP_TOP(d, d) >> 2;
    }
    *top = DSP_LOWER(dsp_limit((int32_t)(lower >> 13)), dsp_limit((int32_t)(upper >> 13)));
    *low = DSP_LOWER(lower << 3, upper << 3);
}

/* A lobe's numbers in both lanes. */
typedef struct dsp_lobe {
    dsp_pair slope, reach;
    int shift;
    uint8_t squarings;
} dsp_lobe;

BURNISH_Q15_INLINE dsp_lobe dsp_lobe_of(const burnish_lobe_q15 *lobe) {
    dsp_lobe wide;
    wide.slope = dsp_set(lobe->slope);
    wide.reach = dsp_set(lobe->reach);
    wide.shift = lobe->shift;
    wide.squarings = lobe->squarings ? lobe->squarings : 32; /* the dark lobe: until it is 0 */
    return wide;
}

/* The lobe from a, as burnish_q15_fast_at. */
BURNISH_Q15_INLINE dsp_pair dsp_power(dsp_pair a, uint8_t squarings) {
    dsp_pair x = a ^ 0xFFFFFFFFu;
    do {
        x = dsp_high(x, x);
    } while (--squarings);
    return x;
}

/* The lobe at a cosine. Lanes beyond reach hold arbitrary values until the end. */
BURNISH_Q15_INLINE dsp_pair dsp_at_cosine(const dsp_lobe *lobe, dsp_pair cosine) {
    const dsp_pair lambda = dsp_subs(dsp_set(BURNISH_Q15_ONE), cosine);
    const dsp_pair low = dsp_low(lobe->slope, lambda);
    const dsp_pair high = dsp_high(lobe->slope, lambda);
    const dsp_pair a = dsp_left(high, 16 - lobe->shift) | dsp_right(low, lobe->shift);
    return dsp_where_zero(dsp_subs(lambda, lobe->reach), dsp_power(a, lobe->squarings));
}

/* The lobe at the chord of two vectors. With lambda = 2^8 top + rest, w 2 is slope top
 * + floor(slope rest / 2^8); the lobe is 0 where that is 2^(17 + shift) or more. */
BURNISH_Q15_INLINE dsp_pair dsp_at_chord(const dsp_lobe *lobe, const dsp_pair normal[3],
                                         const dsp_pair half[3]) {
    dsp_pair top, rest, low, high, a;
    dsp_chord(normal, half, &top, &rest);
    rest = dsp_high(lobe->slope, rest & 0xFF00FF00u);
    low = dsp_add(dsp_low(lobe->slope, top), rest);
    high = dsp_add(dsp_high(lobe->slope, top),
                   dsp_where_not_zero(dsp_subs(rest, low), 0x10001u)); /* the carry */
    a = dsp_left(high, 15 - lobe->shift) | dsp_right(low, 1 + lobe->shift);
    return dsp_where_zero(dsp_subs(high, dsp_set((uint16_t)((2ul << lobe->shift) - 1u))),
                          dsp_power(a, lobe->squarings));
}

/* burnish_q15_normalize_near */
BURNISH_Q15_INLINE void dsp_normalize_near(dsp_pair v[3]) {
    const dsp_pair least = 0x80018001u, sign = 0x80008000u;
    dsp_pair limited, squared, gain;
    int i;
    limited = dsp_max_signed(dsp_shortfall(v), least);
    squared = dsp_high_signed(limited, limited);
    squared = dsp_add(dsp_add(squared, squared), squared);
    gain = dsp_mean(limited ^ sign, dsp_right(squared, 2) ^ sign) ^ sign;
    for (i = 0; i < 3; ++i) {
        const dsp_pair more =
            dsp_add(dsp_high_signed(v[i], gain), dsp_right(dsp_low(v[i], gain), 15));
        v[i] = dsp_max_signed(dsp_adds_signed(v[i], more), least);
    }
}

/* burnish_q15_accumulate */
BURNISH_Q15_INLINE dsp_pair dsp_accumulate(dsp_pair sum, dsp_pair factor, dsp_pair weight) {
    return dsp_adds(sum, dsp_high(factor, weight));
}

/* burnish_q15_code */
BURNISH_Q15_INLINE dsp_pair dsp_code(dsp_pair intensity, uint16_t largest) {
    const dsp_pair twice = dsp_set((uint16_t)(2u * largest));
    const dsp_pair x = dsp_sub(intensity, dsp_subs(intensity, dsp_set(BURNISH_Q15_ONE)));
    return dsp_add(dsp_high(x, twice), dsp_right(dsp_low(x, twice), 15));
}

/* A light's numbers in both lanes. */
typedef struct dsp_light {
    dsp_axis direction, half_axis;
    dsp_pair half[3], diffuse[3], specular[3];
} dsp_light;

BURNISH_Q15_INLINE void dsp_light_of(dsp_light *wide, const burnish_q15_light *light) {
    int i;
    wide->direction = dsp_axis_of(light->direction);
    wide->half_axis = dsp_axis_of(light->half);
    for (i = 0; i < 3; ++i) {
        wide->half[i] = dsp_set((uint16_t)light->half[i]);
        wide->diffuse[i] = dsp_set(light->diffuse[i]);
        wide->specular[i] = dsp_set(light->specular[i]);
    }
}

enum { DSP_LIGHTS_KEPT = 4 }; /* lights that are spread once, not again for every two pixels */

/* What does not depend on the pixel. */
typedef struct dsp_shader {
    dsp_lobe lobe;
    dsp_pair ambient[3];
    uint8_t narrow, count;
    const burnish_q15_light *lights;
    dsp_light kept[DSP_LIGHTS_KEPT];
} dsp_shader;

BURNISH_Q15_INLINE void dsp_shader_of(dsp_shader *wide, const burnish_q15_shader *shader,
                                      const burnish_q15_light *lights, uint8_t count) {
    uint8_t i;
    wide->lobe = dsp_lobe_of(&shader->lobe);
    wide->narrow = shader->narrow;
    wide->count = count;
    wide->lights = lights;
    for (i = 0; i < 3; ++i) {
        wide->ambient[i] = dsp_set(shader->ambient[i]);
    }
    for (i = 0; i < count && i < DSP_LIGHTS_KEPT; ++i) {
        dsp_light_of(&wide->kept[i], &lights[i]);
    }
}

/* burnish_q15_shade */
BURNISH_Q15_INLINE void dsp_shade(const dsp_shader *shader, const dsp_pair normal[3],
                                  dsp_pair color[3]) {
    dsp_light spread;
    uint8_t i, k;
    for (k = 0; k < 3; ++k) {
        color[k] = shader->ambient[k];
    }
    for (i = 0; i < shader->count; ++i) {
        const dsp_light *light = &spread;
        dsp_pair cosine, weight;
        if (i < DSP_LIGHTS_KEPT) {
            light = &shader->kept[i];
        } else {
            dsp_light_of(&spread, &shader->lights[i]);
        }
        cosine = dsp_cosine(dsp_dot(normal, &light->direction));
        weight = dsp_adds(cosine, cosine);
        for (k = 0; k < 3; ++k) {
            color[k] = dsp_accumulate(color[k], light->diffuse[k], weight);
        }
        weight = shader->narrow
                     ? dsp_at_chord(&shader->lobe, normal, light->half)
                     : dsp_at_cosine(&shader->lobe, dsp_cosine(dsp_dot(normal, &light->half_axis)));
        weight = dsp_where_not_zero(cosine, weight);
        for (k = 0; k < 3; ++k) {
            color[k] = dsp_accumulate(color[k], light->specular[k], weight);
        }
    }
}

/* values[i] = burnish_lobe_q15_fast(lobe, cosines[i]).
 *   count  an even number */
static inline void dsp_lobe_fast(const burnish_lobe_q15 *lobe, size_t count,
                                 const uint16_t *cosines, uint16_t *values) {
    const dsp_lobe wide = dsp_lobe_of(lobe);
    size_t i;
    if (wide.squarings == 1) { /* the usual order: a loop without one inside */
        dsp_lobe one = wide;
        one.squarings = 1;
        for (i = 0; i < count; i += 2) {
            *(dsp_memory *)(values + i) = dsp_at_cosine(&one, *(const dsp_memory *)(cosines + i));
        }
        return;
    }
    for (i = 0; i < count; i += 2) {
        *(dsp_memory *)(values + i) = dsp_at_cosine(&wide, *(const dsp_memory *)(cosines + i));
    }
}

/* pixels[i]: burnish_q15_normalize_near, burnish_q15_shade and burnish_q15_rgb565 of a normal.
 *   count   an even number
 *   normal  x, y, z: Q15, of a length near 1, as after interpolation */
static inline void dsp_pixels_rgb565(const burnish_q15_shader *shader,
                                     const burnish_q15_light *lights, uint8_t light_count,
                                     size_t count, const int16_t *const normal[3],
                                     uint16_t *pixels) {
    dsp_shader wide;
    size_t i;
    int k;
    dsp_shader_of(&wide, shader, lights, light_count);
    for (i = 0; i < count; i += 2) {
        dsp_pair n[3], color[3];
        for (k = 0; k < 3; ++k) {
            n[k] = *(const dsp_memory *)(normal[k] + i);
        }
        dsp_normalize_near(n);
        dsp_shade(&wide, n, color);
        *(dsp_memory *)(pixels + i) = dsp_left(dsp_code(color[0], 31), 11) |
                                      dsp_left(dsp_code(color[1], 63), 5) | dsp_code(color[2], 31);
    }
}

#endif
