/* The sRGB tables and their look-up. */
#include "core/srgb.h"

#include <string.h>

#include "core/srgb_table.h"

const float burnish_srgb_to_linear[256] = {SRGB_LINEAR};

static const float next_threshold[256] = {SRGB_NEXT_THRESHOLD};
static const uint8_t bucket_code[SRGB_BUCKETS] = {SRGB_BUCKET_CODE};

static float bits_float(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The float's pattern names a bucket with at most two thresholds in it, so two comparisons decide.
 * The order of the first clamp's operands sends NaN to the lowest bucket. */
uint8_t burnish_linear_to_srgb(float linear) {
    const float lowest = bits_float(SRGB_FIRST_BITS);
    const float highest = bits_float(SRGB_LAST_BITS);
    float x = linear > lowest ? linear : lowest;
    x = x < highest ? x : highest;
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    unsigned code = bucket_code[(bits - SRGB_FIRST_BITS) >> SRGB_BUCKET_SHIFT];
    code += x >= next_threshold[code];
    return (uint8_t)(code + (x >= next_threshold[code]));
}

_Static_assert(BURNISH_SRGB_FIRST_BITS == SRGB_FIRST_BITS &&
                   BURNISH_SRGB_LAST_BITS == SRGB_LAST_BITS &&
                   BURNISH_SRGB_BUCKETS << 16 == SRGB_BUCKETS << SRGB_BUCKET_SHIFT,
               "the packed table covers the floats of srgb_table.h");

void burnish_srgb_encoder_make(burnish_srgb_encoder *encoder) {
    memset(encoder, 0, sizeof *encoder);
    for (uint32_t i = 0; i < BURNISH_SRGB_BUCKETS; ++i) {
        const uint32_t first = SRGB_FIRST_BITS + (i << 16), end = first + (1 << 16);
        const uint32_t code = burnish_linear_to_srgb(bits_float(first));
        uint32_t level;
        memcpy(&level, &next_threshold[code], sizeof level);
        encoder->entries[BURNISH_SRGB_AROUND + i] =
            (int32_t)(((code + 1) << 16) - (level < end ? level : end));
    }
}

float burnish_srgb_value_to_linear(float value) {
    if (!(value > 0)) {
        return 0;
    }
    if (value >= 1) {
        return 1;
    }
    float position = value * 255.0F;
    int code = (int)position;
    if (code > 254) {
        return 1; /* the product was rounded up to 255 */
    }
    float low = burnish_srgb_to_linear[code];
    float high = burnish_srgb_to_linear[code + 1];
    return low + (high - low) * (position - (float)code);
}
