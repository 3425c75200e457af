/* Fits the lobes of near lights to GGX: the slope, the axis and the stretch in shaders/burnish.shade and
 * src/shading/environment_simd.h, by coordinate search from the constants there. Prints the root of the
 * mean square of the error, times the albedo, averaged over roughnesses and views, before and after. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "burnish/kernels.h"
#include "burnish/theory.h"

enum { ROUGHNESSES = 10, VIEWS = 7, LIGHTS = 120, SAMPLES = 2048, PARAMETERS = 7 };

static const double VIEW_COSINES[VIEWS] = {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9};

typedef struct scene {
    double roughness, cosine, albedo;
    burnish_kernels_polygon lights[LIGHTS];
    double expected[LIGHTS]; /* times the albedo */
} scene;

static scene scenes[ROUGHNESSES * VIEWS];

static double drawn(double low, double high) {
    return low + (high - low) * ((rand() + 0.5) / (RAND_MAX + 1.0));
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        c[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static void set_length(double a[3], double length) {
    const double scale = length / sqrt(dot(a, a));
    for (int k = 0; k < 3; ++k) {
        a[k] *= scale;
    }
}

/* A rectangle near the mirror direction of (sin, 0, cosine), nearer to it on smooth surfaces. */
static void draw_light(const scene *s, double center[3], double u[3], double v[3]) {
    const double spread = 0.6 * s->roughness * s->roughness + drawn(0.1, 0.4);
    double facing[3], other[3];
    for (int k = 0; k < 3; ++k) {
        const double mirror = k == 0 ? -sqrt(1 - s->cosine * s->cosine) : k == 2 ? s->cosine : 0;
        center[k] = mirror + spread * drawn(-1, 1);
        other[k] = drawn(-1, 1);
    }
    center[2] = center[2] < -0.1 ? -center[2] : center[2];
    set_length(center, drawn(1, 2));
    for (int k = 0; k < 3; ++k) {
        facing[k] = -center[k] + 0.5 * drawn(-1, 1);
    }
    cross(facing, other, u);
    cross(facing, u, v);
    set_length(u, drawn(0.1, 0.8));
    set_length(v, drawn(0.1, 0.8));
}

static double radical_inverse(int i) {
    double x = 0;
    for (double half = 0.5; i > 0; i /= 2, half /= 2) {
        x += i % 2 * half;
    }
    return x;
}

/* Light of radiance 1 by half vectors from GGX, with Smith's correlated shadowing; without a light the
 * albedo. */
static double reflect(const scene *s, const double *center, const double *u, const double *v) {
    const double alpha = s->roughness * s->roughness, a2 = alpha * alpha;
    const double viewer[3] = {sqrt(1 - s->cosine * s->cosine), 0, s->cosine};
    double normal[3] = {0, 0, 0}, sum = 0;
    if (center) {
        cross(u, v, normal);
    }
    for (int i = 0; i < SAMPLES; ++i) {
        const double r = (i + 0.5) / SAMPLES, phi = 2 * M_PI * radical_inverse(i);
        const double z = sqrt((1 - r) / (1 + (a2 - 1) * r)), across = sqrt(1 - z * z);
        const double h[3] = {across * cos(phi), across * sin(phi), z}, v_h = dot(viewer, h);
        const double w[3] = {2 * v_h * h[0] - viewer[0], 2 * v_h * h[1] - viewer[1],
                             2 * v_h * h[2] - viewer[2]};
        if (!(v_h > 0 && w[2] > 0)) {
            continue;
        }
        int is_lit = !center;
        if (center) {
            const double t = dot(normal, center) / dot(normal, w);
            const double d[3] = {t * w[0] - center[0], t * w[1] - center[1], t * w[2] - center[2]};
            is_lit = t > 0 && fabs(dot(d, u)) <= dot(u, u) && fabs(dot(d, v)) <= dot(v, v);
        }
        const double to_v = w[2] * sqrt(a2 + (1 - a2) * viewer[2] * viewer[2]);
        const double to_w = viewer[2] * sqrt(a2 + (1 - a2) * w[2] * w[2]);
        sum += is_lit ? 2 * w[2] / (to_v + to_w) * v_h / z : 0;
    }
    return sum / SAMPLES;
}

static void make_scene(scene *s, double roughness, double cosine) {
    s->roughness = roughness;
    s->cosine = cosine;
    s->albedo = reflect(s, NULL, NULL, NULL);
    for (int i = 0; i < LIGHTS; ++i) {
        double center[3], u[3], v[3];
        draw_light(s, center, u, v);
        s->lights[i] = burnish_kernels_polygon_default();
        s->lights[i].is_two_sided = 1;
        for (int c = 0; c < 4; ++c) {
            const double x = c == 1 || c == 2 ? 1 : -1, y = c > 1 ? 1 : -1;
            for (int k = 0; k < 3; ++k) {
                s->lights[i].vertices[c][k] = (float)(center[k] + x * u[k] + y * v[k]);
            }
        }
        s->expected[i] = reflect(s, center, u, v);
    }
}

/* p: slope; lean = p1 r^(p2 + p3 cosine) r / (r + p4); width = x + (1 - x) p5 r^p6 across. */
static double scene_error(scene *s, const double p[PARAMETERS]) {
    static const float origin[3] = {0, 0, 0}, up = 1, flat = 0;
    const double r = s->roughness, x = fmax(s->cosine, 0.03);
    const double lean = fmin(1, p[1] * pow(r, p[2] + p[3] * s->cosine) * r / (r + p[4]));
    const double strength = fmax(0, 1 / (x + (1 - x) * p[5] * pow(r, p[6])) - 1);
    double axis[3] = {-sqrt(1 - s->cosine * s->cosine) * (1 - lean), 0,
                      s->cosine * (1 - lean) + lean};
    burnish_theory_lobe_sum sum;
    double squares = 0;
    set_length(axis, 1);
    const float a[3] = {(float)axis[0], (float)axis[1], (float)axis[2]};
    const float e = (float)sqrt(strength);
    const burnish_kernels_points points = {.normal = {&flat, &flat, &up},
                                           .position = {origin, origin, origin}};
    const burnish_kernels_axes axes = {{&a[0], &a[1], &a[2]}, {&flat, &e, &flat}};
    burnish_theory_lobe_sum_fit(BURNISH_THEORY_GGX, r * r, 2, &sum, NULL);
    for (int i = 0; i < LIGHTS; ++i) {
        burnish_kernels_polygon *light = &s->lights[i];
        float got = 0;
        light->lobe_count = sum.count;
        for (int j = 0; j < sum.count; ++j) {
            light->lobes[j] = (burnish_kernels_lobe){
                sum.order[j], (float)fmax(1, p[0] * sum.zeta[j]), (float)sum.weight[j]};
        }
        burnish_kernels_polygon_light(NULL, light, &points, &axes, 1, (float *const[2]){NULL, &got},
                                      NULL);
        const double d = (double)got * s->albedo - s->expected[i];
        squares += d * d;
    }
    return sqrt(squares / LIGHTS);
}

static double error_of(const double p[PARAMETERS]) {
    double sum = 0;
    for (int i = 0; i < ROUGHNESSES * VIEWS; ++i) {
        sum += scene_error(&scenes[i], p);
    }
    return sum / (ROUGHNESSES * VIEWS);
}

int main(void) {
    double p[PARAMETERS] = {0.78, 1.1, 1.7, 3.3, 0.1, 1.5, 2.5};
    double steps[PARAMETERS] = {0.1, 0.1, 0.3, 0.5, 0.05, 0.2, 0.5};
    const double round[PARAMETERS] = {1, 0, 0, 0, 1, 1, 1}; /* R, no stretch */
    for (int i = 0; i < ROUGHNESSES * VIEWS; ++i) {
        make_scene(&scenes[i], (double)(i / VIEWS + 1) / ROUGHNESSES, VIEW_COSINES[i % VIEWS]);
    }
    double least = error_of(p);
    printf(
        "around the mirror direction, without stretch: %.4f\nwith the shaders' constants: %.4f\n",
        error_of(round), least);
    for (int pass = 0; pass < 8; ++pass) {
        int improves = 0;
        for (int k = 0; k < 2 * PARAMETERS; ++k) {
            const double before = p[k / 2];
            p[k / 2] += k % 2 ? -steps[k / 2] : steps[k / 2];
            const double error = error_of(p);
            improves |= error < least;
            p[k / 2] = error < least ? p[k / 2] : before;
            least = error < least ? error : least;
        }
        for (int k = 0; k < PARAMETERS && !improves; ++k) {
            steps[k] /= 2;
        }
    }
    printf("after a search: %.4f\n  slope %.3f\n", least, p[0]);
    printf("  lean %.3f r^(%.3f + %.3f NoV) r / (r + %.3f)\n", p[1], p[2], p[3], p[4]);
    printf("  width x + (1 - x) %.3f r^%.3f\n", p[5], p[6]);
    return 0;
}
