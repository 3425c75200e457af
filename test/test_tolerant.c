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

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_nameless_material());
    RUN(test_library_fault());
    RUN(test_strict_build());
    return test_end("tolerant");
}
