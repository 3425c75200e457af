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

/* Between two entries.  table  257 words: cos^n at the ends of 256 steps of the cosine, UQ0.16 */
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
