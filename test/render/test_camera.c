/* burnish_camera_frame: everything is inside the margin and as large as it allows; the axes are the
 * documented ones. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/build/build.h"
#include "mesh/builtin.h"
#include "mesh_arrays.h"
#include "pictures.h"
#include "vec.h"

#define DEGREE (acos(-1.0) / 180)

static burnish_mesh *triangle(const float *positions) {
    static const uint32_t indices[3] = {0, 1, 2};
    const burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 3, indices, 1);
    return create_mesh(&arrays, NULL);
}

/* Unit axes right, up, back of a camera, and the distance to its focal point. */
static double axes(const burnish_camera *camera, double right[3], double up[3], double back[3]) {
    for (int k = 0; k < 3; ++k) {
        back[k] = camera->position[k] - camera->focal_point[k];
    }
    const double distance = sqrt(dot(back, back));
    normalize(back);
    cross(camera->view_up, back, right);
    normalize(right);
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

static void check_axis(const double actual[3], const double expected[3], size_t view,
                       const char *what) {
    CHECK(fabs(actual[0] - expected[0]) + fabs(actual[1] - expected[1]) +
                  fabs(actual[2] - expected[2]) <
              1e-9,
          "view %zu, %s: %g %g %g, not %g %g %g", view, what, actual[0], actual[1], actual[2],
          expected[0], expected[1], expected[2]);
}

/* Insets and a given height: the object is in the middle of the remaining area, at the size that
 * fits there or at the given one. */
static void test_insets(void) {
    const double cases[][4] = {{0.1, 0, 0, 0}, {0, 0.2, 0.05, 0.15}, {0.3, 0.3, 0.01, 0}};
    burnish_mesh *mesh = load_tessellated(":teapot", 6);
    burnish_error error;
    for (int i = 0; i < 3; ++i) {
        for (int projection = 0; projection < 3; ++projection) {
            burnish_framing options = burnish_framing_default();
            burnish_camera camera;
            double e[4], t[4];
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
            const double x0 = -options.aspect + 2 * t[0], y0 = -1 + 2 * t[2];
            const double x1 = options.aspect - 2 * t[1], y1 = 1 - 2 * t[3];
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
    burnish_mesh_destroy(mesh);
}

static void test_exact_fit(void) {
    const char *names[] = {":teapot", ":knot", ":torus"};
    const double aspects[] = {1, 16 / 9.0, 0.4}, angles[] = {30, 5, 100};
    const double margins[] = {0.05, 0, 0.45};
    for (int name = 0; name < 3; ++name) {
        burnish_mesh *mesh = load_tessellated(names[name], 6);
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

/* Where the camera stands, and what is right and up in the picture: of the default direction, of
 * views that CAD names, and turned: tilting past the pole does not jump. Up may have any length. */
static void test_views(void) {
    const double a = sin(35 * DEGREE), b = cos(35 * DEGREE), c = cos(20 * DEGREE),
                 d = sin(20 * DEGREE), s = sqrt(0.5);
    const struct {
        double up[3], direction[3], azimuth, elevation, back[3], right[3], picture_up[3];
    } views[] = {
        /* three-quarter */
        {{0, 1, 0}, {0}, NAN, 0, {a * c, d, b * c}, {b, 0, -a}, {-a * d, c, -b * d}},
        {{0, 0, 7}, {0}, NAN, 0, {a * c, -b * c, d}, {b, a, 0}, {-a * d, b * d, c}},
        {{0, -1e-50, 0}, {0}, NAN, 0, {a * c, -d, -b * c}, {b, 0, a}, {-a * d, -c, b * d}},
        /* front, right, top, bottom, y up and z up */
        {{0, 1, 0}, {0, 0, -1}, 0, 0, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
        {{0, 1, 0}, {-5, 0, 0}, 0, 0, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {{0, 1, 0}, {0, -1, 0}, 0, 0, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
        {{0, 1, 0}, {0, 2, 0}, 0, 0, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
        {{0, 0, 1}, {0, 1, 0}, 0, 0, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
        {{0, 0, 1}, {-1, 0, 0}, 0, 0, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{0, 0, 1}, {0, 0, -1}, 0, 0, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
        {{0, 0, 1}, {0, 0, 1}, 0, 0, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
        /* the camera on the right, between, from above, over the top, from below */
        {{0, 1, 0}, {0, 0, -3}, 90, 0, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        {{0, 1, 0}, {0, 0, -3}, -45, 0, {-s, 0, s}, {s, 0, s}, {0, 1, 0}},
        {{0, 1, 0}, {0, 0, -3}, -45, 90, {0, 1, 0}, {s, 0, s}, {s, 0, -s}},
        {{0, 1, 0}, {0, 0, -3}, 0, 135, {0, s, -s}, {1, 0, 0}, {0, -s, -s}},
        {{0, 1, 0}, {0, 0, -3}, 0, -30, {0, -0.5, sqrt(0.75)}, {1, 0, 0}, {0, sqrt(0.75), 0.5}},
    };
    burnish_mesh *mesh = load_tessellated(":knot", 6);
    for (size_t i = 0; i < sizeof views / sizeof *views; ++i) {
        burnish_framing options = burnish_framing_default();
        double right[3], up[3], back[3];
        memcpy(options.up, views[i].up, sizeof options.up);
        if (!isnan(views[i].azimuth)) {
            memcpy(options.direction, views[i].direction, sizeof options.direction);
            options.azimuth = views[i].azimuth;
            options.elevation = views[i].elevation;
        }
        burnish_camera camera = fit(mesh, &options, 1);
        axes(&camera, right, up, back);
        check_axis(back, views[i].back, i, "back");
        check_axis(right, views[i].right, i, "right");
        check_axis(up, views[i].picture_up, i, "up");
        check_axis(camera.view_up, up, i, "view_up is exact");
    }
    burnish_framing any = burnish_framing_default();
    const double length = sqrt(14), unit[3] = {1 / length, 2 / length, -3 / length};
    double right[3], up[3], back[3];
    memcpy(any.up, (double[3]){1e90, 2e90, -3e90}, sizeof any.up);
    const burnish_camera camera = fit(mesh, &any, 1);
    axes(&camera, right, up, back);
    CHECK(fabs(dot(back, unit) - d) < 1e-9 && fabs(dot(right, unit)) < 1e-9, "any up: %g %g",
          dot(back, unit), dot(right, unit));
    burnish_mesh_destroy(mesh);
}

static void test_degenerate_shapes(void) {
    burnish_framing options = burnish_framing_default();
    const float flat[] = {-1, 0, 0, 1, 0, 0, 0, 0, 1};
    burnish_mesh *mesh = triangle(flat);
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
    mesh = triangle(needle);
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
        mesh = triangle(view);
        options = burnish_framing_default();
        options.orthographic = i % 2;
        fit(mesh, &options, 1);
        burnish_mesh_destroy(mesh);
    }
    const float far[] = {1e6f, 1e6f, 1e6f, 1e6f + 1, 1e6f, 1e6f, 1e6f, 1e6f + 2, 1e6f};
    mesh = triangle(far);
    options = burnish_framing_default();
    options.direction[2] = -1;
    fit(mesh, &options, 1);
    burnish_mesh_destroy(mesh);
}

static void test_arguments(void) {
    burnish_mesh *mesh = load_tessellated(":torus", 6);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_camera camera;
#define WRONG(change, word)                                                                        \
    do {                                                                                           \
        burnish_framing wrong = burnish_framing_default();                                         \
        wrong.change;                                                                              \
        CHECK(burnish_camera_frame(mesh, &wrong, &camera, &error) == BURNISH_STATUS_ARGUMENT &&    \
                  strstr(error.text, word),                                                        \
              "%s: %s", #change, error.text);                                                      \
    } while (0)
    WRONG(cookie = burnish_load_options_default().cookie, "burnish_framing_default()");
    WRONG(up[1] = -INFINITY, "up[1]");
    WRONG(up[2] = NAN, "up[2]");
    WRONG(direction[0] = INFINITY, "direction[0]");
    WRONG(direction[1] = -1e200, "direction[1]");
    WRONG(azimuth = NAN, "azimuth");
    WRONG(elevation = 1e7, "elevation");
    WRONG(view_angle = 0, "view_angle 0");
    WRONG(view_angle = 180, "view_angle 180");
    WRONG(view_angle = NAN, "view_angle");
    WRONG(view_angle = 1e-320, "view_angle");
    WRONG(aspect = 0, "aspect 0");
    WRONG(aspect = -1, "aspect -1");
    WRONG(aspect = INFINITY, "aspect");
    WRONG(margin = -0.01, "margin -0.01");
    WRONG(margin = 0.46, "margin 0.46");
    WRONG(margin = NAN, "margin");
    WRONG(inset[2] = -1, "inset");
    WRONG(orthographic_height = -1, "height");
    WRONG(inset[2] = wrong.inset[3] = wrong.margin = 0.3, "leave no room");
#undef WRONG
    burnish_framing options = burnish_framing_default();
    options.view_angle = 1e-3;
    fit(mesh, &options, 1);
    options = burnish_framing_default();
    CHECK1(options.view_angle == 30 && options.margin == 0.05 && options.aspect == 1);
    CHECK1(burnish_camera_frame(NULL, &options, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_camera_frame(mesh, NULL, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_camera_frame(mesh, &options, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    burnish_mesh_destroy(mesh);
}

/* A sphere of radius 1 with triangles of `size` at `distance`, which are strays or not. */
static void test_strays(void) {
    static const struct {
        float distance, size;
        int count, is_connected, strays;
    } cases[] = {{999, 0.01f, 1, 0, 1}, {-1e30f, 1e23f, 1, 0, 1}, {3e38f, 1e32f, 2, 0, 2},
                 {20, 0.01f, 2, 0, 2},  {1e5f, 0.01f, 1, 1, 1},   {4, 0.01f, 1, 0, 0},
                 {100, 10, 1, 0, 0},    {100, 0.01f, 1, 1, 0}};
    const burnish_load_options load = burnish_load_options_default();
    burnish_mesh *sphere = NULL;
    CHECK1(burnish_mesh_load(":sphere", &load, &sphere, NULL) == BURNISH_STATUS_OK);
    const burnish_mesh_view *view = burnish_mesh_get_view(sphere);
    const size_t vertices = view->vertex_count, triangles = view->triangle_count;
    float *positions = calloc(vertices + 6, 3 * sizeof *positions);
    uint32_t *indices = calloc(triangles + 4, 3 * sizeof *indices);
    burnish_render_options options = burnish_render_options_default();
    const burnish_framing framing = burnish_framing_default();
    options.width = options.height = 64;
    uint64_t expected = 0;
    for (size_t i = 0; i <= sizeof cases / sizeof *cases; ++i) { /* the first is the sphere alone */
        const int count = i > 0 ? cases[i - 1].count : 0;
        memcpy(positions, view->positions, 3 * vertices * sizeof *positions);
        memcpy(indices, view->indices, 3 * triangles * sizeof *indices);
        for (int t = 0; t < count; ++t) {
            for (int k = 0; k < 3; ++k) {
                float *p = positions + 3 * (vertices + (size_t)(3 * t + k));
                const float at = t ? -cases[i - 1].distance : cases[i - 1].distance;
                p[0] = at + (k == 1 ? cases[i - 1].size : 0);
                p[1] = at * 0.5f + (k == 2 ? cases[i - 1].size + at * 1e-6f : 0);
                p[2] = at * 0.25f;
                indices[3 * (triangles + (size_t)t) + (size_t)k] =
                    k > 0 && cases[i - 1].is_connected ? (uint32_t)k
                                                       : (uint32_t)vertices + (uint32_t)(3 * t + k);
            }
        }
        const burnish_mesh_description arrays =
            describe_arrays(positions, NULL, NULL, vertices + 3 * (size_t)count, indices,
                            triangles + (size_t)count);
        OWNED_MESH *mesh = create_mesh(&arrays, NULL);
        CHECK1(burnish_camera_frame(mesh, &framing, &options.camera, NULL) == BURNISH_STATUS_OK);
        const uint64_t hash = hash_drawn(mesh, &options);
        const int strays = i > 0 ? cases[i - 1].strays : 0;
        float low[3], high[3];
        burnish_mesh_get_bounds(mesh, low, high);
        expected = i == 0 ? hash : expected;
        CHECK((burnish_mesh_get_warning_count(mesh) > 0) == (strays > 0), "case %zu", i);
        CHECK(strays == 0 || cases[i - 1].is_connected || hash == expected, "case %zu", i);
        const int is_drawn = i > 0 && fabs((double)cases[i - 1].distance) <= 1000;
        CHECK(i == 0 || (high[0] > 3 || low[0] < -3) == is_drawn, "case %zu: bounds", i);
    }
    /* a square is the ground, unless it is not flat or not much larger; once the sphere ends it */
    static const float grounds[][4] = {
        {100, 0, 0, 1}, {100, 0, 1, 1}, {100, 1, 0, 0}, {4, 0, 0, 0}};
    for (size_t i = 0; i < sizeof grounds / sizeof *grounds; ++i) {
        const float s = grounds[i][0];
        const uint32_t first = (uint32_t)vertices;
        for (uint32_t k = 0; k < 4; ++k) {
            const float p[3] = {k % 2 ? s : -s, k ? -1 : grounds[i][1] - 1, k / 2 ? s : -s};
            const uint32_t corners[3] = {first + k, first + (k ^ 1),
                                         grounds[i][2] > 0 ? 7 : first + (k ^ 2)};
            memcpy(positions + 3 * (vertices + k), p, sizeof p);
            memcpy(indices + 3 * (triangles + k), corners, sizeof corners);
        }
        const burnish_mesh_description arrays =
            describe_arrays(positions, NULL, NULL, vertices + 4, indices, triangles + 4);
        OWNED_MESH *mesh = create_mesh(&arrays, NULL);
        CHECK(burnish_mesh_get_warning_count(mesh) == (size_t)grounds[i][3], "ground %zu", i);
    }
    free(positions);
    free(indices);
    burnish_mesh_destroy(sphere);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_exact_fit());
    RUN(test_insets());
    RUN(test_no_materials());
    RUN(test_views());
    RUN(test_degenerate_shapes());
    RUN(test_strays());
    RUN(test_arguments());
    return test_end("camera");
}
