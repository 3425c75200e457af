/* Diameters and radii of the circles and arcs that a view sees end on, one for
 * equal ones, and the positions of centres: running dimensions from one origin
 * (ISO 129-1), above the object and on its left. */
#include <stdio.h>
#include <string.h>

#include "annotate/annotate.h"
#include "image/text/text.h"
#include "mesh/axes.h"

/* In heights of a capital. */
#define OFFSET 1.2 /* from the object's box to the line of positions, ... */
#define MARK 0.5   /* ... and more where a section's arrows are */
#define OVER 0.3   /* of an extension line beyond it, and from there to its number */
#define CLEAR 0.3  /* around labels */
#define JOG 0.7    /* of extension lines, across it, to numbers that are moved apart */
#define ORIGIN 0.4
#define SHORTEST 1.1 /* leader */
#define STEP 1.3     /* between the lengths of a leader that are tried */

#define END_ON_SINE 1e-3
#define EDGE_ON_SINE 0.1
#define LEAST_RADIUS 2.0 /* pixels */
#define SAME 0.05        /* pixels between positions that are one */
#define HALF_TURN 3.2    /* radians: longer arcs have a diameter; ... */
#define LEAST_TURN 3.0   /* ... shorter ones are fillets, whose centres have no position */
#define DIAGONAL 0.70710678118654752440
#define STEEP_X 0.5
#define STEEP_Y 0.86602540378443864676

/* Bounds of time: labels in all, those tried next to circles, edges that each keeps clear of. */
enum { LABELS_MAX = 56, LEADERS = 64, MEMBERS = 8, DIAMETERS_MAX = 32, OUTLINES_MAX = 1 << 16 };

typedef struct hole {
    burnish_point at;
    double radius;                 /* pixels */
    double largest;                /* of the circles around the same centre */
    double angle;                  /* 7 if it is closed, else the sum of its arcs, radians */
    burnish_point toward;          /* a point of the first arc */
    char text[BURNISH_LABEL_SIZE]; /* its diameter */
    int is_done;
} hole;

typedef struct finder {
    const burnish_annotation_view *view;
    burnish_annotation_list *list;
    burnish_annotation_list outlines; /* edges of the object, which labels keep clear of */
    hole *holes;
    size_t count, capacity;
    int diameters; /* that were tried */
} finder;

static double distance_between(burnish_point a, burnish_point b) {
    return burnish_sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/* Whether two of a circle's outermost points are seen. */
static int is_circle_seen(const finder *f, const burnish_circle *circle) {
    int seen = 0;
    for (int i = 0; i < 4; ++i) {
        const burnish_vec3 away = burnish_vec3_scale(i & 1 ? f->view->right : f->view->up,
                                                     i & 2 ? circle->radius : -circle->radius);
        double distance;
        const burnish_point p =
            burnish_annotation_project(f->view, burnish_vec3_add(circle->center, away), &distance);
        seen += burnish_annotation_is_seen(f->view, p, distance);
    }
    return seen >= 2;
}

/* Equal circles and parts of one circle around the same point are one. */
static void add_hole(finder *f, burnish_vec3 center, double radius, burnish_vec3 normal,
                     hole made) {
    double distance;
    made.at = burnish_annotation_project(f->view, center, &distance);
    made.radius = made.largest = radius * f->view->pixels;
    if (burnish_vec3_length(burnish_vec3_cross(normal, f->view->forward)) > END_ON_SINE ||
        made.radius < LEAST_RADIUS) {
        return;
    }
    burnish_number_text(2 * radius, made.text);
    for (size_t i = 0; i < f->count; ++i) {
        hole *other = &f->holes[i];
        if (distance_between(other->at, made.at) < SAME) {
            other->largest = made.largest =
                made.largest > other->largest ? made.largest : other->largest;
            if (strcmp(other->text, made.text) == 0) {
                const int is_other = distance_between(other->toward, made.toward) > made.radius / 2;
                other->angle += is_other ? made.angle : 0;
                return;
            }
        }
    }
    f->holes = burnish_reserve(f->list->memory, f->holes, &f->capacity, f->count + 1,
                               sizeof *f->holes, "holes");
    if (f->list->memory->status == BURNISH_STATUS_OK) {
        f->holes[f->count++] = made;
    }
}

/* Circles first. Arcs smaller than a letter are details. */
static void add_holes(finder *f, const burnish_axes *axes) {
    for (size_t i = 0; i < axes->circle_count; ++i) {
        const burnish_circle *circle = &axes->circles[i];
        const burnish_axis_line *axis = &axes->items[circle->axis];
        if (axis->radius > 0 && is_circle_seen(f, circle)) {
            add_hole(f, circle->center, circle->radius, axis->direction, (hole){.angle = 7});
        }
    }
    for (size_t i = 0; i < axes->arc_count; ++i) {
        const burnish_arc *arc = &axes->arcs[i];
        double distance;
        const burnish_point p = burnish_annotation_project(f->view, arc->middle, &distance);
        if (arc->radius * f->view->pixels > f->view->text &&
            burnish_annotation_is_seen(f->view, p, distance)) {
            add_hole(f, arc->center, arc->radius, arc->normal,
                     (hole){.angle = arc->angle, .toward = p});
        }
    }
}

/* Sharp edges, hidden ones too, and those of smooth surfaces that are seen edge on. */
static void add_outlines(finder *f, const burnish_edges *edges) {
    const burnish_mesh_view *mesh = f->view->mesh;
    for (size_t i = 0; i < edges->count && f->outlines.line_count <= OUTLINES_MAX; ++i) {
        int is_outline = edges->items[i].flags & BURNISH_EDGE_SHARP ? 2 : 0;
        burnish_point p[2];
        for (int k = 0; k < 2; ++k) {
            const size_t at = 3 * (size_t)edges->items[i].ends[k];
            const double sine =
                burnish_vec3_dot(burnish_vec3_loadf(mesh->normals + at), f->view->forward);
            double distance;
            p[k] = burnish_annotation_project(f->view, burnish_vec3_loadf(mesh->positions + at),
                                              &distance);
            is_outline += sine > -EDGE_ON_SINE && sine < EDGE_ON_SINE;
        }
        if (is_outline >= 2) {
            burnish_annotation_add_line(&f->outlines, p[0], p[1], f->view->line,
                                        BURNISH_LAYER_LINES);
        }
    }
}

/* Takes a label if there is room. */
static int take_label(finder *f, const burnish_annotation_label *label) {
    const burnish_area area = burnish_area_grown(label->area, CLEAR * f->view->text);
    if (f->list->label_count >= LABELS_MAX ||
        !burnish_annotation_is_within(f->view, &label->area) ||
        !burnish_annotation_is_free(f->list, &area) ||
        !burnish_annotation_is_free(&f->outlines, &area)) {
        return 0;
    }
    burnish_annotation_add_label(f->list, label);
    return 1;
}

static void add_line(const finder *f, burnish_point a, burnish_point b) {
    burnish_annotation_add_line(f->list, a, b, f->view->line, BURNISH_LAYER_LINES);
}

/* ---- Diameters ---- */

/* A leader from the circle to a label outside it, along a diagonal or steeper,
 * or for short arcs in their direction. */
static int try_leader(finder *f, const hole *h, const char *text, int which) {
    const double step = (SHORTEST + STEP * (which / 8)) * f->view->text;
    const double x = which & 4 ? STEEP_X : DIAGONAL, y = which & 4 ? STEEP_Y : DIAGONAL;
    burnish_point d = {which & 1 ? -x : x, which & 2 ? y : -y};
    if (h->angle < HALF_TURN) {
        const double reach = distance_between(h->toward, h->at);
        const burnish_point to = {(h->toward.x - h->at.x) / reach, (h->toward.y - h->at.y) / reach};
        d = h->angle < LEAST_TURN || d.x * to.x + d.y * to.y < x / 2 ? to : d;
    }
    const burnish_point tip = burnish_moved_along(h->at, d, h->radius);
    if (h->angle < LEAST_TURN && which & 2) { /* from within */
        d = (burnish_point){-d.x, -d.y};
    }
    const double side = d.x < 0 ? -1 : 1;
    const burnish_point elbow = burnish_moved_along(tip, d, step);
    const burnish_area own =
        burnish_annotation_label_at(f->view, text, elbow, BURNISH_LAYER_LINES).area;
    const double aside = CLEAR * f->view->text + (own.right - own.left) / 2;
    const burnish_annotation_label label = burnish_annotation_label_at(
        f->view, text, (burnish_point){elbow.x + side * aside, elbow.y}, BURNISH_LAYER_LINES);
    for (double at = SHORTEST * f->view->text; at < step; at += CLEAR * f->view->text) {
        const burnish_point p = burnish_moved_along(tip, d, at);
        const burnish_area around =
            burnish_area_grown((burnish_area){p.x, p.y, p.x, p.y}, CLEAR * f->view->text / 2);
        if (!burnish_annotation_is_free(f->list, &around)) {
            return 0;
        }
    }
    if (!take_label(f, &label)) {
        return 0;
    }
    const size_t first = f->list->line_count;
    burnish_annotation_add_arrow(f->view, tip, d, f->list);
    add_line(f, burnish_moved_along(tip, d, BURNISH_ARROW_LENGTH * f->view->text), elbow);
    for (size_t i = first; i < f->list->line_count; ++i) {
        f->list->lines[i].layer = BURNISH_LAYER_BOX; /* no rim that breaks outlines */
    }
    return 1;
}

/* One for all circles of a diameter, or arcs of a radius, next to one of the first. */
static void add_diameter(finder *f, size_t first) {
    char text[BURNISH_LABEL_SIZE], value[BURNISH_LABEL_SIZE], number[24] = "";
    size_t members[MEMBERS], count = 0;
    const int is_arc = f->holes[first].angle < HALF_TURN;
    int is_placed = 0;
    for (size_t i = first; i < f->count; ++i) {
        if (strcmp(f->holes[i].text, f->holes[first].text) == 0 &&
            is_arc == (f->holes[i].angle < HALF_TURN)) {
            f->holes[i].is_done = 1;
            members[count < MEMBERS ? count : MEMBERS - 1] = i;
            ++count;
        }
    }
    if (count > 1) {
        snprintf(number, sizeof number, "%zux ", count);
    }
    burnish_number_text(f->holes[first].radius * (is_arc ? 1 : 2) / f->view->pixels, value);
    snprintf(text, sizeof text, "%.8s%s%.20s", number, is_arc ? "R" : BURNISH_DIAMETER, value);
    const int leaders = ++f->diameters <= DIAMETERS_MAX ? LEADERS : 0;
    for (int which = 0; which < leaders; ++which) {
        for (size_t i = 0; i < count && i < MEMBERS && !is_placed; ++i) {
            is_placed = try_leader(f, &f->holes[members[i]], text, which);
        }
    }
    f->list->left_out += !is_placed;
}

/* ---- Positions ---- */

/* Along x above the box, or along y on its left. */
typedef struct running {
    burnish_point origin, along, out;
    double length; /* of the box */
} running;

/* Where a hole's centre is along a line of positions, and the middle of its number. */
typedef struct position {
    const hole *hole;
    double at, to, half; /* half: of the room that the number needs along the line */
    char text[BURNISH_LABEL_SIZE];
} position;

static double measure(const running *r, const hole *h, burnish_point d) {
    return (h->at.x - r->origin.x) * d.x + (h->at.y - r->origin.y) * d.y;
}

/* The next position after `last`, of the circle nearest to the line; NULL: none. A circle that
 * reaches the origin's edge has no position: a round object has no edge to measure from. */
static const hole *next_position(const finder *f, const running *r, double last) {
    const hole *next = NULL;
    for (size_t i = 0; i < f->count; ++i) {
        const hole *h = &f->holes[i];
        const double at = measure(r, h, r->along), best = next ? measure(r, next, r->along) : 0;
        if (h->angle > LEAST_TURN && at > last + SAME && at > h->largest + SAME &&
            at < r->length - SAME &&
            (!next || at < best - SAME ||
             (at < best + SAME && measure(r, h, r->out) > measure(r, next, r->out)))) {
            next = h;
        }
    }
    return next;
}

/* The label of a number with its middle at a point; a turned one reads upward.
 */
static burnish_annotation_label number_at(const finder *f, const char *text, burnish_point p,
                                          int is_turned) {
    burnish_annotation_label made =
        burnish_annotation_label_at(f->view, text, p, BURNISH_LAYER_LINES);
    const burnish_area a = made.area;
    const double x = (a.left + a.right) / 2, y = (a.top + a.bottom) / 2;
    const double wide = (a.right - a.left) / 2, high = (a.bottom - a.top) / 2;
    if (is_turned) {
        made.is_turned = 1;
        made.area = (burnish_area){x - high, y - wide, x + high, y + wide};
    }
    return made;
}

/* Numbers that have no room next to each other are moved apart, by no more than
 * they need. Returns whether one is. */
static int spread_numbers(const finder *f, position *all, size_t count, int is_wide) {
    double before = -1e9, after = 1e9;
    int is_moved = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_area a = number_at(f, all[i].text, (burnish_point){0, 0}, 0).area;
        all[i].half = (is_wide ? a.right - a.left : f->view->text) / 2 + CLEAR * f->view->text;
        all[i].to = all[i].at > before + all[i].half ? all[i].at : before + all[i].half;
        is_moved |= all[i].to > all[i].at;
        before = all[i].to + all[i].half;
    }
    for (size_t i = count; i-- > 0;) {
        const double low = all[i].at < after - all[i].half ? all[i].at : after - all[i].half;
        all[i].to = (all[i].to + low) / 2;
        after = low - all[i].half;
    }
    return is_moved;
}

/* A number with an extension line from its hole. */
static int add_position(finder *f, const running *r, const position *p, burnish_point on,
                        int is_moved) {
    const double text = f->view->text;
    int is_turned = is_moved && r->along.x > 0, is_placed = 0;
    const burnish_point end = burnish_moved_along(on, r->out, OVER * text);
    const burnish_point jog = burnish_moved_along(burnish_moved_along(end, r->along, p->to - p->at),
                                                  r->out, is_moved ? JOG * text : 0);
    for (; is_turned < 2 && !is_placed; ++is_turned) { /* one that has no room is tried turned */
        const burnish_area own = number_at(f, p->text, jog, is_turned).area;
        const double reach = (r->along.x > 0 ? own.bottom - own.top : own.right - own.left) / 2;
        const burnish_annotation_label label =
            number_at(f, p->text, burnish_moved_along(jog, r->out, OVER * text + reach), is_turned);
        is_placed = take_label(f, &label);
    }
    f->list->left_out += !is_placed;
    if (!is_placed) {
        return 0;
    }
    burnish_annotation_add_line(
        f->list, burnish_moved_along(p->hole->at, r->out, p->hole->largest + CLEAR * text), end,
        f->view->line, BURNISH_LAYER_BOX); /* without a rim over the object */
    add_line(f, on, end);
    add_line(f, end, jog);
    return 1;
}

static void add_positions(finder *f, const running *r) {
    const double text = f->view->text, arrow = BURNISH_ARROW_LENGTH * text;
    const burnish_vec3 cut = burnish_vec3_load(f->view->section.normal);
    const double mark = burnish_magnitude(burnish_vec3_dot(cut, f->view->right) * r->along.x +
                                          burnish_vec3_dot(cut, f->view->up) * r->along.y);
    const double offset = (OFFSET + (mark > DIAGONAL ? MARK : 0)) * text;
    const burnish_point origin = burnish_moved_along(r->origin, r->out, offset);
    position all[LABELS_MAX];
    size_t count = 0;
    double last = 0;
    for (const hole *h = next_position(f, r, 0); h; h = next_position(f, r, last)) {
        last = measure(r, h, r->along);
        f->list->left_out += count == LABELS_MAX;
        if (count < LABELS_MAX) {
            all[count] = (position){.hole = h, .at = last};
            burnish_number_text(last / f->view->pixels, all[count++].text);
        }
    }
    const int is_moved = spread_numbers(f, all, count, r->along.x > 0);
    if (is_moved && r->along.x > 0) { /* all are turned (ISO 129-1) */
        spread_numbers(f, all, count, 0);
    }
    last = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_point on = burnish_moved_along(origin, r->along, all[i].at);
        if (!add_position(f, r, &all[i], on, is_moved)) {
            continue;
        }
        const burnish_point edge = burnish_moved_along(on, r->out, CLEAR * text - offset);
        if (!burnish_annotation_hits_label(f->list, edge, on, f->view->line)) {
            add_line(f, edge, on); /* else the line without a rim ends at the label's rim */
        }
        add_line(f, burnish_moved_along(origin, r->along, last), on);
        if (all[i].at - last > 1.5 * arrow) {
            burnish_annotation_add_arrow(f->view, on, (burnish_point){-r->along.x, -r->along.y},
                                         f->list);
        }
        last = all[i].at;
    }
    if (last > 0) {
        burnish_annotation_add_line(f->list, origin, origin, ORIGIN * text, BURNISH_LAYER_LINES);
        add_line(f, burnish_moved_along(r->origin, r->out, CLEAR * text),
                 burnish_moved_along(origin, r->out, OVER * text));
    }
}

/* ---- All ---- */

static void annotate_holes(finder *f) {
    const burnish_area box = f->view->box;
    for (size_t i = 0; i < f->count; ++i) {
        for (int k = 0; k < 2 && f->holes[i].angle > HALF_TURN; ++k) { /* centre lines */
            const burnish_point d = {k, 1 - k};
            const double reach = f->holes[i].largest + f->view->text;
            burnish_annotation_add_line(&f->outlines, burnish_moved_along(f->holes[i].at, d, reach),
                                        burnish_moved_along(f->holes[i].at, d, -reach),
                                        f->view->line, BURNISH_LAYER_LINES);
        }
    }
    add_positions(f, &(running){{box.left, box.top}, {1, 0}, {0, -1}, box.right - box.left});
    add_positions(f, &(running){{box.left, box.bottom}, {0, -1}, {-1, 0}, box.bottom - box.top});
    for (size_t i = 0; i < 2 * f->count; ++i) { /* arcs first, which have fewer places */
        const hole *h = &f->holes[i % f->count];
        if (!h->is_done && (i >= f->count || h->angle < HALF_TURN)) {
            add_diameter(f, i % f->count);
        }
    }
}

void burnish_annotate_holes(const burnish_annotation_view *view, burnish_annotation_list *list) {
    burnish_memory *memory = list->memory;
    finder f = {.view = view, .list = list, .outlines = {.memory = memory}};
    burnish_tasks tasks;
    burnish_edges edges = {NULL, 0};
    burnish_axes axes = {.count = 0};
    burnish_tasks_begin(&tasks, memory->context, 1);
    if (view->parallel &&
        burnish_edges_find(view->mesh, &tasks, memory, &edges) == BURNISH_STATUS_OK) {
        burnish_axes_find(view->mesh, &edges, memory, &axes);
    }
    if (memory->status == BURNISH_STATUS_OK) {
        add_holes(&f, &axes);
    }
    list->left_out += axes.are_too_many != 0;
    if (f.count > 0 && memory->status == BURNISH_STATUS_OK) {
        add_outlines(&f, &edges);
        annotate_holes(&f);
    }
    void *const arrays[] = {edges.items, axes.items, axes.circles,
                            axes.arcs,   f.holes,    f.outlines.lines};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        burnish_release(memory->context, arrays[i]);
    }
}
