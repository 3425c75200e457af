/* Annotations: numbers, lengths on the screen, and that nothing overlaps. */
#include <locale.h>
#include <math.h>

#include "annotate/annotate.h"
#include "burnish/render.h"
#include "decimal_comma.h"
#include "images.h"
#include "shapes.h"

/* The surface of an axis-aligned block. */
static burnish_mesh *block(const float low[3], const float high[3], const float up[3]) {
    shape s = {.point_count = 0};
    add_box(&s, (double[]){low[0], low[1], low[2]}, (double[]){high[0], high[1], high[2]});
    burnish_mesh_description arrays = describe_arrays(s.points, NULL, NULL, 8, s.corners, 12);
    memcpy(arrays.up_axis, up, sizeof arrays.up_axis);
    return create_mesh(&arrays, NULL);
}

static burnish_mesh *block_of(float x, float y, float z) {
    return block((const float[3]){0, 0, 0}, (const float[3]){x, y, z}, (const float[3]){0, 0, 1});
}

static void test_numbers(void) {
    static const double values[] = {0,        1,         10,        0.1F,       12.5,    304.79999,
                                    123.449,  1234.4,    9999.7,    1e9,        12345.6, 0.0001,
                                    12345678, 123456789, 0.0123456, 0.00001234, 3e38,    1e-30};
    static const char *const texts[] = {"0",         "1",      "10",       "0.1",       "12.5",
                                        "304.8",     "123.4",  "1234",     "10000",     "1e+09",
                                        "12346",     "0.0001", "12345678", "1.235e+08", "0.01235",
                                        "1.234e-05", "3e+38",  "1e-30"};
    char text[BURNISH_LABEL_SIZE];
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        burnish_number_text(values[i], text);
        CHECK_TEXT(text, texts[i]);
    }
    if (test_decimal_comma_begin()) {
        burnish_number_text(12.5, text);
        CHECK_TEXT(text, "12.5");
        test_decimal_comma_end();
    }
}

static void test_round_numbers(void) {
    uint64_t random = test_seed(1);
    for (int i = 0; i < 2000; ++i) {
        const double limit = pow(10, 60 * test_uniform(&random, 0, 1) - 30);
        const burnish_round_number below = burnish_round_number_below(limit);
        const burnish_round_number above = burnish_round_number_above(limit);
        CHECK(below.value <= limit && below.value * 2.5 > limit * (1 - 1e-12), "%g below %g",
              below.value, limit);
        CHECK(above.value >= limit && above.value < limit * 2.5 * (1 + 1e-12), "%g above %g",
              above.value, limit);
        CHECK1(below.digit == 1 || below.digit == 2 || below.digit == 5);
    }
    CHECK1(burnish_round_number_below(0.2).value == 0.2 &&
           burnish_round_number_above(0.2).value == 0.2);
    CHECK1(burnish_round_number_below(1000).value == 1000 &&
           burnish_round_number_above(501).value == 1000);
}

/* A layout to look at. */
typedef struct laid_out {
    burnish_annotation_view view;
    burnish_annotation_list list;
    burnish_memory memory;
    burnish_camera camera;
    burnish_callouts callouts;
} laid_out;

static void lay_out(const burnish_mesh *mesh, burnish_framing framing,
                    burnish_annotation_flags kinds, int width, int height, laid_out *made) {
    burnish_annotate_options annotations = burnish_annotate_options_default();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    annotations.kinds = kinds;
    annotations.callouts = &made->callouts;
    framing.aspect = (double)width / height;
    CHECK_OK(
        burnish_annotate_inset(mesh, &annotations, &framing, width, height, framing.inset, &error),
        error);
    CHECK_OK(burnish_camera_frame(mesh, &framing, &made->camera, &error), error);
    CHECK_OK(burnish_annotation_view_make(mesh, &annotations, &made->camera, width, height,
                                          &made->view, &error),
             error);
    made->memory = burnish_memory_of(NULL, &error);
    CHECK1(burnish_annotation_lay_out(&made->view, kinds, 1, &made->memory, &made->list) ==
           BURNISH_STATUS_OK);
}

static void drop(laid_out *made) {
    burnish_annotation_release(&made->list);
}

static const burnish_annotation_label *find_label(const laid_out *made, const char *text) {
    for (size_t i = 0; i < made->list.label_count; ++i) {
        if (strcmp(made->list.labels[i].text, text) == 0) {
            return &made->list.labels[i];
        }
    }
    return NULL;
}

/* The bar's length in pixels is its number times pixels per unit. */
static void test_scale_bar(void) {
    static const double heights[] = {0.37, 1, 12, 55, 1234, 4e6, 3e-4};
    burnish_mesh *mesh = block_of(10, 5, 3);
    for (size_t i = 0; i < sizeof heights / sizeof *heights; ++i) {
        for (int width = 60; width < 2000; width = width * 7 / 3) {
            laid_out made;
            burnish_framing framing = burnish_framing_default();
            double longest = 0, widest = 0;
            framing.orthographic_height = heights[i];
            lay_out(mesh, framing, BURNISH_ANNOTATION_SCALE, width, 500, &made);
            for (size_t k = 0; k < made.list.line_count; ++k) {
                const burnish_stroke *s = &made.list.lines[k].stroke;
                if ((double)s->radius > widest) {
                    widest = (double)s->radius;
                    longest = (double)s->x1 - (double)s->x0;
                }
            }
            if (CHECK1(made.list.label_count == 1)) {
                const double number = strtod(made.list.labels[0].text, NULL);
                CHECK(fabs(longest - number * 500 / heights[i]) < 1e-3, "%g pixels for %g of %g",
                      longest, number, heights[i]);
                CHECK(longest <= 0.22 * width + 1e-3 && longest > 0.08 * width,
                      "%g pixels of a picture of %d", longest, width);
            }
            drop(&made);
        }
    }
    burnish_mesh_destroy(mesh);
}

static int has_line(const laid_out *made, double x0, double y0, double x1, double y1) {
    for (size_t i = 0; i < made->list.line_count; ++i) {
        const burnish_stroke *s = &made->list.lines[i].stroke;
        if (fabs((double)s->x0 - x0) < 0.01 && fabs((double)s->y0 - y0) < 0.01 &&
            fabs((double)s->x1 - x1) < 0.01 && fabs((double)s->y1 - y1) < 0.01) {
            return 1;
        }
    }
    return 0;
}

/* Numbers are the box's lengths; a dimension line ends exactly beyond the box's projected corners,
 * and extension lines lead there. */
static void test_dimensions(void) {
    static const struct {
        double direction[3];
        const char *texts[3];
    } cases[] = {{{0, 1, 0}, {"40", "10.12", NULL}},
                 {{-1, 0, 0}, {"20.5", "10.12", NULL}},
                 {{0, 0, -1}, {"40", "20.5", NULL}},
                 {{-1, 1, -1}, {"40", "20.5", "10.12"}},
                 {{-0.3, 1, -0.4}, {"40", "20.5", "10.12"}}};
    burnish_mesh *mesh = block((const float[3]){-3, 7, 100}, (const float[3]){37, 27.5F, 110.125F},
                               (const float[3]){0, 0, 1});
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        laid_out made;
        burnish_framing framing = burnish_framing_default();
        memcpy(framing.direction, cases[i].direction, sizeof framing.direction);
        framing.orthographic = 1;
        lay_out(mesh, framing, BURNISH_ANNOTATION_DIMENSIONS, 640, 480, &made);
        size_t expected = 0;
        for (; expected < 3 && cases[i].texts[expected]; ++expected) {
            CHECK(find_label(&made, cases[i].texts[expected]) != NULL, "case %zu: no %s", i,
                  cases[i].texts[expected]);
        }
        CHECK1(made.list.label_count == expected && made.list.left_out == 0);
        drop(&made);
    }
    laid_out made;
    burnish_framing framing = burnish_framing_default();
    framing.direction[1] = 1;
    framing.orthographic_height = 60; /* 10 pixels a unit */
    lay_out(mesh, framing, BURNISH_ANNOTATION_DIMENSIONS, 800, 600, &made);
    const double left = made.view.corners[0].x, right = made.view.corners[1].x;
    const double bottom = made.view.corners[0].y, text = made.view.text;
    CHECK(fabs(right - left - 400) < 1e-9, "40 units are %g pixels", right - left);
    CHECK1(has_line(&made, left, bottom + 0.35 * text, left, bottom + (1.7 + 0.45) * text));
    CHECK1(has_line(&made, right, bottom + 0.35 * text, right, bottom + (1.7 + 0.45) * text));
    const burnish_annotation_label *label = find_label(&made, "40");
    CHECK1(label && fabs((label->area.left + label->area.right) / 2 - (left + right) / 2) <= 1);
    drop(&made);
    burnish_mesh_destroy(mesh);
}

/* Labels keep clear of each other, of all lines but the grid's and the box's, of the object and of
 * the picture's edge. */
static void check_apart(const laid_out *made, const char *what, int in_perspective) {
    const burnish_annotation_list *list = &made->list;
    for (size_t i = 0; i < list->label_count; ++i) {
        const burnish_annotation_label *label = &list->labels[i];
        const burnish_area area = burnish_area_grown(label->area, -0.01);
        CHECK(area.left >= 0 && area.top >= 0 && area.right <= made->view.width &&
                  area.bottom <= made->view.height,
              "%s: %s leaves the picture", what, label->text);
        for (size_t k = 0; k < i; ++k) {
            CHECK(!burnish_areas_touch(&area, &list->labels[k].area), "%s: %s on %s", what,
                  label->text, list->labels[k].text);
        }
        for (size_t k = 0; k < list->line_count; ++k) {
            const burnish_stroke *s = &list->lines[k].stroke;
            const burnish_point a = {(double)s->x0, (double)s->y0};
            const burnish_point b = {(double)s->x1, (double)s->y1};
            CHECK(list->lines[k].layer < BURNISH_LAYER_LINES || !burnish_segment_hits(a, b, &area),
                  "%s: a line through %s", what, label->text);
        }
        CHECK(list->crowded || !burnish_annotation_hits_hull(&made->view, &area),
              "%s: %s lies on the object (perspective: %d)", what, label->text, in_perspective);
    }
}

static void test_nothing_overlaps(void) {
    uint64_t random = test_seed(7);
    size_t left_out = 0, shown = 0;
    for (int i = 0; i < 400; ++i) {
        float low[3], high[3];
        const float up[3] = {i % 3 == 0, i % 3 == 1, i % 3 == 2};
        for (int k = 0; k < 3; ++k) {
            const double middle = 100 * test_uniform(&random, 0, 1) - 50;
            const double extent = pow(10, 3 * test_uniform(&random, 0, 1) - 1.5);
            low[k] = (float)(middle - extent);
            high[k] = (float)(middle + extent);
        }
        burnish_mesh *mesh = block(low, high, up);
        burnish_framing framing = burnish_framing_default();
        laid_out made;
        char what[80];
        const int width = 150 + (int)(900 * test_uniform(&random, 0, 1));
        const int height = 150 + (int)(900 * test_uniform(&random, 0, 1));
        framing.orthographic = i % 4 != 0;
        if (i % 5 == 0) {
            framing.direction[i / 5 % 3] = i / 15 % 2 ? 1 : -1;
        } else {
            framing.azimuth = 360 * test_uniform(&random, 0, 1);
            framing.elevation = 180 * test_uniform(&random, 0, 1) - 110;
        }
        lay_out(mesh, framing, i % 2 ? BURNISH_ANNOTATION_ALL : BURNISH_ANNOTATION_DIMENSIONS,
                width, height, &made);
        snprintf(what, sizeof what, "scene %d, %d x %d", i, width, height);
        check_apart(&made, what, !framing.orthographic);
        left_out += made.list.left_out;
        shown += made.list.label_count;
        drop(&made);
        burnish_mesh_destroy(mesh);
    }
    CHECK(left_out * 50 < shown, "%zu left out, %zu shown", left_out, shown);
}

/* ---- Callouts ---- */

enum { BOXES_MAX = 40 };

/* An OBJ file of boxes, each a part. Every third is a screw, of which all but the first are equal. */
static burnish_mesh *boxes_of(uint64_t *random, int count) {
    static char text[BOXES_MAX * 600];
    size_t used = 0;
    for (int i = 0; i < count; ++i) {
        double low[3], size[3];
        used += (size_t)sprintf(text + used, i % 3 ? "o %d box\n" : "o screw.%d\n", i + 1);
        for (int k = 0; k < 3; ++k) {
            low[k] = floor(test_uniform(random, 0, 60));
            size[k] = i % 3 ? 1 + floor(test_uniform(random, 0, 12)) : i == 0 ? 3 : 2;
        }
        for (int k = 0; k < 8; ++k) {
            used += (size_t)sprintf(text + used, "v %g %g %g\n", low[0] + (k & 1) * size[0],
                                    low[1] + (k >> 1 & 1) * size[1], low[2] + (k >> 2) * size[2]);
        }
        used += (size_t)sprintf(text + used, "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\n"
                                             "f -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n");
    }
    return load_bytes(text, used, "boxes.obj", NULL);
}

/* 1: q and r are on different sides of the line from a to b. */
static int parts_points(burnish_point a, burnish_point b, burnish_point q, burnish_point r) {
    return burnish_cross_of_points(a, b, q) * burnish_cross_of_points(a, b, r) < 0;
}

/* Leaders start within their parts and do not cross; balloons are apart from each other and from the
 * object. Returns how many there are. */
static size_t check_balloons(const laid_out *made, const burnish_mesh *mesh) {
    burnish_point starts[BURNISH_BALLOONS_MAX], middles[BURNISH_BALLOONS_MAX];
    const double radius = made->view.text; /* less than a balloon's */
    const int width = (int)made->view.width;
    size_t count = 0;
    for (size_t i = 0; i < made->list.label_count; ++i) {
        const burnish_area *area = &made->list.labels[i].area;
        if (area->right < made->list.marks[0].left) { /* not of the list */
            const burnish_callout *item =
                &made->callouts.items[atoi(made->list.labels[i].text) - 1];
            const uint32_t id = made->view.triangles[item->y * width + item->x];
            const size_t part = burnish_mesh_get_view(mesh)->triangle_parts[id];
            CHECK1(part == item->part || (item->part == 3 && part % 3 == 0));
            starts[count] = (burnish_point){item->x + 0.5, item->y + 0.5};
            middles[count++] =
                (burnish_point){(area->left + area->right) / 2, (area->top + area->bottom) / 2};
        }
    }
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < i; ++k) {
            CHECK1(hypot(middles[i].x - middles[k].x, middles[i].y - middles[k].y) > 2 * radius);
            CHECK1(!parts_points(starts[i], middles[i], starts[k], middles[k]) ||
                   !parts_points(starts[k], middles[k], starts[i], middles[i]));
        }
        for (int at = 0; at < width * (int)made->view.height; ++at) {
            if (hypot(at % width - middles[i].x, at / width - middles[i].y) < radius) {
                CHECK1(made->view.triangles[at] == BURNISH_TRIANGLE_NONE);
            }
        }
    }
    return count;
}

/* Entries list all parts, equal ones together. */
static void test_callouts(void) {
    enum { WIDTH = 600, HEIGHT = 450 };
    static uint32_t ids[WIDTH * HEIGHT];
    uint64_t random = test_seed(11);
    size_t visible = 0, shown = 0;
    burnish_renderer *renderer = NULL;
    CHECK1(burnish_renderer_create(NULL, &renderer, NULL) == BURNISH_STATUS_OK);
    for (int i = 0; i < 40; ++i) {
        const int boxes = 7 + (int)test_uniform(&random, 0, BOXES_MAX - 7);
        burnish_mesh *mesh = boxes_of(&random, boxes);
        burnish_framing framing = burnish_framing_default();
        burnish_render_options options = burnish_render_options_default();
        burnish_target target = burnish_target_default();
        laid_out made;
        size_t total = 0;
        framing.azimuth = test_uniform(&random, 0, 360);
        lay_out(mesh, framing, BURNISH_ANNOTATION_CALLOUTS, WIDTH, HEIGHT, &made);
        drop(&made);
        options.camera = made.camera;
        options.width = WIDTH;
        options.height = HEIGHT;
        target.triangles = ids;
        target.triangle_stride = WIDTH * sizeof *ids;
        CHECK1(burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, NULL) ==
               BURNISH_STATUS_OK);
        made.view.triangles = ids;
        burnish_list_parts(mesh, &made.view, &made.memory);
        CHECK1(burnish_annotation_lay_out(&made.view, 0, 1, &made.memory, &made.list) ==
               BURNISH_STATUS_OK);
        shown += check_balloons(&made, mesh);
        for (size_t k = 0; k < made.callouts.count; ++k) {
            const burnish_callout *item = &made.callouts.items[k];
            CHECK1(item->count == (item->part == 3 ? (size_t)(boxes - 1) / 3 : 1));
            visible += (size_t)item->is_visible;
            total += item->count;
        }
        CHECK(total == (size_t)boxes, "%zu of %d parts", total, boxes);
        drop(&made);
        burnish_mesh_destroy(mesh);
    }
    CHECK(shown * 10 > visible * 8, "%zu of %zu balloons", shown, visible);
    burnish_renderer_destroy(renderer);
}

/* A wall in front of everything hides the box and the grid; nothing in front hides nothing. */
static void test_depth(void) {
    enum { WIDTH = 200, HEIGHT = 150 };
    static float wall[WIDTH * HEIGHT];
    burnish_mesh *mesh = block_of(4, 3, 2);
    laid_out made;
    lay_out(mesh, burnish_framing_default(), BURNISH_ANNOTATION_BOX, WIDTH, HEIGHT, &made);
    CHECK1(made.list.line_count == 12);
    drop(&made);
    for (int wanted = 0; wanted < 2; ++wanted) {
        for (int i = 0; i < WIDTH * HEIGHT; ++i) {
            wall[i] = wanted ? 0.01F : 1e6F;
        }
        made.view.depth = wall;
        made.view.depth_stride = WIDTH * sizeof *wall;
        CHECK1(burnish_annotation_lay_out(&made.view,
                                          BURNISH_ANNOTATION_BOX | BURNISH_ANNOTATION_GRID, 1,
                                          &made.memory, &made.list) == BURNISH_STATUS_OK);
        size_t hidden = 0, seen = 0, grid = 0;
        for (size_t i = 0; i < made.list.line_count; ++i) {
            hidden += made.list.lines[i].layer == BURNISH_LAYER_HIDDEN;
            seen += made.list.lines[i].layer == BURNISH_LAYER_BOX;
            grid += made.list.lines[i].layer == BURNISH_LAYER_GRID;
        }
        CHECK(wanted ? hidden > 24 && seen == 0 && grid == 0
                     : hidden == 0 && seen == 12 && grid > 8,
              "wall %d: %zu hidden, %zu seen, %zu of the grid", wanted, hidden, seen, grid);
        drop(&made);
    }
    burnish_mesh_destroy(mesh);
}

/* Far from the origin, at the ends of single precision, next to the camera: nothing crashes, and
 * what is drawn has finite coordinates. */
static void test_extremes(void) {
    static const float sizes[] = {1e-20F, 1e-3F, 1e12F, 1e18F},
                       offsets[] = {0, 1e6F, 1e15F, -1e18F};
    for (int i = 0; i < 16; ++i) {
        const float s = sizes[i / 4], o = offsets[i % 4];
        const float low[3] = {o, 0, -s}, high[3] = {o + s, s * 2, s};
        const float up[3] = {0, 1, 0};
        if (!(high[0] > low[0])) {
            continue;
        }
        burnish_mesh *mesh = block(low, high, up);
        laid_out made;
        for (int orthographic = 0; orthographic < 2; ++orthographic) {
            burnish_framing framing = burnish_framing_default();
            framing.orthographic = orthographic;
            lay_out(mesh, framing, BURNISH_ANNOTATION_ALL, 320, 240, &made);
            check_apart(&made, "extreme", !orthographic);
            for (size_t k = 0; k < made.list.line_count; ++k) {
                CHECK1(isfinite(made.list.lines[k].stroke.x0) &&
                       isfinite(made.list.lines[k].stroke.y1));
            }
            const burnish_point far_away = {1e39, -1e39}; /* the end of an edge next to the eye */
            const burnish_annotation_label label =
                burnish_annotation_label_at(&made.view, "1", far_away, BURNISH_LAYER_LINES);
            CHECK1(label.x > 0.9e39 && label.baseline < -0.9e39);
            drop(&made);
        }
        burnish_annotate_options annotations = burnish_annotate_options_default();
        annotations.kinds = BURNISH_ANNOTATION_ALL;
        burnish_camera inside = made.camera;
        for (int k = 0; k < 3; ++k) {
            inside.position[k] = ((double)low[k] + (double)high[k]) / 2;
        }
        inside.orthographic_height = 0;
        burnish_image image = make_image(320, 240, 4);
        const burnish_pixels pixels = burnish_image_get_pixels(&image);
        CHECK1(burnish_annotate(mesh, &annotations, &inside, &pixels, NULL, NULL) ==
               BURNISH_STATUS_OK);
        burnish_image_destroy(&image);
        burnish_mesh_destroy(mesh);
    }
}

static void test_refusals(void) {
    burnish_mesh *mesh = block_of(1, 2, 3);
    const burnish_annotate_options good = burnish_annotate_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_camera camera;
    burnish_image image = make_image(64, 64, 3);
    burnish_error error;
    double inset[4];
    float depth[64 * 64];
    size_t left_out;
    CHECK1(burnish_camera_frame(mesh, &framing, &camera, NULL) == BURNISH_STATUS_OK);
    const burnish_pixels pixels = burnish_image_get_pixels(&image);
#define REFUSED(...)                                                                               \
    CHECK(burnish_annotate(__VA_ARGS__, &left_out, &error) == BURNISH_STATUS_ARGUMENT &&           \
              strlen(error.text) > 10,                                                             \
          "\"%s\"", error.text)
#define WRONG(...)                                                                                 \
    do {                                                                                           \
        burnish_annotate_options bad = good;                                                       \
        __VA_ARGS__;                                                                               \
        REFUSED(mesh, &bad, &camera, &pixels);                                                     \
    } while (0)
    REFUSED(NULL, &good, &camera, &pixels);
    REFUSED(mesh, NULL, &camera, &pixels);
    REFUSED(mesh, &good, NULL, &pixels);
    REFUSED(mesh, &good, &camera, NULL);
    WRONG(bad.depth = depth, bad.depth_stride = 63 * 4);
    WRONG(bad.depth = depth, bad.depth_stride = 64 * 4 + 1);
    WRONG(bad.cookie = 0);
    WRONG(bad.kinds = 256);
    WRONG(bad.text_height = 4);
    WRONG(bad.text_height = NAN);
    memcpy(camera.focal_point, camera.position, sizeof camera.position);
    REFUSED(mesh, &good, &camera, &pixels);
    CHECK1(burnish_annotate_inset(mesh, &good, NULL, 64, 64, inset, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_annotate_inset(mesh, &good, &framing, 0, 64, inset, &error) ==
           BURNISH_STATUS_ARGUMENT);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_numbers());
    RUN(test_round_numbers());
    RUN(test_scale_bar());
    RUN(test_dimensions());
    RUN(test_nothing_overlaps());
    RUN(test_callouts());
    RUN(test_depth());
    RUN(test_extremes());
    RUN(test_refusals());
    return test_end("annotate");
}
