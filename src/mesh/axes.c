/* Circles and arcs among sharp edges, and the axes that circles share. */
#include "mesh/axes.h"

#include <string.h>

enum { LEAST_VERTICES = 12, LEAST_TRIPLES = 3, AXES_MAX = 4096, CIRCLES_MAX = 1 << 14 };

#define NO_EDGE UINT32_MAX
#define CROWDED (UINT32_MAX - 1) /* more than two sharp edges meet */

#define ROUND_SHARE 0.004 /* of the radius: how far vertices are from the circle and its plane */
#define CHORD_SHARE 0.6   /* of the radius: the longest edge */
#define SAME_SINE 0.005   /* of the angle between directions that are one */
#define LEAST_ANGLE 0.52  /* radians, of an arc */
#define SAME_CENTER 0.02  /* of the radius: between circles through three points each of an arc */
#define LEAST_SPAN 0.01   /* of the radius: between circles that are two */

typedef struct finder {
    const burnish_mesh_view *mesh;
    const burnish_edges *edges;
    burnish_memory *memory;
    uint32_t *at; /* of each vertex: two sharp edges */
    uint8_t *is_walked;
    burnish_vec3 *points; /* of the loop at hand */
    size_t point_count, point_capacity;
    burnish_axes *axes;
} finder;

static int is_sharp(const burnish_edge *edge) {
    return edge->flags & BURNISH_EDGE_SHARP;
}

static void note_edge(finder *f, uint32_t edge, uint32_t vertex) {
    uint32_t *at = f->at + 2 * (size_t)vertex;
    if (at[0] == NO_EDGE) {
        at[0] = edge;
    } else if (at[1] == NO_EDGE) {
        at[1] = edge;
    } else {
        at[0] = at[1] = CROWDED;
    }
}

static void push_point(finder *f, burnish_vec3 point) {
    f->points = burnish_reserve(f->memory, f->points, &f->point_capacity, f->point_count + 1,
                                sizeof *f->points, "circles");
    if (f->memory->status == BURNISH_STATUS_OK) {
        f->points[f->point_count++] = point;
    }
}

/* Walks from an edge's end across it until no single other edge goes on; returns 1 for a loop. */
static int walk(finder *f, uint32_t edge, int end) {
    const burnish_edge *items = f->edges->items;
    uint32_t vertex = items[edge].ends[end];
    f->point_count = 0;
    do {
        push_point(f, burnish_vec3_loadf(f->mesh->positions + 3 * (size_t)vertex));
        f->is_walked[edge] = 1;
        vertex = items[edge].ends[items[edge].ends[0] == vertex];
        const uint32_t *at = f->at + 2 * (size_t)vertex;
        if (at[1] >= CROWDED) {
            push_point(f, burnish_vec3_loadf(f->mesh->positions + 3 * (size_t)vertex));
            return 0;
        }
        edge = at[0] == edge ? at[1] : at[0];
    } while (!f->is_walked[edge]);
    return 1;
}

/* A circle through points: its centre by least squares (Kasa 1976), relative to their mean. */
static int fit_circle(const burnish_vec3 *points, size_t n, burnish_vec3 *center,
                      burnish_vec3 *normal, double *radius) {
    burnish_vec3 mean = {0, 0, 0}, area = {0, 0, 0};
    for (size_t i = 0; i < n; ++i) {
        mean = burnish_vec3_add(mean, points[i]);
    }
    mean = burnish_vec3_scale(mean, 1 / (double)n);
    for (size_t i = 0; i < n; ++i) {
        area =
            burnish_vec3_add(area, burnish_vec3_cross(burnish_vec3_sub(points[i], mean),
                                                      burnish_vec3_sub(points[(i + 1) % n], mean)));
    }
    *normal = burnish_vec3_normalize(area);
    const burnish_vec3 u = burnish_vec3_normalize(burnish_vec3_sub(points[0], mean));
    const burnish_vec3 v = burnish_vec3_cross(*normal, u);
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, squares = 0;
    for (size_t i = 0; i < n; ++i) {
        const burnish_vec3 p = burnish_vec3_sub(points[i], mean);
        const double x = burnish_vec3_dot(p, u), y = burnish_vec3_dot(p, v), z = x * x + y * y;
        xx += x * x, xy += x * y, yy += y * y, xz += x * z, yz += y * z, squares += z;
    }
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-6 * xx * yy)) {
        return 0;
    }
    const double a = (xz * yy - yz * xy) / (2 * determinant);
    const double b = (yz * xx - xz * xy) / (2 * determinant);
    *center = burnish_vec3_add(
        mean, burnish_vec3_add(burnish_vec3_scale(u, a), burnish_vec3_scale(v, b)));
    *radius = burnish_sqrt(squares / (double)n + a * a + b * b);
    return 1;
}

/* gap: 1 where the last point is not next to the first. */
static int is_circle(const burnish_vec3 *points, size_t n, int gap, burnish_vec3 center,
                     burnish_vec3 normal, double radius) {
    for (size_t i = 0; i < n; ++i) {
        const burnish_vec3 p = burnish_vec3_sub(points[i], center);
        const size_t after = i + 1 < n ? i + 1 : gap ? i : 0;
        const burnish_vec3 next = burnish_vec3_sub(points[after], points[i]);
        if (burnish_magnitude(burnish_vec3_dot(p, normal)) > ROUND_SHARE * radius ||
            burnish_magnitude(burnish_vec3_length(p) - radius) > ROUND_SHARE * radius ||
            burnish_vec3_length(next) > CHORD_SHARE * radius) {
            return 0;
        }
    }
    return radius > 0;
}

static void add_circle(finder *f, burnish_vec3 center, burnish_vec3 normal, double radius) {
    burnish_axes *axes = f->axes;
    size_t i = 0;
    for (; i < axes->count; ++i) {
        burnish_axis_line *axis = &axes->items[i];
        const burnish_vec3 away = burnish_vec3_sub(center, axis->origin);
        const double largest = radius > axis->radius ? radius : axis->radius;
        const double at = burnish_vec3_dot(away, axis->direction);
        if (burnish_vec3_length(burnish_vec3_cross(normal, axis->direction)) < SAME_SINE &&
            burnish_vec3_length(burnish_vec3_cross(away, axis->direction)) <
                2 * ROUND_SHARE * largest) {
            axis->radii[0] = at < axis->from ? radius : axis->radii[0];
            axis->radii[1] = at > axis->to ? radius : axis->radii[1];
            axis->from = at < axis->from ? at : axis->from;
            axis->to = at > axis->to ? at : axis->to;
            axis->radius = largest;
            break;
        }
    }
    axes->items = burnish_reserve(f->memory, axes->items, &axes->capacity, i + 1,
                                  sizeof *axes->items, "axes");
    axes->circles = burnish_reserve(f->memory, axes->circles, &axes->circle_capacity,
                                    axes->circle_count + 1, sizeof *axes->circles, "circles");
    if (f->memory->status == BURNISH_STATUS_OK) {
        axes->circles[axes->circle_count++] = (burnish_circle){center, radius, i};
        if (i == axes->count) {
            axes->items[axes->count++] =
                (burnish_axis_line){center, normal, 0, 0, {radius, radius}, radius};
        }
    }
}

/* ---- Arcs ---- */

int burnish_circle_through(const burnish_vec3 p[3], burnish_vec3 *center, double *radius) {
    const burnish_vec3 u = burnish_vec3_sub(p[1], p[0]), v = burnish_vec3_sub(p[2], p[0]);
    const burnish_vec3 w = burnish_vec3_cross(u, v);
    const double uu = burnish_vec3_dot(u, u), vv = burnish_vec3_dot(v, v);
    const double ww = burnish_vec3_dot(w, w);
    if (!(ww > 1e-8 * uu * vv)) {
        return 0;
    }
    const burnish_vec3 to =
        burnish_vec3_scale(burnish_vec3_add(burnish_vec3_scale(burnish_vec3_cross(w, u), vv),
                                            burnish_vec3_scale(burnish_vec3_cross(v, w), uu)),
                           1 / (2 * ww));
    *center = burnish_vec3_add(p[0], to);
    *radius = burnish_vec3_length(to);
    return 1;
}

/* How many triples of points, from the first on, are on one circle. */
static size_t count_triples(const burnish_vec3 *p, size_t n) {
    burnish_vec3 first, center;
    double radius, other;
    size_t count = 0;
    if (n >= 3 && burnish_circle_through(p, &first, &radius)) {
        for (count = 1; count + 3 <= n && burnish_circle_through(p + count, &center, &other) &&
                        burnish_vec3_length(burnish_vec3_sub(center, first)) < SAME_CENTER * radius;
             ++count) {
        }
    }
    return count;
}

static void add_arc(finder *f, const burnish_vec3 *p, size_t n) {
    burnish_axes *axes = f->axes;
    burnish_arc arc = {.middle = p[n / 2]};
    if (!fit_circle(p, n, &arc.center, &arc.normal, &arc.radius) ||
        !is_circle(p, n, 1, arc.center, arc.normal, arc.radius)) {
        return;
    }
    for (size_t i = 0; i + 1 < n; ++i) {
        const double chord = burnish_vec3_length(burnish_vec3_sub(p[i + 1], p[i])) / arc.radius;
        arc.angle += chord * (1 + chord * chord / 24);
    }
    axes->arcs = burnish_reserve(f->memory, axes->arcs, &axes->arc_capacity, axes->arc_count + 1,
                                 sizeof *axes->arcs, "arcs");
    if (f->memory->status == BURNISH_STATUS_OK && arc.angle > LEAST_ANGLE) {
        axes->arcs[axes->arc_count++] = arc;
    }
}

/* A circle, or arcs, of the points at hand. A loop is walked from a corner. */
static void find_shapes(finder *f, int is_loop) {
    const size_t n = f->point_count;
    size_t first = 0, end = n;
    burnish_vec3 center, normal;
    double radius;
    if (is_loop && n >= LEAST_VERTICES && fit_circle(f->points, n, &center, &normal, &radius) &&
        is_circle(f->points, n, 0, center, normal, radius)) {
        add_circle(f, center, normal, radius);
        return;
    }
    for (size_t i = 0; is_loop && f->memory->status == BURNISH_STATUS_OK && i < n + 2; ++i) {
        push_point(f, f->points[i]);
    }
    if (f->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    if (is_loop) {
        while (first < n && count_triples(f->points + first, 4) == 2) {
            ++first;
        }
        ++first;
        end = first < n ? first + n + 1 : 0;
    }
    for (size_t count; first + 3 <= end && f->axes->arc_count <= CIRCLES_MAX;
         first += count > 1 ? count : 1) {
        count = count_triples(f->points + first, end - first);
        if (count >= LEAST_TRIPLES) {
            add_arc(f, f->points + first, count + 2);
        }
    }
}

/* Open chains from their ends, then loops. */
static void find_axes(finder *f) {
    burnish_axes *axes = f->axes;
    for (int is_loop = 0; is_loop < 2; ++is_loop) {
        for (size_t i = 0; i < 2 * f->edges->count && f->memory->status == BURNISH_STATUS_OK &&
                           axes->count <= AXES_MAX && axes->circle_count <= CIRCLES_MAX;
             ++i) {
            const burnish_edge *edge = &f->edges->items[i / 2];
            if (is_sharp(edge) && !f->is_walked[i / 2] &&
                (is_loop || f->at[2 * (size_t)edge->ends[i % 2] + 1] >= CROWDED)) {
                find_shapes(f, walk(f, (uint32_t)(i / 2), i % 2));
            }
        }
    }
    if (axes->count > AXES_MAX || axes->circle_count > CIRCLES_MAX ||
        axes->arc_count > CIRCLES_MAX) {
        axes->count = axes->circle_count = axes->arc_count = 0;
        axes->are_too_many = 1;
    }
    for (size_t i = 0; i < axes->count; ++i) {
        burnish_axis_line *axis = &axes->items[i];
        axis->radius = axis->to - axis->from > LEAST_SPAN * axis->radius ? axis->radius : 0;
    }
}

void burnish_axes_find(const burnish_mesh_view *mesh, const burnish_edges *edges,
                       burnish_memory *memory, burnish_axes *axes) {
    finder f = {.mesh = mesh, .edges = edges, .memory = memory, .axes = axes};
    axes->count = axes->circle_count = axes->arc_count = 0;
    f.at = burnish_allocate(memory, mesh->vertex_count, 2 * sizeof *f.at, "circles");
    f.is_walked = burnish_allocate_zeroed(memory, edges->count, 1, "circles");
    if (memory->status == BURNISH_STATUS_OK) {
        memset(f.at, 0xff, mesh->vertex_count * 2 * sizeof *f.at);
        for (uint32_t i = 0; i < edges->count; ++i) {
            if (is_sharp(&edges->items[i])) {
                note_edge(&f, i, edges->items[i].ends[0]);
                note_edge(&f, i, edges->items[i].ends[1]);
            }
        }
        find_axes(&f);
    }
    burnish_release(memory->context, f.at);
    burnish_release(memory->context, f.is_walked);
    burnish_release(memory->context, f.points);
}
