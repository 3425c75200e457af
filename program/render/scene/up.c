/* A guess of the up axis from how the object would stand on the ground. Files use +Y or +Z, and the
 * format does not reliably define which. The contact area of an object is everything within 1 % of
 * its height above its lowest point. The object is stable if its centre is above the convex hull of
 * the contact area; the further inside and the lower the centre, the more stable. docs/formats.md has
 * the limits. */
#include "render/scene/up.h"

#include <float.h>
#include <math.h>
#include <string.h>

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

/* A surface that faces one way is a sheet in a slanted plane if it is at most this share of its longest
 * side thick, and its normal farther than 8 degrees from all axes. */
#define FACING 0.9
#define SLANTED 0.1
#define STRAIGHT 0.99

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* A triangle's normal, as long as twice its area, which is returned. */
static inline __attribute__((always_inline)) double find_area(const burnish_mesh_view *view,
                                                              size_t triangle, double normal[3]) {
    const uint32_t *corner = view->indices + 3 * triangle;
    const float *a = view->positions + 3 * (size_t)corner[0];
    const float *b = view->positions + 3 * (size_t)corner[1];
    const float *c = view->positions + 3 * (size_t)corner[2];
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        normal[k] = u[i] * v[j] - u[j] * v[i];
    }
    return length_of(normal);
}

/* The normal of a sheet in a slanted plane, or 0, 0, 0. */
static void find_slant(const burnish_mesh_view *view, double normal[3]) {
    enum { SAMPLES = 1024 };
    double one[3], sum[3] = {0}, total = 0, low = DBL_MAX, high = -DBL_MAX, longest = 0;
    int is_straight = 0;
    for (size_t t = 0; t < view->triangle_count; t += view->triangle_count / SAMPLES + 1) {
        total += find_area(view, t, one);
        for (int k = 0; k < 3; ++k) {
            sum[k] += one[k];
        }
    }
    const double length = length_of(sum);
    const int faces_one_way = length > FACING * total;
    for (int k = 0; k < 3; ++k) {
        normal[k] = faces_one_way ? sum[k] / length : 0;
        is_straight |= fabs(normal[k]) > STRAIGHT;
        longest = fmax(longest, (double)view->bounds_max[k] - (double)view->bounds_min[k]);
    }
    for (size_t i = 0; i < view->vertex_count && faces_one_way && !is_straight; ++i) {
        const float *p = view->positions + 3 * i;
        const double at =
            normal[0] * (double)p[0] + normal[1] * (double)p[1] + normal[2] * (double)p[2];
        low = at < low ? at : low; /* gcc 12 for aarch64 fails to compile fmin and fmax here */
        high = at > high ? at : high;
    }
    if (is_straight || high - low > SLANTED * longest) {
        memset(normal, 0, 3 * sizeof *normal);
    }
}

/* Centroid of the surface. Returns 1 if the surface is open. */
static int find_center(const burnish_mesh_view *view, double center[3]) {
    double sum[3] = {0}, vector[3] = {0}, normal[3], total = 0;
    for (size_t t = 0; t < view->triangle_count; ++t) {
        const uint32_t *corner = view->indices + 3 * t;
        const double area = find_area(view, t, normal);
        total += area;
        for (size_t k = 0; k < 3; ++k) {
            vector[k] += normal[k];
            sum[k] += area *
                      ((double)view->positions[3 * (size_t)corner[0] + k] +
                       (double)view->positions[3 * (size_t)corner[1] + k] +
                       (double)view->positions[3 * (size_t)corner[2] + k]) /
                      3;
        }
    }
    for (int k = 0; k < 3; ++k) {
        center[k] = total > 0 ? sum[k] / total
                              : ((double)view->bounds_min[k] + (double)view->bounds_max[k]) / 2;
    }
    return length_of(vector) > OPEN_SHARE * total;
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

/* Clouds are terrain or buildings if they are lower along Z than this share of their other extents,
 * but not drawings in the plane of X and Y; their coordinates are geographic, in metres or feet, if
 * they are farther from the origin than this, and than so many times their extents. */
#define TERRAIN 0.3
#define GEOGRAPHIC 10000
#define GEOGRAPHIC_TIMES 4

/* Whether nearly all points are in what a depth camera sees from 0, 0, 0 along +Z: at most 37 degrees
 * to the sides, 31 up and down. */
static int are_before_camera(const burnish_mesh_view *view) {
    size_t inside = 0;
    for (size_t i = 0; i < view->vertex_count; ++i) {
        const float *p = view->positions + 3 * i;
        const double z = view->origin[2] + (double)p[2];
        inside += fabs(view->origin[0] + (double)p[0]) < 0.75 * z &&
                  fabs(view->origin[1] + (double)p[1]) < 0.6 * z;
    }
    return inside * 100 >= view->vertex_count * 99;
}

static const char *why_cloud_is_other(const burnish_mesh_view *view, int may_be_camera) {
    double extents[3];
    int are_far = 1;
    for (int k = 0; k < 3; ++k) {
        const double low = (double)view->bounds_min[k], high = (double)view->bounds_max[k];
        const double away = fabs(view->origin[k] + (low + high) / 2);
        extents[k] = high - low - 2 * (double)view->point_radius;
        are_far &= k == 2 || (away > GEOGRAPHIC && away > GEOGRAPHIC_TIMES * extents[k]);
    }
    const double side = fmin(extents[0], extents[1]);
    const int is_low = extents[2] < TERRAIN * side && extents[2] > FLAT * side;
    return are_far                                    ? "geographic"
           : may_be_camera && are_before_camera(view) ? "camera"
           : is_low                                   ? "terrain"
                                                      : NULL;
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
    if (has_faces && !stance.flat_axis) {
        find_slant(view, stance.slant);
    }
    const int usual = view->up_axis[1] > 0.5F ? 1 : view->up_axis[2] > 0.5F ? 2 : 0;
    const int is_doubted = is_stl || format == BURNISH_FORMAT_OBJ || format == BURNISH_FORMAT_PLY ||
                           format == BURNISH_FORMAT_OFF || format == BURNISH_FORMAT_PCD ||
                           format == BURNISH_FORMAT_ARRAYS;
    if (is_doubted && usual == 1 && info->point_count > 0) {
        stance.reason = why_cloud_is_other(view, format == BURNISH_FORMAT_PCD);
        stance.other = 2;
    }
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
    if (!stance.flat_axis && here < doubted && stance.tipping[stance.other] >= believed) {
        stance.reason = "stability";
    }
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
    camera->stands_otherwise = camera->up == UP_AUTO ? stance.reason : NULL;
    camera->flat_axis = stance.flat_axis;
    memcpy(camera->slant, stance.slant, sizeof camera->slant);
}
