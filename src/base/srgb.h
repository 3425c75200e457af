/* sRGB transfer function (IEC 61966-2-1) by exact tables: no pow at run time. */
#ifndef BURNISH_BASE_SRGB_H
#define BURNISH_BASE_SRGB_H

#include <stdint.h>

/* Linear light of each 8-bit code, correctly rounded. */
extern const float burnish_srgb_to_linear[256];

/* The nearest 8-bit code of a linear value, exactly: the largest code k whose lower decision level,
 * the linear value of (k - 1/2) / 255 rounded up to float, is <= linear. NaN and values <= 0 give
 * 0, above 1 give 255. */
uint8_t burnish_linear_to_srgb(float linear);

/* Linear light of an sRGB value in [0, 1] between codes, by linear interpolation of the table;
 * clamps. */
float burnish_srgb_value_to_linear(float value);

#endif
