/* Point clouds, whose points are as large as density says, and lines, which are prisms. */
#include <float.h>

#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "reader_input.h"

static burnish_mesh *load(const char *name, const char *text, const burnish_load_options *options) {
    burnish_mesh *mesh = load_bytes(text, strlen(text), name, options);
    CHECK1(!mesh || burnish_mesh_get_warning_count(mesh) == 0);
    return mesh;
}

/* Points of a given size keep their positions and colours. */
static void test_sizes(void) {
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 0.5;
    burnish_mesh *mesh = load("a.obj", "v 1 2 3 1 0 0\nv -4 5 6 0 1 0\n", &options);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    if (CHECK1(view && view->triangle_count == 0 && view->vertex_count == 2 && !view->indices)) {
        static const float positions[6] = {1, 2, 3, -4, 5, 6};
        static const uint8_t colors[8] = {255, 0, 0, 255, 0, 255, 0, 255};
        CHECK1(burnish_mesh_get_info(mesh)->point_count == 2 &&
               burnish_mesh_get_info(mesh)->line_count == 0 && view->point_radius == 0.25f);
        CHECK1(memcmp(view->positions, positions, sizeof positions) == 0 &&
               memcmp(view->colors, colors, sizeof colors) == 0);
        CHECK1(view->bounds_min[0] == -4.25f && view->bounds_max[2] == 6.25f);
    }
    burnish_mesh_destroy(mesh);
}

enum { SIDE = 64 };

/* A square lattice of step 1/64 in z = 0, with normals or without. The caller frees it. */
static char *make_lattice(int has_normals) {
    enum { ROOM = SIDE * SIDE * 40 + 400 };
    char *text = malloc(ROOM);
    if (!text) {
        abort();
    }
    size_t size = (size_t)snprintf(text, ROOM,
                                   "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\n"
                                   "property float y\nproperty float z\n%send_header\n",
                                   SIDE * SIDE,
                                   has_normals ? "property float nx\nproperty float ny\n"
                                                 "property float nz\n"
                                               : "");
    for (int i = 0; i < SIDE * SIDE; ++i) {
        size += (size_t)snprintf(text + size, ROOM - size, "%g %g 0%s\n", (double)(i % SIDE) / 64,
                                 (double)(i / SIDE) / 64, has_normals ? " 0 3 -4" : "");
    }
    return text;
}

/* The 6th nearest point of a lattice is sqrt(2) steps away: 1.2 times that is the radius. Normals
 * are the file's, the plane's or none. Threads change nothing. */
static void test_density(void) {
    static const float file[3] = {0, 0.6f, -0.8f};
    burnish_load_options options = burnish_load_options_default();
    for (int has_normals = 0; has_normals < 2; ++has_normals) {
        char *text = make_lattice(has_normals);
        burnish_mesh *meshes[3] = {NULL};
        for (int i = 0; i < 3; ++i) {
            options.threads = 1 + 3 * i;
            meshes[i] = load("a.ply", text, &options);
            CHECK1(meshes[0] && same_meshes(meshes[0], meshes[i]));
        }
        const burnish_mesh_view *view = meshes[0] ? burnish_mesh_get_view(meshes[0]) : NULL;
        if (CHECK1(view && view->vertex_count == SIDE * SIDE)) {
            const double error = (double)view->point_radius * 64 / (1.2 * 1.41421356) - 1;
            CHECK(error > -1e-6 && error < 1e-6, "%g", error);
            size_t wrong = 0;
            for (size_t i = 0; i < view->vertex_count; ++i) {
                const float *n = view->normals + 3 * i;
                wrong += has_normals ? memcmp(n, file, sizeof file) != 0
                                     : n[2] * n[2] < 0.999999f || n[0] * n[0] > 1e-6f;
            }
            CHECK(wrong == 0, "%zu", wrong);
        }
        for (int i = 0; i < 3; ++i) {
            burnish_mesh_destroy(meshes[i]);
        }
        free(text);
    }
    options.normals = BURNISH_NORMALS_FILE;
    char *text = make_lattice(0);
    burnish_mesh *mesh = load("a.ply", text, &options);
    CHECK1(mesh && burnish_mesh_get_view(mesh)->normals[2] == 0);
    burnish_mesh_destroy(mesh);
    free(text);
}

/* One point of 41 is far away: the view's bounds leave it out, the box of the content does not. */
static void test_outliers(void) {
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 2;
    char text[2000];
    size_t size = (size_t)snprintf(text, sizeof text, "v 500 0 0\n");
    for (int i = 0; i < 40; ++i) {
        size += (size_t)snprintf(text + size, sizeof text - size, "v %d %d %d\n", i % 10, i / 10,
                                 i % 3);
    }
    burnish_mesh *mesh = load_bytes(text, size, "a.obj", &options);
    float low[3], high[3];
    if (CHECK1(mesh && burnish_mesh_get_warning_count(mesh) == 1)) {
        CHECK_TEXT(burnish_mesh_get_warning(mesh, 0),
                   "a.obj: 1 of 41 points are far from the others, so the picture is framed "
                   "without them; remove them, or set the camera");
        burnish_mesh_get_bounds(mesh, low, high);
        CHECK1(high[0] == 500 && burnish_mesh_get_view(mesh)->bounds_max[0] == 10);
    }
    burnish_mesh_destroy(mesh);
}

/* 20,000 facets that may take half of the memory that they need: every second one becomes a point at
 * its middle. Its base of 80 MiB can not be less. */
static void test_preview(void) {
    enum { COUNT = 20000, SIZE = 84 + 50 * COUNT };
    static uint8_t bytes[SIZE];
    const uint32_t count = COUNT;
    burnish_load_options options = burnish_load_options_default();
    burnish_error error;
    memcpy(bytes + 80, &count, sizeof count);
    for (size_t i = 0; i < COUNT; ++i) {
        const float x = (float)(i % 100), y = (float)(i / 100);
        const float corners[9] = {x, y, 0, x + 3, y, 0, x, y + 3, 0};
        memcpy(bytes + 84 + 50 * i + 12, corners, sizeof corners);
    }
    options.max_memory = (80 << 20) + SIZE + COUNT / 2 * 112;
    burnish_mesh *mesh = load_bytes(bytes, SIZE, "a.stl", &options);
    if (CHECK1(mesh && burnish_mesh_get_info(mesh)->thinning == 2 &&
               burnish_mesh_get_info(mesh)->point_count == COUNT / 2)) {
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        CHECK1(view->positions[3] == 3 && view->positions[4] == 1 && view->normals[5] == 1);
        CHECK_TEXT(burnish_mesh_get_warning(mesh, 0),
                   "a.stl: a preview: 1 in 2 of 20000 triangles is drawn, as a point, since all "
                   "need more memory than max-memory");
    }
    burnish_mesh_destroy(mesh);
    options.max_memory = 50000000;
    CHECK1(burnish_mesh_load_memory(bytes, SIZE, "a.stl", &options, &mesh, &error) ==
           BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text,
               "a.stl: max-memory: 50 MB are too few for a preview; give at least 87 MB");
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

/* Bounds contain the positions, for any size of the solids. Points and lines have no facts. */
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
    CHECK(low[0] == 0 && high[0] == 0, "cut: %g to %g", (double)low[0], (double)high[0]);
    burnish_mesh_destroy(mesh);
    burnish_mesh_get_bounds(NULL, low, high);
    CHECK1(low[0] == 0 && high[2] == 0);
}

static void test_limits(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    options.max_triangles = 2;
    CHECK1(burnish_mesh_load_memory(text, strlen(text), "a.obj", &options, &mesh, &error) ==
           BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text, "a.obj: 3 points are too many: each counts as a triangle; raise "
                           "max-triangles, or thin them out");
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
    RUN(test_sizes());
    RUN(test_density());
    RUN(test_outliers());
    RUN(test_preview());
    RUN(test_lines());
    RUN(test_limits());
    return test_end("points");
}
