/* Drawings against pictures: annotations drawn from their SVG are those of the pixels; areas are
 * the pixels of their colour, and hatching the dark ones among them; sheets have one layout; sizes
 * in millimetres; errors and memory. */
#include <math.h>

#include "burnish/annotate.h"
#include "burnish/drawing.h"
#include "burnish/look.h"
#include "burnish/sheet.h"
#include "core/srgb.h"
#include "counting_context.h"
#include "image/text/strokes.h"
#include "images.h"
#include "pictures.h"
#include "svg_path.h"

enum { WIDTH = 480, HEIGHT = 360 };

static burnish_error error;
static svg_path path;

static burnish_mesh *load(const char *name) {
    burnish_mesh *mesh = load_measured(name, burnish_load_options_default().tessellation);
    CHECK_OK(burnish_look_set_materials(BURNISH_LOOK_DRAWING, mesh, &error), error);
    return mesh;
}

static burnish_render_options make_options(const burnish_mesh *mesh, int orthographic) {
    burnish_render_options options = framed_options(mesh, WIDTH, HEIGHT);
    burnish_framing framing = burnish_framing_default();
    burnish_render_options_set_look(&options, BURNISH_LOOK_DRAWING, NULL);
    framing.aspect = (double)WIDTH / HEIGHT;
    framing.orthographic = orthographic;
    CHECK_OK(burnish_camera_frame(mesh, &framing, &options.camera, &error), error);
    return options;
}

/* ---- Reading an SVG ---- */

static void read_color(const char *text, uint8_t color[3]) {
    unsigned value = 0;
    CHECK1(text && sscanf(text, "#%6x", &value) == 1);
    for (int k = 0; k < 3; ++k) {
        color[k] = (uint8_t)(value >> (16 - 8 * k));
    }
}

/* Draws the groups of lines that an SVG has from `text` on. */
static void draw_groups(const char *text, const burnish_image *image) {
    static burnish_stroke strokes[1 << 15];
    const burnish_pixels pixels = burnish_image_get_pixels(image);
    for (const char *group = text; (group = strstr(group, "<g ")) != NULL; ++group) {
        const char *end = strstr(group, "</g>"), *opacity = attribute(group, "opacity");
        uint8_t color[3];
        size_t count = 0;
        read_color(attribute(group, "stroke"), color);
        for (const char *tag = group; (tag = strstr(tag, "<path")) != NULL && tag < end; ++tag) {
            const double width = strtod(attribute(tag, "stroke-width"), NULL);
            svg_read_path(attribute(tag, "d"), &path);
            for (size_t i = 0; i < path.count; ++i) {
                for (size_t k = path.starts[i]; k + 1 < path.starts[i + 1]; ++k) {
                    const double *p = path.points[k];
                    strokes[count++] = (burnish_stroke){(float)p[0], (float)p[1], (float)p[2],
                                                        (float)p[3], (float)(width / 2)};
                }
            }
        }
        const burnish_ink ink = burnish_ink_of(color, opacity ? strtof(opacity, NULL) : 1);
        burnish_memory memory = burnish_memory_of(NULL, &error);
        CHECK_OK(burnish_strokes_draw(&pixels, strokes, count, &ink, NULL, &memory), error);
    }
}

static burnish_drawing *make_drawing(int width, int height) {
    burnish_drawing *drawing = NULL;
    CHECK_OK(burnish_drawing_create(NULL, width, height, &drawing, &error), error);
    return drawing;
}

/* White but for what draw_groups() finds. */
static burnish_image draw_svg(const char *text, int width, int height) {
    burnish_image image = make_filled(width, height, 3, 255);
    draw_groups(text, &image);
    return image;
}

/* How many pixels differ by more than so many codes. */
static size_t count_differences(const burnish_image *a, const burnish_image *b, int codes) {
    size_t found = 0;
    for (size_t i = 0; i < (size_t)a->width * (size_t)a->height * 3; ++i) {
        found += abs(a->pixels[i] - b->pixels[i]) > codes;
    }
    return found;
}

static char *svg_of(const burnish_drawing *drawing, double dots_per_inch) {
    char *text = NULL;
    size_t size = 0;
    CHECK_OK(burnish_drawing_encode_svg(drawing, NULL, NULL, dots_per_inch, &text, &size, &error),
             error);
    return text;
}

/* ---- Annotations ---- */

/* The SVG's groups, drawn as strokes, give the picture that burnish_annotate draws. */
static void test_annotations(int orthographic) {
    static float depth[WIDTH * HEIGHT];
    static const char *const labels[] = {"6.434", "3.15", "4", "X", "Y", "Z", "grid 0.5"};
    burnish_mesh *mesh = load(":teapot");
    burnish_render_options options = make_options(mesh, orthographic);
    burnish_annotate_options annotations = burnish_annotate_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_image expected = make_filled(WIDTH, HEIGHT, 3, 255);
    burnish_drawing *drawing = make_drawing(WIDTH, HEIGHT);
    const burnish_pixels pixels = burnish_image_get_pixels(&expected);
    const burnish_target target =
        make_target((burnish_pixels){.width = WIDTH}, depth, NULL, NULL, NULL);
    size_t left_out[2] = {9, 8};
    annotations.depth = depth;
    annotations.depth_stride = WIDTH * sizeof *depth;
    annotations.kinds = BURNISH_ANNOTATION_ALL;
    framing.aspect = (double)WIDTH / HEIGHT;
    framing.orthographic = orthographic;
    CHECK1(burnish_annotate_inset(mesh, &annotations, &framing, WIDTH, HEIGHT, framing.inset,
                                  &error) == BURNISH_STATUS_OK &&
           burnish_camera_frame(mesh, &framing, &options.camera, &error) == BURNISH_STATUS_OK);
    draw_into(mesh, &options, &target, NULL);
    CHECK_OK(burnish_annotate(mesh, &annotations, &options.camera, &pixels, &left_out[0], &error),
             error);
    CHECK_OK(burnish_annotate_drawing(mesh, &annotations, &options.camera, drawing, &left_out[1],
                                      &error),
             error);
    char *text = svg_of(drawing, 0);
    burnish_image drawn = draw_svg(text, WIDTH, HEIGHT);
    CHECK1(left_out[0] == left_out[1]);
    /* coordinates have two decimals: an edge of full contrast moves by 1 or 2 codes, of sRGB's
     * darkest ones by more */
    const size_t differences = count_differences(&expected, &drawn, 8);
    CHECK(differences < 20, "%zu values differ", differences);
    memset(drawn.pixels, 255, image_size(&drawn));
    CHECK1(count_differences(&expected, &drawn, 8) > 10000);
    for (size_t i = 0; i < sizeof labels / sizeof *labels; ++i) {
        char label[40];
        snprintf(label, sizeof label, "aria-label=\"%s\"", labels[i]);
        CHECK(strstr(text, label), "no %s", label);
    }
    CHECK1((strstr(text, "aria-label=\"1\"") != NULL) == orthographic); /* the scale bar */
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawing);
    burnish_image_destroy(&expected);
    burnish_image_destroy(&drawn);
    burnish_mesh_destroy(mesh);
}

/* ---- Areas ---- */

/* Whether a point is inside the path, whose lines may be open, by the even-odd rule. */
static int is_inside(double x, double y) {
    int inside = 0;
    for (size_t i = 0; i < path.count; ++i) {
        const size_t end = path.starts[i + 1];
        for (size_t k = path.starts[i]; k < end; ++k) {
            const double *a = path.points[k];
            const double *b = path.points[k + 1 < end ? k + 1 : path.starts[i]];
            if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) {
                inside = !inside;
            }
        }
    }
    return inside;
}

/* The area of the path, whose holes run the other way. */
static double area_of_path(void) {
    double sum = 0;
    for (size_t i = 0; i < path.count; ++i) {
        for (size_t k = path.starts[i]; k + 1 < path.starts[i + 1]; ++k) {
            const double *a = path.points[k], *b = path.points[k + 1];
            sum += a[0] * b[1] - a[1] * b[0];
        }
    }
    return sum / 2;
}

/* What a pixel of the picture shows: 0 background, 1 surface, 2 and 3 the cuts 0 and 1. */
typedef struct truth {
    uint8_t kinds[WIDTH * HEIGHT];
    double count[4];
} truth;

/* Kinds by a picture whose surfaces are grey: caps are tinted, so red and blue differ; which cut a
 * cap is of, by its normal, that of `planes`. */
static void find_truth(const burnish_mesh *mesh, const burnish_render_options *options,
                       const double planes[2][3], const burnish_image *image, truth *t) {
    static float normals[WIDTH * HEIGHT][3];
    const burnish_target target =
        make_target(burnish_image_get_pixels(image), NULL, normals[0], NULL, NULL);
    burnish_render_options plain = *options;
    plain.edges = 0;
    plain.samples = 1;
    draw_into(mesh, &plain, &target, NULL);
    memset(t, 0, sizeof *t);
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const uint8_t *p = image->pixels + 3 * (size_t)i;
        const int shows = memcmp(p, options->background, 3) != 0;
        const float *n = normals[i];
        double cosine[2];
        for (int k = 0; k < 2; ++k) {
            cosine[k] = (double)n[0] * planes[k][0] + (double)n[1] * planes[k][1] +
                        (double)n[2] * planes[k][2];
        }
        t->kinds[i] = (uint8_t)(!shows ? 0 : p[0] == p[2] ? 1 : cosine[0] > 0.999 ? 2 : 3);
        ++t->count[t->kinds[i]];
    }
}

/* The path is the pixels of one kind, but for pixels along their border. */
static void check_area(const truth *t, int kind) {
    size_t wrong = 0, border = 0;
    for (int y = 1; y < HEIGHT - 1; ++y) {
        for (int x = 1; x < WIDTH - 1; ++x) {
            const int i = y * WIDTH + x, is = t->kinds[i] == kind;
            int near = 0;
            for (int k = 0; k < 9; ++k) {
                near |= (t->kinds[i + (k / 3 - 1) * WIDTH + k % 3 - 1] == kind) != is;
            }
            border += (size_t)near;
            wrong += !near && is_inside(x + 0.5, y + 0.5) != is;
        }
    }
    const double off = area_of_path() - t->count[kind];
    CHECK(wrong == 0, "kind %d: %zu pixels away from borders", kind, wrong);
    CHECK(fabs(off) < 0.06 * (double)border, "kind %d: %g of %g", kind, off, t->count[kind]);
}

/* Hatching lies on dark pixels, and there is as much of it as there is room for: a line every
 * 14 / sqrt(2) pixels. */
static void check_hatching(const burnish_image *image, const truth *t, int kind) {
    double length = 0;
    size_t pale = 0, looked = 0;
    for (size_t i = 0; i < path.count; ++i) {
        const double *a = path.points[path.starts[i]], *b = path.points[path.starts[i] + 1];
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        CHECK(path.starts[i + 1] - path.starts[i] == 2 && fabs(fabs(dx) - fabs(dy)) < 0.03 &&
                  dx * dy * (kind == 2 ? -1 : 1) >= 0,
              "line %zu: %g, %g", i, dx, dy);
        length += sqrt(dx * dx + dy * dy);
        for (double at = 0.25; at < 0.8; at += 0.25) {
            const int x = (int)(a[0] + at * dx), y = (int)(a[1] + at * dy);
            const int is_kind = fabs(dx) > 6 && t->kinds[y * WIDTH + x] == kind;
            looked += (size_t)is_kind;
            pale += is_kind && pixel_at(image, x, y)[1] > 160;
        }
    }
    const double expected = t->count[kind] / (14 / sqrt(2));
    CHECK(pale == 0 && looked > 20, "%zu of %zu pale", pale, looked);
    CHECK(fabs(length / expected - 1) < 0.03, "length %g, expected %g", length, expected);
}

/* The drawing of a picture that a renderer has drawn. */
static burnish_drawing *trace(const burnish_mesh *mesh, const burnish_render_options *options) {
    burnish_renderer *renderer = make_renderer(NULL);
    burnish_drawing *drawing = make_drawing(options->width, options->height);
    burnish_image image = {0};
    CHECK_OK(burnish_renderer_draw(renderer, mesh, options, &image, NULL, &error), error);
    CHECK_OK(burnish_renderer_trace(renderer, mesh, options, drawing, &error), error);
    burnish_image_destroy(&image);
    burnish_renderer_destroy(renderer);
    return drawing;
}

/* A torus, cut twice, grey on white: three areas, two of them hatched. */
static void test_areas(int orthographic) {
    static const double planes[2][3] = {{0, 0, 1}, {1, 0, 0}};
    static truth t;
    burnish_mesh *mesh = load(":torus");
    burnish_material grey = *burnish_mesh_get_material(mesh, 0);
    burnish_image image = make_image(WIDTH, HEIGHT, 3);
    cut_mesh(mesh, 0, 0, 1, 0.1);
    cut_mesh(mesh, 1, 0, 0, 0.2);
    set_three(grey.ambient, 0.8F);
    set_material(mesh, &grey);
    const burnish_render_options options = make_options(mesh, orthographic);
    find_truth(mesh, &options, planes, &image, &t);
    CHECK(t.count[1] > 5000 && t.count[2] > 2000 && t.count[3] > 2000, "%g %g %g", t.count[1],
          t.count[2], t.count[3]);
    burnish_drawing *drawing = trace(mesh, &options);
    char *text = svg_of(drawing, 0);
    int areas[4] = {0}, hatched = 0, kind = 0;
    const char *end = strstr(text, "<g ");
    for (const char *tag = text; (tag = strstr(tag, "<path")) != NULL && tag < end; ++tag) {
        svg_read_path(attribute(tag, "d"), &path);
        if (attribute(tag, "stroke")) { /* of the area before */
            check_hatching(&image, &t, kind);
            ++hatched;
            continue;
        }
        uint8_t color[3];
        read_color(attribute(tag, "fill"), color);
        kind = color[0] == color[2];
        for (int i = 0; i < WIDTH * HEIGHT && kind == 0; ++i) { /* the cut that it has pixels of */
            const int is_cut = t.kinds[i] > 1 && is_inside(i % WIDTH + 0.5, (int)(i / WIDTH) + 0.5);
            kind = is_cut ? t.kinds[i] : 0;
        }
        ++areas[kind];
        check_area(&t, kind);
        CHECK1(strstr(tag, "evenodd") && color[1] < 255);
        if (kind == 1) {
            CHECK1(abs(color[0] - burnish_linear_to_srgb(0.8F)) <= 1);
        }
    }
    CHECK(areas[1] == 1 && areas[2] == 1 && areas[3] == 1 && hatched == 2, "%d %d %d, %d", areas[1],
          areas[2], areas[3], hatched);
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawing);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
}

/* ---- Sheets, sizes ---- */

/* Cells stand where the sheet of images has them, and labels are drawn there with the same
 * strokes. */
static void test_sheet(void) {
    enum { CELLS = 5, COLUMNS = 2, W = 120, H = 90 };
    static const uint8_t white[3] = {255, 255, 255}, ink[3] = {20, 30, 40};
    static const char *const labels[CELLS] = {"front", "a \"long\" label that is cut somewhere",
                                              "<&>", "", "iso"};
    burnish_image images[CELLS], sheet = {0};
    burnish_drawing *drawings[CELLS], *drawn_sheet = NULL, *other = make_drawing(W, H + 1);
    burnish_sheet_cell cells[CELLS];
    for (int i = 0; i < CELLS; ++i) {
        images[i] = make_filled(W, H, 3, 100 + i);
        drawings[i] = make_drawing(W, H);
        cells[i] = (burnish_sheet_cell){.image = &images[i], .label = labels[i]};
    }
    CHECK_OK(burnish_image_sheet(&sheet, cells, CELLS, COLUMNS, white, ink, &error), error);
    CHECK_OK(burnish_drawing_sheet(cells, drawings, CELLS, COLUMNS, ink, &drawn_sheet, &error),
             error);
    char *text = svg_of(drawn_sheet, 254);
    char head[160];
    snprintf(head, sizeof head, "width=\"%gmm\" height=\"%gmm\" viewBox=\"0 0 %d %d\"",
             sheet.width / 10.0, sheet.height / 10.0, sheet.width, sheet.height);
    CHECK(strstr(text, head), "%s is not in %.200s", head, text);
    burnish_image drawn = draw_svg(text, sheet.width, sheet.height);
    const char *tag = strstr(text, "<svg x=");
    for (int i = 0; i < CELLS && CHECK1(tag); ++i, tag = strstr(tag + 1, "<svg x=")) {
        const int x = atoi(attribute(tag, "x")), y = atoi(attribute(tag, "y"));
        CHECK1(atoi(attribute(tag, "width")) == W && atoi(attribute(tag, "height")) == H);
        burnish_image_destroy(&images[i]);
        for (int row = 0; row < H; ++row) { /* the same pixels, for the comparison */
            memset(pixel_at(&drawn, x, y + row), 100 + i, 3 * W);
        }
    }
    CHECK(count_differences(&sheet, &drawn, 8) < 20, "%zu values differ",
          count_differences(&sheet, &drawn, 8));
    CHECK1(strstr(text, "aria-label=\"a &quot;long&quot; label that is cut somewhere\"") &&
           strstr(text, "aria-label=\"&lt;&amp;&gt;\""));
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawn_sheet);

    images[0] = (burnish_image){.width = W, .height = H, .channels = 3};
    cells[0].image = &images[0];
    CHECK1(burnish_drawing_sheet(cells, &other, 1, 1, ink, &drawn_sheet, &error) ==
               BURNISH_STATUS_ARGUMENT &&
           !drawn_sheet);
    burnish_drawing_destroy(other);
    for (int i = 0; i < CELLS; ++i) {
        burnish_drawing_destroy(drawings[i]);
    }
    burnish_image_destroy(&sheet);
    burnish_image_destroy(&drawn);
}

/* Views fit their cells at one scale, in rows and columns of the method. */
static void check_layout(const burnish_projection *projection) {
    const burnish_projection_area *cells = projection->cells;
    const burnish_projection_area *front = &cells[BURNISH_PROJECTION_FRONT],
                                  *top = &cells[BURNISH_PROJECTION_TOP];
    const burnish_projection_area *side = &cells[BURNISH_PROJECTION_SIDE];
    const int is_top = projection->section == 2;
    const burnish_projection_area *free =
        &cells[is_top ? BURNISH_PROJECTION_SECTION : BURNISH_PROJECTION_PICTORIAL];
    const burnish_projection_area *third =
        &cells[is_top ? BURNISH_PROJECTION_PICTORIAL : BURNISH_PROJECTION_SECTION];
    const int is_first = projection->method == BURNISH_PROJECTION_FIRST_ANGLE;
    CHECK1(front->x == top->x && front->width == top->width && front->y == side->y &&
           front->height == side->height && side->x == front->x + front->width &&
           free->x == side->x && free->y == top->y && free->width == side->width + third->width &&
           free->height == top->height && third->x == side->x + side->width &&
           third->y == side->y && third->height == side->height &&
           (third->width > 0) == (projection->section > 0));
    CHECK1(top->y == (is_first ? front->y + front->height : front->y - top->height));
    CHECK1(front->x >= 0 && free->x + free->width <= projection->width &&
           (is_first ? top : front)->y + (is_first ? top : front)->height <= projection->height);
    const double s = projection->pixels_per_unit;
    CHECK1(s * projection->extents[0] < front->width &&
           s * projection->extents[1] < front->height && s * projection->extents[2] < side->width &&
           s * projection->extents[2] < top->height);
    CHECK1(projection->section == 0 || s * projection->extents[projection->section == 1 ? 2 : 0] <
                                           cells[BURNISH_PROJECTION_SECTION].width);
}

/* Layouts of many objects and sheets. Scales on paper are those of ISO 5455. */
static void test_projection_layout(void) {
    uint64_t state = test_seed(1);
    for (int i = 0; i < 400; ++i) {
        burnish_projection projection = {
            .method = i % 2, .width = 300 + 7 * i, .height = 900, .section = i % 5 % 4};
        for (int k = 0; k < 3; ++k) {
            projection.extents[k] =
                i % 7 == k ? 0 : pow(10, (double)(test_random32(&state) % 1000) / 200 - 2);
        }
        projection.pixels_per_millimetre = i % 4 == 0 ? 5 : 0;
        projection.paper = i % 8 == 0 ? "A4" : NULL;
        CHECK_OK(burnish_projection_lay_out(&projection, &error), error);
        check_layout(&projection);
        CHECK1((projection.scale[0] != 0) == (i % 4 == 0));
        CHECK1(projection.text_height >= 2.5 * projection.pixels_per_millimetre);
        CHECK1(!projection.paper || projection.cells[BURNISH_PROJECTION_FRONT].x == 20 * 5);
    }
    const struct {
        double size;
        const char *scale;
        double value;
    } rows[] = {{30, "2:1", 2}, {60, "1:1", 1}, {100, "1:2", 0.5}, {300, "1:5", 0.2}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        const double size = rows[i].size;
        burnish_projection projection = {.width = 1684,
                                         .height = 1190,
                                         .extents = {size, size, size},
                                         .pixels_per_millimetre = 144 / 25.4};
        CHECK_OK(burnish_projection_lay_out(&projection, &error), error);
        CHECK(strcmp(projection.scale, rows[i].scale) == 0, "%g: %s", size, projection.scale);
        CHECK1(fabs(projection.pixels_per_unit - rows[i].value * 144 / 25.4) < 1e-9);
    }
    burnish_projection projection = {.width = 239, .height = 900, .extents = {1, 1, 1}};
    CHECK1(burnish_projection_lay_out(&projection, &error) == BURNISH_STATUS_ARGUMENT);
    projection = (burnish_projection){.width = 900, .height = 900};
    CHECK1(burnish_projection_lay_out(&projection, &error) == BURNISH_STATUS_ARGUMENT);
}

/* Frame, title, scale and symbol of a drawing are those of the picture. */
static void test_projection(void) {
    static const uint8_t white[3] = {255, 255, 255}, ink[3] = {20, 30, 40};
    burnish_projection projection = {.width = 800,
                                     .height = 600,
                                     .extents = {40, 20, 30},
                                     .pixels_per_millimetre = 3,
                                     .method = BURNISH_PROJECTION_FIRST_ANGLE,
                                     .section = 3};
    burnish_image images[BURNISH_PROJECTION_VIEWS], picture = {0};
    const burnish_image *views[BURNISH_PROJECTION_VIEWS];
    burnish_drawing *drawings[BURNISH_PROJECTION_VIEWS], *drawing;
    CHECK_OK(burnish_projection_lay_out(&projection, &error), error);
    for (int i = 0; i < BURNISH_PROJECTION_VIEWS; ++i) {
        const burnish_projection_area *cell = &projection.cells[i];
        images[i] = make_filled(cell->width, cell->height, 3, 255);
        views[i] = &images[i];
        drawings[i] = make_drawing(cell->width, cell->height);
    }
    CHECK_OK(burnish_projection_image(&projection, "a<b", views, white, ink, &picture, &error),
             error);
    CHECK_OK(burnish_projection_drawing(&projection, "a<b", drawings, ink, &drawing, &error),
             error);
    char *text = svg_of(drawing, 0);
    burnish_image drawn = draw_svg(text, projection.width, projection.height);
    CHECK(count_differences(&picture, &drawn, 8) < 40, "%zu values differ",
          count_differences(&picture, &drawn, 8));
    CHECK1(strstr(text, "aria-label=\"a&lt;b\"") && strstr(text, "aria-label=\"1:1\""));
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawing);
    for (int i = 0; i < BURNISH_PROJECTION_VIEWS; ++i) {
        burnish_drawing_destroy(drawings[i]);
        burnish_image_destroy(&images[i]);
    }
    burnish_image_destroy(&picture);
    burnish_image_destroy(&drawn);
}

/* How often a letter stands after a blank or a digit: the operators of paths. */
static int count_operators(const char *text, char first, char other) {
    int count = 0;
    for (const char *c = text; *c; ++c) {
        count += (*c == first || *c == other) && c > text &&
                 (c[-1] == ' ' || c[-1] == '"' || c[-1] == 'z' || (c[-1] >= '0' && c[-1] <= '9')) &&
                 (c[1] == '\n' || c[1] == ' ' || c[1] == '-' || c[1] == '.' ||
                  (c[1] >= '0' && c[1] <= '9'));
    }
    return count;
}

static int count_text(const char *text, const char *part) {
    int count = 0;
    for (const char *c = text; (c = strstr(c, part)) != NULL; ++c) {
        ++count;
    }
    return count;
}

/* A PDF's table leads to its objects, its stream has the length that it states, its page the size
 * in points, and its content one path for each of the SVG's. */
static void test_pdf(void) {
    static const uint8_t white[3] = {255, 255, 255};
    burnish_mesh *mesh = load(":torus");
    cut_mesh(mesh, 0, 0, 1, 0.1);
    burnish_render_options options = make_options(mesh, 1);
    burnish_drawing *drawing = trace(mesh, &options);
    burnish_annotate_options annotations = burnish_annotate_options_default();
    annotations.kinds = BURNISH_ANNOTATION_DIMENSIONS | BURNISH_ANNOTATION_BOX;
    CHECK_OK(burnish_annotate_drawing(mesh, &annotations, &options.camera, drawing, NULL, &error),
             error);
    char *text, *svg = svg_of(drawing, 0);
    size_t size;
    CHECK_OK(burnish_drawing_encode_pdf(drawing, "a(b", white, 144, &text, &size, &error), error);
    CHECK1(strlen(text) == size && strncmp(text, "%PDF-1.4\n", 9) == 0);
    const char *table = text + strtoul(strstr(text, "startxref\n") + 10, NULL, 10);
    CHECK1(strncmp(table, "xref\n0 6\n", 9) == 0);
    for (int i = 1; i < 6; ++i) {
        char head[16];
        snprintf(head, sizeof head, "%d 0 obj\n", i);
        CHECK(strncmp(text + strtoul(table + 9 + 20 * i, NULL, 10), head, strlen(head)) == 0, "%s",
              head);
    }
    const char *stream = strstr(text, "stream\n") + 7;
    CHECK1(stream + strtoul(strstr(text, "/Length") + 7, NULL, 10) == strstr(text, "endstream"));
    CHECK1(strstr(text, "/MediaBox [0 0 240 180]") && strstr(text, "/Title (a\\(b)"));
    for (const char *sign = stream; (sign = strchr(sign, '-')); ++sign) {
        CHECK(sign[-1] == ' ' || sign[-1] == '(', "%.9s is not two numbers", sign - 4);
    }
    CHECK1(count_text(text, ") Tj") == count_text(svg, "aria-label=") && strstr(text, ") Tj"));
    CHECK(count_operators(stream, 'm', 'm') == count_operators(svg, 'M', 'm') &&
              count_operators(stream, 'm', 'm') > 50,
          "%d and %d", count_operators(stream, 'm', 'm'), count_operators(svg, 'M', 'm'));
    burnish_release(NULL, text);
    burnish_release(NULL, svg);
    CHECK1(burnish_drawing_encode_pdf(drawing, NULL, NULL, 0.5, &text, &size, &error) ==
           BURNISH_STATUS_ARGUMENT);
    burnish_drawing_destroy(drawing);
    burnish_mesh_destroy(mesh);
}

/* A font of squares, one per byte, whose lower and upper sides outlines leave out. */
static int32_t set_squares(void *user_data, const char *text, size_t length, int height,
                           burnish_outline_sink *take, void *context) {
    (void)user_data, (void)text;
    const int32_t side = height * 256;
    for (size_t i = 0; i < length && take; ++i) {
        const int32_t x = (int32_t)i * (side + 768);
        const int32_t corners[4][2] = {{x, 0}, {x + side, 0}, {x + side, side}, {x, side}};
        for (int k = 0; k < 4; ++k) {
            take(context, k == 0 ? BURNISH_OUTLINE_MOVE : BURNISH_OUTLINE_LINE, corners[k]);
        }
        take(context, BURNISH_OUTLINE_MOVE, corners[0]);
    }
    return (int32_t)length * (side + 768);
}

/* A font's letters are areas: the dark pixels of the sheet of images. */
static void test_font(void) {
    enum { W = 120, H = 90 };
    static const uint8_t white[3] = {255, 255, 255}, ink[3] = {0, 0, 0};
    const burnish_font font = {set_squares, NULL};
    burnish_image image = make_filled(W, H, 3, 255), sheet = {0};
    burnish_drawing *drawing = make_drawing(W, H), *drawn = NULL;
    size_t wrong = 0, dark = 0;
    const burnish_sheet_cell cell = {&image, "abc", &font};
    CHECK_OK(burnish_image_sheet(&sheet, &cell, 1, 1, white, ink, &error), error);
    CHECK_OK(burnish_drawing_sheet(&cell, &drawing, 1, 1, ink, &drawn, &error), error);
    char *text = svg_of(drawn, 0);
    const char *label = strstr(text, "<path aria-label=\"abc\" fill=\"#000000\" d=\"");
    if (CHECK1(label)) {
        svg_read_path(strstr(label, " d=\"") + 4, &path);
        for (int i = 0; i < sheet.width * sheet.height; ++i) {
            const int is_dark = sheet.pixels[3 * (size_t)i] < 128;
            const double x = i % sheet.width + 0.5, y = (int)(i / sheet.width) + 0.5;
            dark += (size_t)is_dark;
            wrong += is_inside(x, y) != is_dark;
        }
    }
    CHECK(wrong == 0 && dark >= 3 * 9 * 9, "%zu wrong of %zu", wrong, dark);
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawing);
    burnish_drawing_destroy(drawn);
    burnish_image_destroy(&image);
    burnish_image_destroy(&sheet);
}

static void test_arguments(void) {
    burnish_drawing *drawing = NULL;
    char *text = NULL;
    size_t size;
    CHECK1(burnish_drawing_create(NULL, 0, 9, &drawing, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_drawing_create(NULL, 9, BURNISH_IMAGE_MAX_SIZE + 1, &drawing, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_drawing_encode_svg(NULL, NULL, NULL, 0, &text, &size, &error) ==
           BURNISH_STATUS_ARGUMENT);
    drawing = make_drawing(1000, 700);
    CHECK1(burnish_drawing_encode_svg(drawing, NULL, NULL, 0.5, &text, &size, &error) ==
           BURNISH_STATUS_ARGUMENT);
    text = svg_of(drawing, 300);
    CHECK1(strstr(text, "width=\"84.6667mm\" height=\"59.2667mm\" viewBox=\"0 0 1000 700\""));
    burnish_release(NULL, text);
    text = svg_of(drawing, 0);
    CHECK1(strstr(text, "width=\"1000\" height=\"700\""));
    burnish_release(NULL, text);
    CHECK_OK(burnish_drawing_encode_svg(drawing,
                                        "\xC3\xA9<&\">\n\x7F\xEF\xBF\xBD\xEF\xBF\xBE"
                                        "\xEF\xBF\xBF\xFF\xED\xA0\x80\xF0\x9F\x91",
                                        NULL, 0, &text, &size, &error),
             error);
    CHECK1(strstr(text, "<title>\xC3\xA9&lt;&amp;&quot;&gt; ?\xEF\xBF\xBD?????????"
                        "</title>"));
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawing);
    burnish_drawing_destroy(NULL);
}

/* ---- Memory ---- */

/* A cut torus, drawn. */
typedef struct traced {
    burnish_mesh *mesh;
    burnish_render_options options;
    burnish_renderer *renderer;
} traced;

static burnish_status encode_again(const burnish_context *context, const void *data, uint64_t *hash,
                                   burnish_error *found) {
    const traced *from = data;
    burnish_annotate_options annotations = burnish_annotate_options_default();
    burnish_drawing *drawing = NULL;
    char *texts[2] = {NULL, NULL};
    size_t sizes[2] = {0, 0};
    annotations.context = context;
    annotations.kinds = BURNISH_ANNOTATION_DIMENSIONS;
    burnish_status status = burnish_drawing_create(context, 64, 48, &drawing, found);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_trace(from->renderer, from->mesh, &from->options, drawing, found);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_annotate_drawing(from->mesh, &annotations, &from->options.camera, drawing,
                                          NULL, found);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_drawing_encode_svg(drawing, "t", NULL, 0, &texts[0], &sizes[0], found);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_drawing_encode_pdf(drawing, "t", NULL, 0, &texts[1], &sizes[1], found);
    }
    *hash = test_add_hash(test_add_hash(0, texts[0], sizes[0]), texts[1], sizes[1]);
    burnish_release(context, texts[0]);
    burnish_release(context, texts[1]);
    burnish_drawing_destroy(drawing);
    return status;
}

static void test_memory(void) {
    traced from = {load(":torus"), .renderer = make_renderer(NULL)};
    burnish_image image = {0};
    int cancelled;
    cut_mesh(from.mesh, 0, 0, 1, 0.1);
    from.options = make_options(from.mesh, 0);
    from.options.width = 64;
    from.options.height = 48;
    from.options.threads = 1;
    CHECK_OK(burnish_renderer_draw(from.renderer, from.mesh, &from.options, &image, NULL, &error),
             error);
    const int failures = check_stops(encode_again, &from, &cancelled);
    CHECK(failures > 20, "%d", failures);
    burnish_image_destroy(&image);
    burnish_renderer_destroy(from.renderer);
    burnish_mesh_destroy(from.mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_annotations(0));
    RUN(test_annotations(1));
    RUN(test_areas(0));
    RUN(test_areas(1));
    RUN(test_sheet());
    RUN(test_projection_layout());
    RUN(test_projection());
    RUN(test_pdf());
    RUN(test_font());
    RUN(test_arguments());
    RUN(test_memory());
    return test_end("drawing");
}
