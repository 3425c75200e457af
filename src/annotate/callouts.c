/* Callouts: balloons with the numbers of parts on a rectangle around the object, leaders from there
 * to the parts, and the parts list along the right edge. */
#include <stdio.h>
#include <string.h>

#include "annotate/annotate.h"
#include "base/elementary.h"
#include "base/numbers.h"

/* Lengths in heights of a capital. */
#define RADIUS 1.2 /* of a balloon */
#define GAP 1.1    /* from the object to a balloon, and from there to the list */
#define APART 0.5  /* from balloon to balloon */
#define DOT 0.5    /* diameter, at a leader's start */
#define BORDER 0.8 /* from the picture's edge */
#define ROW 1.5    /* of the list */
#define NUMBER 2.1 /* of the list's numbers, and the space behind them */

/* The widest list, of the picture's smaller side. */
#define LIST_WIDEST 0.34

enum { SEGMENTS = 24, PLACES_MAX = 1024, NOWHERE = PLACES_MAX, ROUNDS = 64 };

/* ---- The list ---- */

static double width_of(const burnish_annotation_label *label) {
    return label->area.right - label->area.left;
}

/* What a row says behind its number, cut to a width. Parts that are not visible are paler. */
static burnish_annotation_label make_row(const burnish_annotation_view *view, size_t i,
                                         double width) {
    const burnish_callout *item = &view->callouts->items[i];
    const char *name = view->parts[item->part].name;
    const int is_pale = view->triangles && !item->is_visible;
    char text[BURNISH_LABEL_SIZE];
    burnish_annotation_label label;
    int length = *name ? snprintf(text, sizeof text, "%zux %s", item->count, name)
                       : snprintf(text, sizeof text, "%zux #%zu", item->count, item->part + 1);
    length = length < BURNISH_LABEL_SIZE ? length : BURNISH_LABEL_SIZE - 1;
    do {
        while (((uint8_t)text[length] & 0xC0) == 0x80) { /* whole characters */
            --length;
        }
        text[length] = 0;
        label = burnish_annotation_label_at(view, text, (burnish_point){0, 0},
                                            is_pale ? BURNISH_LAYER_HIDDEN : BURNISH_LAYER_LINES);
    } while (width_of(&label) > width && --length > 0);
    return label;
}

static void add_text(const burnish_annotation_view *view, burnish_annotation_label label,
                     double left, double baseline, burnish_annotation_list *list) {
    const double width = width_of(&label);
    label.x = (double)(int)left;
    label.baseline = (double)(int)baseline;
    label.area =
        (burnish_area){label.x, label.baseline - view->text, label.x + width, label.baseline};
    burnish_annotation_add_label(list, &label);
}

void burnish_annotate_parts_list(const burnish_annotation_view *view,
                                 burnish_annotation_list *list) {
    const double text = view->text, border = BORDER * text;
    const double smaller = view->width < view->height ? view->width : view->height;
    const double most = LIST_WIDEST * smaller - NUMBER * text;
    const double rows = (view->height - 2 * border - text) / (ROW * text) + 1;
    const size_t all = view->callouts->count;
    const size_t count = most < 3 * text || rows < 1 ? 0 : rows < (double)all ? (size_t)rows : all;
    double width = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_annotation_label row = make_row(view, i, most);
        width = width_of(&row) > width ? width_of(&row) : width;
    }
    for (int i = 0; i < view->hull_count && !list->bounded; ++i) { /* room for list and balloons */
        const double ring = (GAP + 2 * RADIUS) * text;
        const burnish_point p = view->hull[i];
        burnish_annotation_add_line(
            list, (burnish_point){p.x - ring, p.y - ring},
            (burnish_point){p.x + ring + (GAP + NUMBER) * text + width, p.y + ring}, view->line,
            BURNISH_LAYER_LINES);
    }
    if (!list->bounded) {
        return;
    }
    const double left = view->width - border - width;
    for (size_t i = 0; i < count; ++i) {
        const double baseline = border + (1 + ROW * (double)i) * text;
        char number[BURNISH_LABEL_SIZE];
        snprintf(number, sizeof number, "%zu", i + 1);
        burnish_annotation_label row = make_row(view, i, most);
        add_text(view, row, left, baseline, list);
        row = burnish_annotation_label_at(view, number, (burnish_point){0, 0}, row.layer);
        add_text(view, row, left - 0.7 * text - width_of(&row), baseline, list);
    }
    list->left_out += all - count;
    list->marks[list->mark_count++] = (burnish_area){
        left - NUMBER * text, 0, view->width, count > 0 ? border + ROW * (double)count * text : 0};
}

/* ---- Balloons ---- */

/* Where balloons can be, and which entry of the list is where. */
typedef struct ring {
    burnish_point places[PLACES_MAX];
    size_t place_count;
    burnish_callout *callouts[BURNISH_BALLOONS_MAX];
    size_t at[BURNISH_BALLOONS_MAX]; /* a place, or NOWHERE */
    size_t count;
    double pitch; /* the least distance of balloons */
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

/* Lists the free places on the rectangle around the object, within the picture and left of the
 * list. */
static void find_places(const burnish_annotation_view *view, const burnish_annotation_list *list,
                        ring *r) {
    const double radius = RADIUS * view->text + 2 * view->line;
    const burnish_area all = {0, 0, view->width, view->height};
    const burnish_area room = {radius, radius, list->marks[0].left - radius, view->height - radius};
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
            const burnish_area covered = bound_object(view, &area);
            if (covered.left > covered.right && burnish_annotation_is_free(list, &area)) {
                r->places[r->place_count++] = p;
            }
        }
    }
}

/* 1: a place is far enough from all balloons but one. */
static int is_apart(const ring *r, size_t place, size_t but) {
    for (size_t i = 0; i < r->count; ++i) {
        if (i != but && r->at[i] != NOWHERE &&
            distance_of(r->places[place], r->places[r->at[i]]) < r->pitch) {
            return 0;
        }
    }
    return 1;
}

/* The length of a leader; without a balloon it is longer than all. */
static double length_of(const ring *r, size_t i, size_t place) {
    return place == NOWHERE ? 1e6 : distance_of(start_of(r->callouts[i]), r->places[place]);
}

/* Moves and swaps balloons while leaders get shorter: leaders that cross are longer than swapped. */
static void place_balloons(ring *r) {
    int changed = 1;
    for (int n = 0; n < ROUNDS && changed; ++n) {
        changed = 0;
        for (size_t i = 0; i < r->count; ++i) {
            for (size_t place = 0; place < r->place_count; ++place) {
                if (length_of(r, i, place) < length_of(r, i, r->at[i]) && is_apart(r, place, i)) {
                    r->at[i] = place;
                    changed = 1;
                }
            }
            for (size_t k = 0; k < i; ++k) {
                const size_t a = r->at[i], b = r->at[k];
                if (length_of(r, i, b) + length_of(r, k, a) + 1e-6 <
                    length_of(r, i, a) + length_of(r, k, b)) {
                    r->at[i] = b;
                    r->at[k] = a;
                    changed = 1;
                }
            }
        }
    }
}

/* 1: the leader of a balloon runs through another balloon. */
static int is_blocked(const ring *r, size_t i, double radius) {
    int hits = 0;
    for (size_t k = 0; k < r->count; ++k) {
        if (k != i && r->at[k] != NOWHERE) {
            const burnish_area area = around(r->places[r->at[k]], radius);
            hits |= burnish_segment_hits(start_of(r->callouts[i]), r->places[r->at[i]], &area);
        }
    }
    return hits;
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
    ring r = {.pitch = (2 * RADIUS + APART) * view->text};
    for (size_t i = 0; i < view->callouts->count && r.count < BURNISH_BALLOONS_MAX; ++i) {
        r.at[r.count] = NOWHERE;
        r.callouts[r.count] = &view->callouts->items[i];
        r.count += view->callouts->items[i].is_visible != 0;
    }
    find_places(view, list, &r);
    place_balloons(&r);
    for (size_t i = r.count; i-- > 0;) {
        r.at[i] =
            r.at[i] != NOWHERE && is_blocked(&r, i, 0.9 * RADIUS * view->text) ? NOWHERE : r.at[i];
    }
    for (size_t i = 0; i < r.count; ++i) {
        if (r.at[i] != NOWHERE) {
            r.callouts[i]->has_balloon = 1;
            draw_balloon(view, r.callouts[i], r.places[r.at[i]], list);
        }
    }
}
