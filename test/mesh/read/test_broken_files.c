/* Broken files of every kind: each ends with one line, and none crashes, hangs or takes
 * disproportionate memory. The address sanitizer also detects reads beyond the end. */
#include <sys/stat.h>
#include <unistd.h>

#include "burnish/render.h"
#include "mesh/build/normals/normals.h"
#include "mesh_arrays.h"
#include "reader_input.h"
#include "used_bytes.h"

#define PLY_VERTEX "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\n"
#define PLY_HEAD "ply\nformat ascii 1.0\n" PLY_VERTEX PLY_FACE "end_header\n"
#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define FACET "solid\nfacet normal 0 0 1\nouter loop\n"

/* ---- messages, literally ---- */

static const struct {
    const char *text, *message; /* which begins with the name of the file */
} messages[] = {
    {"", "mesh.obj: byte 0: the file is empty"},
    {"", "mesh.ply: byte 0: the file is empty"},
    {"", "mesh.stl: byte 0: the file is empty"},
    {"vn 0 0 1\n", "mesh.obj: no faces among 0 vertices; export the mesh with its faces"},
    {"v 0 0\n", "mesh.obj:1: vertex has 2 numbers; write v x y z or v x y z r g b"},
    {"\n\nv 0.5 1,500 0.5\n", /* thousands, perhaps */
     "mesh.obj:3: coordinate \"1,500\" is not a number; write it like 1.5 or -2e-3"},
    {"v 0 0 1,500,000\n",
     "mesh.obj:1: coordinate \"1,500,000\" is not a number; write it like 1.5 or -2e-3"},
    {"v 0 nan 0\n", "mesh.obj:1: coordinate \"nan\" is not finite; repair or remove it"},
    {"v 0 0 -Infinity\n",
     "mesh.obj:1: coordinate \"-Infinity\" is not finite; repair or remove it"},
    {"v 1e39 0 0\n", "mesh.obj:1: coordinate \"1e39\" is out of range; scale it to below 3.4e38"},
    {"v 0123456789012345678901234567890123456789x 0 0\n",
     "mesh.obj:1: coordinate \"0123456789012345678901234567890123456...\" is not a number; write "
     "it like 1.5 or -2e-3"},
    {TRIANGLE "f 1 2 4\n",
     "mesh.obj:4: face refers to vertex 4, but the file has 3; correct the index"},
    {TRIANGLE "f 1 2 -4\n",
     "mesh.obj:4: face refers to vertex -4, but only 3 precede it; correct the index"},
    {TRIANGLE "f 1 2 \\\n99999999999999999999\n",
     "mesh.obj:5: face refers to vertex 99999999999999999999, but the file has 3; correct the "
     "index"},
    {TRIANGLE "f 0 1 2\n", "mesh.obj:4: face refers to vertex 0; indices start at 1"},
    {TRIANGLE "f 1 2 3a\n",
     "mesh.obj:4: face corner \"3a\" is not an index; write v, v/t, v//n or v/t/n"},
    {TRIANGLE "f 1/2/3/4 2 3\n",
     "mesh.obj:4: face corner \"1/2/3/4\" is not an index; write v, v/t, v//n or v/t/n"},
    {"v 0 0 \x1b[1m\n",
     "mesh.obj:1: coordinate \"?[1m\" is not a number; write it like 1.5 or -2e-3"},

    {"hello", "mesh.stl: byte 5: the file ends within the 84 bytes of a binary STL header and is "
              "not ASCII STL; the file is truncated or not STL"},
    {"solid x\nendsolid x\n", "mesh.stl: no triangles; export the mesh again"},
    {"solid x\n", "mesh.stl: no triangles; export the mesh again"},
    {FACET "vertex 0 0 0\nver",
     "mesh.stl:5: expected \"vertex\", found the end of the file; the file is truncated"},
    {FACET "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nfacet\n",
     "mesh.stl:8: expected \"endfacet\", found \"facet\"; repair the file"},
    {FACET "vertex 0 0 0\nvertex 1 0 0\nendloop\n",
     "mesh.stl:6: expected \"vertex\", found \"endloop\"; repair the file"},
    {FACET "vertex 0 0 inf\n", "mesh.stl:4: coordinate \"inf\" is not finite; repair or remove it"},
    {"solid\nfacet normal 0 0 inner loop\nouter\n",
     "mesh.stl:3: expected \"loop\", found the end of the file; the file is truncated"},

    {"plymouth", "mesh.ply:1: expected the line \"ply\", found \"plymouth\"; check the format"},
    {"ply\nformat ascii 1.0\n",
     "mesh.ply:2: the file ends within the header; the file is truncated"},
    {"ply\nformat ascii 2.0\n", "mesh.ply:2: format version is \"2.0\"; only 1.0 exists"},
    {"ply\nformat zip 1.0\n",
     "mesh.ply:2: format \"zip\" is unknown; use ascii, binary_little_endian or binary_big_endian"},
    {"ply\nelement vertex 1152921504606846976\n",
     "mesh.ply:2: element count 1152921504606846976 is more than any file holds; correct it"},
    {"ply\nelement vertex -3\n", "mesh.ply:2: element count is \"-3\"; write element NAME COUNT"},
    {"ply\nelement vertex 3\nproperty quad x\n",
     "mesh.ply:3: property type \"quad\" is unknown; use char, uchar, short, ushort, int, uint, "
     "float or double"},
    {"ply\nelement face 3\nproperty list float int vertex_indices\n",
     "mesh.ply:3: list count type \"float\" is not an integer type; use uchar or int"},
    {"ply\nproperty float x\n",
     "mesh.ply:2: property before the first element; declare its element first"},
    {"ply\nnonsense\n", "mesh.ply:2: the file ends within the header; the file is truncated"},
    {"ply\n" PLY_VERTEX "end_header\n",
     "mesh.ply:6: the header has no format line; add \"format ascii 1.0\" or what the file is"},
    {"ply\nformat ascii 1.0\nend_header\n",
     "mesh.ply:3: the header declares no element vertex; export the mesh again"},
    {"ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n1\n",
     "mesh.ply:3: element vertex has no scalar properties x, y and z; add them"},
    {"ply\nformat ascii 1.0\n" PLY_VERTEX "element face 1\nproperty int a\nend_header\n",
     "mesh.ply:7: element face has no list property vertex_indices; add it"},
    {"ply\nformat ascii 1.0\n" PLY_VERTEX PLY_VERTEX "end_header\n",
     "mesh.ply:7: a second vertex element; merge the two"},
    {"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
     "z\nend_header\n",
     "mesh.ply: no vertices or faces; export the mesh again"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
     "mesh.ply: no face has 3 different corners; export the mesh again"},
    {PLY_HEAD "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
     "mesh.ply:11: vertex 1: coordinate y is not finite or beyond 3.4e38; repair the mesh"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 -1e300\n3 0 1 2\n",
     "mesh.ply:12: vertex 2: coordinate z is not finite or beyond 3.4e38; repair the mesh"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     "mesh.ply:13: element face, row 1: vertex index 3 is out of range; there are 3 vertices, "
     "counted from 0"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
     "mesh.ply:13: element face, row 1: vertex index -1 is out of range; there are 3 vertices, "
     "counted from 0"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n",
     "mesh.ply:13: element face, row 1: list length -1 is not a count; repair the file"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 0\n250 0 1 2\n",
     "mesh.ply:13: element face, row 1: a list of 250 values does not fit its line; the file is "
     "truncated or damaged"},
    {PLY_HEAD "0 0 0\n1 0 0\n0 1 0\n  3   0   1\n",
     "mesh.ply:13: the line ends in element face, row 1 of 1; the file is truncated"},
    {PLY_HEAD "0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n",
     "mesh.ply:10: value \"zero\" is not a number; write it like 1.5 or -2e-3"},
};

static void test_messages(void) {
    for (size_t i = 0; i < sizeof messages / sizeof *messages; ++i) {
        const char *name = messages[i].message + strlen("mesh.");
        const burnish_format format = *name == 'o'   ? BURNISH_FORMAT_OBJ
                                      : *name == 'p' ? BURNISH_FORMAT_PLY
                                                     : BURNISH_FORMAT_STL;
        burnish_status status = read_text(format, messages[i].text);
        check_fault(status, BURNISH_STATUS_FORMAT, messages[i].message);
    }
}

/* A mesh with a faulty library is still drawn. */
static void test_mtl_messages(void) {
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"Kd 1 1 1\n", "a.mtl:1: Kd before the first newmtl was ignored"},
        {"newmtl\n", "a.mtl:1: newmtl has no name; faces without a material have this one"},
        {"newmtl a\nKd 1 1\n", "a.mtl:2: Kd has 2 numbers, not 3; the statement was ignored"},
        {"newmtl a\n\nKs 1 red 1\n", "a.mtl:3: Ks \"red\" is not a number; write it like 1.5 or "
                                     "-2e-3; the statement was ignored"},
        {"newmtl a\nNs\n", "a.mtl:2: Ns has no number; the statement was ignored"},
        {"newmtl a\nNs nan\nillum x\n", "a.mtl:2: Ns \"nan\" is not finite; repair or remove it; "
                                        "the statement was ignored (and 1 more like it)"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mtl library = {0};
        burnish_error error = {0};
        char warning[300];
        CHECK_OK(read_mtl(cases[i].text, &library, warning, &error), error);
        CHECK_TEXT(warning, cases[i].message);
        burnish_mtl_destroy(NULL, &library);
    }
}

/* Messages whose bytes are binary. */
static void test_binary_messages(void) {
    byte_list stl = {.size = 0}, ply = {.size = 0};
    put_stl(&stl, "solid", 2);
    check_fault(read_bytes(BURNISH_FORMAT_STL, stl.bytes, stl.size - 1), BURNISH_STATUS_FORMAT,
                "mesh.stl: byte 80: 2 triangles are announced, but the file ends after "
                "1; it is truncated or not STL");
    memcpy(stl.bytes + 84 + 50 + 12 + 8, "\0\0\x80\x7f", 4); /* infinity as z of facet 1 */
    CHECK_OK(read_bytes(BURNISH_FORMAT_STL, stl.bytes, stl.size), fault);
    memset(stl.bytes + 84 + 12, 0xFF, 4);
    check_fault(read_bytes(BURNISH_FORMAT_STL, stl.bytes, stl.size), BURNISH_STATUS_FORMAT,
                "mesh.stl: byte 96: coordinate is not finite; repair the mesh");

    put_ply(&ply, 2);
    CHECK1(read_bytes(BURNISH_FORMAT_PLY, ply.bytes, ply.size - 1) == BURNISH_STATUS_FORMAT);
    char expected[200];
    snprintf(expected, sizeof expected,
             "mesh.ply: byte %zu: element face, row 2: a list of 3 values does not fit the rest of "
             "the file; the file is truncated or damaged",
             ply.size - 13);
    CHECK_TEXT(fault.text, expected);
}

static void test_limits(void) {
    burnish_load_options options = burnish_load_options_default();
    static const char quad[] = TRIANGLE "f 1 2 3\nf 1 2 3 1\n";
    byte_list stl = {.size = 0}, ply = {.size = 0};
    put_stl(&stl, "", 3);
    put_ply(&ply, 1);
    options.max_triangles = 2;
    check_fault(run_reader(BURNISH_FORMAT_OBJ, quad, strlen(quad), &options, NULL),
                BURNISH_STATUS_LIMIT,
                "mesh.obj:5: more than 2 triangles; raise the limit or simplify the mesh");
    check_fault(run_reader(BURNISH_FORMAT_STL, stl.bytes, stl.size, &options, NULL),
                BURNISH_STATUS_LIMIT,
                "mesh.stl: byte 80: more than 2 triangles; raise the limit or simplify the mesh");
    CHECK1(run_reader(BURNISH_FORMAT_PLY, ply.bytes, ply.size, &options, NULL) ==
           BURNISH_STATUS_LIMIT);
    options.max_triangles = 3;
    CHECK_OK(run_reader(BURNISH_FORMAT_OBJ, quad, strlen(quad), &options, NULL), fault);
}

/* ---- claims ---- */

/* Refused before memory for what is announced is requested. */
static int refuses_within_16_mib(const char *name, const byte_list *list) {
    used_bytes used;
    burnish_load_options options = burnish_load_options_default();
    burnish_context *context = make_counted(&used);
    burnish_mesh *mesh;
    options.context = context;
    const burnish_status status =
        burnish_mesh_load_memory(list->bytes, list->size, name, &options, &mesh, NULL);
    burnish_context_destroy(context);
    return status == BURNISH_STATUS_FORMAT && atomic_load(&used.most) < 16 << 20;
}

static void test_claims(void) {
    static const char *const texts[] = {
        "ply\nformat binary_little_endian 1.0\nelement vertex 80000000\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n",
        "ply\nformat ascii 1.0\nelement vertex 999999999999999999\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n1 2 3\n",
        "ply\nformat binary_big_endian 1.0\nelement a 999999999999999999\nproperty list int int b\n"
        "element vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
        "1000000000 0 0 0\n",
        "ply\nformat ascii 1.0\nelement nothing 999999999999999999\nelement vertex 0\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        byte_list list = {.size = 0};
        put_text(&list, texts[i]);
        CHECK(refuses_within_16_mib("a.ply", &list), "claim %zu", i);
    }
    byte_list stl = {.size = 0};
    put_stl(&stl, "", 0);
    stl.bytes[83] = 0x01; /* 16,777,216 triangles, 839 MB, in 100 bytes */
    put(&stl, "sixteen bytes...", 16);
    CHECK1(refuses_within_16_mib("a.stl", &stl));
    check_fault(read_text(BURNISH_FORMAT_PLY, texts[0]), BURNISH_STATUS_FORMAT,
                "mesh.ply:3: element vertex announces 80000000 rows, but the rest of "
                "the file has room for 0 at most; the file is truncated or damaged");
}

/* ---- files ---- */

static void check_load(const char *path, const burnish_load_options *options, burnish_status status,
                       const char *message) {
    burnish_mesh *scene = (burnish_mesh *)&test_checks; /* must become NULL */
    burnish_error error = {0};
    burnish_status actual = burnish_mesh_load(path, options, &scene, &error);
    CHECK(actual == status && scene == NULL, "%s: %d", path, (int)actual);
    CHECK_TEXT(error.text, message);
}

static void test_files(void) {
    burnish_load_options options = burnish_load_options_default();
    char folder[] = "/tmp/burnish-test-XXXXXX";
    if (!CHECK1(mkdtemp(folder) && chdir(folder) == 0)) {
        return;
    }
    check_load("missing.obj", &options, BURNISH_STATUS_READ,
               "missing.obj: can't be opened: No such file or directory");
    check_load(".", &options, BURNISH_STATUS_READ, ".: can't be read: Is a directory");
    test_write_file("empty.stl", "");
    check_load("empty.stl", &options, BURNISH_STATUS_FORMAT,
               "empty.stl: byte 0: the file is empty");
    test_write_file("note.txt", "hello");
    check_load("note.txt", &options, BURNISH_STATUS_FORMAT,
               "note.txt: neither its name nor its first bytes identify the format; name the input "
               "format, one of "
               "gltf, obj, off, ply, stl, 3mf, gcode, splat, spz, bms, "
               "scene, urdf, pcd, las, xyz");
    test_write_file("bad.mtl", "newmtl a\nKd x\n");
    test_write_file("bad.obj", "mtllib bad.mtl\n" TRIANGLE "f 1 2 3\n");
    options.strict = 1;
    check_load("bad.obj", &options, BURNISH_STATUS_FORMAT,
               "bad.mtl:2: Kd \"x\" is not a number; write it like 1.5 or -2e-3; the statement was "
               "ignored: rejected, as loading is strict; repair the file, or allow warnings");
    options.strict = 0;
    CHECK1(mkfifo("pipe.mtl", 0600) == 0);
    test_write_file("pipe.obj", "mtllib pipe.mtl\nf 1 2 3\n");
    check_load("pipe.obj", &options, BURNISH_STATUS_FORMAT,
               "pipe.obj:2: face refers to vertex 1, but the file has 0; correct the index");
    options.max_input_bytes = 4;
    check_load("note.txt", &options, BURNISH_STATUS_LIMIT,
               "note.txt: larger than the limit of 4 bytes; raise the limit or simplify the mesh");
    check_load("/dev/zero", &options, BURNISH_STATUS_LIMIT,
               "/dev/zero: larger than the limit of 4 bytes; raise the limit or simplify the mesh");
    options.cookie = 0;
    check_load("note.txt", &options, BURNISH_STATUS_ARGUMENT,
               "options: not initialised; start from burnish_load_options_default()");
    CHECK1(burnish_mesh_load("x", &options, NULL, NULL) == BURNISH_STATUS_ARGUMENT);
    options = burnish_load_options_default();
    check_load(NULL, &options, BURNISH_STATUS_ARGUMENT, "path: NULL; pass a path");
    remove("empty.stl"), remove("note.txt"), remove("bad.mtl"), remove("bad.obj");
    remove("pipe.mtl"), remove("pipe.obj");
    CHECK1(chdir("/") == 0 && rmdir(folder) == 0);
}

/* A name of any length leaves room for the message. */
static void test_long_name(void) {
    static char name[3000];
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *scene;
    burnish_error error = {0};
    memset(name, 'x', sizeof name - 5);
    strcpy(name + sizeof name - 5, ".obj");
    CHECK1(burnish_mesh_load_memory("v x", 3, name, &options, &scene, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK(strncmp(error.text, "...xxx", 6) == 0 &&
              strstr(error.text, "xxx.obj:1: coordinate \"x\" is not a number; write it like 1.5"),
          "%s", error.text);
    static const char line[] = "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n";
    CHECK1(burnish_mesh_load_memory(line, sizeof line - 1, name, &options, &scene, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK(strstr(error.text, "xxx.obj: no triangle has any area; 1 triangle was read"), "%s",
          error.text);
    CHECK1(burnish_mesh_load_memory(NULL, 3, "a", &options, &scene, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_mesh_load_memory(NULL, 0, "a.obj", &options, &scene, &error) ==
           BURNISH_STATUS_FORMAT);
}

/* Found by fuzzing: meshes at the limits of single precision are drawn, or rejected in one line;
 * none draws invalid numbers. */
static void test_extreme_sizes(void) {
    static const struct {
        const char *mesh;
        burnish_status status;
    } cases[] = {
        {"v 0 0 0\nv 1e-45 0 0\nv 0 1e-45 0\nf 1 2 3\n", BURNISH_STATUS_LIMIT},
        {"v 0 0 0\nv 2e-41 0 0\nv 0 1e-38 0\nf 1 2 3\n", BURNISH_STATUS_LIMIT},
        {"v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n", BURNISH_STATUS_OK},
        {"v 1e30 0 0\nv 2e30 0 0\nv 0 1e30 0\nf 1 2 3\n", BURNISH_STATUS_OK},
        {"v 3.4e38 3.4e38 3.4e38\nv -3.4e38 0 0\nv 0 -3.4e38 0\nf 1 2 3\n", BURNISH_STATUS_OK},
    };
    burnish_load_options load = burnish_load_options_default();
    load.format = BURNISH_FORMAT_OBJ;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        for (int orthographic = 0; orthographic < 2; ++orthographic) {
            burnish_framing fit = burnish_framing_default();
            burnish_render_options options = burnish_render_options_default();
            burnish_render_report report = {0};
            burnish_image image = {0};
            burnish_error error = {0};
            fit.orthographic = orthographic;
            options.width = options.height = 32;
            options.threads = 1;
            OWNED_MESH *scene = load_bytes(cases[i].mesh, strlen(cases[i].mesh), "a.obj", &load);
            CHECK_OK(burnish_camera_frame(scene, &fit, &options.camera, &error), error);
            CHECK(burnish_render(scene, &options, &image, &report, &error) == cases[i].status,
                  "%zu, %d: %s", i, orthographic, error.text);
            if (cases[i].status == BURNISH_STATUS_OK) {
                CHECK(report.covered_pixels > 50, "%zu: %zu pixels", i, report.covered_pixels);
            } else {
                CHECK(strstr(error.text, "across is too small") && !image.pixels, "%s", error.text);
            }
            burnish_image_destroy(&image);
        }
    }
}

/* Found by fuzzing: sums weighted by the angles at a needle's tip have squares below 1e-300. */
static void test_short_normals(void) {
    static const double scales[] = {1e100,  1,      1e-45,  1e-119, 1e-121,
                                    1e-150, 1e-161, 1e-200, 1e-305};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; ++i) {
        float unit[3];
        burnish_store_unit((burnish_vec3){3 * scales[i], 0, -4 * scales[i]}, unit);
        CHECK(unit[0] == 0.6f && unit[1] == 0 && unit[2] == -0.8f, "%g: %.9g %.9g %.9g", scales[i],
              (double)unit[0], (double)unit[1], (double)unit[2]);
    }
    float none[3] = {1, 1, 1};
    burnish_store_unit((burnish_vec3){0, -0.0, 0}, none);
    CHECK1(none[0] == 0 && none[1] == 0 && none[2] == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_messages());
    RUN(test_mtl_messages());
    RUN(test_binary_messages());
    RUN(test_limits());
    RUN(test_claims());
    RUN(test_files());
    RUN(test_long_name());
    RUN(test_extreme_sizes());
    RUN(test_short_normals());
    return test_end("broken_files");
}
