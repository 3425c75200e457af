/* The camera's view of the bounding box, and what touches what on the screen. */
#include "annotate/annotate.h"
#include "base/numbers.h"

#include <string.h>

burnish_vec3 burnish_annotation_corner(const burnish_annotation_view *view, int bits) {
    return (burnish_vec3){bits & 1 ? view->high.x : view->low.x,
                          bits & 2 ? view->high.y : view->low.y,
                          bits & 4 ? view->high.z : view->low.z};
}

burnish_point burnish_annotation_project(const burnish_annotation_view *view, burnish_vec3 p,
                                         double *distance) {
    const burnish_vec3 v = burnish_vec3_sub(p, view->eye);
    *distance = burnish_vec3_dot(v, view->forward);
    const double scale = view->parallel ? view->pixels : view->pixels / *distance;
    return (burnish_point){view->width / 2 + burnish_vec3_dot(v, view->right) * scale,
                           view->height / 2 - burnish_vec3_dot(v, view->up) * scale};
}

/* ---- What touches what ---- */

int burnish_areas_touch(const burnish_area *a, const burnish_area *b) {
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

void burnish_order_axes(const double keys[3], int order[3]) {
    for (int i = 0; i < 3; ++i) {
        int at = i;
        for (; at > 0 && keys[order[at - 1]] < keys[i] - 1e-6; --at) {
            order[at] = order[at - 1];
        }
        order[at] = i;
    }
}

int burnish_segment_hits(burnish_point a, burnish_point b, const burnish_area *area) {
    double from = 0, to = 1;
    return burnish_cut_to_range(a.x, b.x - a.x, area->left, area->right, &from, &to) &&
           burnish_cut_to_range(a.y, b.y - a.y, area->top, area->bottom, &from, &to);
}

/* Both are convex: they are apart if all of one is outside an edge of the other. */
int burnish_annotation_hits_hull(const burnish_annotation_view *view, const burnish_area *area) {
    const burnish_point box[4] = {{area->left, area->top},
                                  {area->right, area->top},
                                  {area->right, area->bottom},
                                  {area->left, area->bottom}};
    burnish_area bounds = {view->hull[0].x, view->hull[0].y, view->hull[0].x, view->hull[0].y};
    for (int i = 0; i < view->hull_count; ++i) {
        const burnish_point a = view->hull[i], b = view->hull[(i + 1) % view->hull_count];
        int outside = view->hull_count > 2;
        for (int k = 0; k < 4 && outside; ++k) {
            outside = burnish_cross_of_points(a, b, box[k]) <= 0;
        }
        if (outside) {
            return 0;
        }
        bounds.left = a.x < bounds.left ? a.x : bounds.left;
        bounds.right = a.x > bounds.right ? a.x : bounds.right;
        bounds.top = a.y < bounds.top ? a.y : bounds.top;
        bounds.bottom = a.y > bounds.bottom ? a.y : bounds.bottom;
    }
    return bounds.left <= area->right && area->left <= bounds.right && bounds.top <= area->bottom &&
           area->top <= bounds.bottom;
}

/* ---- Making it ---- */

/* Rounds to 1/64 pixel: corners that coincide in a view along an axis are then equal. */
static double snap_to_64ths(double value) {
    value = value > -1e12 ? value : -1e12;
    value = value < 1e12 ? value : 1e12;
    return (double)(int64_t)(value * 64 + (value < 0 ? -0.5 : 0.5)) / 64;
}

/* Andrew's monotone chain; cross is positive inside the hull. */
static void make_hull(burnish_annotation_view *view) {
    burnish_point sorted[8], chain[17];
    int count = 0;
    for (int i = 0; i < 8; ++i) {
        int at = i;
        const burnish_point p = {snap_to_64ths(view->corners[i].x),
                                 snap_to_64ths(view->corners[i].y)};
        for (; at > 0 &&
               (sorted[at - 1].x > p.x || (sorted[at - 1].x == p.x && sorted[at - 1].y > p.y));
             --at) {
            sorted[at] = sorted[at - 1];
        }
        sorted[at] = p;
    }
    for (int pass = 0; pass < 2; ++pass) {
        const int start = count;
        for (int i = 0; i < 8; ++i) {
            const burnish_point p = sorted[pass == 0 ? i : 7 - i];
            while (count - start >= 2 &&
                   burnish_cross_of_points(chain[count - 2], chain[count - 1], p) <= 0) {
                --count;
            }
            chain[count++] = p;
        }
        --count; /* the last begins the other half */
    }
    view->hull_count = count > 8 ? 8 : count;
    for (int i = 0; i < view->hull_count; ++i) {
        view->hull[i] = chain[i];
    }
}

static void choose_up(const burnish_mesh_view *mesh, const double wanted[3],
                      burnish_annotation_view *view) {
    double largest = 0;
    const int given = wanted[0] != 0 || wanted[1] != 0 || wanted[2] != 0;
    for (int k = 0; k < 3; ++k) {
        const double value = given ? wanted[k] : mesh->up_axis[k];
        const double size = value < 0 ? -value : value;
        if (size > largest) {
            largest = size;
            view->up_axis = k;
            view->up_negative = value < 0;
        }
    }
}

/* Text and lines grow with the picture; both are whole pixels, to be sharp. */
static void choose_sizes(const burnish_annotate_options *annotations,
                         burnish_annotation_view *view) {
    const double smaller = view->width < view->height ? view->width : view->height;
    view->lengths = annotations->lengths ? annotations->lengths : 7;
    double text = annotations->text_height > 0 ? annotations->text_height : smaller / 44;
    text = annotations->text_height > 0 || text > 9 ? text : 9;
    view->text = (double)(int)(text + 0.5);
    view->line = annotations->text_height > 0 ? view->text / 14 /* .25 mm where it is 3.5 mm */
                                              : (double)(int)(view->text / 12 + 0.5);
    view->line = view->line > 1 ? view->line : 1;
}

burnish_status burnish_annotation_view_make(const burnish_mesh *mesh,
                                            const burnish_annotate_options *annotations,
                                            const burnish_camera *camera, int width, int height,
                                            burnish_annotation_view *view, burnish_error *error) {
    const burnish_mesh_view *arrays = burnish_mesh_get_view(mesh);
    double distance;
    *view = (burnish_annotation_view){.width = width,
                                      .height = height,
                                      .corners_seen = 1,
                                      .box = BURNISH_AREA_NONE,
                                      .mesh = arrays,
                                      .section = annotations->section,
                                      .depth = annotations->depth,
                                      .depth_stride = annotations->depth_stride,
                                      .triangles = annotations->triangles,
                                      .parts = burnish_mesh_get_contents(mesh)->parts};
    if (annotations->kinds & BURNISH_ANNOTATION_CALLOUTS) {
        view->callouts = annotations->callouts;
    }
    view->eye = burnish_vec3_load(camera->position);
    view->forward =
        burnish_vec3_normalize(burnish_vec3_sub(burnish_vec3_load(camera->focal_point), view->eye));
    view->right = burnish_vec3_normalize(
        burnish_vec3_cross(view->forward, burnish_vec3_load(camera->view_up)));
    view->up = burnish_vec3_cross(view->right, view->forward);
    if (!(burnish_vec3_length(view->right) > 0.5) ||
        !(camera->orthographic_height > 0 || (camera->view_angle >= BURNISH_VIEW_ANGLE_MIN &&
                                              camera->view_angle <= BURNISH_VIEW_ANGLE_MAX))) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: it looks nowhere; take one that a picture was drawn with");
    }
    view->parallel = camera->orthographic_height > 0;
    if (view->parallel) {
        view->pixels = height / camera->orthographic_height;
    } else {
        double sine, cosine;
        burnish_sincos(camera->view_angle * (BURNISH_DEGREE / 2), &sine, &cosine);
        view->pixels = height * 0.5 * cosine / sine;
    }
    float low[3], high[3];
    burnish_mesh_get_bounds(mesh, low, high);
    view->low = burnish_vec3_loadf(low);
    view->high = burnish_vec3_loadf(high);
    memcpy(view->origin, arrays->origin, sizeof view->origin);
    view->diagonal = burnish_vec3_length(burnish_vec3_sub(view->high, view->low));
    choose_up(arrays, annotations->up, view);
    choose_sizes(annotations, view);
    for (int i = 0; i < 8; ++i) {
        view->corners[i] =
            burnish_annotation_project(view, burnish_annotation_corner(view, i), &distance);
        view->corners_seen &= view->parallel || distance > 1e-6 * view->diagonal;
        const burnish_point p = view->corners[i];
        burnish_area_widen(&view->box, (burnish_area){p.x, p.y, p.x, p.y});
    }
    if (view->corners_seen) {
        make_hull(view);
    }
    return BURNISH_STATUS_OK;
}
