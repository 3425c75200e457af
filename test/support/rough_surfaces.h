/* For tests: what rough surfaces reflect of near and distant windows and of a dark room, in the
 * pixels of a picture. */
#ifndef BURNISH_TEST_ROUGH_SURFACES_H
#define BURNISH_TEST_ROUGH_SURFACES_H

#include <math.h>

#include "burnish/light.h"
#include "core/vec3.h"
#include "pictures.h"
#include "vec.h"

enum { SIDE = 320, COLUMNS = 128, ROWS = 64, SHAPES = 2, LIGHTS = 3 };

typedef double vec[3];

static struct picture {
    float rgba[SIDE][SIDE][4], depth[SIDE][SIDE], normal[SIDE][SIDE][3];
} picture;

static uint64_t seed;

static inline double drawn(void) {
    return (double)test_uniform_float(&seed, 0, 1);
}

/* ---- Microfacets of GGX, N being z ---- */

static inline double smith(const vec w, double alpha) {
    const double t = alpha * alpha * (1 - w[2] * w[2]) / (w[2] * w[2]);
    return (-1 + copysign(sqrt(1 + t), w[2])) / 2;
}

/* A normal that is seen from w (Dupuy and Benyoub 2023), from two numbers in [0, 1). */
static inline void visible_normal(const vec w, double alpha, double a, double b, vec m) {
    vec v = {alpha * w[0], alpha * w[1], w[2]};
    normalize(v);
    const double z = (1 - a) * (1 + v[2]) - v[2], s = sqrt(fmax(0, 1 - z * z));
    m[0] = alpha * (s * cos(2 * M_PI * b) + v[0]);
    m[1] = alpha * (s * sin(2 * M_PI * b) + v[1]);
    m[2] = z + v[2];
    normalize(m);
}

/* ---- Lights ---- */

static const burnish_area_light areas[2] = {
    {BURNISH_AREA_RECT, 0, 0, 1, {-1.2, 1.1, 1.3}, {0.6, 0, 0.5}, {0, 0.6, 0}, {1.2f, 1.2f, 1.2f}},
    {BURNISH_AREA_RECT, 1, 0, 1, {-0.8, 0.7, 0.9}, {0.4, 0, 0.35}, {0, 0.4, 0}, {1.2f, 1.2f, 1.2f}},
};

/* A dark room with a window and a lamp. */
static float room[ROWS][COLUMNS];

static inline void furnish(void) {
    for (int i = 0; i < ROWS * COLUMNS; ++i) {
        const int x = i % COLUMNS, y = i / COLUMNS;
        const int is_window = x >= 78 && x < 98 && y >= 12 && y < 30;
        const int is_lamp = x >= 112 && x < 118 && y >= 20 && y < 26;
        room[y][x] = is_window ? 8 : is_lamp ? 18 : 0.03f + 0.02f * (float)y / ROWS;
    }
}

/* What comes from direction w to a point. */
static inline double radiance(int light, const vec position, const vec w) {
    if (light == 2) {
        const double azimuth = atan2(w[2], w[0]) / (2 * M_PI) + 0.5;
        const int x = (int)fmin(azimuth * COLUMNS, COLUMNS - 1);
        const int y = (int)fmin(acos(fmin(fmax(w[1], -1), 1)) / M_PI * ROWS, ROWS - 1);
        return 0.25 * (double)room[y][x];
    }
    const burnish_area_light *area = &areas[light];
    const double *u = area->half_u, *v = area->half_v;
    vec n, c, d;
    for (int k = 0; k < 3; ++k) {
        c[k] = area->center[k] - (area->is_distant ? 0 : position[k]);
    }
    cross(u, v, n);
    const double t = dot(n, c) / dot(n, w);
    for (int k = 0; k < 3; ++k) {
        d[k] = t * w[k] - c[k];
    }
    return t > 0 && fabs(dot(d, u)) <= dot(u, u) && fabs(dot(d, v)) <= dot(v, v)
               ? (double)area->color[0]
               : 0;
}

/* ---- Pixels ---- */

static inline double srgb(double x) {
    const double c = fmin(fmax(x, 0), 1);
    return 255 * (c < 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055);
}

static inline burnish_render_options options_for(int light, burnish_environment *environment) {
    burnish_render_options options = front_options(SIDE, SIDE, 2.2);
    options.light_count = 0;
    options.camera.position[2] = 4;
    options.up[1] = 1;
    set_three(options.ambient_light, 0);
    if (light < 2) {
        options.area_lights[0] = areas[light];
        options.area_light_count = 1;
    } else {
        options.environment = environment;
        options.environment_strength = 0.25f;
    }
    return options;
}

typedef struct errors {
    double squares, sum, sizes[SHAPES * SIDE * SIDE / 877 + SHAPES];
    int count;
} errors;

#endif
