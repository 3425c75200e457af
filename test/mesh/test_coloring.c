/* Colours by values: maps at their published values, ranges, and what vertices get. */
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "gltf_input.h"
#include "mesh_arrays.h"
#include "reader_input.h"

static void test_maps(void) {
    static const struct {
        burnish_color_map map;
        double value;
        uint8_t srgb[3];
    } cases[] = {{BURNISH_COLOR_MAP_VIRIDIS, 0, {68, 1, 84}},
                 {BURNISH_COLOR_MAP_VIRIDIS, 0.5, {33, 144, 140}},
                 {BURNISH_COLOR_MAP_VIRIDIS, 7, {253, 231, 37}},
                 {BURNISH_COLOR_MAP_COOLWARM, 0.5, {221, 221, 221}},
                 {BURNISH_COLOR_MAP_COOLWARM, 1, {180, 4, 38}},
                 {BURNISH_COLOR_MAP_GREY, 0.2, {51, 51, 51}},
                 {BURNISH_COLOR_MAP_GREY, -1, {0, 0, 0}},
                 {BURNISH_COLOR_MAP_GREY, __builtin_nan(""), {0, 0, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        uint8_t srgb[3];
        burnish_color_map_get(cases[i].map, cases[i].value, srgb);
        CHECK(memcmp(srgb, cases[i].srgb, 3) == 0, "%zu: %d %d %d", i, srgb[0], srgb[1], srgb[2]);
    }
}

#define PLY(rows, faces)                                                                           \
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"                \
    "property float z\nproperty double scalar_heat\n" faces "end_header\n" rows
#define ROWS "0 0 0 10\n0 1 0 20\n1 1 0 30\n1 2 1 50\n"
#define FACES "element face 2\nproperty list uchar int vertex_indices\n"

/* A point's colour is the map's at its value. */
static void test_points(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_coloring coloring = burnish_coloring_default();
    static const char text[] = PLY(ROWS, "");
    double range[2] = {0, 0};
    burnish_error error;
    options.scalar_property = "heat";
    options.keep_texture_coordinates = 1;
    burnish_mesh *mesh = load_bytes(text, strlen(text), "a.ply", &options);
    coloring.source = BURNISH_COLOR_BY_PROPERTY;
    coloring.map = BURNISH_COLOR_MAP_GREY;
    CHECK1(burnish_mesh_color_by(mesh, &coloring, range, &error) == BURNISH_STATUS_OK);
    CHECK1(range[0] == 10 && range[1] == 50);
    const uint8_t *colors = mesh ? burnish_mesh_get_view(mesh)->colors : NULL;
    CHECK1(colors && colors[0] == 0 && colors[4] == 64 && colors[8] == 128 && colors[12] == 255);
    coloring.source = BURNISH_COLOR_BY_HEIGHT; /* y; the range has two ends */
    coloring.range[0] = 2;
    CHECK1(burnish_mesh_color_by(mesh, &coloring, range, &error) == BURNISH_STATUS_OK);
    colors = mesh ? burnish_mesh_get_view(mesh)->colors : NULL;
    CHECK1(colors && range[0] == 2 && colors[0] == 255 && colors[4] == 128 && colors[12] == 0);
    burnish_mesh_destroy(mesh);
    options.scalar_property = "cold";
    check_refused(text, strlen(text), "a.ply", &options, BURNISH_STATUS_FORMAT,
                  "a.ply:3: no other vertex property \"cold\" to colour by; the vertices "
                  "have x, y, z, scalar_heat");
}

/* A TGA of one pixel. */
static burnish_status give_pixel(void *user_data, const char *name, uint64_t max_bytes,
                                 const void **bytes, size_t *size, burnish_error *error) {
    static const uint8_t pixel[] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0, 1, 2, 3};
    (void)user_data, (void)name, (void)max_bytes, (void)error;
    *bytes = pixel;
    *size = sizeof pixel;
    return BURNISH_STATUS_OK;
}

/* The texture of a file has no triangles to lie on, with and without values to colour by. */
static void test_textured_points(void) {
    static const char text[] = "ply\nformat ascii 1.0\ncomment TextureFile t.tga\n"
                               "element vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nproperty float u\nproperty float v\n"
                               "property float heat\nend_header\n"
                               "0 0 0 0 0 1\n0 1 0 0 1 2\n1 1 0 1 1 3\n";
    for (int choice = 0; choice < 4; ++choice) {
        burnish_load_options options = burnish_load_options_default();
        burnish_render_options drawing = burnish_render_options_default();
        burnish_framing framing = burnish_framing_default();
        burnish_image image = {0};
        burnish_error error;
        options.scalar_property = choice & 1 ? "heat" : NULL;
        options.keep_texture_coordinates = choice >> 1;
        options.referenced_files = (burnish_file_loader){give_pixel, NULL, NULL};
        OWNED_MESH *mesh = load_bytes(text, strlen(text), "a.ply", &options);
        CHECK1(burnish_mesh_get_texture_count(mesh) == 0 &&
               burnish_mesh_get_material(mesh, 0)->textures[BURNISH_TEXTURE_COLOR].texture == 0);
        CHECK1(!burnish_mesh_get_view(mesh)->texture_coordinates == (choice < 3));
        CHECK_OK(burnish_camera_frame(mesh, &framing, &drawing.camera, &error), error);
        drawing.width = drawing.height = 16;
        CHECK_OK(burnish_render(mesh, &drawing, &image, NULL, &error), error);
        burnish_image_destroy(&image);
    }
}

/* A mesh gets the map as its texture: u is in the middle of texel 255 (value - low) / size. */
static void test_triangles(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_coloring coloring = burnish_coloring_default();
    static const char text[] = PLY(ROWS "3 0 1 2\n3 1 2 3\n", FACES);
    options.scalar_property = "heat";
    options.keep_texture_coordinates = 1;
    burnish_mesh *mesh = load_bytes(text, strlen(text), "a.ply", &options);
    coloring.source = BURNISH_COLOR_BY_PROPERTY;
    CHECK1(burnish_mesh_color_by(mesh, &coloring, NULL, NULL) == BURNISH_STATUS_OK);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    double least = 1, most = 0;
    for (size_t i = 0; view && i < view->vertex_count; ++i) {
        const double u = (double)view->texture_coordinates[2 * i];
        least = u < least ? u : least;
        most = u > most ? u : most;
    }
    CHECK(least == 0.5 / 256 && most == 255.5 / 256, "%g to %g", least, most);
    CHECK1(burnish_mesh_get_texture_count(mesh) == 1 &&
           burnish_mesh_get_material(mesh, 0)->textures[BURNISH_TEXTURE_COLOR].texture == 1);
    burnish_mesh_destroy(mesh);
    options.scalar_property = NULL;
    options.keep_texture_coordinates = 0;
    burnish_error error;
    mesh = load_bytes(text, strlen(text), "a.ply", &options);
    CHECK1(burnish_mesh_color_by(mesh, &coloring, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(
        error.text,
        "colours: the mesh has no scalar property; only PLY, PCD, LAS, XYZ and glTF files have "
        "them");
    burnish_mesh_destroy(mesh);
}

/* A glTF attribute of one number per vertex: 1, 0 and 0. */
static void test_gltf(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_coloring coloring = burnish_coloring_default();
    double range[2];
    byte_list file = {.size = 0};
    put_json(&file, "$head'buffers':[$triangle_buffer],'bufferViews':[{'buffer':0,"
                    "'byteLength':36}],'accessors':[$accessor(0,5126,3,VEC3),"
                    "$part(12,5126,3,SCALAR)],$mesh('POSITION':0,'_HEAT':1),$node}");
    options.scalar_property = "_HEAT";
    options.keep_texture_coordinates = 1;
    coloring.source = BURNISH_COLOR_BY_PROPERTY;
    burnish_mesh *mesh = load_bytes(file.bytes, file.size, "a.gltf", &options);
    CHECK1(burnish_mesh_color_by(mesh, &coloring, range, NULL) == BURNISH_STATUS_OK);
    CHECK(range[0] == 0 && range[1] == 1, "%g to %g", range[0], range[1]);
    burnish_mesh_destroy(mesh);
    options.scalar_property = "_COLD";
    check_refused(file.bytes, file.size, "a.gltf", &options, BURNISH_STATUS_FORMAT,
                  "a.gltf: no vertex attribute \"_COLD\" of one number to colour by; "
                  "glTF's names of such attributes begin with _");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_maps());
    RUN(test_points());
    RUN(test_textured_points());
    RUN(test_triangles());
    RUN(test_gltf());
    return test_end("coloring");
}
