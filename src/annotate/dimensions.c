/* Dimensions: the lengths of the bounding box, as in technical drawings, and of a round object its
 * diameter. A dimension line is parallel to an edge on the outline of the box on the screen, outside
 * the box. Extension lines lead there from the ends of the edge. The number is upright, in a gap of
 * the line or next to a line that is too short. */
#include "annotate/annotate.h"
#include "image/text/text.h"

/* Of the height of a capital. */
#define LEAST_OFFSET 1.7    /* from the edge to the dimension line */
#define CLEAR 0.55          /* white around a number */
#define EXTENSION_GAP 0.35  /* white between the edge and an extension line */
#define EXTENSION_OVER 0.45 /* of an extension line beyond the dimension line */
#define TIER 1.8            /* distance between attempts, outwards */

/* An axis seen at less than this sine of its angle to the view is not measured. */
#define LEAST_SINE 0.12

enum { TIERS = 3, PLACES = 4 };

/* An edge on the outline of the box on the screen. */
typedef struct edge {
    burnish_point p, q;   /* its ends */
    burnish_point d;      /* from p to q, unit length */
    burnish_point n;      /* away from the box, unit length */
    double length, value; /* pixels; units */
    int is_diameter;
    double preference;
} edge;

/* 1 if all corners are on one side of the line through corners i and j. */
static int make_edge(const burnish_annotation_view *view, int i, int j, edge *made) {
    const burnish_point p = view->corners[i], q = view->corners[j];
    const double dx = q.x - p.x, dy = q.y - p.y, length = burnish_sqrt(dx * dx + dy * dy);
    double least = 0, most = 0;
    if (!(length >= 1 && length < 1e9)) {
        return 0;
    }
    made->d = (burnish_point){dx / length, dy / length};
    made->n = (burnish_point){made->d.y, -made->d.x};
    for (int k = 0; k < 8; ++k) {
        const double side =
            (view->corners[k].x - p.x) * made->n.x + (view->corners[k].y - p.y) * made->n.y;
        least = side < least ? side : least;
        most = side > most ? side : most;
    }
    if (most > 0.01 && least < -0.01) {
        return 0;
    }
    if (most > 0.01) {
        made->n = (burnish_point){-made->n.x, -made->n.y};
    } else if (least > -0.01 && made->n.y < burnish_magnitude(made->n.x) * 0.5) {
        made->n = (burnish_point){-made->n.x, -made->n.y}; /* a line: below it, or to the right */
    }
    made->p = p;
    made->q = q;
    made->is_diameter = 0;
    made->length = length;
    made->preference = made->n.y + 0.45 * made->n.x; /* below rather than above, right than left */
    return 1;
}

static double extent_along(burnish_point d, double width, double height) {
    const double x = burnish_magnitude(d.x), y = burnish_magnitude(d.y);
    return x * height < y * width ? height / y : width / x; /* through its middle */
}

static void push_line(burnish_annotation_list *made, burnish_point a, burnish_point b,
                      double width) {
    burnish_annotation_add_line(made, a, b, width, BURNISH_LAYER_LINES);
}

/* A dimension next to its edge. place 0: the number in or next to the middle, 1 and 2: beyond an
 * end, 3: next to the middle. */
static void make_dimension(const burnish_annotation_view *view, const edge *e, int tier, int place,
                           burnish_annotation_list *made) {
    const double text = view->text, arrow = BURNISH_ARROW_LENGTH * text, clear = CLEAR * text;
    char number[BURNISH_LABEL_SIZE] = BURNISH_DIAMETER;
    burnish_number_text(e->value, number + (e->is_diameter ? sizeof BURNISH_DIAMETER - 1 : 0));
    made->labels[0] = burnish_annotation_label_at(view, number, e->p, BURNISH_LAYER_LINES);
    const double width = made->labels[0].area.right - made->labels[0].area.left;
    const double gap = extent_along(e->d, width + clear, text + clear);
    const double reach = (burnish_magnitude(e->d.x) * width + burnish_magnitude(e->d.y) * text) / 2;
    const double depth = (burnish_magnitude(e->n.x) * width + burnish_magnitude(e->n.y) * text) / 2;
    const double least = LEAST_OFFSET * text, wide = depth + CLEAR * text * 1.2;
    const double offset = (wide > least && place == 0 ? wide : least) + tier * TIER * text;
    const burnish_point p = burnish_moved_along(e->p, e->n, offset),
                        q = burnish_moved_along(e->q, e->n, offset);
    const burnish_point middle = {(p.x + q.x) / 2, (p.y + q.y) / 2};
    const int inside = e->length > 3.2 * arrow; /* arrows */
    const int in_line = place == 0 && e->length > gap + 2 * arrow + clear;
    made->line_count = 0;
    made->label_count = 1;
    for (int end = 0; end < 2; ++end) {
        const burnish_point corner = end ? e->q : e->p, tip = end ? q : p;
        const double way = (end ? -1 : 1) * (inside ? 1 : -1);
        const burnish_point d = {e->d.x * way, e->d.y * way};
        push_line(made, burnish_moved_along(corner, e->n, EXTENSION_GAP * text),
                  burnish_moved_along(corner, e->n, offset + EXTENSION_OVER * text), view->line);
        burnish_annotation_add_arrow(view, tip, d, made);
        if (!inside) {
            push_line(made, tip, burnish_moved_along(tip, d, 2 * arrow), view->line);
        }
    }
    made->labels[0] = burnish_annotation_label_at(view, number, middle, BURNISH_LAYER_LINES);
    if (in_line) {
        push_line(made, p, burnish_moved_along(middle, e->d, -gap / 2), view->line);
        push_line(made, burnish_moved_along(middle, e->d, gap / 2), q, view->line);
        return;
    }
    push_line(made, p, q, view->line);
    const double beyond = e->length / 2 + (inside ? 0 : 2 * arrow) + clear + reach;
    const burnish_point center = place == 1   ? burnish_moved_along(middle, e->d, beyond)
                                 : place == 2 ? burnish_moved_along(middle, e->d, -beyond)
                                              : burnish_moved_along(middle, e->n, depth + clear);
    made->labels[0] = burnish_annotation_label_at(view, number, center, BURNISH_LAYER_LINES);
}

int burnish_annotation_is_within(const burnish_annotation_view *view, const burnish_area *area) {
    return area->left >= 1 && area->top >= 1 && area->right <= view->width - 1 &&
           area->bottom <= view->height - 1;
}

static int has_room(const burnish_annotation_view *view, const burnish_annotation_list *list,
                    const burnish_annotation_list *made) {
    const burnish_area *number = &made->labels[0].area;
    const burnish_area label = burnish_area_grown(*number, CLEAR * view->text / 2);
    const burnish_area all = burnish_annotation_bounds(made, *number, 0);
    if (burnish_annotation_hits_hull(view, &label) || !burnish_annotation_is_free(list, &label) ||
        (list->bounded && !burnish_annotation_is_within(view, &all))) {
        return 0;
    }
    for (size_t i = 0; i < made->line_count; ++i) {
        const burnish_stroke *s = &made->lines[i].stroke;
        const burnish_point a = {(double)s->x0, (double)s->y0}, b = {(double)s->x1, (double)s->y1};
        if (burnish_segment_hits(a, b, number) ||
            burnish_annotation_hits_label(list, a, b, view->line)) {
            return 0;
        }
    }
    return 1;
}

/* Of the ways to draw the dimension next to an edge, the first with enough room. */
static int place_dimension(const burnish_annotation_view *view, const edge *e,
                           burnish_annotation_list *made, burnish_annotation_list *list) {
    for (int tier = 0; tier < TIERS; ++tier) {
        for (int at = 0; at < PLACES; ++at) {
            make_dimension(view, e, tier, at, made);
            if (has_room(view, list, made)) {
                burnish_annotation_take(list, made, (burnish_point){0, 0});
                return 1;
            }
        }
    }
    return 0;
}

/* The edges along an axis that a dimension can be next to, the best first. */
static int list_edges(const burnish_annotation_view *view, int axis, edge edges[4]) {
    int count = 0;
    for (int i = 0; i < 8; ++i) {
        edge made;
        if ((i >> axis & 1) || !make_edge(view, i, i | 1 << axis, &made)) {
            continue;
        }
        made.value = burnish_axis(view->high, axis) - burnish_axis(view->low, axis);
        int at = count++;
        for (; at > 0 && edges[at - 1].preference < made.preference - 1e-9; --at) {
            edges[at] = edges[at - 1];
        }
        edges[at] = made;
    }
    return count;
}

static int is_measured(const burnish_annotation_view *view, int axis) {
    const double x = burnish_axis(view->right, axis), y = burnish_axis(view->up, axis);
    return (view->lengths >> axis & 1) && x * x + y * y > LEAST_SINE * LEAST_SINE &&
           burnish_axis(view->high, axis) > burnish_axis(view->low, axis);
}

/* The axis of an object that is round about just one, with its diameter; -1: there is none. */
static int find_round(const burnish_annotation_view *view, double *diameter) {
    int found = -1, count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double measured = burnish_annotation_diameter(view, axis);
        count += measured > 0;
        found = measured > 0 ? axis : found;
        *diameter = measured > 0 ? measured : *diameter;
    }
    return count == 1 ? found : -1;
}

/* Whether another length states the diameter, too: one in this view, the longer or the first, or, if
 * this view has one length, in the view next to it. */
static int is_repeated(const burnish_annotation_view *view, int axis, int round) {
    const int other = 3 - axis - round;
    const burnish_vec3 size = burnish_vec3_sub(view->high, view->low);
    const double longer = burnish_axis(size, other) - burnish_axis(size, axis);
    return (view->lengths & (view->lengths - 1)) == 0 ||
           (is_measured(view, other) && (longer > 0 || (longer == 0 && other < axis)));
}

/* Longest edges first: they need their middle. */
void burnish_annotate_dimensions(const burnish_annotation_view *view,
                                 burnish_annotation_list *list) {
    edge edges[3][4];
    burnish_annotation_label label;
    burnish_annotation_list made = {.labels = &label, .memory = list->memory}; /* it is tried */
    int counts[3] = {0}, order[3];
    double lengths[3] = {0};
    double diameter = 0;
    const int round = find_round(view, &diameter);
    for (int axis = 0; axis < 3; ++axis) {
        const int is_round = round >= 0 && axis != round;
        if (is_measured(view, axis) && !(is_round && is_repeated(view, axis, round))) {
            counts[axis] = view->corners_seen ? list_edges(view, axis, edges[axis]) : 0;
            for (int k = 0; k < counts[axis] && is_round; ++k) {
                edges[axis][k].value = diameter;
                edges[axis][k].is_diameter = 1;
            }
            lengths[axis] = counts[axis] > 0 ? edges[axis][0].length : 0;
            list->left_out += counts[axis] == 0;
        }
    }
    burnish_order_axes(lengths, order);
    for (int i = 0; i < 3; ++i) {
        const int axis = order[i];
        int placed = counts[axis] == 0;
        for (int k = 0; k < counts[axis] && !placed; ++k) {
            placed = place_dimension(view, &edges[axis][k], &made, list);
        }
        list->left_out += !placed;
    }
    burnish_release(list->memory->context, made.lines);
}
