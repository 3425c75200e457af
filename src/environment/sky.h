/* The environment "sky". */
#ifndef BURNISH_ENVIRONMENT_SKY_H
#define BURNISH_ENVIRONMENT_SKY_H

/* Fills an equirectangular image of 3 width height floats. */
void burnish_sky_fill(int width, int height, float *rgb);

#endif
