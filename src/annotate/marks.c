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

enum { CORNERS = 6 };

/* ---- Corners ---- */

static burnish_point corner_shift(const burnish_annotation_view *view, const burnish_area *area,
                                  int corner) {
    const double border = BORDER * view->text;
    const double left = border - area->left, right = view->width - border - area->right;
    const double top = border - area->top, bottom = view->height - border - area->bottom;
    const double x = corner > 3 ? (left + right) / 2 : corner & 1 ? right : left;
    const double y = corner == 2 || corner == 3 || corner == 5 ? top : bottom;
    return (burnish_point){burnish_whole_pixel(x), burnish_whole_pixel(y)}; /* labels are on them */
}

static int fits_mark(const burnish_annotation_view *view, const burnish_annotation_list *list,
                     const burnish_area *area, int beside_object) {
    const burnish_area grown = burnish_area_grown(*area, 0.4 * view->text);
    return area->left >= 0 && area->top >= 0 && area->right <= view->width &&
           area->bottom <= view->height && burnish_annotation_is_free(list, &grown) &&
           !(beside_object && view->corners_seen && burnish_annotation_hits_hull(view, &grown));
}

/* Moves a mark into the first free corner, from `preferred` on. If there is none, the mark can
 * overlap the object. */
static void settle_mark(const burnish_annotation_view *view, burnish_annotation_list *made,
                        int preferred, burnish_annotation_list *list) {
    const burnish_area nothing = BURNISH_AREA_NONE;
    const burnish_area own = burnish_annotation_bounds(made, nothing, 1);
    int is_settled = 0;
    for (int beside_object = 1; beside_object >= 0 && !is_settled; --beside_object) {
        for (int i = 0; i < CORNERS && !is_settled; ++i) {
            const int corner = i < 4 ? i ^ preferred : i;
            const burnish_point by = corner_shift(view, &own, corner);
            const burnish_area area = burnish_area_moved(own, by);
            if (fits_mark(view, list, &area, beside_object)) {
                list->crowded += !beside_object;
                burnish_annotation_take(list, made, by);
                list->marks[list->mark_count++] = area;
                is_settled = 1;
            }
        }
    }
    list->crowded += !is_settled;
    list->left_out += !is_settled && made->label_count > 0;
    burnish_release(made->memory->context, made->lines);
}

/* ---- The marks ---- */

/* The letter of an axis is beyond its end or, if that is not free, a little to the side or further
 * out. The letter of an axis that points to the viewer, or away, is next to the origin. */
static void push_letter(const burnish_annotation_view *view, int axis, burnish_point end,
                        burnish_annotation_list *made) {
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
        const burnish_area grown = burnish_area_grown(label.area, 1);
        if (burnish_annotation_is_free(made, &grown)) {
            made->labels[made->label_count++] = label;
            return;
        }
    }
}

static void add_axes(const burnish_annotation_view *view, burnish_annotation_list *list) {
    burnish_annotation_label labels[3];
    burnish_annotation_list made = {.labels = labels, .memory = list->memory};
    burnish_point ends[3];
    const double away[3] = {view->forward.x, view->forward.y, view->forward.z};
    int order[3];
    burnish_order_axes(away, order); /* axes that point away first: nearer ones cover them */
    for (int i = 0; i < 3; ++i) {
        const int axis = order[i];
        const double length = AXIS_LENGTH * view->text;
        ends[axis] = (burnish_point){burnish_axis(view->right, axis) * length,
                                     -burnish_axis(view->up, axis) * length};
        burnish_annotation_add_line(&made, (burnish_point){0, 0}, ends[axis], 1.5 * view->line,
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
    burnish_annotation_label label;
    burnish_annotation_list made = {.labels = &label, .memory = list->memory};
    char text[BURNISH_LABEL_SIZE];
    const double longest = BAR_LONGEST * view->width / view->pixels;
    if (!view->parallel || !(longest > 1e-300 && longest < 1e300)) {
        list->left_out += view->parallel;
        return;
    }
    const burnish_round_number number = burnish_round_number_below(longest);
    const double length = number.value * view->pixels, tick = TICK * view->text;
    burnish_number_text(number.value, text);
    burnish_annotation_add_line(&made, (burnish_point){0, 0}, (burnish_point){length, 0},
                                2 * view->line, BURNISH_LAYER_LINES);
    for (int end = 0; end < 2; ++end) {
        const double x = end ? length : 0;
        burnish_annotation_add_line(&made, (burnish_point){x, -tick}, (burnish_point){x, tick},
                                    view->line, BURNISH_LAYER_LINES);
    }
    const burnish_point middle = {length / 2, -tick - (BAR_GAP + 0.5) * view->text};
    made.labels[made.label_count++] =
        burnish_annotation_label_at(view, text, middle, BURNISH_LAYER_LINES);
    settle_mark(view, &made, 1, list);
}

static void add_spacing(const burnish_annotation_view *view, burnish_annotation_list *list) {
    const burnish_annotation_grid grid = burnish_annotation_grid_of(view);
    char number[BURNISH_LABEL_SIZE], text[BURNISH_LABEL_SIZE] = "grid ";
    burnish_annotation_label label;
    burnish_annotation_list made = {.labels = &label, .memory = list->memory};
    if (!grid.is_there) {
        return;
    }
    burnish_number_text(grid.spacing.value, number);
    memcpy(text + 5, number, strlen(number) < 20 ? strlen(number) + 1 : 1);
    made.labels[made.label_count++] =
        burnish_annotation_label_at(view, text, (burnish_point){0, 0}, BURNISH_LAYER_LINES);
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
