/* Showing differences: blue where the second picture is darker, orange where it is lighter, both
 * darker the larger the difference, so that they read in print and without seeing red or green. */
#ifndef TOOL_PICTURE_DIFFERENCE_H
#define TOOL_PICTURE_DIFFERENCE_H

#include "burnish/image.h"

/* What a picture's colours are from the strongest difference below to that above: `end` stands for
 * those from end on. */
void picture_difference_color(double difference, double end, uint8_t color[3]);

/* Of each pixel image - reference in the channel where it is largest, as a new picture of the same
 * channels. Transparent pixels lie on white; of alpha there is no difference. Errors: MEMORY. */
burnish_status picture_subtract(const burnish_image *reference, const burnish_image *image,
                                double end, burnish_image *result, burnish_error *error);

/* A bar of the colours from `low` (-end, or 0 for what has no sign) to end, and numbers below it.
 *   left, top, width, thickness  of the bar, pixels
 *   height                       of the numbers, pixels */
void picture_draw_scale(burnish_image *card, int left, int top, int width, int thickness,
                        float height, double low, double end);

/* A line of text whose middle is at x. */
void picture_draw_centered(burnish_image *image, float x, float y, float height, const char *text);

#endif
