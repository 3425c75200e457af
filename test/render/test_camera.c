/* burnish_camera_frame: everything is inside the margin and as large as it allows; the axes are the
 * documented ones. */
#include <math.h>

#include "burnish/mesh.h"
#include "mesh/build/build.h"
#include "mesh/builtin.h"
#include "mesh_arrays.h"
#include "support.h"

#define DEGREE (acos(-1.0) / 180)

static burnish_mesh *builtin(const char *name) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_data data = {0};
    burnish_mesh *mesh = NULL;
    options.tessellation = 6;
    CHECK1(burnish_make_builtin(name, &options, &data, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_mesh_build(&data, name, &options, BURNISH_FORMAT_BUILTIN, &mesh) ==
           BURNISH_STATUS_OK);
    burnish_mesh_data_destroy(&data);
    return mesh;
}

static burnish_mesh *triangles(const float *positions, size_t triangle_count) {
    uint32_t indices[64];
    for (uint32_t i = 0; i < 64; ++i) {
        indices[i] = i;
    }
    const burnish_mesh_description arrays =
        describe_arrays(positions, NULL, NULL, 3 * triangle_count, indices, triangle_count);
    return create_mesh(&arrays, NULL);
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
    for (int k = 0; k < 3; ++k) {
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

/* Unit axes right, up, back of a camera, and the distance to its focal point. */
static double axes(const burnish_camera *camera, double right[3], double up[3], double back[3]) {
    double distance = 0, length;
    for (int k = 0; k < 3; ++k) {
        back[k] = camera->position[k] - camera->focal_point[k];
    }
    distance = sqrt(dot(back, back));
    for (int k = 0; k < 3; ++k) {
        back[k] /= distance;
    }
    cross(camera->view_up, back, right);
    length = sqrt(dot(right, right));
    for (int k = 0; k < 3; ++k) {
        right[k] /= length;
    }
    cross(back, right, up);
    return distance;
}

/* The mesh's extent in the picture, in units of half its height: x0, x1, y0, y1. */
static void extent(const burnish_mesh *mesh, const burnish_camera *camera, double e[4]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    double right[3], up[3], back[3], scale = tan(camera->view_angle * DEGREE / 2);
    axes(camera, right, up, back);
    e[0] = e[2] = INFINITY;
    e[1] = e[3] = -INFINITY;
    for (size_t i = 0; i < view->vertex_count; ++i) {
        double v[3];
        for (int k = 0; k < 3; ++k) {
            v[k] = (double)view->positions[3 * i + k] - camera->position[k];
        }
        double depth = -dot(v, back);
        CHECK(depth > 0, "vertex %zu lies behind the camera", i);
        double half =
            camera->orthographic_height > 0 ? camera->orthographic_height / 2 : depth * scale;
        double x = dot(v, right) / half, y = dot(v, up) / half;
        e[0] = fmin(e[0], x);
        e[1] = fmax(e[1], x);
        e[2] = fmin(e[2], y);
        e[3] = fmax(e[3], y);
    }
}

/* Fits and proves it: centred in both axes, inside the margins, touching in one. touches 0: a
 * camera that had to keep its distance. */
static burnish_camera fit(const burnish_mesh *mesh, const burnish_framing *options, int touches) {
    burnish_camera camera = {{0}, {0}, {0}, 0, 0};
    burnish_error error = {BURNISH_STATUS_OK, ""};
    CHECK_OK(burnish_camera_frame(mesh, options, &camera, &error), error);
    double e[4], free_side = 2 * options->margin * fmin(options->aspect, 1);
    double limit_x = options->aspect - free_side, limit_y = 1 - free_side;
    extent(mesh, &camera, e);
    CHECK(fabs(e[0] + e[1]) < 1e-9 && fabs(e[2] + e[3]) < 1e-9, "centre off by %g, %g", e[0] + e[1],
          e[2] + e[3]);
    CHECK(e[1] <= limit_x + 1e-9 && e[3] <= limit_y + 1e-9, "x %g of %g, y %g of %g", e[1], limit_x,
          e[3], limit_y);
    int touching = fabs(e[1] - limit_x) < 1e-9 || fabs(e[3] - limit_y) < 1e-9;
    CHECK(touching == touches, "x %.12g of %g, y %.12g of %g", e[1], limit_x, e[3], limit_y);
    CHECK1(camera.view_angle == options->view_angle);
    CHECK1((camera.orthographic_height > 0) == (options->orthographic != 0));
    return camera;
}

static void check_axis(const double actual[3], double x, double y, double z, const char *what) {
    CHECK(fabs(actual[0] - x) + fabs(actual[1] - y) + fabs(actual[2] - z) < 1e-9,
          "%s: %g %g %g, not %g %g %g", what, actual[0], actual[1], actual[2], x, y, z);
}

/* Insets and a given height: the object is in the middle of the remaining area, at the size that
 * fits there or at the given one. */
static void test_insets(void) {
    const double cases[][4] = {{0.1, 0, 0, 0}, {0, 0.2, 0.05, 0.15}, {0.3, 0.3, 0.01, 0}};
    burnish_mesh *mesh = builtin("teapot");
    burnish_error error;
    for (int i = 0; i < 3; ++i) {
        for (int projection = 0; projection < 3; ++projection) {
            burnish_framing options = burnish_framing_default();
            burnish_camera camera;
            double e[4], t[4], smaller = 1;
            options.aspect = 1.5;
            options.orthographic = projection > 0;
            options.orthographic_height = projection == 2 ? 12 : 0;
            memcpy(options.inset, cases[i], sizeof options.inset);
            CHECK_OK(burnish_camera_frame(mesh, &options, &camera, &error), error);
            CHECK1(projection < 2 || camera.orthographic_height == 12);
            extent(mesh, &camera, e);
            for (int k = 0; k < 4; ++k) {
                t[k] = options.margin + cases[i][k];
            }
            const double x0 = -options.aspect + 2 * smaller * t[0], y0 = -1 + 2 * smaller * t[2];
            const double x1 = options.aspect - 2 * smaller * t[1], y1 = 1 - 2 * smaller * t[3];
            /* in perspective what is left and right of the picture's middle shrinks in proportion
             */
            const double fx = projection > 0 ? 1 : x0 / x1, fy = projection > 0 ? 1 : y0 / y1;
            const double gx = projection > 0 ? e[0] - x0 - (x1 - e[1]) : e[0] - fx * e[1];
            const double gy = projection > 0 ? e[2] - y0 - (y1 - e[3]) : e[2] - fy * e[3];
            CHECK(fabs(gx) < 1e-9 && fabs(gy) < 1e-9,
                  "case %d, projection %d: %g %g %g %g in %g %g %g %g", i, projection, e[0], e[1],
                  e[2], e[3], x0, x1, y0, y1);
            CHECK1(projection == 2 || fabs(e[0] - x0) < 1e-9 || fabs(e[2] - y0) < 1e-9);
        }
    }
    burnish_framing options = burnish_framing_default();
    burnish_camera camera;
    options.margin = 0.2;
    options.inset[2] = options.inset[3] = 0.3;
    CHECK1(burnish_camera_frame(mesh, &options, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    options.inset[2] = -1;
    CHECK1(burnish_camera_frame(mesh, &options, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    options = burnish_framing_default();
    options.orthographic_height = -1;
    CHECK1(burnish_camera_frame(mesh, &options, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    burnish_mesh_destroy(mesh);
}

static void test_exact_fit(void) {
    const char *names[] = {"teapot", "knot", "torus"};
    const double aspects[] = {1, 16 / 9.0, 0.4}, angles[] = {30, 5, 100};
    const double margins[] = {0.05, 0, 0.45};
    for (int name = 0; name < 3; ++name) {
        burnish_mesh *mesh = builtin(names[name]);
        for (int i = 0; i < 54; ++i) {
            burnish_framing options = burnish_framing_default();
            options.aspect = aspects[i % 3];
            options.view_angle = angles[i / 3 % 3];
            options.margin = margins[i / 9 % 3];
            options.orthographic = i / 27;
            options.azimuth = 17 * i;
            options.elevation = 3 * i;
            fit(mesh, &options, 1);
        }
        burnish_mesh_destroy(mesh);
    }
}

/* The camera of a fine sphere is at r / sin of the remaining angle, on the three-quarter axis. */
static void test_sphere_distance(void) {
    burnish_load_options load = burnish_load_options_default();
    burnish_mesh_data data = {0};
    burnish_mesh *mesh = NULL;
    load.tessellation = 64;
    CHECK1(burnish_make_builtin("sphere", &load, &data, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_mesh_build(&data, "sphere", &load, BURNISH_FORMAT_BUILTIN, &mesh) ==
           BURNISH_STATUS_OK);
    burnish_mesh_data_destroy(&data);
    burnish_framing options = burnish_framing_default();
    burnish_camera camera = fit(mesh, &options, 1);
    double distance = sqrt(dot(camera.position, camera.position));
    double expected = 1 / sin(atan(tan(15 * DEGREE) * 0.9));
    CHECK(fabs(distance / expected - 1) < 1e-3, "%g, not %g", distance, expected);
    CHECK(sqrt(dot(camera.focal_point, camera.focal_point)) < 1e-3, "focal point off the centre");
    burnish_mesh_destroy(mesh);
}

/* Cameras and lights of a file remain when it has no material. */
static void test_no_materials(void) {
    burnish_load_options load = burnish_load_options_default();
    burnish_mesh_data data = {0};
    burnish_mesh *mesh = NULL;
    CHECK1(burnish_make_builtin("sphere", &load, &data, NULL) == BURNISH_STATUS_OK);
    data.cameras =
        burnish_allocate_zeroed(&data.memory, 1, sizeof *data.cameras, "a camera without a name");
    data.lights = burnish_allocate_zeroed(&data.memory, 1, sizeof *data.lights, "a light");
    if (CHECK1(data.cameras && data.lights)) {
        data.cameras->camera.position[1] = 7;
        data.camera_count = data.light_count = 1;
        CHECK1(data.material_count == 0);
        CHECK1(burnish_mesh_build(&data, "sphere", &load, BURNISH_FORMAT_BUILTIN, &mesh) ==
               BURNISH_STATUS_OK);
        const burnish_named_camera *camera = burnish_mesh_get_camera(mesh, 0);
        CHECK(camera && camera->camera.position[1] == 7, "the camera is lost");
        CHECK(burnish_mesh_get_light_count(mesh) == 1, "the light is lost");
    }
    burnish_mesh_data_destroy(&data);
    burnish_mesh_destroy(mesh);
}

static void test_three_quarter(void) {
    burnish_mesh *mesh = builtin("sphere");
    burnish_framing options = burnish_framing_default();
    double right[3], up[3], back[3], a = 35 * DEGREE, e = 20 * DEGREE;
    burnish_camera camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, sin(a) * cos(e), sin(e), cos(a) * cos(e), "+Y up: back");
    check_axis(right, cos(a), 0, -sin(a), "+Y up: right");
    check_axis(camera.view_up, up[0], up[1], up[2], "view_up is exact");

    options.up[1] = 0;
    options.up[2] = 7; /* any length */
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, sin(a) * cos(e), -cos(a) * cos(e), sin(e), "+Z up: back");
    check_axis(right, cos(a), sin(a), 0, "+Z up: right");

    options.up[2] = 0;
    options.up[1] = -1e-50;
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    CHECK(up[1] < -0.9 && back[1] < 0 && back[2] < 0, "-Y up: back %g %g %g", back[0], back[1],
          back[2]);

    options.up[0] = 1e90;
    options.up[1] = 2e90;
    options.up[2] = -3e90;
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    double length = sqrt(14), unit[3] = {1 / length, 2 / length, -3 / length};
    CHECK(fabs(dot(back, unit) - sin(e)) < 1e-9 && fabs(dot(right, unit)) < 1e-9, "any up: %g %g",
          dot(back, unit), dot(right, unit));
    burnish_mesh_destroy(mesh);
}

/* Views that CAD names: direction, and what is right and up in the picture. */
static void test_named_views(void) {
    static const struct {
        double up[3], direction[3], right[3], picture_up[3];
    } views[] = {
        {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},  /* front */
        {{0, 1, 0}, {-5, 0, 0}, {0, 0, -1}, {0, 1, 0}}, /* right */
        {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}}, /* top */
        {{0, 1, 0}, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}},   /* bottom */
        {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   /* front */
        {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  /* right */
        {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},  /* top */
        {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  /* bottom */
    };
    burnish_mesh *mesh = builtin("teapot");
    for (int i = 0; i < 8; ++i) {
        burnish_framing options = burnish_framing_default();
        double right[3], up[3], back[3];
        memcpy(options.up, views[i].up, sizeof options.up);
        memcpy(options.direction, views[i].direction, sizeof options.direction);
        burnish_camera camera = fit(mesh, &options, 1);
        axes(&camera, right, up, back);
        const double *r = views[i].right, *u = views[i].picture_up;
        check_axis(right, r[0], r[1], r[2], "right");
        check_axis(up, u[0], u[1], u[2], "up");
    }
    burnish_mesh_destroy(mesh);
}

/* Azimuth and elevation turn the given direction; tilting past the pole does not jump. */
static void test_turns(void) {
    burnish_mesh *mesh = builtin("knot");
    burnish_framing options = burnish_framing_default();
    double right[3], up[3], back[3], s = sqrt(0.5);
    options.direction[2] = -3;
    options.azimuth = 90;
    burnish_camera camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, 1, 0, 0, "azimuth 90: the camera is on the right");
    options.azimuth = -45;
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, -s, 0, s, "azimuth -45");
    options.elevation = 90;
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, 0, 1, 0, "elevation 90: from above");
    check_axis(up, s, 0, -s, "elevation 90: up");
    options.azimuth = 0;
    options.elevation = 135;
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, 0, s, -s, "elevation 135: over the top");
    check_axis(up, 0, -s, -s, "elevation 135: upside down");
    options.elevation = -30;
    camera = fit(mesh, &options, 1);
    axes(&camera, right, up, back);
    check_axis(back, 0, -0.5, sqrt(0.75), "elevation -30: from below");
    burnish_mesh_destroy(mesh);
}

static void test_degenerate_shapes(void) {
    burnish_framing options = burnish_framing_default();
    const float flat[] = {-1, 0, 0, 1, 0, 0, 0, 0, 1};
    burnish_mesh *mesh = triangles(flat, 1);
    for (int i = 0; i < 2; ++i) {
        options.orthographic = i;
        options.direction[0] = options.direction[1] = 0;
        options.direction[2] = -1; /* along the plane */
        fit(mesh, &options, 1);
        options.direction[1] = -1;
        options.direction[2] = 0;
        fit(mesh, &options, 1);
    }
    burnish_mesh_destroy(mesh);

    /* A needle seen from its tip: the sides alone would put the camera on the tip. */
    const float needle[] = {0, 0, 10, -0.1f, 0, 0, 0.1f, 0, 0};
    mesh = triangles(needle, 1);
    options = burnish_framing_default();
    options.direction[2] = -1;
    burnish_camera camera = fit(mesh, &options, 0);
    CHECK(camera.position[2] > 10.05, "%g", camera.position[2]);
    CHECK(camera.focal_point[2] < 10, "%g", camera.focal_point[2]);
    burnish_mesh_destroy(mesh);

    /* Sizes at both ends of float, and a small mesh far from the origin. */
    const float sizes[] = {1e-45f, 1e-20f, 3e38f};
    for (int i = 0; i < 6; ++i) {
        float s = sizes[i / 2];
        const float view[] = {-s, 0, 0, s, 0, 0, 0, s, 0};
        mesh = triangles(view, 1);
        options = burnish_framing_default();
        options.orthographic = i % 2;
        fit(mesh, &options, 1);
        burnish_mesh_destroy(mesh);
    }
    const float far[] = {1e6f, 1e6f, 1e6f, 1e6f + 1, 1e6f, 1e6f, 1e6f, 1e6f + 2, 1e6f};
    mesh = triangles(far, 1);
    options = burnish_framing_default();
    options.direction[2] = -1;
    fit(mesh, &options, 1);
    burnish_mesh_destroy(mesh);
}

/* If the caller gives no up axis, the mesh's is used: +Z for STL. */
static void test_up_of_format(void) {
    static const char STL[] = "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                              "vertex 0 0 1\nendloop\nendfacet\nendsolid\n";
    static const double Z[3] = {0, 0, 1};
    burnish_framing options = burnish_framing_default();
    burnish_camera own, told;
    burnish_mesh *mesh = load_bytes(STL, sizeof STL - 1, "a.stl", NULL);
    CHECK1(burnish_mesh_get_view(mesh)->up_axis[2] == 1);
    CHECK1(burnish_camera_frame(mesh, &options, &own, NULL) == BURNISH_STATUS_OK);
    memcpy(options.up, Z, sizeof Z);
    CHECK1(burnish_camera_frame(mesh, &options, &told, NULL) == BURNISH_STATUS_OK);
    CHECK1(memcmp(&own, &told, sizeof own) == 0 && own.view_up[2] > 0.9);
    burnish_mesh_destroy(mesh);
}

static void test_arguments(void) {
    burnish_mesh *mesh = builtin("torus");
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_camera camera;
    burnish_framing wrong[16];
    const char *words[16] = {"burnish_framing_default()",
                             "up[1]",
                             "up[2]",
                             "direction[0]",
                             "azimuth",
                             "elevation",
                             "view_angle 0",
                             "view_angle 180",
                             "view_angle",
                             "aspect 0",
                             "aspect -1",
                             "aspect",
                             "margin -0.01",
                             "margin 0.46",
                             "margin",
                             "direction[1]"};
    for (int i = 0; i < 16; ++i) {
        wrong[i] = burnish_framing_default();
    }
    wrong[0].cookie = burnish_load_options_default().cookie;
    wrong[1].up[1] = -INFINITY;
    wrong[2].up[2] = NAN;
    wrong[3].direction[0] = INFINITY;
    wrong[4].azimuth = NAN;
    wrong[5].elevation = 1e7;
    wrong[6].view_angle = 0;
    wrong[7].view_angle = 180;
    wrong[8].view_angle = NAN;
    wrong[9].aspect = 0;
    wrong[10].aspect = -1;
    wrong[11].aspect = INFINITY;
    wrong[12].margin = -0.01;
    wrong[13].margin = 0.46;
    wrong[14].margin = NAN;
    wrong[15].direction[1] = -1e200;
    for (int i = 0; i < 16; ++i) {
        CHECK(burnish_camera_frame(mesh, &wrong[i], &camera, &error) == BURNISH_STATUS_ARGUMENT,
              "%d", i);
        CHECK(strstr(error.text, words[i]), "%d: %s", i, error.text);
    }
    burnish_framing options = burnish_framing_default();
    options.view_angle = 1e-320;
    CHECK1(burnish_camera_frame(mesh, &options, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK(strstr(error.text, "view_angle"), "%s", error.text);
    options.view_angle = 1e-3;
    fit(mesh, &options, 1);
    options = burnish_framing_default();
    CHECK1(options.view_angle == 30 && options.margin == 0.05 && options.aspect == 1);
    CHECK1(burnish_camera_frame(NULL, &options, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_camera_frame(mesh, NULL, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_camera_frame(mesh, &options, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_exact_fit());
    RUN(test_insets());
    RUN(test_sphere_distance());
    RUN(test_no_materials());
    RUN(test_three_quarter());
    RUN(test_named_views());
    RUN(test_turns());
    RUN(test_degenerate_shapes());
    RUN(test_up_of_format());
    RUN(test_arguments());
    return test_end("camera");
}
