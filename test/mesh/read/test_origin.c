/* Coordinates far from the origin: the mesh has the file's coordinates minus an origin, without
 * rounding. */
#include <math.h>

#include "burnish/mesh.h"
#include "mesh/read/common/local_origin.h"
#include "mesh_arrays.h"
#include "sheet.h"

/* ---- A torus in each format ---- */

enum { SIDE = 36, POINTS = SIDE * SIDE, FORMATS = 8 };

#define UNIT 0x1p-16 /* of coordinates */

/* A node's translation has double precision; a camera is 5 above the torus. */
static void put_gltf(file_bytes *to, const double shift[3], double scale) {
    const sheet torus = {.shape = SHEET_TORUS, .side = SIDE, .scale = scale};
    file_bytes json = {0}, positions = {0}, indices = {0};
    for (unsigned i = 0; i < POINTS; ++i) {
        unsigned faces[2][4];
        sheet_faces(&torus, i, faces);
        for (int k = 0; k < 3; ++k) {
            add_float(&positions, sheet_coordinate(&torus, i, k), 0, 0);
        }
        for (int k = 0; k < 6; ++k) {
            add_bits(&indices, faces[k / 3][k % 3], 2, 0);
        }
    }
    say(&json,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0,\"translation\":[%.17g,%.17g,%.17g]},"
        "{\"camera\":0,\"translation\":[%.17g,%.17g,%.17g]}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,"
        "\"znear\":0.1}}],",
        shift[0], shift[1], shift[2], shift[0], shift[1], shift[2] + 5);
    say(&json,
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":%d},{\"bufferView\":1,\"componentType\":5123,\"type\":\"SCALAR\","
        "\"count\":%d}],",
        POINTS, 6 * POINTS);
    say(&json,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,"
        "\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu}]}",
        positions.size, positions.size, indices.size, positions.size + indices.size);
    add(&positions, indices.bytes, indices.size);
    add_glb(to, &json, &positions);
    free(json.bytes);
    free(positions.bytes);
    free(indices.bytes);
}

/* names[format] of the input. */
static const char *const names[FORMATS] = {"a.obj", "a.ply", "little.ply", "big.ply",
                                           "a.off", "a.stl", "a.glb",      "points.ply"};
enum { GLTF = 6, POINT_CLOUD = 7 };

static void put_cloud(file_bytes *to, const sheet *s) {
    say(to,
        "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
        "property double z\nend_header\n",
        POINTS);
    for (unsigned i = 0; i < POINTS; ++i) {
        say_position(to, s, i);
        say(to, "\n");
    }
}

static file_bytes make(int format, const double shift[3], double scale) {
    static void (*const texts[])(file_bytes *, const sheet *) = {
        write_obj, write_ply, NULL, NULL, write_off, write_stl, NULL, put_cloud};
    const sheet torus = {.shape = SHEET_TORUS,
                         .shift = shift,
                         .scale = scale,
                         .side = SIDE,
                         .quads = format != 5, /* STL has none */
                         .newline = "\n",
                         .end = format == 5 ? "endsolid\n" : ""};
    file_bytes to = {0};
    if (format == GLTF) {
        put_gltf(&to, shift, scale);
    } else if (texts[format]) {
        texts[format](&to, &torus);
    } else {
        write_binary_ply(&to, &torus, &(ply_layout){"uchar", "int", 1, 4, format == 3, 1});
    }
    return to;
}

static burnish_mesh *load(int format, const double shift[3], double scale, int threads,
                          const double *origin) {
    burnish_load_options options = burnish_load_options_default();
    file_bytes bytes = make(format, shift, scale);
    options.threads = threads;
    options.measure = 1;
    options.origin = origin;
    options.ignore_referenced_files = 1;
    burnish_mesh *mesh = load_bytes(bytes.bytes, bytes.size, names[format], &options);
    free(bytes.bytes);
    return mesh;
}

static const double zero[3] = {0, 0, 0};

/* ---- Tests ---- */

static int same_facts(const burnish_mesh *a, const burnish_mesh *b) {
    const burnish_mesh_facts *f = burnish_mesh_get_facts(a), *g = burnish_mesh_get_facts(b);
    float bounds[2][6];
    burnish_mesh_get_bounds(a, bounds[0], bounds[0] + 3);
    burnish_mesh_get_bounds(b, bounds[1], bounds[1] + 3);
    if (memcmp(bounds[0], bounds[1], sizeof *bounds) != 0 || !f || !g) {
        return !f && !g && memcmp(bounds[0], bounds[1], sizeof *bounds) == 0; /* of points */
    }
    return f->vertex_count == g->vertex_count && f->edge_count == g->edge_count &&
           f->degenerate_count == g->degenerate_count && f->area == g->area &&
           f->volume == g->volume &&
           memcmp(f->center_of_mass, g->center_of_mass, sizeof f->center_of_mass) == 0;
}

/* If the shift is a multiple of the origin's grid, here 1/8, the mesh has the same bits as the mesh
 * at the origin, and the origin is the shift: in every format, for any number of threads. */
static void test_same_bits(void) {
    static const double shift[3] = {500000.125, 4100000.25, 300.5};
    static const int threads[3] = {1, 2, 7};
    for (int format = 0; format < FORMATS; ++format) {
        OWNED_MESH *there = load(format, zero, 1, 1, NULL);
        for (int i = 0; i < 3; ++i) {
            OWNED_MESH *moved = load(format, shift, 1, threads[i], NULL);
            if (CHECK1(there && moved)) {
                const burnish_mesh_view *a = burnish_mesh_get_view(there);
                const burnish_mesh_view *b = burnish_mesh_get_view(moved);
                CHECK(memcmp(a->origin, zero, sizeof zero) == 0, "%s", names[format]);
                CHECK(memcmp(b->origin, shift, sizeof shift) == 0, "%s: %.17g %.17g %.17g",
                      names[format], b->origin[0], b->origin[1], b->origin[2]);
                CHECK(same_meshes(there, moved), "%s, %d threads", names[format], threads[i]);
                CHECK(same_facts(there, moved), "%s", names[format]);
                CHECK1(burnish_mesh_get_info(moved)->point_count ==
                       (format == POINT_CLOUD ? POINTS : 0));
                CHECK1(burnish_mesh_get_warning_count(moved) == 0);
            }
            if (format == GLTF && CHECK1(moved && burnish_mesh_get_camera_count(moved) == 1)) {
                const burnish_camera *camera = &burnish_mesh_get_camera(moved, 0)->camera;
                CHECK1(camera->position[0] == 0 && camera->position[1] == 0 &&
                       camera->position[2] == 5);
            }
        }
    }
}

/* Anywhere: positions with the origin are the file's to half a unit in the last digit of a float as
 * large as the object; also of one that is smaller than the floats' steps at its distance. */
static void test_accuracy(void) {
    static const double shift[3] = {-498765.4321, 4100234.567, -87.654321};
    static const double scales[4] = {1, 1e-4, 1000, 12345};
    for (int format = 0; format < FORMATS - 1; ++format) { /* but points, which are balls */
        for (int i = 0; i < 4; ++i) {
            const double scale = scales[i];
            OWNED_MESH *mesh = load(format, shift, scale, 2, NULL);
            const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
            double largest = 0;
            for (size_t v = 0; view && v < view->vertex_count; ++v) {
                double p[3];
                for (int k = 0; k < 3; ++k) { /* on the torus: (|xy| - 1)^2 + z^2 = 0.375^2 */
                    p[k] = ((double)view->positions[3 * v + (size_t)k] +
                            (view->origin[k] - shift[k])) /
                           scale;
                }
                const double ring = hypot(p[0], p[1]) - 1;
                largest = fmax(largest, fabs(hypot(ring, p[2]) - 0.375));
            }
            /* rounding to UNIT, to floats below 2, to doubles of 4,100,000 */
            const double bound = 2 * UNIT * 0.5 + 2 * 0x1p-24 * 2 + 2 * 0x1p-31 / scale +
                                 (format == GLTF ? 0x1p-23 : 0);
            CHECK(view && largest < bound, "%s: %g > %g", names[format], largest, bound);
            CHECK(view && view->vertex_count == POINTS, "%s at %g: %zu vertices", names[format],
                  scale, view ? view->vertex_count : 0);
        }
    }
}

/* Up to 32 times its size away, a mesh has its file's rounded coordinates; a file of floats always
 * does. */
static void test_near(void) {
    static const double near[3] = {80, -60, 85}, far[3] = {80, -60, 95}; /* the size is 2.75 */
    for (int format = 0; format < FORMATS - 1; ++format) {
        burnish_mesh *mesh = load(format, near, 1, 1, NULL);
        const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        if (CHECK1(view)) {
            CHECK(memcmp(view->origin, zero, sizeof zero) == 0, "%s", names[format]);
            CHECK(view->bounds_max[0] == 81.375f, "%s: %g", names[format],
                  (double)view->bounds_max[0]);
        }
        burnish_mesh_destroy(mesh);
        mesh = load(format, far, 1, 1, NULL);
        view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        CHECK(view && memcmp(view->origin, far, sizeof far) == 0, "%s", names[format]);
        burnish_mesh_destroy(mesh);
    }
}

/* Every format uses the caller's origin unchanged. An origin that is not a number is rejected. */
static void test_given(void) {
    static const double shift[3] = {500000.125, 4100000.25, 300.5}, other[3] = {0, 4100000, 0};
    static const double wrong[3] = {0, HUGE_VAL, 0};
    for (int format = 0; format < FORMATS; ++format) {
        burnish_mesh *mesh = load(format, shift, 1, 2, other);
        const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        if (CHECK1(view)) {
            CHECK1(memcmp(view->origin, other, sizeof other) == 0);
            CHECK(format == POINT_CLOUD || view->bounds_max[1] == 1.625f, "%s: %.9g", names[format],
                  (double)view->bounds_max[1]);
        }
        burnish_mesh_destroy(mesh);
        mesh = load(format, shift, 1, 2, zero);
        view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        CHECK(view && memcmp(view->origin, zero, sizeof zero) == 0 && view->bounds_max[0] > 5e5f,
              "%s", names[format]);
        burnish_mesh_destroy(mesh);
    }
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    burnish_error error = {0};
    options.origin = wrong;
    CHECK1(burnish_mesh_load(":torus", &options, &mesh, &error) == BURNISH_STATUS_ARGUMENT);
    options.origin = other;
    if (CHECK_OK(burnish_mesh_load(":torus", &options, &mesh, &error), error)) {
        CHECK1(burnish_mesh_get_view(mesh)->bounds_max[1] < -4e6f);
        burnish_mesh_destroy(mesh);
    }
}

/* A binary STL of one facet, floats, less an origin. */
static void test_floats(void) {
    static const float values[12] = {0, 0, 1, 4096, 8, 0, 4097, 8, 0, 4096, 9, 0.5f};
    static const double origin[3] = {4096, 0, 0};
    burnish_load_options options = burnish_load_options_default();
    file_bytes file = {0};
    add(&file, (uint8_t[84]){[80] = 1}, 84);
    for (size_t i = 0; i < 12; ++i) {
        add_float(&file, (double)values[i], 0, 0);
    }
    add_bits(&file, 0, 2, 0);
    for (int given = 0; given < 2; ++given) {
        options.origin = given ? origin : NULL;
        OWNED_MESH *mesh = load_bytes(file.bytes, file.size, "a.stl", &options);
        if (mesh) {
            const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
            CHECK1(view->bounds_min[0] == (given ? 0 : 4096.0f) && view->bounds_min[1] == 8);
            CHECK1(view->origin[0] == (given ? 4096 : 0));
        }
    }
    free(file.bytes);
}

/* Warnings, materials and the material library come from one reading. */
static burnish_status load_library(void *user_data, const char *name, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    static const char library[] = "newmtl red\nKd 1 0 0\n";
    (void)name, (void)max_bytes, (void)error;
    ++*(int *)user_data;
    *bytes = library;
    *size = sizeof library - 1;
    return BURNISH_STATUS_OK;
}

static void test_once(void) {
    static const char obj[] = "mtllib a.mtl\nv 500000.25 4e6 0\nv 500001.25 4e6 0\n"
                              "v 500000.25 4000001 0\nv 500001.25 4000001 0\nusemtl red\n"
                              "f 1 2 3\nusemtl none\nf 2 4 3\nf 1 2\nl 1 2\n";
    burnish_load_options options = burnish_load_options_default();
    int times = 0;
    options.referenced_files = (burnish_file_loader){load_library, NULL, &times};
    OWNED_MESH *mesh = load_bytes(obj, sizeof obj - 1, "a.obj", &options);
    if (!mesh) {
        return;
    }
    CHECK1(times == 1);
    CHECK1(burnish_mesh_get_view(mesh)->origin[1] == 4000000.5);
    CHECK1(burnish_mesh_get_view(mesh)->triangle_materials != NULL);
    CHECK(burnish_mesh_get_warning_count(mesh) == 3, "%zu warnings",
          burnish_mesh_get_warning_count(mesh));
    CHECK1(burnish_mesh_get_material(mesh, 0)->diffuse[0] == 1);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_same_bits());
    RUN(test_accuracy());
    RUN(test_near());
    RUN(test_given());
    RUN(test_floats());
    RUN(test_once());
    return test_end("origin");
}
