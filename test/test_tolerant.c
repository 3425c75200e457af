/* Files that are not quite right are drawn with a warning; a strict load refuses each of them. */
#include "burnish/mesh.h"
#include "reader_input.h"

static const char *library; /* the text of every material library */

static burnish_status open_library(void *user_data, const char *name, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data, (void)max_bytes;
    if (!library) {
        return burnish_fail(error, BURNISH_STATUS_READ, "%s: No such file", name);
    }
    *size = strlen(library);
    *bytes = library;
    return BURNISH_STATUS_OK;
}

static burnish_load_options options_of(int strict) {
    burnish_load_options options = burnish_load_options_default();
    options.strict = strict;
    options.companions.load = open_library;
    return options;
}

/* Loads bytes that deserve exactly this one warning (NULL: none); strict loading makes an error of
 * it. Returns the mesh, NULL where there is none. */
static burnish_mesh *load_tolerantly(const char *name, const void *bytes, size_t size,
                                     const char *warning) {
    burnish_mesh *mesh, *none = NULL;
    burnish_error error = {0};
    burnish_load_options options = options_of(1);
    const burnish_status strict =
        burnish_mesh_load_memory(bytes, size, name, &options, &none, &error);
    CHECK(strict == (warning ? BURNISH_STATUS_FORMAT : BURNISH_STATUS_OK), "%d %s", (int)strict,
          error.text);
    CHECK(!warning || (!none && strncmp(error.text, warning, strlen(warning)) == 0), "%s",
          error.text);
    burnish_mesh_destroy(none);
    options = options_of(0);
    error = (burnish_error){0};
    if (!CHECK(burnish_mesh_load_memory(bytes, size, name, &options, &mesh, &error) ==
                   BURNISH_STATUS_OK,
               "%s", error.text)) {
        return NULL;
    }
    const size_t count = burnish_mesh_warning_count(mesh);
    CHECK(count == (warning ? 1 : 0), "%zu warnings, first: %s", count,
          count > 0 ? burnish_mesh_warning(mesh, 0) : "");
    if (warning && count > 0) {
        CHECK_TEXT(burnish_mesh_warning(mesh, 0), warning);
    }
    return mesh;
}

static burnish_mesh *load_text(const char *name, const char *text, const char *warning) {
    return load_tolerantly(name, text, strlen(text), warning);
}

static size_t triangles_of(const burnish_mesh *mesh) {
    return mesh ? burnish_mesh_get_view(mesh)->triangle_count : 0;
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* Blender writes "newmtl" and "usemtl" with nothing after it. */
static void test_nameless_material(void) {
    library = "newmtl \nKd 1 0 0\n";
    burnish_mesh *mesh = load_text("a.obj", "mtllib a.mtl\n" TRIANGLE "usemtl\nf 1 2 3\n",
                                   "a.mtl:1: newmtl has no name; faces without a material have "
                                   "this one");
    CHECK1(mesh && color_is(burnish_mesh_material(mesh, 0)->diffuse, 1, 0, 0));
    burnish_mesh_destroy(mesh);
}

/* What was read before and after the fault counts. */
static void test_library_fault(void) {
    library = "newmtl a\nKd 0 1 0\nKs x 1 1\nNs 7\n";
    burnish_mesh *mesh = load_text("a.obj", "mtllib a.mtl\n" TRIANGLE "usemtl a\nf 1 2 3\n",
                                   "a.mtl:3: Ks \"x\" is not a number; write it like 1.5 or -2e-3; "
                                   "the statement was ignored");
    CHECK1(mesh && color_is(burnish_mesh_material(mesh, 0)->diffuse, 0, 1, 0) &&
           burnish_mesh_material(mesh, 0)->exponent == 7);
    burnish_mesh_destroy(mesh);
}

/* Building warns as well. */
static void test_strict_build(void) {
    burnish_mesh *mesh = load_text("a.obj", TRIANGLE "f 1 2 3\nf 1 1 3\n",
                                   "a.obj: 1 of 2 triangles have no area and were left out");
    CHECK1(triangles_of(mesh) == 1);
    burnish_mesh_destroy(mesh);
}

/* ---- Faces ---- */

/* Normals that a face names and the file does not have are generated, those that it has are kept.
 */
static void test_missing_normals(void) {
    burnish_mesh *mesh = load_text("a.obj", TRIANGLE "vn 1 0 1\nf 1//1 2//7 3//-2\n",
                                   "a.obj: faces refer to normals that the file "
                                   "does not have");
    if (CHECK1(triangles_of(mesh) == 1)) {
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        int kept = 0, generated = 0;
        for (size_t i = 0; i < view->vertex_count; ++i) {
            kept += view->normals[3 * i] > 0.7f;
            generated += view->normals[3 * i + 2] == 1;
        }
        CHECK(kept == 1 && generated == 2, "%d %d", kept, generated);
    }
    burnish_mesh_destroy(mesh);
    mesh = load_text("a.obj", TRIANGLE "f 1//0 2//99999999999999999999 3//-99999999999\n",
                     "a.obj: faces refer to normals that the file does not have");
    CHECK1(triangles_of(mesh) == 1);
    burnish_mesh_destroy(mesh);
    mesh = load_text("a.obj", TRIANGLE "vn 0 0\nvn x 1 2\nf 1//1 2//2 3//1\n",
                     "a.obj:4: a normal is not 3 numbers; it was generated (and 1 more like it)");
    CHECK1(triangles_of(mesh) == 1);
    burnish_mesh_destroy(mesh);
}

/* ---- Colours ---- */

static const uint8_t *color_at(const burnish_mesh *mesh, float x, float y) {
    static const uint8_t none[4] = {0};
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    for (size_t i = 0; view && view->colors && i < view->vertex_count; ++i) {
        if (view->positions[3 * i] == x && view->positions[3 * i + 1] == y) {
            return view->colors + 4 * i;
        }
    }
    return none;
}

static int color_at_is(const burnish_mesh *mesh, float x, float y, uint8_t r, uint8_t g,
                       uint8_t b) {
    const uint8_t *rgba = color_at(mesh, x, y);
    return rgba[0] == r && rgba[1] == g && rgba[2] == b && rgba[3] == 255;
}

static void test_obj_colors(void) {
    burnish_mesh *mesh = load_text(
        "a.obj", "v 0 0 0 1 nan 0\nv 1 0 0 0 1 0\nv 0 1 0 1 0\nf 1 2 3\n",
        "a.obj:1: what follows a vertex's coordinates is no colour; it is white (and 1 more like "
        "it)");
    CHECK1(color_at_is(mesh, 0, 0, 255, 255, 255) && color_at_is(mesh, 1, 0, 0, 255, 0) &&
           color_at_is(mesh, 0, 1, 255, 255, 255));
    burnish_mesh_destroy(mesh);
    /* One component beyond 2 tells that all count to 255; those up to 1 and white by default too.
     */
    mesh = load_text("a.obj",
                     "v 0 0 0 255 128 0\nv 1 0 0 1 0.4 1\nv 0 1 0\nv 1 1 0 300 -4 7\nf 1 2 4 3\n",
                     "a.obj: colours of vertices are beyond 1 and were taken to count to 255");
    CHECK1(color_at_is(mesh, 0, 0, 255, 128, 0) && color_at_is(mesh, 1, 0, 1, 0, 1) &&
           color_at_is(mesh, 0, 1, 255, 255, 255) && color_at_is(mesh, 1, 1, 255, 0, 7));
    burnish_mesh_destroy(mesh);
    mesh = load_text("a.obj", "v 0 0 0 1.25 0.5 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", NULL);
    CHECK1(color_at_is(mesh, 0, 0, 255, 128, 0) && color_at_is(mesh, 1, 0, 255, 255, 255));
    burnish_mesh_destroy(mesh);
}

/* ---- STL ---- */

#define LOOP "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"

static void test_stl_text(void) {
    static const struct {
        const char *text, *warning;
        size_t triangles;
    } cases[] = {
        {"solid\nfacet normal 0 0 1\n" LOOP, "a.stl:8: \"endsolid\" is missing", 1},
        {"solid a\nfacet normal 0 0 1\n" LOOP "solid b\nfacet normal 0 0 1\n" LOOP "endsolid\n",
         "a.stl:9: \"endsolid\" is missing", 2},
        {"solid\nfacet normal 0 0 1\n" LOOP
         "endsolid\nmade by hand\nsolid\nfacet normal 0 0 1\n" LOOP "endsolid b\nfacetious text\n",
         "a.stl:10: text after \"endsolid\" was ignored (and 1 more like it)", 2},
        {"solid\nfacet normal 0 weird 1\n" LOOP "facet normal nan inf 0\n" LOOP
         "facet normal\n" LOOP "facet normal 1 2\n" LOOP "endsolid\n",
         "a.stl:2: a normal is not 3 numbers; it was ignored (and 2 more like it)", 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh *mesh = load_text("a.stl", cases[i].text, cases[i].warning);
        CHECK(triangles_of(mesh) == cases[i].triangles, "case %zu: %zu", i, triangles_of(mesh));
        burnish_mesh_destroy(mesh);
    }
}

/* The size tells how many facets there are, unless nothing fits it. */
static void test_stl_count(void) {
    static const uint32_t counts[] = {0, 11, 13, UINT32_MAX};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
        byte_list list = {.size = 0};
        char warning[128];
        put_stl(&list, "size counts", 12);
        memcpy(list.bytes + 80, &counts[i], 4);
        snprintf(warning, sizeof warning,
                 "a.stl: byte 80: %u triangles are announced, but the file has 12, which are drawn",
                 counts[i]);
        burnish_mesh *mesh = load_tolerantly("a.stl", list.bytes, list.size, warning);
        CHECK(triangles_of(mesh) == 12, "%zu", triangles_of(mesh));
        burnish_mesh_destroy(mesh);
    }
}

/* ---- PLY ---- */

#define PLY_HEAD(words)                                                                            \
    "ply\nformat ascii 1.0\n" words "element vertex 3\nproperty float x\nproperty float y\n"       \
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"            \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

static void test_ply_header(void) {
    burnish_mesh *mesh = load_text(
        "a.ply", PLY_HEAD("Created by hand\n") "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n",
        "a.ply:3: \"Created\" begins no line of a PLY header; it was ignored");
    CHECK1(triangles_of(mesh) == 1);
    burnish_mesh_destroy(mesh);
    static const float xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    byte_list list = {.size = 0};
    put_text(&list, "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                    "property float y\nproperty float z\nelement face 1\n"
                    "property list uchar int vertex_indices\nend_header\r\n");
    for (int i = 0; i < 9; ++i) {
        put_float(&list, xyz[i], 0);
    }
    put_bits(&list, 3, 1, 0);
    for (uint64_t i = 0; i < 3; ++i) {
        put_bits(&list, i, 4, 0);
    }
    mesh = load_tolerantly("a.ply", list.bytes, list.size,
                           "a.ply:9: \"end_header\" ends with CR LF, other lines with LF");
    CHECK1(triangles_of(mesh) == 1);
    burnish_mesh_destroy(mesh);
}

/* Rows are lines where there are as many of both. */
static void test_ply_lines(void) {
    static const struct {
        const char *body, *warning;
    } cases[] = {
        {"0 0 0 9 2 3 255\n1 0 0 9 2 3 255\n\n0 1 0 9 2 3 255\n3 0 1 2\n",
         "a.ply:13: the line has more or fewer values than the header says (and 2 more like it)"},
        {"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
         "a.ply:13: the line has more or fewer values than the header says (and 2 more like it)"},
        {"0 0 0 9 2 3\n1 0 0 9 2 3\n0 1 0 9\n3 0 1 2 255 255 255\n",
         "a.ply:15: the line has more or fewer values than the header says (and 1 more like it)"},
        /* rows that are no lines, as they may be */
        {"0 0 0\n9 2 3\n1 0 0\n9 2 3\n0 1 0 9 2 3 3 0\n1 2\n", NULL},
        {"0 0 0 9 2 3 1 0 0 9 2 3\n0 1 0\n9 2 3\n3 0 1 2\n", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[1024];
        snprintf(text, sizeof text, "%s%s", PLY_HEAD(""), cases[i].body);
        burnish_mesh *mesh = load_text("a.ply", text, cases[i].warning);
        const int white = i == 1;
        CHECK(color_at_is(mesh, 0, 0, white ? 255 : 9, white ? 255 : 2, white ? 255 : 3) &&
                  burnish_mesh_get_view(mesh)->bounds_max[2] == 0,
              "case %zu", i);
        CHECK(color_at(mesh, 0, 1)[1] == (i == 1 || i == 2 ? 255 : 2), "case %zu", i);
        burnish_mesh_destroy(mesh);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_nameless_material());
    RUN(test_library_fault());
    RUN(test_strict_build());
    RUN(test_missing_normals());
    RUN(test_obj_colors());
    RUN(test_stl_text());
    RUN(test_stl_count());
    RUN(test_ply_header());
    RUN(test_ply_lines());
    return test_end("tolerant");
}
