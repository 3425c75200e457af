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

static inline double schlick(double f0, double cosine) {
    return f0 + (1 - f0) * pow(1 - fmin(fmax(cosine, 0), 1), 5);
}

/* ---- Lights ---- */

static const burnish_area_light areas[2] = {
    {BURNISH_AREA_RECT, 0, 0, 1, {-1.2, 1.1, 1.3}, {0.6, 0, 0.5}, {0, 0.6, 0}, {1.2f, 1.2f, 1.2f}},
    {BURNISH_AREA_RECT, 1, 0, 1, {-0.8, 0.7, 0.9}, {0.4, 0, 0.35}, {0, 0.4, 0}, {1.2f, 1.2f, 1.2f}},
};

/* A dark room with a window and a lamp. */
static float room[ROWS][COLUMNS];

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

/* The room as an environment. */
static inline burnish_environment *make_room(void) {
    static float rgb[ROWS][COLUMNS][3];
    burnish_environment *environment;
    burnish_error error;
    for (int i = 0; i < ROWS * COLUMNS; ++i) {
        const int x = i % COLUMNS, y = i / COLUMNS;
        const int is_window = x >= 78 && x < 98 && y >= 12 && y < 30;
        const int is_lamp = x >= 112 && x < 118 && y >= 20 && y < 26;
        room[y][x] = is_window ? 8 : is_lamp ? 18 : 0.03f + 0.02f * (float)y / ROWS;
        set_three(rgb[y][x], room[y][x]);
    }
    CHECK_OK(burnish_environment_create(NULL, COLUMNS, ROWS, rgb[0][0], &environment, &error),
             error);
    return environment;
}

/* ---- Shapes and their pixels ---- */

/* A sphere and a tilted square. */
static inline void make_shapes(burnish_mesh *meshes[SHAPES]) {
    static const float corners[] = {-1, -0.8f, 0.9f,  1,  -0.8f, 0.9f,
                                    1,  0.7f,  -0.9f, -1, 0.7f,  -0.9f};
    meshes[0] = load_tessellated(":sphere", 64);
    meshes[1] = create_quads(corners, NULL, 1);
}

static inline void draw_shape(const burnish_mesh *mesh, const burnish_render_options *options) {
    const burnish_target target = make_target(floats_of(picture.rgba[0][0], SIDE, SIDE),
                                              picture.depth[0], picture.normal[0][0], NULL, NULL);
    draw_into(mesh, options, &target, NULL);
}

/* What a pixel shows; returns 0 for the background. */
static inline int find_surface(int x, int y, vec position, vec normal) {
    position[0] = ((x + 0.5) / SIDE - 0.5) * 2.2;
    position[1] = (0.5 - (y + 0.5) / SIDE) * 2.2;
    position[2] = 4 - (double)picture.depth[y][x];
    for (int k = 0; k < 3; ++k) {
        normal[k] = (double)picture.normal[y][x][k];
    }
    return isfinite(picture.depth[y][x]);
}

/* Axes of a surface, the last of which is its normal, and v along them. */
static inline void make_frame(const vec normal, const vec v, vec axes[3], vec local) {
    cross(normal, fabs(normal[0]) < 0.6 ? (vec){1, 0, 0} : (vec){0, 1, 0}, axes[0]);
    normalize(axes[0]);
    cross(normal, axes[0], axes[1]);
    for (int k = 0; k < 3; ++k) {
        axes[2][k] = normal[k];
    }
    for (int k = 0; k < 3; ++k) {
        local[k] = dot(v, axes[k]);
    }
}

/* What comes to a point along a direction in terms of the axes. */
static inline double local_radiance(int light, const vec position, vec axes[3], const vec local) {
    vec w;
    for (int k = 0; k < 3; ++k) {
        w[k] = local[0] * axes[0][k] + local[1] * axes[1][k] + local[2] * axes[2][k];
    }
    return radiance(light, position, w);
}

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

enum { ERRORS_MOST = 1024 };
typedef struct errors {
    double squares, sum, sizes[ERRORS_MOST];
    int count;
} errors;

/* Adds a difference in 8-bit codes. */
static inline void add_error(errors *e, double value, double should) {
    const double d = srgb(value) - srgb(should);
    e->squares += d * d;
    e->sizes[e->count % ERRORS_MOST] = fabs(d);
    e->sum += d;
    ++e->count;
}

#endif
