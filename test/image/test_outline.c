/* Outlines: coverage is the area of the pixel, whatever the shape, its sense and its place. */
#include <math.h>

#include "burnish/sheet.h"
#include "image/text/glyph_outline.h"
#include "support.h"

enum { SIZE = 40 };

/* Linear pixels whose fourth channel is the coverage. */
typedef struct canvas {
    float values[SIZE][SIZE][4];
    burnish_pixels pixels;
    burnish_memory memory;
    burnish_outline outline;
} canvas;

static void begin(canvas *made) {
    memset(made->values, 0, sizeof made->values);
    made->pixels = (burnish_pixels){SIZE, SIZE, BURNISH_PIXELS_RGBA_FLOAT, sizeof made->values[0],
                                    (uint8_t *)made->values};
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

static double overlap(double a, double b, int pixel) {
    return fmax(0, fmin(b, pixel + 1) - fmax(a, pixel));
}

static double total(const canvas *made) {
    double sum = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        sum += (double)made->values[i / SIZE][i % SIZE][3];
    }
    return sum;
}

/* Rectangles, also ones that leave the picture: exactly the product of two overlaps. */
static void test_rectangles(void) {
    static canvas made;
    uint64_t random = test_seed(3);
    for (int i = 0; i < 200; ++i) {
        int32_t x[2], y[2];
        for (int k = 0; k < 2; ++k) {
            x[k] = (int32_t)test_uniform(&random, -20 * 256, 60 * 256);
            y[k] = (int32_t)test_uniform(&random, -20 * 256, 60 * 256);
        }
        const int32_t points[4][2] = {{x[0], y[0]}, {x[1], y[0]}, {x[1], y[1]}, {x[0], y[1]}};
        double worst = 0;
        polygon(&made, points, 4);
        const double left = fmin(x[0], x[1]) / 256, right = fmax(x[0], x[1]) / 256;
        const double top = fmin(y[0], y[1]) / 256, bottom = fmax(y[0], y[1]) / 256;
        for (int k = 0; k < SIZE * SIZE; ++k) {
            const double expected = overlap(left, right, k % SIZE) * overlap(top, bottom, k / SIZE);
            const double got = (double)made.values[k / SIZE][k % SIZE][3];
            worst = fmax(worst, fabs(got - expected));
        }
        CHECK(worst < 1e-6, "rectangle %d: off by %g", i, worst);
    }
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
        for (int k = 0; k < SIZE * SIZE; ++k) {
            const double got = (double)made.values[k / SIZE][k % SIZE][3];
            const double expected = clipped_area((const int32_t(*)[2])t, k % SIZE, k / SIZE);
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
    CHECK1(total(&made) == SIZE * SIZE);
    polygon(&made, beside, 3);
    CHECK1(total(&made) == 0);
    begin(&made);
    fill(&made);
    CHECK1(total(&made) == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_rectangles());
    RUN(test_triangles());
    RUN(test_curves());
    RUN(test_far());
    return test_end("outline");
}
