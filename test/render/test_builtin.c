/* The built-in objects: closed surfaces, the right size, unit normals that point outward. */
#include <math.h>

#include "mesh_arrays.h"
#include "vec.h"

#define PI 3.14159265358979323846

/* V - E + F */
static long euler(const burnish_mesh_facts *facts) {
    return (long)facts->vertex_count - (long)facts->edge_count + (long)facts->triangle_count;
}

/* Closed, in one piece, with a vertex for each position. */
static void check_closed(const burnish_mesh *mesh, const char *name, long expected) {
    const burnish_mesh_facts *facts = burnish_mesh_get_facts(mesh);
    CHECK(facts->is_solid && facts->shell_count == 1 && euler(facts) == expected &&
              facts->non_manifold_edge_count == 0,
          "%s: %zu open edges, Euler %ld", name, facts->open_edge_count, euler(facts));
    CHECK1(burnish_mesh_get_view(mesh)->vertex_count == facts->vertex_count &&
           burnish_mesh_get_warning_count(mesh) == 0);
}

/* Every normal has unit length and agrees with its triangles within the given cosine. */
static void check_normals(const burnish_mesh_view *mesh, const char *name, double least_cosine) {
    double worst_length = 0, worst_cosine = 1;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        double p[3][3], n[3][3], u[3], v[3], face[3];
        for (size_t k = 0; k < 9; ++k) {
            const size_t at = 3 * (size_t)mesh->indices[3 * i + k / 3] + k % 3;
            p[k / 3][k % 3] = (double)mesh->positions[at];
            n[k / 3][k % 3] = (double)mesh->normals[at];
        }
        for (int k = 0; k < 3; ++k) {
            u[k] = p[1][k] - p[0][k];
            v[k] = p[2][k] - p[0][k];
        }
        cross(u, v, face);
        normalize(face);
        for (int k = 0; k < 3; ++k) {
            worst_length = fmax(worst_length, fabs(sqrt(dot(n[k], n[k])) - 1));
            worst_cosine = fmin(worst_cosine, dot(face, n[k]));
        }
    }
    CHECK(worst_length < 1.2e-7, "%s: length off by %g", name, worst_length);
    CHECK(worst_cosine > least_cosine, "%s: cosine %g", name, worst_cosine);
}

static void test_sphere(void) {
    for (int k = 0; k < 2; ++k) {
        int n = 8 << k;
        burnish_mesh *mesh = load_measured(":sphere", n);
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        check_closed(mesh, "sphere", 2);
        CHECK(view->triangle_count == 48u * n * n, "%zu", view->triangle_count);
        size_t equator = 0;
        for (size_t i = 0; i < view->vertex_count; ++i) {
            const float *p = view->positions + 3 * i;
            double r2 = (double)p[0] * (double)p[0] + (double)p[1] * (double)p[1] +
                        (double)p[2] * (double)p[2];
            CHECK(fabs(sqrt(r2) - 1) < 1.2e-7, "radius %.9g", sqrt(r2));
            for (int axis = 0; axis < 3; ++axis) {
                double off = (double)p[axis] - (double)view->normals[3 * i + axis];
                CHECK(fabs(off) <= 6e-8, "normal is not the position: %g", off);
            }
            equator += p[1] == 0;
        }
        CHECK(equator == 8u * n, "%zu vertices around", equator);
        check_normals(view, "sphere", 0.99);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK1(view->bounds_min[axis] == -1 && view->bounds_max[axis] == 1);
        }
        burnish_mesh_destroy(mesh);
    }
}

static void test_torus(void) {
    for (int k = 0; k < 2; ++k) {
        int n = 8 << k;
        burnish_mesh *mesh = load_measured(":torus", n);
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        check_closed(mesh, "torus", 0);
        CHECK1(view->vertex_count == 32u * n * n);
        for (size_t i = 0; i < view->vertex_count; ++i) {
            const float *p = view->positions + 3 * i, *normal = view->normals + 3 * i;
            double ring = hypot((double)p[0], (double)p[2]), y = (double)p[1];
            CHECK(fabs(hypot(ring - 1, y) - 0.4) < 2e-7, "off the torus");
            CHECK(fabs((double)normal[1] - y / 0.4) < 1e-6, "normal");
            CHECK1(fabs((double)normal[0] - (double)p[0] / ring * (ring - 1) / 0.4) < 1e-6);
        }
        check_normals(view, "torus", 0.98);
        burnish_mesh_destroy(mesh);
    }
}

/* The data set has six open borders: the rim's inner edge, the lid's lower edge (both circles of
 * four patches), both ends of the handle, and both of the spout (two patches each). The handle's
 * lower end has one point in common with the body. With fewer than three segments a few
 * triangles of the spout's lip contradict the surface's normals, and are turned. */
static void test_teapot(void) {
    for (int n = 3; n <= 16; n += n < 5 ? 1 : 5) {
        burnish_mesh *mesh = load_measured(":teapot", n);
        const burnish_mesh_facts *facts = burnish_mesh_get_facts(mesh);
        size_t triangles = 32u * 2 * n * n - 8u * n;
        CHECK(facts->triangle_count == triangles, "%d: %zu", n, facts->triangle_count);
        CHECK(facts->is_consistent && facts->shell_count == 4, "%d: %zu shells", n,
              facts->shell_count);
        CHECK(facts->open_edge_count == 16u * n, "%d: %zu open edges", n, facts->open_edge_count);
        /* Body, rim and bottom: a disc (1); lid: a disc (1); handle and spout: tubes (0). The
         * common point counts once. */
        CHECK(euler(facts) == 1 + 1 + 0 + 0 - 1, "%d: Euler %ld", n, euler(facts));
        CHECK(burnish_mesh_get_warning_count(mesh) == 0, "%s", burnish_mesh_get_warning(mesh, 0));
        burnish_mesh_destroy(mesh);
    }
    burnish_mesh *mesh = load_tessellated(":teapot", 16);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    check_normals(view, "teapot", 0.5);
    CHECK(view->bounds_min[1] == 0 && view->bounds_max[1] == 3.15f, "%g .. %g",
          (double)view->bounds_min[1], (double)view->bounds_max[1]);
    CHECK(view->bounds_min[2] == -view->bounds_max[2], "mirrored");
    CHECK(view->bounds_min[0] == -3 && view->bounds_max[0] > 3.4f, "spout along +x");
    /* The poles: the lid's top looks up, the middle of the bottom down. */
    size_t poles = 0;
    for (size_t i = 0; i < view->vertex_count; ++i) {
        const float *p = view->positions + 3 * i, *normal = view->normals + 3 * i;
        if (p[0] == 0 && p[2] == 0) {
            float up = p[1] > 1 ? 1.0f : -1.0f;
            CHECK(normal[0] == 0 && normal[1] == up && normal[2] == 0, "%g %g %g",
                  (double)normal[0], (double)normal[1], (double)normal[2]);
            ++poles;
        }
    }
    CHECK(poles == 2, "%zu vertices at the poles", poles);
    burnish_mesh_destroy(mesh);
}

static void test_arguments(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *view = NULL;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    CHECK1(burnish_mesh_load(":kettle", &options, &view, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text,
               ":kettle: unknown built-in object; there are :teapot, :sphere, :torus, :knot");
    const char *names[] = {":teapot", ":sphere", ":torus", ":knot"};
    for (int i = 0; i < 4; ++i) {
        options = burnish_load_options_default();
        options.max_triangles = 100;
        CHECK1(burnish_mesh_load(names[i], &options, &view, &error) == BURNISH_STATUS_LIMIT);
        CHECK(strstr(error.text, names[i]) && strstr(error.text, "100"), "%s", error.text);
        CHECK1(view == NULL);
        burnish_mesh *mesh = load_tessellated(names[i], 1);
        check_normals(burnish_mesh_get_view(mesh), names[i], -1);
        burnish_mesh_destroy(mesh);
    }
    int wrong[] = {0, -1, 257};
    for (int i = 0; i < 3; ++i) {
        options = burnish_load_options_default();
        options.tessellation = wrong[i];
        CHECK1(burnish_mesh_load(":sphere", &options, &view, &error) == BURNISH_STATUS_ARGUMENT);
        CHECK(strstr(error.text, "tessellation"), "%s", error.text);
    }
    options = burnish_load_options_default();
    options.cookie = 1;
    CHECK1(burnish_mesh_load(":sphere", &options, &view, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK(strstr(error.text, "burnish_load_options_default()"), "%s", error.text);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_sphere());
    RUN(test_torus());
    RUN(test_teapot());
    RUN(test_arguments());
    return test_end("builtin");
}
