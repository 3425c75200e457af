/* Camera framing: the whole mesh in the picture, as large as the margin allows. */
#include <float.h>

#include "base/layout.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "core/float_mode.h"
#include "core/vec3.h"
#include "mesh/data/mesh.h"

/* The three-quarter view: from the front, turned this far to the right and lifted this far. */
#define THREE_QUARTER_AZIMUTH 35.0
#define THREE_QUARTER_ELEVATION 20.0

/* Below this sine of the angle between them, the direction counts as parallel to up. */
#define PARALLEL 1e-6

/* The camera stays this share of the mesh's diagonal in front of its nearest vertex: a needle seen
 * from its tip would otherwise touch the camera. */
#define CLEARANCE 0.01

/* Newton steps to centre an axis; three to six suffice, see center_axes. */
enum { CENTER_STEPS = 64 };

/* The camera's axes: right, the picture's up, and back toward the viewer. */
typedef struct view_frame {
    burnish_vec3 right, up, back;
} view_frame;

#define COOKIE BURNISH_COOKIE(0x66726d32, burnish_framing)

void burnish_framing_init(burnish_framing *framing, uint64_t layout) {
    const burnish_framing defaults = {
        .cookie = COOKIE, .view_angle = 30, .aspect = 1, .margin = 0.05};
    burnish_layout_init(framing, layout, BURNISH_LAYOUT(burnish_framing), &defaults);
}

static burnish_status check_number(double value, double low, double high, const char *name,
                                   burnish_error *error) {
    if (value >= low && value <= high) {
        return BURNISH_STATUS_OK;
    }
    return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "options: %s %g is not in [%g, %g]", name,
                        value, low, high);
}

/* Vectors are accepted up to 1e100, which keeps their squares finite. */
static burnish_status check_vector(const double v[3], const char *name, burnish_error *error) {
    for (int i = 0; i < 3; ++i) {
        if (!(v[i] >= -1e100 && v[i] <= 1e100)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "options: %s[%d] is %g, not a number within 1e100", name, i, v[i]);
        }
    }
    return BURNISH_STATUS_OK;
}

/* The shorter side of the picture, in heights: the unit of margin and insets. */
static double smaller_side(const burnish_framing *options) {
    return options->aspect < 1 ? options->aspect : 1;
}

/* The space that margin and insets leave right, left, above and below the picture's middle, in
 * halves of its height: the order of push_sides. */
static void picture_rooms(const burnish_framing *options, double room[4]) {
    const double smaller = smaller_side(options);
    for (int k = 0; k < 4; ++k) {
        room[k] = (k < 2 ? options->aspect : 1) - 2 * options->margin * smaller;
        room[k] -= 2 * options->inset[k ^ 1] * smaller;
    }
}

/* In perspective the middle of the picture must stay in the remaining space. */
static burnish_status check_room(const burnish_framing *options, burnish_error *error) {
    const int parallel = options->orthographic || options->orthographic_height > 0;
    double room[4];
    int enough = 1;
    picture_rooms(options, room);
    for (int k = 0; k < 4; ++k) {
        enough &= parallel ? room[k] + room[k ^ 1] > 0 : room[k] > 0;
    }
    return enough
               ? BURNISH_STATUS_OK
               : burnish_fail(
                     error, BURNISH_STATUS_ARGUMENT,
                     "options: margin and inset leave no room for the object; make them smaller");
}

static burnish_status check_framing(const burnish_framing *options, burnish_error *error) {
    burnish_status status = burnish_layout_check(options, COOKIE, "options", "framing", error);
    if (status == BURNISH_STATUS_OK) {
        status = check_vector(options->up, "up", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_vector(options->direction, "direction", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_number(options->azimuth, -1e6, 1e6, "azimuth", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_number(options->elevation, -1e6, 1e6, "elevation", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_number(options->view_angle, BURNISH_VIEW_ANGLE_MIN, BURNISH_VIEW_ANGLE_MAX,
                              "view_angle", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_number(options->aspect, 1e-5, 1e5, "aspect", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_number(options->margin, 0, 0.45, "margin", error);
    }
    for (int i = 0; i < 4 && status == BURNISH_STATUS_OK; ++i) {
        status = check_number(options->inset[i], 0, 0.45, "inset", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_number(options->orthographic_height, 0, 1e100, "orthographic_height", error);
    }
    return status == BURNISH_STATUS_OK ? check_room(options, error) : status;
}

/* Unit vector along v, whose largest coordinate may have any size. */
static burnish_vec3 direction_of(const double v[3]) {
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        double size = v[i] < 0 ? -v[i] : v[i];
        largest = size > largest ? size : largest;
    }
    burnish_vec3 scaled = {v[0] / largest, v[1] / largest, v[2] / largest};
    return burnish_vec3_normalize(scaled);
}

/* The side from which an object with this up axis is seen from the front: where the smallest
 * rotation that takes +Y to up takes +Z. Up +Y: +Z; up +Z: -Y, as in CAD; up -Y, for which no
 * rotation is the smallest: -Z, which keeps +X on the right. */
static burnish_vec3 front_of(burnish_vec3 up) {
    burnish_vec3 z = {0, 0, 1};
    burnish_vec3 axis = {up.z, 0, -up.x}; /* Y x up, as long as the sine of the angle */
    double cosine = up.y;
    if (1 + cosine < 1e-9) {
        return (burnish_vec3){0, 0, -1};
    }
    /* Rodrigues' formula: v + a x v + a x (a x v) / (1 + cos). */
    burnish_vec3 first = burnish_vec3_cross(axis, z);
    burnish_vec3 second = burnish_vec3_scale(burnish_vec3_cross(axis, first), 1 / (1 + cosine));
    return burnish_vec3_normalize(burnish_vec3_add(burnish_vec3_add(z, first), second));
}

/* v turned by the angle around the unit axis, counter-clockwise seen against the axis. */
static burnish_vec3 rotate_about(burnish_vec3 v, burnish_vec3 axis, double degrees) {
    double sine, cosine;
    burnish_sincos(degrees * BURNISH_DEGREE, &sine, &cosine);
    burnish_vec3 along = burnish_vec3_scale(axis, burnish_vec3_dot(axis, v) * (1 - cosine));
    burnish_vec3 across = burnish_vec3_scale(burnish_vec3_cross(axis, v), sine);
    return burnish_vec3_add(burnish_vec3_add(burnish_vec3_scale(v, cosine), across), along);
}

/* The frame that looks against `back` with the picture's up as near to `up` as can be. Straight
 * down the picture's top is the side away from the front (up +Y: -Z, up +Z: +Y), straight up it is
 * the front: what tilting the front view by 90 degrees gives. */
static view_frame look_against(burnish_vec3 back, burnish_vec3 up, burnish_vec3 front) {
    burnish_vec3 right = burnish_vec3_cross(up, back);
    if (burnish_vec3_length(right) < PARALLEL) {
        right = burnish_vec3_cross(up, front);
    }
    right = burnish_vec3_normalize(right);
    right = burnish_vec3_normalize(
        burnish_vec3_sub(right, burnish_vec3_scale(back, burnish_vec3_dot(right, back))));
    return (view_frame){right, burnish_vec3_cross(back, right), back};
}

static int is_zero(const double v[3]) {
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static view_frame choose_frame(const burnish_framing *options, const float mesh_up[3]) {
    const burnish_vec3 up = is_zero(options->up)
                                ? burnish_vec3_normalize(burnish_vec3_loadf(mesh_up))
                                : direction_of(options->up);
    const burnish_vec3 front = front_of(up);
    double azimuth = options->azimuth, elevation = options->elevation;
    const double *d = options->direction;
    view_frame frame;
    if (is_zero(d)) {
        frame = look_against(front, up, front);
        azimuth += THREE_QUARTER_AZIMUTH;
        elevation += THREE_QUARTER_ELEVATION;
    } else {
        frame = look_against(burnish_vec3_scale(direction_of(d), -1), up, front);
    }
    /* Lifting the camera also tilts the picture's up vector, to avoid a jump at the poles. */
    frame.back = rotate_about(frame.back, frame.right, -elevation);
    frame.right = burnish_vec3_normalize(rotate_about(frame.right, up, azimuth));
    frame.back = burnish_vec3_normalize(rotate_about(frame.back, up, azimuth));
    frame.up = burnish_vec3_normalize(burnish_vec3_cross(frame.back, frame.right));
    return frame;
}

/* Neighbouring vertices, as the frame sees them: their bounds. */
enum { GROUP = 64 };
typedef struct group_bounds {
    burnish_vec3 low, high;
} group_bounds;

/* The mesh as the frame sees it, relative to the middle of its bounds. */
typedef struct view_mesh {
    const burnish_mesh_view *mesh;
    burnish_vec3 middle;
    view_frame frame;
    double diagonal;                /* of the bounds */
    double radius;                  /* of a point cloud's spheres; 0: triangles */
    int has_strays;                 /* 1: vertices outside the bounds are not framed */
    const struct view_mesh *splats; /* framed, too; NULL: none */
    group_bounds *groups;
    size_t group_count;
} view_mesh;

/* Outliers are not framed. */
static int is_framed(const view_mesh *view, size_t i) {
    const float *p = view->mesh->positions + 3 * i;
    const float *low = view->mesh->bounds_min, *high = view->mesh->bounds_max;
    return !view->has_strays || (p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] &&
                                 p[1] <= high[1] && p[2] >= low[2] && p[2] <= high[2]);
}

static burnish_vec3 view_vertex(const view_mesh *view, size_t i) {
    burnish_vec3 p =
        burnish_vec3_sub(burnish_vec3_loadf(view->mesh->positions + 3 * i), view->middle);
    return (burnish_vec3){burnish_vec3_dot(p, view->frame.right),
                          burnish_vec3_dot(p, view->frame.up),
                          burnish_vec3_dot(p, view->frame.back)};
}

/* An extreme value of a side and the depth of the vertex that has it. */
typedef struct extreme {
    double value, depth;
} extreme;

static void measure_group(const view_mesh *view, size_t first, size_t end, group_bounds *bounds) {
    bounds->low = (burnish_vec3){DBL_MAX, DBL_MAX, DBL_MAX};
    bounds->high = (burnish_vec3){-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (size_t i = first; i < end; ++i) {
        const burnish_vec3 p = view_vertex(view, i);
        if (!is_framed(view, i)) {
            continue;
        }
        bounds->low.x = p.x < bounds->low.x ? p.x : bounds->low.x;
        bounds->low.y = p.y < bounds->low.y ? p.y : bounds->low.y;
        bounds->low.z = p.z < bounds->low.z ? p.z : bounds->low.z;
        bounds->high.x = p.x > bounds->high.x ? p.x : bounds->high.x;
        bounds->high.y = p.y > bounds->high.y ? p.y : bounds->high.y;
        bounds->high.z = p.z > bounds->high.z ? p.z : bounds->high.z;
    }
}

/* Measures all groups. This reads each vertex once; later steps read only a few again. */
static burnish_status measure_groups(view_mesh *view, burnish_memory *memory) {
    const size_t count = view->mesh->vertex_count;
    view->group_count = (count + GROUP - 1) / GROUP;
    view->groups = burnish_allocate(memory, view->group_count, sizeof *view->groups, "bounds");
    for (size_t i = 0; i < view->group_count && view->groups; ++i) {
        const size_t first = i * GROUP, end = first + GROUP;
        measure_group(view, first, end < count ? end : count, &view->groups[i]);
    }
    return memory->status;
}

static void push_group(const view_mesh *view, size_t group, const double t[4], extreme side[4]) {
    const size_t first = group * GROUP, count = view->mesh->vertex_count;
    const size_t end = first + GROUP < count ? first + GROUP : count;
    for (size_t i = first; i < end; ++i) {
        burnish_vec3 p = view_vertex(view, i);
        if (!is_framed(view, i)) {
            continue;
        }
        double value[4] = {p.x + t[0] * p.z, t[1] * p.z - p.x, p.y + t[2] * p.z, t[3] * p.z - p.y};
        for (int k = 0; k < 4; ++k) {
            if (value[k] > side[k].value) {
                side[k] = (extreme){value[k], p.z};
            }
        }
    }
}

/* side[0] = max(x + t[0] z), side[1] = max(-x + t[1] z), and side[2], side[3] the same in y: the
 * four side planes of a view frustum with these slopes >= 0, pushed against the mesh. Rounding is
 * monotone, so no vertex exceeds the bounds of its group. */
static void push_sides(const view_mesh *view, const double t[4], extreme side[4]) {
    for (int k = 0; k < 4; ++k) {
        side[k] = (extreme){-DBL_MAX, 0};
    }
    for (size_t i = 0; i < view->group_count; ++i) {
        const burnish_vec3 low = view->groups[i].low, high = view->groups[i].high;
        if (high.x + t[0] * high.z > side[0].value || t[1] * high.z - low.x > side[1].value ||
            high.y + t[2] * high.z > side[2].value || t[3] * high.z - low.y > side[3].value) {
            push_group(view, i, t, side);
        }
    }
    for (int k = 0; k < 4; ++k) { /* spheres reach farther by their radius across the side */
        side[k].value += view->radius * __builtin_sqrt(1 + t[k] * t[k]);
    }
    if (view->splats) {
        extreme other[4];
        push_sides(view->splats, t, other);
        for (int k = 0; k < 4; ++k) {
            side[k] = other[k].value > side[k].value ? other[k] : side[k];
        }
    }
}

static void measure_depth(const view_mesh *view, double *near_depth, double *far_depth) {
    *near_depth = -DBL_MAX;
    *far_depth = DBL_MAX;
    for (size_t i = 0; i < view->group_count; ++i) {
        const group_bounds *group = &view->groups[i];
        *near_depth = group->high.z > *near_depth ? group->high.z : *near_depth;
        *far_depth = group->low.z < *far_depth ? group->low.z : *far_depth;
    }
    *near_depth += view->radius;
    *far_depth -= view->radius;
    if (view->splats) {
        double near, far;
        measure_depth(view->splats, &near, &far);
        *near_depth = near > *near_depth ? near : *near_depth;
        *far_depth = far < *far_depth ? far : *far_depth;
    }
}

/* The position across the view, at distance cz, with room on both sides in the proportion of the
 * weights, in both axes.
 *
 * In x, let v and w be the weights of right and left, and a and b the maxima of push_sides. With
 * slope s the sides touch the mesh at cz = (a(v s) + b(w s)) / (v + w) s. The function g(s) = a(v
 * s) + b(w s) - (v + w) s cz is convex, falls strictly because cz is larger than every z, and is
 * not negative at 0. Its zero is the slope that fits this cz, and (w a - v b) / (v + w) is the
 * position. Newton's steps from 0 never overshoot and end on the zero, since g is piecewise linear.
 */
static void center_axes(const view_mesh *view, double cz, const double weight[4],
                        double center[2]) {
    double slope[2] = {0, 0};
    for (int step = 0, moved = 1; moved && step < CENTER_STEPS; ++step) {
        extreme side[4];
        const double t[4] = {weight[0] * slope[0], weight[1] * slope[0], weight[2] * slope[1],
                             weight[3] * slope[1]};
        push_sides(view, t, side);
        moved = 0;
        for (int axis = 0; axis < 2; ++axis) {
            const extreme *high = &side[2 * axis], *low = &side[2 * axis + 1];
            const double v = weight[2 * axis], w = weight[2 * axis + 1];
            double value = high->value + low->value - (v + w) * slope[axis] * cz;
            double next = slope[axis] + value / (v * (cz - high->depth) + w * (cz - low->depth));
            center[axis] = (w * high->value - v * low->value) / (v + w);
            moved |= next > slope[axis];
            slope[axis] = next > slope[axis] ? next : slope[axis];
        }
    }
}

static void frame_perspective(const view_mesh *view, const burnish_framing *options,
                              burnish_vec3 *position, double *focus) {
    double sine, cosine, room[4], t[4], weight[4], near_depth, far_depth, center[2];
    extreme side[4];
    burnish_sincos(options->view_angle * BURNISH_DEGREE / 2, &sine, &cosine);
    picture_rooms(options, room);
    for (int k = 0; k < 4; ++k) {
        t[k] = sine / cosine * room[k];
        weight[k] = 2 * room[k] / (room[k] + room[k ^ 1]);
    }
    measure_depth(view, &near_depth, &far_depth);
    push_sides(view, t, side);
    double cz = near_depth + CLEARANCE * view->diagonal;
    double needed_x = (side[0].value + side[1].value) / (t[0] + t[1]);
    double needed_y = (side[2].value + side[3].value) / (t[2] + t[3]);
    cz = needed_x > cz ? needed_x : cz;
    cz = needed_y > cz ? needed_y : cz;
    center_axes(view, cz, weight, center);
    *position = (burnish_vec3){center[0], center[1], cz};
    *focus = (near_depth + far_depth) / 2;
}

static double frame_orthographic(const view_mesh *view, const burnish_framing *options,
                                 burnish_vec3 *position, double *focus) {
    static const double straight[4] = {0, 0, 0, 0};
    double room[4], near_depth, far_depth;
    extreme side[4];
    picture_rooms(options, room);
    measure_depth(view, &near_depth, &far_depth);
    push_sides(view, straight, side);
    double height_x = (side[0].value + side[1].value) / ((room[0] + room[1]) / 2);
    double height_y = (side[2].value + side[3].value) / ((room[2] + room[3]) / 2);
    double height = height_x > height_y ? height_x : height_y;
    height = height > 0 ? height : view->diagonal;
    height = options->orthographic_height > 0 ? options->orthographic_height : height;
    const double unit = height * smaller_side(options) / 2; /* half of what an inset of 1 takes */
    const double *inset = options->inset;
    *focus = (near_depth + far_depth) / 2;
    *position = (burnish_vec3){(side[0].value - side[1].value) / 2 - (inset[0] - inset[1]) * unit,
                               (side[2].value - side[3].value) / 2 - (inset[2] - inset[3]) * unit,
                               *focus + view->diagonal};
    return height;
}

/* From the frame back to the mesh's coordinates. */
static burnish_vec3 to_world(const view_mesh *view, burnish_vec3 p) {
    burnish_vec3 across = burnish_vec3_add(burnish_vec3_scale(view->frame.right, p.x),
                                           burnish_vec3_scale(view->frame.up, p.y));
    return burnish_vec3_add(view->middle,
                            burnish_vec3_add(across, burnish_vec3_scale(view->frame.back, p.z)));
}

static burnish_status frame_mesh(const burnish_mesh *mesh, const burnish_framing *options,
                                 burnish_camera *camera, burnish_error *error) {
    const burnish_mesh_view *arrays = &mesh->view;
    const burnish_vec3 low = burnish_vec3_loadf(arrays->bounds_min);
    const burnish_vec3 high = burnish_vec3_loadf(arrays->bounds_max);
    view_mesh view = {arrays,
                      burnish_vec3_scale(burnish_vec3_add(low, high), 0.5),
                      choose_frame(options, arrays->up_axis),
                      burnish_vec3_length(burnish_vec3_sub(high, low)),
                      (double)arrays->point_radius,
                      arrays->point_radius > 0 || mesh->has_strays,
                      NULL,
                      NULL,
                      0};
    view_mesh splats = view;
    burnish_memory memory = burnish_memory_of(mesh->context, error);
    burnish_vec3 position;
    double focus, height = 0;
    if (mesh->splats) {
        splats.mesh = &mesh->splats->view;
        splats.radius = (double)splats.mesh->point_radius;
        splats.has_strays = 1;
        view.splats = &splats;
        measure_groups(&splats, &memory);
    }
    if (measure_groups(&view, &memory) != BURNISH_STATUS_OK) {
        burnish_release(mesh->context, splats.groups);
        burnish_release(mesh->context, view.groups);
        return memory.status;
    }
    if (options->orthographic || options->orthographic_height > 0) {
        height = frame_orthographic(&view, options, &position, &focus);
    } else {
        frame_perspective(&view, options, &position, &focus);
    }
    burnish_release(mesh->context, splats.groups);
    burnish_release(mesh->context, view.groups);
    *camera = (burnish_camera){.view_angle = options->view_angle, .orthographic_height = height};
    burnish_vec3_store(to_world(&view, position), camera->position);
    burnish_vec3_store(to_world(&view, (burnish_vec3){position.x, position.y, focus}),
                       camera->focal_point);
    burnish_vec3_store(view.frame.up, camera->view_up);
    return BURNISH_STATUS_OK;
}

burnish_status burnish_camera_frame(const burnish_mesh *mesh, const burnish_framing *options,
                                    burnish_camera *camera, burnish_error *error) {
    if (!mesh || !camera) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL; pass one",
                            mesh ? "camera" : "mesh");
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    burnish_status status = check_framing(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = frame_mesh(mesh, options, camera, error);
    }
    burnish_float_mode_leave(before);
    return status;
}
