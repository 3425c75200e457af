/* Which way is up: a guess from how the object would stand. Files come with up +Y or +Z, and their
 * format tells which only mostly. An object touches the ground with what lies within 1 % of its
 * height above its lowest point. It stands where its centre lies above the convex hull of that, the
 * better the further inside and the lower. docs/up.md has measured how often this is right. */
#include "render/up.h"

#include <float.h>
#include <math.h>

enum { DIRECTIONS = 32 }; /* in which the hull is measured */

/* What touches the ground, of the height. */
#define CONTACT 0.01

/* Tangents of tipping angles: below the first, 6 degrees, the format is doubted; from the second
 * on, 22 degrees, the other axis is believed. */
#define DOUBTED 0.1
#define BELIEVED 0.4

/* Centre of the surface, every area weighing the same. */
static void find_center(const burnish_mesh_view *view, double center[3]) {
    double sum[3] = {0}, total = 0;
    for (size_t t = 0; t < view->triangle_count; ++t) {
        const uint32_t *corner = view->indices + 3 * t;
        const float *a = view->positions + 3 * (size_t)corner[0];
        const float *b = view->positions + 3 * (size_t)corner[1];
        const float *c = view->positions + 3 * (size_t)corner[2];
        double u[3], v[3];
        for (int k = 0; k < 3; ++k) {
            u[k] = (double)b[k] - (double)a[k];
            v[k] = (double)c[k] - (double)a[k];
        }
        const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2];
        const double z = u[0] * v[1] - u[1] * v[0], area = sqrt(x * x + y * y + z * z);
        total += area;
        for (int k = 0; k < 3; ++k) {
            sum[k] += area * ((double)a[k] + (double)b[k] + (double)c[k]) / 3;
        }
    }
    for (int k = 0; k < 3; ++k) {
        center[k] = total > 0 ? sum[k] / total
                              : ((double)view->bounds_min[k] + (double)view->bounds_max[k]) / 2;
    }
}

/* How far what touches the ground reaches from the centre, in each direction. */
static void measure_reach(const burnish_mesh_view *view, int axis, const double center[3],
                          double reach[DIRECTIONS]) {
    const double low = (double)view->bounds_min[axis];
    const double limit = low + CONTACT * ((double)view->bounds_max[axis] - low);
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (int i = 0; i < DIRECTIONS; ++i) {
        reach[i] = -DBL_MAX;
    }
    for (size_t v = 0; v < view->vertex_count; ++v) {
        const float *p = view->positions + 3 * v;
        const double x = (double)p[first] - center[first];
        const double y = (double)p[second] - center[second];
        for (int i = 0; i < DIRECTIONS / 4 && (double)p[axis] <= limit; ++i) {
            const double across = i, along = DIRECTIONS / 4 - i;
            const double length = sqrt(across * across + along * along);
            const double c = along / length, s = across / length;
            const double here[4] = {x * c + y * s, y * c - x * s, -x * c - y * s, x * s - y * c};
            for (int k = 0; k < 4; ++k) {
                double *farthest = &reach[i + k * DIRECTIONS / 4];
                *farthest = here[k] > *farthest ? here[k] : *farthest;
            }
        }
    }
}

static double tipping(const burnish_mesh_view *view, int axis, const double center[3]) {
    double reach[DIRECTIONS], least = DBL_MAX;
    measure_reach(view, axis, center, reach);
    for (int i = 0; i < DIRECTIONS; ++i) {
        least = reach[i] < least ? reach[i] : least;
    }
    const double rise = center[axis] - (double)view->bounds_min[axis];
    return rise > 0 ? least / rise : least > 0 ? DBL_MAX : -1;
}

double render_tipping(const burnish_mesh_view *view, int axis) {
    double center[3];
    find_center(view, center);
    return tipping(view, axis, center);
}

int render_stands_otherwise(const burnish_mesh_view *view) {
    const int usual = view->up_axis[1] > 0.5F ? 1 : view->up_axis[2] > 0.5F ? 2 : 0;
    double center[3];
    find_center(view, center);
    return usual != 0 && tipping(view, usual, center) < DOUBTED &&
           tipping(view, 3 - usual, center) >= BELIEVED;
}
