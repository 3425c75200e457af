#include "mesh/read/gcode/gcode.h"

#include <float.h>

#include "core/vec3.h"

/* Of the diagonal of the path: a fifth of a pixel in pictures of 512 pixels. */
#define FINEST (1.0 / 2000)

/* Turns with a smaller cosine have square corners. */
#define SHARP 0.2

static burnish_vec3 between(const burnish_gcode_point *from, const burnish_gcode_point *to) {
    return burnish_vec3_sub(burnish_vec3_loadf(to->position), burnish_vec3_loadf(from->position));
}

/* Whether a rod to the point has another direction than the one that ends at the last point. */
static int is_sharp(const burnish_gcode *g, const burnish_gcode_point *point) {
    const burnish_gcode_point *last = g->points + g->count - 1;
    return !point->is_start && !last->is_start &&
           burnish_vec3_dot(burnish_vec3_normalize(between(last - 1, last)),
                            burnish_vec3_normalize(between(last, point))) < SHARP;
}

static void append(burnish_gcode *g, const burnish_gcode_point *point) {
    g->points = burnish_reserve(g->memory, g->points, &g->capacity, g->count + 2, sizeof *point,
                                "a path of G-code");
    if (g->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    if (g->count > 0 && g->count + 2 < g->room && is_sharp(g, point)) {
        g->points[g->count] = g->points[g->count - 1];
        g->points[g->count++].is_start = 1;
    }
    g->points[g->count++] = *point;
    g->bend = 0;
}

void burnish_gcode_flush(burnish_gcode *g) {
    if (g->has_pending) {
        g->has_pending = 0;
        append(g, &g->pending);
    }
}

/* How far the pending point is from a rod that passes it; infinite if the path turns back. */
static double find_bend(const burnish_gcode *g, const burnish_gcode_point *point) {
    const burnish_gcode_point *last = g->points + g->count - 1;
    const burnish_vec3 all = between(last, point), first = between(last, &g->pending);
    return burnish_vec3_dot(first, between(&g->pending, point)) < 0
               ? DBL_MAX
               : burnish_vec3_length(burnish_vec3_cross(first, burnish_vec3_normalize(all)));
}

/* Widths that change along a wall are one rod within a tenth. */
static int is_like(const burnish_gcode_point *a, const burnish_gcode_point *b) {
    return a->feature == b->feature && a->tool == b->tool && a->layer == b->layer &&
           a->height == b->height && b->width >= 0.9F * a->width && b->width <= 1.1F * a->width;
}

void burnish_gcode_add(burnish_gcode *g, const burnish_gcode_point *point) {
    if (!point->is_start && g->has_pending && is_like(&g->pending, point)) {
        const double bend = g->bend + find_bend(g, point);
        if (bend <= g->tolerance) { /* a bound for the distances of all points between */
            g->bend = bend;
            memcpy(g->pending.position, point->position, sizeof point->position);
            g->pending.filament += point->filament;
            g->pending.length += point->length;
            return;
        }
    }
    burnish_gcode_flush(g);
    if (point->is_start) {
        append(g, point);
    } else {
        g->pending = *point;
        g->has_pending = 1;
    }
}

/* Passes the path through the tolerance and the step of layers again, in place: it never has more
 * points than were read. */
static void pass_again(burnish_gcode *g) {
    const size_t count = g->count;
    int is_cut = 0;
    g->count = 0;
    for (g->room = 1; g->room <= count; ++g->room) {
        burnish_gcode_point point = g->points[g->room - 1];
        point.is_start |= (uint8_t)is_cut;
        is_cut = point.layer % g->layer_step != 0;
        if (!is_cut) {
            burnish_gcode_add(g, &point);
        }
    }
    burnish_gcode_flush(g);
    g->room = SIZE_MAX;
}

static double measure(const burnish_gcode *g) {
    double low[3], high[3], squared = 0;
    for (size_t i = 0; i < 3 * g->count; ++i) {
        const double at = (double)g->points[i / 3].position[i % 3];
        low[i % 3] = i < 3 || at < low[i % 3] ? at : low[i % 3];
        high[i % 3] = i < 3 || at > high[i % 3] ? at : high[i % 3];
    }
    for (int k = 0; k < 3; ++k) {
        squared += (high[k] - low[k]) * (high[k] - low[k]);
    }
    return burnish_sqrt(squared);
}

burnish_status burnish_gcode_reduce(burnish_gcode *g, size_t most) {
    burnish_gcode_flush(g);
    while (g->count > most && g->memory->status == BURNISH_STATUS_OK) {
        const double size = measure(g);
        if (g->tolerance < size * FINEST) {
            g->tolerance = size * FINEST;
        } else if (g->layer_step <= g->layer / 64) {
            g->layer_step *= 2;
        } else if (g->tolerance < size / 20) {
            g->tolerance *= 2;
        } else if (g->layer_step <= g->layer) {
            g->layer_step *= 2;
        } else {
            return burnish_reader_fail(g->reader, BURNISH_STATUS_LIMIT, NULL,
                                       "its path has more than %zu pieces in a layer; draw fewer "
                                       "objects, or raise --max-memory and --max-triangles",
                                       most);
        }
        pass_again(g);
    }
    return g->memory->status;
}
