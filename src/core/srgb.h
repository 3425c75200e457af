/* sRGB transfer function (IEC 61966-2-1) by exact tables: no pow at run time. */
#ifndef BURNISH_CORE_SRGB_H
#define BURNISH_CORE_SRGB_H

#include <stdint.h>

#include "base/arithmetic.h"

/* Linear light of each 8-bit code, correctly rounded. */
extern const float burnish_srgb_to_linear[256];

/* The nearest 8-bit code of a linear value, exactly: the largest code k whose lower decision level,
 * the linear value of (k - 1/2) / 255 rounded up to float, is <= linear. NaN and values <= 0 give
 * 0, above 1 give 255. */
uint8_t burnish_linear_to_srgb(float linear);

/* The same look-up for vectors: one table entry decides. With b, the bits of the float clamped to
 * [BURNISH_SRGB_FIRST_BITS, BURNISH_SRGB_LAST_BITS] as above, (entry + b) >> 16 is the code, where
 * the entry of bucket (b - FIRST_BITS) >> 16 is (its first code + 1 << 16) - the bits of the
 * decision level in it, or of its end. AROUND the buckets are entries that are read, but not used. */
enum { BURNISH_SRGB_BUCKETS = 1664, BURNISH_SRGB_AROUND = 16 };
#define BURNISH_SRGB_FIRST_BITS 0x39000000
#define BURNISH_SRGB_LAST_BITS 0x3f7fffff
typedef struct burnish_srgb_encoder {
    int32_t entries[BURNISH_SRGB_AROUND + BURNISH_SRGB_BUCKETS + BURNISH_SRGB_AROUND];
} burnish_srgb_encoder;

/* Fills the table: a few microseconds. */
void burnish_srgb_encoder_make(burnish_srgb_encoder *encoder);

/* Linear light of an sRGB value in [0, 1] between codes, by linear interpolation of the table;
 * clamps. */
float burnish_srgb_value_to_linear(float value);

#endif
