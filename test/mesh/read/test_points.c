/* Point clouds and lines: each is a small solid of the mesh, as large as density says. */
#include <float.h>

#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "reader_input.h"

static burnish_mesh *load(const char *name, const char *text, const burnish_load_options *options) {
    burnish_mesh *mesh = load_bytes(text, strlen(text), name, options);
    CHECK1(!mesh || burnish_mesh_get_warning_count(mesh) == 0);
    return mesh;
}

/* What closed surfaces enclose, wherever they are: positive where they are wound outward. */
static double volume_of(const burnish_mesh_view *view) {
    double volume = 0;
    for (size_t i = 0; i < view->triangle_count; ++i) {
        double p[3][3];
        for (size_t k = 0; k < 9; ++k) {
            p[k / 3][k % 3] =
                (double)view->positions[3 * (size_t)view->indices[3 * i + k / 3] + k % 3];
        }
        volume += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                  p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                  p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return volume / 6;
}

/* Balls of a given size: where they should be, wound outward, with their points' colours and the
 * volume of an icosahedron, 2.536 r^3. */
static void test_balls(void) {
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 0.5;
    burnish_mesh *mesh = load("a.obj", "v 1 2 3 1 0 0\nv -4 5 6 0 1 0\n", &options);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    if (CHECK1(view && view->triangle_count == 40 && view->vertex_count == 24)) {
        CHECK1(burnish_mesh_get_info(mesh)->point_count == 2 &&
               burnish_mesh_get_info(mesh)->line_count == 0);
        for (size_t i = 0; i < view->vertex_count; ++i) {
            const float *p = view->positions + 3 * i, *n = view->normals + 3 * i;
            const int red = view->colors[4 * i] == 255;
            const double center[3] = {red ? 1 : -4, red ? 2 : 5, red ? 3 : 6};
            for (int k = 0; k < 3; ++k) {
                const double error = (double)p[k] - center[k] - 0.25 * (double)n[k];
                CHECK(error < 1e-6 && error > -1e-6, "%zu: %g", i, error);
            }
            CHECK1(view->colors[4 * i] + view->colors[4 * i + 1] == 255);
        }
        const double volume = volume_of(view) / (2 * 2.5361507 * 0.015625);
        CHECK(volume > 0.9999 && volume < 1.0001, "%g", volume);
    }
    burnish_mesh_destroy(mesh);
}

/* A square lattice of step 1/64: balls of twice the step. With the file's normals they are shaded
 * by those. Threads change nothing. */
static void test_density(void) {
    enum { SIDE = 64, ROOM = SIDE * SIDE * 40 + 400 };
    char *text = malloc(ROOM);
    if (!text) {
        abort();
    }
    size_t size = (size_t)snprintf(text, ROOM,
                                   "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\n"
                                   "property float y\nproperty float z\nproperty float nx\n"
                                   "property float ny\nproperty float nz\nend_header\n",
                                   SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        size += (size_t)snprintf(text + size, ROOM - size, "%g %g 0 0 0 1\n",
                                 (double)(i % SIDE) / 64, (double)(i / SIDE) / 64);
    }
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *meshes[3] = {NULL};
    for (int i = 0; i < 3; ++i) {
        options.threads = 1 + 3 * i;
        meshes[i] = load("a.ply", text, &options);
        CHECK1(meshes[0] && same_meshes(meshes[0], meshes[i]));
    }
    const burnish_mesh_view *view = meshes[0] ? burnish_mesh_get_view(meshes[0]) : NULL;
    if (CHECK1(view && view->triangle_count == 20 * SIDE * SIDE)) {
        /* an icosahedron reaches 0.85065 r along each axis */
        CHECK(view->bounds_max[2] > 0.85064f / 64 && view->bounds_max[2] < 0.85066f / 64, "%g",
              (double)view->bounds_max[2] * 64);
        size_t wrong = 0;
        for (size_t i = 0; i < view->vertex_count; ++i) {
            wrong += view->normals[3 * i + 2] != 1;
        }
        CHECK(wrong == 0, "%zu", wrong);
    }
    for (int i = 0; i < 3; ++i) {
        burnish_mesh_destroy(meshes[i]);
    }
    free(text);
}

/* Rods between vertices, by numbers from either end. */
static void test_lines(void) {
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 0.25;
    burnish_mesh *mesh = load("a.obj", "v 0 0 0\nv 2 0 0\nl 1 2\nv 2 3 0\nl -2/1 -1\n", &options);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    if (CHECK1(view && view->triangle_count == 24 && view->vertex_count >= 20)) {
        CHECK1(burnish_mesh_get_info(mesh)->line_count == 2 &&
               burnish_mesh_get_info(mesh)->point_count == 0);
        CHECK1(view->bounds_max[1] == 3 && view->bounds_min[0] == 0);
        for (size_t i = 0; i < view->vertex_count; ++i) {
            const float *p = view->positions + 3 * i, *n = view->normals + 3 * i;
            const double x = p[0] - 0.125 * (double)n[0], y = p[1] - 0.125 * (double)n[1];
            const double z = p[2] - 0.125 * (double)n[2];
            CHECK(y * y + z * z < 1e-12 || (x - 2) * (x - 2) + z * z < 1e-12, "%zu", i);
        }
    }
    burnish_mesh_destroy(mesh);
}

/* Bounds contain the positions, for any size of the solids. The solids have no facts. */
static void test_bounds(void) {
    static const struct {
        const char *name, *text;
        double low[3], high[3]; /* of the file */
    } cases[] = {
        {"a.obj", "v 1 2 3\nv -4 5 6\nv 0 3 4\n", {-4, 2, 3}, {1, 5, 6}},
        {"a.obj", "v 0 0 0\nv 2 0 0\nv 9 9 9\nv 2 3 0\nl 1 2\nl 2 4\n", {0, 0, 0}, {2, 3, 0}},
        {"a.obj", "v 5000001 2 3\nv 5000004 5 6\n", {5000001, 2, 3}, {5000004, 5, 6}},
        {"a.off", "OFF\n2 0 0\n0 0 0\n1 2 3\n", {0, 0, 0}, {1, 2, 3}}};
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 0.5;
    options.measure = 1;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh *mesh = load(cases[i].name, cases[i].text, &options);
        float low[3], high[3];
        burnish_mesh_get_bounds(mesh, low, high);
        for (int k = 0; k < 3 && mesh; ++k) {
            const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
            CHECK((double)low[k] + view->origin[k] == cases[i].low[k] &&
                      (double)high[k] + view->origin[k] == cases[i].high[k],
                  "%zu: axis %d from %g to %g", i, k, (double)low[k], (double)high[k]);
            CHECK1(view->bounds_min[k] <= low[k] && view->bounds_max[k] >= high[k]);
        }
        CHECK1(!burnish_mesh_get_facts(mesh));
        burnish_mesh_destroy(mesh);
    }
    burnish_mesh *mesh = load("a.obj", "v 0 0 0\nv 4 1 1\n", &options);
    const burnish_clip_plane plane = {{1, 0, 0}, 2};
    float low[3], high[3];
    CHECK1(burnish_mesh_clip(mesh, &plane, NULL) == BURNISH_STATUS_OK);
    burnish_mesh_get_bounds(mesh, low, high);
    CHECK(low[0] == 0 && high[0] > 0.2f && high[0] <= 0.25f, "cut: %g to %g", (double)low[0],
          (double)high[0]);
    burnish_mesh_destroy(mesh);
    burnish_mesh_get_bounds(NULL, low, high);
    CHECK1(low[0] == 0 && high[2] == 0);
}

static void test_limits(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    options.max_triangles = 24; /* three octahedra, no icosahedra */
    mesh = load("a.obj", text, &options);
    CHECK1(mesh && burnish_mesh_get_view(mesh)->triangle_count == 24);
    burnish_mesh_destroy(mesh);
    options.max_triangles = 23;
    CHECK1(burnish_mesh_load_memory(text, strlen(text), "a.obj", &options, &mesh, &error) ==
           BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text, "a.obj: 3 points are too many: each is drawn as 8 triangles; thin them "
                           "out");
    options = burnish_load_options_default();
    options.point_size = -1;
    CHECK1(burnish_mesh_load_memory(text, strlen(text), "a.obj", &options, &mesh, &error) ==
           BURNISH_STATUS_ARGUMENT);
    options.point_size = 0; /* points in one place */
    mesh = load("a.obj", "v 3 3 3\nv 3 3 3\n", &options);
    CHECK1(mesh != NULL);
    burnish_mesh_destroy(mesh);
    static const char ends[] = "v 0 0 0\nv 3.4028235e38 -3.4028235e38 0\n"; /* the range's */
    mesh = load_bytes(ends, strlen(ends), "a.obj", &options);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    CHECK1(view && view->bounds_max[0] == FLT_MAX && view->bounds_min[1] == -FLT_MAX);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_bounds());
    RUN(test_balls());
    RUN(test_density());
    RUN(test_lines());
    RUN(test_limits());
    return test_end("points");
}
