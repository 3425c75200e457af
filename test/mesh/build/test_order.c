/* The order of triangles and vertices in a mesh, and building by threads. */
#include <math.h>

#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "support.h"

/* A sheet of SHEET x SHEET squares, with their triangles in random order. Square q's corners are
 * grid point q and its neighbours. */
enum {
    SHEET = 132, /* enough triangles for four threads */
    SHEET_VERTICES = (SHEET + 1) * (SHEET + 1),
    SHEET_TRIANGLES = 2 * SHEET * SHEET
};
typedef struct sheet_mesh {
    float positions[3 * SHEET_VERTICES], normals[3 * SHEET_VERTICES];
    uint8_t colors[4 * SHEET_VERTICES];
    uint32_t indices[3 * SHEET_TRIANGLES];
} sheet_mesh;

/* Row after row. */
static void make_sheet(sheet_mesh *mesh) {
    memset(mesh, 0, sizeof *mesh);
    for (uint32_t i = 0; i < SHEET_VERTICES; ++i) {
        mesh->positions[3 * i] = (float)(i % (SHEET + 1));
        mesh->positions[3 * i + 1] = (float)(i / (SHEET + 1));
        mesh->normals[3 * i + 2] = 1;
        mesh->colors[4 * i + i % 3] = 255;
    }
    for (uint32_t i = 0; i < SHEET_TRIANGLES; ++i) {
        const uint32_t q = i / 2, a = q / SHEET * (SHEET + 1) + q % SHEET, b = a + 1,
                       c = a + SHEET + 1, d = c + 1;
        memcpy(mesh->indices + 3 * i, i % 2 ? (uint32_t[]){b, d, c} : (uint32_t[]){a, b, c}, 12);
    }
}

static void shuffle_sheet(sheet_mesh *mesh) {
    uint64_t state = test_seed(3);
    for (uint32_t i = SHEET_TRIANGLES - 1; i > 0; --i) {
        const uint32_t j = test_random32(&state) % (i + 1);
        uint32_t kept[3];
        memcpy(kept, mesh->indices + 3 * i, sizeof kept);
        memcpy(mesh->indices + 3 * i, mesh->indices + 3 * j, sizeof kept);
        memcpy(mesh->indices + 3 * j, kept, sizeof kept);
    }
}

/* A number of a sheet's triangle by its corners' positions: the square, and which half. */
static uint32_t sheet_number(const float *positions, const uint32_t *corners) {
    float x = SHEET, y = SHEET, sum = 0;
    for (int k = 0; k < 3; ++k) {
        const float *p = positions + 3 * (size_t)corners[k];
        x = p[0] < x ? p[0] : x;
        y = p[1] < y ? p[1] : y;
        sum += p[0] + p[1];
    }
    return 2 * ((uint32_t)y * SHEET + (uint32_t)x) + (sum - 3 * (x + y) > 3);
}

static burnish_mesh *build_sheet(const sheet_mesh *sheet, int threads) {
    static uint16_t numbers[SHEET_TRIANGLES];
    burnish_load_options options = burnish_load_options_default();
    burnish_material materials[7];
    burnish_mesh_description arrays =
        describe_arrays(sheet->positions, sheet->normals, sheet->colors, SHEET_VERTICES,
                        sheet->indices, SHEET_TRIANGLES);
    for (size_t i = 0; i < SHEET_TRIANGLES; ++i) {
        numbers[i] = (uint16_t)(sheet_number(sheet->positions, sheet->indices + 3 * i) % 7);
    }
    for (int i = 0; i < 7; ++i) {
        materials[i] = burnish_material_default();
    }
    arrays.materials = materials;
    arrays.material_count = 7;
    arrays.triangle_materials = (burnish_array){numbers, SHEET_TRIANGLES, 0};
    options.threads = threads;
    return create_mesh(&arrays, &options);
}

/* The triangles of a large mesh are ordered in space, each with its material, colours and normals,
 * the same way for any number of threads. */
static void test_order(void) {
    static sheet_mesh sheet;
    static uint8_t seen[SHEET_TRIANGLES];
    make_sheet(&sheet);
    shuffle_sheet(&sheet);
    burnish_mesh *mesh = build_sheet(&sheet, 1), *other = build_sheet(&sheet, 3);
    if (!CHECK1(mesh != NULL && other != NULL)) {
        return;
    }
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh),
                            *same = burnish_mesh_get_view(other);
    CHECK1(view->triangle_count == SHEET_TRIANGLES && view->vertex_count == SHEET_VERTICES);
    CHECK1(memcmp(view->indices, same->indices, sizeof(uint32_t) * 3 * SHEET_TRIANGLES) == 0);
    CHECK1(memcmp(view->positions, same->positions, sizeof sheet.positions) == 0);
    double way = 0;
    int wrong = 0;
    for (size_t i = 0; i < SHEET_TRIANGLES; ++i) {
        const uint32_t *corners = view->indices + 3 * i;
        const uint32_t number = sheet_number(view->positions, corners);
        wrong += seen[number]++ || view->triangle_materials[i] != number % 7;
        for (int k = 0; k < 3; ++k) {
            const float *p = view->positions + 3 * (size_t)corners[k];
            const uint32_t vertex = (uint32_t)p[1] * (SHEET + 1) + (uint32_t)p[0];
            wrong += view->colors[4 * (size_t)corners[k] + vertex % 3] != 255;
        }
        if (i > 0) {
            const float *p = view->positions + 3 * (size_t)corners[0];
            const float *q = view->positions + 3 * (size_t)corners[-3];
            way += fabs((double)p[0] - q[0]) + fabs((double)p[1] - q[1]);
        }
    }
    CHECK(wrong == 0, "%d triangles or corners are not what they were", wrong);
    /* random places are 88 apart, places in cells of 9 x 9 are 6 */
    CHECK(way / SHEET_TRIANGLES < 10, "neighbours are %g apart", way / SHEET_TRIANGLES);
    burnish_mesh_destroy(mesh);
    burnish_mesh_destroy(other);
}

/* Vertices that are equal, or differ in their normal or colour alone, and triangles without area,
 * with all normals and with a missing one: any number of threads builds the same mesh. */
static void test_build_by_threads(void) {
    static sheet_mesh sheet;
    for (int missing = 0; missing < 2; ++missing) {
        make_sheet(&sheet);
        shuffle_sheet(&sheet);
        for (uint32_t i = 1; i < SHEET_VERTICES; ++i) {
            if (i % 5 == 0) { /* another vertex at the position before */
                memcpy(sheet.positions + 3 * i, sheet.positions + 3 * (i - 1), 12);
                memcpy(sheet.colors + 4 * i, sheet.colors + 4 * (i - 1), 4);
                sheet.colors[4 * i + 1] = i % 2 ? 9 : sheet.colors[4 * i + 1];
                sheet.normals[3 * i] = i % 3 ? 0.0f : 1.0f;
            }
        }
        sheet.normals[2] = missing ? 0.0f : 1.0f;
        OWNED_MESH *mesh = build_sheet(&sheet, 1);
        if (!CHECK1(mesh != NULL)) {
            return;
        }
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        CHECK1(view->triangle_count < SHEET_TRIANGLES && view->vertex_count < SHEET_VERTICES);
        for (int threads = 2; threads < 8; ++threads) {
            OWNED_MESH *other = build_sheet(&sheet, threads);
            CHECK(other && same_meshes(mesh, other), "%d threads, kind %d", threads, missing);
        }
    }
}

/* A file whose neighbours are near each other is not reordered. A file whose neighbours are far
 * apart is, even if every other triangle is the next one in space. */
static void test_order_of_files(void) {
    static sheet_mesh sheet;
    for (int apart = 0; apart < 2; ++apart) {
        make_sheet(&sheet);
        for (size_t i = 0; apart && i < SHEET_TRIANGLES / 2; i += 2) {
            uint32_t kept[3], *near = sheet.indices + 3 * i,
                              *far = near + 3 * (SHEET_TRIANGLES / 2);
            memcpy(kept, near, sizeof kept);
            memcpy(near, far, sizeof kept);
            memcpy(far, kept, sizeof kept);
        }
        OWNED_MESH *mesh = build_sheet(&sheet, 2);
        if (!CHECK1(mesh != NULL)) {
            return;
        }
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        size_t moved = 0;
        for (size_t i = 0; i < SHEET_TRIANGLES; ++i) {
            moved += sheet_number(view->positions, view->indices + 3 * i) !=
                     sheet_number(sheet.positions, sheet.indices + 3 * i);
        }
        CHECK(apart ? moved > SHEET_TRIANGLES / 2 : moved == 0, "%d: %zu triangles moved", apart,
              moved);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_build_by_threads());
    RUN(test_order());
    RUN(test_order_of_files());
    return test_end("order");
}
