/* One object in all formats: the same picture, and warnings for files with wrong names. */
#include "burnish/look.h"
#include "gltf_input.h"
#include "pictures.h"
#include "threemf_input.h"

/* ---- One triangle in each format ---- */

#define FACET_TEXT                                                                                 \
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 "                      \
    "0\nendloop\nendfacet\n"
#define PLY_TEXT                                                                                   \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"                     \
    "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n"

/* The last one needs expat. */
static const struct kind {
    const char *name, *format, *shown;
    const char *text; /* of the whole file, or before the gltf_triangle; NULL: 3MF */
    int has_corners;  /* 1: as floats */
    const char *end;  /* after them, `end_size` bytes */
    size_t end_size;
} kinds[] = {
    {"text.stl", "stl", "STL", "solid a\n" FACET_TEXT "endsolid a\n", 0, "", 0},
    {"a.obj", "obj", "OBJ", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n", 0, "", 0},
    {"a.off", "off", "OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n", 0, "", 0},
    {"text.ply", "ply", "PLY", "ply\nformat ascii 1.0\n" PLY_TEXT "0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n",
     0, "", 0},
    {"a.ply", "ply", "PLY", "ply\nformat binary_little_endian 1.0\n" PLY_TEXT, 1, "\3\0\1\2", 4},
    {"a.stl", "stl", "STL", NULL, 1, "\0\0", 2},
    {"a.gltf", "gltf", "glTF", "$head$triangle,$node}", 0, "", 0},
    {"a.glb", "gltf", "glTF",
     "$head$buffer(36),'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
     "$mesh('POSITION':0),$node}",
     1, "", 0},
    {"a.3mf", "3mf", "3MF", NULL, 0, "", 0},
};
enum { ALL_KINDS = sizeof kinds / sizeof *kinds, KINDS = ALL_KINDS - !BURNISH_HAS_3MF, SIZE = 32 };

static void put_kind(byte_list *list, const struct kind *kind) {
    static byte_list binary;
    const int is_gltf = strcmp(kind->format, "gltf") == 0;
    list->size = binary.size = 0;
    if (!kind->text && !kind->has_corners) {
        zip_list *zip = begin_3mf(MODEL("<object id='1'><mesh><vertices><vertex x='0' y='0' z='0'/>"
                                        "<vertex x='1' y='0' z='0'/><vertex x='0' y='2' z='0'/>"
                                        "</vertices><triangles><triangle v1='0' v2='1' v3='2'/>"
                                        "</triangles></mesh></object>",
                                        ITEM_1));
        end_zip(zip, 0);
        put(list, zip->bytes, zip->size);
        return;
    }
    if (!kind->text) { /* binary STL: a title, a count and a normal */
        const uint8_t head[96] = {[80] = 1};
        put(list, head, sizeof head);
    } else if (is_gltf && !kind->has_corners) {
        put_json(list, kind->text);
    } else if (!is_gltf) {
        put_text(list, kind->text);
    }
    if (kind->has_corners) {
        put_floats(is_gltf ? &binary : list, 9, gltf_triangle);
    }
    if (is_gltf && kind->has_corners) {
        put_glb(list, kind->text, &binary);
    }
    put(list, kind->end, kind->end_size);
}

static burnish_mesh *load_kind(const struct kind *kind, const char *name, int strict) {
    static byte_list list;
    burnish_load_options options = burnish_load_options_default();
    options.strict = strict;
    put_kind(&list, kind);
    return load_bytes(list.bytes, list.size, name, &options);
}

/* A file without colours has the grey of the look, whatever its format; glTF states white. */
static void test_same_grey(burnish_look look) {
    static float pixels[ALL_KINDS][SIZE * SIZE * 4];
    burnish_render_options options = burnish_render_options_default();
    burnish_render_options_set_look(&options, look, NULL);
    options.width = options.height = SIZE;
    options.occlusion = 0; /* its sky depends on which way is up */
    int white = -1;
    for (int i = 0; i < KINDS; ++i) {
        OWNED_MESH *mesh = load_kind(&kinds[i], kinds[i].name, 1);
        burnish_framing framing = burnish_framing_default();
        if (!mesh) {
            continue;
        }
        framing.up[2] = 1;
        framing.direction[0] = -1;
        framing.direction[1] = -1;
        framing.direction[2] = -1;
        CHECK1(burnish_camera_frame(mesh, &framing, &options.camera, NULL) == BURNISH_STATUS_OK);
        CHECK1(burnish_look_set_materials(look, mesh, NULL) == BURNISH_STATUS_OK);
        draw_floats(mesh, &options, pixels[i], NULL);
        const int is_gltf = strcmp(kinds[i].format, "gltf") == 0;
        white = is_gltf && white < 0 ? i : white;
        const int same = is_gltf ? white : 0;
        CHECK(memcmp(pixels[i], pixels[same], sizeof *pixels) == 0, "%s, look %d: %g instead of %g",
              kinds[i].name, (int)look, (double)pixels[i][4 * (SIZE / 2 * SIZE + SIZE / 2)],
              (double)pixels[same][4 * (SIZE / 2 * SIZE + SIZE / 2)]);
    }
}

/* ---- Names ---- */

/* Under the name of each other format: read by its contents, with a warning. */
static void test_misnamed(void) {
    for (int kind = 0; kind < KINDS; ++kind) {
        for (int name = 0; name < ALL_KINDS; ++name) {
            const int is_same = strcmp(kinds[kind].format, kinds[name].format) == 0;
            OWNED_MESH *mesh = load_kind(&kinds[kind], kinds[name].name, 0);
            char expected[128];
            snprintf(expected, sizeof expected, "%s: the file is %s, not %s as its name says",
                     kinds[name].name, kinds[kind].shown, kinds[name].shown);
            if (!mesh) {
                continue;
            }
            CHECK_TEXT(burnish_format_get_info(burnish_mesh_get_info(mesh)->format)->name,
                       kinds[kind].format);
            CHECK1(burnish_mesh_get_view(mesh)->triangle_count == 1);
            if (CHECK(burnish_mesh_get_warning_count(mesh) == !is_same, "%s as %s",
                      kinds[kind].name, kinds[name].name) &&
                !is_same) {
                CHECK_TEXT(burnish_mesh_get_warning(mesh, 0), expected);
            }
        }
    }
}

/* Puts 84 + 50 * 64 + 20 bytes with a count that does not match. */
static void put_filled(byte_list *list, const char *first, size_t size, uint8_t filler,
                       uint32_t announced) {
    list->size = 0;
    put(list, first, size);
    while (list->size < 80) {
        put_bits(list, filler, 1, 0);
    }
    put_bits(list, announced, 4, 0);
    while (list->size < 84 + 50 * 64 + 20) {
        put_bits(list, filler, 1, 0);
    }
}

static void check_not_stl(const byte_list *list, burnish_format format, const char *text) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    burnish_error error = {0};
    options.format = format;
    CHECK1(burnish_mesh_load_memory(list->bytes, list->size, "a.stl", &options, &mesh, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK(strstr(error.text, text), "%s", error.text);
    burnish_mesh_destroy(mesh);
}

/* Other files called .stl: named by their first bytes, even if what follows could be facets. */
static void test_foreign(void) {
    static const struct {
        const char *first;
        size_t size;
        const char *what;
    } cases[] = {{"%PDF-1.7\n\1", 10, "a.stl: a PDF document, which contradicts its name"},
                 {"\211PNG\r\n\032\n", 8, "a.stl: a PNG picture, which"},
                 {"\377\330\377\340", 4, "a.stl: a JPEG picture, which"},
                 {"RIFF\0\0\0\0WEBPVP8 ", 16, "a.stl: a WebP picture, which"},
                 {"7z\274\257\047\034", 6, "a.stl: a 7-Zip archive, which"},
                 {"Rar!\032\007\1\0", 8, "a.stl: a RAR archive, which"},
                 {"\3757zXZ\0", 6, "a.stl: a file packed by xz, which"},
                 {"(\265/\375\4", 5, "a.stl: a file packed by zstd, which"},
                 {"\211HDF\r\n\032\n", 8, "a.stl: an HDF5 file, which"},
                 {"\320\317\021\340\241\261\032\341", 8, "a.stl: an OLE file"}};
    static byte_list list;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        put_filled(&list, cases[i].first, cases[i].size, 0x40, 64); /* coordinates of 3 */
        check_not_stl(&list, BURNISH_FORMAT_AUTO, cases[i].what);
    }
}

/* A brace alone does not make JSON of a file with another name. */
static void test_brace(void) {
    static byte_list list;
    list.size = 0;
    put_text(&list,
             "{ a comment of Pascal, and no mesh, but as many bytes as an STL's header has }\n"
             "program a;\nbegin\nend.\n");
    check_not_stl(&list, BURNISH_FORMAT_AUTO, "text that does not begin with \"solid\"");
}

/* Bytes that are not facets, whatever the first bytes are. If the bytes are facets, a wrong count
 * is a warning, whatever the title says. */
static void test_garbage(void) {
    static const char refusal[] = "byte 80: not STL: the count does not fit the file's size, and ";
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    burnish_error error = {0};
    static byte_list list;
    put_filled(&list, "\1", 1, 0xFF, 64); /* not numbers */
    check_not_stl(&list, BURNISH_FORMAT_STL, refusal);
    put_filled(&list, "\1", 1, 0x01, 64); /* 2e-38 */
    check_not_stl(&list, BURNISH_FORMAT_STL, refusal);
    put_filled(&list, "\1", 1, 0x7E, 3); /* 8e37 */
    check_not_stl(&list, BURNISH_FORMAT_STL, refusal);
    for (int odd = 0; odd < 4; ++odd) { /* of 8 facets: 2 with a tiny coordinate may be rounding */
        list.size = 0;
        put_stl(&list, "MZ, exported", 8);
        put(&list, "behind", 6);
        for (int i = 0; i < odd; ++i) {
            memcpy(list.bytes + 84 + 50 * i + 12 + 8, "\1\0\0\0", 4);
        }
        error = (burnish_error){0};
        const burnish_status status =
            burnish_mesh_load_memory(list.bytes, list.size, "a.stl", &options, &mesh, &error);
        CHECK(status == (odd > 2 ? BURNISH_STATUS_FORMAT : BURNISH_STATUS_OK), "%d odd: %s", odd,
              error.text);
        CHECK1(odd > 2 || burnish_mesh_get_warning_count(mesh) == 1);
        burnish_mesh_destroy(mesh);
    }
    list.size = 0;
    put_stl(&list, "a part", 8); /* the count matches: tiny numbers are accepted */
    for (int i = 0; i < 8; ++i) {
        memcpy(list.bytes + 84 + 50 * i + 12 + 8, "\1\0\0\0", 4);
    }
    mesh = load_bytes(list.bytes, list.size, "a.stl", NULL);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_same_grey(BURNISH_LOOK_STUDIO));
    RUN(test_same_grey(BURNISH_LOOK_TECHNICAL));
    RUN(test_same_grey(BURNISH_LOOK_PLAIN));
    RUN(test_misnamed());
    RUN(test_foreign());
    RUN(test_brace());
    RUN(test_garbage());
    return test_end("formats");
}
