/* Loading with options and a context: allocations fail, calls are cancelled, and the caller's
 * floating-point environment has no effect. Large files are read in pieces. */
#include <fcntl.h>
#include <unistd.h>

#include "burnish/mesh.h"
#include "counting_context.h"
#include "mesh/read/io/streaming.h"
#include "mesh_arrays.h"
#include "sheet.h"
#include "used_bytes.h"

static const char OBJ[] = "mtllib paint.mtl\nmtllib none.mtl\n"
                          "v 0.1 0.2 0.3\nv 1.7 0 1e-40\nv 0 1.3 0.7\nv 1 1 0.33333333333\n"
                          "vt 0.1 0.2\nvt 0.9 0.1\nvt 0.3 0.7\nvt 1 1\nusemtl red\n"
                          "f 1/1 2/2 3/3\nf 2/4 4/4 3/3\nf 1 1 2\n";
static const char MTL[] = "newmtl red\nKd 1 0.25 0.1\nNs 30.3\n";
static const char PLY[] = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                          "property float y\nproperty float z\nproperty uchar red\n"
                          "property uchar green\nproperty uchar blue\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n"
                          "0.1 0 0 1 2 3\n1.1 0.3 0 4 5 6\n1 1 0.7 7 8 9\n0 1 1e-41 9 9 9\n"
                          "4 0 1 2 3\n";
static const char STL[] =
    "solid\nfacet normal 0 0 0\nouter loop\nvertex 0.1 0 0.3\nvertex 1 0.7 0\n"
    "vertex 0 0.123456789 1\nendloop\nendfacet\nendsolid\n";

static const struct {
    const char *name, *text; /* text NULL: built in */
    size_t size;
} inputs[] = {{"a.obj", OBJ, sizeof OBJ - 1},
              {"a.ply", PLY, sizeof PLY - 1},
              {"a.stl", STL, sizeof STL - 1},
              {":torus", NULL, 0}};
enum { INPUTS = sizeof inputs / sizeof *inputs };

/* ---- Files that the input names ---- */

typedef struct library {
    int loads, releases;
} library;

static burnish_status load_library(void *user_data, const char *name, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    library *l = user_data;
    if (strcmp(name, "paint.mtl") != 0) {
        error->status = BURNISH_STATUS_READ;
        snprintf(error->text, sizeof error->text, "%s: not in the box", name);
        return BURNISH_STATUS_READ;
    }
    CHECK1(max_bytes >= sizeof MTL);
    ++l->loads;
    *bytes = MTL;
    *size = sizeof MTL - 1;
    return BURNISH_STATUS_OK;
}

static void release_library(void *user_data, const void *bytes, size_t size) {
    CHECK1(bytes == MTL && size == sizeof MTL - 1);
    ++((library *)user_data)->releases;
}

static burnish_status load(int input, const burnish_load_options *options, burnish_mesh **mesh,
                           burnish_error *error) {
    return inputs[input].text ? burnish_mesh_load_memory(inputs[input].text, inputs[input].size,
                                                         inputs[input].name, options, mesh, error)
                              : burnish_mesh_load(inputs[input].name, options, mesh, error);
}

static burnish_load_options options_of(library *box, const burnish_context *context) {
    burnish_load_options options = burnish_load_options_default();
    *box = (library){0};
    options.tessellation = 4;
    options.keep_texture_coordinates = 1;
    options.context = context;
    options.referenced_files = (burnish_file_loader){load_library, release_library, box};
    return options;
}

/* ---- Contexts ---- */

static burnish_status make_input(const void *data, const burnish_load_options *options,
                                 burnish_mesh **mesh, burnish_error *error) {
    library box;
    const burnish_load_options own = options_of(&box, options->context);
    const burnish_status status = load(*(const int *)data, &own, mesh, error);
    CHECK(box.loads == box.releases, "%d files loaded, %d released", box.loads, box.releases);
    return status;
}

static void test_stopped(int input) {
    check_failures(make_input, &input, 0, 0);
    check_failures(make_input, &input, 0, 1);
}

static void test_log(void) {
    counts c;
    library box;
    burnish_context *context = make_context(&c);
    const burnish_load_options options = options_of(&box, context);
    burnish_mesh *mesh = NULL;
    CHECK1(load(0, &options, &mesh, NULL) == BURNISH_STATUS_OK);
    const size_t count = burnish_mesh_get_warning_count(mesh);
    CHECK(count == 1 && c.lines == 1, "%zu warnings, %d lines", count, c.lines);
    CHECK_TEXT(c.last_line, burnish_mesh_get_warning(mesh, count - 1));
    burnish_mesh_destroy(mesh);
    burnish_context_destroy(context);
}

/* ---- The floating-point environment ---- */

static void test_environment(int input) {
    library box;
    const burnish_load_options options = options_of(&box, NULL);
    burnish_mesh *first = NULL;
    for (int mode = 0; mode < 8; ++mode) {
        burnish_mesh *mesh = NULL;
        set_mode(mode);
        const unsigned before = control_bits();
        const burnish_status status = load(input, &options, &mesh, NULL);
        const unsigned after = control_bits();
        set_mode(0);
        CHECK(status == BURNISH_STATUS_OK && before == after, "%s, mode %d", inputs[input].name,
              mode);
        first = first ? first : mesh;
        CHECK(first && same_meshes(first, mesh) &&
                  memcmp(burnish_mesh_get_material(first, 0), burnish_mesh_get_material(mesh, 0),
                         sizeof(burnish_material)) == 0,
              "%s, mode %d: another mesh", inputs[input].name, mode);
        if (mesh != first) {
            burnish_mesh_destroy(mesh);
        }
    }
    burnish_mesh_destroy(first);
}

/* A cube from -1 to 1 or an octahedron around it, whose file gives each vertex one normal, away from
 * the middle. */
static const char SMOOTH_CUBE[] =
    "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
    "vn -1 -1 -1\nvn 1 -1 -1\nvn -1 1 -1\nvn 1 1 -1\nvn -1 -1 1\nvn 1 -1 1\nvn -1 1 1\n"
    "vn 1 1 1\nf 1//1 3//3 4//4 2//2\nf 5//5 6//6 8//8 7//7\nf 1//1 2//2 6//6 5//5\n"
    "f 3//3 7//7 8//8 4//4\nf 1//1 5//5 7//7 3//3\nf 2//2 4//4 8//8 6//6\n";

/* The same cube. */
#define SMOOTH_GLTF(material)                                                                      \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"       \
    "\"mesh\":0}],"                                                                                \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0},\"indices\":1,"    \
    "\"material\":0}]}],\"materials\":[{\"name\":\"m\"" material "}],\"textures\":[{}],"           \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","       \
    "\"min\":[-1,-1,-1],\"max\":[1,1,1]},{\"bufferView\":1,\"componentType\":5121,\"count\":36,"   \
    "\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},{\"buffer\":0,"       \
    "\"byteOffset\":96,\"byteLength\":36}],\"buffers\":[{\"byteLength\":132,\"uri\":"              \
    "\"data:application/octet-stream;base64,"                                                      \
    "AACAvwAAgL8AAIC/AACAPwAAgL8AAIC/AACAvwAAgD8AAIC/AACAPwAAgD8AAIC/AACAvwAAgL8AAIA/AACA"         \
    "PwAAgL8AAIA/AACAvwAAgD8AAIA/AACAPwAAgD8AAIA/AAIDAAMBBAUHBAcGAAEFAAUEAgYHAgcDAAQGAAYC"         \
    "AQMHAQcF"                                                                                     \
    "\"}]}"

/* Six sides with a round top: every normal is 45 degrees or more off some face, but no edge of the
 * cone is sharp. */
static const char SMOOTH_CONE[] =
    "v 0 0 2\nv 2 0 0\nv 1 1.73205 0\nv -1 1.73205 0\nv -2 0 0\nv -1 -1.73205 0\n"
    "v 1 -1.73205 0\nvn 0 0 1\nvn 1 0 1\nvn 0.5 0.866 1\nvn -0.5 0.866 1\nvn -1 0 1\n"
    "vn -0.5 -0.866 1\nvn 0.5 -0.866 1\nf 1//1 2//2 3//3\nf 1//1 3//3 4//4\n"
    "f 1//1 4//4 5//5\nf 1//1 5//5 6//6\nf 1//1 6//6 7//7\nf 1//1 7//7 2//2\n";

static void check_normals(const char *text, const char *name, burnish_normals_source normals,
                          double angle, size_t vertices, const char *warning) {
    burnish_load_options options = burnish_load_options_default();
    options.normals = normals;
    options.crease_angle = angle;
    OWNED_MESH *mesh = load_bytes(text, strlen(text), name, &options);
    if (mesh) {
        const size_t count = burnish_mesh_get_view(mesh)->vertex_count;
        const char *found = burnish_mesh_get_warning(mesh, 0);
        CHECK(count == vertices, "%zu vertices, not %zu", count, vertices);
        CHECK(warning ? found && strstr(found, warning) : !found, "warning: %s",
              found ? found : "none");
    }
}

/* Own normals give a corner of the cube three vertices; those of the file one. */
static void test_normals_source(void) {
    const burnish_normals_source automatic = BURNISH_NORMALS_AUTO, file = BURNISH_NORMALS_FILE;
    const double no_angle = BURNISH_CREASE_AUTO;
    check_normals(SMOOTH_CUBE, "a.obj", automatic, no_angle, 24, "the sharp edges of 100 %");
    check_normals(SMOOTH_CUBE, "a.obj", file, no_angle, 8, NULL);
    check_normals(SMOOTH_CUBE, "a.obj", BURNISH_NORMALS_OWN, no_angle, 24, NULL);
    check_normals(SMOOTH_CUBE, "a.obj", automatic, 80, 24, NULL);
    check_normals(SMOOTH_CUBE, "a.obj", automatic, 100, 8, NULL);
    check_normals(SMOOTH_CUBE, "a.obj", file, 80, 8, "the crease angle has no effect");
    check_normals(SMOOTH_GLTF(""), "a.gltf", automatic, no_angle, 24, "the sharp edges of 100 %");
    check_normals(SMOOTH_GLTF(",\"normalTexture\":{\"index\":0}"), "a.gltf", automatic, no_angle, 8,
                  NULL);
    check_normals(SMOOTH_CONE, "a.obj", automatic, no_angle, 7, NULL);
}

/* ---- Files that are read in pieces ---- */

static char path[4096];

/* The most that a context hands out while the file is loaded, from its path or from memory. */
static size_t peak_of(const file_bytes *file, int is_in_pieces) {
    used_bytes used;
    burnish_load_options options = burnish_load_options_default();
    burnish_context *context = make_counted(&used);
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    used.refused = is_in_pieces ? file->size : 0;
    options.context = context;
    options.threads = 1;
    CHECK((is_in_pieces ? burnish_mesh_load(path, &options, &mesh, &error)
                        : burnish_mesh_load_memory(file->bytes, file->size, path, &options, &mesh,
                                                   &error)) == BURNISH_STATUS_OK,
          "%s", error.text);
    burnish_mesh_destroy(mesh);
    burnish_context_destroy(context);
    return atomic_load(&used.most);
}

/* A file that is cut when the call first asks whether to go on. */
static int cut_file(void *user_data) {
    CHECK1(truncate(path, *(const off_t *)user_data) == 0);
    return 0;
}

static void check_cut(const file_bytes *file) {
    for (off_t size = 0; size < 200000; size += 70000) {
        burnish_context_options made = burnish_context_options_default();
        burnish_load_options options = burnish_load_options_default();
        burnish_mesh *mesh = NULL;
        burnish_error error = {0};
        burnish_context *context = NULL;
        save_bytes(path, file);
        made.cancelled = cut_file;
        made.cancelled_user_data = &size;
        CHECK1(burnish_context_create(&made, &context, NULL) == BURNISH_STATUS_OK);
        options.context = context;
        options.threads = 1;
        const burnish_status status = burnish_mesh_load(path, &options, &mesh, &error);
        CHECK(status == BURNISH_STATUS_FORMAT && strstr(error.text, "truncated"),
              "cut to %ld bytes: %d, %s", (long)size, (int)status, error.text);
        burnish_mesh_destroy(mesh);
        burnish_context_destroy(context);
    }
}

static burnish_status load_path(const void *data, const burnish_load_options *options,
                                burnish_mesh **mesh, burnish_error *error) {
    return burnish_mesh_load(data, options, mesh, error);
}

/* A file that is loaded from its path takes its head or window more than from memory, where its
 * bytes are the caller's and not counted, and no array has its size. By one thread: the peak of
 * several depends on which of them work at the same time. */
static void test_pieces(void) {
    const sheet s = {.side = 100, .normals = 1, .colors = 1, .newline = "\n", .end = "endsolid\n"};
    for (int i = 0; i < 4; ++i) {
        file_bytes file = {0};
        if (i == 0) {
            write_binary_ply(&file, &s, &(ply_layout){"uchar", "int", 1, 4, 0, 0});
        } else if (i == 1) {
            write_binary_stl(&file, &s, "a part");
        } else {
            (i == 2 ? write_ply : write_stl)(&file, &s);
        }
        save_bytes(path, &file);
        const size_t pieces = peak_of(&file, 1), whole = peak_of(&file, 0);
        CHECK(pieces <= whole + BURNISH_STREAMED_HEAD,
              "file %d of %zu bytes takes %zu, from memory %zu", i, file.size, pieces, whole);
        if (i < 2) {
            check_failures(load_path, path, 2, 0);
        }
        if (i != 2) { /* a text of rows may end early with another message */
            check_cut(&file);
        }
        free(file.bytes);
    }
}

/* A descriptor is read to its end; one that is elsewhere than at the beginning from there. */
static void test_descriptor(void) {
    file_bytes file = {0};
    write_binary_stl(&file, &(sheet){.side = 100}, "a part");
    save_bytes(path, &file);
    const int descriptor = open(path, O_RDONLY);
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    CHECK_OK(burnish_mesh_load_descriptor(descriptor, "a", &options, &mesh, &error), error);
    CHECK1(lseek(descriptor, 0, SEEK_CUR) == (off_t)file.size);
    burnish_mesh_destroy(mesh);
    CHECK1(lseek(descriptor, 50, SEEK_SET) == 50);
    CHECK(burnish_mesh_load_descriptor(descriptor, "a", &options, &mesh, &error) !=
              BURNISH_STATUS_OK,
          "the end of a file was read as all of it");
    burnish_mesh_destroy(mesh);
    CHECK1(close(descriptor) == 0);
    free(file.bytes);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    snprintf(path, sizeof path, TEST_BINARY_DIR "/load-%d.stl", (int)getpid());
    RUN(test_log());
    RUN(test_normals_source());
    for (int i = 0; i < INPUTS; ++i) {
        RUN(test_stopped(i));
        RUN(test_environment(i));
    }
    RUN(test_pieces());
    RUN(test_descriptor());
    unlink(path);
    return test_end("load");
}
