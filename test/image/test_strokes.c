/* Strokes: coverage against distances in double precision, every format,
 * threads, memory that runs out. Outlines: coverage against areas. */
#include <math.h>

#include "burnish/sheet.h"
#include "core/srgb.h"
#include "counting_context.h"
#include "image/text/glyph_outline.h"
#include "image/text/strokes.h"
#include "pictures.h"

enum { WIDTH = 61, HEIGHT = 47 };

static uint64_t state;

static float random_float(float low, float high) {
    return test_uniform_float(&state, low, high);
}

static burnish_status draw(const burnish_pixels *pixels, const burnish_stroke *strokes,
                           size_t count, float opacity) {
    static const uint8_t color[3] = {200, 100, 30};
    const burnish_ink ink = burnish_ink_of(color, opacity);
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    return burnish_strokes_draw(pixels, strokes, count, &ink, NULL, &memory);
}

static double distance_to(const burnish_stroke *s, double x, double y) {
    const double ex = (double)s->x1 - s->x0, ey = (double)s->y1 - s->y0;
    const double length2 = ex * ex + ey * ey;
    double t = length2 > 0 ? ((x - s->x0) * ex + (y - s->y0) * ey) / length2 : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(x - s->x0 - t * ex, y - s->y0 - t * ey);
}

/* Random strokes, some far outside, drawn over nothing: alpha is the largest coverage. */
static void test_coverage(float reach) {
    enum { COUNT = 12 };
    static float light[WIDTH * HEIGHT * 4];
    burnish_stroke strokes[COUNT];
    for (int i = 0; i < COUNT; ++i) {
        const float far = i % 3 == 0 ? reach : 40;
        strokes[i] = (burnish_stroke){random_float(-far, far), random_float(-far, far),
                                      random_float(-far, far), random_float(-far, far),
                                      random_float(0.1f, 3)};
    }
    memset(light, 0, sizeof light);
    const burnish_pixels pixels = floats_of(light, WIDTH, HEIGHT);
    CHECK1(draw(&pixels, strokes, COUNT, 1) == BURNISH_STATUS_OK);
    /* An end is a float, and a stroke far away is cut: its direction turns by a few ulp. */
    const double tolerance = 3e-5 + (double)reach * 1e-6;
    for (int y = 0; y < HEIGHT; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            double expected = 0;
            for (int i = 0; i < COUNT; ++i) {
                const double radius = (double)strokes[i].radius;
                const double share = 0.5 + radius - distance_to(&strokes[i], x + 0.5, y + 0.5);
                expected = fmax(expected, fmin(share, fmin(1, 2 * radius)));
            }
            const double got = (double)light[(y * WIDTH + x) * 4 + 3];
            CHECK(fabs(got - expected) <= tolerance, "reach %g, %d, %d: %g, expected %g",
                  (double)reach, x, y, got, expected);
        }
    }
}

/* Bytes are the floats' light over the same ground, BGRA is RGBA turned round, what lies between
 * rows stays. */
static void test_formats(void) {
    enum { STRIDE = WIDTH * 4 + 5 };
    static uint8_t bytes[BURNISH_PIXELS_COUNT][STRIDE * HEIGHT];
    static float light[WIDTH * HEIGHT * 4];
    const burnish_stroke strokes[] = {{3, 4, 50, 40, 1.3f}, {55, 2, 9, 44, 0.4f}};
    for (int format = 0; format < BURNISH_PIXELS_RGBA_FLOAT; ++format) {
        memset(bytes[format], 255, sizeof bytes[format]);
        const burnish_pixels pixels = {WIDTH, HEIGHT, (burnish_pixel_format)format, STRIDE,
                                       bytes[format]};
        CHECK1(draw(&pixels, strokes, 2, 0.7f) == BURNISH_STATUS_OK);
    }
    for (int i = 0; i < WIDTH * HEIGHT * 4; ++i) {
        light[i] = 1;
    }
    const burnish_pixels floats = floats_of(light, WIDTH, HEIGHT);
    CHECK1(draw(&floats, strokes, 2, 0.7f) == BURNISH_STATUS_OK);
    for (int y = 0; y < HEIGHT; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            const uint8_t *rgb = bytes[BURNISH_PIXELS_RGB8] + y * STRIDE + 3 * x;
            const uint8_t *rgba = bytes[BURNISH_PIXELS_RGBA8] + y * STRIDE + 4 * x;
            const uint8_t *bgra = bytes[BURNISH_PIXELS_BGRA8] + y * STRIDE + 4 * x;
            const float *linear = light + (y * WIDTH + x) * 4;
            CHECK1(memcmp(rgb, rgba, 3) == 0 && rgba[3] == 255 && bgra[3] == 255);
            CHECK1(bgra[0] == rgba[2] && bgra[1] == rgba[1] && bgra[2] == rgba[0]);
            for (int k = 0; k < 3; ++k) {
                CHECK(rgb[k] == burnish_linear_to_srgb(linear[k]), "%d, %d: %d", x, y, rgb[k]);
            }
        }
        for (int x = 4 * WIDTH; x < STRIDE; ++x) {
            CHECK1(bytes[BURNISH_PIXELS_RGBA8][y * STRIDE + x] == 255);
        }
    }
}

static void test_extremes(void) {
    const float values[] = {(float)NAN, (float)INFINITY, -(float)INFINITY, 3e38f, -3e38f, 1e30f};
    static float light[WIDTH * HEIGHT * 4];
    const burnish_pixels pixels = floats_of(light, WIDTH, HEIGHT);
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        for (int k = 0; k < 4; ++k) {
            float ends[4] = {-10, -10, -10, -20};
            ends[k] = values[i];
            const burnish_stroke stroke = {ends[0], ends[1], ends[2], ends[3], 1};
            CHECK1(draw(&pixels, &stroke, 1, 1) == BURNISH_STATUS_OK);
        }
    }
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        CHECK(light[4 * i + 3] == 0, "ink at pixel %d", i);
    }
    const burnish_stroke across = {-9e8f, 20.5f, 1e9f, 20.5f, 0.5f};
    CHECK1(draw(&pixels, &across, 1, 1) == BURNISH_STATUS_OK);
    CHECK(light[(20 * WIDTH + 30) * 4 + 3] > 0.99f, "a line through the picture, %g",
          (double)light[(20 * WIDTH + 30) * 4 + 3]);
    const float radii[] = {0, -1, (float)NAN, 1025};
    for (size_t i = 0; i < sizeof radii / sizeof *radii; ++i) {
        const burnish_stroke stroke = {1, 1, 2, 2, radii[i]};
        CHECK1(draw(&pixels, &stroke, 1, 1) == BURNISH_STATUS_ARGUMENT);
    }
}

/* More strokes in bands than are listed at a time, by any number of threads: the same bytes. */
static void test_bands(void) {
    enum { TALL = BURNISH_IMAGE_MAX_SIZE, THIN = 3, COUNT = 1100 };
    static uint8_t pictures[2][TALL][THIN][3];
    static burnish_stroke strokes[COUNT];
    const uint8_t black[3] = {0, 0, 0};
    const burnish_ink ink = burnish_ink_of(black, 1);
    strokes[0] = (burnish_stroke){0.5f, 16000.5f, 0.5f, 16100.5f, 0.5f};
    for (int i = 1; i < COUNT; ++i) { /* touch the last column */
        strokes[i] = (burnish_stroke){3, 0, 3, TALL, 0.5f};
    }
    for (int t = 0; t < 2; ++t) {
        const burnish_pixels view = {THIN, TALL, BURNISH_PIXELS_RGB8, THIN * 3, **pictures[t]};
        burnish_tasks tasks;
        burnish_memory memory = burnish_memory_of(NULL, NULL);
        burnish_tasks_begin(&tasks, NULL, t ? 7 : 1);
        memset(pictures[t], 255, sizeof pictures[t]);
        CHECK1(burnish_strokes_draw(&view, strokes, COUNT, &ink, &tasks, &memory) ==
               BURNISH_STATUS_OK);
    }
    CHECK1(memcmp(pictures[0], pictures[1], sizeof pictures[0]) == 0);
    for (int y = 0; y < TALL; ++y) {
        const int inside = y >= 16000 && y <= 16100;
        CHECK(pictures[0][y][0][0] == (inside ? 0 : 255), "row %d: %d", y, pictures[0][y][0][0]);
        CHECK(pictures[0][y][1][0] == 255, "row %d: %d", y, pictures[0][y][1][0]);
        CHECK(pictures[0][y][2][0] == 188, "row %d: %d", y, pictures[0][y][2][0]); /* half */
    }
}

static burnish_status draw_again(const burnish_context *context, const void *data, uint64_t *hash,
                                 burnish_error *error) {
    static uint8_t bytes[WIDTH * HEIGHT * 3];
    const burnish_pixels pixels = {WIDTH, HEIGHT, BURNISH_PIXELS_RGB8, WIDTH * 3, bytes};
    const burnish_stroke stroke = {1, 1, 50, 40, 1};
    const burnish_ink ink = burnish_ink_of((uint8_t[3]){0}, 1);
    burnish_memory memory = burnish_memory_of(context, error);
    burnish_tasks tasks;
    (void)data;
    memset(bytes, 255, sizeof bytes);
    burnish_tasks_begin(&tasks, context, 1);
    const burnish_status status = burnish_strokes_draw(&pixels, &stroke, 1, &ink, &tasks, &memory);
    *hash = test_add_hash(0, bytes, sizeof bytes);
    return status;
}

static void test_refusals(void) {
    int cancelled;
    const int failures = check_stops(draw_again, NULL, &cancelled);
    CHECK(failures == 3 && cancelled >= 3, "%d failures, %d cancelled", failures, cancelled);
}

/* ---- Outlines: coverage is the area of the pixel, whatever the shape, its sense and its place ---- */

enum { SIDE = 40 };

/* Linear pixels whose fourth channel is the coverage. */
typedef struct canvas {
    float values[SIDE][SIDE][4];
    burnish_pixels pixels;
    burnish_memory memory;
    burnish_outline outline;
} canvas;

static void begin(canvas *made) {
    memset(made->values, 0, sizeof made->values);
    made->pixels = floats_of(made->values[0][0], SIDE, SIDE);
    made->memory = burnish_memory_of(NULL, NULL);
    made->outline = (burnish_outline){.memory = &made->memory};
}

static void fill(canvas *made) {
    const burnish_ink ink = {{1, 1, 1}, 1};
    CHECK1(burnish_outline_fill(&made->outline, &made->pixels, &ink) == BURNISH_STATUS_OK);
}

/* Points are y upward: the sense of y is turned for pixels from the top. */
static void polygon(canvas *made, const int32_t (*points)[2], int count) {
    begin(made);
    for (int i = 0; i < count; ++i) {
        const int32_t p[2] = {points[i][0], -points[i][1]};
        burnish_outline_add(&made->outline, i ? BURNISH_OUTLINE_LINE : BURNISH_OUTLINE_MOVE, p);
    }
    fill(made);
}

static double total(const canvas *made) {
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        sum += (double)made->values[i / SIDE][i % SIDE][3];
    }
    return sum;
}

/* Area of the triangle within the pixel: clipped by its four sides (Sutherland and Hodgman). */
static double clipped_area(const int32_t (*t)[2], int px, int py) {
    double p[16][2], q[16][2];
    int count = 3;
    for (int i = 0; i < 3; ++i) {
        p[i][0] = t[i][0] / 256.0 - px;
        p[i][1] = t[i][1] / 256.0 - py;
    }
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2, upper = side % 2;
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            const double *a = p[i], *b = p[(i + 1) % count];
            const double da = upper ? 1 - a[axis] : a[axis], db = upper ? 1 - b[axis] : b[axis];
            if (da >= 0) {
                memcpy(q[kept++], a, sizeof q[0]);
            }
            if ((da < 0) != (db < 0)) {
                const double s = da / (da - db);
                q[kept][0] = a[0] + s * (b[0] - a[0]);
                q[kept++][1] = a[1] + s * (b[1] - a[1]);
            }
        }
        memcpy(p, q, sizeof p);
        count = kept;
    }
    double area = 0;
    for (int i = 0; i < count; ++i) {
        area += p[i][0] * p[(i + 1) % count][1] - p[(i + 1) % count][0] * p[i][1];
    }
    return fabs(area) / 2;
}

static void test_triangles(void) {
    static canvas made, turned;
    uint64_t random = test_seed(4);
    for (int i = 0; i < 100; ++i) {
        int32_t t[3][2], back[3][2];
        double worst = 0;
        for (int k = 0; k < 3; ++k) {
            t[k][0] = (int32_t)test_uniform(&random, -10 * 256, 50 * 256);
            t[k][1] = (int32_t)test_uniform(&random, -10 * 256, 50 * 256);
            memcpy(back[2 - k], t[k], sizeof back[0]);
        }
        polygon(&made, (const int32_t(*)[2])t, 3);
        polygon(&turned, (const int32_t(*)[2])back, 3);
        CHECK1(memcmp(made.values, turned.values, sizeof made.values) == 0);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            const double got = (double)made.values[k / SIDE][k % SIDE][3];
            const double expected = clipped_area((const int32_t(*)[2])t, k % SIDE, k / SIDE);
            worst = fmax(worst, fabs(got - expected));
        }
        CHECK(worst < 0.012, "triangle %d: off by %g", i, worst); /* crossings at 1/256 pixel */
    }
}

/* Circles of conic and cubic pieces; a hole wound the other way. */
static void test_curves(void) {
    static canvas made;
    const int32_t r = 15 * 256, c = 20 * 256, k = (int32_t)(0.5522847498 * r);
    const double pi = acos(-1.0);
    begin(&made);
    const int32_t start[2] = {c + r, -c};
    const int32_t arcs[4][6] = {{c + r, -c + k, c + k, -c + r, c, -c + r},
                                {c - k, -c + r, c - r, -c + k, c - r, -c},
                                {c - r, -c - k, c - k, -c - r, c, -c - r},
                                {c + k, -c - r, c + r, -c - k, c + r, -c}};
    burnish_outline_add(&made.outline, BURNISH_OUTLINE_MOVE, start);
    for (int i = 0; i < 4; ++i) {
        burnish_outline_add(&made.outline, BURNISH_OUTLINE_CUBIC, arcs[i]);
    }
    fill(&made);
    CHECK(fabs(total(&made) / (pi * 225) - 1) < 0.004, "%g of %g", total(&made), pi * 225);
    /* a parabola over 20 pixels, 10 high: 2/3 of its box; its hole: half as wide and high */
    begin(&made);
    for (int hole = 0; hole < 2; ++hole) {
        const int32_t half = (hole ? 5 : 10) * 256, high = (hole ? 10 : 20) * 256;
        const int32_t from[2] = {c + (hole ? half : -half), -30 * 256};
        const int32_t bow[4] = {c, -30 * 256 + high, c + (hole ? -half : half), -30 * 256};
        burnish_outline_add(&made.outline, BURNISH_OUTLINE_MOVE, from);
        burnish_outline_add(&made.outline, BURNISH_OUTLINE_CONIC, bow);
    }
    fill(&made);
    const double expected = 2.0 / 3 * (20 * 10 - 10 * 5);
    CHECK(fabs(total(&made) / expected - 1) < 0.01, "%g of %g", total(&made), expected);
}

/* Coordinates far outside neither overflow nor mark anything but what they cover. */
static void test_far(void) {
    static canvas made;
    const int32_t all[4][2] = {{-2000000000, -2000000000},
                               {2000000000, -2000000000},
                               {2000000000, 2000000000},
                               {-2000000000, 2000000000}};
    const int32_t beside[3][2] = {{50 * 256, 0}, {2000000000, 5000}, {60 * 256, 30 * 256}};
    polygon(&made, all, 4);
    CHECK1(total(&made) == SIDE * SIDE);
    polygon(&made, beside, 3);
    CHECK1(total(&made) == 0);
    begin(&made);
    fill(&made);
    CHECK1(total(&made) == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    state = test_seed(1);
    RUN(test_coverage(100));
    RUN(test_coverage(1e6f));
    RUN(test_formats());
    RUN(test_extremes());
    RUN(test_bands());
    RUN(test_refusals());
    RUN(test_triangles());
    RUN(test_curves());
    RUN(test_far());
    return test_end("strokes");
}
