/* Shows differences: blue where the second picture is darker, orange where it is lighter. Larger
 * differences are darker, which works in print and for colour-blind readers. */
#ifndef TOOL_PICTURE_DIFFERENCE_H
#define TOOL_PICTURE_DIFFERENCE_H

#include "burnish/image.h"

/* The colour of a difference, clamped to -end .. end. */
void picture_difference_color(double difference, double end, uint8_t color[3]);

/* Shows image - reference for each pixel, in the channel with the largest difference, as a new
 * picture. Transparent pixels are blended with white; alpha is not compared. Errors: MEMORY. */
burnish_status picture_subtract(const burnish_image *reference, const burnish_image *image,
                                double end, burnish_image *result, burnish_error *error);

/* Draws a bar of the colours from `low` (-end, or 0 for unsigned values) to end, with numbers below.
 *   box     of the bar: x, y, width, height, pixels
 *   height  of the numbers, pixels */
void picture_draw_scale(burnish_image *card, const int box[4], float height, double low,
                        double end);

#endif
