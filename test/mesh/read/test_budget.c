/* Small inputs that expand: one rule for all readers rejects them before memory is allocated, for
 * any number of threads. Plain files are drawn. */
#include "mesh/read/io/budget.h"
#include "mesh/read/read.h"
#include "sheet.h"
#include "support.h"
#include "used_bytes.h"

#define GLTF_HEAD "{'asset':{'version':'2.0'},"

/* Text with ' for ", which is readable in C. */
__attribute__((format(printf, 2, 3))) static void put_json(file_bytes *list, const char *format,
                                                           ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c; ++c) {
        add(list, *c == '\'' ? "\"" : c, 1);
    }
}

/* ---- Files ---- */

/* Loads on one thread; *most: the largest sum of memory at any time. */
static burnish_status load(const file_bytes *file, const char *name, burnish_load_options options,
                           size_t *most, size_t *triangles, burnish_error *error) {
    used_bytes memory;
    burnish_context *context = make_counted(&memory);
    burnish_mesh *mesh;
    options.context = context;
    options.threads = 1;
    *error = (burnish_error){0};
    const burnish_status status =
        burnish_mesh_load_memory(file->bytes, file->size, name, &options, &mesh, error);
    *triangles = status == BURNISH_STATUS_OK ? burnish_mesh_get_view(mesh)->triangle_count : 0;
    burnish_mesh_destroy(mesh);
    *most = memory.most;
    burnish_context_destroy(context);
    CHECK(memory.now == 0, "%s: %zu bytes lost", name, memory.now);
    return status;
}

/* A GLB whose primitives of a mode share some points. */
static file_bytes make_shared(int mode, int points, int times) {
    file_bytes json = {0}, binary = {0}, list = {0};
    const uint32_t size = 12 * (uint32_t)points;
    put_json(&json,
             GLTF_HEAD "'scene':0,'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],'buffers':[{"
                       "'byteLength':%u}],'bufferViews':[{'buffer':0,'byteLength':%u}],",
             size, size);
    put_json(&json,
             "'accessors':[{'bufferView':0,'componentType':5126,'count':%d,'type':'VEC3'}],"
             "'meshes':[{'primitives':[",
             points);
    for (int i = 0; i < times; ++i) {
        put_json(&json, "%s{'mode':%d,'attributes':{'POSITION':0}}", i ? "," : "", mode);
    }
    put_json(&json, "]}]}");
    for (int i = 0; i < 3 * points; ++i) {
        add_float(&binary, (double)((uint32_t)i * (uint32_t)i % 1009), 0, 0);
    }
    add_glb(&list, &json, &binary);
    free(json.bytes);
    free(binary.bytes);
    return list;
}

/* Points count as a vertex and a triangle, lines as their prisms; a limit of triangles replaces the rule. */
static void test_solids(void) {
    enum { POINTS = 900, MUCH = 16 << 20 };
    static const struct {
        int mode, times;
        burnish_status status;
        const char *kind;
    } cases[] = {{0, 3000, BURNISH_STATUS_LIMIT, "points: 900 * 3000 * (1 + 1)"},
                 {3, 250, BURNISH_STATUS_LIMIT, "lines: 899 * 250 * 32"},
                 {4, 4500, BURNISH_STATUS_LIMIT, "triangles: 900 * 4500 * (1 + 1 / 3)"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_load_options options = burnish_load_options_default();
        burnish_error error;
        size_t most, triangles;
        file_bytes list = make_shared(cases[i].mode, POINTS, cases[i].times);
        const burnish_status status = load(&list, "a.glb", options, &most, &triangles, &error);
        CHECK(status == cases[i].status && strstr(error.text, "become more than 5242880 vertices "),
              "%s: %d %s", cases[i].kind, (int)status, error.text);
        CHECK(most < MUCH, "%s: %zu bytes", cases[i].kind, most);
        free(list.bytes);
    }
    burnish_load_options options = burnish_load_options_default();
    burnish_error error;
    size_t most, triangles;
    file_bytes list = make_shared(3, POINTS, 250);
    options.max_triangles = 16 * 250 * POINTS;
    CHECK(load(&list, "a.glb", options, &most, &triangles, &error) == BURNISH_STATUS_OK &&
              triangles > 2000000,
          "%zu triangles, %s", triangles, error.text);
    free(list.bytes);
    list = make_shared(4, POINTS, 10);
    options.max_triangles = 1000;
    CHECK1(load(&list, "a.glb", options, &most, &triangles, &error) == BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text, "a.glb: more than 1000 triangles; raise the limit or simplify the mesh");
    free(list.bytes);
}

/* A face or strip of so many corners is rejected while its corners are counted. */
static void test_faces(void) {
    enum { CORNERS = 6000000, MUCH = 200 << 20 };
    static const char *const heads[] = {
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n6000000",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
        "property char z\nelement face 1\nproperty list uint uchar vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n6000000"};
    static const char *const names[] = {"a.obj", "a.off", "a.ply"};
    static const int firsts[] = {1, 0, 0};
    for (size_t i = 0; i < 3; ++i) {
        file_bytes list = {0};
        add(&list, heads[i], strlen(heads[i]));
        for (int k = 0; k < CORNERS; ++k) {
            const char corner[3] = {' ', (char)('0' + firsts[i] + k % 3), 0};
            add(&list, corner, 2);
        }
        add(&list, "\n", 1);
        burnish_load_options options = burnish_load_options_default();
        char line[200];
        burnish_mesh_data data;
        burnish_error error;
        /* as if unpacked from gzip: few bytes count */
        const burnish_reader_input input = {.bytes = list.bytes,
                                            .size = list.size,
                                            .packed_size = 40000,
                                            .name = names[i],
                                            .options = &options};
        used_bytes memory;
        burnish_context *context = make_counted(&memory);
        data = burnish_mesh_data_begin(context, NULL, &error);
        burnish_reader reader = {.input = &input, .mesh = &data, .error = &error};
        burnish_format format = BURNISH_FORMAT_AUTO;
        CHECK(burnish_read(&reader, &format) == BURNISH_STATUS_LIMIT, "%s", names[i]);
        snprintf(line, sizeof line,
                 "%s: its 40000 bytes become more than 5242880 vertices and triangles; set "
                 "--max-triangles to draw them, or unpack the file first",
                 names[i]);
        CHECK_TEXT(error.text, line);
        burnish_mesh_data_destroy(&data);
        CHECK(memory.most < MUCH, "%s: %zu bytes", names[i], memory.most);
        burnish_context_destroy(context);
        free(list.bytes);
    }
}

/* ---- Companions ---- */

typedef struct self_folder {
    file_bytes *file;
    size_t asked, now, most;
} self_folder;

static burnish_status give_self(void *user_data, const char *name, uint64_t max_bytes,
                                const void **bytes, size_t *size, burnish_error *error) {
    self_folder *folder = user_data;
    (void)name, (void)max_bytes, (void)error;
    ++folder->asked;
    folder->now += folder->file->size;
    folder->most = folder->now > folder->most ? folder->now : folder->most;
    *bytes = folder->file->bytes;
    *size = folder->file->size;
    return BURNISH_STATUS_OK;
}

static void release_self(void *user_data, const void *bytes, size_t size) {
    (void)bytes;
    ((self_folder *)user_data)->now -= size;
}

/* A file that is its own buffers, by names that mean the same file. */
static file_bytes make_self(int buffers, size_t size) {
    static const char *const aliases[] = {"", "./", ".//./"};
    file_bytes list = {0};
    put_json(&list, GLTF_HEAD "'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],'buffers':[");
    for (int i = 0; i < buffers; ++i) {
        put_json(&list, "%s{'byteLength':36,'uri':'%sself.gltf'}", i ? "," : "", aliases[i % 3]);
    }
    put_json(&list, "],'bufferViews':[");
    for (int i = 0; i < buffers; ++i) {
        put_json(&list, "%s{'buffer':%d,'byteLength':36}", i ? "," : "", i);
    }
    put_json(&list, "],'accessors':[");
    for (int i = 0; i < buffers; ++i) {
        put_json(&list, "%s{'bufferView':%d,'componentType':5126,'count':3,'type':'VEC3'}",
                 i ? "," : "", i);
    }
    put_json(&list, "],'meshes':[{'primitives':[");
    for (int i = 0; i < buffers; ++i) {
        put_json(&list, "%s{'attributes':{'POSITION':%d}}", i ? "," : "", i);
    }
    put_json(&list, "]}]}");
    while (list.size < size) {
        add(&list, " ", 1);
    }
    return list;
}

static void test_self(void) {
    enum { BUFFERS = 700, SIZE = 1 << 20, TIMES = 64 };
    file_bytes list = make_self(BUFFERS, SIZE);
    self_folder folder = {.file = &list};
    burnish_load_options options = burnish_load_options_default();
    burnish_error error;
    size_t most, triangles;
    options.referenced_files = (burnish_file_loader){give_self, release_self, &folder};
    CHECK1(load(&list, "self.gltf", options, &most, &triangles, &error) == BURNISH_STATUS_LIMIT);
    CHECK(strstr(error.text, "self.gltf too often; let buffers share it"), "%s", error.text);
    /* once as a file, and again as often as TIMES the input and that file allow */
    CHECK(folder.asked == 1 + 2 * TIMES + 1 && folder.now == 0, "%zu", folder.asked);
    free(list.bytes);
}

static void test_keys(void) {
    static const char *const same[] = {"a/b.png", "./a/b.png", "a//b.png", "A/./B.png", "a\\b.PNG"};
    static const char *const other[] = {"a/b.pn", "ab.png", "a/bpng", "b/a.png", "", "a"};
    for (size_t i = 0; i < sizeof same / sizeof *same; ++i) {
        CHECK(burnish_companion_key(same[i]) == burnish_companion_key(same[0]), "%s", same[i]);
    }
    for (size_t i = 0; i < sizeof other / sizeof *other; ++i) {
        CHECK(burnish_companion_key(other[i]) != burnish_companion_key(same[0]), "%s", other[i]);
    }
}

/* ---- Many triangles at a vertex ---- */

/* Strips of the same points: 3.6 million corners meet in a few vertices, or 5.4 million. */
static void test_crowded(void) {
    enum { STRIP = 5, POINTS = 30000 };
    burnish_load_options options = burnish_load_options_default();
    burnish_error error;
    size_t most, triangles;
    file_bytes few = make_shared(STRIP, POINTS, 40), many = make_shared(STRIP, POINTS, 60);
    CHECK_OK(load(&few, "few.glb", options, &most, &triangles, &error), error);
    CHECK1(triangles > 0);
    CHECK1(load(&many, "many.glb", options, &most, &triangles, &error) == BURNISH_STATUS_LIMIT);
    CHECK(strstr(error.text, "many.glb: too many triangles meet in the same vertices: "), "%s",
          error.text);
    options.max_triangles = 10000000;
    CHECK_OK(load(&many, "many.glb", options, &most, &triangles, &error), error);
    free(few.bytes);
    free(many.bytes);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_solids());
    RUN(test_faces());
    RUN(test_self());
    RUN(test_keys());
    RUN(test_crowded());
    return test_end("budget");
}
