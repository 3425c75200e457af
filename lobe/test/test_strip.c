/* The Arduino library's rasteriser against the obvious one: per pixel exact edges in 64 bits, depth
 * and normal in double precision. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "support.h"

#include "burnish/ring.h"

enum { WIDTH = 64, HEIGHT = 48, TRIANGLES = 12, SCENES = 400, GUARD = 0xA5 };

/* What a pixel got last, and from which triangle. */
typedef struct seen {
    int triangle;
    int16_t normal[3];
} seen;

typedef struct picture {
    seen pixels[HEIGHT][WIDTH];
    int current, top, rows;
} picture;

static void take(void *user_data, uint8_t x, uint8_t y, const int16_t normal[3]) {
    picture *to = user_data;
    if (CHECK(x < WIDTH && y < to->rows, "pixel %d, %d of a strip of %d rows", x, y, to->rows)) {
        seen *pixel = &to->pixels[to->top + y][x];
        pixel->triangle = to->current;
        memcpy(pixel->normal, normal, sizeof pixel->normal);
    }
}

typedef struct triangle {
    burnish_strip_corner corner[3];
} triangle;

/* A direction within `spread` of another, in Q15. */
static void near_direction(uint64_t *state, const double from[3], double spread, int16_t to[3]) {
    double v[3], length = 0;
    for (int k = 0; k < 3; ++k) {
        v[k] = from[k] + test_uniform(state, -spread, spread);
        length += v[k] * v[k];
    }
    for (int k = 0; k < 3; ++k) {
        to[k] = (int16_t)lrint(32767 * v[k] / sqrt(length));
    }
}

/* Triangles of all sizes, slivers and ones that are partly outside; their normals differ by at most
 * 40 degrees. */
static void make_scene(uint64_t *state, triangle scene[TRIANGLES]) {
    for (int i = 0; i < TRIANGLES; ++i) {
        double axis[3];
        const double size = i % 3 == 0 ? 40 : i % 3 == 1 ? 200 : 700;
        const double x = test_uniform(state, -100, 16 * WIDTH + 100);
        const double y = test_uniform(state, -100, 16 * HEIGHT + 100);
        double length = 0;
        for (int k = 0; k < 3; ++k) {
            axis[k] = test_uniform(state, -1, 1);
            length += axis[k] * axis[k];
        }
        for (int k = 0; k < 3; ++k) {
            axis[k] /= sqrt(length + 1e-9);
        }
        for (int c = 0; c < 3; ++c) {
            burnish_strip_corner *corner = &scene[i].corner[c];
            corner->x = (int16_t)(x + test_uniform(state, -size, size));
            corner->y = (int16_t)(y + test_uniform(state, -size, size) * (i % 4 == 3 ? .02 : 1));
            corner->z = (int16_t)test_uniform(state, 0x200, 0x7E00);
            near_direction(state, axis, .2, corner->normal);
        }
    }
}

static void draw(const triangle scene[TRIANGLES], int rows, picture *to) {
    uint8_t depth[WIDTH * HEIGHT + 2];
    memset(to, 0, sizeof *to);
    for (int top = 0; top < HEIGHT; top += rows) {
        const burnish_strip strip = {depth + 1, WIDTH, (uint8_t)rows, (uint8_t)top, take, to};
        memset(depth, GUARD, sizeof depth);
        to->top = top;
        to->rows = rows;
        burnish_strip_clear(&strip);
        for (int i = 0; i < TRIANGLES; ++i) {
            to->current = i + 1;
            burnish_strip_triangle(&strip, &scene[i].corner[0], &scene[i].corner[1],
                                   &scene[i].corner[2]);
        }
        CHECK(depth[0] == GUARD && depth[WIDTH * rows + 1] == GUARD, "a strip of %d rows overflows",
              rows);
    }
}

/* Twice the area, in 64 bits. */
static int64_t area(const burnish_strip_corner *a, const burnish_strip_corner *b, int64_t x,
                    int64_t y) {
    return (int64_t)(b->y - a->y) * (x - a->x) - (int64_t)(b->x - a->x) * (y - a->y);
}

/* Weights of the corners at a pixel's centre; 0 where the triangle is not there. */
static int covers(const triangle *t, int column, int row, double weight[3]) {
    const burnish_strip_corner *c = t->corner;
    const int64_t x = 16 * column + 8, y = 16 * row + 8, whole = area(&c[0], &c[1], c[2].x, c[2].y);
    const int64_t edge[3] = {area(&c[1], &c[2], x, y), area(&c[2], &c[0], x, y),
                             area(&c[0], &c[1], x, y)};
    for (int i = 0; i < 3; ++i) {
        weight[i] = (double)edge[i] / (double)whole;
    }
    return whole > 0 && edge[0] >= 0 && edge[1] >= 0 && edge[2] >= 0;
}

/* Depth and normal of a triangle there. */
static double value(const triangle *t, const double weight[3], double normal[3]) {
    double z = 0, length = 0;
    for (int k = 0; k < 3; ++k) {
        normal[k] = 0;
        z += weight[k] * t->corner[k].z;
        for (int i = 0; i < 3; ++i) {
            normal[k] += weight[i] * t->corner[i].normal[k];
        }
        length += normal[k] * normal[k];
    }
    for (int k = 0; k < 3; ++k) {
        normal[k] /= sqrt(length);
    }
    return z;
}

static double worst_angle, worst_length;
static long covered;

static void check_pixel(const triangle scene[TRIANGLES], const picture *from, int column, int row) {
    const seen *pixel = &from->pixels[row][column];
    double nearest = -1, chosen = -1, weight[3], normal[3], wanted[3] = {0, 0, 0};
    for (int i = 0; i < TRIANGLES; ++i) {
        if (covers(&scene[i], column, row, weight)) {
            const double z = value(&scene[i], weight, normal);
            nearest = fmax(nearest, z);
            if (pixel->triangle == i + 1) {
                chosen = z;
                memcpy(wanted, normal, sizeof wanted);
            }
        }
    }
    CHECK((nearest >= 0) == (pixel->triangle > 0), "%d, %d: covered %d", column, row,
          pixel->triangle);
    if (pixel->triangle > 0 && nearest >= 0) {
        double length = 0, along = 0;
        CHECK(chosen >= nearest - 0x80 - 64, "%d, %d: depth %.1f, the nearest is %.1f", column, row,
              chosen, nearest);
        for (int k = 0; k < 3; ++k) {
            length += (double)pixel->normal[k] * pixel->normal[k];
            along += wanted[k] * pixel->normal[k];
        }
        length = sqrt(length);
        worst_angle = fmax(worst_angle, acos(fmin(1, along / length)));
        worst_length = fmax(worst_length, fabs(length / 32768 - 1));
        ++covered;
    }
}

static void test_triangles(void) {
    static const int heights[] = {1, 3, 8, 16};
    static picture whole, strips;
    uint64_t state = test_seed(1);
    for (int number = 0; number < SCENES; ++number) {
        triangle scene[TRIANGLES];
        make_scene(&state, scene);
        draw(scene, HEIGHT, &whole);
        for (int row = 0; row < HEIGHT; ++row) {
            for (int column = 0; column < WIDTH; ++column) {
                check_pixel(scene, &whole, column, row);
            }
        }
        draw(scene, heights[number % 4], &strips);
        CHECK(memcmp(whole.pixels, strips.pixels, sizeof whole.pixels) == 0,
              "scene %d: other pixels in strips of %d rows", number, heights[number % 4]);
    }
    CHECK(covered > 10 * SCENES, "%ld pixels only", covered);
    CHECK(worst_angle < .004 && worst_length < .01, "normals: %.5f rad, length %.5f", worst_angle,
          worst_length);
    printf("strip: %ld pixels, normals within %.5f rad, length within %.5f\n", covered, worst_angle,
           worst_length);
}

static double length_of(const int16_t v[3]) {
    return sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]) / 32768;
}

static void ignore(void *user_data, uint8_t x, uint8_t y, const int16_t normal[3]) {
    (void)user_data;
    (void)x;
    (void)y;
    (void)normal;
}

/* A ring that faces the viewer covers the area between two circles; turned, its normals stay unit.
 */
static void test_ring(void) {
    enum { SIZE = 96, LARGE = 30, SMALL = 12 };
    static uint8_t depth[SIZE * SIZE];
    burnish_ring ring;
    burnish_strip_corner corners[BURNISH_RING_CORNERS];
    const burnish_strip strip = {depth, SIZE, SIZE, 0, ignore, NULL};
    const double exact =
        acos(-1) * ((LARGE + SMALL) * (LARGE + SMALL) - (LARGE - SMALL) * (LARGE - SMALL));
    int count = 0;
    burnish_ring_create(&ring, SIZE * 8, SIZE * 8, LARGE * 16, SMALL * 16);
    for (int turn = 0; turn < 64; ++turn) {
        burnish_ring_turn(&ring, (uint16_t)(turn * 1021), (uint16_t)(turn * 733));
        for (uint8_t side = 0; side < BURNISH_RING_SIDES; ++side) {
            burnish_ring_section(&ring, side, corners);
            for (int i = 0; i < BURNISH_RING_CORNERS; ++i) {
                CHECK(fabs(length_of(corners[i].normal) - 1) < .006, "turn %d: a normal of %.4f",
                      turn, length_of(corners[i].normal));
                CHECK(corners[i].z >= 0x200 && corners[i].z <= 0x7E00, "turn %d: depth %d", turn,
                      corners[i].z);
            }
        }
    }
    burnish_ring_turn(&ring, 0, 0);
    burnish_strip_clear(&strip);
    burnish_ring_draw(&ring, &strip);
    for (int i = 0; i < SIZE * SIZE; ++i) {
        count += depth[i] > 0;
    }
    CHECK(fabs(count / exact - 1) < .02, "%d pixels, a ring has %.0f", count, exact);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_triangles());
    RUN(test_ring());
    return test_end("strip");
}
