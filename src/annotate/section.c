/* The plane of a section: where it is edge on, a chain line across the object with wide ends, and
 * arrows in the direction of the section's view with its letter (ISO 128-3); where it is face on, the
 * section's name. */
#include "annotate/annotate.h"

/* Of the height of a capital. */
#define CLEAR 0.3  /* between the object's box and the wide ends */
#define END 0.8    /* length of these */
#define SHAFT 1.9  /* of an arrow, with its head, ... */
#define LONGER 1.2 /* ... and how much longer each attempt is */
#define BESIDE 0.8 /* from its tail to the middle of the letter */
#define ABOVE 1.3  /* from the box to the middle of the name */
#define DASH 1.6
#define GAP 0.35

#define EDGE_ON 1e-3 /* how far from 1 a cosine can be */
#define FARTHEST 1e5 /* pixels that a chain line is long */

/* The chain line, below other lines and without a rim, so edges of the object stay. */
static void add_chain(const burnish_annotation_view *view, burnish_point from, burnish_point along,
                      double length, burnish_annotation_list *list) {
    const double dash = DASH * view->text, gap = GAP * view->text;
    for (double at = 0; at < length; at += dash + 2 * gap) {
        const double end = at + dash < length ? at + dash : length;
        const burnish_point dot = burnish_moved_along(from, along, end + gap);
        burnish_annotation_add_line(list, burnish_moved_along(from, along, at),
                                    burnish_moved_along(from, along, end), view->line,
                                    BURNISH_LAYER_BOX);
        if (end + gap < length) {
            burnish_annotation_add_line(list, dot, dot, view->line, BURNISH_LAYER_BOX);
        }
    }
}

/* From the end of the plane's line next to the box, which `out` leads away from; d: to the viewer. */
static void add_end(const burnish_annotation_view *view, burnish_point at, burnish_point out,
                    burnish_point d, double shaft, burnish_annotation_list *list) {
    const double text = view->text;
    const burnish_point from = burnish_moved_along(at, out, CLEAR * text);
    const burnish_point tip = burnish_moved_along(from, out, END * text / 2);
    const burnish_point tail = burnish_moved_along(tip, d, shaft * text);
    burnish_annotation_add_line(list, from, burnish_moved_along(from, out, END * text),
                                2 * view->line, BURNISH_LAYER_LINES);
    burnish_annotation_add_line(list, burnish_moved_along(tip, d, BURNISH_ARROW_LENGTH * text),
                                tail, view->line, BURNISH_LAYER_LINES);
    burnish_annotation_add_arrow(view, tip, d, list);
    const burnish_annotation_label label = burnish_annotation_label_at(
        view, "A", burnish_moved_along(tail, d, BESIDE * text), BURNISH_LAYER_LINES);
    burnish_annotation_add_label(list, &label);
}

static double dot(burnish_point a, burnish_point b) {
    return a.x * b.x + a.y * b.y;
}

void burnish_annotate_section(const burnish_annotation_view *view, int attempt,
                              burnish_annotation_list *list) {
    const double shaft = SHAFT + LONGER * attempt;
    const burnish_vec3 normal = burnish_vec3_load(view->section.normal);
    const burnish_vec3 middle = burnish_vec3_scale(burnish_vec3_add(view->low, view->high), 0.5);
    const burnish_point d = {burnish_vec3_dot(normal, view->right),
                             -burnish_vec3_dot(normal, view->up)};
    const burnish_point along = {-d.y, d.x};
    double depth, low = 0, high = 0;
    const burnish_point on = burnish_annotation_project(
        view,
        burnish_vec3_add(middle, burnish_vec3_scale(normal, view->section.offset -
                                                                burnish_vec3_dot(normal, middle))),
        &depth);
    for (int i = 0; i < 8; ++i) {
        const burnish_point away = {view->corners[i].x - on.x, view->corners[i].y - on.y};
        low = dot(away, along) < low ? dot(away, along) : low;
        high = dot(away, along) > high ? dot(away, along) : high;
    }
    if (view->parallel && dot(d, d) > 1 - EDGE_ON && high - low < FARTHEST) {
        const burnish_point ends[2] = {burnish_moved_along(on, along, low),
                                       burnish_moved_along(on, along, high)};
        add_end(view, ends[0], (burnish_point){-along.x, -along.y}, d, shaft, list);
        add_end(view, ends[1], along, d, shaft, list);
        add_chain(view, burnish_moved_along(ends[0], along, -CLEAR * view->text), along,
                  high - low + 2 * CLEAR * view->text, list);
    } else if (view->parallel && burnish_vec3_dot(normal, view->forward) < EDGE_ON - 1) {
        const burnish_annotation_label label = burnish_annotation_label_at(
            view, "A-A", (burnish_point){on.x, view->box.top - ABOVE * view->text},
            BURNISH_LAYER_LINES);
        burnish_annotation_add_label(list, &label);
    }
}
