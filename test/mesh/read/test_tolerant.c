/* Files that are not quite right are drawn with a warning; a strict load refuses each of them. */
#include <sys/stat.h>
#include <unistd.h>

#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "zip_input.h"

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
    options.referenced_files.load = open_library;
    return options;
}

/* Loads bytes that deserve exactly this one warning (NULL: none); strict loading makes an error of
 * it. Returns the mesh until the next call, NULL where there is none. */
static burnish_mesh *load_tolerantly(const char *name, const void *bytes, size_t size,
                                     const char *warning) {
    static burnish_mesh *mesh;
    burnish_mesh *none = NULL;
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
    burnish_mesh_destroy(mesh);
    mesh = load_bytes(bytes, size, name, &options);
    if (mesh) {
        check_only_warning(mesh, warning);
    }
    return mesh;
}

static burnish_mesh *load_text(const char *name, const char *text, const char *warning) {
    return load_tolerantly(name, text, strlen(text), warning);
}

static size_t triangles_of(const burnish_mesh *mesh) {
    return mesh ? burnish_mesh_get_view(mesh)->triangle_count : 0;
}

static void check_text(const char *name, const char *text, const char *warning, size_t triangles) {
    burnish_mesh *mesh = load_text(name, text, warning);
    CHECK(triangles_of(mesh) == triangles, "%s: %zu triangles", text, triangles_of(mesh));
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* Blender writes "newmtl" and "usemtl" with nothing after it. */
static void test_nameless_material(void) {
    library = "newmtl \nKd 1 0 0\n";
    burnish_mesh *mesh = load_text("a.obj", "mtllib a.mtl\n" TRIANGLE "usemtl\nf 1 2 3\n",
                                   "a.mtl:1: newmtl has no name; faces without a material have "
                                   "this one");
    CHECK1(mesh && color_is(burnish_mesh_get_material(mesh, 0)->diffuse, 1, 0, 0));
}

/* A name that is not in the library may end before a comment. */
static void test_material_comment(void) {
    library = "newmtl a\nKd 1 0 0\nnewmtl a # b\nKd 0 1 0\n";
    burnish_mesh *mesh = load_text(
        "a.obj", "mtllib a.mtl\n" TRIANGLE "usemtl a # c\nf 1 2 3\nusemtl a # b\nf 1 2 3\n", NULL);
    CHECK1(mesh && burnish_mesh_get_material_count(mesh) == 2 &&
           color_is(burnish_mesh_get_material(mesh, 0)->diffuse, 1, 0, 0) &&
           color_is(burnish_mesh_get_material(mesh, 1)->diffuse, 0, 1, 0));
    library = ""; /* and where it has no names at all */
    check_text("a.obj", "mtllib a.mtl\n" TRIANGLE "usemtl a # c\nf 1 2 3\n",
               "a.obj: material \"a # c\" is in no material library; it is burnish's grey", 1);
}

/* What was read before and after the fault counts. */
static void test_library_fault(void) {
    library = "newmtl a\nKd 0 1 0\nKs x 1 1\nNs 7\n";
    burnish_mesh *mesh = load_text("a.obj", "mtllib a.mtl\n" TRIANGLE "usemtl a\nf 1 2 3\n",
                                   "a.mtl:3: Ks \"x\" is not a number; write it like 1.5 or -2e-3; "
                                   "the statement was ignored");
    CHECK1(mesh && color_is(burnish_mesh_get_material(mesh, 0)->diffuse, 0, 1, 0) &&
           burnish_mesh_get_material(mesh, 0)->exponent == 7);
}

/* Building warns as well. */
static void test_strict_build(void) {
    check_text("a.obj", TRIANGLE "f 1 2 3\nf 1 1 3\n",
               "a.obj: 1 of 2 triangles have no area and were left out", 1);
}

/* ---- Faces ---- */

/* Missing normals that a face names are generated; the present ones are kept. */
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
    check_text("a.obj", TRIANGLE "f 1//0 2//99999999999999999999 3//-99999999999\n",
               "a.obj: faces refer to normals that the file does not have", 1);
    check_text("a.obj", TRIANGLE "vn 0 0\nvn x 1 2\nf 1//1 2//2 3//1\n",
               "a.obj:4: a normal is not 3 numbers; it was generated (and 1 more like it)", 1);
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
    burnish_mesh *mesh =
        load_text("a.obj", "v 0 0 0 1 nan 0\nv 1 0 0 0 1 0\nv 0 1 0 1 0\nf 1 2 3\n",
                  "a.obj:1: the values after a vertex's coordinates are not a colour; it is white "
                  "(and 1 more like "
                  "it)");
    CHECK1(color_at_is(mesh, 0, 0, 255, 255, 255) && color_at_is(mesh, 1, 0, 0, 255, 0) &&
           color_at_is(mesh, 0, 1, 255, 255, 255));
    /* One component beyond 2 means that all count to 255, including components up to 1 and default
     * white. */
    mesh = load_text("a.obj",
                     "v 0 0 0 255 128 0\nv 1 0 0 1 0.4 1\nv 0 1 0\nv 1 1 0 300 -4 7\nf 1 2 4 3\n",
                     "a.obj: vertex colours exceed 1 and were read as 0 to 255");
    CHECK1(color_at_is(mesh, 0, 0, 255, 128, 0) && color_at_is(mesh, 1, 0, 1, 0, 1) &&
           color_at_is(mesh, 0, 1, 255, 255, 255) && color_at_is(mesh, 1, 1, 255, 0, 7));
    mesh = load_text("a.obj", "v 0 0 0 1.25 0.5 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", NULL);
    CHECK1(color_at_is(mesh, 0, 0, 255, 128, 0) && color_at_is(mesh, 1, 0, 255, 255, 255));
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
        {"solid\nfacet\n" LOOP "facet\n" LOOP "endsolid\n",
         "a.stl:3: a normal is not 3 numbers; it was ignored (and 1 more like it)", 2},
        {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
         "endloop one\nendfacet two three\nfacet normal 0 0 1\n" LOOP "endsolid\n",
         "a.stl:7: text in a facet's line was ignored (and 1 more like it)", 2},
        {"solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
         "endfacet facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
         "endfacet endsolid a\n",
         NULL, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        check_text("a.stl", cases[i].text, cases[i].warning, cases[i].triangles);
    }
}

/* The size determines the number of facets, unless nothing matches it. 0, which programs write that
 * can not seek in their output, is no reason to warn. */
static void test_stl_count(void) {
    static const uint32_t counts[] = {0, 11, 13, UINT32_MAX};
    byte_list other = {.size = 0}; /* a size that matches counts, whatever the name is */
    put_stl(&other, "size counts", 12);
    burnish_mesh *named = load_tolerantly("a.obj", other.bytes, other.size,
                                          "a.obj: the file is STL, not OBJ as its name says");
    CHECK(triangles_of(named) == 12, "%zu", triangles_of(named));
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
        byte_list list = {.size = 0};
        char warning[128];
        put_stl(&list, "size counts", 12);
        memcpy(list.bytes + 80, &counts[i], 4);
        snprintf(warning, sizeof warning,
                 "a.stl: byte 80: %u triangles are announced, but the file has 12, which are drawn",
                 counts[i]);
        burnish_mesh *mesh =
            load_tolerantly("a.stl", list.bytes, list.size, counts[i] > 0 ? warning : NULL);
        CHECK(triangles_of(mesh) == 12, "%zu", triangles_of(mesh));
    }
}

/* ---- PLY ---- */

#define PLY_HEAD(words)                                                                            \
    "ply\nformat ascii 1.0\n" words "element vertex 3\nproperty float x\nproperty float y\n"       \
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"            \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

static void test_ply_header(void) {
    check_text("a.ply",
               PLY_HEAD("Created by hand\n") "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n",
               "a.ply:3: \"Created\" does not start a line of a PLY header; ignored", 1);
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
    burnish_mesh *mesh =
        load_tolerantly("a.ply", list.bytes, list.size,
                        "a.ply:9: \"end_header\" ends with CR LF, other lines with LF");
    CHECK1(triangles_of(mesh) == 1);
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
        /* rows that are not lines, which is valid */
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
    }
}

/* Comments in the body, which the format does not permit, and blank lines, which are not comments.
 * Lines keep their numbers. */
static void test_ply_comments(void) {
    static const struct {
        const char *body, *warning;
    } cases[] = {
        {"comment by hand\n0 0 0 9 2 3\n1 0 0 9 2 3\n0 1 0 9 2 3\n3 0 1 2\n",
         "a.ply:13: a comment among the rows was ignored"},
        {"0 0 0 9 2 3\n\n# 1\n1 0 0 9 2 3\r\n  comment 5 5 5\r\n0 1 0 9 2 3\n\nobj_info 3 0 1 2\n"
         "3 0 1 2\n",
         "a.ply:15: a comment among the rows was ignored (and 2 more like it)"},
        {"0 0 0 9 2 3\n\n\n1 0 0 9 2 3\n0 1 0 9 2 3\n   \n3 0 1 2\n", NULL},
        {"0 0 0 9 2 3\n1 0 0 9 2 3\n0 1 0 9 2 3\n3 0 1 2\ncomment the end\n", NULL},
    };
    char text[1024];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        snprintf(text, sizeof text, "%s%s", PLY_HEAD(""), cases[i].body);
        burnish_mesh *mesh = load_text("a.ply", text, cases[i].warning);
        CHECK(triangles_of(mesh) == 1 && color_at_is(mesh, 0, 1, 9, 2, 3), "case %zu", i);
    }
    burnish_load_options options = options_of(0);
    burnish_error error;
    /* Later messages about the header have its line. */
    snprintf(text, sizeof text, "%s%s", PLY_HEAD("comment TextureFile b.png\n"), cases[0].body);
    burnish_mesh *mesh = load_bytes(text, strlen(text), "a.ply", &options);
    CHECK1(burnish_mesh_get_warning_count(mesh) == 2);
    CHECK(strstr(burnish_mesh_get_warning(mesh, 1), "a.ply:3: texture \"b.png\" was skipped"), "%s",
          burnish_mesh_get_warning(mesh, 1));
    burnish_mesh_destroy(mesh);
    snprintf(text, sizeof text, "%s%s", PLY_HEAD(""),
             "# c\n0 0 0 9 2 3\n1 0 x 9 2 3\n0 1 0 9 2 3\n3 0 1 2\n");
    CHECK1(burnish_mesh_load_memory(text, strlen(text), "a.ply", &options, &mesh, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK(strncmp(error.text, "a.ply:15: value \"x\"", 19) == 0, "%s", error.text);
    snprintf(text, sizeof text, "%s%s", PLY_HEAD(""),
             "# c\n0 0 0 9 2 3\n1 0 1 9 2 3\n# d\n0 1 0 9 2 3\n");
    CHECK1(burnish_mesh_load_memory(text, strlen(text), "a.ply", &options, &mesh, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK(strstr(error.text, "truncated"), "%s", error.text);
}

/* A vertex of two faces has two colours; polygons have one. In all encodings the same. */
static void test_face_colors(void) {
    static const float xyz[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {3, 3, 0}};
    static const uint8_t faces[2][5] = {{3, 0, 4, 3}, {4, 0, 1, 2, 3}};
    for (int order = 0; order < 2; ++order) { /* of the faces: a triangle or a polygon first */
        for (int encoding = 0; encoding < 3; ++encoding) {
            byte_list list = {.size = 0};
            char line[400];
            snprintf(line, sizeof line,
                     "ply\nformat %s 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                     "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
                     ply_encodings[encoding]);
            put_text(&list, line);
            for (int i = 0; i < 15; ++i) {
                put_ply_value(&list, encoding, 'f', (double)xyz[i / 3][i % 3]);
            }
            for (int i = 0; i < 2; ++i) {
                const uint8_t *face = faces[i ^ order];
                put_ply_value(&list, encoding, 'n', 0);
                for (int k = 0; k <= face[0] + 3; ++k) {
                    const int is_color = k > face[0];
                    put_ply_value(&list, encoding, k == 0 || is_color ? 'c' : 'i',
                                  is_color ? 10 * face[0] + k : face[k]);
                }
            }
            burnish_mesh *mesh = load_tolerantly("a.ply", list.bytes, list.size, NULL);
            CHECK(triangles_of(mesh) == 3 && color_at_is(mesh, 3, 3, 34, 35, 36) &&
                      color_at_is(mesh, 1, 0, 45, 46, 47) && color_at_is(mesh, 1, 1, 45, 46, 47),
                  "%d %d", order, encoding);
            CHECK1(mesh && burnish_mesh_get_view(mesh)->vertex_count == 7);
        }
    }
    for (int alike = 0; alike < 2; ++alike) { /* faces have the colours if vertices all have one */
        char text[600];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                 "property float y\nproperty float z\nproperty uchar r\n"
                 "property uchar g\nproperty uchar b\nelement face 1\n"
                 "property list uchar int vertex_indices\nproperty uchar red\n"
                 "property uchar green\nproperty uchar blue\nend_header\n"
                 "0 0 0 9 8 7\n1 0 0 9 8 7\n0 1 0 9 8 %d\n3 0 1 2 1 2 3\n",
                 alike ? 7 : 6);
        burnish_mesh *mesh = load_text(
            "a.ply", text,
            alike ? NULL : "a.ply: colours of faces are not drawn, the colours of vertices are");
        CHECK1(alike ? color_at_is(mesh, 1, 0, 1, 2, 3) : color_at_is(mesh, 1, 0, 9, 8, 7));
    }
}

/* ---- Material libraries: where they are ---- */

/* Loads in.obj of the folder at hand, which names the library by a line; whether that was found. */
static int finds_library(const char *line, int ignore_referenced_files, const char *warning) {
    char text[400];
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    burnish_load_options options = burnish_load_options_default();
    options.ignore_referenced_files = ignore_referenced_files;
    snprintf(text, sizeof text, "mtllib %s\n" TRIANGLE "usemtl a\nf 1 2 3\n", line);
    test_write_file("in.obj", text);
    if (!CHECK_OK(burnish_mesh_load("in.obj", &options, &mesh, &error), error)) {
        return 0;
    }
    const int found = color_is(burnish_mesh_get_material(mesh, 0)->diffuse, 1, 0, 0);
    const size_t count = burnish_mesh_get_warning_count(mesh);
    CHECK(count == (warning != NULL), "%s: %zu warnings, %s", line, count,
          count > 0 ? burnish_mesh_get_warning(mesh, 0) : "");
    CHECK(!warning || count == 0 || strstr(burnish_mesh_get_warning(mesh, 0), warning), "%s: %s",
          line, burnish_mesh_get_warning(mesh, 0));
    burnish_mesh_destroy(mesh);
    return found;
}

static void test_libraries(void) {
    char folder[] = "/tmp/burnish-tolerant-XXXXXX";
    CHECK1(mkdtemp(folder) && chdir(folder) == 0 && mkdir("in", 0700) == 0 &&
           mkdir("in/Sub", 0700) == 0);
    test_write_file("out.mtl", "newmtl a\nKd 1 0 0\n");
    CHECK1(chdir("in") == 0);
    test_write_file("Plain.mtl", "newmtl a\nKd 1 0 0\n");
    test_write_file("a b.mtl", "newmtl a\nKd 1 0 0\n");
    test_write_file("Sub/c.mtl", "newmtl a\nKd 1 0 0\n");
    CHECK1(symlink("../out.mtl", "link.mtl") == 0 && symlink("..", "up") == 0);
    static const struct {
        const char *line, *warning;
        int found;
    } cases[] = {
        {"Plain.mtl", NULL, 1},
        {"plain.MTL", NULL, 1},
        {"sub\\C.mtl", NULL, 1},
        {"a b.mtl", NULL, 1},
        {"a\\ b.mtl", NULL, 1},
        {"Plain.mtl # a comment", NULL, 1},
        {"a b.mtl\t# a comment # of two", NULL, 1},
        {"none.mtl # a comment", "No such file", 0},
        {"C:\\Users\\me\\Plain.mtl", "is next to the file", 1},
        {"/home/x/plain.mtl", "is next to the file", 1},
        {"../mtl/Plain.mtl", "is next to the file", 1},
        {"none/Plain.mtl", "is next to the file", 1},
        {"../out.mtl", "outside the folder", 0},
        {"link.mtl", "leads out of the folder", 0},
        {"up/out.mtl", "leads out of the folder", 0},
        {"none.mtl", "No such file", 0},
        {"none/", "was not read", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        CHECK(finds_library(cases[i].line, 0, cases[i].warning) == cases[i].found, "%s",
              cases[i].line);
        CHECK(!finds_library(cases[i].line, 1, NULL), "%s", cases[i].line);
    }
    CHECK1(unlink("in.obj") == 0 && unlink("Plain.mtl") == 0 && unlink("a b.mtl") == 0 &&
           unlink("Sub/c.mtl") == 0 && rmdir("Sub") == 0 && unlink("link.mtl") == 0 &&
           unlink("up") == 0 && chdir("..") == 0 && unlink("out.mtl") == 0 && rmdir("in") == 0 &&
           chdir("/") == 0 && rmdir(folder) == 0);
}

/* ---- Wrappings ---- */

/* "v 0 0 0" and so on, by gzip(1) -9, in two files one after the other. */
static const uint8_t packed[] = {
    0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x2b, 0x53, 0x30, 0x00, 0x41, 0xae,
    0x32, 0x05, 0x43, 0x30, 0x0d, 0x00, 0x29, 0x2a, 0xd9, 0xc3, 0x10, 0x00, 0x00, 0x00, 0x1f, 0x8b,
    0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0x2b, 0x53, 0x30, 0x50, 0x30, 0x54, 0x30, 0xe0,
    0x4a, 0x03, 0x92, 0x46, 0x0a, 0xc6, 0x5c, 0x00, 0x25, 0xcc, 0xe3, 0xa5, 0x10, 0x00, 0x00, 0x00};

static void test_gzip(void) {
    burnish_mesh *mesh = load_tolerantly("a.obj.gz", packed, sizeof packed, NULL);
    CHECK1(triangles_of(mesh) == 1);
    mesh = load_tolerantly("standard input", packed, sizeof packed, NULL);
    CHECK1(triangles_of(mesh) == 1);
    uint8_t copy[sizeof packed];
    burnish_load_options options = burnish_load_options_default();
    burnish_error error;
    for (size_t size = 3; size < sizeof packed; ++size) {
        burnish_status status =
            burnish_mesh_load_memory(packed, size, "a.gz", &options, &mesh, &error);
        /* cut between the two files, the first is whole: its vertices */
        CHECK(status == BURNISH_STATUS_FORMAT ||
                  (mesh && burnish_mesh_get_info(mesh)->point_count == 2),
              "%zu: %d", size, (int)status);
        burnish_mesh_destroy(mesh);
    }
    for (size_t i = 0; i < sizeof packed; ++i) { /* checksums find every change of what matters */
        memcpy(copy, packed, sizeof packed);
        copy[i] ^= 0x10;
        if (burnish_mesh_load_memory(copy, sizeof copy, "a.gz", &options, &mesh, &error) ==
            BURNISH_STATUS_OK) {
            /* what no longer begins a second file is ignored, as gzip does */
            CHECK(triangles_of(mesh) == 1 || burnish_mesh_get_info(mesh)->point_count == 2,
                  "byte %zu", i);
            burnish_mesh_destroy(mesh);
        }
    }
}

/* 65 MiB of blanks in 64 KiB are refused before all are unpacked. */
static void test_gzip_bomb(void) {
    static uint8_t bomb[1 << 16];
    /* a block whose code of 2 zero bits repeats a blank 258 times */
    static const uint8_t head[] = {0x1f, 0x8b, 8,    0,    0,    0,    0,    0,    0,
                                   3,    0xec, 0xc1, 0x81, 0x00, 0x00, 0x00, 0x00, 0x80,
                                   0x20, 0x95, 0xfd, 0x29, 0x17, 0xa9, 0x0a, 0x00};
    memcpy(bomb, head, sizeof head);
    burnish_load_options options = burnish_load_options_default();
    check_refused(bomb, sizeof bomb, "a.gz", &options, BURNISH_STATUS_LIMIT,
                  "a.gz: its 65536 bytes unpack to more than 67108864; unpack it first if "
                  "that is right");
    options.max_input_bytes = sizeof bomb;
    check_refused(bomb, sizeof bomb, "a.gz", &options, BURNISH_STATUS_LIMIT,
                  "a.gz: unpacks to more than the limit of 65536 bytes; raise the limit or "
                  "simplify the mesh");
}

/* Text in UTF-16, with a material's name beyond 16 bits. */
static void test_utf16(void) {
    static const uint32_t text[] = {'v', ' ', '0', ' ',  '0', ' ',  '0',  '\n',   'v',     ' ',
                                    '1', ' ', '0', ' ',  '0', '\n', 'v',  ' ',    '0',     ' ',
                                    '1', ' ', '0', '\n', 'o', ' ',  0xE9, 0x20AC, 0x1F40E, '\n',
                                    'f', ' ', '1', ' ',  '2', ' ',  '3'};
    for (int big = 0; big < 2; ++big) {
        byte_list list = {.size = 0};
        put_bits(&list, 0xFEFF, 2, big);
        for (size_t i = 0; i < sizeof text / sizeof *text; ++i) {
            if (text[i] >= 0x10000) {
                put_bits(&list, 0xD800 | (text[i] - 0x10000) >> 10, 2, big);
                put_bits(&list, 0xDC00 | (text[i] & 0x3FF), 2, big);
            } else {
                put_bits(&list, text[i], 2, big);
            }
        }
        burnish_mesh *mesh = load_tolerantly("memory", list.bytes, list.size, NULL);
        CHECK1(triangles_of(mesh) == 1);
    }
}

/* ---- Bad values ---- */

#define STL_FACET(V) "facet normal 0 0 1\nouter loop\n" V "endloop\nendfacet\n"
#define STL_VERTICES "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
#define STL_GOOD STL_FACET(STL_VERTICES)
#define PLY_XYZ(COUNT)                                                                             \
    "ply\nformat ascii 1.0\nelement vertex " #COUNT                                                \
    "\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_FACES(COUNT)                                                                           \
    "element face " #COUNT "\nproperty list uchar int vertex_indices\nend_header\n"
#define PLY_TRIANGLE "0 0 0\n1 0 0\n0 1 0\n"
#define OFF_TRIANGLE "0 0 0\n1 0 0\n0 1 0\n"

/* What can't be used is left out, and what is written in an unusual way is read: one warning each. */
static const struct {
    const char *name, *text;
    size_t triangles; /* or points */
    const char *warning;
} bad_values[] = {
    {"a.obj", "v nan inf 0\n" TRIANGLE "f 2 3 4\n", 1,
     "a.obj:1: coordinate \"nan\" is not finite; repair or remove it; it was left out"},
    {"a.obj", TRIANGLE "v 1 1 inf\nv 0 0 1.#QNAN\nf 1 2 3\nf 1 2 3 4\nf 3 2 5\n", 1,
     "a.obj:4: coordinate \"inf\" is not finite; repair or remove it; it was left out (and 1 more "
     "like it)"},
    {"a.obj", TRIANGLE "v 1 1\nv x 1 1\nf 1 2 3\nf 2 4 3\nf 2 5 3\n", 1,
     "a.obj:4: vertex has 2 numbers; write v x y z or v x y z r g b; it was left out (and 1 more "
     "like it)"},
    {"a.obj", "v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n", 1,
     "a.obj: vertices have two numbers, x and y; z was taken as 0"},
    {"a.obj", TRIANGLE "f 1 2 9\nf 1 2 3\nf 1 3 2 77\nv 0 0 1\nf 1 4 2\nv nan 0 0\n", 2,
     "a.obj:4: face refers to vertex 9, but the file has 5; correct the index; it was left out "
     "(and 2 more like it)"},
    {"a.obj", TRIANGLE "f 0 2 3\nf -9 1 2\nf 1 2 3\nf 1 2 3a\nf 1 2 3/1/1/1\nf 1 2 4294967297\n", 1,
     "a.obj:4: face refers to vertex 0; indices start at 1; it was left out (and 4 more like it)"},
    {"a.obj", TRIANGLE "f 1.0 2.0/1 3\n", 1,
     "a.obj:4: \"1.0\" has an unusual form; it was read (and 1 more like it)"},
    {"a.obj", "v 0 0 0\nv 1,5 0 0\nv 0 -1,25e0 0\nvn 0,0 0,0 1,0\nf 1//1 2//1 3//1\n", 1,
     "a.obj:2: \"1,5\" has an unusual form; it was read "
     "(and 4 more like it)"},
    {"a.obj", "V 0 0 0\nV 1 0 0\nV 0 1 0\nF 1 2 3\n", 1,
     "a.obj:1: \"V\" has an unusual form; it was read (and 3 more like it)"},
    {"a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nv 1 1 0\nl 1 2\nl 3 4\n", 64,
     "a.obj:2: coordinate \"nan\" is not finite; repair or remove it; it was left out"},
    {"a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0 \n", 2,
     "a.obj:2: coordinate \"nan\" is not finite; repair or remove it; it was left out"},
    {"a.stl",
     "solid\n" STL_GOOD STL_FACET("vertex 0 0 nan\nvertex 1 0 0\nvertex 0 1e39 0\n") "endsolid\n",
     1, "a.stl:11: coordinate \"nan\" is not finite; repair or remove it; it was left out"},
    {"a.stl", "# by x\nsolid\n" STL_GOOD "endsolid\n", 1,
     "a.stl:1: text before \"solid\" was ignored"},
    {"a.stl", "solid\n" STL_GOOD "end solid a\n", 1,
     "a.stl:9: \"end\" was joined with the next word"},
    {"a.stl",
     "solid\nfacet normal 0 0 1\nouter loop\n" STL_VERTICES "end loop\nend facet\nendsolid\n", 1,
     "a.stl:7: \"end\" was joined with the next word (and 1 more like it)"},
    {"a.stl",
     "solid\n" STL_FACET("vertex 0,0 0,0 0,0\nvertex 1,0D+00 0 0\nvertex 0 1D0 0\n") "endsolid\n",
     1,
     "a.stl:4: \"0,0\" has an unusual form; it was read "
     "(and 4 more like it)"},
    {"a.stl", "solid\n" STL_FACET(STL_VERTICES "vertex 0 0.5 0.5\n") "endsolid\n", 2,
     "a.stl:2: a facet has more than 3 vertices"},
    {"a.stl", "; by x\n/* 1 */\nsolid\n" STL_GOOD "endsolid\n", 1,
     "a.stl:1: text before \"solid\" was ignored (and 1 more like it)"},
    {"a.stl", "solid\n# by x\n" STL_GOOD "; y\nendsolid\n", 1,
     "a.stl:2: a comment was ignored (and 1 more like it)"},
    {"a.stl", STL_GOOD "endsolid\n", 1, "a.stl:1: \"solid\" is missing"},
    {"a.stl",
     "solid\n" STL_GOOD STL_FACET("vertex 0 None 0\nvertex 1 0 0\nvertex 0 1 0\n") "endsolid\n", 1,
     "a.stl:11: coordinate \"None\" is not a number; write it like 1.5 or -2e-3; it was left out"},
    {"a.obj", TRIANGLE "fo 1 2 3\n", 1, "a.obj:4: \"fo\" has an unusual form; it was read"},
    {"a.pcd",
     "# .pcd v.7\nversion .7\nfields x y z\nsize 4 4 4\ntype f f f\ncount 1 1 1\nwidth 2\n"
     "height 1\npoints 2\ndata ASCII\n0 0 0\n1 1 1\n",
     2, NULL},
    {"a.pcd", "VERSION .7\nFIELDS x y z\nPOINTS 2\nDATA ascii\n0.5,0,1\n1, 1, 1\n", 2,
     "a.pcd:5: commas or semicolons separate values"},
    {"a.ply", "\n# by x\ncomment y\n  " PLY_XYZ(3) PLY_FACES(1) PLY_TRIANGLE "3 0 1 2\n", 1,
     "a.ply: blanks or comments before \"ply\" were ignored"},
    {"a.off",
     "OFF\n7 5 0\n" OFF_TRIANGLE
     "0 0 1\n1e5 0 0\n100001 0 0\n1e5 1 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 5 6\n",
     4,
     "a.off: 1 of 5 triangles are far from the others, near 100000, 0, 0, so the mesh is drawn "
     "without them; remove them"},
    {"a.ply", PLY_XYZ(4) PLY_FACES(3) PLY_TRIANGLE "nan nan 1\n3 0 1 2\n4 0 1 2 3\n3 0 1 -1\n", 1,
     "a.ply:13: vertex 3: coordinate x is not finite or beyond 3.4e38; repair the mesh; it was "
     "left "
     "out (and 1 more like it)"},
    {"a.ply", PLY_XYZ(3) PLY_FACES(1) "0 0 0\n1,5 0 0\n0 1D+00 0\n3 0 1 2\n", 1,
     "a.ply:11: \"1,5\" has an unusual form; it was read "
     "(and 1 more like it)"},
    {"a.ply", PLY_XYZ(3) "end_header\n0 0 0\n0 nan 0\n1 1 1\n", 2,
     "a.ply:9: vertex 1: coordinate y is not finite or beyond 3.4e38; repair the mesh; it was left "
     "out"},
    {"a.ply", PLY_XYZ(4) PLY_FACES(3) PLY_TRIANGLE "1 one 0\n3 0 1 2\n3 0 1 3\n3 0 x 2\n", 1,
     "a.ply:13: value \"one\" is not a number; write it like 1.5 or -2e-3; it was left out (and 1 "
     "more like it)"},
    {"a.ply", "\xEF\xBB\xBF" PLY_XYZ(3) PLY_FACES(1) PLY_TRIANGLE "3 0 1 2\n", 1,
     "a.ply: the file begins with a byte order mark"},
    {"a.ply",
     "PLY\nFORMAT ASCII 1.0\nELEMENT VERTEX 3\nPROPERTY FLOAT X\nPROPERTY FLOAT Y\nPROPERTY FLOAT "
     "Z\n"
     "ELEMENT FACE 1\nPROPERTY LIST UCHAR INT VERTEX_INDICES\nEND_HEADER\n" PLY_TRIANGLE
     "3 0 1 2\n",
     1, "a.ply:1: \"PLY\" has an unusual form; it was read (and 5 more like it)"},
    {"a.ply", PLY_XYZ(3) "property uint64 id\n" PLY_FACES(1) "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n",
     1, "a.ply:7: \"uint64\" has an unusual form; it was read"},
    {"a.off", "OFF\n5 3 0\n" OFF_TRIANGLE "0 nan 0\nx 1 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n", 1,
     "a.off:6: coordinate \"nan\" is not finite; repair or remove it; it was left out (and 1 more "
     "like it)"},
    {"a.off", "OFF\n3 4 0\n" OFF_TRIANGLE "3 0 1 2\n3 0 1 3\n3 0 1 -1\n3 0 1 x\n", 1,
     "a.off:7: vertex \"3\" is out of range; there are 3 vertices, counted from 0; it was left out "
     "(and "
     "2 more like it)"},
    {"a.off", "off\n3 1 0\n" OFF_TRIANGLE "3 0 1 2\n", 1,
     "a.off:1: the keyword is in small letters"},
    {"a.off", "OFF\n3 1 0\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n", 1,
     "a.off:4: \"1,5\" has an unusual form; it was read"},
    {"a.off", "OFF\n3 1 0\n" OFF_TRIANGLE "3 0.0 1 2\n", 1,
     "a.off:6: \"0.0\" has an unusual form; it was read"},
};

static void test_bad_values(void) {
    for (size_t i = 0; i < sizeof bad_values / sizeof *bad_values; ++i) {
        burnish_mesh *mesh =
            load_text(bad_values[i].name, bad_values[i].text, bad_values[i].warning);
        const size_t found =
            mesh ? triangles_of(mesh) + (size_t)burnish_mesh_get_info(mesh)->point_count : 0;
        CHECK(found == bad_values[i].triangles, "%s: %zu triangles", bad_values[i].text, found);
    }
}

/* Files that are something else are called by their name. */
static void test_foreign(void) {
    static const struct {
        const char *name, *bytes, *what;
    } cases[] = {
        {"x", "ISO-10303-21;\nHEADER;\n", "a STEP file, which burnish can't read; convert it"},
        {"a.xml", "<?xml version=\"1.0\"?>\n<COLLADA>\n", "a COLLADA file"},
        {"a.igs", "                  S      1\n", "an IGES file"},
        {"a.bin", "what is this", "neither its name nor its first bytes"},
        {"a.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
         "a Git LFS pointer"},
        {"a.glb", "\n\n<!DOCTYPE html>\n<html>", "a.glb: a web page, which contradicts its name"},
        {"a.stl", "\r\n <html>", "a.stl: a web page, which contradicts its name"},
        {"a.obj", "ISO-10303-21;\nHEADER;\n", "a STEP file, which contradicts its name"}};
    burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh *mesh;
        burnish_error error;
        CHECK1(burnish_mesh_load_memory(cases[i].bytes, strlen(cases[i].bytes), cases[i].name,
                                        &options, &mesh, &error) == BURNISH_STATUS_FORMAT);
        CHECK(strstr(error.text, cases[i].what), "%s", error.text);
    }
}

/* ---- ZIP archives ---- */

/* Puts the parts of a list of names, which blanks separate: a1.obj has 1 triangle. */
static void put_parts(zip_list *zip, const char *names) {
    static const char scene[] =
        "{\"burnish_scene\": 1, \"items\": [{\"file\": \"a3.obj\"}, {\"file\": \"b2.obj\"}]}";
    char name[64], text[400];
    for (int size; sscanf(names, "%63s%n", name, &size) == 1; names += size) {
        const char *digit = strpbrk(name, "123456789");
        const int count = digit ? *digit - '0' : 1, is_off = strstr(name, ".off") != NULL;
        snprintf(text, sizeof text,
                 is_off ? "OFF 3 %d 0\n0 0 0\n1 0 0\n0 1 0\n"
                        : "mtllib ../m/a.mtl\nv 0 0 %d\nv 1 0 0\nv 0 1 0\nusemtl a\n",
                 count);
        for (int i = 0; i < count; ++i) {
            strcat(text, is_off ? "3 0 1 2\n" : "f 1 2 3\n");
        }
        put_part_text(zip, name, strstr(name, ".json") ? scene : text);
    }
}

/* One model is drawn, one of several is chosen by its name, and what systems add is ignored. */
static void test_archives(void) {
    static const struct {
        const char *parts, *name;
        size_t triangles;
        const char *message; /* or a warning */
    } cases[] = {
        {"x/a1.obj", "kit.zip", 1, NULL},
        {"x/a2.obj __MACOSX/x/a3.obj .b4.obj x/.c/a5.obj x/readme.txt", "a/kit.zip", 2, NULL},
        {"x/a3.obj", "standard input", 3, NULL},
        {"x/a3.obj", "part.stl", 3, NULL},
        {"x/a3.obj x/b2.obj", "kit.zip:X/B2.obj", 2, NULL},
        {"x/a3.obj y/b2.obj", "Kit.ZIP:b2.obj", 2, NULL},
        {"x/a.obj x/a.off", "kit.zip", 1, NULL},
        {"x/a3.obj x/b2.obj x/r.urdf x/s.scene.json", "kit.zip", 5, NULL},
        {"x/a3.obj x/b2.obj x/s.scene.json", "kit.zip:b2.obj", 2, NULL},
        {"x/a.obj x/s.scene.json x/t.scene.json", "kit.zip", 0,
         "kit.zip: an archive of several models (x/s.scene.json, x/t.scene.json); name one"},
        {"x/a3.obj x/b2.obj", "in/kit.zip", 0,
         "in/kit.zip: an archive of several models (x/a3.obj, x/b2.obj); name one, as in "
         "kit.zip:part.stl"},
        {"x/a3.obj y/a3.obj", "kit.zip:a3.obj", 0,
         "kit.zip:a3.obj: an archive of several models (x/a3.obj, y/a3.obj); name one"},
        {"x/a3.obj x/a3.obj x/a3.obj", "kit.zip", 3,
         "kit.zip: 3 files in the archive have one name (x/a3.obj); the first is drawn"},
        {"x/a3.obj", "kit.zip:b", 0,
         "kit.zip:b: no model of this name is in the archive (m/a.mtl, x/a3.obj); name one"},
        {"x/a.fbx .a.obj", "kit.zip", 0,
         "kit.zip: a ZIP archive without a model of a format that burnish reads in archives "
         "(m/a.mtl, x/a.fbx); name it, as in kit.zip:part.fbx, or unpack it"},
        {"a1.obj", "kit.zip", 1, "kit.zip:a1.obj:1: material library \"../m/a.mtl\" was not read"},
        {"../x/a1.obj", "kit.zip", 0, "kit.zip: a ZIP archive without a model"},
    };
    static zip_list zip;
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const char *wanted = cases[i].message;
        burnish_mesh *mesh;
        burnish_error error = {0};
        zip.size = zip.directory_size = zip.count = 0;
        put_part_text(&zip, "m/a.mtl", "newmtl a\nKd 1 0 0\n");
        put_parts(&zip, cases[i].parts);
        end_zip(&zip, 0);
        burnish_mesh_load_memory(zip.bytes, zip.size, cases[i].name, &options, &mesh, &error);
        const size_t triangles = mesh ? burnish_mesh_get_view(mesh)->triangle_count : 0;
        const char *line = burnish_mesh_get_warning_count(mesh) > 0
                               ? burnish_mesh_get_warning(mesh, 0)
                               : error.text;
        CHECK(triangles == cases[i].triangles, "%s: %zu, %s", cases[i].parts, triangles, line);
        CHECK(wanted ? strncmp(line, wanted, strlen(wanted)) == 0 : !*line, "%s: %s",
              cases[i].parts, line);
        if (mesh && !wanted) {
            const burnish_material *material = burnish_mesh_get_material(mesh, 0);
            CHECK(material->diffuse[0] == 1 && material->diffuse[1] == 0, "%s", cases[i].parts);
        }
        burnish_mesh_destroy(mesh);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_nameless_material());
    RUN(test_material_comment());
    RUN(test_library_fault());
    RUN(test_strict_build());
    RUN(test_missing_normals());
    RUN(test_obj_colors());
    RUN(test_stl_text());
    RUN(test_stl_count());
    RUN(test_ply_header());
    RUN(test_ply_lines());
    RUN(test_ply_comments());
    RUN(test_face_colors());
    RUN(test_libraries());
    RUN(test_gzip());
    RUN(test_gzip_bomb());
    RUN(test_archives());
    RUN(test_utf16());
    RUN(test_bad_values());
    RUN(test_foreign());
    return test_end("tolerant");
}
