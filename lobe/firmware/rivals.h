/* Integer functions that the lobes are compared with: cycles.c times them. cosine: UQ1.15, above
 * 0x8000 counts as 1. */
#ifndef FIRMWARE_RIVALS_H
#define FIRMWARE_RIVALS_H

#include "burnish/lobe_q15.h"

/* c / (c + n (1 - c)) by one 32-bit division. */
static inline uint16_t schlick16(uint16_t exponent, uint16_t cosine) {
    const uint32_t below = cosine + burnish_q15_multiply(exponent, burnish_q15_lambda(cosine));
    return cosine >= BURNISH_Q15_ONE ? (uint16_t)0xFFFFu
                                     : (uint16_t)(((uint32_t)cosine << 16) / below);
}

#ifdef __AVR__
typedef __uint24 word24;
#else
typedef uint32_t word24;
#endif

/* The same to 8 bits, n <= 255: eight steps of restoring division, unrolled. */
static inline uint8_t schlick8(uint8_t exponent, uint16_t cosine) {
    const word24 below =
        (word24)cosine + (word24)burnish_q15_multiply(exponent, burnish_q15_lambda(cosine));
    word24 rest = cosine;
    uint8_t quotient = 0;
    if (cosine >= BURNISH_Q15_ONE) {
        return 0xFF;
    }
#define STEP(bit)                                                                                  \
    rest = (word24)(rest + rest);                                                                  \
    if (rest >= below) {                                                                           \
        rest = (word24)(rest - below);                                                             \
        quotient |= (uint8_t)(bit);                                                                \
    }
    STEP(128)
    STEP(64)
    STEP(32)
    STEP(16)
    STEP(8)
    STEP(4)
    STEP(2)
    STEP(1)
#undef STEP
    return quotient;
}

/* The nearest entry.  table  256 words: cos^n in the middles of 256 steps of the cosine, UQ0.16 */
static inline uint16_t table_nearest(const uint16_t *table, uint16_t cosine) {
    return table[(uint8_t)(cosine >= BURNISH_Q15_ONE ? 255 : cosine >> 7)];
}

/* Between two entries.  table  257 words: cos^n at the ends of these steps, UQ0.16 */
static inline uint16_t table_between(const uint16_t *table, uint16_t cosine) {
    uint8_t part = (uint8_t)(cosine & 127u), step = (uint8_t)(cosine >> 7);
    if (cosine >= BURNISH_Q15_ONE) {
        part = 128;
        step = 255;
    }
    table += step;
    return (uint16_t)(table[0] +
                      (uint16_t)(burnish_q15_multiply((uint16_t)(table[1] - table[0]), part) >> 7));
}

#endif
