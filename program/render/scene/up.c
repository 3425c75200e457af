/* A guess of the up axis from how the object would stand on the ground. Files use +Y or +Z, and the
 * format does not reliably define which. The contact area of an object is everything within 1 % of
 * its height above its lowest point. The object is stable if its centre is above the convex hull of
 * the contact area; the further inside and the lower the centre, the more stable. docs/up.md has
 * measurements. */
#include "render/scene/up.h"

#include <float.h>
#include <math.h>

enum { DIRECTIONS = 32 }; /* of the measured extents of the hull */

/* Height of the contact area, as a share of the object's height. */
#define CONTACT 0.01

/* Tangents of tipping angles. The format's axis is doubted below 6 degrees; the other axis is
 * accepted from 22 degrees on. */
#define DOUBTED 0.1
#define BELIEVED 0.4

/* Centroid of the surface. */
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

/* Distance from the centre to the edge of the contact area, in each direction. */
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

int render_stands_otherwise(const burnish_mesh_view *view) {
    const int usual = view->up_axis[1] > 0.5F ? 1 : view->up_axis[2] > 0.5F ? 2 : 0;
    double center[3];
    find_center(view, center);
    return usual != 0 && tipping(view, usual, center) < DOUBTED &&
           tipping(view, 3 - usual, center) >= BELIEVED;
}
