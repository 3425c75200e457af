/* Marks: axes, scale bar and the grid's spacing, in free corners of the image. */
#include <stdio.h>
#include <string.h>

#include "annotate/annotate.h"

/* Lengths in heights of a capital. */
#define AXIS_LENGTH 2.4
#define AXIS_LETTER 0.95 /* from an axis' end to the middle of its letter */
#define TICK 0.45        /* half a tick of the scale bar */
#define BAR_GAP 0.55     /* from the bar's ticks to its number */
#define BORDER 0.8       /* from the picture's edge */

/* Of the picture's width. */
#define BAR_LONGEST 0.22

enum { MARK_LINES = 8, MARK_LABELS = 3, CORNERS = 6 };

/* A mark before it has a corner: lines and labels around an origin of its own. */
typedef struct mark {
    struct {
        burnish_point a, b;
        double width;
        burnish_annotation_layer layer;
    } lines[MARK_LINES];
    int line_count;
    burnish_annotation_label labels[MARK_LABELS];
    int label_count;
    burnish_area area;
} mark;

static void widen_mark(mark *made, const burnish_area *area) {
    if (made->line_count + made->label_count <= 1) {
        made->area = *area;
        return;
    }
    made->area.left = area->left < made->area.left ? area->left : made->area.left;
    made->area.top = area->top < made->area.top ? area->top : made->area.top;
    made->area.right = area->right > made->area.right ? area->right : made->area.right;
    made->area.bottom = area->bottom > made->area.bottom ? area->bottom : made->area.bottom;
}

static void push_line(mark *made, burnish_point a, burnish_point b, double width,
                      burnish_annotation_layer layer) {
    const burnish_area area = {
        (a.x < b.x ? a.x : b.x) - width / 2, (a.y < b.y ? a.y : b.y) - width / 2,
        (a.x < b.x ? b.x : a.x) + width / 2, (a.y < b.y ? b.y : a.y) + width / 2};
    made->lines[made->line_count].a = a;
    made->lines[made->line_count].b = b;
    made->lines[made->line_count].width = width;
    made->lines[made->line_count++].layer = layer;
    widen_mark(made, &area);
}

static void push_label(mark *made, const burnish_annotation_label *label) {
    made->labels[made->label_count++] = *label;
    widen_mark(made, &label->area);
}

/* ---- Corners ---- */

static burnish_point corner_shift(const burnish_annotation_view *view, const mark *made,
                                  int corner) {
    const double border = BORDER * view->text;
    const double left = border - made->area.left;
    const double right = view->width - border - made->area.right;
    const double top = border - made->area.top;
    const double bottom = view->height - border - made->area.bottom;
    const burnish_point shifts[CORNERS] = {{left, bottom},
                                           {right, bottom},
                                           {left, top},
                                           {right, top},
                                           {(left + right) / 2, bottom},
                                           {(left + right) / 2, top}};
    return shifts[corner];
}

/* Whole pixels: labels are laid out on them. */
static burnish_point whole_point(burnish_point p) {
    return (burnish_point){(double)(int64_t)(p.x + 16384.5) - 16384,
                           (double)(int64_t)(p.y + 16384.5) - 16384};
}

static int fits_mark(const burnish_annotation_view *view, const burnish_annotation_list *list,
                     const burnish_area *area, int beside_object) {
    const burnish_area grown = burnish_area_grown(*area, 0.4 * view->text);
    return area->left >= 0 && area->top >= 0 && area->right <= view->width &&
           area->bottom <= view->height && burnish_annotation_is_free(list, &grown) &&
           !(beside_object && view->corners_seen && burnish_annotation_hits_hull(view, &grown));
}

static burnish_area shifted_area(burnish_area area, burnish_point by) {
    return (burnish_area){area.left + by.x, area.top + by.y, area.right + by.x, area.bottom + by.y};
}

static void take_mark(burnish_annotation_list *list, const mark *made, burnish_point by) {
    for (int i = 0; i < made->line_count; ++i) {
        const burnish_point a = made->lines[i].a, b = made->lines[i].b;
        burnish_annotation_add_line(list, (burnish_point){a.x + by.x, a.y + by.y},
                                    (burnish_point){b.x + by.x, b.y + by.y}, made->lines[i].width,
                                    made->lines[i].layer);
    }
    for (int i = 0; i < made->label_count; ++i) {
        burnish_annotation_label label = made->labels[i];
        label.x += by.x;
        label.baseline += by.y;
        label.area = shifted_area(label.area, by);
        burnish_annotation_add_label(list, &label);
    }
    list->marks[list->mark_count++] = shifted_area(made->area, by);
}

/* Moves a mark into the first free corner, from `preferred` on. If there is none, the mark can
 * overlap the object. */
static void settle_mark(const burnish_annotation_view *view, const mark *made, int preferred,
                        burnish_annotation_list *list) {
    for (int beside_object = 1; beside_object >= 0; --beside_object) {
        for (int i = 0; i < CORNERS; ++i) {
            const int corner = i < 4 ? i ^ preferred : i;
            const burnish_point by = whole_point(corner_shift(view, made, corner));
            const burnish_area area = shifted_area(made->area, by);
            if (fits_mark(view, list, &area, beside_object)) {
                list->crowded += !beside_object;
                take_mark(list, made, by);
                return;
            }
        }
    }
    ++list->crowded;
    list->left_out += made->label_count > 0;
}

/* ---- The marks ---- */

/* 1: the label touches another label or a line of the mark. */
static int is_taken(const mark *made, const burnish_annotation_label *label) {
    const burnish_area grown = burnish_area_grown(label->area, 1);
    for (int i = 0; i < made->label_count; ++i) {
        if (burnish_areas_touch(&grown, &made->labels[i].area)) {
            return 1;
        }
    }
    for (int i = 0; i < made->line_count; ++i) {
        if (burnish_segment_hits(made->lines[i].a, made->lines[i].b, &grown)) {
            return 1;
        }
    }
    return 0;
}

/* The letter of an axis is beyond its end or, if that is not free, a little to the side or further
 * out. The letter of an axis that points to the viewer, or away, is next to the origin. */
static void push_letter(const burnish_annotation_view *view, int axis, burnish_point end,
                        mark *made) {
    static const double turns[][2] = {{1, 0},  {0.71, 0.71},  {0.71, -0.71},  {0, 1},
                                      {0, -1}, {-0.71, 0.71}, {-0.71, -0.71}, {-1, 0}};
    const char letter[2] = {(char)('X' + axis), 0};
    const double length = burnish_sqrt(end.x * end.x + end.y * end.y);
    const burnish_point d = length > 0.3 * view->text
                                ? (burnish_point){end.x / length, end.y / length}
                                : (burnish_point){-0.71, 0.71};
    burnish_annotation_label label = {.x = 0};
    for (int i = 0; i < 24; ++i) {
        const double *turn = turns[i % 8];
        const double out = (AXIS_LETTER + 0.4 * (i / 8)) * view->text;
        const burnish_point middle = {end.x + (d.x * turn[0] - d.y * turn[1]) * out,
                                      end.y + (d.y * turn[0] + d.x * turn[1]) * out};
        label = burnish_annotation_label_at(view, letter, middle,
                                            (burnish_annotation_layer)(BURNISH_LAYER_AXIS + axis));
        if (!is_taken(made, &label)) {
            push_label(made, &label);
            return;
        }
    }
}

static void add_axes(const burnish_annotation_view *view, burnish_annotation_list *list) {
    mark made = {.line_count = 0};
    burnish_point ends[3];
    int order[3] = {0, 1, 2};
    for (int i = 1; i < 3; ++i) { /* axes that point away first: nearer ones cover them */
        for (int k = i; k > 0 && burnish_axis(view->forward, order[k - 1]) <
                                     burnish_axis(view->forward, order[k]);
             --k) {
            const int swapped = order[k];
            order[k] = order[k - 1];
            order[k - 1] = swapped;
        }
    }
    for (int i = 0; i < 3; ++i) {
        const int axis = order[i];
        const double length = AXIS_LENGTH * view->text;
        ends[axis] = (burnish_point){burnish_axis(view->right, axis) * length,
                                     -burnish_axis(view->up, axis) * length};
        push_line(&made, (burnish_point){0, 0}, ends[axis], 1.5 * view->line,
                  (burnish_annotation_layer)(BURNISH_LAYER_AXIS + axis));
    }
    for (int axis = 0; axis < 3; ++axis) {
        push_letter(view, axis, ends[axis], &made);
    }
    settle_mark(view, &made, 0, list);
}

/* The distance of its ticks is exactly the length at which the camera shows that number of
 * units. */
static void add_scale(const burnish_annotation_view *view, burnish_annotation_list *list) {
    mark made = {.line_count = 0};
    char text[BURNISH_LABEL_SIZE];
    const double longest = BAR_LONGEST * view->width / view->pixels;
    if (!view->parallel || !(longest > 1e-300 && longest < 1e300)) {
        list->left_out += view->parallel;
        return;
    }
    const burnish_round_number number = burnish_round_number_below(longest);
    const double length = number.value * view->pixels, tick = TICK * view->text;
    burnish_number_text(number.value, text);
    push_line(&made, (burnish_point){0, 0}, (burnish_point){length, 0}, 2 * view->line,
              BURNISH_LAYER_LINES);
    for (int end = 0; end < 2; ++end) {
        const double x = end ? length : 0;
        push_line(&made, (burnish_point){x, -tick}, (burnish_point){x, tick}, view->line,
                  BURNISH_LAYER_LINES);
    }
    const burnish_point middle = {length / 2, -tick - (BAR_GAP + 0.5) * view->text};
    const burnish_annotation_label label =
        burnish_annotation_label_at(view, text, middle, BURNISH_LAYER_LINES);
    push_label(&made, &label);
    settle_mark(view, &made, 1, list);
}

static void add_spacing(const burnish_annotation_view *view, burnish_annotation_list *list) {
    const burnish_annotation_grid grid = burnish_annotation_grid_of(view);
    char number[BURNISH_LABEL_SIZE], text[BURNISH_LABEL_SIZE] = "grid ";
    mark made = {.line_count = 0};
    if (!grid.is_there) {
        return;
    }
    burnish_number_text(grid.spacing.value, number);
    memcpy(text + 5, number, strlen(number) < 20 ? strlen(number) + 1 : 1);
    const burnish_annotation_label label =
        burnish_annotation_label_at(view, text, (burnish_point){0, 0}, BURNISH_LAYER_LINES);
    push_label(&made, &label);
    settle_mark(view, &made, 2, list);
}

void burnish_annotate_marks(const burnish_annotation_view *view, burnish_annotation_flags kinds,
                            burnish_annotation_list *list) {
    if (kinds & BURNISH_ANNOTATION_AXES) {
        add_axes(view, list);
    }
    if (kinds & BURNISH_ANNOTATION_SCALE) {
        add_scale(view, list);
    }
    if (kinds & BURNISH_ANNOTATION_GRID) {
        add_spacing(view, list);
    }
}
