/* Polygons cut into triangles; the readers of OBJ and MTL on well-formed files. */
#include <math.h>

#include "mesh/read/common/triangulate.h"
#include "reader_input.h"

/* ---- polygons ---- */

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

/* Random points joined in a ring and untangled: if two edges cross, the path between them is
 * reversed, which shortens the ring, until it is a simple polygon. */
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

static void test_obj(void) {
    read_good_text(
        BURNISH_FORMAT_OBJ,
        "\xEF\xBB\xBF# a square\r\no thing\r\ng a b\r\ns off\r\nv 0 0 0\r\nv 1 0 0 1.0\r\n"
        "v 1 1 -2.5e-1 \\\r\n  # the rest\r\nv 0 \\\n 1 0\r\nvt 0 0\rvn 0 0 1\n"
        "vn nan 0 0\nfoo bar\n\n  f 1/1/1 2/1/1 -2//-2 4/1 # end\nf -4/ -3// 3");
    CHECK1(got.streams[BURNISH_POSITION].count == 4 && got.streams[BURNISH_NORMAL].count == 2 &&
           got.triangle_count == 3);
    CHECK1(position_is(1, 1, 0, 0) && position_is(2, 1, 1, -0.25f) && position_is(3, 0, 1, 0));
    CHECK1(triangle_is(0, 0, 1, 2) && triangle_is(1, 0, 2, 3) && triangle_is(2, 0, 1, 2));
    static const uint32_t normals[9] = {
        0, 0, 0, 0, 0, BURNISH_NONE, BURNISH_NONE, BURNISH_NONE, BURNISH_NONE};
    CHECK1(got.streams[BURNISH_NORMAL].corners &&
           memcmp(got.streams[BURNISH_NORMAL].corners, normals, sizeof normals) == 0);
    CHECK1(burnish_normals(&got)[2] == 1 && burnish_normals(&got)[3] == 0);
    CHECK1(!burnish_colors(&got) && !got.triangle_materials && got.material_count == 1);
    check_warnings(1, "mesh.obj:14: \"foo\" is not a statement of OBJ and was ignored");
}

/* Curves and surfaces give one warning together, and so do unknown statements. */
static void test_obj_other_statements(void) {
    read_good_text(BURNISH_FORMAT_OBJ,
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nvp 1 2\ncstype bezier\ndeg 1 1\n"
                   "surf 0 1 0 1 1 2 3 1\nparm u 0 1\nend\ncurv 0 1 1 2\nend\nmg 1 2\nlod 3\n"
                   "q 1\n#MRGB 1\nMRGB 2\n\"\xFF 3\n");
    check_warnings(
        2,
        "mesh.obj:8: curves and surfaces (\"surf\") are not drawn; "
        "export them as faces (and 1 more like it)",
        "mesh.obj:15: \"q\" is not a statement of OBJ and was ignored (and 2 more like it)");
}

/* Corners of every form, with indices of 1 to 9 characters: longer ones are read another way. */
static void test_obj_index_forms(void) {
    enum { FACES = 300, PIECE = 64 };
    static const char *const forms[] = {"%0*u/%0*u/%0*u", "%0*u//%0*u", "%0*u/%0*u", "%0*u"};
    uint64_t state = test_seed(6);
    for (size_t form = 0; form < sizeof forms / sizeof *forms; ++form) {
        char text[16 * 27 + FACES * 3 * PIECE] = "";
        uint32_t wanted[FACES][3];
        size_t size = 0, wrong = 0;
        for (int i = 0; i < 9; ++i) {
            size += (size_t)sprintf(text + size, "v %d %d 0\nvt 0 %d\nvn 0 %d 1\n", i, i * i, i, i);
        }
        for (size_t i = 0; i < FACES; ++i) {
            for (uint32_t k = 0; k < 3; ++k) {
                const unsigned number = 1 + (test_random32(&state) % 3) + 3 * k;
                const int width = 1 + (int)(test_random32(&state) % 9);
                wanted[i][k] = number - 1;
                size += (size_t)sprintf(text + size, k ? " " : "f ");
                size += (size_t)snprintf(text + size, PIECE, forms[form], width, number, width,
                                         number, width, number);
            }
            text[size++] = '\n';
        }
        text[size] = 0;
        read_good_text(BURNISH_FORMAT_OBJ, text);
        for (size_t i = 0; i < FACES; ++i) {
            const uint32_t *normals = burnish_stream_corners(&got, BURNISH_NORMAL);
            const uint32_t *texcoords = burnish_stream_corners(&got, BURNISH_TEXCOORD);
            wrong += !triangle_is(i, wanted[i][0], wanted[i][1], wanted[i][2]);
            wrong += form < 2 && memcmp(normals + 3 * i, wanted[i], sizeof wanted[i]) != 0;
            wrong += form % 2 == 0 && memcmp(texcoords + 3 * i, wanted[i], sizeof wanted[i]) != 0;
        }
        CHECK(got.triangle_count == FACES && wrong == 0, "%s: %zu are wrong", forms[form], wrong);
    }
}

/* Faces before their vertices, and missing texture coordinates. */
static void test_obj_forward(void) {
    static const uint32_t texcoords[12] = {0, 1, BURNISH_NONE, 1, 0, 1, 1, 1, 1, 0, 0, 0};
    static const float values[4] = {0, 0.25f, 0.5f, 1};
    read_good_text(BURNISH_FORMAT_OBJ,
                   "f 1/1 2/2 3/9\nf 1/2/1 4/1/1 3/2/1\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 .25\n"
                   "vt .5 1 2\nf -3/-1 2/2 3/-1\nf -3/-2 2/1 3/1\nv 0 1 0\nvn 0 0 1\n");
    CHECK1(got.triangle_count == 4 && triangle_is(1, 0, 3, 2) && triangle_is(2, 0, 1, 2));
    const burnish_stream *read = &got.streams[BURNISH_TEXCOORD];
    CHECK1(read->count == 2 && memcmp(read->items, values, sizeof values) == 0);
    CHECK1(read->corners && memcmp(read->corners, texcoords, sizeof texcoords) == 0);
    CHECK1(got.streams[BURNISH_NORMAL].corners[3] == 0 &&
           got.streams[BURNISH_NORMAL].corners[0] == BURNISH_NONE);
}

/* Colours of ZBrush, for all vertices or else none. */
static void test_obj_paint(void) {
    static const uint8_t expected[] = {16, 32, 48, 255, 171, 205, 239, 255, 0, 0, 255, 255};
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB ff102030FFabCDEF\n# note\n"
                               "#MRGB 000000ff\nf 1 2 3\n";
    read_good_text(BURNISH_FORMAT_OBJ, text);
    CHECK1(burnish_colors(&got) && memcmp(burnish_colors(&got), expected, sizeof expected) == 0);
    check_warnings(0);
    read_good_text(BURNISH_FORMAT_OBJ, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#MRGB ffff0000ff\n");
    CHECK1(!burnish_colors(&got));
}

static void test_obj_colors(void) {
    static const uint8_t expected[] = {255, 255, 255, 255, 255, 128, 0,   255,
                                       0,   255, 51,  255, 255, 255, 255, 255};
    read_good_text(
        BURNISH_FORMAT_OBJ,
        "v 0 0 0\nv 1 0 0 1 .5 0\nv 0 1 0 -1 2 .2\nv 0 0 1\nf 1 2 3\nl 1 2\np 1\nf 1 2\n");
    CHECK1(burnish_colors(&got) && memcmp(burnish_colors(&got), expected, sizeof expected) == 0);
    check_warnings(
        2, "mesh.obj:6: lines and points are not drawn in a file with faces (and 1 more like it)",
        "mesh.obj:8: a face with fewer than 3 corners was ignored");
    CHECK1(!got.streams[BURNISH_NORMAL].corners && got.triangle_count == 1);
}

/* Huge faces become fans. */
static void test_obj_polygons(void) {
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
    read_good_text(BURNISH_FORMAT_OBJ, text);
    CHECK1(got.triangle_count == CORNERS - 2 &&
           triangle_is(CORNERS - 3, 0, CORNERS - 2, CORNERS - 1));
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

static burnish_status read_with_library(const char *text, const char *library) {
    burnish_load_options options = burnish_load_options_default();
    library_text = library;
    return run_reader(BURNISH_FORMAT_OBJ, text, strlen(text), &options, open_library);
}

static void read_good_with(const char *text, const char *library) {
    CHECK_OK(read_with_library(text, library), fault);
}

static void test_mtl(void) {
    static const char library[] =
        "# parts\nnewmtl red paint\nKd 0.8 0.1 0\nKa 1 1 1\nKs .5\nNs 30\nillum 2\nmap_Kd x.png\n"
        "Tr 0\nnewmtl dull\nKa 0.2 0.3 0.4\nKd 1 1 1\nKs 0 0 0\nNs 0\nnewmtl matt\nKs 1 1 1\n"
        "illum 1\nNs 100000\nnewmtl bare\nKs xyz 1 2 3\nnewmtl dull\nKd 0 0 0\n";
    burnish_mtl mtl = {0};
    burnish_error e = {0};
    burnish_material grey = burnish_material_default();
    CHECK_OK(read_mtl(library, &mtl, NULL, &e), e);
    if (CHECK1(mtl.count == 5)) {
        const burnish_material *red = &mtl.entries[0].material, *dull = &mtl.entries[1].material;
        const burnish_material *matt = &mtl.entries[2].material, *bare = &mtl.entries[3].material;
        CHECK_TEXT(mtl.entries[0].name, "red paint");
        CHECK1(color_is(red->diffuse, 0.8f, 0.1f, 0) && color_is(red->ambient, 0.8f, 0.1f, 0));
        CHECK1(color_is(red->specular, .5f, .5f, .5f) && red->exponent == 30);
        CHECK1(red->has_diffuse);
        CHECK1(color_is(dull->ambient, 0.2f, 0.3f, 0.4f) && dull->exponent == 1);
        CHECK1(color_is(matt->specular, 0, 0, 0) && matt->exponent == 65536);
        CHECK1(!matt->has_diffuse);
        CHECK1(memcmp(matt->diffuse, grey.diffuse, sizeof grey.diffuse) == 0);
        CHECK1(memcmp(bare, &grey, sizeof grey) == 0);
    }
    burnish_mtl_destroy(NULL, &mtl);
    CHECK1(mtl.entries == NULL && mtl.count == 0);
}

static void test_obj_materials(void) {
    static const char library[] =
        "newmtl a\nKd 1 0 0\nNs 0.5\nnewmtl b\nKd 0 1 0\nnewmtl a\nKd 1 1 1\n";
    read_good_with("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nusemtl b\nusemtl a\n"
                   "f 1 2 3 4\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl none\nf 1 2 3\n"
                   "mtllib my parts\\a b.mtl\nmtllib my parts\\a b.mtl\n",
                   library);
    static const uint16_t expected[] = {0, 1, 1, 2, 1, 0};
    CHECK1(got.triangle_count == 6 && got.material_count == 3);
    CHECK1(got.triangle_materials &&
           memcmp(got.triangle_materials, expected, sizeof expected) == 0);
    CHECK1(!got.materials[0].has_diffuse && color_is(got.materials[1].diffuse, 1, 0, 0) &&
           color_is(got.materials[2].diffuse, 0, 1, 0));
    check_warnings(2, "my parts/a b.mtl:3: Ns 0.5 is not in [1, 65536] and was taken as 1",
                   "mesh.obj: material \"none\" is in no material library; it is burnish's grey");

    read_good_with("mtllib my parts/a b.mtl\nusemtl b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                   library);
    CHECK1(got.material_count == 1 && !got.triangle_materials &&
           color_is(got.materials[0].diffuse, 0, 1, 0));
}

/* Lines have the materials of usemtl; those of a file with faces do not count. */
static void test_line_materials(void) {
    static const char library[] = "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n";
#define LINES                                                                                      \
    "mtllib my parts/a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nusemtl a\nl 2 3\nl 3 1\nusemtl "   \
    "b\n"
    read_good_with(LINES "l 1 2 3\n", library);
    CHECK1(got.triangle_count > 0 && got.triangle_count % 5 == 0 && got.material_count == 3);
    for (size_t i = 0; i < got.triangle_count && got.triangle_materials; ++i) {
        const size_t line = 5 * i / got.triangle_count;
        CHECK(got.triangle_materials[i] == (line + 1) / 2, "triangle %zu", i);
    }
    CHECK1(got.triangle_materials && color_is(got.materials[1].diffuse, 1, 0, 0) &&
           color_is(got.materials[2].diffuse, 0, 1, 0));
    read_good_with(LINES "f 1 2 3\nusemtl a\nf 3 2 1\n", library);
    CHECK1(got.triangle_count == 2 && got.material_count == 2 && got.triangle_materials &&
           got.triangle_materials[0] == 0 && got.triangle_materials[1] == 1);
    CHECK1(color_is(got.materials[0].diffuse, 0, 1, 0) &&
           color_is(got.materials[1].diffuse, 1, 0, 0));
    read_good_with(LINES "f 1 2 3\n", library);
    CHECK1(got.material_count == 1 && color_is(got.materials[0].diffuse, 0, 1, 0));
#undef LINES
}

/* Warnings of one kind are one line, and there are at most 16 lines. */
static void test_many_warnings(void) {
    char library[512] = "newmtl a\n", mesh[512] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (int i = 0; i < 20; ++i) {
        strcat(library, "Ns 0.5\nKd spectral x\n");
        snprintf(mesh + strlen(mesh), 32, "mtllib no %d\n", i);
    }
    read_good_with("mtllib my parts/a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", library);
    check_warnings(2,
                   "my parts/a b.mtl:3: Kd spectral is not supported and was "
                   "ignored (and 19 more like it)",
                   "my parts/a b.mtl:2: Ns 0.5 is not in [1, 65536] and was taken "
                   "as 1 (and 19 more like it)");
    read_good_with(mesh, library);
    CHECK(got.warning_count == 16, "%zu", got.warning_count);
}

/* The first error of the file is reported; a fault of a library is not an error. */
static void test_first_error(void) {
    static const struct {
        const char *mesh, *error;
    } cases[] = {{"v 0 0 0\nv 0\nmtllib my parts/a b.mtl\nf 1 1 2\n",
                  "mesh.obj:2: vertex has 1 number; write v x y z or v x y z r g b"},
                 {"mtllib none.mtl\nv 0 0 0\nf 1 1 9 x\n",
                  "mesh.obj:3: face refers to vertex 9, but the file has 1; correct the index"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        check_fault(read_with_library(cases[i].mesh, "newmtl a\nKd red\n"), BURNISH_STATUS_FORMAT,
                    cases[i].error);
    }
}

static void test_missing_libraries(void) {
    static const char mesh[] = "usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const struct {
        const char *line, *warning;
    } cases[] = {
        {"mtllib x.mtl", "mesh.obj:1: material library \"x.mtl\" was not read (x.mtl: No such "
                         "file); its materials are burnish's grey"},
        {"mtllib ../x.mtl",
         "mesh.obj:1: material library \"../x.mtl\" was not read (it is outside "
         "the folder of the file; --root=.. allows it); its materials are burnish's grey"},
        {"mtllib /etc/passwd", "mesh.obj:1: material library \"/etc/passwd\" was not read (it is "
                               "outside the folder of the file); its materials are burnish's grey"},
        {"mtllib a\\..\\..\\x",
         "mesh.obj:1: material library \"a\\..\\..\\x\" was not read (it is outside "
         "the folder of the file; --root=.. allows it); its materials are burnish's grey"},
        {"mtllib C:\\x", "mesh.obj:1: material library \"C:\\x\" was not read (it is outside the "
                         "folder of the file); its materials are burnish's grey"},
        {"# none", "mesh.obj: usemtl without mtllib: its materials are burnish's grey"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[256];
        snprintf(text, sizeof text, "%s\n%s", cases[i].line, mesh);
        read_good_with(text, "");
        if (CHECK(got.warning_count == 1, "%s: %zu", cases[i].line, got.warning_count)) {
            CHECK_TEXT(got.warnings[0], cases[i].warning);
        }
        CHECK1(got.material_count == 1 && !got.materials[0].has_diffuse);
    }
}

/* A file is opened once under all its names, and at most 64 files are opened. */
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
    snprintf(text, sizeof text, "%susemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", lines);
    libraries_opened = 0;
    CHECK_OK(read_run(&(reader_run){BURNISH_FORMAT_OBJ, text, strlen(text), &options,
                                    .load_companion = count_library}),
             fault);
    CHECK(libraries_opened == opened, "%zu of %zu: %s", libraries_opened, opened, lines);
    check_warning(warning);
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
    strcpy(text, "mtllib ");
    for (size_t i = 0; i < NAMES; ++i) {
        memcpy(text + 7 + 2 * i, "a ", 2);
    }
    strcpy(text + 7 + 2 * NAMES, "\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    libraries_opened = 0;
    CHECK_OK(read_run(&(reader_run){BURNISH_FORMAT_OBJ, text, strlen(text), &options,
                                    .load_companion = count_library}),
             fault);
    CHECK(libraries_opened == 1, "%zu", libraries_opened);
}

/* Opacity: d precedes Tr, and invisible materials become opaque, with one warning. */
static void test_opacity(void) {
    static const struct {
        const char *statements;
        float transparency;
        int warnings;
    } cases[] = {
        {"", 0, 0},
        {"d 0.25\n", 0.75f, 0},
        {"Tr 0.25\n", 0.25f, 0},
        {"d 1\nTr 1\n", 0, 0}, /* of older exporters */
        {"Tr 1\nd 1\n", 0, 0},
        {"d 0.75\nTr 0.5\n", 0.25f, 0},
        {"d -halo 0.5\n", 0.5f, 1},
        {"d 0\n", 0, 1},
        {"Tr 1\n", 0, 1},
        {"d 0\nTr 0\n", 0, 1},
        {"d -3\n", 0, 1},
        {"d 7\nTr 0.5\n", 0, 0},
        {"d nonsense\n", 0, 0},
        {"d\nTr 0.5\n", 0.5f, 0},
        {"d -halo\n", 0, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char library[80];
        snprintf(library, sizeof library, "newmtl a\n%snewmtl b\nd 0.5\n", cases[i].statements);
        read_good_with("mtllib my parts/a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\n"
                       "f 1 2 3\n",
                       library);
        CHECK(got.material_count == 1 && got.materials[0].transparency == cases[i].transparency,
              "%s: %g", cases[i].statements, (double)got.materials[0].transparency);
        CHECK(got.warning_count == (size_t)cases[i].warnings, "%s: %zu", cases[i].statements,
              got.warning_count);
    }
}

/* Vertex alpha of PLY: kept; 0 everywhere is opaque. */
static void test_ply_alpha(void) {
    for (int i = 0; i < 4; ++i) {
        static const char *const rows[] = {
            "0 0 0 1 2 3 255\n1 0 0 1 2 3 254\n0 1 0 1 2 3 0\n",
            "0 0 0 1 2 3 0\n1 0 0 1 2 3 0\n0 1 0 1 2 3 0\n",
            "0 0 0 .1 .2 .3 1\n1 0 0 .1 .2 .3 .5\n0 1 0 .1 .2 .3 0\n",
            "0 0 0 .1 .2 .3 0\n1 0 0 .1 .2 .3 0\n0 1 0 .1 .2 .3 0\n"};
        static const uint8_t alphas[][3] = {
            {255, 254, 0}, {255, 255, 255}, {255, 128, 0}, {255, 255, 255}};
        const char *type = i < 2 ? "uchar" : "float";
        char text[400];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty %s red\nproperty %s green\nproperty %s blue\n"
                 "property %s alpha\nelement face 1\n"
                 "property list uchar int vertex_indices\nend_header\n%s3 0 1 2\n",
                 type, type, type, type, rows[i]);
        read_good_text(BURNISH_FORMAT_PLY, text);
        const uint8_t *rgba = burnish_colors(&got);
        for (int k = 0; rgba && k < 3; ++k) {
            CHECK(rgba[4 * k + 3] == alphas[i][k], "%d, %d: %d", i, k, rgba[4 * k + 3]);
        }
        CHECK(rgba && got.warning_count == (size_t)(i % 2), "%d: %zu", i, got.warning_count);
    }
}

/* Unsupported properties of materials: one line for the file, for materials in use only. */
static void test_undrawn(void) {
    static const char library[] =
        "newmtl a\nmap_Kd -s 1 1 1 mars.png\nmap_Ks other.png\nd 0.5\nnewmtl b\nbump moon b.png\n"
        "Tr 0\nnewmtl c\nmap_Kd -colorspace sRGB mars.png\nTr 0.1\nnewmtl unused\nmap_Kd x.png\n";
    read_good_with("mtllib my parts/a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"
                   "usemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n",
                   library);
    check_warnings(1, "mesh.obj: texture \"my parts/mars.png\" was skipped: my parts/mars.png: "
                      "No such file (and 2 more like it)");
    CHECK_OK(read_text(BURNISH_FORMAT_PLY,
                       "ply\nformat ascii 1.0\ncomment TextureFile moon.png\nelement vertex 3\n"
                       "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                       "property uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 0 1 2 3 255\n1 0 0 1 2 3 254\n0 1 0 1 2 3 255\n3 0 1 2\n"),
             fault);
    check_warnings(1, "mesh.ply:3: texture \"moon.png\" was skipped: vertices have no "
                      "s and t, faces no texcoord");
    for (int faces = 0; faces < 2; ++faces) { /* an element without rows loses nothing */
        char text[400];
        snprintf(text, sizeof text, /* the strip's triangle lacks it */
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement tristrips 1\nproperty list uchar int vertex_indices\n"
                 "element face %d\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                 "property uchar green\nproperty uchar blue\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n%s",
                 faces, faces ? "3 0 1 2 9 8 7\n" : "");
        read_good_text(BURNISH_FORMAT_PLY, text);
        if (CHECK(got.warning_count == (size_t)faces, "%zu", got.warning_count) && faces) {
            CHECK_TEXT(got.warnings[0], "mesh.ply: colours of faces are not drawn");
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_polygons());
    RUN(test_random_polygons());
    RUN(test_obj());
    RUN(test_obj_index_forms());
    RUN(test_obj_forward());
    RUN(test_obj_other_statements());
    RUN(test_obj_colors());
    RUN(test_obj_paint());
    RUN(test_obj_polygons());
    RUN(test_mtl());
    RUN(test_obj_materials());
    RUN(test_line_materials());
    RUN(test_many_warnings());
    RUN(test_first_error());
    RUN(test_missing_libraries());
    RUN(test_library_names());
    RUN(test_library_line());
    RUN(test_undrawn());
    RUN(test_opacity());
    RUN(test_ply_alpha());
    return test_end("obj");
}
