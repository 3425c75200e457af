/* Lines in the scene: the edges of the bounding box and the ground's grid, hidden by what is in
 * front of them. */
#include "annotate/annotate.h"

/* Of the box's diagonal: a line in a surface counts as in front of it. */
#define DEPTH_BIAS 0.003

/* Lengths in heights of a capital. */
#define DASH 0.55
#define DASH_GAP 0.45
#define TICK 0.35

/* Spacings along the ground's longer side. */
#define SPACINGS 16

/* A plane seen at less than this sine is a line. */
#define EDGE_ON 0.02

/* Spacings from the origin; beyond it lines could not be told apart. */
#define FARTHEST 1e12

/* A line that is being projected to the screen. */
typedef struct scene_line {
    burnish_point a, b;
    double near_a, near_b; /* distances; in perspective their inverses, which are linear */
} scene_line;

/* Clips the line at the plane of the camera. Returns 0 if all of it is behind. */
static int project_line(const burnish_annotation_view *view, burnish_vec3 a, burnish_vec3 b,
                        scene_line *line) {
    double da, db;
    const double least = 1e-3 * view->diagonal;
    line->a = burnish_annotation_project(view, a, &da);
    line->b = burnish_annotation_project(view, b, &db);
    if (view->parallel) {
        line->near_a = da;
        line->near_b = db;
        return 1;
    }
    if (da < least && db < least) {
        return 0;
    }
    if (da < least || db < least) {
        const double t = (least - da) / (db - da);
        const burnish_vec3 middle =
            burnish_vec3_add(a, burnish_vec3_scale(burnish_vec3_sub(b, a), t));
        double *distance = da < least ? &da : &db;
        *(da < least ? &line->a : &line->b) = burnish_annotation_project(view, middle, distance);
        *distance = least;
    }
    line->near_a = 1 / da;
    line->near_b = 1 / db;
    return 1;
}

static burnish_point point_at(const scene_line *line, double t) {
    return (burnish_point){line->a.x + (line->b.x - line->a.x) * t,
                           line->a.y + (line->b.y - line->a.y) * t};
}

/* Clips to the image and a small margin. */
static int clip_to_image(const burnish_annotation_view *view, scene_line *line) {
    double from = 0, to = 1;
    const scene_line whole = *line;
    if (!burnish_cut_to_range(line->a.x, line->b.x - line->a.x, -8, view->width + 8, &from, &to) ||
        !burnish_cut_to_range(line->a.y, line->b.y - line->a.y, -8, view->height + 8, &from, &to) ||
        from == to) {
        return 0;
    }
    line->a = point_at(&whole, from);
    line->b = point_at(&whole, to);
    line->near_a = whole.near_a + (whole.near_b - whole.near_a) * from;
    line->near_b = whole.near_a + (whole.near_b - whole.near_a) * to;
    return 1;
}

int burnish_annotation_is_seen(const burnish_annotation_view *view, burnish_point p,
                               double distance) {
    const int width = (int)view->width, height = (int)view->height;
    const double bias = DEPTH_BIAS * view->diagonal;
    if (!view->depth || !(p.x >= 0 && p.y >= 0 && p.x < view->width && p.y < view->height)) {
        return 1;
    }
    for (int i = 0; i < 9; ++i) {
        const int x = (int)p.x + i % 3 - 1, y = (int)p.y + i / 3 - 1;
        if (x < 0 || y < 0 || x >= width || y >= height) {
            continue;
        }
        const float *row =
            (const float *)((const char *)view->depth + (size_t)y * view->depth_stride);
        if (distance <= (double)row[x] * (1 + 1e-5) + bias) {
            return 1;
        }
    }
    return 0;
}

/* The dashes of [from, to], pixels along the line from its start. */
static void add_dashes(const burnish_annotation_view *view, const scene_line *line, double length,
                       double from, double to, burnish_annotation_list *list) {
    const double dash = DASH * view->text, period = dash + DASH_GAP * view->text;
    for (double i = (double)(int64_t)(from / period); i * period < to; i += 1) {
        const double start = i * period > from ? i * period : from;
        const double end = i * period + dash < to ? i * period + dash : to;
        if (start < end) {
            burnish_annotation_add_line(list, point_at(line, start / length),
                                        point_at(line, end / length), view->line,
                                        BURNISH_LAYER_HIDDEN);
        }
    }
}

/* Draws the visible part of a line in its layer. Hidden parts are dashed, in the grid omitted. */
static void add_scene_line(const burnish_annotation_view *view, burnish_vec3 from, burnish_vec3 to,
                           burnish_annotation_layer layer, burnish_annotation_list *list) {
    scene_line line;
    if (!project_line(view, from, to, &line) || !clip_to_image(view, &line)) {
        return;
    }
    const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y;
    const double length = burnish_sqrt(dx * dx + dy * dy);
    if (!(length < 1e6)) {
        return; /* coordinates beyond the range of screen coordinates */
    }
    const int steps = (int)length + 1;
    int run = 0, seen = 0;
    for (int i = 0; i <= steps; ++i) {
        int now = -1; /* past the end */
        if (i < steps) {
            const double t = (i + 0.5) / steps;
            const double near = line.near_a + (line.near_b - line.near_a) * t;
            now = burnish_annotation_is_seen(view, point_at(&line, t),
                                             view->parallel ? near : 1 / near);
        }
        if (i > 0 && now != seen) {
            const double start = (double)run / steps, end = (double)i / steps;
            if (seen) {
                burnish_annotation_add_line(list, point_at(&line, start), point_at(&line, end),
                                            view->line, layer);
            } else if (layer != BURNISH_LAYER_GRID) {
                add_dashes(view, &line, length, start * length, end * length, list);
            }
            run = i;
        }
        seen = now;
    }
}

void burnish_annotate_box(const burnish_annotation_view *view, burnish_annotation_list *list) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 8; ++i) {
            if (!(i >> axis & 1)) {
                add_scene_line(view, burnish_annotation_corner(view, i),
                               burnish_annotation_corner(view, i | 1 << axis), BURNISH_LAYER_BOX,
                               list);
            }
        }
    }
}

/* ---- The ground's grid ---- */

/* floor and ceil, in the range in which a double holds every integer. */
static double round_down(double value) {
    const double whole = (double)(int64_t)value;
    return whole > value ? whole - 1 : whole;
}

burnish_annotation_grid burnish_annotation_grid_of(const burnish_annotation_view *view) {
    burnish_annotation_grid grid = {.axis = {(view->up_axis + 1) % 3, (view->up_axis + 2) % 3}};
    double longer = 0;
    for (int k = 0; k < 2; ++k) {
        const double extent =
            burnish_axis(view->high, grid.axis[k]) - burnish_axis(view->low, grid.axis[k]);
        longer = extent > longer ? extent : longer;
    }
    longer = longer > 0 ? longer : view->diagonal;
    grid.spacing = burnish_round_number_above(longer / SPACINGS);
    for (int k = 0; k < 2; ++k) {
        const double origin = view->origin[grid.axis[k]], spacing = grid.spacing.value;
        const double cells = origin / spacing;
        grid.offset[k] = cells > -1e15 && cells < 1e15 ? spacing * round_down(cells) - origin : 0;
        const double low = (burnish_axis(view->low, grid.axis[k]) - grid.offset[k]) / spacing;
        const double high = (burnish_axis(view->high, grid.axis[k]) - grid.offset[k]) / spacing;
        if (!(low > -FARTHEST && high < FARTHEST)) {
            return grid;
        }
        /* very close to a line, the line is enough */
        grid.first[k] = round_down(low + 1e-6);
        grid.last[k] = -round_down(-(high - 1e-6));
        if (grid.last[k] <= grid.first[k]) {
            grid.last[k] = grid.first[k] + 1;
        }
    }
    grid.is_there = 1;
    return grid;
}

static burnish_vec3 grid_point(const burnish_annotation_view *view,
                               const burnish_annotation_grid *grid, double u, double v) {
    double p[3];
    p[grid->axis[0]] = u * grid->spacing.value + grid->offset[0];
    p[grid->axis[1]] = v * grid->spacing.value + grid->offset[1];
    p[view->up_axis] = burnish_axis(view->up_negative ? view->high : view->low, view->up_axis);
    return burnish_vec3_load(p);
}

/* The ground seen from its edge: one line with a tick at every spacing of the axis that it shows.
 */
static void add_ground_line(const burnish_annotation_view *view,
                            const burnish_annotation_grid *grid, burnish_annotation_list *list) {
    const double first = burnish_axis(view->right, grid->axis[0]);
    const double second = burnish_axis(view->right, grid->axis[1]);
    const int k = first * first >= second * second ? 0 : 1;
    burnish_point before = {0, 0};
    for (double i = grid->first[k]; i <= grid->last[k]; i += 1) {
        double distance;
        const burnish_vec3 ground = k == 0 ? grid_point(view, grid, i, grid->first[1])
                                           : grid_point(view, grid, grid->first[0], i);
        const burnish_point p = burnish_annotation_project(view, ground, &distance);
        if (!view->parallel && distance < 1e-3 * view->diagonal) {
            return;
        }
        burnish_annotation_add_line(list, p, (burnish_point){p.x, p.y + TICK * view->text},
                                    view->line, BURNISH_LAYER_GRID);
        if (i > grid->first[k]) {
            burnish_annotation_add_line(list, before, p, view->line, BURNISH_LAYER_GRID);
        }
        before = p;
    }
}

void burnish_annotate_grid(const burnish_annotation_view *view, burnish_annotation_list *list) {
    const burnish_annotation_grid grid = burnish_annotation_grid_of(view);
    const double sine = burnish_axis(view->forward, view->up_axis);
    if (!grid.is_there) {
        return;
    }
    if (sine < EDGE_ON && sine > -EDGE_ON) {
        add_ground_line(view, &grid, list);
        return;
    }
    for (double u = grid.first[0]; u <= grid.last[0]; u += 1) {
        add_scene_line(view, grid_point(view, &grid, u, grid.first[1]),
                       grid_point(view, &grid, u, grid.last[1]), BURNISH_LAYER_GRID, list);
    }
    for (double v = grid.first[1]; v <= grid.last[1]; v += 1) {
        add_scene_line(view, grid_point(view, &grid, grid.first[0], v),
                       grid_point(view, &grid, grid.last[0], v), BURNISH_LAYER_GRID, list);
    }
}
