/* The public functions. Annotations are laid out, then drawn layer by layer into pixels or a
 * drawing. Framing only lays them out, to measure the room that they need. */
#include "annotate/annotate.h"

#include <string.h>

#include "base/layout.h"
#include "burnish/drawing.h"
#include "core/float_mode.h"
#include "core/srgb.h"
#include "image/pixels.h"
#include "image/text/drawing.h"
#include "image/text/text.h"

#define COOKIE BURNISH_COOKIE(0x414e4e31, burnish_annotate_options)

#define ARROW_HALF 0.17 /* half an arrow's width, in heights of a capital */

/* The largest share of the space between the margins that is taken on one side. */
#define LARGEST_INSET 0.3

enum { FITTING_STEPS = 12, SECTION_ATTEMPTS = 3 };

void burnish_annotate_options_init(burnish_annotate_options *options, uint64_t layout) {
    const burnish_annotate_options defaults = {.cookie = COOKIE, .background = {255, 255, 255}};
    burnish_layout_init(options, layout, BURNISH_LAYOUT(burnish_annotate_options), &defaults);
}

static burnish_status check_annotate(const burnish_mesh *mesh,
                                     const burnish_annotate_options *annotations, int width,
                                     int height, burnish_error *error) {
    const burnish_status status =
        burnish_layout_check(annotations, COOKIE, "annotations", "annotate_options", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (!mesh) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "annotations: no mesh; pass the one that was drawn");
    }
    if (annotations->kinds & ~(burnish_annotation_flags)BURNISH_ANNOTATION_ALL) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "annotations: kinds %u is not a sum of BURNISH_ANNOTATION_... values",
                            annotations->kinds);
    }
    if (annotations->lengths > 7) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "annotations: lengths %u is not a sum of 1, 2 and 4",
                            (unsigned)annotations->lengths);
    }
    if (annotations->text_height != 0 &&
        !(annotations->text_height >= 5 && annotations->text_height <= 256)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "annotations: text_height %g is not 0 or in [5, 256]",
                            annotations->text_height);
    }
    if (width < 1 || width > BURNISH_IMAGE_MAX_SIZE || height < 1 ||
        height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "annotations: %d x %d pixels; 1 to %d a side are expected", width,
                            height, BURNISH_IMAGE_MAX_SIZE);
    }
    const size_t stride = annotations->depth_stride;
    if (annotations->depth && (stride % 4 != 0 || stride / 4 < (size_t)width)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "annotations: a depth stride of %zu bytes for %d pixels; at least four "
                            "each, and a multiple of 4",
                            stride, width);
    }
    return BURNISH_STATUS_OK;
}

/* The marks of a section, whose arrows each attempt lengthens, and the dimensions. */
static void lay_out_lengths(const burnish_annotation_view *view, burnish_annotation_flags kinds,
                            int attempt, burnish_annotation_list *list) {
    list->line_count = list->label_count = list->left_out = 0;
    if (kinds & BURNISH_ANNOTATION_SECTION) {
        burnish_annotate_section(view, attempt, list);
    }
    if (kinds & BURNISH_ANNOTATION_DIMENSIONS) {
        burnish_annotate_dimensions(view, list);
    }
}

burnish_status burnish_annotation_lay_out(const burnish_annotation_view *view,
                                          burnish_annotation_flags kinds, int bounded,
                                          burnish_memory *memory, burnish_annotation_list *list) {
    const int attempts = kinds & BURNISH_ANNOTATION_SECTION ? SECTION_ATTEMPTS : 1;
    size_t least = SIZE_MAX;
    int best = 0;
    *list = (burnish_annotation_list){.bounded = bounded, .memory = memory};
    for (int i = 0; i < attempts && least > 0; ++i) {
        lay_out_lengths(view, kinds, i, list);
        best = list->left_out < least ? i : best;
        least = list->left_out < least ? list->left_out : least;
    }
    if (list->left_out > least) {
        lay_out_lengths(view, kinds, best, list);
    }
    if (view->callouts && view->callouts->count > 0) {
        burnish_annotate_parts_list(view, list);
    }
    if (kinds & BURNISH_ANNOTATION_HOLES && bounded) {
        burnish_annotate_holes(view, list);
    }
    burnish_annotate_marks(view, kinds, list);
    if (kinds & BURNISH_ANNOTATION_BOX) {
        burnish_annotate_box(view, list);
    }
    if (view->callouts && view->callouts->count > 0 && view->triangles) {
        burnish_annotate_balloons(view, list);
    }
    if (kinds & BURNISH_ANNOTATION_GRID) {
        burnish_annotate_grid(view, list);
    }
    return memory->status;
}

/* ---- Room ---- */

/* Pixels by which the layout exceeds the image: left, right, bottom, top. */
static void measure_overflow(const burnish_annotation_view *view,
                             const burnish_annotation_list *list, double overflow[4]) {
    const double border = 0.5 * view->text;
    const burnish_area all =
        burnish_annotation_bounds(list, (burnish_area){view->width, view->height, 0, 0}, 0);
    overflow[0] = border - all.left;
    overflow[1] = all.right - (view->width - border);
    overflow[2] = all.bottom - (view->height - border);
    overflow[3] = border - all.top;
}

/* A view of the mesh, and insets, which the steps improve. */
typedef struct fitting {
    const burnish_mesh *mesh;
    const burnish_annotate_options *annotations;
    burnish_framing framing;
    int width, height;
    double inset[4], limit[4];
    double floor;  /* of the bottom, where corners were crowded */
    int crowded;   /* the last layout had marks over the object */
    int for_marks; /* 1: the bottom is widened for them */
} fitting;

/* Widens insets that are too small and, until the last steps, reduces insets that are too large: a
 * smaller object needs less. Returns 0 if nothing changes. */
static int adjust_insets(const burnish_annotation_view *view, const burnish_annotation_list *list,
                         int step, fitting *fit) {
    const double smaller = view->width < view->height ? view->width : view->height;
    double missing[4];
    int changed = 0;
    measure_overflow(view, list, missing);
    fit->crowded = list->crowded > 0;
    if (fit->crowded && fit->for_marks) { /* a corner at the bottom becomes free */
        fit->floor = fit->inset[2] + 1.5 * view->text / smaller;
    }
    for (int k = 0; k < 4; ++k) {
        const double low = k == 2 ? fit->floor : 0;
        double wanted = fit->inset[k];
        if (missing[k] > 0.25 || (missing[k] < -1 && step < FITTING_STEPS - 3)) {
            wanted += (missing[k] > 0 ? 1 : 0.8) * missing[k] / smaller;
        }
        wanted = wanted > low ? wanted : low;
        wanted = wanted < fit->limit[k] ? wanted : fit->limit[k];
        changed |= wanted != fit->inset[k];
        fit->inset[k] = wanted;
    }
    return changed;
}

/* One step: frames with the current insets and measures what exceeds the image. */
static burnish_status try_inset(fitting *fit, int step, int *changed, burnish_error *error) {
    const burnish_annotate_options *annotations = fit->annotations;
    burnish_memory memory = burnish_memory_of(annotations->context, error);
    burnish_annotation_view view;
    burnish_annotation_list list;
    burnish_camera camera;
    memcpy(fit->framing.inset, fit->inset, sizeof fit->inset);
    burnish_status status = burnish_camera_frame(fit->mesh, &fit->framing, &camera, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_annotation_view_make(fit->mesh, annotations, &camera, fit->width,
                                              fit->height, &view, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    view.depth = NULL;
    view.triangles = NULL;
    if (view.callouts && step == 0) {
        burnish_list_parts(fit->mesh, &view, &memory);
    }
    status = burnish_annotation_lay_out(&view, annotations->kinds, 0, &memory, &list);
    *changed = status == BURNISH_STATUS_OK && adjust_insets(&view, &list, step, fit);
    burnish_annotation_release(&list);
    return status;
}

/* If no width of the bottom inset frees a corner for the marks, it is not widened for them. */
static burnish_status find_inset(const burnish_mesh *mesh,
                                 const burnish_annotate_options *annotations,
                                 const burnish_framing *framing, int width, int height,
                                 double inset[4], burnish_error *error) {
    const double smaller = framing->aspect < 1 ? framing->aspect : 1;
    fitting fit = {.mesh = mesh,
                   .annotations = annotations,
                   .framing = *framing,
                   .width = width,
                   .height = height,
                   .crowded = 1};
    burnish_status status = BURNISH_STATUS_OK;
    for (int k = 0; k < 4; ++k) {
        const double side = (k < 2 ? framing->aspect : 1) / smaller;
        const int has_list = (annotations->kinds & BURNISH_ANNOTATION_CALLOUTS) != 0;
        const double share = !has_list || k > 1 ? 1 : k == 1 ? 1.5 : 0.5;
        fit.limit[k] = share * LARGEST_INSET * (side - 2 * framing->margin);
        fit.limit[k] = fit.limit[k] < 0.45 ? fit.limit[k] : 0.45;
    }
    for (int for_marks = 1; for_marks >= 0 && fit.crowded; --for_marks) {
        int changed = 1;
        memset(fit.inset, 0, sizeof fit.inset);
        fit.floor = 0;
        fit.for_marks = for_marks;
        for (int step = 0; step < FITTING_STEPS && changed && status == BURNISH_STATUS_OK; ++step) {
            status = try_inset(&fit, step, &changed, error);
        }
    }
    memcpy(inset, fit.inset, sizeof fit.inset);
    return status;
}

burnish_status burnish_annotate_inset(const burnish_mesh *mesh,
                                      const burnish_annotate_options *annotations,
                                      const burnish_framing *framing, int width, int height,
                                      double inset[4], burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    burnish_status status = check_annotate(mesh, annotations, width, height, error);
    if (status == BURNISH_STATUS_OK && !framing) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "annotations: no framing; pass burnish_framing_default()");
    }
    if (status == BURNISH_STATUS_OK) {
        status = find_inset(mesh, annotations, framing, width, height, inset, error);
    }
    burnish_float_mode_leave(before);
    return status;
}

/* ---- Drawing ---- */

/* Colours of the layers and of the rim that keeps lines and letters clear of what they cross. */
typedef struct palette {
    uint8_t layers[BURNISH_LAYER_COUNT][3];
    float opacities[BURNISH_LAYER_COUNT];
    uint8_t rim[3];
    float rim_opacity;
} palette;

/* Relative luminance of WCAG 2.2. */
static double luminance(const uint8_t srgb[3]) {
    return 0.2126 * (double)burnish_srgb_to_linear[srgb[0]] +
           0.7152 * (double)burnish_srgb_to_linear[srgb[1]] +
           0.0722 * (double)burnish_srgb_to_linear[srgb[2]];
}

static double contrast(const uint8_t a[3], const uint8_t b[3]) {
    const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
    return x > y ? x / y : y / x;
}

static palette choose_palette(const burnish_annotate_options *annotations) {
    static const uint8_t inks[2][3] = {{34, 36, 40}, {242, 243, 245}};
    static const uint8_t axes[2][3][3] = {{{196, 30, 36}, {16, 122, 44}, {28, 76, 214}},
                                          {{255, 128, 118}, {120, 226, 128}, {140, 180, 255}}};
    static const uint8_t white[3] = {255, 255, 255};
    const uint8_t *ground = annotations->transparent ? white : annotations->background;
    const int light = contrast(inks[1], ground) > contrast(inks[0], ground);
    palette made = {.rim_opacity = 0.9F};
    memcpy(made.rim, ground, sizeof made.rim);
    for (int layer = 0; layer < BURNISH_LAYER_COUNT; ++layer) {
        memcpy(made.layers[layer], inks[light], sizeof made.layers[layer]);
        made.opacities[layer] = 1;
    }
    made.opacities[BURNISH_LAYER_GRID] = light ? 0.2F : 0.36F;
    made.opacities[BURNISH_LAYER_HIDDEN] = 0.55F;
    for (int axis = 0; axis < 3; ++axis) {
        const int pale = contrast(axes[1][axis], ground) > contrast(axes[0][axis], ground);
        memcpy(made.layers[BURNISH_LAYER_AXIS + axis], axes[pale][axis], 3);
    }
    return made;
}

/* The middle of whole pixels, or the border between two, for a line of that width. */
static float snapped_to_pixels(float value, float width) {
    const int odd = (int)(width + 0.5F) % 2;
    const float half = odd ? 0.5F : 0;
    return (float)(int)(value - half + 16384.5F) - 16384 + half;
}

/* Lines along rows or columns are as sharp as pixels can be, at most half a pixel off. */
static burnish_stroke sharpened_stroke(burnish_stroke stroke) {
    const float dx = stroke.x1 - stroke.x0, dy = stroke.y1 - stroke.y0;
    if (dx > -0.01F && dx < 0.01F && stroke.x0 > -16384 && stroke.x0 < 32768) {
        stroke.x0 = stroke.x1 = snapped_to_pixels(stroke.x0, 2 * stroke.radius);
    } else if (dy > -0.01F && dy < 0.01F && stroke.y0 > -16384 && stroke.y0 < 32768) {
        stroke.y0 = stroke.y1 = snapped_to_pixels(stroke.y0, 2 * stroke.radius);
    }
    return stroke;
}

/* By a right angle about the middle of an area. */
static burnish_stroke turned_stroke(burnish_stroke s, const burnish_area *area) {
    const float x = (float)((area->left + area->right) / 2);
    const float y = (float)((area->top + area->bottom) / 2);
    return (burnish_stroke){x + (s.y0 - y), y - (s.x0 - x), x + (s.y1 - y), y - (s.x1 - x),
                            s.radius};
}

/* The strokes of a layer, or of LINES and all after it, each thickened by `rim` on both sides. */
static void gather_strokes(const burnish_annotation_list *list, int first, int last, float rim,
                           burnish_stroke_list *to) {
    to->count = 0;
    for (size_t i = 0; i < list->line_count; ++i) {
        if ((int)list->lines[i].layer >= first && (int)list->lines[i].layer <= last) {
            const burnish_stroke sharpened = sharpened_stroke(list->lines[i].stroke);
            burnish_stroke_list_append(to, &sharpened, 1);
        }
    }
    for (size_t i = 0; i < list->label_count; ++i) {
        const burnish_annotation_label *label = &list->labels[i];
        if ((int)label->layer >= first && (int)label->layer <= last) {
            const size_t from = to->count;
            burnish_text_strokes((float)label->x, (float)label->baseline, (float)label->height,
                                 label->text, strlen(label->text), burnish_stroke_list_append, to);
            for (size_t k = from; k < to->count && label->is_turned; ++k) {
                to->items[k] = turned_stroke(to->items[k], &label->area);
            }
        }
    }
    for (size_t i = 0; i < to->count; ++i) {
        to->items[i].radius += rim;
    }
}

/* What is drawn over: one of them. */
typedef struct canvas {
    const burnish_pixels *pixels;
    burnish_drawing *drawing;
    int width, height;
} canvas;

/* A layer of a drawing: its lines, then each label as a path with its text as attribute. */
static void add_layer(const burnish_annotation_list *list, int first, int last, float rim,
                      burnish_stroke_list *figure, burnish_drawing *drawing) {
    burnish_annotation_list part = *list;
    part.label_count = 0;
    gather_strokes(&part, first, last, rim, figure);
    burnish_drawing_strokes(drawing, figure->items, figure->count, NULL);
    part.line_count = 0;
    part.label_count = 1;
    for (size_t i = 0; i < list->label_count; ++i) {
        part.labels = &list->labels[i];
        gather_strokes(&part, first, last, rim, figure);
        burnish_drawing_strokes(drawing, figure->items, figure->count,
                                rim > 0 ? NULL : list->labels[i].text);
    }
}

/* Layer by layer, the rim before lines and axes. */
static burnish_status draw_list(const burnish_annotation_view *view,
                                const burnish_annotation_list *list, const palette *colors,
                                const canvas *to, burnish_memory *memory) {
    burnish_stroke_list figure = {.memory = memory};
    burnish_status status = BURNISH_STATUS_OK;
    for (int layer = 0; layer <= BURNISH_LAYER_COUNT && status == BURNISH_STATUS_OK; ++layer) {
        const int is_rim = layer == BURNISH_LAYER_LINES;
        const int shown = layer > BURNISH_LAYER_LINES ? layer - 1 : layer;
        const int first = is_rim ? BURNISH_LAYER_LINES : shown;
        const int last = is_rim ? BURNISH_LAYER_COUNT - 1 : shown;
        const float rim = is_rim ? (float)(view->line + view->text / 12) : 0;
        const uint8_t *color = is_rim ? colors->rim : colors->layers[shown];
        const float opacity = is_rim ? colors->rim_opacity : colors->opacities[shown];
        gather_strokes(list, first, last, rim, &figure);
        if (to->drawing && figure.count > 0) {
            burnish_drawing_open(to->drawing, color, opacity);
            add_layer(list, first, last, rim, &figure, to->drawing);
            burnish_drawing_close(to->drawing);
            burnish_memory_join(memory, &to->drawing->memory);
        }
        status = memory->status;
        if (status == BURNISH_STATUS_OK && to->pixels) {
            const burnish_ink ink = burnish_ink_of(color, opacity);
            status =
                burnish_strokes_draw(to->pixels, figure.items, figure.count, &ink, NULL, memory);
        }
    }
    burnish_release(memory->context, figure.items);
    return status;
}

static burnish_status annotate_image(const burnish_mesh *mesh,
                                     const burnish_annotate_options *annotations,
                                     const burnish_camera *camera, const canvas *to,
                                     size_t *left_out, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(annotations->context, error);
    burnish_annotation_view view;
    burnish_annotation_list list;
    const palette colors = choose_palette(annotations);
    burnish_status status = burnish_annotation_view_make(mesh, annotations, camera, to->width,
                                                         to->height, &view, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (view.callouts) {
        burnish_list_parts(mesh, &view, &memory);
    }
    status = burnish_annotation_lay_out(&view, annotations->kinds, 1, &memory, &list);
    if (status == BURNISH_STATUS_OK) {
        status = draw_list(&view, &list, &colors, to, &memory);
    }
    if (left_out) {
        *left_out = list.left_out;
    }
    burnish_annotation_release(&list);
    return status;
}

/* Both doors: what to draw over has a size, 0 where there is none. */
static burnish_status annotate_canvas(const burnish_mesh *mesh,
                                      const burnish_annotate_options *annotations,
                                      const burnish_camera *camera, const canvas *to,
                                      size_t *left_out, burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    burnish_status status = check_annotate(mesh, annotations, to->width, to->height, error);
    if (status == BURNISH_STATUS_OK && !camera) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "annotations: no camera; pass the one of the picture");
    }
    if (status == BURNISH_STATUS_OK) {
        status = annotate_image(mesh, annotations, camera, to, left_out, error);
    }
    burnish_float_mode_leave(before);
    return status;
}

burnish_status burnish_annotate(const burnish_mesh *mesh,
                                const burnish_annotate_options *annotations,
                                const burnish_camera *camera, const burnish_pixels *pixels,
                                size_t *left_out, burnish_error *error) {
    const canvas to = {.pixels = pixels,
                       .width = pixels ? pixels->width : 0,
                       .height = pixels ? pixels->height : 0};
    return annotate_canvas(mesh, annotations, camera, &to, left_out, error);
}

burnish_status burnish_annotate_drawing(const burnish_mesh *mesh,
                                        const burnish_annotate_options *annotations,
                                        const burnish_camera *camera, burnish_drawing *drawing,
                                        size_t *left_out, burnish_error *error) {
    canvas to = {.drawing = drawing};
    if (drawing) {
        burnish_drawing_use(drawing, error);
        to.width = drawing->width;
        to.height = drawing->height;
    }
    return annotate_canvas(mesh, annotations, camera, &to, left_out, error);
}

/* ---- The list of lines and labels ---- */

void burnish_annotation_add_line(burnish_annotation_list *list, burnish_point a, burnish_point b,
                                 double width, burnish_annotation_layer layer) {
    list->lines = burnish_reserve(list->memory, list->lines, &list->line_capacity,
                                  list->line_count + 1, sizeof *list->lines, "annotations");
    if (list->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    list->lines[list->line_count++] = (burnish_annotation_line){
        {(float)a.x, (float)a.y, (float)b.x, (float)b.y, (float)(width / 2)}, layer};
}

void burnish_annotation_add_label(burnish_annotation_list *list,
                                  const burnish_annotation_label *label) {
    list->labels = burnish_reserve(list->memory, list->labels, &list->label_capacity,
                                   list->label_count + 1, sizeof *list->labels, "annotations");
    if (list->memory->status == BURNISH_STATUS_OK) {
        list->labels[list->label_count++] = *label;
    }
}

void burnish_annotation_release(burnish_annotation_list *list) {
    burnish_release(list->memory->context, list->lines);
    burnish_release(list->memory->context, list->labels);
}

void burnish_annotation_add_arrow(const burnish_annotation_view *view, burnish_point tip,
                                  burnish_point d, burnish_annotation_list *list) {
    const double half = ARROW_HALF * view->text, width = half > 1.5 ? 0.8 * half : view->line;
    const burnish_point across = {d.y, -d.x}, start = burnish_moved_along(tip, d, view->line / 2);
    const burnish_point base = burnish_moved_along(tip, d, BURNISH_ARROW_LENGTH * view->text);
    for (int i = -2; i <= 2; ++i) {
        burnish_annotation_add_line(list, start, burnish_moved_along(base, across, half * i / 2),
                                    width, BURNISH_LAYER_LINES);
    }
}

void burnish_annotation_take(burnish_annotation_list *list, const burnish_annotation_list *made,
                             burnish_point by) {
    for (size_t i = 0; i < made->line_count; ++i) {
        const burnish_stroke *s = &made->lines[i].stroke;
        burnish_annotation_add_line(list,
                                    (burnish_point){(double)s->x0 + by.x, (double)s->y0 + by.y},
                                    (burnish_point){(double)s->x1 + by.x, (double)s->y1 + by.y},
                                    2 * (double)s->radius, made->lines[i].layer);
    }
    for (size_t i = 0; i < made->label_count; ++i) {
        burnish_annotation_label label = made->labels[i];
        label.x += by.x;
        label.baseline += by.y;
        label.area = burnish_area_moved(label.area, by);
        burnish_annotation_add_label(list, &label);
    }
}

void burnish_area_widen(burnish_area *all, burnish_area area) {
    all->left = area.left < all->left ? area.left : all->left;
    all->top = area.top < all->top ? area.top : all->top;
    all->right = area.right > all->right ? area.right : all->right;
    all->bottom = area.bottom > all->bottom ? area.bottom : all->bottom;
}

burnish_area burnish_annotation_bounds(const burnish_annotation_list *list, burnish_area area,
                                       int with_width) {
    for (size_t i = 0; i < list->line_count; ++i) {
        const burnish_stroke *s = &list->lines[i].stroke;
        const double x0 = (double)s->x0, y0 = (double)s->y0, x1 = (double)s->x1, y1 = (double)s->y1;
        const double half = with_width ? (double)s->radius : 0;
        burnish_area_widen(&area, burnish_area_grown((burnish_area){x0, y0, x0, y0}, half));
        burnish_area_widen(&area, burnish_area_grown((burnish_area){x1, y1, x1, y1}, half));
    }
    for (size_t i = 0; i < list->label_count; ++i) {
        burnish_area_widen(&area, list->labels[i].area);
    }
    return area;
}

double burnish_whole_pixel(double value) {
    if (!(value > -0x1p52 && value < 0x1p52)) {
        return value;
    }
    return value < 0 ? -(double)(int64_t)(0.5 - value) : (double)(int64_t)(value + 0.5);
}

burnish_annotation_label burnish_annotation_label_at(const burnish_annotation_view *view,
                                                     const char *text, burnish_point middle,
                                                     burnish_annotation_layer layer) {
    static const uint8_t unused[3] = {0};
    burnish_annotation_label label = {.layer = layer, .height = view->text};
    const size_t length = strlen(text);
    memcpy(label.text, text, length + 1);
    const double width =
        burnish_text_draw(NULL, 0, 0, (float)view->text, unused, label.text, length);
    label.x = burnish_whole_pixel(middle.x - width / 2);
    label.baseline = burnish_whole_pixel(middle.y + view->text / 2);
    label.area =
        (burnish_area){label.x, label.baseline - view->text, label.x + width, label.baseline};
    return label;
}

int burnish_annotation_hits_label(const burnish_annotation_list *list, burnish_point a,
                                  burnish_point b, double clear) {
    int hits = 0;
    for (size_t i = 0; i < list->label_count; ++i) {
        const burnish_area area = burnish_area_grown(list->labels[i].area, clear);
        hits |= burnish_segment_hits(a, b, &area);
    }
    return hits;
}

int burnish_annotation_is_free(const burnish_annotation_list *list, const burnish_area *area) {
    for (size_t i = 0; i < list->label_count; ++i) {
        if (burnish_areas_touch(area, &list->labels[i].area)) {
            return 0;
        }
    }
    for (size_t i = 0; i < list->mark_count; ++i) {
        if (burnish_areas_touch(area, &list->marks[i])) {
            return 0;
        }
    }
    for (size_t i = 0; i < list->line_count; ++i) {
        const burnish_stroke *s = &list->lines[i].stroke;
        const burnish_area reach = burnish_area_grown(*area, (double)s->radius);
        if (burnish_segment_hits((burnish_point){(double)s->x0, (double)s->y0},
                                 (burnish_point){(double)s->x1, (double)s->y1}, &reach)) {
            return 0;
        }
    }
    return 1;
}
