/* Clipping by one plane after another (Sutherland and Hodgman 1974). */
#include "raster/geometry.h"

#include <assert.h>
#include <string.h>

#include "base/arithmetic.h"

enum { PLANE_COUNT = 5 };

/* Signed distance to a plane, >= 0 inside: near, then the guard band's four sides. */
static float plane_distance(const float p[4], int plane) {
    switch (plane) {
    case 0:
        return p[3] - p[2];
    case 1:
        return BURNISH_GUARD_BAND * p[3] + p[0];
    case 2:
        return BURNISH_GUARD_BAND * p[3] - p[0];
    case 3:
        return BURNISH_GUARD_BAND * p[3] + p[1];
    default:
        return BURNISH_GUARD_BAND * p[3] - p[1];
    }
}

/* The point where an edge leaves a plane. Interpolates from the inner end, so both triangles at the
 * edge get the same bits. */
static burnish_clip_corner cut_edge(const burnish_clip_corner *inner, float inner_distance,
                                    const burnish_clip_corner *outer, float outer_distance) {
    float t = inner_distance / (inner_distance - outer_distance);
    burnish_clip_corner point;
    for (int i = 0; i < 4; ++i) {
        point.position[i] = inner->position[i] + (outer->position[i] - inner->position[i]) * t;
    }
    for (int i = 0; i < 3; ++i) {
        point.weights[i] = inner->weights[i] + (outer->weights[i] - inner->weights[i]) * t;
    }
    return point;
}

/* Rounding of the cut points can make a polygon slightly concave; the bound still holds. */
static int append_corner(burnish_clip_corner *out, int count, burnish_clip_corner corner) {
    if (count < BURNISH_CLIP_MAX) {
        out[count++] = corner;
    }
    return count;
}

static int clip_plane(const burnish_clip_corner *in, int count, int plane,
                      burnish_clip_corner *out) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        const burnish_clip_corner *a = &in[i];
        const burnish_clip_corner *b = &in[i + 1 < count ? i + 1 : 0];
        float da = plane_distance(a->position, plane);
        float db = plane_distance(b->position, plane);
        if (da >= 0) {
            kept = append_corner(out, kept, *a);
        }
        if (da >= 0 && db < 0) {
            kept = append_corner(out, kept, cut_edge(a, da, b, db));
        } else if (da < 0 && db >= 0) {
            kept = append_corner(out, kept, cut_edge(b, db, a, da));
        }
    }
    return kept;
}

int burnish_clip_polygon(burnish_clip_corner *corners, int count) {
    burnish_clip_corner other[BURNISH_CLIP_MAX];
    assert(count >= 3 && count <= BURNISH_CLIP_MAX);
    for (int plane = 0; plane < PLANE_COUNT && count >= 3; ++plane) {
        count = clip_plane(corners, count, plane, other);
        memcpy(corners, other, (size_t)count * sizeof *corners);
    }
    return count >= 3 ? count : 0;
}
