/* OFF: supported files, and messages for broken ones. */
#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "reader_input.h"

/* The mesh until the next call. */
static burnish_mesh *load(const char *text, const char *warning) {
    static burnish_mesh *mesh;
    burnish_load_options options = burnish_load_options_default();
    options.keep_texture_coordinates = 1;
    burnish_mesh_destroy(mesh);
    mesh = load_bytes(text, strlen(text), "a.off", &options);
    check_only_warning(mesh, warning);
    return mesh;
}

/* The vertex at a position: its number, or -1. */
static long vertex_at(const burnish_mesh_view *view, float x, float y) {
    for (size_t i = 0; i < view->vertex_count; ++i) {
        if (view->positions[3 * i] == x && view->positions[3 * i + 1] == y) {
            return (long)i;
        }
    }
    return -1;
}

static int color_is_at(const burnish_mesh *mesh, float x, float y, unsigned rgba) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const long i = vertex_at(view, x, y);
    if (i < 0 || !view->colors) {
        return 0;
    }
    const uint8_t *c = view->colors + 4 * i;
    return ((unsigned)c[0] << 24 | (unsigned)c[1] << 16 | (unsigned)c[2] << 8 | c[3]) == rgba;
}

#define SQUARE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"

static void test_plain(void) {
    static const char *const heads[] = {"OFF\n4 1 4\n", "OFF 4 1 4\n", "# a\n\nOFF # b\n# c\n4 1\n",
                                        "4 1 0\n", "\xEF\xBB\xBFOFF\r\n4\n1\n4\n"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; ++i) {
        char text[200];
        snprintf(text, sizeof text, "%s# vertices\n%s\n4 0 1 2 3 # a face\n", heads[i],
                 i == 2 ? "0 0 0 # a\n1 0 0\n\n1 1 0\n#\n0 1 0\n" : SQUARE);
        burnish_mesh *mesh = load(text, NULL);
        const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        CHECK(view && view->triangle_count == 2 && view->vertex_count == 4 && !view->colors, "%zu",
              i);
    }
}

/* Normals, colours, coordinates: in the order of the letters, from the last to the first. */
static void test_vertices(void) {
    burnish_mesh *mesh = load("STCNOFF\n3 1 0\n0 0 0 0 0.6 0.8 255 0 8 0.25 0.5\n"
                              "1 0 0 0 0 1 0 1 0 1 0\n0 1 0 0 0 1 1 2 3 4 0.75 1\n3 0 1 2\n",
                              NULL);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    if (CHECK1(view && view->colors && view->texture_coordinates)) {
        const long i = vertex_at(view, 0, 0);
        CHECK1(i >= 0 && view->normals[3 * i + 1] == 0.6f && view->normals[3 * i + 2] == 0.8f);
        CHECK1(view->texture_coordinates[2 * i] == 0.25f &&
               view->texture_coordinates[2 * i + 1] == 0.5f);
        CHECK1(color_is_at(mesh, 0, 0, 0xFF0008FF) && color_is_at(mesh, 1, 0, 0x000100FF) &&
               color_is_at(mesh, 0, 1, 0x01020304));
    }
    mesh = load("COFF\n3 1 0\n0 0 0 0.5 0 1.0 1.0\n1 0 0 255 0 0 128\n0 1 0\n3 0 1 2\n",
                "a.off:5: a vertex has no colour; it is white");
    CHECK1(mesh && color_is_at(mesh, 0, 0, 0x8000FFFF) && color_is_at(mesh, 1, 0, 0xFF000080) &&
           color_is_at(mesh, 0, 1, 0xFFFFFFFF));
}

/* Without a prefix: three or four numbers behind the coordinates are colours or normals. */
static void test_unnamed_values(void) {
    static const struct {
        const char *rows[3];
        unsigned color; /* of the first vertex; 0: there are none */
        int has_normals;
    } cases[] = {
        {{"255 128 0", "0 0 1", "9 9 9"}, 0xFF8000FF, 0},
        {{"255 128 0 64", "0 0 1 255", "9 9 9 255"}, 0xFF800040, 0},
        {{"1 0.5 0", "0 0 1", "0 0 0"}, 0xFF8000FF, 0},
        {{"1 0 0", "0 0.25 1", "1 1 1"}, 0xFF0000FF, 0}, /* the row alone would be 1/255 */
        {{"1 0 0", "0 1 0", "0 0 1"}, 0xFF0000FF, 0},    /* of length 1, but pure */
        {{"0 0.6 0.8", "0 0 -1", "1 0 0"}, 0, 1},
        {{"0 0.6 0.8", "0.6 0 0.8", "0.6 0.8 0"}, 0, 1}, /* colours are not like this everywhere */
        {{"0 0.6 0.8", "0.6 0.6 0.8", "0.2 0 0"}, 0x0099CCFF, 0},
        {{"0 300 1", "0 0 1", "0 0 1"}, 0, 0}, /* neither */
        {{"0 -2 1", "0 0 1", "3 0 1"}, 0, 0},
        {{"9 9", "9 9", "9 9"}, 0, 0},
        {{"9 9 9", "9 9", "9 9 9"}, 0, 0},
        {{"9 9 9", "9 9 9 9", "9 9 9"}, 0, 0},
        {{"nan 0 0", "0 0 1", "0 0 1"}, 0, 0},
        {{"9 9 9 9 9", "9 9 9 9 9", "9 9 9 9 9"}, 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[200];
        snprintf(text, sizeof text,
                 "OFF\n# c\n3 1 0\n0 0 0 %s\n\n1 0 0 %s # c\n0 1 0 %s\n3 0 1 2\n", cases[i].rows[0],
                 cases[i].rows[1], cases[i].rows[2]);
        burnish_mesh *mesh = load(text, NULL);
        const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        if (CHECK(view, "case %zu", i)) {
            const float *normal = view->normals + 3 * vertex_at(view, 0, 0);
            CHECK((view->colors != NULL) == (cases[i].color != 0), "case %zu", i);
            CHECK(!view->colors || color_is_at(mesh, 0, 0, cases[i].color), "case %zu", i);
            CHECK((normal[1] == 0.6f && normal[2] == 0.8f) == cases[i].has_normals, "case %zu", i);
        }
    }
    burnish_mesh *mesh = load("STOFF\n3 1 0\n0 0 0 255 0 0 0.5 1\n1 0 0 0 0 9 0 0\n"
                              "0 1 0 0 0 9 0 0\n3 0 1 2\n",
                              NULL);
    CHECK1(mesh && color_is_at(mesh, 0, 0, 0xFF0000FF) &&
           burnish_mesh_get_view(mesh)
                   ->texture_coordinates[2 * vertex_at(burnish_mesh_get_view(mesh), 0, 0)] == 0.5f);
    mesh = load("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 0.5 0 1\n0 1 0 0 0 0 1\n3 0 1 2\n", NULL);
    CHECK1(mesh && color_is_at(mesh, 0, 0, 0xFF0000FF));
}

/* A vertex of two faces has both their colours; a face without one is white. */
static void test_face_colors(void) {
    burnish_mesh *mesh =
        load("OFF\n5 3 0\n" SQUARE "5 5 0\n4 0 1 2 3 255 0 0\n3 2 4 3 0.0 1.0 0.5\n"
             "3 1 4 2 7\n",
             NULL);
    CHECK1(mesh && color_is_at(mesh, 0, 0, 0xFF0000FF));
    CHECK1(mesh && burnish_mesh_get_view(mesh)->vertex_count == 4 + 3 + 3);
    mesh = load("OFF\n4 1 0\n" SQUARE "3 0 1 2 1\n", NULL);
    CHECK1(mesh && !burnish_mesh_get_view(mesh)->colors);
    mesh = load("OFF\n4 2 0\n" SQUARE "2 0 1\n3 0 1 2\n",
                "a.off:7: a face with fewer than 3 corners was ignored");
}

/* As in public files: no blank after the keyword, faces that continue in the next line. */
static void test_odd_lines(void) {
    burnish_mesh *mesh = load("  OFF4 2 0\n" SQUARE "3 0\n1 # c\n 2\n3\n\n0 2 3\n", NULL);
    if (CHECK1(mesh)) {
        CHECK1(burnish_mesh_get_view(mesh)->triangle_count == 2 &&
               burnish_mesh_get_view(mesh)->vertex_count == 4);
    }
}

#define O "\0\0\0\0"
#define I "\77\200\0\0"

static void test_binary(void) {
    static const char text[] = "CNOFF BINARY\n\0\0\0\3\0\0\0\1" O O O O O O I I O O I I O O O O I O
        I O O O I O O O I I O O O "\0\0\0\3" O "\0\0\0\1\0\0\0\2" O;
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = load_bytes(text, sizeof text - 1, "a.off", &options);
    CHECK1(mesh && color_is_at(mesh, 0, 0, 0xFF0000FF) && color_is_at(mesh, 1, 0, 0x00FF0000) &&
           color_is_at(mesh, 0, 1, 0xFF000000) && burnish_mesh_get_view(mesh)->normals[2] == 1);
    burnish_mesh_destroy(mesh);
}

static void test_messages(void) {
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"OFF\n", "a.off:1: the file ends before its counts; the file is truncated"},
        {"OFF BINARY\n", "a.off: byte 11: the file ends before its counts; the file is truncated"},
        {"4OFF\n1 1 1\n", "a.off:1: only vertices of 3 dimensions are supported; export OFF"},
        {"OFF\n3 -1 0\n",
         "a.off:2: \"-1\" is not a count; write OFF, then the counts of vertices, faces and edges"},
        {"OFF\n99999999999 1 0\n",
         "a.off:2: 99999999999 vertices are more than 4294967294; split or simplify the mesh"},
        {"OFF\n3 1 0\n0 0 0\n1 0\n", "a.off:4: vertex has 2 numbers, not 3; repair the file"},
        {"OFF\n3 1 0\n0 0 nan\n", "a.off:3: coordinate \"nan\" is not finite; repair or remove it"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n",
         "a.off:4: the file ends after 2 of 3 vertices; the file is truncated"},
        {"OFF\n4 2 0\n" SQUARE "3 0 1 2\n",
         "a.off:7: the file ends after 1 of 2 faces; the file is truncated"},
        {"OFF\n4 1 0\n" SQUARE "3 0 1 4\n",
         "a.off:7: vertex \"4\" is out of range; there are 4 vertices, counted from 0"},
        {"OFF\n4 1 0\n" SQUARE "3 0 1 -2\n",
         "a.off:7: vertex \"-2\" is out of range; there are 4 vertices, counted from 0"},
        {"OFF\n4 1 0\n" SQUARE "9999999999 0 1 2\n",
         "a.off:7: the file ends after 3 of 9999999999 corners; the file is truncated"},
        {"OFF\n4 1 0\n" SQUARE "x 0 1 2\n",
         "a.off:7: \"x\" is not a count of corners; repair the file"},
        {"OFF\n0 0 0\n", "a.off: no faces among 0 vertices; export the mesh with its faces"},
    };
    enum { LARGE = 4 }; /* the count of vertices */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        check_refused(cases[i].text, strlen(cases[i].text), "a.off", NULL,
                      i == LARGE ? BURNISH_STATUS_LIMIT : BURNISH_STATUS_FORMAT, cases[i].message);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_plain());
    RUN(test_vertices());
    RUN(test_unnamed_values());
    RUN(test_face_colors());
    RUN(test_odd_lines());
    RUN(test_binary());
    RUN(test_messages());
    return test_end("off");
}
