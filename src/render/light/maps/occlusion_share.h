/* Ambient occlusion of a batch of points. Neighbours in the picture that lie near each other and
 * face about the same way share one look-up: what hides the sky changes little from one to the
 * next. */
#ifndef BURNISH_RENDER_LIGHT_OCCLUSION_SHARE_H
#define BURNISH_RENDER_LIGHT_OCCLUSION_SHARE_H

#include "raster/tile_layout.h"
#include "render/light/maps/occlusion.h"
#include "render/render_ops.h"

enum {
    BURNISH_SHARE_BATCH = BURNISH_OCCLUDED_MAX,
    BURNISH_SHARE_SQUARES = BURNISH_TILE_PIXELS / 4 /* of 2 x 2 pixels */
};

/* A batch: count <= BURNISH_SHARE_BATCH points, arrays readable up to the next multiple of 16. */
typedef struct burnish_share_points {
    const float *position[3]; /* times w, from the eye */
    const float *w;
    const float *normal[3];
    const uint16_t *pixels; /* index in the tile; NULL: first_pixel + i */
    int first_pixel;
    const int32_t *shown; /* points below 0 are not looked up; NULL: all are */
    int are_layers;       /* 1: other surfaces are behind these; by rays */
} burnish_share_points;

/* A thread's arrays. All zero before the first use. */
typedef struct burnish_share_scratch {
    float position[3][BURNISH_SHARE_BATCH], normal[3][BURNISH_SHARE_BATCH]; /* of the points */
    float key_position[3][BURNISH_SHARE_BATCH], key_normal[3][BURNISH_SHARE_BATCH];
    float open[BURNISH_SEEN_VALUES][BURNISH_SHARE_BATCH];
    float key_open[2][BURNISH_SHARE_BATCH]; /* of the keys: the points that are looked up */
    uint16_t key[BURNISH_SHARE_BATCH];      /* of a point */
    uint16_t square[BURNISH_SHARE_BATCH], next[BURNISH_SHARE_BATCH]; /* of a key */
    uint16_t first[BURNISH_SHARE_SQUARES]; /* key of a square, if square[key] is that square */
} burnish_share_scratch;

/* Writes the points' positions, and their normals as unit vectors, to the scratch. */
void burnish_share_prepare(const burnish_render_ops *ops, const burnish_share_points *points,
                           int count, burnish_share_scratch *scratch);

/* Writes what the points see of the light and the sky, less than 1 by at most the strength, to
 * scratch->open. */
void burnish_occlude_points(const burnish_occlusion_lookup *lookup, const burnish_render_ops *ops,
                            const burnish_share_points *points, int count,
                            burnish_share_scratch *scratch);

#endif
