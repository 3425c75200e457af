/* From model space to the screen: the view, and the units that the rasteriser counts in.
 *
 * Screen space: x right, y down, 1/256 pixel, the origin at the image's top left corner; depth
 * grows toward the viewer. */
#ifndef BURNISH_RASTER_RASTER_VIEW_H
#define BURNISH_RASTER_RASTER_VIEW_H

#include <stdint.h>

enum {
    BURNISH_SUBPIXEL_BITS = 8,
    BURNISH_SUBPIXELS = 1 << BURNISH_SUBPIXEL_BITS, /* fixed-point steps per pixel */
    BURNISH_MAX_SAMPLES = 16                        /* coverage samples per pixel */
};

/* Pixels from the image's centre beyond which triangles are clipped, which keeps fixed point from
 * overflowing. */
#define BURNISH_GUARD_BAND 16000.0f

/* clip = rows * (p - origin, 1); x and y come out in pixels from the image's centre (y up) times w;
 * a point is in front of the near plane when z <= w. */
typedef struct burnish_raster_view {
    int width, height;   /* pixels */
    int samples;         /* 1, 4, 8 or 16 */
    int cull_back_faces; /* 1: they are left out */
    float origin[3];
    float rows[4][4]; /* x, y, z, w */
} burnish_raster_view;

/* Adding it to a float of magnitude below 2^22 leaves a whole number, halves rounded to even, in
 * the sum's lowest bits: 1.5 * 2^23. */
#define BURNISH_ROUNDER 12582912.0f

/* Rounds to 1/256 pixel, halves to even, which keeps mirrored scenes mirrored; abs(pixels) <
 * 16384. */
static inline int32_t burnish_to_fixed(float pixels) {
    const float sum = pixels * (float)BURNISH_SUBPIXELS + BURNISH_ROUNDER;
    return (int32_t)(sum - BURNISH_ROUNDER);
}

/* Two coordinates in one word, x in the low half. */
#define BURNISH_PACK(x, y) ((uint32_t)(x) | (uint32_t)(y) << 16)
#define BURNISH_PACKED_X(packed) ((packed)&0xffff)
#define BURNISH_PACKED_Y(packed) ((packed) >> 16)

typedef struct burnish_raster_ops burnish_raster_ops; /* raster_ops.h */

#endif
