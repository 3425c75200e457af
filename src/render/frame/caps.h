/* Caps: what a cut opened of a solid, filled.
 *
 * A solid is closed. So where the nearest triangle that a cut left is seen from the inside, the
 * line of sight came into the solid through the cut: it met the plane in the solid's inside. There
 * the plane is drawn, with its own depth and normal, hatched. That needs no triangles for the cut,
 * and its border is the border of the triangles that are seen from inside, to the sample.
 *
 * Of several planes the one that is entered last counts: what is before it is cut away. */
#ifndef BURNISH_RENDER_FRAME_CAPS_H
#define BURNISH_RENDER_FRAME_CAPS_H

#include "burnish/mesh.h"
#include "raster/fragments.h"

/* A plane that is seen from the side which was cut away. Its depth at (x, y), pixels from the
 * image's centre, y up, is (right x + up y) + middle. */
typedef struct burnish_cap {
    double right, up, middle;
    float normal[3]; /* unit length, toward the viewer's side */
    int number;      /* of the cut */
} burnish_cap;

typedef struct burnish_caps {
    int count;
    unsigned inside;         /* id_and_facing & 1 of triangles that are seen from inside */
    size_t triangles;        /* the solid's; others follow them, and have no caps */
    const uint16_t *regions; /* of each triangle: see burnish_hatch_style */
    burnish_cap items[BURNISH_CUTS_MAX];
} burnish_caps;

/* Whether a cap lies before a triangle, if a plane does. */
static inline int burnish_caps_hold(const burnish_caps *caps, uint32_t id_and_facing) {
    return (id_and_facing & 1) == caps->inside && id_and_facing >> 1 < caps->triangles;
}

/* The range of depths at (x, y) that cuts leave. */
typedef struct burnish_cap_range {
    int count;
    burnish_cap items[BURNISH_CUTS_MAX];
    int is_exit[BURNISH_CUTS_MAX]; /* 1: what stays is nearer */
} burnish_cap_range;
burnish_cap_range burnish_caps_range(const burnish_mesh_view *mesh,
                                     const burnish_raster_view *view);

/* Planes that are seen edge on, or from the side that stays, make no caps; count is 0 where the
 * mesh is not cut, or no solid. */
burnish_caps burnish_caps_create(const burnish_mesh_view *mesh, const burnish_raster_view *view);

/* The cap at a point where a triangle is seen from inside at `depth`, which becomes the cap's; NULL
 * where no cap is nearer: a line of sight that begins in the solid. */
const burnish_cap *burnish_caps_find(const burnish_caps *caps, double x, double y, float *depth);

/* The width of the hatching's lines in pixels. */
#define BURNISH_HATCH_WIDTH 1.1f

/* The style of hatching, which tells parts that touch apart (ISO 128-50), or materials if there are
 * no parts: bit 0 is the way of the lines, the rest chooses their distance. */
static inline int burnish_hatch_style(int cut, const uint16_t *regions, size_t triangle) {
    const int region = regions ? regions[triangle] : 0;
    return ((cut + region) & 1) + 2 * (region / 2 % 3);
}

static inline const uint16_t *burnish_hatch_regions(const burnish_mesh_view *mesh) {
    return mesh->triangle_parts ? mesh->triangle_parts : mesh->triangle_materials;
}

/* How far apart lines are along a row, in pixels. */
static inline int burnish_hatch_period(int style) {
    return style < 2 ? 14 : style < 4 ? 9 : 20;
}

/* How much of a cap's hatching a pixel of the image shows, [0, 1]: lines of constant width and
 * distance in pixels at 45 degrees, antialiased. */
float burnish_cap_hatch(int style, int x, int y);
#define BURNISH_NO_CAP (-1.0f)

/* What that, or BURNISH_NO_CAP, makes of light: of channel k, 0 is red. Caps are a little warmer
 * than their material, and lines darker. */
static inline float burnish_cap_light(float hatch, int k) {
    static const float tint[3] = {1.0f, 0.92f, 0.80f};
    return hatch < 0 ? 1 : tint[k] * (1 - 0.62f * hatch);
}

#endif
