/* Cameras from flags. Everything that affects pixels uses plain IEEE operations. */
#include "render/scene/cameras.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/numbers.h"
#include "render/scene/color.h"
#include "render/scene/library_options.h"

/* A right-handed frame for every up axis: right x up = front, which points to the viewer. */
typedef struct frame {
    const char *name;
    double up[3], right[3], front[3];
} frame;

static const frame frames[] = {
    [UP_POSITIVE_X] = {"+X", {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
    [UP_NEGATIVE_X] = {"-X", {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    [UP_POSITIVE_Y] = {"+Y", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    [UP_NEGATIVE_Y] = {"-Y", {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    [UP_POSITIVE_Z] = {"+Z", {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    [UP_NEGATIVE_Z] = {"-Z", {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
};

/* The direction to a view's camera, in multiples of right, up and front, and the view's up
 * direction. */
typedef struct standard_view {
    const char *name;
    double toward[3];
    double upward[3];
} standard_view;

static const standard_view views[] = {
    [VIEW_FREE] = {"view", {0, 0, 0}, {0, 1, 0}},
    [VIEW_FRONT] = {"front", {0, 0, 1}, {0, 1, 0}},
    [VIEW_RIGHT] = {"right", {1, 0, 0}, {0, 1, 0}},
    [VIEW_BACK] = {"back", {0, 0, -1}, {0, 1, 0}},
    [VIEW_LEFT] = {"left", {-1, 0, 0}, {0, 1, 0}},
    [VIEW_TOP] = {"top", {0, 1, 0}, {0, 0, -1}},
    [VIEW_BOTTOM] = {"bottom", {0, -1, 0}, {0, 0, 1}},
    [VIEW_ISO] = {"iso", {1, 1, 1}, {0, 1, 0}},
    [VIEW_SECTION] = {"section", {0, 0, 0}, {0, 1, 0}},
};

const char *render_view_name(render_view view) {
    return views[view].name;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The frame of --up, or the one nearest to the mesh's own up axis, or a guess. */
static const frame *frame_in_use(const burnish_mesh *mesh, const render_camera_settings *camera) {
    if (camera->up != UP_FORMAT && camera->up != UP_AUTO) {
        return &frames[camera->up];
    }
    const float *axis = burnish_mesh_get_view(mesh)->up_axis;
    const double up[3] = {axis[0], axis[1], axis[2]};
    int nearest = UP_POSITIVE_Y;
    for (int i = UP_POSITIVE_X; i <= UP_NEGATIVE_Z; ++i) {
        nearest = dot(frames[i].up, up) > dot(frames[nearest].up, up) ? i : nearest;
    }
    if (camera->up == UP_AUTO && camera->stands_otherwise) {
        nearest = *camera->stands_otherwise == 'c' ? UP_NEGATIVE_Y
                  : nearest == UP_POSITIVE_Y       ? UP_POSITIVE_Z
                                                   : UP_POSITIVE_Y;
    }
    return &frames[nearest];
}

render_up render_up_in_use(const burnish_mesh *mesh, const render_camera_settings *camera,
                           double direction[3]) {
    const frame *axes = frame_in_use(mesh, camera);
    memcpy(direction, axes->up, sizeof axes->up);
    return (render_up)(axes - frames);
}

const char *render_up_name(const burnish_mesh *mesh, const render_camera_settings *camera) {
    return frame_in_use(mesh, camera)->name;
}

void render_axes(const burnish_mesh *mesh, const render_camera_settings *camera, int axes[3]) {
    const frame *in_use = frame_in_use(mesh, camera);
    const double *const along[3] = {in_use->right, in_use->up, in_use->front};
    for (int k = 0; k < 3; ++k) {
        axes[k] = along[k][0] != 0 ? 0 : along[k][1] != 0 ? 1 : 2;
    }
}

void render_extents(const burnish_mesh *mesh, const render_camera_settings *camera,
                    double extents[3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    int axes[3];
    render_axes(mesh, camera, axes);
    for (int k = 0; k < 3; ++k) {
        extents[k] = (double)view->bounds_max[axes[k]] - (double)view->bounds_min[axes[k]];
    }
}

static void combine(const frame *axes, const double weights[3], double scale, double result[3]) {
    for (int k = 0; k < 3; ++k) {
        result[k] = scale * (weights[0] * axes->right[k] + weights[1] * axes->up[k] +
                             weights[2] * axes->front[k]);
    }
}

static void subtract(const double a[3], const double b[3], double result[3]) {
    for (int k = 0; k < 3; ++k) {
        result[k] = a[k] - b[k];
    }
}

/* 1 if the sine of the angle between a and b is below 1e-6, so the up direction is undefined. */
static int parallel(const double a[3], const double b[3]) {
    double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
    return dot(cross, cross) <= 1e-12 * (dot(a, a) * dot(b, b));
}

/* The up axis or, for a view along it, the back of the object, as in a floor plan. */
static void usual_upward(const frame *axes, const double direction[3], double upward[3]) {
    memcpy(upward, axes->up, sizeof axes->up);
    if (parallel(direction, upward)) {
        double sign = dot(direction, upward) < 0 ? -1 : 1;
        for (int k = 0; k < 3; ++k) {
            upward[k] = sign * axes->front[k];
        }
    }
}

static burnish_status choose_upward(const frame *axes, const render_camera_settings *camera,
                                    const double direction[3], double upward[3],
                                    burnish_error *error) {
    if (!camera->view_up.given) {
        usual_upward(axes, direction, upward);
        return BURNISH_STATUS_OK;
    }
    memcpy(upward, camera->view_up.values, sizeof camera->view_up.values);
    if (parallel(direction, upward)) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--camera-view-up: it is parallel to the direction of view; use another vector");
    }
    return BURNISH_STATUS_OK;
}

/* Whether a view is a parallel projection. */
static int is_parallel(const render_settings *settings, render_view view) {
    return settings->camera.projection == PROJECTION_PARALLEL || settings->camera.same_scale ||
           settings->camera.orthographic_height.given ||
           (settings->camera.projection == PROJECTION_AUTO && view != VIEW_FREE);
}

static burnish_framing fit_options(const render_settings *settings, render_view view,
                                   const render_room *room) {
    burnish_framing options = burnish_framing_default();
    options.view_angle = settings->camera.view_angle.value;
    options.aspect = (double)settings->picture.size[0] / settings->picture.size[1];
    options.margin = settings->camera.margin.value;
    options.orthographic = is_parallel(settings, view);
    options.orthographic_height = settings->camera.orthographic_height.given
                                      ? settings->camera.orthographic_height.value
                                      : room->height;
    return options;
}

burnish_annotate_options render_make_annotations(const burnish_mesh *mesh,
                                                 const render_settings *settings) {
    burnish_annotate_options annotations = burnish_annotate_options_default();
    annotations.kinds = settings->picture.annotations |
                        (settings->picture.callouts ? BURNISH_ANNOTATION_CALLOUTS : 0);
    if (settings->input.load.explode.given && settings->input.load.explode.value > 0 &&
        burnish_mesh_get_contents(mesh)->part_count > 1) {
        annotations.kinds &=
            ~(unsigned)BURNISH_ANNOTATION_DIMENSIONS; /* nothing has these lengths */
    }
    memcpy(annotations.up, frame_in_use(mesh, &settings->camera)->up, sizeof annotations.up);
    return annotations;
}

/* What a camera is made from. */
typedef struct request {
    const burnish_mesh *mesh;
    const render_settings *settings;
    const frame *axes;
    burnish_framing framing;
    render_room *room;
} request;

/* burnish_camera_frame with room for annotations. Shadows on the ground get none: the object is as
 * large as without. */
static burnish_status frame_with_room(const request *from, burnish_camera *camera,
                                      burnish_error *error) {
    const burnish_mesh *mesh = from->mesh;
    const render_settings *settings = from->settings;
    render_room *room = from->room;
    burnish_framing framing = from->framing;
    burnish_status status = BURNISH_STATUS_OK;
    burnish_annotate_options annotations = render_make_annotations(mesh, settings);
    burnish_callouts unused;
    annotations.callouts = &unused;
    if (!room->is_given && annotations.kinds) {
        status = burnish_annotate_inset(mesh, &annotations, &framing, settings->picture.size[0],
                                        settings->picture.size[1], room->inset, error);
    }
    if (!room->is_given) {
        room->inset[1] += render_legend_inset(settings);
        room->inset[1] = room->inset[1] < 0.45 ? room->inset[1] : 0.45;
    }
    memcpy(framing.inset, room->inset, sizeof framing.inset);
    return status == BURNISH_STATUS_OK ? burnish_camera_frame(mesh, &framing, camera, error)
                                       : status;
}

/* Frames the object for a direction of view and an up direction. */
static burnish_status fit_along(request from, const double direction[3], const double upward[3],
                                burnish_camera *camera, burnish_error *error) {
    memcpy(from.framing.direction, direction, sizeof from.framing.direction);
    memcpy(from.framing.up, upward, sizeof from.framing.up);
    from.framing.azimuth = from.framing.elevation = 0;
    return frame_with_room(&from, camera, error);
}

static burnish_status explicit_camera(request from, burnish_camera *camera, burnish_error *error) {
    const render_settings *settings = from.settings;
    const burnish_mesh_view *view = burnish_mesh_get_view(from.mesh);
    double focal[3], direction[3], upward[3];
    for (int k = 0; k < 3; ++k) {
        focal[k] = settings->camera.focal_point.given
                       ? settings->camera.focal_point.values[k]
                       : ((double)view->bounds_min[k] + view->bounds_max[k]) / 2;
    }
    subtract(focal, settings->camera.position.values, direction);
    if (dot(direction, direction) == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--camera-position: it is equal to the focal point; move one of them");
    }
    burnish_status status = choose_upward(from.axes, &settings->camera, direction, upward, error);
    if (status == BURNISH_STATUS_OK && from.framing.orthographic) {
        render_room none = {.is_given = 1};
        from.room = &none;
        status = fit_along(from, direction, upward, camera, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    memcpy(camera->position, settings->camera.position.values, sizeof camera->position);
    memcpy(camera->focal_point, focal, sizeof camera->focal_point);
    memcpy(camera->view_up, upward, sizeof camera->view_up);
    camera->view_angle = settings->camera.view_angle.value;
    if (render_is_calibrated(settings)) {
        camera->view_angle =
            2 / BURNISH_DEGREE *
            burnish_atan2(settings->picture.size[1] / 2.0, settings->camera.intrinsics.values[1]);
    }
    return BURNISH_STATUS_OK;
}

/* Triangles of an object that can be turned; more hardly show a single plane. */
enum { TURNED_MAX = 64 };

/* The share of a view of a convex object that the largest plane takes.
 *   total  receives twice the area that is seen, times the length of direction */
static double plane_share(const burnish_mesh_view *view, const double direction[3], double *total) {
    double normals[TURNED_MAX][3], areas[TURNED_MAX], largest = 0;
    *total = 0;
    for (size_t i = 0; i < view->triangle_count; ++i) {
        double edges[2][3];
        for (int k = 0; k < 6; ++k) {
            edges[k / 3][k % 3] =
                (double)view->positions[3 * view->indices[3 * i + 1 + k / 3] + k % 3] -
                (double)view->positions[3 * view->indices[3 * i] + k % 3];
        }
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3, last = (k + 2) % 3;
            normals[i][k] = edges[0][next] * edges[1][last] - edges[0][last] * edges[1][next];
        }
        areas[i] = -dot(normals[i], direction);
        *total += areas[i] > 0 ? areas[i] : 0;
    }
    for (size_t i = 0; i < view->triangle_count; ++i) {
        double area = 0;
        for (size_t k = 0; k < view->triangle_count; ++k) {
            area += areas[k] > 0 && parallel(normals[i], normals[k]) ? areas[k] : 0;
        }
        largest = area > largest ? area : largest;
    }
    return *total > 0 ? largest / *total : 0;
}

/* Turns the three-quarter view of a simple object, such as a tetrahedron, if it shows a single plane
 * and another view shows more of the object but not much less area: plates stay. */
static void turn_default(request *from) {
    static const double azimuths[] = {0, 30, -30, 60, -60};
    const burnish_mesh_view *view = burnish_mesh_get_view(from->mesh);
    burnish_framing framing = from->framing;
    double seen = 0;
    for (size_t i = 0; i < 5 && view->triangle_count <= TURNED_MAX; ++i) {
        burnish_camera camera;
        double direction[3], total;
        framing.azimuth = azimuths[i];
        if (burnish_camera_frame(from->mesh, &framing, &camera, NULL) != BURNISH_STATUS_OK) {
            return;
        }
        subtract(camera.focal_point, camera.position, direction);
        const double share = plane_share(view, direction, &total);
        total /= sqrt(dot(direction, direction));
        seen = i == 0 ? total : seen;
        if (i == 0 && share < 0.97) {
            return;
        }
        if (share < 0.8 && total > 0.6 * seen) {
            from->framing.azimuth = framing.azimuth;
            return;
        }
    }
}

/* Degrees by which the three-quarter view of a flat object is raised, so that its face, with what is
 * on it, is not foreshortened: from 0 if the height is a quarter of the longest side to 30 at a
 * twentieth. */
static double lift_of_flat(const burnish_mesh *mesh, const double up[3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    double height = 0, longest = 0;
    for (int k = 0; k < 3; ++k) {
        const double extent = (double)view->bounds_max[k] - (double)view->bounds_min[k];
        height += fabs(up[k]) * extent;
        longest = extent > longest ? extent : longest;
    }
    return longest > 0 ? fmin(fmax((0.25 - height / longest) * 150, 0), 30) : 0;
}

static int has_own_view(const render_camera_settings *camera) {
    return camera->direction.given || camera->view_up.given || camera->azimuth.value != 0 ||
           camera->elevation.given;
}

render_view render_section_view(const burnish_mesh *mesh, const render_settings *settings,
                                double toward[3]) {
    const render_section *section = &settings->input.section;
    const frame *axes = frame_in_use(mesh, &settings->camera);
    int view = VIEW_FREE; /* of two views along an axis, the one that drawings show comes first */
    double side = 0;
    while (view < VIEW_BOTTOM && !(section->sign == 0 ? side != 0 : side * section->sign > 0)) {
        combine(axes, views[++view].toward, 1, toward);
        side = toward[section->axis - 1];
    }
    return (render_view)view;
}

/* The default view: three-quarter, or the standard view that shows a flat object face on. */
static render_view default_view(request *from) {
    const render_camera_settings *camera = &from->settings->camera;
    const frame *axes = from->axes;
    const int k = camera->flat_axis - 1;
    if (has_own_view(camera)) {
        return VIEW_FREE;
    }
    if (k < 0) {
        turn_default(from);
        return VIEW_FREE;
    }
    return axes->up[k] != 0 ? VIEW_TOP : axes->front[k] != 0 ? VIEW_FRONT : VIEW_RIGHT;
}

/* The camera that shows the whole object: standard views, --camera-direction, three-quarter view.
 */
static burnish_status framed_camera(request from, render_view view, burnish_camera *camera,
                                    burnish_error *error) {
    const render_settings *settings = from.settings;
    const frame *axes = from.axes;
    burnish_framing *framing = &from.framing;
    double direction[3], upward[3];
    burnish_status status;
    memcpy(framing->up, axes->up, sizeof framing->up);
    framing->elevation = settings->camera.elevation.value;
    if (!settings->camera.elevation.given && !settings->camera.direction.given &&
        !settings->camera.view_up.given) {
        framing->elevation += lift_of_flat(from.mesh, axes->up);
    }
    const double *slant = settings->camera.slant;
    if (view == VIEW_FREE && !has_own_view(&settings->camera) && dot(slant, slant) > 0) {
        subtract((const double[3]){0, 0, 0}, slant, direction);
        usual_upward(axes, direction, upward);
        return fit_along(from, direction, upward, camera, error);
    }
    view = view == VIEW_FREE ? default_view(&from) : view;
    if (view != VIEW_FREE) {
        combine(axes, views[view].toward, -1, direction);
        combine(axes, views[view].upward, 1, upward);
        return fit_along(from, direction, upward, camera, error);
    }
    framing->azimuth += settings->camera.azimuth.value;
    if (settings->camera.direction.given) {
        memcpy(framing->direction, settings->camera.direction.values, sizeof framing->direction);
        if (!settings->camera.view_up.given && parallel(framing->direction, framing->up)) {
            usual_upward(axes, framing->direction, framing->up);
        }
    }
    if (!settings->camera.view_up.given) {
        return frame_with_room(&from, camera, error);
    }
    status = burnish_camera_frame(from.mesh, framing, camera, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    /* The extents change when the picture is rolled: frame again along this direction. */
    subtract(camera->focal_point, camera->position, direction);
    status = choose_upward(axes, &settings->camera, direction, upward, error);
    return status == BURNISH_STATUS_OK ? fit_along(from, direction, upward, camera, error) : status;
}

/* One of the input's own cameras. */
static burnish_status own_camera(const burnish_mesh *mesh, const render_settings *settings,
                                 burnish_camera *camera, burnish_error *error) {
    const size_t count = burnish_mesh_get_camera_count(mesh);
    const char *wanted = settings->camera.own;
    double number;
    const int is_number = cli_read_real(wanted, strlen(wanted), &number);
    for (size_t i = 0; i < count; ++i) {
        const burnish_named_camera *own = burnish_mesh_get_camera(mesh, i);
        if (strcmp(own->name, wanted) == 0 || (is_number && number == (double)i)) {
            *camera = own->camera;
            return BURNISH_STATUS_OK;
        }
    }
    return cli_fail(
        error, BURNISH_STATUS_ARGUMENT,
        "--camera: \"%s\" is not one of the input's %zu; use a name, or a number from 0 to %zu",
        wanted, count, count - 1);
}

void render_upward(const burnish_mesh *mesh, const render_camera_settings *camera, double up[3]) {
    memcpy(up, frame_in_use(mesh, camera)->up, 3 * sizeof *up);
}

burnish_status render_camera(const burnish_mesh *mesh, const render_settings *settings,
                             render_view view, render_room *room, burnish_camera *camera,
                             burnish_error *error) {
    double toward[3];
    view = view == VIEW_SECTION ? render_section_view(mesh, settings, toward) : view;
    const request from = {mesh, settings, frame_in_use(mesh, &settings->camera),
                          fit_options(settings, view, room), room};
    *camera = (burnish_camera){.view_angle = settings->camera.view_angle.value};
    burnish_status status =
        settings->camera.own && view == VIEW_FREE && burnish_mesh_get_camera_count(mesh) > 0
            ? own_camera(mesh, settings, camera, error)
        : settings->camera.position.given ? explicit_camera(from, camera, error)
                                          : framed_camera(from, view, camera, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (settings->camera.focal_point.given && !settings->camera.position.given) {
        for (int k = 0; k < 3; ++k) {
            camera->position[k] += settings->camera.focal_point.values[k] - camera->focal_point[k];
            camera->focal_point[k] = settings->camera.focal_point.values[k];
        }
    }
    double zoom = settings->camera.zoom.value;
    if (camera->orthographic_height > 0) {
        camera->orthographic_height /= zoom;
    } else if (zoom != 1) {
        for (int k = 0; k < 3; ++k) {
            camera->position[k] =
                camera->focal_point[k] + (camera->position[k] - camera->focal_point[k]) / zoom;
        }
    }
    return BURNISH_STATUS_OK;
}
