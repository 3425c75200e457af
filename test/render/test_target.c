/* Pictures in the caller's memory: every format and stride, the planes of a sphere. */
#include <math.h>

#include "core/srgb.h"
#include "pictures.h"

enum { WIDTH = 131, HEIGHT = 77, PADDING = 20, GUARD = 64 };

static const uint8_t GUARD_BYTE = 0x5a;

/* A dim picture, whose light nothing clamps. */
static burnish_render_options make_options(const burnish_mesh *mesh, int samples) {
    burnish_render_options options = framed_options(mesh, WIDTH, HEIGHT);
    options.samples = samples;
    options.background[0] = 30;
    options.background[1] = 90;
    options.background[2] = 200;
    for (int i = 0; i < options.light_count; ++i) {
        for (int k = 0; k < 3; ++k) {
            options.lights[i].color[k] *= 0.25f;
        }
    }
    return options;
}

/* Memory for a plane between guards. */
typedef struct guarded {
    uint8_t *bytes, *first; /* all of it; the plane */
    size_t row, stride;     /* bytes */
    int rows;
} guarded;

static guarded make_guarded(size_t row, size_t padding, int rows) {
    guarded g = {.row = row, .stride = row + padding, .rows = rows};
    const size_t size = g.stride * (size_t)rows + 2 * GUARD;
    g.bytes = aligned_alloc(64, (size + 63) / 64 * 64);
    g.first = g.bytes + GUARD;
    memset(g.bytes, GUARD_BYTE, size);
    return g;
}

/* Whether anything outside the rows was written. */
static int is_damaged(const guarded *g) {
    const size_t size = g->stride * (size_t)g->rows + 2 * GUARD;
    for (size_t i = 0; i < size; ++i) {
        const int is_inside = i >= GUARD && i < size - GUARD && (i - GUARD) % g->stride < g->row;
        if (!is_inside && g->bytes[i] != GUARD_BYTE) {
            return 1;
        }
    }
    return 0;
}

static const uint8_t *row_at(const guarded *g, int y) {
    return g->first + (size_t)y * g->stride;
}

/* ---- Formats ---- */

/* Whether a pixel of a target equals the pixel of an image by burnish_render. */
static int same_pixel(burnish_pixel_format format, const uint8_t *pixel, const uint8_t *expected,
                      int channels) {
    const uint8_t alpha = channels == 4 ? expected[3] : 255;
    float light[4];
    switch (format) {
    case BURNISH_PIXELS_RGB8:
        return memcmp(pixel, expected, 3) == 0;
    case BURNISH_PIXELS_RGBA8:
        return memcmp(pixel, expected, 3) == 0 && pixel[3] == alpha;
    case BURNISH_PIXELS_BGRA8:
        return pixel[0] == expected[2] && pixel[1] == expected[1] && pixel[2] == expected[0] &&
               pixel[3] == alpha;
    default:
        memcpy(light, pixel, sizeof light);
        return burnish_linear_to_srgb(light[0]) == expected[0] &&
               burnish_linear_to_srgb(light[1]) == expected[1] &&
               burnish_linear_to_srgb(light[2]) == expected[2] &&
               (int)(light[3] * 255 + 0.5f) == alpha;
    }
}

static const size_t PIXEL_SIZES[] = {3, 4, 4, 16};

static void check_format(const burnish_mesh *mesh, const burnish_render_options *options,
                         const burnish_image *image, burnish_pixel_format format, size_t padding) {
    guarded g = make_guarded(WIDTH * PIXEL_SIZES[format], padding, HEIGHT);
    burnish_target target = burnish_target_default();
    int wrong = 0;
    target.pixels = (burnish_pixels){WIDTH, HEIGHT, format, g.stride, g.first};
    draw_into(mesh, options, &target, NULL);
    for (int y = 0; y < HEIGHT && image->pixels; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            const uint8_t *expected =
                image->pixels + (size_t)(y * WIDTH + x) * (size_t)image->channels;
            wrong += !same_pixel(format, row_at(&g, y) + (size_t)x * PIXEL_SIZES[format], expected,
                                 image->channels);
        }
    }
    CHECK(wrong == 0, "format %d, %d samples, transparent %d: %d pixels differ", (int)format,
          options->samples, options->transparent, wrong);
    CHECK(!is_damaged(&g), "format %d, padding %zu: wrote beside the rows", (int)format, padding);
    free(g.bytes);
}

static void test_formats(int samples) {
    burnish_mesh *mesh = load_tessellated(":knot", 12);
    for (int transparent = 0; transparent < 2; ++transparent) {
        burnish_render_options options = make_options(mesh, samples);
        options.transparent = transparent;
        burnish_image image = draw_image(mesh, &options, NULL);
        for (int i = transparent; i <= BURNISH_PIXELS_RGBA_FLOAT; ++i) { /* RGB has no alpha */
            const size_t padding = (i + transparent + samples) % 2 ? PADDING + (size_t)(i % 3) : 0;
            options.threads = 1 + i % 3;
            check_format(mesh, &options, &image, (burnish_pixel_format)i, padding);
        }
        burnish_image_destroy(&image);
    }
    burnish_mesh_destroy(mesh);
}

/* Ten times white on a white quad is 10 in floats, also where samples are mixed. */
static void test_unclamped(int samples) {
    static const float POSITIONS[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    burnish_mesh *mesh = create_quads(POSITIONS, NULL, 1);
    burnish_material material = matt_material(1);
    burnish_render_options options = front_options(8, 8, 3.1);
    float pixels[8][8][4], largest = 0;
    set_material(mesh, &material);
    light_evenly(&options);
    set_three(options.ambient_light, 10);
    options.samples = samples;
    draw_floats(mesh, &options, pixels[0][0], NULL);
    int mixed = 0;
    for (int i = 0; i < 64; ++i) {
        const float *pixel = pixels[i / 8][i % 8];
        largest = pixel[0] > largest ? pixel[0] : largest;
        mixed += pixel[0] > 0 && pixel[0] < 10;
        CHECK1(pixel[3] == 1);
    }
    CHECK(largest == 10 && (mixed > 0) == (samples > 1), "largest %g, %d mixed", (double)largest,
          mixed);
    burnish_mesh_destroy(mesh);
}

/* ---- Planes ---- */

typedef struct planes {
    guarded pixels, depth, triangles, normals, coverage;
    burnish_target target;
} planes;

static planes make_planes(int width, int height, int with_pixels) {
    const size_t w = (size_t)width;
    planes p = {make_guarded(4 * w, 7, height),  make_guarded(4 * w, 8, height),
                make_guarded(4 * w, 12, height), make_guarded(12 * w, 4, height),
                make_guarded(w, 3, height),      burnish_target_default()};
    p.target.pixels = (burnish_pixels){width, height, BURNISH_PIXELS_RGBA8, p.pixels.stride,
                                       with_pixels ? p.pixels.first : NULL};
    p.target.depth = (float *)p.depth.first;
    p.target.depth_stride = p.depth.stride;
    p.target.triangles = (uint32_t *)p.triangles.first;
    p.target.triangle_stride = p.triangles.stride;
    p.target.normals = (float *)p.normals.first;
    p.target.normal_stride = p.normals.stride;
    p.target.coverage = p.coverage.first;
    p.target.coverage_stride = p.coverage.stride;
    return p;
}

static void free_planes(planes *p) {
    CHECK(!is_damaged(&p->pixels) && !is_damaged(&p->depth) && !is_damaged(&p->triangles) &&
              !is_damaged(&p->normals) && !is_damaged(&p->coverage),
          "wrote beside the rows");
    free(p->pixels.bytes);
    free(p->depth.bytes);
    free(p->triangles.bytes);
    free(p->normals.bytes);
    free(p->coverage.bytes);
}

static float depth_at(const planes *p, int x, int y) {
    return ((const float *)(const void *)row_at(&p->depth, y))[x];
}

static uint32_t triangle_at(const planes *p, int x, int y) {
    return ((const uint32_t *)(const void *)row_at(&p->triangles, y))[x];
}

static const float *normal_at(const planes *p, int x, int y) {
    return (const float *)(const void *)row_at(&p->normals, y) + 3 * x;
}

/* The unit sphere at the origin, seen along -z: depth and normal by Pythagoras. */
static void test_sphere(int samples, double orthographic_height) {
    enum { SIZE = 160 };
    burnish_mesh *mesh = load_tessellated(":sphere", 128);
    burnish_render_options options = front_options(SIZE, SIZE, orthographic_height);
    planes p = make_planes(SIZE, SIZE, 0);
    double worst_depth = 0, worst_normal = 0, worst_length = 0;
    int inside = 0;
    options.samples = samples;
    options.camera.view_angle = 14;
    draw_into(mesh, &options, &p.target, NULL);
    const double extent = orthographic_height > 0 ? orthographic_height / 2 : tan(7 * M_PI / 180);
    for (int y = 0; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x) {
            const double px = (x + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * extent;
            const double py = (SIZE / 2.0 - y - 0.5) / (SIZE / 2.0) * extent;
            /* parallel: (px, py, z); perspective: t (px, py, -1) from (0, 0, 10) */
            double t = 10 - sqrt(fmax(0, 1 - px * px - py * py)), rest = 1 - px * px - py * py;
            double n[3] = {px, py, 10 - t};
            if (orthographic_height == 0) {
                const double a = px * px + py * py + 1;
                rest = 100 - a * 99;
                t = (10 - sqrt(fmax(0, rest))) / a;
                n[0] = t * px;
                n[1] = t * py;
                n[2] = 10 - t;
            }
            if (rest > 0.1) {
                const float *normal = normal_at(&p, x, y);
                double difference = 0, length = 0;
                for (int k = 0; k < 3; ++k) {
                    difference = fmax(difference, fabs((double)normal[k] - n[k]));
                    length += (double)normal[k] * (double)normal[k];
                }
                worst_depth = fmax(worst_depth, fabs((double)depth_at(&p, x, y) - t));
                worst_normal = fmax(worst_normal, difference);
                worst_length = fmax(worst_length, fabs(sqrt(length) - 1));
                ++inside;
            } else if (rest < -0.1) {
                const float *normal = normal_at(&p, x, y);
                CHECK(isinf(depth_at(&p, x, y)) && depth_at(&p, x, y) > 0 && normal[0] == 0 &&
                          normal[1] == 0 && normal[2] == 0 &&
                          triangle_at(&p, x, y) == BURNISH_TRIANGLE_NONE &&
                          !row_at(&p.coverage, y)[x],
                      "(%d, %d) is empty", x, y);
            }
        }
    }
    CHECK(inside > 5000, "%d pixels inside", inside);
    /* where triangles share a pixel, the point is up to half a pixel from its centre */
    const double bound = samples == 1 ? 1e-3 : 0.03;
    CHECK(worst_depth < bound, "depth is off by %g", worst_depth);
    CHECK(worst_normal < bound, "normals are off by %g", worst_normal);
    CHECK(worst_length < 4e-7, "normals' length is off by %g", worst_length);
    free_planes(&p);
    burnish_mesh_destroy(mesh);
}

/* ---- Arguments ---- */

static void test_errors(void) {
    burnish_mesh *mesh = load_tessellated(":knot", 8);
    burnish_render_options options = make_options(mesh, 1);
    planes p = make_planes(WIDTH, HEIGHT, 1);
    const burnish_target good = p.target;
    burnish_renderer *renderer = make_renderer(NULL);
    burnish_target target;
    burnish_error error;
#define WRONG(change, part)                                                                        \
    do {                                                                                           \
        target = good;                                                                             \
        change;                                                                                    \
        error.text[0] = 0;                                                                         \
        CHECK(burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error) ==       \
                      BURNISH_STATUS_ARGUMENT &&                                                   \
                  strstr(error.text, part),                                                        \
              "\"%s\" says nothing of %s", error.text, part);                                      \
    } while (0)
    WRONG(target.cookie = 0, "burnish_target_default");
    WRONG(target.pixels.stride = 4 * WIDTH - 1, "pixels has a stride of 523 bytes");
    WRONG(target.pixels.width = WIDTH - 1, "130 x 77");
    WRONG(target.pixels.format = BURNISH_PIXELS_COUNT, "no pixel format");
    WRONG(target.pixels.format = BURNISH_PIXELS_GRAY16, "no pixel format");
    WRONG(target.depth_stride = 4 * WIDTH - 4, "depth");
    WRONG(target.depth_stride = 4 * WIDTH + 2, "multiple of 4");
    WRONG(target.triangle_stride = 4, "triangles");
    WRONG(target.normal_stride = 4 * WIDTH, "normals");
    WRONG(target.coverage_stride = WIDTH - 1, "coverage");
    options.transparent = 1;
    WRONG(target.pixels.format = BURNISH_PIXELS_RGB8, "alpha");
    options.transparent = 0;
    WRONG(options.samples = 3, "samples");
#undef WRONG
    CHECK1(burnish_renderer_draw_into(renderer, mesh, &options, NULL, NULL, NULL) ==
           BURNISH_STATUS_ARGUMENT);
    for (int y = 0; y < HEIGHT; ++y) {
        CHECK1(row_at(&p.pixels, y)[0] == GUARD_BYTE && row_at(&p.coverage, y)[0] == GUARD_BYTE);
    }
    burnish_renderer_destroy(renderer);
    free_planes(&p);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_formats(1));
    RUN(test_formats(4));
    RUN(test_formats(16));
    RUN(test_unclamped(1));
    RUN(test_unclamped(8));
    RUN(test_sphere(1, 2.4));
    RUN(test_sphere(1, 0));
    RUN(test_sphere(8, 2.4));
    RUN(test_sphere(4, 0));
    RUN(test_errors());
    return test_end("target");
}
