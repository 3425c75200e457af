/* Coverage is exact: samples on shared edges belong to one triangle, clipped or not. Tile lists are
 * those of compare_scene.h, of any number of threads and budget of memory. */
#include <math.h>
#include <stdint.h>

#include "raster/geometry.h"
#include "reference_tile.h"
#include "support.h"

enum { GRID = 12, SIZE = BURNISH_TILE_SIZE, MAX_TRIANGLES = 4096 };

typedef struct test_mesh {
    float positions[3 * 2048];
    uint32_t indices[3 * MAX_TRIANGLES];
    size_t vertex_count, triangle_count;
} test_mesh;

static void add_triangle(test_mesh *mesh, size_t a, size_t b, size_t c) {
    uint32_t *index = mesh->indices + 3 * mesh->triangle_count++;
    index[0] = (uint32_t)a;
    index[1] = (uint32_t)b;
    index[2] = (uint32_t)c;
}

/* A plane of GRID x GRID jittered cells reaching beyond the image on all sides; with snap the
 * vertices are on pixel centres and corners, where the top-left rule decides. */
static void make_plane(test_mesh *mesh, int snap, uint64_t state) {
    double cell = SIZE * 1.3 / GRID;
    mesh->vertex_count = mesh->triangle_count = 0;
    for (int y = 0; y <= GRID; ++y) {
        for (int x = 0; x <= GRID; ++x) {
            float *p = mesh->positions + 3 * mesh->vertex_count++;
            double jitter_x = (test_uniform(&state, 0, 1) - 0.5) * 0.3;
            double jitter_y = (test_uniform(&state, 0, 1) - 0.5) * 0.3;
            p[0] = (float)((x - GRID / 2 + jitter_x) * cell);
            p[1] = (float)((y - GRID / 2 + jitter_y) * cell);
            p[2] = 0;
            if (snap) {
                p[0] = (float)(floor(p[0] * 2.0) / 2);
                p[1] = (float)(floor(p[1] * 2.0) / 2);
            }
        }
    }
    for (size_t y = 0; y < GRID; ++y) {
        for (size_t x = 0; x < GRID; ++x) {
            size_t a = y * (GRID + 1) + x, b = a + 1, c = a + GRID + 1, d = c + 1;
            if (test_random32(&state) & 1) {
                add_triangle(mesh, a, b, d);
                add_triangle(mesh, a, d, c);
            } else {
                add_triangle(mesh, a, b, c);
                add_triangle(mesh, c, b, d);
            }
        }
    }
}

static burnish_triangles triangles_of(const test_mesh *mesh) {
    return (burnish_triangles){
        mesh->positions, mesh->vertex_count, mesh->indices, mesh->triangle_count, NULL, 0};
}

/* How many triangles cover each sample of a one-tile image: drawn one at a time. */
static void count_coverage(const burnish_raster_view *view, const burnish_geometry *geometry,
                           int *coverage) {
    reference_tile tile;
    uint32_t entry;
    CHECK(reference_tile_create(&tile, view->samples, NULL) == BURNISH_STATUS_OK, "tile");
    for (entry = 0; entry < reference_primitive_count(geometry); ++entry) {
        if (reference_side(geometry, entry) < 0) {
            continue;
        }
        reference_draw_indices(&tile, view, geometry, 0, 0, &entry, 1);
        for (int i = 0; i < BURNISH_TILE_PIXELS * view->samples; ++i) {
            coverage[i] += tile.triangles[i] == entry;
        }
    }
    reference_tile_destroy(&tile);
}

/* Every sample of the SIZE x SIZE image is covered by exactly one triangle of the mesh. */
static void check_each_sample_once(const char *name, const burnish_raster_view *view,
                                   const test_mesh *mesh) {
    static int coverage[BURNISH_TILE_PIXELS * BURNISH_MAX_SAMPLES];
    burnish_geometry geometry = {0};
    memset(coverage, 0, sizeof coverage);
    const burnish_triangles triangles = triangles_of(mesh);
    CHECK1(burnish_geometry_update(&geometry, burnish_raster_ops_for(BURNISH_ISA_SCALAR), view,
                                   &triangles, NULL, NULL) == BURNISH_STATUS_OK);
    count_coverage(view, &geometry, coverage);
    int holes = 0, twice = 0;
    for (int i = 0; i < BURNISH_TILE_PIXELS * view->samples; ++i) {
        holes += coverage[i] == 0;
        twice += coverage[i] > 1;
    }
    CHECK(holes == 0 && twice == 0, "%s, %d samples: %d holes, %d drawn twice", name, view->samples,
          holes, twice);
    burnish_geometry_destroy(&geometry);
}

static void check_plane(void) {
    static const int SAMPLES[] = {1, 4, 8, 16};
    static test_mesh mesh;
    for (int i = 0; i < 4; ++i) {
        burnish_raster_view view = parallel_view(SIZE, SIZE, SAMPLES[i]);
        for (uint32_t seed = 1; seed <= 8; ++seed) {
            make_plane(&mesh, 0, test_seed(seed));
            check_each_sample_once("jittered plane", &view, &mesh);
            make_plane(&mesh, 1, test_seed(seed));
            check_each_sample_once("snapped plane", &view, &mesh);
        }
    }
}

/* The inside of a box, seen from within at a wide angle: every ray meets it once, and its triangles
 * need the near plane and the guard band. */
static void check_box_from_inside(void) {
    static test_mesh mesh;
    static const uint8_t FACES[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                        {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        uint64_t state = test_seed(seed);
        mesh.vertex_count = mesh.triangle_count = 0;
        for (int i = 0; i < 8; ++i) {
            float *p = mesh.positions + 3 * mesh.vertex_count++;
            p[0] = i & 1 ? 1.0f : -1.0f;
            p[1] = i & 2 ? 1.0f : -1.0f;
            p[2] = i & 4 ? 1.0f : -1.0f;
        }
        for (int f = 0; f < 6; ++f) {
            add_triangle(&mesh, FACES[f][0], FACES[f][1], FACES[f][2]);
            add_triangle(&mesh, FACES[f][0], FACES[f][2], FACES[f][3]);
        }
        double eye[3], turn = test_uniform(&state, 0, 1) * 6.28,
                       tilt = test_uniform(&state, 0, 1) - 0.5;
        for (int i = 0; i < 3; ++i) {
            eye[i] = (test_uniform(&state, 0, 1) - 0.5) * 1.99;
        }
        double forward[3] = {sin(turn) * cos(tilt), sin(tilt), -cos(turn) * cos(tilt)};
        double right[3] = {cos(turn), 0, sin(turn)};
        double up[3] = {-sin(turn) * sin(tilt), cos(tilt), cos(turn) * sin(tilt)};
        burnish_raster_view view = {.width = SIZE, .height = SIZE, .samples = seed % 2 ? 1 : 4};
        for (int i = 0; i < 3; ++i) {
            view.rows[0][i] = (float)(right[i] * 8); /* 8 pixels at distance 1: 152 degrees */
            view.rows[1][i] = (float)(up[i] * 8);
            view.rows[3][i] = (float)forward[i];
            view.rows[0][3] -= (float)(right[i] * eye[i] * 8);
            view.rows[1][3] -= (float)(up[i] * eye[i] * 8);
            view.rows[3][3] -= (float)(forward[i] * eye[i]);
        }
        view.rows[2][3] = 0x1p-14f;
        check_each_sample_once("box from inside", &view, &mesh);
    }
}

static void check_rounding(void) {
    CHECK(burnish_to_fixed(0.001953125f) == 0, "half a step goes to even: 0");
    CHECK(burnish_to_fixed(0.005859375f) == 2, "one and a half steps go to 2");
    for (int i = -4000; i <= 4000; ++i) {
        float pixels = (float)i * 4.0931f;
        int32_t fixed = burnish_to_fixed(pixels);
        CHECK(fixed == -burnish_to_fixed(-pixels), "rounding is symmetric at %g", (double)pixels);
        CHECK(fabs((double)pixels * 256 - fixed) <= 0.5, "rounding to nearest at %g",
              (double)pixels);
    }
}

/* A tile of a mesh in parallel view, drawn by the fast renderer; marks its triangles. */
static void draw_first_tile(burnish_tile *tile, const burnish_raster_view *view,
                            const test_mesh *mesh, int column, uint8_t *drawn) {
    static burnish_float4 attributes[2048];
    const burnish_raster_ops *ops =
        burnish_raster_ops_for(burnish_isa_best(burnish_isa_available()));
    burnish_geometry geometry = {0};
    burnish_bins bins = {0};
    const burnish_triangles triangles = triangles_of(mesh);
    list_triangles(ops, view, &triangles, &geometry, &bins);
    tile->attributes[0] = attributes;
    CHECK(burnish_tile_draw(tile, ops, view, &geometry, &bins, column, 0), "a triangle is there");
    ops->mark_drawn(tile, drawn);
    burnish_bins_destroy(&bins);
    burnish_geometry_destroy(&geometry);
}

/* A triangle that covers one pixel, then its right neighbour: what an earlier frame has left in the
 * tile must not hide it. */
static void check_marks(void) {
    static test_mesh mesh;
    const burnish_tile_options options = {.samples = 1, .planes = 3, .keep_ids = 1};
    burnish_tile tile;
    burnish_tile_create(&tile, &options, NULL, NULL);
    for (int x = 0; x < 8; ++x) {
        const float left = (float)(x - SIZE / 2);
        const float top = SIZE / 2;
        const float p[9] = {left, top + 0.2f, 0, left, top - 1, 0, left + 1.2f, top - 1, 0};
        uint8_t drawn[1] = {0};
        memcpy(mesh.positions, p, sizeof p);
        mesh.vertex_count = 3;
        mesh.triangle_count = 0;
        add_triangle(&mesh, 0, 1, 2);
        burnish_raster_view view = parallel_view(SIZE, SIZE, 1);
        draw_first_tile(&tile, &view, &mesh, 0, drawn);
        CHECK(tile.buffer.depths[burnish_pixel_index(x, 0)] > 0, "pixel %d shows it", x);
        CHECK(drawn[0] == 1, "the triangle that pixel %d shows is counted", x);
    }
    burnish_tile_destroy(&tile);
}

/* A wall hides back-facing triangles in a tile that extends beyond the image: HiZ culls them there
 * too. */
static void check_hiz_at_the_edge(void) {
    enum { HIDDEN = 600, WIDTH = SIZE + 4 };
    static test_mesh mesh;
    const burnish_tile_options options = {.samples = 4, .planes = 3};
    const burnish_raster_view view = parallel_view(WIDTH, 20, 4);
    static uint8_t drawn[HIDDEN + 2];
    burnish_tile tile;
    mesh.vertex_count = mesh.triangle_count = 0;
    for (int i = 0; i < HIDDEN + 2; ++i) {
        const float size = i < 2 ? 400 : 4, z = i < 2 ? 100 : -100;
        const float x = i < 2 ? 0 : WIDTH / 2 - 4, y = i < 2 ? 0 : -2;
        const float corners[4][2] = {
            {x - size, y - size}, {x + size, y - size}, {x + size, y + size}, {x - size, y + size}};
        for (int k = 0; k < 3; ++k) {
            const float *at = corners[i % 2 ? (k + 2) % 4 : k];
            float *p = mesh.positions + 3 * (mesh.vertex_count + (size_t)k);
            p[0] = at[0];
            p[1] = at[1];
            p[2] = z;
        }
        const size_t a = mesh.vertex_count, back = i >= 2;
        add_triangle(&mesh, a, a + 1 + back, a + 2 - back);
        mesh.vertex_count += 3;
    }
    burnish_tile_create(&tile, &options, NULL, NULL);
    draw_first_tile(&tile, &view, &mesh, 1, drawn);
    CHECK(tile.primitives.count < 64, "%zu primitives were set up", tile.primitives.count);
    burnish_tile_destroy(&tile);
}

/* Polygons that only rounding can make of a triangle: their corners alternate between both sides of
 * the near plane, so each edge is cut. Memory after the array must not change. */
static void check_clip_bound(void) {
    burnish_clip_corner corners[2 * BURNISH_CLIP_MAX];
    memset(corners, 0xa5, sizeof corners);
    for (int i = 0; i < BURNISH_CLIP_MAX; ++i) {
        corners[i] = (burnish_clip_corner){.position = {0, 0, i % 2 ? 2.0f : 0.5f, 1.0f}};
    }
    const int count = burnish_clip_polygon(corners, BURNISH_CLIP_MAX);
    int damaged = 0;
    for (size_t i = sizeof corners / 2; i < sizeof corners; ++i) {
        damaged += ((const uint8_t *)corners)[i] != 0xa5;
    }
    CHECK(count <= BURNISH_CLIP_MAX, "%d corners", count);
    CHECK(damaged == 0, "%d bytes written behind the corners", damaged);
}

/* The largest image and many threads: the lists of all slices stay within their bound. */
static void check_list_memory(void) {
    enum { BATCHES = 4096, THREADS = 64 };
    static burnish_triangle_batch batches[BATCHES];
    static burnish_batch_header headers[BATCHES]; /* no triangle is visible */
    const burnish_geometry geometry = {
        .batches = batches, .headers = headers, .batch_count = BATCHES, .mesh_batches = BATCHES};
    const burnish_raster_view view = parallel_view(16384, 16384, 1);
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, THREADS);
    burnish_bins bins = {0};
    size_t lists = 0;
    burnish_bins_begin(&bins, NULL);
    CHECK(burnish_bin_tiles(&bins, burnish_raster_ops_for(BURNISH_ISA_SCALAR), &geometry, &view,
                            &tasks, NULL) == BURNISH_STATUS_OK,
          "bins");
    for (size_t i = 0; i < bins.slice_count; ++i) {
        lists += bins.slices[i].list_capacity;
    }
    CHECK(bins.slice_count > 1, "several slices: %zu", bins.slice_count);
    CHECK(lists <= BURNISH_LISTS_MAX, "%zu lists of %zu slices", lists, bins.slice_count);
    burnish_bins_destroy(&bins);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_rounding());
    RUN(check_plane());
    RUN(check_box_from_inside());
    RUN(check_marks());
    RUN(check_hiz_at_the_edge());
    RUN(check_clip_bound());
    RUN(check_list_memory());
    return test_end("raster");
}
