/* Whether the outline of an object is round, so that it has a diameter: a disc, a gear. */
#include "annotate/annotate.h"
#include "mesh/axes.h"

enum { SECTORS = 16 };

#define SQUARE 0.03 /* of a side of the box: how much the sides differ, at most */
#define NEAR 0.97   /* of half a side: how far the outermost vertex of each sector is, at least */
#define ROUND 0.004 /* of the radius: how far that vertex can be from the circle */
#define TAN_22_5 0.41421356237309504880

static burnish_vec3 across(burnish_vec3 v, int axis) {
    return (burnish_vec3){burnish_axis(v, (axis + 1) % 3), burnish_axis(v, (axis + 2) % 3), 0};
}

static int sector_of(burnish_vec3 v) {
    const double a = burnish_magnitude(v.x), b = burnish_magnitude(v.y);
    return (v.x < 0) | (v.y < 0) << 1 | (a < b) << 2 |
           ((a < b ? a : b) > TAN_22_5 * (a < b ? b : a)) << 3;
}

double burnish_annotation_diameter(const burnish_annotation_view *view, int axis) {
    const burnish_mesh_view *mesh = view->mesh;
    const burnish_vec3 low = across(view->low, axis), high = across(view->high, axis);
    const burnish_vec3 middle = burnish_vec3_scale(burnish_vec3_add(low, high), 0.5);
    const double side = high.x - low.x, other = high.y - low.y;
    burnish_vec3 far[SECTORS] = {{0, 0, 0}}, center;
    double radius;
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        const burnish_vec3 p = across(burnish_vec3_loadf(mesh->positions + 3 * i), axis);
        const burnish_vec3 v = burnish_vec3_sub(p, middle);
        burnish_vec3 *best = &far[sector_of(v)];
        *best = burnish_vec3_dot(v, v) > burnish_vec3_dot(*best, *best) ? v : *best;
    }
    const burnish_vec3 three[3] = {far[0], far[13], far[15]}; /* at 0, 120 and 240 degrees */
    if (!(burnish_magnitude(side - other) < SQUARE * side) ||
        !burnish_circle_through(three, &center, &radius)) {
        return 0;
    }
    for (int i = 0; i < SECTORS; ++i) {
        const double away = burnish_vec3_length(burnish_vec3_sub(far[i], center));
        if (!(burnish_vec3_length(far[i]) > NEAR * side / 2 && away > (1 - ROUND) * radius &&
              away < (1 + ROUND) * radius)) {
            return 0;
        }
    }
    return 2 * radius;
}
