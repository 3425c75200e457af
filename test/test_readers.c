/* The readers of OBJ, MTL, STL and PLY on well-formed files, and the way from a file to a scene. */
#include <float.h>
#include <math.h>
#include <unistd.h>

#include "core/srgb.h"
#include "decimal_comma.h"
#include "mesh/read/chunks.h"
#include "reader_input.h"

/* ---- numbers ---- */

/* A decimal of one of the shapes that files hold, and of some that they should not. */
static void random_decimal(uint64_t *state, char *out, size_t size) {
    uint64_t shape = test_random64(state) % 6;
    double value;
    uint64_t bits = test_random64(state);
    switch (shape) {
    case 0:
        snprintf(out, size, "%.*f", (int)(bits % 9), (double)(int64_t)bits / 1e16);
        break;
    case 1:
        snprintf(out, size, "%.*e", (int)(bits % 20), (double)(bits >> 11) * 1e-9);
        break;
    case 2: /* any double at all */
        memcpy(&value, &bits, sizeof value);
        snprintf(out, size, "%.17g", isfinite(value) ? value : 0.1);
        break;
    case 3:
        snprintf(out, size, "%s%llu.%llue%d", bits & 1 ? "-" : "+", (unsigned long long)bits % 1000,
                 (unsigned long long)test_random64(state), (int)(bits % 660) - 330);
        break;
    case 4:
        snprintf(out, size, "%lld.%0*d%llu", (long long)(int64_t)bits >> 40, (int)(bits % 60), 0,
                 (unsigned long long)test_random64(state));
        break;
    default: /* halfway between two doubles: 2^53 + 1 + 2k, exactly and with a tail */
        snprintf(out, size, "%llu%s",
                 (unsigned long long)(UINT64_C(9007199254740993) + (bits & 1022)),
                 bits & 1024 ? ".0000000000000000000000000000001" : "");
    }
}

static burnish_token token_of(const char *text) {
    return (burnish_token){(const uint8_t *)text, strlen(text)};
}

static void check_number(const char *text) {
    double value = 0, expected = strtod(text, NULL);
    burnish_number_status status = burnish_parse_double(token_of(text), &value);
    if (isinf(expected)) {
        CHECK(status == BURNISH_NUMBER_RANGE, "%s", text);
    } else {
        CHECK(status == BURNISH_NUMBER_OK && memcmp(&value, &expected, sizeof value) == 0,
              "%s: %a, strtod %a", text, value, expected);
    }
}

static void test_random_numbers(void) {
    enum { COUNT = 200000 };
    uint64_t state = test_seed(20240607);
    char text[256];
    for (int i = 0; i < COUNT; ++i) {
        random_decimal(&state, text, sizeof text);
        check_number(text);
    }
}

/* Thousands of digits: the copy that is parsed is bounded, the result is as if it were not. */
static void test_long_numbers(void) {
    static char text[5000];
    /* 1 + 2^-53 is halfway between 1 and its neighbour: the tail decides, however far away. */
    const char *half = "1.00000000000000011102230246251565404236316680908203125";
    for (size_t tail = 0; tail < 4000; tail += 97) {
        size_t length = strlen(half);
        memcpy(text, half, length);
        memset(text + length, '0', tail);
        strcpy(text + length + tail, "1");
        check_number(text);
        text[length + tail] = 0;
        check_number(text);
    }
    memset(text, '0', 4000);
    strcpy(text + 4000, "12.5e-1");
    check_number(text);
    memset(text, '9', 4000);
    strcpy(text + 4000, "e-3995");
    check_number(text);
    text[0] = '.';
    strcpy(text + 4000, "e7");
    check_number(text);
    check_number("1e-99999999999999999999");
    check_number("0e99999999999999999999");
    check_number("1e99999999999999999999");
}

static void test_number_grammar(void) {
    static const struct {
        const char *text;
        burnish_number_status status;
        double value;
    } cases[] = {
        {".5", BURNISH_NUMBER_OK, 0.5},
        {"5.", BURNISH_NUMBER_OK, 5},
        {"+1e2", BURNISH_NUMBER_OK, 100},
        {"-1.25E-1", BURNISH_NUMBER_OK, -0.125},
        {"007", BURNISH_NUMBER_OK, 7},
        {"", BURNISH_NUMBER_GARBAGE, 0},
        {"-", BURNISH_NUMBER_GARBAGE, 0},
        {".", BURNISH_NUMBER_GARBAGE, 0},
        {"1e", BURNISH_NUMBER_GARBAGE, 0},
        {"1e+", BURNISH_NUMBER_GARBAGE, 0},
        {"0x10", BURNISH_NUMBER_GARBAGE, 0},
        {"1,5", BURNISH_NUMBER_GARBAGE, 0},
        {"1.5f", BURNISH_NUMBER_GARBAGE, 0},
        {"--1", BURNISH_NUMBER_GARBAGE, 0},
        {"e5", BURNISH_NUMBER_GARBAGE, 0},
        {"1.2.3", BURNISH_NUMBER_GARBAGE, 0},
        {"nan", BURNISH_NUMBER_NOT_FINITE, 0},
        {"-NaN(ind)", BURNISH_NUMBER_NOT_FINITE, 0},
        {"Infinity", BURNISH_NUMBER_NOT_FINITE, 0},
        {"-inf", BURNISH_NUMBER_NOT_FINITE, 0},
        {"-1.#IND", BURNISH_NUMBER_NOT_FINITE, 0},
        {"3.5e38", BURNISH_NUMBER_RANGE, 0},
        {"-1e999", BURNISH_NUMBER_RANGE, 0},
        {"1e-60", BURNISH_NUMBER_OK, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        float value = 0;
        burnish_number_status status = burnish_parse_float(token_of(cases[i].text), &value);
        CHECK(status == cases[i].status && (double)value == cases[i].value, "\"%s\": %d, %g",
              cases[i].text, (int)status, (double)value);
    }
    float largest = 0;
    CHECK1(burnish_parse_float(token_of("3.4028235677973366e38"), &largest) ==
           BURNISH_NUMBER_RANGE);
    CHECK1(burnish_parse_float(token_of("3.4028235677973362e38"), &largest) == BURNISH_NUMBER_OK &&
           largest == FLT_MAX);
}

/* ---- polygons ---- */

static double triangle_area(const float *p, const float *q, const float *r) {
    return 0.5 * (((double)q[0] - p[0]) * ((double)r[1] - p[1]) -
                  ((double)q[1] - p[1]) * ((double)r[0] - p[0]));
}

/* Cuts a simple polygon in the plane: all triangles turn the same way, and areas add up. */
static void check_cut(const char *name, const float *positions, size_t count) {
    uint32_t corners[BURNISH_POLYGON_CORNERS];
    uint16_t cut[3 * (BURNISH_POLYGON_CORNERS - 2)];
    double area = 0, sum = 0, absolute = 0;
    for (size_t i = 0; i < count; ++i) {
        const float *p = positions + 3 * i, *q = positions + 3 * ((i + 1) % count);
        corners[i] = (uint32_t)i;
        area += 0.5 * ((double)p[0] * q[1] - (double)p[1] * q[0]);
    }
    burnish_polygon_cut(positions, corners, count, cut);
    for (size_t i = 0; i < count - 2; ++i) {
        double part = triangle_area(positions + 3 * cut[3 * i], positions + 3 * cut[3 * i + 1],
                                    positions + 3 * cut[3 * i + 2]);
        sum += part;
        absolute += fabs(part);
    }
    CHECK(fabs(absolute - fabs(area)) <= 1e-9 * fabs(area) && fabs(sum - area) <= 1e-9 * fabs(area),
          "%s: area %.12g, triangles %.12g, without sign %.12g", name, area, sum, absolute);
}

static void test_polygons(void) {
    static const float arrow[] = {0, 0, 0, 2, -2, 0, 1, 0, 0, 2, 2, 0};
    static const float ell[] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0};
    static const float in_line[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    static const float keyhole[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 0,
                                    1, 1, 0, 1, 3, 0, 3, 3, 0, 3, 1, 0, 1, 1, 0};
    float comb[3 * BURNISH_POLYGON_CORNERS], star[3 * BURNISH_POLYGON_CORNERS];
    check_cut("arrow", arrow, 4);
    check_cut("ell", ell, 6);
    check_cut("three in line", in_line, 5);
    check_cut("keyhole", keyhole, 10);
    for (size_t i = 0; i < BURNISH_POLYGON_CORNERS; ++i) {
        double angle = 2 * 3.14159265358979 * (double)i / BURNISH_POLYGON_CORNERS;
        double radius = i % 2 ? 1 : 0.25;
        float *s = star + 3 * i, *c = comb + 3 * i;
        s[0] = (float)(radius * cos(angle));
        s[1] = (float)(radius * sin(angle));
        s[2] = 0;
        c[0] = (float)i;
        c[1] = i % 2 ? 10 : 1;
        c[2] = 0;
    }
    comb[1] = comb[3 * BURNISH_POLYGON_CORNERS - 2] = -1;
    check_cut("star", star, BURNISH_POLYGON_CORNERS);
    check_cut("comb", comb, BURNISH_POLYGON_CORNERS);
    for (size_t i = 0; i < sizeof arrow / sizeof *arrow / 3; ++i) { /* every first corner */
        float turned[12];
        for (size_t k = 0; k < 12; ++k) {
            turned[k] = arrow[(k + 3 * i) % 12];
        }
        check_cut("turned arrow", turned, 4);
    }
}

static int separated(const float *a, const float *b, const float *c, const float *d) {
    return (triangle_area(a, b, c) > 0) == (triangle_area(a, b, d) > 0) ||
           (triangle_area(c, d, a) > 0) == (triangle_area(c, d, b) > 0);
}

/* Random points joined in a ring and untangled: whenever two edges cross, the way between them is
 * turned round, which shortens the ring, so that it ends as a simple polygon. */
static void untangle(float *positions, size_t count) {
    for (int crossed = 1; crossed;) {
        crossed = 0;
        for (size_t i = 0; i + 2 < count; ++i) {
            for (size_t k = i + 2; k < count - (i == 0); ++k) {
                float *a = positions + 3 * i, *c = positions + 3 * k;
                if (separated(a, a + 3, c, positions + 3 * ((k + 1) % count))) {
                    continue;
                }
                crossed = 1;
                for (size_t lower = i + 1, upper = k; lower < upper; ++lower, --upper) {
                    for (size_t axis = 0; axis < 2; ++axis) {
                        float swap = positions[3 * lower + axis];
                        positions[3 * lower + axis] = positions[3 * upper + axis];
                        positions[3 * upper + axis] = swap;
                    }
                }
            }
        }
    }
}

static void test_random_polygons(void) {
    uint64_t state = test_seed(11);
    for (int round = 0; round < 1000; ++round) {
        float positions[3 * 40] = {0};
        size_t count = 4 + test_random64(&state) % 37;
        for (size_t i = 0; i < count; ++i) { /* 20 bits: areas are exact in double */
            positions[3 * i] = (float)(test_random64(&state) >> 44);
            positions[3 * i + 1] = (float)(test_random64(&state) >> 44);
        }
        untangle(positions, count);
        check_cut("random polygon", positions, count);
    }
}

/* ---- OBJ ---- */

static int position_is(const burnish_mesh_data *s, size_t i, float x, float y, float z) {
    return i < s->streams[BURNISH_POSITION].count && burnish_positions(s)[3 * i] == x &&
           burnish_positions(s)[3 * i + 1] == y && burnish_positions(s)[3 * i + 2] == z;
}

static int triangle_is(const burnish_mesh_data *s, size_t i, uint32_t a, uint32_t b, uint32_t c) {
    return i < s->triangle_count && s->streams[BURNISH_POSITION].corners[3 * i] == a &&
           s->streams[BURNISH_POSITION].corners[3 * i + 1] == b &&
           s->streams[BURNISH_POSITION].corners[3 * i + 2] == c;
}

static void test_obj(void) {
    burnish_mesh_data s;
    burnish_error e;
    CHECK(read_text(
              BURNISH_FORMAT_OBJ,
              "\xEF\xBB\xBF# a square\r\no thing\r\ng a b\r\ns off\r\nv 0 0 0\r\nv 1 0 0 1.0\r\n"
              "v 1 1 -2.5e-1 \\\r\n  # the rest\r\nv 0 \\\n 1 0\r\nvt 0 0\rvn 0 0 1\n"
              "vn nan 0 0\nfoo bar\n\n  f 1/1/1 2/1/1 -2//-2 4/1 # end\nf -4/ -3// 3",
              &s, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK1(s.streams[BURNISH_POSITION].count == 4 && s.streams[BURNISH_NORMAL].count == 2 &&
           s.triangle_count == 3);
    CHECK1(position_is(&s, 1, 1, 0, 0) && position_is(&s, 2, 1, 1, -0.25f) &&
           position_is(&s, 3, 0, 1, 0));
    CHECK1(triangle_is(&s, 0, 0, 1, 2) && triangle_is(&s, 1, 0, 2, 3) &&
           triangle_is(&s, 2, 0, 1, 2));
    static const uint32_t normals[9] = {
        0, 0, 0, 0, 0, BURNISH_NONE, BURNISH_NONE, BURNISH_NONE, BURNISH_NONE};
    CHECK1(s.streams[BURNISH_NORMAL].corners &&
           memcmp(s.streams[BURNISH_NORMAL].corners, normals, sizeof normals) == 0);
    CHECK1(burnish_normals(&s)[2] == 1 && burnish_normals(&s)[3] == 0);
    CHECK1(!burnish_colors(&s) && !s.triangle_materials && s.material_count == 1 &&
           s.warning_count == 0);
    burnish_mesh_data_destroy(&s);
}

/* Faces before their vertices; texture coordinates, of which some are not there. */
static void test_obj_forward(void) {
    static const uint32_t texcoords[12] = {0, 1, BURNISH_NONE, 1, 0, 1, 1, 1, 1, 0, 0, 0};
    static const float values[4] = {0, 0.25f, 0.5f, 1};
    burnish_mesh_data s;
    burnish_error e;
    CHECK(read_text(BURNISH_FORMAT_OBJ,
                    "f 1/1 2/2 3/9\nf 1/2/1 4/1/1 3/2/1\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 .25\n"
                    "vt .5 1 2\nf -3/-1 2/2 3/-1\nf -3/-2 2/1 3/1\nv 0 1 0\nvn 0 0 1\n",
                    &s, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK1(s.triangle_count == 4 && triangle_is(&s, 1, 0, 3, 2) && triangle_is(&s, 2, 0, 1, 2));
    const burnish_stream *read = &s.streams[BURNISH_TEXCOORD];
    CHECK1(read->count == 2 && memcmp(read->items, values, sizeof values) == 0);
    CHECK1(read->corners && memcmp(read->corners, texcoords, sizeof texcoords) == 0);
    CHECK1(s.streams[BURNISH_NORMAL].corners[3] == 0 &&
           s.streams[BURNISH_NORMAL].corners[0] == BURNISH_NONE);
    burnish_mesh_data_destroy(&s);
}

static void test_obj_colors(void) {
    burnish_mesh_data s;
    burnish_error e;
    static const uint8_t expected[] = {255, 255, 255, 255, 255, 128, 0,   255,
                                       0,   255, 51,  255, 255, 255, 255, 255};
    CHECK(
        read_text(BURNISH_FORMAT_OBJ,
                  "v 0 0 0\nv 1 0 0 1 .5 0\nv 0 1 0 -1 2 .2\nv 0 0 1\nf 1 2 3\nl 1 2\np 1\nf 1 2\n",
                  &s, &e) == BURNISH_STATUS_OK,
        "%s", e.text);
    CHECK1(burnish_colors(&s) && memcmp(burnish_colors(&s), expected, sizeof expected) == 0);
    if (CHECK(s.warning_count == 2, "%zu", s.warning_count)) {
        CHECK_TEXT(s.warnings[0], "mesh.obj:6: lines and points were ignored");
        CHECK_TEXT(s.warnings[1], "mesh.obj:8: faces with fewer than 3 corners were ignored");
    }
    CHECK1(!s.streams[BURNISH_NORMAL].corners && s.triangle_count == 1);
    burnish_mesh_data_destroy(&s);
}

/* Concave faces keep their area, huge ones become fans. */
static void test_obj_polygons(void) {
    burnish_mesh_data s;
    burnish_error e;
    CHECK(read_text(BURNISH_FORMAT_OBJ,
                    "v 0 0 0\nv 2 -2 0\nv 1 0 0\nv 2 2 0\nf 1 2 3 4\nf 2 3 4 1\n", &s,
                    &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    double area = 0;
    for (size_t t = 0; t < s.triangle_count; ++t) {
        const uint32_t *c = s.streams[BURNISH_POSITION].corners + 3 * t;
        double part =
            triangle_area(burnish_positions(&s) + 3 * c[0], burnish_positions(&s) + 3 * c[1],
                          burnish_positions(&s) + 3 * c[2]);
        CHECK(part > 0, "triangle %zu: %g", t, part);
        area += part;
    }
    CHECK(s.triangle_count == 4 && area == 4, "%zu triangles, area %g", s.triangle_count, area);
    burnish_mesh_data_destroy(&s);

    enum { CORNERS = 1000 };
    static char text[CORNERS * 40];
    size_t length = 0;
    for (int i = 0; i < CORNERS; ++i) {
        length += (size_t)snprintf(text + length, sizeof text - length, "v %d %d 0\n", i, i * i);
    }
    length += (size_t)snprintf(text + length, sizeof text - length, "f");
    for (int i = 1; i <= CORNERS; ++i) {
        length += (size_t)snprintf(text + length, sizeof text - length, " %d", i);
    }
    CHECK(read_text(BURNISH_FORMAT_OBJ, text, &s, &e) == BURNISH_STATUS_OK, "%s", e.text);
    CHECK1(s.triangle_count == CORNERS - 2 &&
           triangle_is(&s, CORNERS - 3, 0, CORNERS - 2, CORNERS - 1));
    burnish_mesh_data_destroy(&s);
}

/* ---- MTL ---- */

static const char *library_text;

static burnish_status open_library(void *user_data, const char *file, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data;
    if (strcmp(file, "my parts/a b.mtl") != 0 || max_bytes == 0) {
        return burnish_fail(error, BURNISH_STATUS_READ, "%s: No such file", file);
    }
    *size = strlen(library_text);
    *bytes = library_text;
    return BURNISH_STATUS_OK;
}

static burnish_status read_with_library(const char *text, const char *library, burnish_mesh_data *s,
                                        burnish_error *e) {
    burnish_load_options options = burnish_load_options_default();
    library_text = library;
    return run_reader(BURNISH_FORMAT_OBJ, text, strlen(text), &options, open_library, s, e);
}

static int color_is(const float color[3], float r, float g, float b) {
    return color[0] == burnish_srgb_value_to_linear(r) &&
           color[1] == burnish_srgb_value_to_linear(g) &&
           color[2] == burnish_srgb_value_to_linear(b);
}

static void test_mtl(void) {
    static const char library[] =
        "# parts\nnewmtl red paint\nKd 0.8 0.1 0\nKa 1 1 1\nKs .5\nNs 30\nillum 2\nmap_Kd x.png\n"
        "Tr 0\nnewmtl dull\nKa 0.2 0.3 0.4\nKd 1 1 1\nKs 0 0 0\nNs 0\nnewmtl matt\nKs 1 1 1\n"
        "illum 1\nNs 100000\nnewmtl bare\nKs xyz 1 2 3\nnewmtl dull\nKd 0 0 0\n";
    burnish_mtl mtl = {0};
    burnish_error e = {0};
    burnish_material grey = burnish_material_default();
    CHECK(read_mtl(library, &mtl, &e) == BURNISH_STATUS_OK, "%s", e.text);
    if (CHECK1(mtl.count == 5)) {
        const burnish_material *red = &mtl.entries[0].material, *dull = &mtl.entries[1].material;
        const burnish_material *matt = &mtl.entries[2].material, *bare = &mtl.entries[3].material;
        CHECK_TEXT(mtl.entries[0].name, "red paint");
        CHECK1(color_is(red->diffuse, 0.8f, 0.1f, 0) && color_is(red->ambient, 0.8f, 0.1f, 0));
        CHECK1(color_is(red->specular, .5f, .5f, .5f) && red->exponent == 30);
        CHECK1(red->has_diffuse && red->has_exponent);
        CHECK1(color_is(dull->ambient, 0.2f, 0.3f, 0.4f) && dull->exponent == 1);
        CHECK1(dull->has_exponent);
        CHECK1(color_is(matt->specular, 0, 0, 0) && matt->exponent == 65536);
        CHECK1(matt->has_exponent && !matt->has_diffuse);
        CHECK1(memcmp(matt->diffuse, grey.diffuse, sizeof grey.diffuse) == 0);
        CHECK1(memcmp(bare, &grey, sizeof grey) == 0);
    }
    burnish_mtl_destroy(NULL, &mtl);
    CHECK1(mtl.entries == NULL && mtl.count == 0);
}

static void test_obj_materials(void) {
    static const char library[] =
        "newmtl a\nKd 1 0 0\nNs 0.5\nnewmtl b\nKd 0 1 0\nnewmtl a\nKd 1 1 1\n";
    burnish_mesh_data s;
    burnish_error e;
    CHECK(
        read_with_library("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nusemtl b\nusemtl a\n"
                          "f 1 2 3 4\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl none\nf 1 2 3\n"
                          "mtllib my parts\\a b.mtl\nmtllib my parts\\a b.mtl\n",
                          library, &s, &e) == BURNISH_STATUS_OK,
        "%s", e.text);
    static const uint16_t expected[] = {0, 1, 1, 2, 1, 0};
    CHECK1(s.triangle_count == 6 && s.material_count == 3);
    CHECK1(s.triangle_materials && memcmp(s.triangle_materials, expected, sizeof expected) == 0);
    CHECK1(!s.materials[0].has_diffuse && color_is(s.materials[1].diffuse, 1, 0, 0) &&
           color_is(s.materials[2].diffuse, 0, 1, 0));
    if (CHECK(s.warning_count == 2, "%zu", s.warning_count)) {
        CHECK_TEXT(s.warnings[0],
                   "my parts/a b.mtl:3: Ns 0.5 is not in [1, 65536] and was taken as 1");
        CHECK_TEXT(s.warnings[1],
                   "mesh.obj: material \"none\" is in no material library; it is burnish's grey");
    }
    burnish_mesh_data_destroy(&s);

    CHECK(
        read_with_library("mtllib my parts/a b.mtl\nusemtl b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                          library, &s, &e) == BURNISH_STATUS_OK,
        "%s", e.text);
    CHECK1(s.material_count == 1 && !s.triangle_materials &&
           color_is(s.materials[0].diffuse, 0, 1, 0));
    burnish_mesh_data_destroy(&s);
}

/* Warnings stop after 16 lines, however many there would be. */
static void test_many_warnings(void) {
    char library[512] = "newmtl a\n";
    burnish_mesh_data s;
    burnish_error e;
    for (int i = 0; i < 40; ++i) {
        strcat(library, "Ns 0.5\n");
    }
    CHECK(read_with_library("mtllib my parts/a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                            library, &s, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK(s.warning_count == 16, "%zu", s.warning_count);
    burnish_mesh_data_destroy(&s);
}

static void test_missing_libraries(void) {
    static const char mesh[] = "usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const struct {
        const char *line, *warning;
    } cases[] = {
        {"mtllib x.mtl", "mesh.obj:1: material library \"x.mtl\" was not read (x.mtl: No such "
                         "file); its materials are burnish's grey"},
        {"mtllib ../x.mtl", "mesh.obj:1: material library \"../x.mtl\" was not read (it lies "
                            "outside the folder of the file); its materials are burnish's grey"},
        {"mtllib /etc/passwd", "mesh.obj:1: material library \"/etc/passwd\" was not read (it lies "
                               "outside the folder of the file); its materials are burnish's grey"},
        {"mtllib a\\..\\x", "mesh.obj:1: material library \"a\\..\\x\" was not read (it lies "
                            "outside the folder of the file); its materials are burnish's grey"},
        {"mtllib C:\\x", "mesh.obj:1: material library \"C:\\x\" was not read (it lies "
                         "outside the folder of the file); its materials are burnish's grey"},
        {"# none", "mesh.obj: usemtl without mtllib: its materials are burnish's grey"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[256];
        burnish_mesh_data s;
        burnish_error e;
        snprintf(text, sizeof text, "%s\n%s", cases[i].line, mesh);
        CHECK(read_with_library(text, "", &s, &e) == BURNISH_STATUS_OK, "%s", e.text);
        if (CHECK(s.warning_count == 1, "%s: %zu", cases[i].line, s.warning_count)) {
            CHECK_TEXT(s.warnings[0], cases[i].warning);
        }
        CHECK1(s.material_count == 1 && !s.materials[0].has_diffuse);
        burnish_mesh_data_destroy(&s);
    }
}

/* Asked for under whatever name, a file is opened once; no more than 64 files are. */
static size_t libraries_opened;

static burnish_status count_library(void *user_data, const char *file, uint64_t max_bytes,
                                    const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data;
    (void)file, (void)max_bytes, (void)error;
    ++libraries_opened;
    *size = 9;
    *bytes = "newmtl a\n";
    return BURNISH_STATUS_OK;
}

static void check_libraries(const char *lines, size_t opened, const char *warning) {
    static char text[4096];
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_data s;
    burnish_error e;
    snprintf(text, sizeof text, "%susemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", lines);
    libraries_opened = 0;
    CHECK(run_reader(BURNISH_FORMAT_OBJ, text, strlen(text), &options, count_library, &s, &e) ==
              BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK(libraries_opened == opened, "%zu of %zu: %s", libraries_opened, opened, lines);
    if (CHECK(s.warning_count == (warning != NULL), "%zu", s.warning_count) && warning) {
        CHECK_TEXT(s.warnings[0], warning);
    }
    burnish_mesh_data_destroy(&s);
}

static void test_library_names(void) {
    char many[1024] = "";
    check_libraries("mtllib x.mtl\nmtllib ./x.mtl\nmtllib .\\x.mtl\nmtllib .//./x.mtl\n", 1, NULL);
    check_libraries("mtllib p/x.mtl\nmtllib p//x.mtl\nmtllib p/./x.mtl\nmtllib p\\x.mtl\n", 1,
                    NULL);
    check_libraries("mtllib x\nmtllib y\nmtllib x/y\nmtllib xy\nmtllib .x\nmtllib x./y\n", 6, NULL);
    for (int i = 0; i < 66; ++i) {
        snprintf(many + strlen(many), sizeof many - strlen(many), "mtllib %d\n", i);
    }
    check_libraries(many, 64,
                    "mesh.obj:65: only the first 64 material libraries are read; merge them");
}

/* A million names on one line: comparing each with all bytes of the line would take hours. */
static void test_library_line(void) {
    enum { NAMES = 1000000 };
    static char text[2 * NAMES + 100];
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_data s;
    burnish_error e;
    strcpy(text, "mtllib ");
    for (size_t i = 0; i < NAMES; ++i) {
        memcpy(text + 7 + 2 * i, "a ", 2);
    }
    strcpy(text + 7 + 2 * NAMES, "\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    libraries_opened = 0;
    CHECK(run_reader(BURNISH_FORMAT_OBJ, text, strlen(text), &options, count_library, &s, &e) ==
              BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK(libraries_opened == 1, "%zu", libraries_opened);
    burnish_mesh_data_destroy(&s);
}

/* What materials have and pictures do not: one line for the file, of materials in use only. */
static void test_undrawn(void) {
    static const char library[] =
        "newmtl a\nmap_Kd -s 1 1 1 mars.png\nmap_Ks other.png\nd 0.5\nnewmtl b\nbump moon b.png\n"
        "Tr 0\nnewmtl c\nmap_Kd mars.png\nTr 0.1\nnewmtl unused\nmap_Kd x.png\n";
    burnish_mesh_data s;
    burnish_error e;
    CHECK(
        read_with_library("mtllib my parts/a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"
                          "usemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n",
                          library, &s, &e) == BURNISH_STATUS_OK,
        "%s", e.text);
    if (CHECK(s.warning_count == 1, "%zu", s.warning_count)) {
        CHECK_TEXT(s.warnings[0], "mesh.obj: 2 textures (mars.png, moon b.png) and the "
                                  "transparency of 2 materials are not drawn");
    }
    burnish_mesh_data_destroy(&s);
    CHECK1(read_text(BURNISH_FORMAT_PLY,
                     "ply\nformat ascii 1.0\ncomment TextureFile moon.png\nelement vertex 3\n"
                     "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                     "property uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0 1 2 3 255\n1 0 0 1 2 3 254\n0 1 0 1 2 3 255\n3 0 1 2\n",
                     &s, &e) == BURNISH_STATUS_OK);
    if (CHECK(s.warning_count == 1, "%zu", s.warning_count)) {
        CHECK_TEXT(s.warnings[0],
                   "mesh.ply: 1 texture (moon.png) and transparency (alpha) are not drawn");
    }
    burnish_mesh_data_destroy(&s);
    for (int faces = 0; faces < 2; ++faces) { /* of an element without rows nothing is lost */
        char text[400];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement tristrips 1\nproperty list uchar int vertex_indices\n"
                 "element face %d\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                 "property uchar green\nproperty uchar blue\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n%s",
                 faces, faces ? "3 0 1 2 9 8 7\n" : "");
        CHECK(read_text(BURNISH_FORMAT_PLY, text, &s, &e) == BURNISH_STATUS_OK, "%s", e.text);
        if (CHECK(s.warning_count == (size_t)faces, "%zu", s.warning_count) && faces) {
            CHECK_TEXT(s.warnings[0], "mesh.ply: colours of faces are not drawn");
        }
        burnish_mesh_data_destroy(&s);
    }
}

/* ---- STL ---- */

static void test_stl(void) {
    burnish_mesh_data s;
    burnish_error e;
    CHECK(read_text(BURNISH_FORMAT_STL,
                    "Solid one facet\nFACET NORMAL 0 0 1\r\nouter loop\nvertex 0 0 0 vertex 1 0 0\n"
                    "vertex 0 1.5 -2e1\nendloop\nendfacet\nendsolid one\n"
                    "solid\nfacet normal nan nan nan\nouter loop\nvertex 3 0 0\nvertex 4 0 0\n"
                    "vertex 3 1 0\nendloop\nendfacet\nendsolid",
                    &s, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK1(s.triangle_count == 2 && s.streams[BURNISH_POSITION].count == 6 &&
           s.streams[BURNISH_NORMAL].count == 0);
    CHECK1(position_is(&s, 2, 0, 1.5f, -20) && position_is(&s, 5, 3, 1, 0));
    CHECK1(triangle_is(&s, 1, 3, 4, 5));
    burnish_mesh_data_destroy(&s);
}

static void test_binary_stl(void) {
    static const char *const headers[] = {"", "solid made by a CAD program",
                                          "solid x\nfacet normal"};
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_data s;
    burnish_error e;
    for (size_t h = 0; h < 3; ++h) {
        for (size_t more = 0; more < 3; ++more) { /* bytes behind the last facet */
            byte_list list = {.size = 0};
            put_stl(&list, headers[h], 3);
            put(&list, "xyz", more);
            CHECK(run_reader(BURNISH_FORMAT_STL, list.bytes, list.size, &options, NULL, &s, &e) ==
                      BURNISH_STATUS_OK,
                  "%s", e.text);
            CHECK1(s.triangle_count == 3 && position_is(&s, 7, 3, 0, 0) &&
                   position_is(&s, 8, 2, 1, 0.5f));
            CHECK1(s.warning_count == (more > 0));
            if (more == 2 && s.warning_count == 1) {
                CHECK_TEXT(s.warnings[0],
                           "mesh.stl: byte 234: 2 bytes after the last triangle were ignored");
            }
            burnish_mesh_data_destroy(&s);
        }
    }
}

/* Colours that are not drawn are one line: those of facets (VisCAM, SolidView) and, by the header,
 * those of the object and of facets (Magics). */
static void test_stl_colors(void) {
    static const struct {
        const char *header;
        size_t count, colored; /* facets, and the one that has a colour */
        const char *warning;   /* NULL: none */
    } cases[] = {{"", 3, 3, NULL},
                 {"", 3, 0, "mesh.stl: colours of facets are not drawn"},
                 {"", 3, 2, "mesh.stl: colours of facets are not drawn"},
                 {"made by hand COLOR=\x10\x20\x30\xFF", 3, 3,
                  "mesh.stl: the colours that its header announces are not drawn"},
                 {"COLOR=\x10\x20\x30\xFF,MATERIAL=", 3, 1,
                  "mesh.stl: the colours that its header announces are not drawn"}};
    burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        byte_list list = {.size = 0};
        burnish_mesh_data s;
        burnish_error e;
        put_stl(&list, cases[i].header, (uint32_t)cases[i].count);
        if (cases[i].colored < cases[i].count) {
            list.bytes[84 + 50 * cases[i].colored + 49] |= 0x80;
        }
        CHECK(run_reader(BURNISH_FORMAT_STL, list.bytes, list.size, &options, NULL, &s, &e) ==
                  BURNISH_STATUS_OK,
              "%s", e.text);
        if (CHECK(s.warning_count == (cases[i].warning != NULL), "case %zu: %zu", i,
                  s.warning_count) &&
            cases[i].warning) {
            CHECK_TEXT(s.warnings[0], cases[i].warning);
        }
        burnish_mesh_data_destroy(&s);
    }
}

/* ---- PLY ---- */

static void test_ply(void) {
    burnish_load_options options = burnish_load_options_default();
    for (int encoding = 0; encoding < 3; ++encoding) {
        byte_list list = {.size = 0};
        burnish_mesh_data s;
        burnish_error e;
        put_ply(&list, encoding);
        CHECK(run_reader(BURNISH_FORMAT_PLY, list.bytes, list.size, &options, NULL, &s, &e) ==
                  BURNISH_STATUS_OK,
              "%d: %s", encoding, e.text);
        CHECK1(s.streams[BURNISH_POSITION].count == 5 && s.streams[BURNISH_NORMAL].count == 5 &&
               s.triangle_count == 3);
        CHECK1(position_is(&s, 2, 1, 1, 0) && position_is(&s, 4, 0.5f, 2, -1.25f));
        CHECK1(triangle_is(&s, 0, 0, 1, 2) && triangle_is(&s, 1, 0, 2, 3) &&
               triangle_is(&s, 2, 3, 2, 4));
        CHECK1(!s.streams[BURNISH_NORMAL].corners); /* numbered as positions are */
        CHECK1(burnish_normals(&s)[14] == 1 && burnish_normals(&s)[12] == 0);
        CHECK1(burnish_colors(&s) && burnish_colors(&s)[16] == 40 && burnish_colors(&s)[17] == 80 &&
               burnish_colors(&s)[18] == 120 && burnish_colors(&s)[19] == 251);
        burnish_mesh_data_destroy(&s);
    }
}

/* Faces before vertices, types of every kind, strips, colours as floats and 16 bits. */
static void test_ply_variants(void) {
    burnish_mesh_data s;
    burnish_error e;
    CHECK(
        read_text(BURNISH_FORMAT_PLY,
                  "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uint8 uint16 "
                  "vertex_index\r\n"
                  "element vertex 4\r\nproperty double x\r\nproperty int16 y\r\nproperty char z\r\n"
                  "property float diffuse_red\r\nproperty float diffuse_green\r\n"
                  "property float diffuse_blue\r\nproperty list int int extra\r\nend_header\r\n"
                  "4 0 1 2 3\r\n0 0 0 0 .5 1 0\r\n2 -2 0 1 2 -1 2 7 7\r\n1 0 0 nan 0 0 0\r\n2 2 0 "
                  "0 0 0 0",
                  &s, &e) == BURNISH_STATUS_OK,
        "%s", e.text);
    static const uint8_t colors[] = {0, 128, 255, 255, 255, 255, 0, 255,
                                     0, 0,   0,   255, 0,   0,   0, 255};
    CHECK1(s.triangle_count == 2 && s.streams[BURNISH_POSITION].count == 4 &&
           !s.streams[BURNISH_NORMAL].corners);
    CHECK1(burnish_colors(&s) && memcmp(burnish_colors(&s), colors, sizeof colors) == 0);
    for (size_t t = 0; t < s.triangle_count; ++t) { /* cut by positions that come later */
        const uint32_t *c = s.streams[BURNISH_POSITION].corners + 3 * t;
        CHECK1(triangle_area(burnish_positions(&s) + 3 * c[0], burnish_positions(&s) + 3 * c[1],
                             burnish_positions(&s) + 3 * c[2]) == 1);
    }
    burnish_mesh_data_destroy(&s);

    CHECK(read_text(BURNISH_FORMAT_PLY,
                    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                    "property float z\nproperty ushort red\nproperty ushort green\n"
                    "property ushort blue\nelement tristrips 1\n"
                    "property list int int vertex_indices\nend_header\n"
                    "0 0 0 65535 0 257 1 0 0 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 0 2 0 0 0 0\n"
                    "13 0 1 2 3 4 -1 4 3 2 2 -1 0 1\n",
                    &s, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK(s.triangle_count == 4, "%zu", s.triangle_count);
    CHECK1(triangle_is(&s, 0, 0, 1, 2) && triangle_is(&s, 1, 2, 1, 3) &&
           triangle_is(&s, 2, 2, 3, 4) && triangle_is(&s, 3, 4, 3, 2));
    CHECK1(burnish_colors(&s) && burnish_colors(&s)[0] == 255 && burnish_colors(&s)[1] == 0 &&
           burnish_colors(&s)[2] == 1);
    burnish_mesh_data_destroy(&s);
}

/* What the header does not declare is not there: no colours, no normals, also with some of them. */
static void test_ply_plain(void) {
    static const char *const extra[] = {"", "property uchar red\nproperty uchar green\n",
                                        "property float nx\nproperty float nz\n"};
    for (size_t i = 0; i < 3; ++i) {
        char text[512];
        burnish_mesh_data s;
        burnish_error e;
        const char *row = i > 0 ? " 1 1" : "";
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\n%selement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0%s\n1 0 0%s\n0 1 0%s\n3 0 1 2\n",
                 extra[i], row, row, row);
        CHECK(read_text(BURNISH_FORMAT_PLY, text, &s, &e) == BURNISH_STATUS_OK, "%s", e.text);
        CHECK(!burnish_colors(&s) && !burnish_normals(&s) && !s.streams[BURNISH_NORMAL].corners &&
                  s.triangle_count == 1,
              "%zu", i);
        burnish_mesh_data_destroy(&s);
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
    burnish_load_options options = burnish_load_options_default();
    for (size_t k = 0; k < 3; ++k) {
        byte_list list = {.size = 0};
        burnish_mesh_data s;
        burnish_error e;
        for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
            put_text(&list, lines[i]);
            put_text(&list, ends[k]);
        }
        put(&list, body, sizeof body);
        CHECK(run_reader(BURNISH_FORMAT_PLY, list.bytes, list.size, &options, NULL, &s, &e) ==
                  BURNISH_STATUS_OK,
              "%zu: %s", k, e.text);
        CHECK1(s.triangle_count == 1 && position_is(&s, 0, 10, 13, 10));
        burnish_mesh_data_destroy(&s);
    }
}

/* Many face elements, each with a row or two: none looks at the rest of the file. */
static void test_ply_elements(void) {
    enum { ELEMENTS = 100000, ROOM = 100 };
    char *text = malloc((size_t)ELEMENTS * ROOM);
    burnish_load_options options = burnish_load_options_default();
    burnish_tasks tasks;
    burnish_mesh_data s;
    burnish_error e;
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
    CHECK(run_reader_threads(BURNISH_FORMAT_PLY, text, size, &options, NULL, &tasks, &s, &e) ==
              BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK(s.triangle_count == ELEMENTS, "%zu", s.triangle_count);
    burnish_mesh_data_destroy(&s);
    free(text);
}

/* ---- from a file ---- */

static void test_guess(void) {
    static const struct {
        const char *bytes, *name;
        burnish_format format;
    } cases[] = {
        {"", "A.OBJ", BURNISH_FORMAT_OBJ},       {"", "dir/a.Stl", BURNISH_FORMAT_STL},
        {"", "a.ply", BURNISH_FORMAT_PLY},       {"ply\r\n", "a.obj", BURNISH_FORMAT_PLY},
        {"solid x", "-", BURNISH_FORMAT_STL},    {"# hi\n\nv 0 0 0\n", NULL, BURNISH_FORMAT_OBJ},
        {"mtllib x", "obj", BURNISH_FORMAT_OBJ}, {"GIF89a", "picture", BURNISH_FORMAT_AUTO},
        {"", "", BURNISH_FORMAT_AUTO},
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

static void test_files(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *scene = NULL;
    burnish_error e = {0};
    CHECK(burnish_mesh_load(TEST_DATA_DIR "/cube.obj", &options, &scene, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    if (scene) {
        CHECK1(burnish_mesh_get_view(scene)->triangle_count == 12);
        CHECK1(burnish_mesh_material_count(scene) == 2 && burnish_mesh_warning_count(scene) == 0);
        CHECK1(color_is(burnish_mesh_material(scene, 0)->diffuse, 0.8f, 0.2f, 0.1f));
        CHECK1(burnish_mesh_get_info(scene)->format == BURNISH_FORMAT_OBJ);
    }
    burnish_mesh_destroy(scene);
    CHECK(burnish_mesh_load(":sphere", &options, &scene, &e) == BURNISH_STATUS_OK, "%s", e.text);
    CHECK1(scene && burnish_mesh_get_info(scene)->format == BURNISH_FORMAT_BUILTIN);
    burnish_mesh_destroy(scene);

    byte_list list = {.size = 0};
    put_ply(&list, 1);
    CHECK(burnish_mesh_load_memory(list.bytes, list.size, NULL, &options, &scene, &e) ==
              BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK1(scene && burnish_mesh_get_info(scene)->format == BURNISH_FORMAT_PLY);
    burnish_mesh_destroy(scene);
}

/* Standard input through a pipe, in pieces that grow the buffer. */
static void test_standard_input(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *scene = NULL;
    burnish_error e = {0};
    FILE *pipe =
        popen("head -c 300000 /dev/zero | tr '\\0' '#'; echo; cat " TEST_DATA_DIR "/cube.obj", "r");
    int saved = dup(STDIN_FILENO);
    if (!CHECK1(pipe && saved >= 0 && dup2(fileno(pipe), STDIN_FILENO) == STDIN_FILENO)) {
        return;
    }
    options.format = BURNISH_FORMAT_OBJ;
    CHECK(burnish_mesh_load("-", &options, &scene, &e) == BURNISH_STATUS_OK, "%s", e.text);
    if (scene && CHECK1(burnish_mesh_warning_count(scene) == 1)) {
        CHECK1(burnish_mesh_get_view(scene)->triangle_count == 12);
        CHECK_TEXT(burnish_mesh_warning(scene, 0),
                   "standard input:3: material library \"cube.mtl\" was not read (the input has no "
                   "folder); its materials are burnish's grey");
    }
    burnish_mesh_destroy(scene);
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
    ssize_t got;
    char bytes[4096];
    FILE *pipe = popen("head -c 1000000 /dev/zero", "r");
    int saved = dup(STDIN_FILENO);
    if (!CHECK1(pipe && saved >= 0 && dup2(fileno(pipe), STDIN_FILENO) == STDIN_FILENO)) {
        return;
    }
    options.max_input_bytes = LIMIT;
    CHECK1(burnish_mesh_load("-", &options, &mesh, &e) == BURNISH_STATUS_LIMIT);
    while ((got = read(STDIN_FILENO, bytes, sizeof bytes)) > 0) {
        rest += (size_t)got;
    }
    CHECK(rest == ALL - LIMIT - 1, "%zu bytes were read", ALL - rest);
    dup2(saved, STDIN_FILENO);
    close(saved);
    pclose(pipe);
}

/* The program that loads a mesh may have set a locale with a decimal comma. */
static void test_decimal_comma(void) {
    static const char obj[] =
        "v 1.5 0 0\nv 2.25e0 1 0\nv 0.1 1.00000000000000000000001 3\nf 1 2 3\n";
    burnish_mesh_data source;
    burnish_error error;
    if (!test_decimal_comma_begin()) {
        return;
    }
    CHECK1(read_text(BURNISH_FORMAT_OBJ, obj, &source, &error) == BURNISH_STATUS_OK);
    CHECK1(source.streams[BURNISH_POSITION].count == 3 && burnish_positions(&source)[0] == 1.5f &&
           burnish_positions(&source)[3] == 2.25f && burnish_positions(&source)[6] == 0.1f &&
           burnish_positions(&source)[7] == 1);
    burnish_mesh_data_destroy(&source);
    test_decimal_comma_end();
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_random_numbers());
    RUN(test_long_numbers());
    RUN(test_number_grammar());
    RUN(test_decimal_comma());
    RUN(test_polygons());
    RUN(test_random_polygons());
    RUN(test_obj());
    RUN(test_obj_forward());
    RUN(test_obj_colors());
    RUN(test_obj_polygons());
    RUN(test_mtl());
    RUN(test_obj_materials());
    RUN(test_many_warnings());
    RUN(test_missing_libraries());
    RUN(test_library_names());
    RUN(test_library_line());
    RUN(test_undrawn());
    RUN(test_stl());
    RUN(test_binary_stl());
    RUN(test_stl_colors());
    RUN(test_ply());
    RUN(test_ply_variants());
    RUN(test_ply_plain());
    RUN(test_ply_line_ends());
    RUN(test_ply_elements());
    RUN(test_guess());
    RUN(test_files());
    RUN(test_standard_input());
    RUN(test_pipe_limit());
    return test_end("readers");
}
