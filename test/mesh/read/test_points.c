/* Point clouds, whose points are as large as density says, and lines, which are rods. */
#include <float.h>

#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "sheet.h"

static burnish_mesh *load(const char *name, const char *text, const burnish_load_options *options) {
    burnish_mesh *mesh = load_bytes(text, strlen(text), name, options);
    CHECK1(!mesh || burnish_mesh_get_warning_count(mesh) == 0);
    return mesh;
}

/* Points of a given size keep their positions and colours. */
static void test_sizes(void) {
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 0.5;
    OWNED_MESH *mesh = load("a.obj", "v 1 2 3 1 0 0\nv -4 5 6 0 1 0\n", &options);
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
    static const char apart[] = "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 1 1 1\nv 1 0 1\n"
                                "v 7000 0 0\nv 7000 0 1\nv 7000 1 0\nv 7001 0 0\nv 7001 1 0\n"
                                "v 7001 1 1\nv 7001 0 1\n"; /* would be specks */
    OWNED_MESH *clusters = load("b.obj", apart, NULL);
    const double radius = clusters ? (double)burnish_mesh_get_view(clusters)->point_radius : 0;
    CHECK(radius > 139 && radius < 141, "%g", radius);
}

enum { SIDE = 64 };

/* A square lattice of step 1/64 in z = 0, each point so many times, with normals or without. The
 * caller frees it. */
static char *make_lattice(int copies, int has_normals) {
    file_bytes text = {0};
    say(&text,
        "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
        "property float z\n%send_header\n",
        copies * SIDE * SIDE,
        has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "");
    for (int k = 0; k < copies * SIDE * SIDE; ++k) {
        const int i = k / copies;
        say(&text, "%g %g 0%s\n", (double)(i % SIDE) / 64, (double)(i / SIDE) / 64,
            has_normals > 1 ? " nan nan nan"
            : has_normals   ? " 0 3 -4"
                            : "");
    }
    add(&text, "", 1);
    return (char *)text.bytes;
}

/* The 6th nearest point of a lattice is sqrt(2) steps away: 1.2 times that is the radius. Normals
 * are the file's, the plane's or none. Threads and copies of the points change nothing. */
static void test_density(void) {
    static const float file[3] = {0, 0.6f, -0.8f};
    burnish_load_options options = burnish_load_options_default();
    for (int form = 0; form < 5; ++form) { /* the last: normals that are not numbers */
        const int has_normals = form < 4 ? form % 2 : 2, copies = form < 2 ? 1 : 9;
        char *text = make_lattice(copies, has_normals);
        burnish_mesh *meshes[3] = {NULL};
        for (int i = 0; i < 3; ++i) {
            options.threads = 1 + 3 * i;
            meshes[i] = load_bytes(text, strlen(text), "a.ply", &options);
            CHECK1(burnish_mesh_get_warning_count(meshes[i]) == (has_normals > 1));
            CHECK1(meshes[0] && same_meshes(meshes[0], meshes[i]));
        }
        const burnish_mesh_view *view = meshes[0] ? burnish_mesh_get_view(meshes[0]) : NULL;
        if (CHECK1(view && view->vertex_count == (size_t)copies * SIDE * SIDE)) {
            const double error = (double)view->point_radius * 64 / (1.2 * 1.41421356) - 1;
            CHECK(error > -1e-6 && error < 1e-6, "%g", error);
            size_t wrong = 0;
            for (size_t i = 0; i < view->vertex_count; ++i) {
                const float *n = view->normals + 3 * i;
                wrong += has_normals == 1 ? memcmp(n, file, sizeof file) != 0
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
    char *text = make_lattice(1, 0);
    OWNED_MESH *mesh = load("a.ply", text, &options);
    CHECK1(mesh && burnish_mesh_get_view(mesh)->normals[2] == 0);
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
    OWNED_MESH *mesh = load_bytes(text, size, "a.obj", &options);
    float low[3], high[3];
    if (CHECK1(mesh && burnish_mesh_get_warning_count(mesh) == 1)) {
        CHECK_TEXT(burnish_mesh_get_warning(mesh, 0),
                   "a.obj: 1 of 41 points are far from the others, so the picture is framed "
                   "without them; remove them, or set the camera");
        burnish_mesh_get_bounds(mesh, low, high);
        CHECK1(high[0] == 500 && burnish_mesh_get_view(mesh)->bounds_max[0] == 10);
    }
}

/* Strays that hardly enlarge the box: not framed while they are one in a hundred at most. */
static void test_strays(void) {
    const burnish_load_options options = burnish_load_options_default();
    for (int count = 0; count <= 12; ++count) {
        static char text[20000];
        size_t size = 0;
        for (int i = 0; i < 900; ++i) {
            size += (size_t)snprintf(text + size, sizeof text - size, "v %d %d %d\n", i % 30,
                                     i / 30, (i * 7) % 5);
        }
        for (int i = 0; i < count; ++i) {
            size += (size_t)snprintf(text + size, sizeof text - size, "v %d %d 0\n",
                                     15 + 9 * (i % 3), 60 + 12 * (i / 3));
        }
        OWNED_MESH *mesh = load_bytes(text, size, "a.obj", &options);
        const int are_few = count > 0 && count <= 9;
        CHECK(mesh && burnish_mesh_get_warning_count(mesh) == (size_t)are_few, "%d strays", count);
        const float high = mesh ? burnish_mesh_get_view(mesh)->bounds_max[1] : 0;
        CHECK((high < 35) == (count == 0 || are_few), "%d strays, up to %g", count, (double)high);
    }
}

/* Rods between vertices, by numbers from either end. */
static void test_lines(void) {
    burnish_load_options options = burnish_load_options_default();
    options.point_size = 0.25;
    OWNED_MESH *mesh = load("a.obj", "v 0 0 0\nv 2 0 0\nl 1 2\nv 2 3 0\nl -2/1 -1\n", &options);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    if (CHECK1(view && view->triangle_count == 2 * 64 && view->vertex_count >= 20)) {
        CHECK1(burnish_mesh_get_info(mesh)->line_count == 2 &&
               burnish_mesh_get_info(mesh)->point_count == 0);
        float low[3], high[3];
        burnish_mesh_get_bounds(mesh, low, high); /* of the ends, without their caps */
        CHECK1(high[1] == 3 && low[0] == 0 && view->bounds_max[1] == 3.125f);
        for (size_t i = 0; i < view->vertex_count; ++i) {
            const float *p = view->positions + 3 * i, *n = view->normals + 3 * i;
            const double x = p[0] - 0.125 * (double)n[0], y = p[1] - 0.125 * (double)n[1];
            const double z = p[2] - 0.125 * (double)n[2];
            const double off = x < 1 ? x * x : (x - 2) * (x - 2);
            const double up = x < 1 || y < 1.5 ? y * y : (y - 3) * (y - 3);
            CHECK(off + up + z * z < 1e-12, "%zu", i); /* a sphere's point around an end */
        }
    }
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
        OWNED_MESH *mesh = load(cases[i].name, cases[i].text, &options);
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
    }
    OWNED_MESH *mesh = load("a.obj", "v 0 0 0\nv 4 1 1\n", &options);
    const burnish_clip_plane plane = {{1, 0, 0}, 2};
    float low[3], high[3];
    CHECK1(burnish_mesh_clip(mesh, &plane, NULL) == BURNISH_STATUS_OK);
    burnish_mesh_get_bounds(mesh, low, high);
    CHECK(low[0] == 0 && high[0] == 0, "cut: %g to %g", (double)low[0], (double)high[0]);
    burnish_mesh_get_bounds(NULL, low, high);
    CHECK1(low[0] == 0 && high[2] == 0);
}

static void test_limits(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    options.max_triangles = 2;
    check_refused(text, strlen(text), "a.obj", &options, BURNISH_STATUS_LIMIT,
                  "a.obj: 3 points are too many: each counts as a triangle; raise "
                  "--max-triangles, or thin them out");
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
    RUN(test_strays());
    RUN(test_lines());
    RUN(test_limits());
    return test_end("points");
}
