/* Transforms a vertex, and culls and bounds a triangle, in plain C. The SIMD code of src/raster
 * must give the same bits. Included by tests. */
#ifndef BURNISH_TEST_REFERENCE_GEOMETRY_H
#define BURNISH_TEST_REFERENCE_GEOMETRY_H

#include <string.h>

#include "raster/fragments.h"

/* A vertex on the screen, one at a time. */
static burnish_screen_vertex reference_vertex(const burnish_raster_view *view,
                                              const float position[3], float *inverse_w) {
    float clip[4];
    for (int i = 0; i < 4; ++i) {
        const float *row = view->rows[i];
        float x = position[0] - view->origin[0], y = position[1] - view->origin[1],
              z = position[2] - view->origin[2];
        clip[i] = ((row[0] * x + row[1] * y) + row[2] * z) + row[3];
    }
    const float half_width = (float)view->width * 0.5f * clip[3];
    const float half_height = (float)view->height * 0.5f * clip[3];
    const float guard = BURNISH_GUARD_BAND * clip[3];
    burnish_screen_vertex made = {0, 0, 0, 0};
    made.outcode |= clip[0] < -half_width ? BURNISH_OUT_LEFT : 0;
    made.outcode |= clip[0] > half_width ? BURNISH_OUT_RIGHT : 0;
    made.outcode |= clip[1] < -half_height ? BURNISH_OUT_BOTTOM : 0;
    made.outcode |= clip[1] > half_height ? BURNISH_OUT_TOP : 0;
    made.outcode |= clip[2] > clip[3] ? BURNISH_OUT_NEAR : 0;
    made.outcode |= clip[0] < -guard || clip[0] > guard || clip[1] < -guard || clip[1] > guard
                        ? BURNISH_OUT_GUARD
                        : 0;
    *inverse_w = 0;
    if (!(made.outcode & BURNISH_OUT_CLIP)) {
        *inverse_w = 1.0f / clip[3];
        made.x = burnish_to_fixed(clip[0] * *inverse_w) + view->width * (BURNISH_SUBPIXELS / 2);
        made.y = view->height * (BURNISH_SUBPIXELS / 2) - burnish_to_fixed(clip[1] * *inverse_w);
        made.depth = clip[2] * *inverse_w;
    }
    return made;
}

/* Minimum and maximum of three numbers, and the pixels along an axis whose samples can be between
 * them. */
static int reference_range(int a, int b, int c, int samples, int size, int *first, int *last) {
    const int low = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const int high = a > b ? (a > c ? a : c) : (b > c ? b : c);
    *first = (low + (samples == 1 ? 127 : 0)) >> 8;
    *last = (high - (samples == 1 ? 128 : 0)) >> 8;
    *first = *first < 0 ? 0 : *first;
    *last = *last >= size ? size - 1 : *last;
    return *first <= *last;
}

/* As burnish_triangle_batch has it. */
typedef struct reference_bounds {
    float nearest;
    uint32_t first, last;
} reference_bounds;

/* An unclipped triangle; returns 0 when it can't be seen. */
static int reference_cull(const burnish_raster_view *view, const burnish_screen_vertex v[3],
                          reference_bounds *made, int *back) {
    const int64_t area = (int64_t)(v[1].x - v[0].x) * (v[2].y - v[0].y) -
                         (int64_t)(v[2].x - v[0].x) * (v[1].y - v[0].y);
    int x0, x1, y0, y1;
    memset(made, 0, sizeof *made);
    if ((v[0].outcode & v[1].outcode & v[2].outcode & BURNISH_OUT_REJECT) || area == 0 ||
        (view->cull_back_faces && area > 0) ||
        !reference_range(v[0].x, v[1].x, v[2].x, view->samples, view->width, &x0, &x1) ||
        !reference_range(v[0].y, v[1].y, v[2].y, view->samples, view->height, &y0, &y1)) {
        return 0;
    }
    *back = area > 0;
    made->nearest = v[0].depth;
    for (int i = 1; i < 3; ++i) {
        made->nearest = v[i].depth > made->nearest ? v[i].depth : made->nearest;
    }
    made->first = (uint32_t)(y0 / 8 << 16 | x0 / 8);
    made->last = (uint32_t)(y1 / 8 << 16 | x1 / 8);
    return 1;
}

#endif
