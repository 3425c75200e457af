/* Pairs of depth maps, whose triangles skip lists and tiles, against maps one by one; and clusters of
 * vertices for them. */
#include "render/light/maps/depth_map.h"

#include <math.h>

#include "burnish/kernels.h"
#include "raster/raster_ops.h"
#include "render/light/maps/occlusion.h"
#include "render/light/maps/vertex_clusters.h"
#include "support.h"

enum {
    PAIRS = 3,
    SIZE_LARGE = 256,
    TRIANGLES = 300,
    LARGE_TOLERANCE = 1 /* codes: large triangles are planes, which are rounded elsewhere */
};

typedef struct soup {
    float positions[9 * TRIANGLES];
    uint32_t indices[3 * TRIANGLES];
    burnish_mesh_view mesh;
} soup;

/* Triangles of several sizes around random places of a box; some share edges, some are flat, some
 * have a vertex twice. */
static void make_soup(soup *made, size_t count, uint64_t *state) {
    static const float sizes[] = {0.003f, 0.02f, 0.06f, 0.2f, 0.5f, 1};
    float size = sizes[test_random32(state) % 6];
    memset(made, 0, sizeof *made);
    for (size_t t = 0; t < count; ++t) {
        float *p = made->positions + 9 * t, center[3];
        size = test_random32(state) % 8 ? size : sizes[test_random32(state) % 6];
        for (int k = 0; k < 3; ++k) {
            center[k] = test_uniform_float(state, size - 1, 1 - size);
        }
        for (int i = 0; i < 9; ++i) {
            p[i] = center[i % 3] + test_uniform_float(state, -size, size);
        }
        if (t > 0 && test_random32(state) % 3 == 0) {
            memcpy(p, p - 3, 3 * sizeof *p);
            memcpy(p + 3, p - 6, 3 * sizeof *p);
        }
        for (uint32_t i = 0; i < 3; ++i) {
            made->indices[3 * t + i] = (uint32_t)(3 * t) + i;
        }
        if (test_random32(state) % 30 == 0) {
            made->indices[3 * t + 1] = made->indices[3 * t];
        }
    }
    made->mesh = (burnish_mesh_view){.vertex_count = 3 * count,
                                     .triangle_count = count,
                                     .positions = made->positions,
                                     .indices = made->indices,
                                     .bounds_min = {-1, -1, -1},
                                     .bounds_max = {1, 1, 1}};
}

/* Moves vertices to corners and centres of texels, seen along Z: edges that pass through centres
 * belong to one of two triangles. */
static void snap_soup(soup *made, const burnish_map_view *view) {
    const float half = 0.577350269f; /* of the box whose corners are on the unit sphere */
    for (size_t i = 0; i < 3 * made->mesh.vertex_count; ++i) {
        const double steps = (double)(made->positions[i] * half) * 2 * view->texels;
        made->positions[i] = (float)(floor(steps) / (2 * view->texels));
    }
    for (int k = 0; k < 3; ++k) {
        made->mesh.bounds_min[k] = -half;
        made->mesh.bounds_max[k] = half;
    }
}

/* One that this processor has. */
static burnish_isa pick_isa(uint64_t *state) {
    uint32_t isa;
    do {
        isa = test_random32(state) % 32;
    } while (!(burnish_isa_available() >> isa & 1));
    return (burnish_isa)isa;
}

typedef struct map_run {
    burnish_status status;
    burnish_error error;
    uint16_t depths[2 * PAIRS * SIZE_LARGE * SIZE_LARGE];
} map_run;

/* One by one by scalar code. */
static void draw_each(const soup *from, burnish_map_drawer *drawer, const burnish_map_view *views,
                      int count, map_run *run) {
    const size_t texels = (size_t)views->size * (size_t)views->size;
    burnish_tasks tasks;
    burnish_memory memory = burnish_memory_of(NULL, &run->error);
    burnish_tasks_begin(&tasks, NULL, 1);
    memset(run, 0, sizeof *run);
    drawer->ops = burnish_raster_ops_for(BURNISH_ISA_SCALAR);
    for (int i = 0; i < 2 * count && run->status == BURNISH_STATUS_OK; ++i) {
        const burnish_map_view view = i % 2 ? burnish_map_view_back(views[i / 2]) : views[i / 2];
        run->status = burnish_map_draw(drawer, &from->mesh, &view, run->depths + (size_t)i * texels,
                                       &tasks, &memory);
    }
}

static void draw_pairs(const soup *from, burnish_map_drawer *drawer, const burnish_map_view *views,
                       int count, burnish_isa isa, int threads, map_run *run) {
    const size_t texels = (size_t)views->size * (size_t)views->size;
    burnish_tasks tasks;
    burnish_memory memory = burnish_memory_of(NULL, &run->error);
    burnish_tasks_begin(&tasks, NULL, threads);
    memset(run, 0, sizeof *run);
    memset(run->depths, 0x55, sizeof run->depths);
    drawer->ops = burnish_raster_ops_for(isa);
    run->status = burnish_map_pairs_draw(
        drawer, &from->mesh, &(burnish_map_pairs){views, count, run->depths, texels, NULL}, &tasks,
        &memory);
    memset(run->depths + 2 * (size_t)count * texels, 0,
           sizeof run->depths - 2 * (size_t)count * texels * sizeof *run->depths);
}

/* How far apart two codes are; where only one shows something, very far. */
static int distance(uint16_t a, uint16_t b) {
    return !a != !b ? INT32_MAX : a > b ? a - b : b - a;
}

/* Pairs equal single maps, up to a tolerance for large triangles, and do not depend on threads or
 * the instruction set. */
static void check_soup(const soup *from, const burnish_map_view *views, int count,
                       burnish_map_drawer *drawer, uint64_t *state, const char *what) {
    static map_run plain, pairs, run;
    const size_t texels = (size_t)views->size * (size_t)views->size;
    double worst = 0;
    draw_each(from, drawer, views, count, &plain);
    draw_pairs(from, drawer, views, count, BURNISH_ISA_SCALAR, 1, &pairs);
    CHECK(pairs.status == plain.status && strcmp(pairs.error.text, plain.error.text) == 0,
          "%s: \"%s\" instead of \"%s\"", what, pairs.error.text, plain.error.text);
    const burnish_isa isa = pick_isa(state);
    draw_pairs(from, drawer, views, count, isa, 1 + (int)(test_random32(state) % 2), &run);
    CHECK(run.status == pairs.status && memcmp(run.depths, pairs.depths, sizeof pairs.depths) == 0,
          "%s: %s: depths differ", what, burnish_isa_name(isa));
    for (size_t i = 0; i < 2 * (size_t)count * texels && plain.status == BURNISH_STATUS_OK; ++i) {
        worst = fmax(worst, distance(plain.depths[i], pairs.depths[i]));
    }
    CHECK(worst <= LARGE_TOLERANCE, "%s: depths differ by %g codes", what, worst);
}

static void test_soups(void) {
    static soup made;
    burnish_map_drawer drawer = {.max_overdraw = 1e9};
    uint64_t state = test_seed(74);
    for (int i = 0; i < 400; ++i) {
        const int count = 1 + (int)(test_random32(&state) % PAIRS);
        const int first = (int)(test_random32(&state) % 30), size = i % 3 ? 128 : SIZE_LARGE;
        burnish_map_view views[PAIRS];
        make_soup(&made, 1 + test_random32(&state) % TRIANGLES, &state);
        for (int k = 0; k < count; ++k) {
            views[k] = burnish_occlusion_view(2 * (first + k), 64, size);
        }
        drawer.max_overdraw = 1e9;
        check_soup(&made, views, count, &drawer, &state, "any");
        views[0] = burnish_map_view_make((burnish_vec3){0, 0, 1}, (burnish_vec3){1, 0, 0}, size);
        snap_soup(&made, views);
        check_soup(&made, views, 1, &drawer, &state, "snapped");
    }
    burnish_map_drawer_destroy(&drawer, NULL);
}

/* Small and large triangles are counted alike: the limit and the message are the same. */
static void test_overdraw(void) {
    static soup made;
    burnish_map_drawer drawer = {0};
    uint64_t state = test_seed(75);
    int refused = 0;
    for (int i = 0; i < 100; ++i) {
        static map_run run;
        const burnish_map_view views[2] = {burnish_occlusion_view(2 * (i % 32), 64, 128),
                                           burnish_occlusion_view(2 * ((i + 1) % 32), 64, 128)};
        make_soup(&made, TRIANGLES, &state);
        drawer.max_overdraw = (1 << test_random32(&state) % 10) / 16.0;
        check_soup(&made, views, 2, &drawer, &state, "limit");
        draw_pairs(&made, &drawer, views, 2, BURNISH_ISA_SCALAR, 1, &run);
        refused += run.status == BURNISH_STATUS_LIMIT;
    }
    CHECK(refused > 20 && refused < 80, "%d of 100 were refused", refused);
    burnish_map_drawer_destroy(&drawer, NULL);
}

/* ---- Clusters of vertices against cells found in double precision ---- */

enum { VERTICES = 4000, CLUSTER_TRIANGLES = 6000, AXIS_CELLS = 64 };

typedef struct cluster_mesh {
    float positions[3 * VERTICES];
    uint32_t indices[3 * CLUSTER_TRIANGLES];
    uint16_t transparent[CLUSTER_TRIANGLES / 16 + 1];
} cluster_mesh;

/* The cell of a position. The middle of the mesh is the corner of a cell. */
static int cell_of(const float *position) {
    int cell = 0;
    for (int k = 0; k < 3; ++k) {
        cell = cell * AXIS_CELLS + (int)floor(position[k] * 16.0 + AXIS_CELLS / 2);
    }
    return cell;
}

/* Positions are multiples of 1/64, so a cell has 64 of them and no cell depends on rounding. */
static burnish_mesh_view make_cluster_mesh(cluster_mesh *made, uint64_t *state) {
    const float half = 0x1.279a74p-1f; /* sqrt(1 / 3): of a box with corners on the unit sphere */
    memset(made, 0, sizeof *made);
    for (int i = 0; i < 3 * VERTICES; ++i) {
        made->positions[i] = (float)(test_random32(state) % 32) / 64 - 0.25f + 1 / 256.0f;
    }
    for (int i = 0; i < 3 * CLUSTER_TRIANGLES; ++i) {
        made->indices[i] = test_random32(state) % VERTICES;
        if (i % 3 && test_random32(state) % 2) {
            made->indices[i] = (made->indices[i - 1] + 1) % VERTICES;
            memcpy(made->positions + 3 * made->indices[i],
                   made->positions + 3 * made->indices[i - 1], 3 * sizeof(float));
        }
        made->transparent[i / 48] |= (uint16_t)((test_random32(state) % 8 == 0) << i / 3 % 16);
    }
    return (burnish_mesh_view){.vertex_count = VERTICES,
                               .triangle_count = CLUSTER_TRIANGLES,
                               .positions = made->positions,
                               .indices = made->indices,
                               .bounds_min = {-half, -half, -half},
                               .bounds_max = {half, half, half}};
}

/* Exactly the triangles whose corners are in three cells are left, in their order. */
static void check_cluster_mesh(const cluster_mesh *made, const burnish_mesh_view *mesh,
                               const uint16_t *transparent, burnish_clusters *clusters) {
    burnish_error error;
    burnish_memory memory = burnish_memory_of(NULL, &error);
    burnish_mesh_view coarse;
    size_t left = 0;
    CHECK(burnish_clusters_make(clusters, mesh, 1 / 16.0, transparent, &memory, &coarse) ==
              BURNISH_STATUS_OK,
          "%s", error.text);
    for (size_t i = 0; i < CLUSTER_TRIANGLES; ++i) {
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

static void test_clusters(void) {
    static cluster_mesh made;
    burnish_clusters clusters = {0};
    uint64_t state = test_seed(76);
    for (int i = 0; i < 20; ++i) {
        const burnish_mesh_view mesh = make_cluster_mesh(&made, &state);
        check_cluster_mesh(&made, &mesh, i % 2 ? made.transparent : NULL, &clusters);
    }
    burnish_clusters_destroy(&clusters, NULL);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_soups());
    RUN(test_overdraw());
    RUN(test_clusters());
    return test_end("depth_maps");
}
