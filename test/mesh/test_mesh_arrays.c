/* burnish_mesh_create: arrays of every shape, materials, every error, failing allocations,
 * cancelling, progress, and the caller's floating-point environment. */
#include <math.h>

#include "counting_context.h"
#include "mesh_arrays.h"
#include "support.h"

enum { SIDES = 600, VERTICES = SIDES + 2, TRIANGLES = SIDES + 1 };

/* A cone whose tip has more faces than are measured at once, and a triangle without area. */
static float positions[3 * VERTICES], normals[3 * VERTICES], texcoords[2 * VERTICES];
static uint8_t colors[4 * VERTICES];
static uint32_t indices[3 * TRIANGLES];

static void make_cone(void) {
    for (uint32_t i = 0; i < SIDES; ++i) {
        const double angle = 2 * acos(-1.0) * i / SIDES;
        positions[3 * i] = (float)cos(angle);
        positions[3 * i + 1] = (float)sin(angle);
        memcpy(indices + 3 * i, (uint32_t[]){SIDES, i, (i + 1) % SIDES}, 12);
    }
    positions[3 * SIDES + 2] = 1;
    positions[3 * SIDES + 4] = 0x1p-140f; /* subnormal */
    for (uint32_t i = 0; i < VERTICES; ++i) {
        memcpy(normals + 3 * i, (float[]){positions[3 * i], positions[3 * i + 1], 0.1f}, 12);
        memcpy(texcoords + 2 * i, (float[]){(float)i, 1.0f / (float)(i + 1)}, 8);
        memcpy(colors + 4 * i, (uint8_t[]){(uint8_t)i, (uint8_t)(i / 7), 3, 255}, 4);
    }
}

/* ---- Shapes of arrays ---- */

static burnish_mesh *create(const burnish_mesh_description *arrays, int texture_coordinates) {
    burnish_load_options options = burnish_load_options_default();
    options.keep_texture_coordinates = texture_coordinates;
    return create_mesh(arrays, &options);
}

/* All attributes of a vertex in one struct, with padding. */
typedef struct fat_vertex {
    float position[3];
    uint8_t pad, color[4];
    float normal[3], texcoord[2];
} fat_vertex;

static void test_strides(void) {
    static fat_vertex fat[VERTICES];
    static uint16_t shorts[3 * TRIANGLES];
    burnish_mesh_description packed =
        describe_arrays(positions, normals, colors, VERTICES, indices, TRIANGLES);
    packed.texture_coordinates = (burnish_array){texcoords, VERTICES, 0};
    for (size_t i = 0; i < VERTICES; ++i) {
        memcpy(fat[i].position, positions + 3 * i, 12);
        memcpy(fat[i].normal, normals + 3 * i, 12);
        memcpy(fat[i].color, colors + 4 * i, 4);
        memcpy(fat[i].texcoord, texcoords + 2 * i, 8);
    }
    for (size_t i = 0; i < (size_t)3 * TRIANGLES; ++i) {
        shorts[i] = (uint16_t)indices[i];
    }
    burnish_mesh_description strided = burnish_mesh_description_default();
    strided.positions = (burnish_array){fat->position, VERTICES, sizeof *fat};
    strided.normals = (burnish_array){fat->normal, VERTICES, sizeof *fat};
    strided.colors = (burnish_array){fat->color, VERTICES, sizeof *fat};
    strided.texture_coordinates = (burnish_array){fat->texcoord, VERTICES, sizeof *fat};
    strided.indices = (burnish_array){shorts, (size_t)3 * TRIANGLES, 0};
    strided.index_size = 2;
    burnish_mesh *a = create(&packed, 1), *b = create(&strided, 1);
    CHECK(a && same_meshes(a, b), "%s", "strides and 16-bit indices");
    CHECK1(memcmp(burnish_mesh_get_view(a)->colors, burnish_mesh_get_view(b)->colors,
                  4 * burnish_mesh_get_view(a)->vertex_count) == 0);
    burnish_mesh_destroy(a);
    burnish_mesh_destroy(b);
}

/* Bytes as indices, and none at all. */
static void test_small_indices(void) {
    static const float square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint8_t bytes[] = {0, 1, 2, 3, 4, 5};
    static const uint32_t words[] = {0, 1, 2, 3, 4, 5};
    burnish_mesh_description arrays = describe_arrays(square, NULL, NULL, 6, words, 2);
    OWNED_MESH *whole = create(&arrays, 0);
    arrays.indices.items = bytes;
    arrays.index_size = 1;
    OWNED_MESH *small = create(&arrays, 0);
    arrays.indices = (burnish_array){0};
    OWNED_MESH *none = create(&arrays, 0);
    CHECK(whole && same_meshes(whole, small), "%s", "8-bit indices");
    CHECK(whole && same_meshes(whole, none), "%s", "no indices");
    CHECK1(burnish_mesh_get_view(none)->vertex_count == 4);
}

/* Two triangles that meet in an edge; at one of its ends they have other texture coordinates. If
 * these are kept, there are two vertices, and each corner keeps its coordinates. */
static void test_texture_coordinates(void) {
    static const float square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const float own[] = {0, 0, 1, 0, 0, 1, 0.5f, 0, 1, 1, 0, 1};
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){square, 6, 0};
    arrays.texture_coordinates = (burnish_array){own, 6, 0};
    burnish_mesh *dropped = create(&arrays, 0), *kept = create(&arrays, 1);
    const burnish_mesh_view *view = burnish_mesh_get_view(kept);
    CHECK1(burnish_mesh_get_view(dropped)->vertex_count == 4);
    CHECK1(burnish_mesh_get_view(dropped)->texture_coordinates == NULL);
    if (CHECK(view->vertex_count == 5 && view->texture_coordinates, "%zu", view->vertex_count)) {
        for (size_t i = 0; i < 6; ++i) {
            const size_t vertex = view->indices[i];
            CHECK(memcmp(view->texture_coordinates + 2 * vertex, own + 2 * i, 8) == 0 &&
                      memcmp(view->positions + 3 * vertex, square + 3 * i, 12) == 0,
                  "corner %zu", i);
        }
    }
    burnish_mesh_destroy(dropped);
    burnish_mesh_destroy(kept);
}

static void refuse(const burnish_mesh_description *arrays, const char *text) {
    burnish_load_options options = burnish_load_options_default();
    burnish_error error = {0};
    burnish_mesh *mesh = (burnish_mesh *)&error;
    CHECK(burnish_mesh_create(arrays, &options, &mesh, &error) == BURNISH_STATUS_ARGUMENT && !mesh,
          "%s", text);
    CHECK_TEXT(error.text, text);
}

static void test_refusals(void) {
    static const float bad[] = {0, 0, 1, NAN, 0, 0};
    static const float square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    burnish_material material = burnish_material_default();
    burnish_mesh_description good = burnish_mesh_description_default(), wrong;
    good.positions = (burnish_array){square, 3, 0};
    wrong = good;
    wrong.cookie = 0;
    refuse(&wrong, "description: not initialised; start from burnish_mesh_description_default()");
    wrong = good;
    wrong.normals = (burnish_array){square, 2, 0};
    refuse(&wrong, "normals: count is 2; expected one per vertex, that is 3");
    wrong = good;
    wrong.positions.stride = 8;
    refuse(&wrong, "positions: stride is 8; an item has 12 bytes");
    wrong = good;
    wrong.index_size = 3;
    refuse(&wrong, "index_size: 3 is not 1, 2 or 4");
    wrong = good;
    wrong.positions.count = 4;
    refuse(&wrong, "positions: count is 4; triangles need a multiple of 3, at least 3");
    wrong = good;
    wrong.texture_coordinates = (burnish_array){bad, 3, 0};
    refuse(&wrong, "texture_coordinates[1]: number 2 of 2 is not finite");
    wrong = good;
    wrong.up_axis[1] = 0;
    refuse(&wrong, "up_axis: needs three finite numbers, not all 0; use for example 0, 1, 0");
    wrong = good;
    wrong.material_count = 2;
    refuse(&wrong, "materials: there are 2 at NULL; expected at most 65536, and an array");
    wrong.materials = &material;
    wrong.material_count = 1;
    material.diffuse[1] = 2;
    refuse(&wrong, "materials[0]: diffuse[1] is 2, not in [0, 1]");
}

/* ---- Materials, and what is refused ---- */

/* Four triangles in a row, the second without area; material numbers as given. */
static burnish_status build_materials(size_t material_count, const uint16_t numbers[4],
                                      burnish_mesh **mesh, burnish_error *error) {
    static const float row[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
    static const uint32_t corners[] = {0, 1, 2, 1, 1, 2, 1, 3, 2, 2, 3, 4};
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_description arrays = describe_arrays(row, NULL, NULL, 5, corners, 4);
    burnish_material materials[3];
    for (size_t i = 0; i < 3; ++i) {
        materials[i] = burnish_material_default();
        materials[i].exponent = (float)(10 + i);
    }
    arrays.name = "row";
    arrays.materials = materials;
    arrays.material_count = material_count;
    arrays.triangle_materials = (burnish_array){numbers, 4, 0};
    return burnish_mesh_create(&arrays, &options, mesh, error);
}

static void test_material_numbers(void) {
    burnish_mesh *mesh;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    const uint16_t numbers[4] = {2, 1, 0, 2}, zeros[4] = {0};
    CHECK_OK(build_materials(3, numbers, &mesh, &error), error);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK1(view->triangle_count == 3 && burnish_mesh_get_material_count(mesh) == 3);
    const uint16_t *kept = view->triangle_materials;
    if (CHECK1(kept != NULL)) {
        CHECK(kept[0] == 2 && kept[1] == 0 && kept[2] == 2, "%d %d %d", kept[0], kept[1], kept[2]);
    }
    CHECK1(burnish_mesh_get_material(mesh, 2)->exponent == 12);
    CHECK1(burnish_mesh_get_material(mesh, 3) == NULL);
    burnish_mesh_destroy(mesh);

    CHECK_OK(build_materials(1, zeros, &mesh, &error), error);
    CHECK1(burnish_mesh_get_view(mesh)->triangle_materials == NULL);
    CHECK1(burnish_mesh_get_material_count(mesh) == 1);
    CHECK1(burnish_mesh_get_material(mesh, 0)->exponent == 10);
    burnish_mesh_destroy(mesh);

    CHECK_OK(build_materials(0, zeros, &mesh, &error), error);
    burnish_material grey = burnish_material_default();
    CHECK1(burnish_mesh_get_material_count(mesh) == 1);
    CHECK1(memcmp(burnish_mesh_get_material(mesh, 0), &grey, sizeof grey) == 0);
    burnish_mesh_destroy(mesh);

    CHECK1(build_materials(2, numbers, &mesh, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "triangle_materials[0]: 2 is out of range, there are 2 materials");
    CHECK1(mesh == NULL);
}

static void test_set_material(void) {
    const burnish_mesh_description cone =
        describe_arrays(positions, NULL, NULL, VERTICES, indices, TRIANGLES);
    OWNED_MESH *mesh = create(&cone, 0);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_material m = burnish_material_default();
    CHECK1(m.has_diffuse == 0 && m.exponent >= 1);
    m.exponent = 65536;
    m.diffuse[1] = 1;
    m.specular[2] = 0;
    CHECK_OK(burnish_mesh_set_material(mesh, 0, &m, &error), error);
    CHECK1(memcmp(burnish_mesh_get_material(mesh, 0), &m, sizeof m) == 0);
    CHECK1(burnish_mesh_set_material(mesh, 1, &m, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "index: 1 is out of range, the mesh has 1 material");
    CHECK1(burnish_mesh_set_material(NULL, 0, &m, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_mesh_set_material(mesh, 0, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    const float bad[] = {-0.1f, 1.5f, NAN, INFINITY};
    for (int i = 0; i < 4; ++i) {
        burnish_material wrong[4] = {m, m, m, m};
        wrong[0].ambient[0] = wrong[1].diffuse[1] = wrong[2].specular[2] = bad[i];
        wrong[3].exponent = bad[i] == 1.5f ? 0.5f : bad[i];
        const char *words[] = {"ambient[0]", "diffuse[1]", "specular[2]", "exponent"};
        for (int k = 0; k < 4; ++k) {
            CHECK1(burnish_mesh_set_material(mesh, 0, &wrong[k], &error) ==
                   BURNISH_STATUS_ARGUMENT);
            CHECK(strstr(error.text, words[k]), "%s", error.text);
        }
    }
    CHECK(memcmp(burnish_mesh_get_material(mesh, 0), &m, sizeof m) == 0,
          "a refused one was stored");
}

/* Plain positions and indices. */
static void refuse_plain(const float *vertices, size_t vertex_count, const uint32_t *corners,
                         size_t triangle_count, const char *text) {
    const burnish_mesh_description arrays =
        describe_arrays(vertices, NULL, NULL, vertex_count, corners, triangle_count);
    refuse(&arrays, text);
}

static void test_arguments(void) {
    float square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint32_t corners[] = {0, 1, 2};
    refuse_plain(NULL, 3, corners, 1, "positions: NULL; pass an array");
    refuse_plain(square, 3, NULL, 1, "indices: items is NULL, but count is 3; pass an array");
    refuse_plain(square, 2, corners, 1, "positions: count is 2, not in [3, 2^32 - 2]");
    refuse_plain(square, UINT32_MAX, corners, 1,
                 "positions: count is 4294967295, not in [3, 2^32 - 2]");
    refuse_plain(square, 3, corners, 0,
                 "indices: count is 0; triangles need a multiple of 3, at least 3");
    corners[2] = 3;
    refuse_plain(square, 3, corners, 1, "indices[2]: 3 is out of range, there are 3 vertices");
    corners[2] = 2;
    square[4] = NAN;
    refuse_plain(square, 3, corners, 1, "positions[1]: number 2 of 3 is not finite");
    square[4] = -INFINITY;
    refuse_plain(square, 3, corners, 1, "positions[1]: number 2 of 3 is not finite");
    square[4] = 0;
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_description arrays = describe_arrays(square, NULL, NULL, 3, corners, 1);
    CHECK1(burnish_mesh_create(&arrays, &options, NULL, NULL) == BURNISH_STATUS_ARGUMENT);
    /* Far too many triangles are rejected before a byte of them is read. */
    burnish_mesh *mesh = NULL;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    arrays.indices.count = (size_t)3 << 31;
    CHECK1(burnish_mesh_create(&arrays, &options, &mesh, &error) == BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text, "mesh: more than 1431655764 triangles; split or simplify the mesh");
    burnish_mesh_destroy(NULL);
    CHECK1(burnish_mesh_get_view(NULL) == NULL && burnish_mesh_get_material_count(NULL) == 0);
}

static void test_options(void) {
    const float square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const uint32_t corners[] = {0, 1, 2, 1, 3, 2};
    const burnish_mesh_description arrays = describe_arrays(square, NULL, NULL, 4, corners, 2);
    burnish_load_options wrong[9];
    const char *words[9] = {"burnish_load_options_default()",
                            "crease_angle",
                            "crease_angle",
                            "tessellation",
                            "tessellation",
                            "max_triangles",
                            "format",
                            "format",
                            "format"};
    for (int i = 0; i < 9; ++i) {
        wrong[i] = burnish_load_options_default();
    }
    memset(&wrong[0], 0, sizeof wrong[0]);
    wrong[1].crease_angle = 180.5;
    wrong[2].crease_angle = NAN;
    wrong[3].tessellation = 0;
    wrong[4].tessellation = 257;
    wrong[5].max_triangles = 1431655765;
    wrong[6].format = BURNISH_FORMAT_COUNT;
    wrong[7].format = (burnish_format)-1;
    wrong[8].format = BURNISH_FORMAT_ARRAYS;
    for (int i = 0; i < 10; ++i) {
        burnish_error error = {BURNISH_STATUS_OK, ""};
        burnish_mesh *mesh = (burnish_mesh *)&error;
        const burnish_load_options *options = i < 9 ? &wrong[i] : NULL;
        CHECK(burnish_mesh_create(&arrays, options, &mesh, &error) == BURNISH_STATUS_ARGUMENT, "%d",
              i);
        CHECK(mesh == NULL && strstr(error.text, i < 9 ? words[i] : "NULL"), "%s", error.text);
    }
    burnish_load_options options = burnish_load_options_default();
    CHECK1(options.crease_angle == BURNISH_CREASE_AUTO && options.tessellation == 16);
    CHECK1(options.max_triangles == 1431655764 && options.max_input_bytes >> 30 == 16);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_mesh *mesh = NULL;
    options.max_triangles = 1;
    CHECK1(burnish_mesh_create(&arrays, &options, &mesh, &error) == BURNISH_STATUS_LIMIT);
    CHECK(strstr(error.text, "mesh: more than 1 triangles; raise the limit"), "%s", error.text);
}

/* ---- Contexts ---- */

/* Vertices by the file's normals, by generated ones, with colours and texture coordinates. */
static burnish_mesh_description kind_of_mesh(int kind) {
    burnish_mesh_description arrays =
        describe_arrays(positions, kind == 0 ? normals : NULL, kind == 2 ? colors : NULL, VERTICES,
                        indices, TRIANGLES);
    if (kind == 2) {
        arrays.texture_coordinates = (burnish_array){texcoords, VERTICES, 0};
    }
    return arrays;
}

static burnish_status make_mesh(const void *data, const burnish_load_options *options,
                                burnish_mesh **mesh, burnish_error *error) {
    const int kind = *(const int *)data;
    const burnish_mesh_description arrays = kind_of_mesh(kind);
    const burnish_framing framing = burnish_framing_default();
    burnish_load_options own = *options;
    burnish_camera camera;
    own.keep_texture_coordinates = 1;
    own.measure = kind == 1;
    burnish_status status = burnish_mesh_create(&arrays, &own, mesh, error);
    if (status == BURNISH_STATUS_OK) {
        CHECK1(burnish_mesh_get_view(*mesh)->triangle_count == TRIANGLES - 1 &&
               burnish_mesh_get_warning_count(*mesh) == 0); /* one has no area: too few to warn */
        status = burnish_camera_frame(*mesh, &framing, &camera, error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_mesh_destroy(*mesh);
        *mesh = NULL;
    }
    return status;
}

static void test_stopped(int kind, int threads) {
    check_failures(make_mesh, &kind, threads, 0);
    check_failures(make_mesh, &kind, threads, 1);
}

/* ---- The floating-point environment ---- */

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    make_cone();
    RUN(test_strides());
    RUN(test_small_indices());
    RUN(test_texture_coordinates());
    RUN(test_refusals());
    RUN(test_material_numbers());
    RUN(test_set_material());
    RUN(test_arguments());
    RUN(test_options());
    RUN(test_stopped(0, 1));
    RUN(test_stopped(1, 1));
    RUN(test_stopped(1, 3));
    RUN(test_stopped(2, 3));
    return test_end("mesh_arrays");
}
