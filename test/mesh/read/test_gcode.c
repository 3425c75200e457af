/* G-code: paths against formulas, and what slicers note in comments. */
#include <math.h>

#include "mesh_arrays.h"

#define HEAD ";LAYER_CHANGE\n;WIDTH:0.4\n;HEIGHT:0.2\n"

/* Rods are as wide as the distance of neighbours: w - h (1 - pi / 4). */
static const double half_width = (0.4 - 0.2 * (1 - M_PI / 4)) / 2;

static burnish_mesh *load(const char *text, const burnish_load_options *options) {
    return load_bytes(text, strlen(text), "a.gcode", options);
}

static void check_same(const burnish_mesh *a, const burnish_mesh *b, const char *what) {
    const burnish_mesh_view *x = burnish_mesh_get_view(a), *y = burnish_mesh_get_view(b);
    if (CHECK(x && y && x->vertex_count == y->vertex_count &&
                  x->triangle_count == y->triangle_count,
              "%s", what)) {
        CHECK(memcmp(x->positions, y->positions, x->vertex_count * 12) == 0 &&
                  memcmp(x->indices, y->indices, x->triangle_count * 12) == 0,
              "%s", what);
    }
}

static void check_box(const burnish_mesh *mesh, const double box[6], double tolerance,
                      const char *what) {
    float low[3], high[3];
    burnish_mesh_get_bounds(mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        CHECK(fabs((double)low[k] - box[k]) <= tolerance &&
                  fabs((double)high[k] - box[3 + k]) <= tolerance,
              "%s: axis %d: %g to %g, not %g to %g", what, k, (double)low[k], (double)high[k],
              box[k], box[3 + k]);
    }
}

/* One path, written in several ways. */
static void test_forms(void) {
    static const char *const forms[] = {
        "G1 X50.8 E1\nG1 Y25.4 E2\nG1 X25.4 Y50.8 E3\nG1 E2\nG0 X0 Y25.4\nG1 E3\nG1 X0 Y0 E4",
        "M83\nG1 X50.8 E1\nG1 Y25.4 E1\nG1 X25.4 Y50.8 E1\nG1 X0 Y25.4\nG1 X0 Y0 E1",
        "G91\nG1 X25.4 E1\nG1 X25.4 E1\nG1 Y25.4 E1\nG1 X-25.4 Y25.4 E1\nG1 X-25.4 Y-25.4 E-1\n"
        "G90\nM83\nG1 Y0 E1",
        "M82\nG20\nG1X2E1\nN7 G01 Y1 E2*71\ng1 x1 y2 e3 ; in inches\nG1 X0 Y1\nG1 X0 Y0 E4",
        "G92 X100 Y10 E7\nG1 X150.8 E8\nG1 Y35.4 E9\nG92 E0\nG1 X125.4 Y60.8 E+.5\nG1 X100 Y35.4\n"
        "G1 X100 Y10 E1",
        "M83 (relative)\nG1 X50.8 E1\nG1 F900 Y25.4 Z0.2 E1\nSET_X Y=1\n\nG1 X25.4 Y50.8 E1\r\n"
        "G1 X Y E1\nG4 P1\nG1 X0 Y25.4 E-.1\nG1 Y0 E1"};
    char text[400];
    burnish_mesh *first = NULL;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; ++i) {
        snprintf(text, sizeof text, HEAD "G1 Z0.2\n%s\n", forms[i]);
        burnish_mesh *mesh = load(text, NULL);
        first = first ? first : mesh;
        CHECK(burnish_mesh_get_view(mesh)->triangle_count == 4 * 8, "%zu", i);
        check_same(first, mesh, forms[i]);
        if (mesh != first) {
            burnish_mesh_destroy(mesh);
        }
    }
    check_box(first, (double[]){-half_width, -0.8 * half_width, 0, 50.8 + half_width, 50.8, 0.2},
              0.3, "bounds");
    burnish_mesh_destroy(first);
}

/* Straight rods: their box, and their width from the flow. */
static void test_sizes(void) {
    const double area = M_PI / 4 * 1.75 * 1.75 * 0.05, half = area / 0.3 / 2;
    OWNED_MESH *square = load(
        HEAD "M83\nG1 Z.2\nG1 X10 E1\nG1 Y10 E1\nG1 X-0.00000000000000000000009 E1\nG1 Y0 E1\n",
        NULL);
    check_box(square,
              (double[]){-half_width, -half_width, 0, 10 + half_width, 10 + half_width, 0.2}, 1e-5,
              "a square");
    OWNED_MESH *flow = load("M83\nG1 Z.3\nG1 X10 E.5\n", NULL);
    check_box(flow, (double[]){-0.8 * half, -half, 0, 10 + 0.8 * half, half, 0.3}, 1e-5, "flow");
    OWNED_MESH *line =
        load(HEAD "M83\nG1 Z.2\nG1 X1 E1\nG1 X2 Y.001 E1\nG1 X3 E1\nG1 X4 E1\n", NULL);
    CHECK1(burnish_mesh_get_view(line)->triangle_count == 8 &&
           burnish_mesh_get_info(line)->line_count == 4);
}

/* Words without a number are left out, with one warning: how many, and where the first is. */
static void test_odd_numbers(void) {
    OWNED_MESH *mesh =
        load(HEAD "M83\nG28 X Y\nG1 Z.2\nG1 X10 E1\nG1 Xnan Y10 E1\nG1 X20000000 E1\n"
                  "G1 X0 Y{y} E1\nG1 Y0 E1\nG1 Y0..5\n",
             NULL);
    const char *warning = burnish_mesh_get_warning(mesh, 0);
    CHECK(
        burnish_mesh_get_warning_count(mesh) == 1 &&
            strcmp(warning,
                   "a.gcode:8: X has no number below 1e7; it was left out (and 3 more like it)") ==
                0,
        "%s", warning);
    check_box(mesh, (double[]){-half_width, -half_width, 0, 10 + half_width, 10 + half_width, 0.2},
              0.05, "a square");
}

/* Arcs around 0, 0 from 10, 0: their ends, and the way around. */
static void test_arcs(void) {
    static const struct {
        const char *text;
        double box[4]; /* of the path */
    } arcs[] = {
        {"G3 X0 Y10 I-10 J0 E1", {0, 0, 10, 10}},  {"G3 X0 Y10 R10 E1", {0, 0, 10, 10}},
        {"G2 X0 Y10 I-10 E1", {-10, -10, 10, 10}}, {"G2 X0 Y10 R-10 E1", {-10, -10, 10, 10}},
        {"G3 X-10 Y0 I-10 E1", {-10, 0, 10, 10}},  {"G2 X-10 Y0 I-10 E1", {-10, -10, 10, 0}},
        {"G3 I-10 E1", {-10, -10, 10, 10}},        {"G2 I-10 E1", {-10, -10, 10, 10}}};
    for (size_t i = 0; i < sizeof arcs / sizeof *arcs; ++i) {
        char text[200];
        snprintf(text, sizeof text, HEAD "M83\nG0 X10 Z.2\n%s\n", arcs[i].text);
        OWNED_MESH *mesh = load(text, NULL);
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        const double *b = arcs[i].box;
        check_box(mesh, (double[]){b[0], b[1], 0, b[2], b[3], 0.2}, half_width + 0.02,
                  arcs[i].text);
        for (size_t v = 0; v < view->vertex_count; ++v) {
            const double r =
                hypot((double)view->positions[3 * v], (double)view->positions[3 * v + 1]);
            CHECK(fabs(r - 10) < half_width + 0.02, "%s: %g", arcs[i].text, r);
        }
    }
}

/* Features, tools, colours and layers; what comes before the first layer is not drawn. */
static void test_contents(void) {
    OWNED_MESH *mesh = load(
        "; filament_colour = #FF0000;#00ff00;\n; extruder_colour = #0000FF;;#0000FF\nM83\n"
        ";TYPE:Custom\nG1 Z.2\nG1 X500 E9\nG0 X0\n;LAYER_CHANGE\n;TYPE:Outer wall\nT0\nG1 X10 E1\n"
        "; FEATURE: Infill\nT2\nG1 Y5 E2\nT1000\n; CHANGE_LAYER\nG1 Z.4 F9\nG1 X0 E.5\n",
        NULL);
    const burnish_contents *c = burnish_mesh_get_contents(mesh);
    CHECK1(burnish_mesh_get_info(mesh)->layer_count == 2 &&
           burnish_mesh_get_info(mesh)->line_count == 3 && c->filament_count == 3);
    check_box(mesh, (double[]){0, 0, 0, 10, 5, 0.4}, 1.1, "without the start");
    if (CHECK1(c->part_count == 2 && c->filament_count == 3)) {
        CHECK_TEXT(c->parts[0].name, "Outer wall");
        CHECK_TEXT(c->parts[1].name, "Infill");
        CHECK1(c->parts[0].triangle_count == 8 && c->parts[1].triangle_count == 16);
        CHECK1(memcmp(c->filaments[0].srgb, "\xFF\0\0", 3) == 0 &&
               memcmp(c->filaments[2].srgb, "\0\0\xFF", 3) == 0);
        CHECK1(c->filaments[0].length == 10 && c->filaments[2].length == 2.5);
        CHECK1(burnish_mesh_get_material(mesh, 0)->diffuse[0] == 1 &&
               burnish_mesh_get_material(mesh, 0)->diffuse[1] == 0);
    }
    OWNED_MESH *grey = load("M83\nG1 X9 E1\n", NULL);
    CHECK1(!burnish_mesh_get_material(grey, 0)->has_diffuse &&
           burnish_mesh_get_contents(grey)->part_count == 0);
}

/* 1000 layers in 300 points: fewer are drawn, and they fill the same room. */
static void test_reduction(void) {
    static char text[200000];
    burnish_load_options options = burnish_load_options_default();
    size_t size = (size_t)snprintf(text, sizeof text, "M83\n;HEIGHT:0.2\n;WIDTH:0.4\n");
    for (int i = 0; i < 1024; ++i) {
        size += (size_t)snprintf(
            text + size, sizeof text - size,
            ";LAYER:%d\nG0 X0 Y0\nG1 Z%.1f\nG1 X90 E1\nG1 Y90 E1\nG1 X0 Y0 E1\n", i, 0.2 * (i + 1));
    }
    options.max_triangles = 8 * 600;
    OWNED_MESH *mesh = load_bytes(text, size, "a.gcode", &options);
    CHECK1(burnish_mesh_get_view(mesh)->triangle_count == 3 * 8 * 64 &&
           burnish_mesh_get_info(mesh)->layer_count == 1024);
    check_box(mesh, (double[]){0, 0, 0, 90, 90, 204.8}, 0.5, "fewer layers");
    check_only_warning(mesh, "a.gcode: 1 in 16 layers is drawn, as high as 16, since the path has "
                             "more pieces than are drawn");
    options.max_triangles = BURNISH_TRIANGLES_MAX;
    options.max_memory = (80 << 20) + size + (size_t)8 * 600 * 112;
    OWNED_MESH *small = load_bytes(text, size, "a.gcode", &options);
    CHECK1(same_meshes(small, mesh));
    options.max_triangles = 8;
    check_refused(
        text, size, "a.gcode", &options, BURNISH_STATUS_LIMIT,
        "a.gcode: its path has more than 1 pieces in a layer; draw fewer objects, or raise "
        "--max-memory and --max-triangles");
}

/* A file that is read in pieces is the mesh of its bytes. */
static void test_pieces(void) {
    enum { LINES = 90000, ROOM = 24 * LINES };
    static const char path[] = TEST_BINARY_DIR "/pieces.gcode";
    char *text = malloc(ROOM);
    size_t size = 0;
    for (int i = 0; i < LINES && text; ++i) {
        size += (size_t)snprintf(text + size, ROOM - size, "G1 X%d Y%d.%02d E%d\n", i * 7 % 90,
                                 i / 900, (i % 97) * (i % 97) % 97, i + 1);
    }
    FILE *file = fopen(path, "wb");
    CHECK1(text && file && fwrite(text, 1, size, file) == size && size > (1 << 20) + 9);
    if (file) {
        fclose(file);
    }
    OWNED_MESH *streamed = load_mesh(path, NULL), *whole = load_bytes(text, size, path, NULL);
    check_same(streamed, whole, "pieces");
    free(text);
    remove(path);
}

#define PNG64                                                                                      \
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mP438AAAAQBAYD718vxAAAAAElFTkSuQmCC"

static void test_thumbnails(void) {
    static const char with[] = "; thumbnail_QOI begin 99x99 8\n; AAAAAAAA\n; thumbnail_QOI end\n"
                               "; thumbnail begin 1x1 92\n; " PNG64 "\n; thumbnail end\nM83\n";
    static const char moves[] = "; thumbnail_QOI begin 1x1 8\nM83\nG1 X9 E1\n";
    static const uint8_t binary[] = "GCDE\1\0\0\0\0\0\5\0\0\0\2\0\0\0\2\0\1\0\1\0..\0";
    burnish_load_options options = burnish_load_options_default();
    OWNED_MESH *mesh = load(with, NULL);
    CHECK1(burnish_mesh_get_info(mesh)->is_thumbnail && burnish_mesh_get_texture_count(mesh) == 1);
    check_only_warning(mesh,
                       "a.gcode: no move has filament (E); the picture that it holds is drawn, "
                       "no geometry");
    options.thumbnail = BURNISH_THUMBNAIL_NEVER;
    check_refused(with, sizeof with - 1, "a.gcode", &options, BURNISH_STATUS_FORMAT,
                  "a.gcode: no move has filament (E), and its pictures are not PNG or JPEG; export "
                  "G-code of a 3D printer as text, with thumbnails in PNG");
    options.thumbnail = BURNISH_THUMBNAIL_ONLY;
    check_refused(moves, sizeof moves - 1, "a.gcode", &options, BURNISH_STATUS_FORMAT,
                  "a.gcode: it holds no picture of itself, and its pictures are not PNG or JPEG; "
                  "export G-code of a 3D printer as text, with thumbnails in PNG");
    check_refused(binary, sizeof binary - 1, "a.bgcode", NULL, BURNISH_STATUS_FORMAT,
                  "a.bgcode: it is binary G-code, of which the path is not read, and its pictures "
                  "are not PNG or JPEG; export G-code of a 3D printer as text, with thumbnails in "
                  "PNG");
    check_refused(
        "G0 X1 Z5\nG1 Z-1 F100\nG1 X9\nM3 S1\n", 33, "mill.gcode", NULL, BURNISH_STATUS_FORMAT,
        "mill.gcode: no move has filament (E); export G-code of a 3D printer as text, with "
        "thumbnails in PNG");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_forms());
    RUN(test_sizes());
    RUN(test_odd_numbers());
    RUN(test_arcs());
    RUN(test_contents());
    RUN(test_reduction());
    RUN(test_pieces());
    RUN(test_thumbnails());
    return test_end("gcode");
}
