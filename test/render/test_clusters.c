/* Clusters of vertices against cells found in double precision. */
#include "render/light/vertex_clusters.h"

#include <math.h>

#include "support.h"

enum { VERTICES = 4000, TRIANGLES = 6000, AXIS_CELLS = 64 };

typedef struct soup {
    float positions[3 * VERTICES];
    uint32_t indices[3 * TRIANGLES];
    uint16_t transparent[TRIANGLES / 16 + 1];
} soup;

/* The cell of a position. The middle of the mesh is the corner of a cell. */
static int cell_of(const float *position) {
    int cell = 0;
    for (int k = 0; k < 3; ++k) {
        cell = cell * AXIS_CELLS + (int)floor(position[k] * 16.0 + AXIS_CELLS / 2);
    }
    return cell;
}

/* Positions are multiples of 1/64, so a cell has 64 of them and no cell depends on rounding. */
static burnish_mesh_view make_soup(soup *made, uint64_t *state) {
    const float half = 0x1.279a74p-1f; /* sqrt(1 / 3): of a box with corners on the unit sphere */
    memset(made, 0, sizeof *made);
    for (int i = 0; i < 3 * VERTICES; ++i) {
        made->positions[i] = (float)(test_random32(state) % 32) / 64 - 0.25f + 1 / 256.0f;
    }
    for (int i = 0; i < 3 * TRIANGLES; ++i) {
        made->indices[i] = test_random32(state) % VERTICES;
        if (i % 3 && test_random32(state) % 2) {
            made->indices[i] = (made->indices[i - 1] + 1) % VERTICES;
            memcpy(made->positions + 3 * made->indices[i],
                   made->positions + 3 * made->indices[i - 1], 3 * sizeof(float));
        }
        made->transparent[i / 48] |= (uint16_t)((test_random32(state) % 8 == 0) << i / 3 % 16);
    }
    return (burnish_mesh_view){.vertex_count = VERTICES,
                               .triangle_count = TRIANGLES,
                               .positions = made->positions,
                               .indices = made->indices,
                               .bounds_min = {-half, -half, -half},
                               .bounds_max = {half, half, half}};
}

/* Exactly the triangles whose corners are in three cells are left, in their order. */
static void check_soup(const soup *made, const burnish_mesh_view *mesh, const uint16_t *transparent,
                       burnish_clusters *clusters) {
    burnish_error error;
    burnish_memory memory = burnish_memory_of(NULL, &error);
    burnish_mesh_view coarse;
    size_t left = 0;
    CHECK(burnish_clusters_make(clusters, mesh, 1 / 16.0, transparent, &memory, &coarse) ==
              BURNISH_STATUS_OK,
          "%s", error.text);
    for (size_t i = 0; i < TRIANGLES; ++i) {
        int cells[3];
        for (int k = 0; k < 3; ++k) {
            cells[k] = cell_of(made->positions + 3 * made->indices[3 * i + k]);
        }
        if (cells[0] == cells[1] || cells[1] == cells[2] || cells[2] == cells[0] ||
            (transparent && transparent[i / 16] >> i % 16 & 1)) {
            continue;
        }
        for (int k = 0; k < 3 && left < coarse.triangle_count; ++k) {
            const uint32_t vertex = coarse.indices[3 * left + k];
            CHECK(vertex < coarse.vertex_count &&
                      cell_of(coarse.positions + 3 * vertex) == cells[k],
                  "corner %d of triangle %zu left its cell", k, i);
        }
        ++left;
    }
    CHECK(left == coarse.triangle_count && left > 0, "%zu triangles are left instead of %zu",
          coarse.triangle_count, left);
    CHECK(coarse.vertex_count <= 512, "%zu clusters in 512 cells", coarse.vertex_count);
}

static void test_soups(void) {
    static soup made;
    burnish_clusters clusters = {0};
    uint64_t state = test_seed(76);
    for (int i = 0; i < 20; ++i) {
        const burnish_mesh_view mesh = make_soup(&made, &state);
        check_soup(&made, &mesh, i % 2 ? made.transparent : NULL, &clusters);
    }
    burnish_clusters_destroy(&clusters, NULL);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_soups());
    return test_end("clusters");
}
