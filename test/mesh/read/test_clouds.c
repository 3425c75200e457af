/* PCD, LAS and lines of numbers: each holds the same points as a PLY file. */
#include <math.h>

#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "reader_input.h"

enum { POINTS = 48 };

/* Values of point i; coordinates are multiples of 1/8. */
static double coordinate(int i, int k) {
    return k == 2 ? (i * 7 % 11) / 8.0 - 0.5 : (k == 0 ? i % 6 : i / 6) * 1.25 - 2;
}
static unsigned color_of(int i, int k) {
    return (unsigned)(37 * i + 101 * k + 5 * i * k) & 255;
}

/* The same as PLY text, with or without colours; `away` is added to x and y. */
static burnish_mesh *load_ply(double away, int has_colors) {
    byte_list text = {.size = 0};
    char line[200];
    snprintf(line, sizeof line,
             "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
             "property double z\n%send_header\n",
             POINTS,
             has_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
    put_text(&text, line);
    for (int i = 0; i < POINTS; ++i) {
        snprintf(line, sizeof line, "%.17g %.17g %.17g", away + coordinate(i, 0),
                 away + coordinate(i, 1), coordinate(i, 2));
        put_text(&text, line);
        snprintf(line, sizeof line, " %u %u %u", color_of(i, 0), color_of(i, 1), color_of(i, 2));
        put_text(&text, has_colors ? line : "");
        put_text(&text, "\n");
    }
    return load_bytes(text.bytes, text.size, "a.ply", NULL);
}

static void check_same(const char *what, const byte_list *file, const char *name,
                       const burnish_mesh *expected) {
    OWNED_MESH *mesh = load_bytes(file->bytes, file->size, name, NULL);
    CHECK(mesh && same_meshes(mesh, expected), "%s", what);
    CHECK(mesh && burnish_mesh_get_warning_count(mesh) == 0, "%s warns", what);
}

/* ---- PCD ---- */

/* LZF: equal bytes as a byte and a copy of what is before, others as runs. */
static void pack_lzf(byte_list *to, const uint8_t *from, size_t size) {
    for (size_t at = 0; at < size;) {
        size_t run = 1;
        while (at + run < size && run < 264 && from[at + run] == from[at]) {
            ++run;
        }
        put_bits(to, 0, 1, 0);
        put(to, from + at, 1);
        at += run;
        if (--run >= 9) {
            put_bits(to, 7 << 5, 1, 0);
            put_bits(to, run - 9, 1, 0);
            put_bits(to, 0, 1, 0);
        } else if (run >= 3) {
            put_bits(to, (run - 2) << 5, 1, 0);
            put_bits(to, 0, 1, 0);
        } else {
            at -= run;
        }
    }
}

enum { MISSING = 12, ALL = POINTS + MISSING, FIELDS = 5 };

/* Field f of a point: x, y, z, a gap, and a colour; points that are missing follow the others. */
static void put_field(byte_list *list, int i, int f, int is_text, char type) {
    const uint32_t packed = (type == 'U' ? 0xFF000000u : 0) | color_of(i, 0) << 16 |
                            color_of(i, 1) << 8 | color_of(i, 2);
    char line[100];
    float value = f > 2 ? 0 : i < POINTS ? (float)coordinate(i, f) : NAN;
    if (!is_text) {
        f < 3 ? put_float(list, value, 0) : put_bits(list, f == 3 ? 0 : packed, 4, 0);
        return;
    }
    if (f == 4) {
        memcpy(&value, &packed, sizeof value);
    }
    if (f == 4 && type == 'U') {
        snprintf(line, sizeof line, "%u\n", packed);
    } else {
        snprintf(line, sizeof line, "%.9g%c", (double)value, f == 4 ? '\n' : ' ');
    }
    put_text(list, line);
}

static void put_pcd(byte_list *list, int encoding, char type) {
    static const char *const names[] = {"ascii", "binary", "binary_compressed"};
    byte_list columns = {.size = 0}, packed = {.size = 0};
    char line[300];
    snprintf(line, sizeof line,
             "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _ rgb\nSIZE 4 4 4 %c 4\nTYPE F F F U %c\n"
             "COUNT 1 1 1 %c 1\nWIDTH 12\nHEIGHT %d\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA %s\n",
             encoding == 0 ? '4' : '1', type, encoding == 0 ? '1' : '4', ALL / 12, ALL,
             names[encoding]);
    put_text(list, line);
    for (int k = 0; k < FIELDS * ALL; ++k) {
        const int i = encoding == 2 ? k % ALL : k / FIELDS;
        const int f = encoding == 2 ? k / ALL : k % FIELDS;
        if (encoding < 2 || f != 3) {
            put_field(encoding == 2 ? &columns : list, i, f, encoding == 0, type);
        }
    }
    if (encoding == 2) {
        pack_lzf(&packed, columns.bytes, columns.size);
        put_bits(list, packed.size, 4, 0);
        put_bits(list, columns.size, 4, 0);
        put(list, packed.bytes, packed.size);
    }
}

static void test_pcd(void) {
    OWNED_MESH *expected = load_ply(0, 1);
    for (int form = 0; form < 6; ++form) {
        byte_list file = {.size = 0};
        put_pcd(&file, form % 3, form < 3 ? 'U' : 'F');
        check_same("PCD", &file, form == 0 ? "x" : "a.pcd", expected);
        if (form == 2) { /* cut off, and damaged */
            check_refused(file.bytes, file.size - 1, "a.pcd", NULL, BURNISH_STATUS_FORMAT,
                          "a.pcd: byte 164: the packed data does not fit the header; the file is "
                          "truncated");
            file.bytes[164 + 8] = 0xFF;
            check_refused(file.bytes, file.size, "a.pcd", NULL, BURNISH_STATUS_FORMAT,
                          "a.pcd: byte 164: the packed data is damaged; export the file again");
        }
    }
}

/* ---- LAS ---- */

/* Coordinates count in steps of 1/8 from x + 1000, y - 3, z.
 *   shift  of colours: 8, or 0 as some programs write them; -1: they are 0 */
static void put_las(byte_list *list, unsigned format, int shift, double away) {
    static const uint8_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    static const uint8_t colors[] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
    const size_t extra = format % 3, head = format > 5 ? 375 : 227;
    const double numbers[6] = {0.125, 0.125, 0.125, away + 1000, away - 3, 0};
    memset(list->bytes, 0, head);
    memcpy(list->bytes, "LASF", 4);
    list->bytes[24] = 1;
    list->bytes[25] = format > 5 ? 4 : 2;
    list->bytes[94] = (uint8_t)head;
    list->bytes[95] = (uint8_t)(head >> 8);
    memcpy(list->bytes + 96, list->bytes + 94, 2);
    list->bytes[104] = (uint8_t)format;
    list->bytes[105] = (uint8_t)(sizes[format] + extra);
    list->bytes[format > 5 ? 247 : 107] = POINTS;
    for (size_t k = 0; k < 6; ++k) {
        byte_list number = {.size = 0};
        uint64_t bits;
        memcpy(&bits, &numbers[k], sizeof bits);
        put_bits(&number, bits, 8, 0);
        memcpy(list->bytes + 131 + 8 * k, number.bytes, 8);
    }
    list->size = head;
    for (int i = 0; i < POINTS; ++i) {
        uint8_t *record = list->bytes + list->size;
        for (int k = 0; k < 3; ++k) {
            const double start = k == 0 ? 1000 : k == 1 ? -3 : 0;
            put_bits(list, (uint64_t)(int64_t)((coordinate(i, k) - start) * 8), 4, 0);
        }
        memset(record + 12, 0, sizes[format] + extra - 12);
        for (int k = 0; k < 3 && colors[format] > 0 && shift >= 0; ++k) {
            record[colors[format] + 2 * k + shift / 8] = (uint8_t)color_of(i, k);
            record[colors[format] + 2 * k] = (uint8_t)color_of(i, k); /* 257 times it */
        }
        list->size += sizes[format] + extra - 12;
    }
}

static void test_las(void) {
    for (unsigned format = 0; format <= 10; ++format) {
        const int has_colors =
            format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
        for (int form = 0; form < 3; ++form) {
            const double away = form == 2 ? 4500000 : 0;
            OWNED_MESH *expected = load_ply(away, has_colors);
            byte_list file = {.size = 0};
            put_las(&file, format, form == 1 ? 0 : 8, away);
            check_same("LAS", &file, "x", expected);
        }
    }
    byte_list file = {.size = 0};
    put_las(&file, 3, -1, 0);
    file.bytes[file.size - 34 + 15] = 2; /* ground, and a building: their colours */
    file.bytes[file.size - 2 * 34 + 15] = 6;
    OWNED_MESH *classes = load_bytes(file.bytes, file.size, "a.las", NULL);
    const uint8_t *colors = classes ? burnish_mesh_get_view(classes)->colors : NULL;
    CHECK1(colors && memcmp(colors + 4 * (POINTS - 1), colors + 4 * (POINTS - 2), 4) != 0 &&
           memcmp(colors, colors + 4, 4) == 0);
    file.bytes[104] |= 0x80;
    check_refused(
        file.bytes, file.size, "a.laz", NULL, BURNISH_STATUS_FORMAT,
        "a.laz: LAZ, packed LAS, which burnish can't read; convert it to LAS, for example "
        "with pdal translate or las2las");
    file.bytes[104] = 11;
    check_refused(file.bytes, file.size, "a.las", NULL, BURNISH_STATUS_FORMAT,
                  "a.las: records of point format 11 with 34 bytes do not exist; export the file "
                  "again");
}

/* ---- Lines of numbers ---- */

/* Rows in many spellings are these two points, with what follows x, y and z. */
static void test_xyz(void) {
    static const struct {
        const char *name, *text;
        int red, normal; /* of the second point: -1: no colours; x of its normal in tenths */
    } cases[] = {
        {"a.xyz", "1 2 3\n4.5 5 6\n", -1, 0},
        {"a.xyz", "1 2 3 0\n4.5 5 6 700\n", 255, 0},
        {"a.pts", "2\n1 2 3 -1200 10 20 30\n4.5 5 6 40 200 20 30\n", 200, 0},
        {"a.xyz", "1 2 3 10 20 30\n4.5 5 6 200 20 30\n", 200, 0},
        {"a.xyz", "1 2 3 0.5 0.5 0.25\n4.5 5 6 0.8 0.5 0.25\n", 204, 0},
        {"a.xyz", "1 2 3 0 0 -1\n4.5 5 6 0.6 0 0.8\n", -1, 6},
        {"a.xyz", "1 2 3 10 20 30 0 0 -1\n4.5 5 6 200 20 30 0.6 0 0.8\n", 200, 6},
        {"a.xyz", "1 2 3 0 0 -1 10 20 30\n4.5 5 6 0.6 0 0.8 200 20 30\n", 200, 6},
        {"a.asc", "# a survey\n\n1\t2\t3\n# more\n4.5 5 6\r\n", -1, 0},
        {"a.txt", "1, 2, 3\n4.5, 5, 6\n", -1, 0},
        {"a.txt", "1;2;3;10;20;30\n4,5;5;6;200;20;30\n", 200, 0},
        {"a.xyz", "1,0 2,0 3,0\n4,5 5,0 6,0\n", -1, 0},
        {"a.csv",
         "\"id\",\"z\",\"y\",\"x\",\"Red\",\"g\",\"b\",\"name\"\n"
         "7,3,2,1,10,20,30,a\n8,6,5,4.5,200,20,30,b\n",
         200, 0},
        {"a.xyz", "//X Y Z R G B Nx Ny Nz\n1 2 3 1 2 3 0 0 1\n4.5 5 6 200 2 3 0.6 0 0.8\n", 200, 6},
    };
    burnish_load_options options = burnish_load_options_default();
    options.normals = BURNISH_NORMALS_FILE;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const char *text = cases[i].text;
        OWNED_MESH *mesh = load_bytes(text, strlen(text), cases[i].name, &options);
        const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        static const float positions[6] = {1, 2, 3, 4.5f, 5, 6};
        CHECK(view && view->vertex_count == 2 &&
                  memcmp(view->positions, positions, sizeof positions) == 0,
              "positions of %s", text);
        CHECK(view && (view->colors ? view->colors[4] : -1) == cases[i].red, "colours of %s", text);
        CHECK(view && fabs((double)view->normals[3] - cases[i].normal / 10.0) < 1e-6,
              "normals of %s", text);
    }
    static const char atoms[] = "2\nwater\nO 0 0 0\nH 1 0 0\n";
    check_refused(
        atoms, strlen(atoms), "a.xyz", NULL, BURNISH_STATUS_FORMAT,
        "a.xyz:1: no line begins with three numbers, x, y and z; if it is a list of atoms, "
        "convert it with a program of chemistry");
    static const char scene[] = "#VRML V2.0 utf8\npoint [\n1 2 3,\n4 5 6,\n7 8 10\n";
    check_refused(
        scene, strlen(scene), "a.wrl", NULL, BURNISH_STATUS_FORMAT,
        "a.wrl: a VRML file, which burnish can't read; convert it to one of gltf, obj, off, "
        "ply, stl, 3mf, gcode, splat, spz, bms, scene, urdf, pcd, las, xyz");
    static const char blocks[] = "1\n1 2 3 4\n1\n5 6 7 9\n1 2"; /* two scans, the second cut off */
    OWNED_MESH *mesh = load_bytes(blocks, strlen(blocks), "a.pts", NULL);
    CHECK1(mesh && burnish_mesh_get_info(mesh)->point_count == 2);
    CHECK_TEXT(mesh ? burnish_mesh_get_warning(mesh, 0) : "",
               "a.pts:3: the line has fewer than 3 numbers; it was left out (and 1 more like it)");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_pcd());
    RUN(test_las());
    RUN(test_xyz());
    return test_end("clouds");
}
