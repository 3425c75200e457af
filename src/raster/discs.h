/* Points as spheres: discs on the screen with the depth of a sphere. A disc is placed like a vertex,
 * to 1/256 pixel, and covers a sample whose distance from its centre is at most its radius, which is
 * rounded to 1/256 pixel: both sides of the comparison are integers. The perspective of a disc is
 * that of its centre. */
#ifndef BURNISH_RASTER_DISCS_H
#define BURNISH_RASTER_DISCS_H

#include "raster/geometry.h"

enum {
    /* half a pixel's diagonal: so a point of any size covers the centre of a pixel */
    BURNISH_POINT_LEAST = 182,
    BURNISH_POINT_MOST = 4096 * BURNISH_SUBPIXELS
};

/* A disc: its radius in 1/256 pixel, and the depth of the sphere's nearest point. */
typedef struct burnish_disc {
    int32_t radius;
    float nearest;
} burnish_disc;

static inline burnish_disc burnish_disc_of(const burnish_point_view *points, float depth,
                                           float inverse_w) {
    const float w = 1.0f / inverse_w, pixels = points->radius_w * inverse_w;
    const int most = BURNISH_POINT_MOST / BURNISH_SUBPIXELS;
    const int32_t radius = pixels < (float)most ? burnish_to_fixed(pixels) : BURNISH_POINT_MOST;
    return (burnish_disc){radius < BURNISH_POINT_LEAST ? BURNISH_POINT_LEAST : radius,
                          (depth * w + points->nearer_z) / (w + points->nearer_w)};
}

/* Where a sample is in a disc, in units of its radius: right, up, and how far the sphere is in front
 * of its centre. */
typedef struct burnish_disc_position {
    float x, y, toward;
} burnish_disc_position;

/* x, y: from the centre, right and down, in 1/256 pixel like the radius. */
static inline burnish_disc_position burnish_disc_position_of(int32_t x, int32_t y, int32_t radius) {
    const float scale = 1.0f / (float)radius;
    const float u = (float)x * scale, v = (float)-y * scale;
    const float rest = 1.0f - (u * u + v * v);
    return (burnish_disc_position){u, v, __builtin_sqrtf(rest > 0 ? rest : 0)};
}

/* The square of the cosine below which a normal does not tell which side faces the viewer. */
#define BURNISH_POINT_GRAZING 0.117f

/* Unit vector to the viewer; x, y: pixels from the image's centre, right and up. */
static inline void burnish_point_toward(const burnish_point_view *points, float x, float y,
                                        float toward[3]) {
    float sum = 0;
    for (int k = 0; k < 3; ++k) {
        toward[k] =
            -points->forward[k] - (points->right[k] * x + points->up[k] * y) * points->slope;
        sum += toward[k] * toward[k];
    }
    const float scale = 1.0f / __builtin_sqrtf(sum);
    for (int k = 0; k < 3; ++k) {
        toward[k] *= scale;
    }
}

/* The normal of a point at a position in its disc: its own, turned toward the viewer, or the
 * sphere's if that is 0, 0, 0. Near the outline of an object, points of its far side show a rim of
 * their discs, so a grazing normal is turned to the sphere's side. x, y: as above. */
static inline void burnish_point_normal(const burnish_point_view *points, const float own[3],
                                        const burnish_disc_position *at, float x, float y,
                                        float normal[3]) {
    float toward[3], sphere[3], cosine = 0, square = 0, side = 0;
    burnish_point_toward(points, x, y, toward);
    for (int k = 0; k < 3; ++k) {
        sphere[k] = (points->right[k] * at->x + points->up[k] * at->y) + toward[k] * at->toward;
        cosine += own[k] * toward[k];
        side += own[k] * sphere[k];
        square += own[k] * own[k];
    }
    side = cosine * cosine > BURNISH_POINT_GRAZING * square ? cosine : side;
    for (int k = 0; k < 3; ++k) {
        normal[k] = square == 0 ? sphere[k] : side < 0 ? -own[k] : own[k];
    }
}

#endif
