/* The readers of STL and PLY on well-formed files, and the way from a file to a mesh. */
#include <math.h>
#include <unistd.h>

#include "mesh_arrays.h"
#include "reader_input.h"
#include "sheet.h"

/* ---- STL ---- */

static void test_stl(void) {
    read_good_text(BURNISH_FORMAT_STL,
                   "Solid one facet\nFACET NORMAL 0 0 1\r\nouter loop\nvertex 0 0 0 vertex 1 0 0\n"
                   "vertex 0 1.5 -2e1\nendloop\nendfacet\nendsolid one\n"
                   "solid\nfacet normal nan nan nan\nouter loop\nvertex 3 0 0\nvertex 4 0 0\n"
                   "vertex 3 1 0\nendloop\nendfacet\nendsolid");
    CHECK1(got.triangle_count == 2 && got.streams[BURNISH_POSITION].count == 6 &&
           got.streams[BURNISH_NORMAL].count == 0);
    CHECK1(position_is(2, 0, 1.5f, -20) && position_is(5, 3, 1, 0));
    CHECK1(triangle_is(1, 3, 4, 5));
    /* a name is any text, also with DEL */
    read_good_text(BURNISH_FORMAT_STL,
                   "solid a\x7F\xE9\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                   "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid");
    CHECK1(got.triangle_count == 1);
}

static void test_binary_stl(void) {
    static const char *const headers[] = {"", "solid made by a CAD program",
                                          "solid x\nfacet normal"};
    for (size_t h = 0; h < 3; ++h) {
        for (size_t more = 0; more < 3; ++more) { /* bytes behind the last facet */
            byte_list list = {.size = 0};
            put_stl(&list, headers[h], 3);
            put(&list, "xyz", more);
            CHECK_OK(read_bytes(BURNISH_FORMAT_STL, list.bytes, list.size), fault);
            CHECK1(got.triangle_count == 3 && position_is(7, 3, 0, 0) &&
                   position_is(8, 2, 1, 0.5f));
            CHECK1(got.warning_count == (more > 0));
            if (more == 2 && got.warning_count == 1) {
                CHECK_TEXT(got.warnings[0],
                           "mesh.stl: byte 234: 2 bytes after the last triangle were ignored");
            }
        }
    }
}

/* Colours of facets: those with bit 15 (VisCAM, SolidView), or, where the header announces one,
 * those without it (Magics). One colour of all is the material's. */
static void test_stl_colors(void) {
    enum {
        NONE = 0x3EEF
    }; /* the attributes that put_stl() writes: not a colour unless the header says so */
    static const struct {
        const char *header;
        uint16_t attributes[3];
        uint8_t expected[3][3];
        int materials; /* the material has the colour */
    } cases[] = {
        {"", {NONE, NONE, NONE}, {{0}}, 0},
        {"", {0xFFFF, 0xFFFF, 0xFFFF}, {{0}}, 0},
        {"", {0x8000, 0x8000, 0x8000}, {{0}}, 0},
        {"",
         {0x8000 | 31 << 10 | 16, NONE, 0x8000 | 1 << 5},
         {{255, 0, 132}, {255, 255, 255}, {0, 8, 0}},
         0},
        {"", {0x8123, NONE, 0x1234}, {{0}}, 0}, /* noise */
        {"x COLOR=\x10\x20\x30\xFF",
         {31 << 10 | 16, 0x8000, 0},
         {{132, 0, 255}, {16, 32, 48}, {0, 0, 0}},
         0},
        {"COLOR=\x10\x20\x30\xFF,MATERIAL=", {0x8000, 0x8000, 0x8000}, {{16, 32, 48}}, 1},
        {"COLOR=\x10\x20\x30\xFF", {31, 31, 31}, {{255, 0, 0}}, 1},
        {"COLOR=\x10\x20\x30\xFF", {0, 0, 0}, {{16, 32, 48}}, 1},
        {"", {0x801F, 0x801F, 0x801F}, {{0, 0, 255}}, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        byte_list list = {.size = 0};
        put_stl(&list, cases[i].header, 3);
        for (size_t k = 0; k < 3; ++k) {
            list.bytes[84 + 50 * k + 48] = (uint8_t)cases[i].attributes[k];
            list.bytes[84 + 50 * k + 49] = (uint8_t)(cases[i].attributes[k] >> 8);
        }
        CHECK_OK(read_bytes(BURNISH_FORMAT_STL, list.bytes, list.size), fault);
        const int is_plain = !cases[i].materials && cases[i].expected[0][0] == 0;
        const uint8_t *rgba = burnish_colors(&got);
        CHECK(got.warning_count == 0 && got.material_count == (size_t)cases[i].materials &&
                  (rgba == NULL) == (is_plain || cases[i].materials),
              "case %zu", i);
        for (size_t corner = 0; rgba && corner < 9; ++corner) {
            CHECK(memcmp(rgba + 4 * corner, cases[i].expected[corner / 3], 3) == 0 &&
                      rgba[4 * corner + 3] == 255,
                  "case %zu, corner %zu", i, corner);
        }
        if (got.material_count == 1) {
            const uint8_t *c = cases[i].expected[0];
            CHECK(color_is(got.materials[0].diffuse, (float)c[0] / 255, (float)c[1] / 255,
                           (float)c[2] / 255) &&
                      got.materials[0].has_diffuse,
                  "case %zu", i);
        }
    }
}

/* ---- PLY ---- */

static void test_ply(void) {
    for (int encoding = 0; encoding < 3; ++encoding) {
        byte_list list = {.size = 0};
        put_ply(&list, encoding);
        CHECK(read_bytes(BURNISH_FORMAT_PLY, list.bytes, list.size) == BURNISH_STATUS_OK, "%d: %s",
              encoding, fault.text);
        CHECK1(got.streams[BURNISH_POSITION].count == 5 && got.streams[BURNISH_NORMAL].count == 5 &&
               got.triangle_count == 3);
        CHECK1(position_is(2, 1, 1, 0) && position_is(4, 0.5f, 2, -1.25f));
        CHECK1(triangle_is(0, 0, 1, 2) && triangle_is(1, 0, 2, 3) && triangle_is(2, 3, 2, 4));
        CHECK1(!got.streams[BURNISH_NORMAL].corners); /* numbered as positions are */
        CHECK1(burnish_normals(&got)[14] == 1 && burnish_normals(&got)[12] == 0);
        CHECK1(burnish_colors(&got) && burnish_colors(&got)[16] == 40 &&
               burnish_colors(&got)[17] == 80 && burnish_colors(&got)[18] == 120 &&
               burnish_colors(&got)[19] == 251);
    }
}

/* Faces before vertices, types of every kind, strips, colours as floats and 16 bits. */
static void test_ply_variants(void) {
    read_good_text(
        BURNISH_FORMAT_PLY,
        "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uint8 uint16 "
        "vertex_index\r\n"
        "element vertex 4\r\nproperty double x\r\nproperty int16 y\r\nproperty char z\r\n"
        "property float diffuse_red\r\nproperty float diffuse_green\r\n"
        "property float diffuse_blue\r\nproperty list int int extra\r\nend_header\r\n"
        "4 0 1 2 3\r\n0 0 0 0 .5 1 0\r\n2 -2 0 1 2 -1 2 7 7\r\n1 0 0 nan 0 0 0\r\n2 2 0 "
        "0 0 0 0");
    static const uint8_t colors[] = {0, 128, 255, 255, 255, 255, 0, 255,
                                     0, 0,   0,   255, 0,   0,   0, 255};
    CHECK1(got.triangle_count == 2 && got.streams[BURNISH_POSITION].count == 4 &&
           !got.streams[BURNISH_NORMAL].corners);
    CHECK1(burnish_colors(&got) && memcmp(burnish_colors(&got), colors, sizeof colors) == 0);
    for (size_t t = 0; t < got.triangle_count; ++t) { /* cut by positions that come later */
        const uint32_t *c = got.streams[BURNISH_POSITION].corners + 3 * t;
        CHECK1(triangle_area(burnish_positions(&got) + 3 * c[0], burnish_positions(&got) + 3 * c[1],
                             burnish_positions(&got) + 3 * c[2]) == 1);
    }

    read_good_text(BURNISH_FORMAT_PLY,
                   "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                   "property float z\nproperty ushort red\nproperty ushort green\n"
                   "property ushort blue\nelement tristrips 1\n"
                   "property list int int vertex_indices\nend_header\n"
                   "0 0 0 65535 0 257 1 0 0 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 0 2 0 0 0 0\n"
                   "13 0 1 2 3 4 -1 4 3 2 2 -1 0 1\n");
    CHECK(got.triangle_count == 4, "%zu", got.triangle_count);
    CHECK1(triangle_is(0, 0, 1, 2) && triangle_is(1, 2, 1, 3) && triangle_is(2, 2, 3, 4) &&
           triangle_is(3, 4, 3, 2));
    CHECK1(burnish_colors(&got) && burnish_colors(&got)[0] == 255 && burnish_colors(&got)[1] == 0 &&
           burnish_colors(&got)[2] == 1);
}

/* Attributes that the header declares only in part, or not at all, are absent. */
static void test_ply_plain(void) {
    static const char *const extra[] = {"", "property uchar red\nproperty uchar green\n",
                                        "property float nx\nproperty float nz\n"};
    for (size_t i = 0; i < 3; ++i) {
        char text[512];
        const char *row = i > 0 ? " 1 1" : "";
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\n%selement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0%s\n1 0 0%s\n0 1 0%s\n3 0 1 2\n",
                 extra[i], row, row, row);
        read_good_text(BURNISH_FORMAT_PLY, text);
        CHECK(!burnish_colors(&got) && !burnish_normals(&got) &&
                  !got.streams[BURNISH_NORMAL].corners && got.triangle_count == 1,
              "%zu", i);
    }
}

/* After "\r" line ends the body may start with a byte that looks like "\n". */
static void test_ply_line_ends(void) {
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    static const char *const lines[] = {"ply",
                                        "format binary_little_endian 1.0",
                                        "element vertex 3",
                                        "property uchar x",
                                        "property uchar y",
                                        "property uchar z",
                                        "element face 1",
                                        "property list uchar uchar vertex_indices",
                                        "end_header"};
    static const uint8_t body[] = {10, 13, 10, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2};
    for (size_t k = 0; k < 3; ++k) {
        byte_list list = {.size = 0};
        for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
            put_text(&list, lines[i]);
            put_text(&list, ends[k]);
        }
        put(&list, body, sizeof body);
        CHECK(read_bytes(BURNISH_FORMAT_PLY, list.bytes, list.size) == BURNISH_STATUS_OK, "%zu: %s",
              k, fault.text);
        CHECK1(got.triangle_count == 1 && position_is(0, 10, 13, 10));
    }
}

/* Many face elements, each with a row or two: none looks at the rest of the file. */
static void test_ply_elements(void) {
    enum { ELEMENTS = 100000, ROOM = 100 };
    char *text = malloc((size_t)ELEMENTS * ROOM);
    burnish_load_options options = burnish_load_options_default();
    burnish_tasks tasks;
    size_t size =
        (size_t)sprintf(text, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                              "property float y\nproperty float z\n");
    for (int i = 0; i < ELEMENTS; ++i) {
        size += (size_t)sprintf(text + size,
                                "element face %d\nproperty list uchar int "
                                "vertex_index\n",
                                1 + i % 2);
    }
    size += (size_t)sprintf(text + size, "end_header\n0 0 0\n1 0 0\n0 1 0\n");
    for (int i = 0; i < ELEMENTS; ++i) {
        size += (size_t)sprintf(text + size, i % 2 ? "2 0 1\n3 0 1 2\n" : "3 0 1 2\n");
    }
    burnish_tasks_begin(&tasks, NULL, 2);
    CHECK_OK(read_run(&(reader_run){BURNISH_FORMAT_PLY, text, size, &options, .tasks = &tasks}),
             fault);
    CHECK(got.triangle_count == ELEMENTS, "%zu", got.triangle_count);
    free(text);
}

/* ---- Numbers ---- */

/* Numbers of any size in a few forms, and one in eight with a character changed. */
static void say_numeral(file_bytes *f, uint64_t *random) {
    static const char *const forms[] = {"%.6e", "%.6E", "%.17g", "%.*f", "%.7e", "%g", "%+.25f"};
    const unsigned form = test_random32(random) % 7;
    const int shift = (int)(test_random32(random) % 64), places = (int)(test_random32(random) % 25);
    double value = (double)(int64_t)test_random64(random) / 4e17;
    char number[400];
    if (test_random32(random) % 2) { /* digits around 2^53 */
        value = (double)(test_random64(random) >> shift) / (1 + test_random32(random) % 100000);
    } else if (test_random32(random) % 4 == 0) {
        uint64_t bits = test_random64(random);
        memcpy(&value, &bits, sizeof value);
        value = value - value == 0 ? value : 1;
    }
    const int is_plain = form == 3 && value < 1e30 && value > -1e30;
    const int size = is_plain ? snprintf(number, sizeof number, "%.*f", places, value)
                              : snprintf(number, sizeof number, forms[form == 3 ? 0 : form], value);
    if (test_random32(random) % 8 == 0 && size < (int)sizeof number) {
        number[test_random32(random) % (unsigned)size] =
            "0123456789.-+eEx/:"[test_random32(random) % 18];
    }
    add(f, " ", 1);
    add(f, number, strlen(number));
}

/* One look at a number and a character at a time must agree. */
static void test_numbers(void) {
    uint64_t random = test_seed(5);
    file_bytes f = {0};
    size_t fast = 0, all = 0;
    while (f.size < 2500000) {
        say_numeral(&f, &random);
    }
    burnish_lexer one = burnish_lexer_open(f.bytes, f.size, 0), other = one;
    for (burnish_token a, b; burnish_lexer_token(&other, &a); ++all) {
        double x = 0, y = 0;
        burnish_number_status status, expected = burnish_parse_double(a, &y);
        int found = burnish_lexer_double(&one, &b, &x, &status);
        CHECK(found && a.bytes == b.bytes && a.size == b.size && status == expected &&
                  memcmp(&x, &y, sizeof x) == 0,
              "%.*s: %.17g %.17g", (int)a.size, (const char *)a.bytes, x, y);
        fast += one.end - a.bytes > BURNISH_DECIMAL_ROOM && burnish_scan_decimal(a.bytes, &x) > 0;
    }
    CHECK(fast > all / 2, "%zu of %zu", fast, all);
    free(f.bytes);
}

/* ---- from a file ---- */

static void test_guess(void) {
    static const struct {
        const char *bytes, *name;
        burnish_format format;
    } cases[] = {
        {"", "A.OBJ", BURNISH_FORMAT_OBJ},
        {"", "dir/a.Stl", BURNISH_FORMAT_STL},
        {"", "a.ply", BURNISH_FORMAT_PLY},
        {"ply\r\n", "a.obj", BURNISH_FORMAT_PLY},
        {"solid x", "-", BURNISH_FORMAT_STL},
        {"# hi\n\nv 0 0 0\n", NULL, BURNISH_FORMAT_OBJ},
        {"mtllib x", "obj", BURNISH_FORMAT_OBJ},
        {"GIF89a", "picture", BURNISH_FORMAT_AUTO},
        {"", "", BURNISH_FORMAT_AUTO},
        {"glTF\2 12 bytes at least", "a.obj", BURNISH_FORMAT_GLTF},
        {"\n{ \"asset\": {", NULL, BURNISH_FORMAT_GLTF},
        {"{ }", NULL, BURNISH_FORMAT_GLTF},
        {"{ }", "a.ply", BURNISH_FORMAT_PLY},
        {"v 0 0 0\n", "a.glb", BURNISH_FORMAT_OBJ},
        {"\1", "a.glb", BURNISH_FORMAT_GLTF},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_format format = burnish_guess_format((const uint8_t *)cases[i].bytes,
                                                     strlen(cases[i].bytes), cases[i].name);
        CHECK(format == cases[i].format, "case %zu: %d", i, (int)format);
    }
    byte_list list = {.size = 0};
    put_stl(&list, "anything", 2);
    CHECK1(burnish_guess_format(list.bytes, list.size, "x") == BURNISH_FORMAT_STL);
}

/* Texture coordinates and textures of faces, as MeshLab writes them, in the three encodings. Each
 * triangle has the coordinates of its corners, also in a concave square that is not cut as a fan. A
 * face with a wrong number of coordinates has 0, 0. Texture numbers out of range become one
 * additional material. */
static void put_face_rows(byte_list *list, int encoding) {
    static const float xyz[5][3] = {{0, 0, 0}, {2, 0, 0}, {0.5f, 0.5f, 0}, {0, 2, 0}, {1, 1, 1}};
    static const int faces[4][6] = {
        {4, 0, 1, 2, 3, 0}, {3, 0, 1, 4, 1}, {3, 1, 2, 4, -1}, {3, 2, 3, 4, 1}};
    for (int i = 0; i < 15; ++i) {
        put_ply_value(list, encoding, 'f', (double)xyz[i / 3][i % 3]);
    }
    for (int f = 0; f < 4; ++f) {
        const int count = faces[f][0], values = f == 3 ? 2 : 2 * count;
        put_ply_value(list, encoding, 'n', 0);
        for (int k = 0; k <= count; ++k) {
            put_ply_value(list, encoding, k == 0 ? 'c' : 'i', faces[f][k]);
        }
        put_ply_value(list, encoding, 'c', values);
        for (int k = 0; k < values; ++k) { /* u: the vertex; v: 10 times the face */
            put_ply_value(list, encoding, 'f', k % 2 == 0 ? faces[f][1 + k / 2] : 10 * f);
        }
        put_ply_value(list, encoding, 'i', faces[f][count + 1]);
    }
}

static void test_ply_face_coordinates(void) {
    static const uint16_t materials[5] = {0, 0, 1, 2, 1};
    for (int encoding = 0; encoding < 3; ++encoding) {
        byte_list list = {.size = 0};
        put_text(&list, "ply\nformat ");
        put_text(&list, ply_encodings[encoding]);
        put_text(&list, " 1.0\ncomment TextureFile a.png\ncomment TextureFile b.png\n"
                        "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                        "element face 4\nproperty list uchar int vertex_indices\n"
                        "property list uchar float texcoord\nproperty int texnumber\nend_header\n");
        put_face_rows(&list, encoding);
        if (!CHECK(read_bytes(BURNISH_FORMAT_PLY, list.bytes, list.size) == BURNISH_STATUS_OK,
                   "%s: %s", ply_encodings[encoding], fault.text)) {
            continue;
        }
        const burnish_stream *uv = &got.streams[BURNISH_TEXCOORD];
        CHECK1(got.triangle_count == 5 && uv->count == 15 && got.material_count == 3);
        CHECK1(got.triangle_materials &&
               memcmp(got.triangle_materials, materials, sizeof materials) == 0);
        for (size_t i = 0; i < 15 && uv->corners; ++i) {
            const uint32_t vertex = got.streams[BURNISH_POSITION].corners[i];
            const float *found = (const float *)uv->items + 2 * (size_t)uv->corners[i];
            const size_t face = i < 6 ? 0 : i / 3 - 1;
            const float u = face == 3 ? 0 : (float)vertex, v = face == 3 ? 0 : 10 * (float)face;
            CHECK(found[0] == u && found[1] == v, "%s, corner %zu: %g %g", ply_encodings[encoding],
                  i, (double)found[0], (double)found[1]);
        }
    }
}

/* Standard input through a pipe, in pieces that grow the buffer. */
static void test_standard_input(void) {
    burnish_load_options options = burnish_load_options_default();
    FILE *pipe =
        popen("head -c 300000 /dev/zero | tr '\\0' '#'; echo; cat " TEST_DATA_DIR "/cube.obj", "r");
    int saved = dup(STDIN_FILENO);
    if (!CHECK1(pipe && saved >= 0 && dup2(fileno(pipe), STDIN_FILENO) == STDIN_FILENO)) {
        return;
    }
    options.format = BURNISH_FORMAT_OBJ;
    OWNED_MESH *scene = load_mesh("-", &options);
    if (scene && CHECK1(burnish_mesh_get_warning_count(scene) == 1)) {
        CHECK1(burnish_mesh_get_view(scene)->triangle_count == 12);
        CHECK_TEXT(burnish_mesh_get_warning(scene, 0),
                   "standard input:3: material library \"cube.mtl\" was not read (the input has no "
                   "folder); its materials are burnish's grey");
    }
    dup2(saved, STDIN_FILENO);
    close(saved);
    pclose(pipe);
}

/* A pipe that gives more than the limit is left alone one byte after it. */
static void test_pipe_limit(void) {
    enum { LIMIT = 100000, ALL = 1000000 };
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error e = {0};
    size_t rest = 0;
    ssize_t count;
    char bytes[4096];
    FILE *pipe = popen("yes \"# a\" | head -c 1000000", "r");
    int saved = dup(STDIN_FILENO);
    if (!CHECK1(pipe && saved >= 0 && dup2(fileno(pipe), STDIN_FILENO) == STDIN_FILENO)) {
        return;
    }
    options.max_input_bytes = LIMIT;
    CHECK1(burnish_mesh_load("-", &options, &mesh, &e) == BURNISH_STATUS_LIMIT);
    while ((count = read(STDIN_FILENO, bytes, sizeof bytes)) > 0) {
        rest += (size_t)count;
    }
    CHECK(rest == ALL - LIMIT - 1, "%zu bytes were read", ALL - rest);
    dup2(saved, STDIN_FILENO);
    close(saved);
    pclose(pipe);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_stl());
    RUN(test_binary_stl());
    RUN(test_stl_colors());
    RUN(test_ply());
    RUN(test_ply_variants());
    RUN(test_ply_plain());
    RUN(test_ply_line_ends());
    RUN(test_ply_elements());
    RUN(test_numbers());
    RUN(test_guess());
    RUN(test_ply_face_coordinates());
    RUN(test_standard_input());
    RUN(test_pipe_limit());
    return test_end("readers");
}
