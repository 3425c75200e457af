/* Callouts: balloons with the numbers of parts on a rectangle around the object, leaders from there
 * to the parts, and the parts list along the right edge. */
#include <stdio.h>
#include <string.h>

#include "annotate/annotate.h"
#include "base/elementary.h"
#include "base/numbers.h"
#include "image/text/text.h"

/* Lengths in heights of a capital. */
#define RADIUS 1.2 /* of a balloon */
#define GAP 1.1    /* from the object to a balloon, and from there to the list */
#define APART 0.5  /* from balloon to balloon */
#define DOT 0.5    /* diameter, at a leader's start */
#define WANTED 5.5 /* between balloons, at least if that makes leaders little longer */
#define BORDER 0.8 /* from the picture's edge */
#define ROW 1.5    /* of the list */
#define NUMBER 2.1 /* of the list's numbers, and the space behind them */

/* The widest list, of the picture's smaller side. */
#define LIST_WIDEST 0.34

enum { SEGMENTS = 24, PLACES_MAX = 1024, NOWHERE = PLACES_MAX, ROUNDS = 64, SMALLEST_TEXT = 7 };

/* ---- The list ---- */

static double width_of(const burnish_annotation_label *label) {
    return label->area.right - label->area.left;
}

static const char *name_of(const burnish_annotation_view *view, size_t i) {
    return view->parts[view->callouts->items[i].part].name;
}

/* What a row says behind its number: the count, and the name or, without letters for it, the part's
 * number. A name that is too wide loses its end or, if another starts the same way, its start. Parts
 * that are not visible are paler. */
static burnish_annotation_label make_row(const burnish_annotation_view *view, size_t i,
                                         double most) {
    const burnish_callout *item = &view->callouts->items[i];
    char text[2 * BURNISH_LABEL_SIZE], number[32];
    burnish_annotation_label label = {.x = 0};
    snprintf(number, sizeof number, "#%zu", item->part + 1);
    const char *name = name_of(view, i);
    name = *name && burnish_text_is_legible(name) ? name : number;
    const int length = (int)strlen(name);
    int is_tail = 0, cut = 0, fits = 0;
    for (; cut < length && !fits; cut += !fits) {
        if (((uint8_t)name[is_tail ? cut : length - cut] & 0xC0) == 0x80) { /* whole characters */
            continue;
        }
        const int size =
            snprintf(text, sizeof text, "%zux %s%.*s%s", item->count, is_tail ? "..." : "",
                     length - cut, name + (is_tail ? cut : 0), cut > 0 && !is_tail ? "..." : "");
        if (size < BURNISH_LABEL_SIZE) {
            label = burnish_annotation_label_at(
                view, text, (burnish_point){0, 0},
                view->triangles && !item->is_visible ? BURNISH_LAYER_HIDDEN : BURNISH_LAYER_LINES);
            fits = width_of(&label) <= most;
        }
        for (size_t k = 0; fits && cut > 0 && !is_tail && k < view->callouts->count; ++k) {
            if (k != i && strncmp(name_of(view, k), name, (size_t)(length - cut)) == 0) {
                is_tail = 1;
                cut = fits = 0;
            }
        }
    }
    return label;
}

/* Returns how many entries have room: all of them if smaller letters, which are set, make that. The
 * last row counts the others. */
static size_t fit_list(const burnish_annotation_view *view, burnish_annotation_view *on,
                       double *most) {
    const double smaller = view->width < view->height ? view->width : view->height;
    const double least = view->text < SMALLEST_TEXT ? view->text : SMALLEST_TEXT;
    const size_t all = view->callouts->count;
    size_t shown = 0;
    *on = *view;
    for (int k = 0; k < 3 && shown < all; ++k) {
        const double text = (double)(int)((1 - 0.15 * k) * view->text + 0.5);
        on->text = text > least ? text : least;
        *most = LIST_WIDEST * smaller - NUMBER * on->text;
        const double rows = (view->height - (2 * BORDER + 1) * on->text) / (ROW * on->text) + 1;
        shown = *most < 3 * on->text || rows < 2 ? 0 : rows < (double)all ? (size_t)rows - 1 : all;
    }
    return shown;
}

/* The bounds of the object within an area of the picture; left is above right if there is none. */
static burnish_area bound_object(const burnish_annotation_view *view, const burnish_area *area) {
    burnish_area bounds = {view->width, view->height, 0, 0};
    for (int y = (int)area->top; y < area->bottom; ++y) {
        for (int x = (int)area->left; x < area->right; ++x) {
            if (view->triangles[(size_t)y * (size_t)view->width + (size_t)x] != UINT32_MAX) {
                bounds.left = x < bounds.left ? x : bounds.left;
                bounds.top = y < bounds.top ? y : bounds.top;
                bounds.right = x >= bounds.right ? x + 1 : bounds.right;
                bounds.bottom = y + 1;
            }
        }
    }
    return bounds;
}

static int is_covered(const burnish_annotation_view *view, burnish_area area) {
    const burnish_area bounds = bound_object(view, &area);
    return bounds.left <= bounds.right;
}

static void add_text(burnish_annotation_label label, double left, double baseline,
                     burnish_annotation_list *list) {
    const double width = width_of(&label);
    label.x = (double)(int)left;
    label.baseline = (double)(int)baseline;
    label.area =
        (burnish_area){label.x, label.baseline - label.height, label.x + width, label.baseline};
    burnish_annotation_add_label(list, &label);
}

/* On the left if the object is on the right only. */
void burnish_annotate_parts_list(const burnish_annotation_view *view,
                                 burnish_annotation_list *list) {
    burnish_annotation_view on;
    double most = 0, width = 0;
    const size_t all = view->callouts->count, shown = fit_list(view, &on, &most);
    const double text = on.text, border = BORDER * text, ring = (GAP + 2 * RADIUS) * view->text;
    for (size_t i = 0; i < shown; ++i) {
        const burnish_annotation_label row = make_row(&on, i, most);
        width = width_of(&row) > width ? width_of(&row) : width;
    }
    width += shown > 0 ? NUMBER * text : 0;
    for (int i = 0; i < view->hull_count && !list->bounded; ++i) { /* room for list and balloons */
        const burnish_point p = view->hull[i];
        burnish_annotation_add_line(
            list, (burnish_point){p.x - ring, p.y - ring},
            (burnish_point){p.x + ring + GAP * view->text + width, p.y + ring}, view->line,
            BURNISH_LAYER_LINES);
    }
    if (!list->bounded) {
        return;
    }
    const size_t rows = shown + (shown > 0 && shown < all);
    const double bottom = shown > 0 ? border + ROW * (double)rows * text : 0;
    burnish_area area = {view->width - border - width, 0, view->width, bottom};
    const burnish_area other = {0, 0, border + width, bottom};
    if (view->triangles && is_covered(view, area) && !is_covered(view, other)) {
        area = other;
    }
    for (size_t i = 0; i < rows; ++i) {
        const double left = (area.left > 0 ? area.left : border) + NUMBER * text;
        const double baseline = border + (1 + ROW * (double)i) * text;
        char number[BURNISH_LABEL_SIZE];
        snprintf(number, sizeof number, i < shown ? "%zu" : "and %zu more",
                 i < shown ? i + 1 : all - shown);
        burnish_annotation_label label = make_row(&on, i, most);
        if (i < shown) {
            add_text(label, left, baseline, list);
        }
        label = burnish_annotation_label_at(&on, number, (burnish_point){0, 0},
                                            i < shown ? label.layer : BURNISH_LAYER_LINES);
        add_text(label, left - (i < shown ? 0.7 * text + width_of(&label) : 0), baseline, list);
    }
    list->left_out += all - shown;
    list->marks[list->mark_count++] = area;
}

/* ---- Balloons ---- */

/* Where balloons can be, and which entry of the list is where. */
typedef struct ring {
    const burnish_annotation_view *view;
    const burnish_annotation_list *list;
    burnish_point places[PLACES_MAX];
    size_t place_count;
    burnish_callout *callouts[BURNISH_BALLOONS_MAX];
    size_t at[BURNISH_BALLOONS_MAX]; /* a place, or NOWHERE */
    size_t count;
    double pitch; /* the least distance of balloons */
    float *costs; /* of each entry at each place */
} ring;

static double distance_of(burnish_point a, burnish_point b) {
    return burnish_sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

static burnish_point start_of(const burnish_callout *callout) {
    return (burnish_point){callout->x + 0.5, callout->y + 0.5};
}

static burnish_area around(burnish_point p, double radius) {
    return (burnish_area){p.x - radius, p.y - radius, p.x + radius, p.y + radius};
}

/* Lists the free places on the rectangle around the object, within the picture and left of the
 * list. */
static void find_places(const burnish_annotation_view *view, const burnish_annotation_list *list,
                        ring *r) {
    const double radius = RADIUS * view->text + 2 * view->line;
    const burnish_area all = {0, 0, view->width, view->height};
    const burnish_area *taken = &list->marks[0]; /* by the list, on one side */
    const burnish_area room = {taken->left > 0 ? radius : taken->right + radius, radius,
                               taken->left > 0 ? taken->left - radius : view->width - radius,
                               view->height - radius};
    burnish_area box = burnish_area_grown(bound_object(view, &all), (GAP + RADIUS) * view->text);
    box.left = box.left > room.left ? box.left : room.left;
    box.top = box.top > room.top ? box.top : room.top;
    box.right = box.right < room.right ? box.right : room.right;
    box.bottom = box.bottom < room.bottom ? box.bottom : room.bottom;
    const double rim = 2 * (box.right - box.left + box.bottom - box.top);
    const double step = 2 * r->pitch * (double)r->count > rim ? r->pitch : r->pitch / 3;
    const burnish_point corners[5] = {{box.left, box.top},
                                      {box.right, box.top},
                                      {box.right, box.bottom},
                                      {box.left, box.bottom},
                                      {box.left, box.top}};
    for (int k = 0; k < 4 && box.left < box.right && box.top < box.bottom; ++k) {
        const burnish_point a = corners[k], b = corners[k + 1];
        const double length = distance_of(a, b);
        const int count = length > step ? (int)(length / step) : 1;
        for (int i = 0; i < count && r->place_count < PLACES_MAX; ++i) {
            const burnish_point p = {a.x + (b.x - a.x) * i / count, a.y + (b.y - a.y) * i / count};
            const burnish_area area = around(p, radius - 1);
            if (!is_covered(view, area) && burnish_annotation_is_free(list, &area)) {
                r->places[r->place_count++] = p;
            }
        }
    }
}

/* 1: the segments from a to b and from p to q cross. */
static int do_cross(burnish_point a, burnish_point b, burnish_point p, burnish_point q) {
    return (burnish_cross_of_points(a, b, p) > 0) != (burnish_cross_of_points(a, b, q) > 0) &&
           (burnish_cross_of_points(p, q, a) > 0) != (burnish_cross_of_points(p, q, b) > 0);
}

static uint32_t triangle_at(const burnish_annotation_view *view, burnish_point p) {
    return p.x >= 0 && p.y >= 0 && p.x < view->width && p.y < view->height
               ? view->triangles[(size_t)p.y * (size_t)view->width + (size_t)p.x]
               : UINT32_MAX;
}

/* What is bad about a leader: its length, lines and labels that it crosses, and edges that it runs
 * along, which are between the two sides of it. */
static double cost_of(const ring *r, burnish_point start, burnish_point place) {
    const double text = r->view->text, length = distance_of(start, place), step = text / 6;
    const burnish_point d = {(place.x - start.x) / length, (place.y - start.y) / length};
    const burnish_point across = {-0.15 * text * d.y, 0.15 * text * d.x};
    double cost = length;
    for (size_t i = 0; i < r->list->line_count; ++i) {
        const burnish_stroke *s = &r->list->lines[i].stroke;
        cost += do_cross(start, place, (burnish_point){(double)s->x0, (double)s->y0},
                         (burnish_point){(double)s->x1, (double)s->y1})
                    ? 8 * text
                    : 0;
    }
    cost += burnish_annotation_hits_label(r->list, start, place, text / 3) ? 60 * text : 0;
    for (double at = step; at < length; at += step) {
        const burnish_point p = burnish_moved_along(start, d, at);
        const burnish_point left = {p.x - across.x, p.y - across.y};
        const burnish_point right = {p.x + across.x, p.y + across.y};
        cost +=
            burnish_is_one_face(r->view, triangle_at(r->view, left), triangle_at(r->view, right))
                ? 0
                : 2 * step;
    }
    return cost;
}

/* What is bad about a balloon's place. Less than the pitch from another, or from its leader, is
 * worse than no balloon; further away is better, up to the wanted distance. */
static double badness_of(const ring *r, size_t i, size_t place) {
    const double wanted = WANTED * r->view->text, radius = 0.9 * RADIUS * r->view->text;
    double cost = place == NOWHERE ? 1e6 : (double)r->costs[i * PLACES_MAX + place];
    for (size_t k = 0; k < r->count && place != NOWHERE; ++k) {
        if (k != i && r->at[k] != NOWHERE) {
            const burnish_point p = r->places[place], q = r->places[r->at[k]];
            const double distance = distance_of(p, q);
            const burnish_area own = around(p, radius), other = around(q, radius);
            cost += distance < r->pitch ||
                            burnish_segment_hits(start_of(r->callouts[i]), p, &other) ||
                            burnish_segment_hits(start_of(r->callouts[k]), q, &own)
                        ? 2e6
                        : 0;
            cost += distance < wanted ? 0.7 * (wanted - distance) : 0;
        }
    }
    return cost;
}

/* Moves and swaps balloons; returns 0 if nothing changes. Last, only leaders that cross count: they
 * are longer than swapped. */
static int improve_balloons(ring *r, int is_last) {
    int changed = 0;
    for (size_t i = 0; i < r->count; ++i) {
        const float *costs = r->costs + i * PLACES_MAX;
        r->at[i] = badness_of(r, i, r->at[i]) > 1e6 ? NOWHERE : r->at[i]; /* a swap blocked it */
        double least = badness_of(r, i, r->at[i]) - 0.01;
        for (size_t place = 0; place < r->place_count && !is_last; ++place) {
            const double cost = badness_of(r, i, place);
            if (cost < least) {
                least = cost - 0.01;
                r->at[i] = place;
                changed = 1;
            }
        }
        for (size_t k = 0; k < i; ++k) {
            const size_t a = r->at[i], b = r->at[k];
            const float *other = r->costs + k * PLACES_MAX;
            if (a != NOWHERE && b != NOWHERE &&
                (is_last ? do_cross(start_of(r->callouts[i]), r->places[a],
                                    start_of(r->callouts[k]), r->places[b])
                         : costs[b] + other[a] + 0.01F < costs[a] + other[b])) {
                r->at[i] = b;
                r->at[k] = a;
                changed = 1;
            }
        }
    }
    return changed;
}

static void draw_balloon(const burnish_annotation_view *view, const burnish_callout *callout,
                         burnish_point middle, burnish_annotation_list *list) {
    const burnish_point start = start_of(callout);
    const double radius = RADIUS * view->text, share = radius / distance_of(start, middle);
    char text[BURNISH_LABEL_SIZE];
    burnish_point last = {middle.x + radius, middle.y};
    for (int k = 1; k <= SEGMENTS; ++k) {
        double sine, cosine;
        burnish_sincos(k * 360.0 / SEGMENTS * BURNISH_DEGREE, &sine, &cosine);
        const burnish_point next = {middle.x + radius * cosine, middle.y + radius * sine};
        burnish_annotation_add_line(list, last, next, view->line, BURNISH_LAYER_LINES);
        last = next;
    }
    last.x = middle.x + (start.x - middle.x) * share;
    last.y = middle.y + (start.y - middle.y) * share;
    burnish_annotation_add_line(list, start, last, view->line, BURNISH_LAYER_LINES);
    burnish_annotation_add_line(list, start, start, DOT * view->text, BURNISH_LAYER_LINES);
    snprintf(text, sizeof text, "%zu", (size_t)(callout - view->callouts->items) + 1);
    const burnish_annotation_label label =
        burnish_annotation_label_at(view, text, middle, BURNISH_LAYER_LINES);
    burnish_annotation_add_label(list, &label);
}

void burnish_annotate_balloons(const burnish_annotation_view *view, burnish_annotation_list *list) {
    ring r = {.view = view, .list = list, .pitch = (2 * RADIUS + APART) * view->text};
    for (size_t i = 0; i < view->callouts->count && r.count < BURNISH_BALLOONS_MAX; ++i) {
        r.at[r.count] = NOWHERE;
        r.callouts[r.count] = &view->callouts->items[i];
        r.count += view->callouts->items[i].is_visible != 0;
    }
    r.costs = burnish_allocate(list->memory, r.count * PLACES_MAX + 1, sizeof *r.costs, "balloons");
    if (list->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    find_places(view, list, &r);
    for (size_t i = 0; i < r.count * r.place_count; ++i) {
        const size_t k = i / r.place_count, place = i % r.place_count;
        r.costs[k * PLACES_MAX + place] =
            (float)cost_of(&r, start_of(r.callouts[k]), r.places[place]);
    }
    for (int is_last = 0; is_last < 2; ++is_last) {
        for (int n = 0; n < ROUNDS && improve_balloons(&r, is_last); ++n) {
        }
    }
    for (size_t i = 0; i < r.count; ++i) {
        if (r.at[i] != NOWHERE) {
            r.callouts[i]->has_balloon = 1;
            draw_balloon(view, r.callouts[i], r.places[r.at[i]], list);
        }
    }
    burnish_release(list->memory->context, r.costs);
}
