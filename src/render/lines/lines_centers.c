/* Centre lines: long dashes and dots (ISO 128-2, line 04). */
#include "render/lines/lines_steps.h"

/* In widths of the line, whose ends are round: dashes are one longer, gaps one shorter. */
#define DASH 23.0
#define SHORT_DASH 7.0 /* in lines that are too short for three long ones */
#define GAP 4.0
#define OVERHANG 12.0 /* beyond what the line belongs to */
#define DOT 0.05      /* pixels */

#define END_ON_SINE 0.02 /* between an axis and the view: a cross */
#define INWARD 1.5
#define LEAST_RADIUS 2.0 /* pixels: smaller circles have no centre lines */

enum { SAMPLES = 24, SEEN = 4 };

typedef struct drawer {
    burnish_line_art *art;
    const burnish_line_scene *scene;
    const burnish_line_projection *projection;
    burnish_memory *memory;
} drawer;

/* The position on the screen; returns 0 behind the camera. */
static int project_position(const drawer *d, burnish_vec3 position, double at[2],
                            double *distance) {
    const burnish_clip_point c = burnish_line_project(d->projection, position);
    if (!(c.w > 0)) {
        return 0;
    }
    const double key = burnish_line_key(d->projection, c);
    at[0] = d->projection->middle[0] + c.x / c.w;
    at[1] = d->projection->middle[1] - c.y / c.w;
    *distance = d->projection->is_parallel ? key : key > 0 ? 1 / key : 0;
    return 1;
}

static burnish_vec3 point_along(const burnish_axis_line *axis, double t) {
    return burnish_vec3_add(axis->origin, burnish_vec3_scale(axis->direction, t));
}

/* Two unit vectors across an axis. */
static void frame_of(const burnish_axis_line *axis, burnish_vec3 *u, burnish_vec3 *v) {
    const burnish_vec3 d = axis->direction;
    const burnish_vec3 other = d.x * d.x < 0.5 ? (burnish_vec3){1, 0, 0} : (burnish_vec3){0, 1, 0};
    *u = burnish_vec3_normalize(burnish_vec3_cross(d, other));
    *v = burnish_vec3_cross(d, *u);
}

/* Whether the first or the last circle is seen at a few of its points, which are moved inward by
 * INWARD pixels: the wall of a cylinder is seen there, not what is beyond its edge. */
static int is_seen(const drawer *d, const burnish_axis_line *axis, double pixel) {
    static const double cosine = 0.96592582628906828675, sine = 0.25881904510252076235; /* 15 deg */
    burnish_vec3 u, v;
    frame_of(axis, &u, &v);
    for (int end = 0; end < 2; ++end) {
        const double inward = INWARD * pixel;
        const burnish_vec3 center =
            point_along(axis, end ? axis->to - inward : axis->from + inward);
        double x = axis->radii[end], y = 0;
        int seen = 0;
        for (int i = 0; i < SAMPLES; ++i) {
            double at[2], distance;
            const burnish_vec3 p = burnish_vec3_add(
                center, burnish_vec3_add(burnish_vec3_scale(u, x), burnish_vec3_scale(v, y)));
            seen += project_position(d, p, at, &distance) &&
                    burnish_line_scene_shows(d->scene, at[0], at[1], distance);
            const double turned = cosine * x - sine * y;
            y = sine * x + cosine * y;
            x = turned;
        }
        if (seen >= SEEN) {
            return 1;
        }
    }
    return 0;
}

/* Begins and ends with a dash; the pattern is scaled to the length. */
static void add_chain(const drawer *d, const double from[2], const double to[2]) {
    const double x = to[0] - from[0], y = to[1] - from[1], length = burnish_sqrt(x * x + y * y);
    const double width = BURNISH_LINE_NARROW * d->scene->outline, gap = GAP * width;
    const double dash = (length < 3 * (DASH + 2 * GAP) * width ? SHORT_DASH : DASH) * width;
    const int count = (int)((length + 2 * gap) / (dash + 2 * gap) + 0.5);
    const int steps = count > 2 ? count - 1 : 1;
    const double scale = length / (steps * (dash + 2 * gap) + dash) / length;
    for (int i = 0; i <= steps && length > 0; ++i) {
        const double start = i * (dash + 2 * gap) * scale, end = start + dash * scale;
        const double dot = end + gap * scale;
        const double marks[2][2] = {{start, end}, {dot, dot + DOT / length}};
        for (int k = 0; k < (i < steps ? 2 : 1); ++k) {
            const double a[2] = {from[0] + marks[k][0] * x, from[1] + marks[k][0] * y};
            const double b[2] = {from[0] + marks[k][1] * x, from[1] + marks[k][1] * y};
            burnish_line_art_add(d->art, a, b, width, d->memory);
        }
    }
}

/* Both lines of a cross, or the line along the axis. */
static void add_axis(const drawer *d, const burnish_axis_line *axis, int with_hidden) {
    const burnish_vec3 middle = point_along(axis, (axis->from + axis->to) / 2);
    const burnish_vec3 toward =
        d->projection->is_parallel
            ? d->projection->viewer
            : burnish_vec3_normalize(burnish_vec3_sub(d->projection->viewer, middle));
    double at[2][2], distance[2], center[2], depth;
    if (!project_position(d, point_along(axis, axis->from), at[0], &distance[0]) ||
        !project_position(d, point_along(axis, axis->to), at[1], &distance[1]) ||
        !project_position(d, middle, center, &depth)) {
        return;
    }
    const double pixel = d->scene->is_parallel ? d->scene->footprint : d->scene->footprint * depth;
    const double radius = axis->radius / pixel,
                 over = OVERHANG * BURNISH_LINE_NARROW * d->scene->outline;
    if (!(radius >= LEAST_RADIUS && radius < 1e5) || (!with_hidden && !is_seen(d, axis, pixel))) {
        return;
    }
    if (burnish_vec3_length(burnish_vec3_cross(axis->direction, toward)) < END_ON_SINE) {
        for (int k = 0; k < 2; ++k) {
            double from[2] = {center[0], center[1]}, to[2] = {center[0], center[1]};
            from[k] -= radius + over;
            to[k] += radius + over;
            add_chain(d, from, to);
        }
        return;
    }
    const double x = at[1][0] - at[0][0], y = at[1][1] - at[0][1];
    const double length = burnish_sqrt(x * x + y * y);
    if (length >= 1 && length < 1e5) {
        const double share = over / length;
        const double from[2] = {at[0][0] - share * x, at[0][1] - share * y};
        const double to[2] = {at[1][0] + share * x, at[1][1] + share * y};
        add_chain(d, from, to);
    }
}

void burnish_line_art_add_centers(burnish_line_art *art, const burnish_mesh_view *mesh,
                                  const burnish_line_scene *scene,
                                  const burnish_line_projection *projection,
                                  const burnish_render_options *options, burnish_memory *memory) {
    const drawer d = {art, scene, projection, memory};
    if (art->axes_mesh != mesh->serial) {
        burnish_axes_find(mesh, &art->edges, memory, &art->axes);
        art->axes_mesh = memory->status == BURNISH_STATUS_OK ? mesh->serial : 0;
    }
    for (size_t i = 0; i < art->axes.count && memory->status == BURNISH_STATUS_OK; ++i) {
        add_axis(&d, &art->axes.items[i], (options->edges & BURNISH_EDGES_HIDDEN) != 0);
    }
}
