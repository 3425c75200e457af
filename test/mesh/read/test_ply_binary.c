/* Binary PLY as most files are: vertices of floats, faces of a uchar and three 32-bit corners; in
 * both byte orders, over more rows than one thread takes, and with one row that is not like the
 * others. The oracle is burnish_mesh_create of the same arrays. */
#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "support.h"

enum { SIDE = 150, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };
_Static_assert(TRIANGLES > 1 << 15, "more rows than the readers take at once");

/* How a file is laid out. */
typedef struct layout {
    const char *length, *corner; /* PLY's types of a face's list */
    int length_size, corner_size;
    int big_endian;
    int has_normals, has_colors;
} layout;

static float positions[3 * VERTICES], normals[3 * VERTICES];
static uint8_t colors[4 * VERTICES];
static uint32_t indices[3 * TRIANGLES];
static uint8_t file[TRIANGLES * 16 + VERTICES * 32 + 1024];
static size_t file_size, faces_begin, row_size;

/* A wavy sheet. The largest corner of a triangle may be any of the three. */
static void make_sheet(void) {
    for (uint32_t i = 0; i < VERTICES; ++i) {
        positions[3 * i] = (float)(i % SIDE);
        positions[3 * i + 1] = (float)(i / SIDE);
        positions[3 * i + 2] = (float)(i * i % 17) * 0.25f;
        normals[3 * i + i % 3] = 1;
        colors[4 * i + i % 3] = (uint8_t)i;
        colors[4 * i + 3] = 255;
    }
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        const uint32_t q = i / 2, a = q / (SIDE - 1) * SIDE + q % (SIDE - 1);
        const uint32_t corners[2][3] = {{a, a + 1, a + SIDE}, {a + 1, a + SIDE + 1, a + SIDE}};
        for (uint32_t k = 0; k < 3; ++k) {
            indices[3 * i + k] = corners[i % 2][(k + q) % 3];
        }
    }
}

static void put(uint64_t bits, int size, int big_endian) {
    for (int i = 0; i < size; ++i) {
        file[file_size++] = (uint8_t)(bits >> 8 * (big_endian ? size - 1 - i : i));
    }
}

static void put_floats(const float *values, int big_endian) {
    for (int k = 0; k < 3; ++k) {
        uint32_t bits;
        memcpy(&bits, values + k, sizeof bits);
        put(bits, 4, big_endian);
    }
}

/* The sheet's first `count` triangles. */
static void write_file(const layout *how, size_t count) {
    file_size = (size_t)snprintf(
        (char *)file, 1024,
        "ply\nformat binary_%s_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
        "property float z\n%s%selement face %zu\nproperty list %s %s vertex_indices\nend_header\n",
        how->big_endian ? "big" : "little", VERTICES,
        how->has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        how->has_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
        count, how->length, how->corner);
    for (size_t i = 0; i < VERTICES; ++i) {
        put_floats(positions + 3 * i, how->big_endian);
        if (how->has_normals) {
            put_floats(normals + 3 * i, how->big_endian);
        }
        for (size_t k = 0; k < 3 && how->has_colors; ++k) {
            put(colors[4 * i + k], 1, 0);
        }
    }
    faces_begin = file_size;
    row_size = (size_t)(how->length_size + 3 * how->corner_size);
    for (size_t i = 0; i < count; ++i) {
        put(3, how->length_size, how->big_endian);
        for (size_t k = 0; k < 3; ++k) {
            put(indices[3 * i + k], how->corner_size, how->big_endian);
        }
    }
}

/* Overwrites corner k of a row; k = -1: its length. */
static void set_value(const layout *how, size_t row, int k, uint32_t value) {
    const size_t end = file_size;
    file_size = faces_begin + row * row_size;
    file_size += k < 0 ? 0 : (size_t)(how->length_size + k * how->corner_size);
    put(value, k < 0 ? how->length_size : how->corner_size, how->big_endian);
    file_size = end;
}

static burnish_status load_file(int threads, burnish_mesh **mesh, burnish_error *error) {
    burnish_load_options options = burnish_load_options_default();
    options.threads = threads;
    options.normals = BURNISH_NORMALS_FILE;
    *error = (burnish_error){0};
    uint8_t *copy = malloc(file_size); /* ends where the file does, for the address sanitizer */
    if (!copy) {
        abort();
    }
    memcpy(copy, file, file_size);
    burnish_status status =
        burnish_mesh_load_memory(copy, file_size, "sheet.ply", &options, mesh, error);
    free(copy);
    return status;
}

static burnish_mesh *expected_mesh(const layout *how, const uint32_t *triangles, size_t count) {
    burnish_load_options options = burnish_load_options_default();
    options.normals = BURNISH_NORMALS_FILE;
    const burnish_mesh_description arrays =
        describe_arrays(positions, how->has_normals ? normals : NULL,
                        how->has_colors ? colors : NULL, VERTICES, triangles, count);
    return create_mesh(&arrays, &options);
}

static const layout LAYOUTS[] = {
    {"uchar", "int", 1, 4, 0, 0, 0},   {"uchar", "uint", 1, 4, 0, 1, 0},
    {"uchar", "int", 1, 4, 0, 0, 1},   {"uint8", "int32", 1, 4, 0, 1, 1},
    {"uchar", "int", 1, 4, 1, 0, 0},   {"uchar", "uint", 1, 4, 1, 1, 1},
    {"int", "int", 4, 4, 0, 0, 0},     {"uchar", "ushort", 1, 2, 0, 0, 0},
    {"ushort", "uint", 2, 4, 1, 0, 1},
};
enum { LAYOUT_COUNT = sizeof LAYOUTS / sizeof LAYOUTS[0] };
static const int THREADS[] = {1, 2, 7};

static void test_layouts(void) {
    for (int i = 0; i < LAYOUT_COUNT; ++i) {
        burnish_mesh *expected = expected_mesh(&LAYOUTS[i], indices, TRIANGLES);
        write_file(&LAYOUTS[i], TRIANGLES);
        for (int t = 0; t < 3; ++t) {
            burnish_mesh *mesh;
            burnish_error error;
            burnish_status status = load_file(THREADS[t], &mesh, &error);
            CHECK(status == BURNISH_STATUS_OK && same_meshes(mesh, expected),
                  "layout %d, %d threads: %s", i, THREADS[t], error.text);
            burnish_mesh_destroy(mesh);
        }
        burnish_mesh_destroy(expected);
    }
}

/* A corner that is not a vertex, in any face: the error names the face. */
static void test_bad_corners(void) {
    static const size_t rows[] = {0, 1, 777, (1 << 15) - 1, 1 << 15, TRIANGLES - 1};
    static const uint32_t values[] = {VERTICES, VERTICES + 1, INT32_MAX, UINT32_MAX, 1u << 31};
    for (int i = 0; i < 6; i += 2) { /* little int, little int with colours, big int */
        const layout *how = &LAYOUTS[i];
        write_file(how, TRIANGLES);
        for (int trial = 0; trial < 6 * 3 * 5; ++trial) {
            const size_t row = rows[trial / 15];
            const int k = trial / 5 % 3;
            burnish_mesh *mesh;
            burnish_error error;
            set_value(how, row, k, values[trial % 5]);
            burnish_status status = load_file(THREADS[trial % 3], &mesh, &error);
            CHECK(status == BURNISH_STATUS_FORMAT && !mesh && strstr(error.text, "sheet.ply: "),
                  "layout %d, row %zu, corner %d = %u: status %d, %s", i, row, k,
                  (unsigned)values[trial % 5], (int)status, error.text);
            burnish_mesh_destroy(mesh);
            set_value(how, row, k, indices[3 * row + (size_t)k]);
        }
        burnish_mesh *mesh;
        burnish_error error;
        CHECK(load_file(2, &mesh, &error) == BURNISH_STATUS_OK, "mended: %s", error.text);
        burnish_mesh_destroy(mesh);
    }
}

/* One quadrilateral among triangles: row by row, it is all the same. */
static void test_odd_row(void) {
    static const size_t rows[] = {0, 40, 1 << 15, TRIANGLES - 2};
    for (int i = 0; i < 6; i += 2) {
        for (size_t r = 0; r < sizeof rows / sizeof rows[0]; ++r) {
            const layout *how = &LAYOUTS[i];
            const size_t row = rows[r], step = (size_t)how->corner_size;

            write_file(how, TRIANGLES);
            const uint32_t *first = indices + 3 * row;
            const uint32_t quad[4] = {first[0], first[1], first[2],
                                      (first[0] + 2 * SIDE + 1) % VERTICES};
            const size_t after = faces_begin + (row + 1) * row_size;
            memmove(file + after + step, file + after, file_size - after);
            set_value(how, row, -1, 4);
            const size_t end = file_size + step;
            file_size = after;
            put(quad[3], (int)step, how->big_endian);
            file_size = end;
            burnish_mesh *meshes[3];
            burnish_error error;
            for (int t = 0; t < 3; ++t) {
                burnish_status status = load_file(THREADS[t], &meshes[t], &error);
                CHECK(status == BURNISH_STATUS_OK && same_meshes(meshes[t], meshes[0]) &&
                          burnish_mesh_get_view(meshes[t])->triangle_count == TRIANGLES + 1,
                      "layout %d, quad in row %zu, %d threads: %s", i, row, THREADS[t], error.text);
            }
            for (int t = 0; t < 3; ++t) {
                burnish_mesh_destroy(meshes[t]);
            }
        }
    }
}

/* A file that ends early, at any of a few bytes near the end. */
static void test_cut(void) {
    for (int i = 0; i < LAYOUT_COUNT; ++i) {
        write_file(&LAYOUTS[i], TRIANGLES);
        const size_t whole = file_size;
        for (size_t cut = 1; cut < 40; cut += 3) {
            burnish_mesh *mesh;
            burnish_error error;
            file_size = whole - cut;
            burnish_status status = load_file(THREADS[cut % 3], &mesh, &error);
            CHECK(status == BURNISH_STATUS_FORMAT && !mesh, "layout %d, %zu bytes short: %d", i,
                  cut, (int)status);
            burnish_mesh_destroy(mesh);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    make_sheet();
    RUN(test_layouts());
    RUN(test_bad_corners());
    RUN(test_odd_row());
    RUN(test_cut());
    return test_end("ply_binary");
}
