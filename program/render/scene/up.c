/* A guess of the up axis from how the object would stand on the ground. Files use +Y or +Z, and the
 * format does not reliably define which. The contact area of an object is everything within 1 % of
 * its height above its lowest point. The object is stable if its centre is above the convex hull of
 * the contact area; the further inside and the lower the centre, the more stable. docs/formats.md has
 * the limits. */
#include "render/scene/up.h"

#include <float.h>
#include <math.h>

enum { DIRECTIONS = 32 }; /* of the measured extents of the hull */

/* Height of the contact area, as a share of the object's height. */
#define CONTACT 0.01

/* Degrees: the usual axis is doubted below, the other one accepted from there on. An object that
 * falls over on the usual axis, such as a bust or a horse, needs less on the other one. */
#define DOUBTED 5.7
#define BELIEVED 21.8
#define FALLEN -0.25
#define BELIEVED_FALLEN 10
#define DOUBTED_STL 2
#define BELIEVED_STL 60

/* A surface is open if its area vectors add up to more than this share of its area. Open surfaces
 * that are balanced on the usual axis, such as reliefs on their tip, stay: they are doubted only
 * below -DOUBTED. */
#define OPEN_SHARE 0.05

/* The largest extent of a flat object along its normal, in its longest extents. */
#define FLAT 0.005

/* Centroid of the surface. Returns 1 if the surface is open. */
static int find_center(const burnish_mesh_view *view, double center[3]) {
    double sum[3] = {0}, vector[3] = {0}, total = 0;
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
        vector[0] += x;
        vector[1] += y;
        vector[2] += z;
        for (int k = 0; k < 3; ++k) {
            sum[k] += area * ((double)a[k] + (double)b[k] + (double)c[k]) / 3;
        }
    }
    for (int k = 0; k < 3; ++k) {
        center[k] = total > 0 ? sum[k] / total
                              : ((double)view->bounds_min[k] + (double)view->bounds_max[k]) / 2;
    }
    return sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]) >
           OPEN_SHARE * total;
}

/* Distance from the centre to the edge of the contact area, in each direction.
 *   sign     of the up direction along the axis
 *   contact  height of the contact area, as a share of the object's */
static void measure_reach(const burnish_mesh_view *view, int axis, double sign, double contact,
                          const double center[3], double reach[DIRECTIONS]) {
    const double low = (double)(sign > 0 ? view->bounds_min : view->bounds_max)[axis];
    const double height = (double)view->bounds_max[axis] - (double)view->bounds_min[axis];
    const double limit = sign * low + contact * height;
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (int i = 0; i < DIRECTIONS; ++i) {
        reach[i] = -DBL_MAX;
    }
    for (size_t v = 0; v < view->vertex_count; ++v) {
        const float *p = view->positions + 3 * v;
        const double x = (double)p[first] - center[first];
        const double y = (double)p[second] - center[second];
        for (int i = 0; i < DIRECTIONS / 4 && sign * (double)p[axis] <= limit; ++i) {
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

/* The angle in degrees by which the object can lean before it falls.
 *   width  receives the contact area's narrowest width */
static double tipping(const burnish_mesh_view *view, int axis, double sign, double contact,
                      const double center[3], double *width) {
    const double low = (double)(sign > 0 ? view->bounds_min : view->bounds_max)[axis];
    double reach[DIRECTIONS], least = DBL_MAX;
    measure_reach(view, axis, sign, contact, center, reach);
    *width = DBL_MAX;
    for (int i = 0; i < DIRECTIONS; ++i) {
        least = fmin(least, reach[i]);
        *width = fmin(*width, reach[i] + reach[(i + DIRECTIONS / 2) % DIRECTIONS]);
    }
    return atan2(least, sign * (center[axis] - low)) * (180 / 3.14159265358979323846);
}

/* 1 + the axis on which the object has no extent, or 0. */
static int find_flat_axis(const burnish_mesh *mesh) {
    const float *low = burnish_mesh_get_view(mesh)->bounds_min;
    const float *high = burnish_mesh_get_view(mesh)->bounds_max;
    int thin = 0, long_axis = 0;
    for (int k = 1; k < 3; ++k) {
        thin = high[k] - low[k] < high[thin] - low[thin] ? k : thin;
        long_axis = high[k] - low[k] > high[long_axis] - low[long_axis] ? k : long_axis;
    }
    const double extent = (double)high[thin] - (double)low[thin];
    return extent <= FLAT * ((double)high[long_axis] - (double)low[long_axis]) ? 1 + thin : 0;
}

render_stance render_find_stance(const burnish_mesh *mesh) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_mesh_info *info = burnish_mesh_get_info(mesh);
    const burnish_format format = info->format;
    const int is_stl = format == BURNISH_FORMAT_STL;
    render_stance stance = {0};
    double center[3], width;
    const int has_faces = info->point_count + info->line_count == 0;
    stance.flat_axis = has_faces ? find_flat_axis(mesh) : 0;
    const int usual = view->up_axis[1] > 0.5F ? 1 : view->up_axis[2] > 0.5F ? 2 : 0;
    const int is_doubted = is_stl || format == BURNISH_FORMAT_OBJ || format == BURNISH_FORMAT_PLY ||
                           format == BURNISH_FORMAT_OFF || format == BURNISH_FORMAT_ARRAYS;
    if (!is_doubted || usual == 0 || !has_faces) {
        return stance;
    }
    stance.usual = usual;
    stance.other = 3 - usual;
    const int is_open = find_center(view, center);
    stance.tipping[1] = tipping(view, 1, 1, CONTACT, center, &width);
    stance.tipping[2] = tipping(view, 2, 1, CONTACT, center, &width);
    const double doubted = is_stl ? DOUBTED_STL : is_open ? -DOUBTED : DOUBTED;
    const double here = stance.tipping[stance.usual];
    const double believed = is_stl ? BELIEVED_STL : here < FALLEN ? BELIEVED_FALLEN : BELIEVED;
    stance.is_other =
        !stance.flat_axis && here < doubted && stance.tipping[stance.other] >= believed;
    return stance;
}

/* The contact area of an object that is drawn on a ground: more than CONTACT, because legs are not
 * all equally long. */
#define STANDING_CONTACT 0.03

/* The narrowest contact that carries an object, as a share of its height or, if that is less, of
 * its narrower side: neither a tip nor an edge does. A sphere has 0.34 of its height, an edge of 90
 * degrees 0.06. */
#define NARROW 0.1
#define NARROW_SIDE 0.3

int render_stands(const burnish_mesh *mesh, const double up[3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_mesh_info *info = burnish_mesh_get_info(mesh);
    const int axis = up[0] != 0 ? 0 : up[1] != 0 ? 1 : 2;
    double center[3], sides[3], width;
    if (info->point_count + info->line_count > 0 || view->triangle_count == 0 ||
        find_flat_axis(mesh)) {
        return 0;
    }
    for (int k = 0; k < 3; ++k) {
        sides[k] = (double)view->bounds_max[k] - (double)view->bounds_min[k];
    }
    find_center(view, center);
    const double angle = tipping(view, axis, up[axis], STANDING_CONTACT, center, &width);
    const double side = fmin(sides[(axis + 1) % 3], sides[(axis + 2) % 3]);
    return angle > -DOUBTED && width >= fmin(NARROW * sides[axis], NARROW_SIDE * side);
}

void render_set_stance(const burnish_mesh *mesh, render_camera_settings *camera) {
    const render_stance stance = render_find_stance(mesh);
    camera->stands_otherwise = camera->up == UP_AUTO && stance.is_other;
    camera->flat_axis = stance.flat_axis;
}
