/* The fast renderer against the reference on thousands of random scenes, every instruction set and
 * number of samples: compare_scene.h. Large and thin triangles: test_large_triangles.c. */
#include "compare_scene.h"

enum { SCENES = 2000 };

/* Tiny triangles close together, as a fine mesh has them; each third is the one before it once
 * more, or from its other side. */
static void make_tiny_scene(random_scene *scene, uint64_t *state) {
    scene->vertex_count = scene->triangle_count = 0;
    const float size = test_uniform_float(state, 0.2f, 1.6f);
    const float x = test_uniform_float(state, -30, 30), y = test_uniform_float(state, -30, 30);
    while (scene->triangle_count < MOST_TRIANGLES - 1) {
        uint32_t *corners = scene->indices + 3 * scene->triangle_count;
        const uint32_t kind = scene->triangle_count > 0 ? test_random32(state) % 6 : 2;
        const float center[3] = {x + test_uniform_float(state, -9, 9),
                                 y + test_uniform_float(state, -9, 9),
                                 test_uniform_float(state, -1, 1)};
        for (uint32_t i = 0; i < 3; ++i) {
            float p[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = center[k] + test_uniform_float(state, -size, size);
            }
            corners[i] = kind < 2 ? corners[(kind ? 2 - (int)i : (int)i) - 3]
                                  : (uint32_t)scene->vertex_count;
            if (kind >= 2) {
                add_vertex(scene, p, state);
            }
        }
        scene->materials[scene->triangle_count++] = (uint16_t)(test_random32(state) % 3);
    }
}

/* Triangles around random places, from a fraction of a pixel to far larger than the picture; some
 * share vertices, some lie exactly on one another, seen from either side. */
static void make_scene(random_scene *scene, uint64_t *state) {
    static const float sizes[] = {0.3f, 1.5f, 4, 12, 40, 300, 4000, 60000};
    scene->vertex_count = scene->triangle_count = 0;
    const uint32_t most = test_random32(state) % 16 ? MOST_TRIANGLES - 1 : 1;
    const size_t count = 1 + test_random32(state) % most;
    float size = sizes[test_random32(state) % 8];
    while (scene->triangle_count < count) {
        uint32_t *corners = scene->indices + 3 * scene->triangle_count;
        uint32_t base = (uint32_t)scene->vertex_count;
        float center[3];
        if (test_random32(state) % 16 == 0) {
            size = sizes[test_random32(state) % 8];
        }
        for (int k = 0; k < 3; ++k) {
            center[k] = test_uniform_float(state, -90, 90);
        }
        for (uint32_t i = 0; i < 3; ++i) {
            float p[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = center[k] + test_uniform_float(state, -size, size);
                if (test_random32(state) % 4 == 0) { /* on the grid of samples */
                    p[k] = (float)(int)p[k] + 0.5f;
                }
            }
            corners[i] = base + i;
            add_vertex(scene, p, state);
        }
        if (scene->triangle_count > 0 && test_random32(state) % 3 == 0) { /* share an edge */
            const uint32_t *before = corners - 3;
            corners[0] = before[1];
            corners[1] = before[0];
            corners[2] = test_random32(state) % 4 ? corners[2] : before[2];
        }
        scene->materials[scene->triangle_count++] = (uint16_t)(test_random32(state) % 3);
    }
}

static void check_scene(const random_scene *scene, int number, uint64_t *state, int *points) {
    static const int counts[] = {1, 4, 1, 8, 1, 16};
    const int width = 65 + (int)(test_random32(state) % 90),
              height = 1 + (int)(test_random32(state) % 130), samples = counts[number % 6];
    burnish_raster_view view = parallel_view(width, height, samples);
    if (test_random32(state) % 2) {
        const float focal = test_uniform_float(state, 50, 400);
        view = perspective_view(width, height, samples, focal, test_uniform_float(state, -50, 200));
    }
    view.cull_back_faces = number % 5 == 4;
    compare_scene(scene, &view, number, NULL, state, points);
}

/* More triangles than a tile remembers, each nearer than the last: old ones must be forgotten. */
static void check_forgetting(void) {
    enum { SAMPLES = 4, LAYERS = 3 * BURNISH_TILE_PRIMITIVES * SAMPLES };
    static float positions[9 * LAYERS], normals[9 * LAYERS];
    static uint32_t indices[3 * LAYERS];
    for (uint32_t i = 0; i < LAYERS; ++i) {
        const float z = (float)i * (200.0f / LAYERS), x = (float)(i % 61) - 30;
        const float p[9] = {x - 3, -3, z, x + 3, -3, z, x, 3, z};
        memcpy(positions + 9 * i, p, sizeof p);
        for (uint32_t k = 0; k < 3; ++k) {
            indices[3 * i + k] = 3 * i + k;
        }
    }
    const burnish_raster_view view = parallel_view(BURNISH_TILE_SIZE, BURNISH_TILE_SIZE, SAMPLES);
    burnish_geometry geometry = {0};
    burnish_attributes attributes = {0};
    burnish_bins bins = {0};
    reference_tile tile;
    burnish_tile fast;
    const burnish_raster_ops *ops = burnish_raster_ops_for(BURNISH_ISA_SCALAR);
    const burnish_tile_options options = {.samples = SAMPLES, .planes = 3};
    const burnish_triangles triangles = {positions, 3 * (size_t)LAYERS, indices, LAYERS, NULL, 0};
    list_triangles(ops, &view, &triangles, &geometry, &bins);
    const burnish_mesh_view mesh = {.normals = normals, .indices = indices};
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    burnish_attributes_update(&attributes, &geometry, &mesh, 0, NULL, &memory);
    reference_tile_create(&tile, SAMPLES, NULL);
    burnish_tile_create(&fast, &options, NULL, NULL);
    fast.attributes[0] = attributes.normals;
    reference_draw_tile(&tile, &view, &geometry, &bins, 0, 0);
    burnish_tile_draw(&fast, ops, &view, &geometry, &bins, 0, 0);
    CHECK(geometry.triangle_count == LAYERS, "all may be seen: %zu", geometry.triangle_count);
    CHECK(fast.primitives.count < LAYERS, "forgot some: %zu", fast.primitives.count);
    CHECK(compare_owners(&tile, &fast, &geometry) == 0, "ids after forgetting");
    burnish_tile_destroy(&fast);
    reference_tile_destroy(&tile);
    burnish_attributes_destroy(&attributes, NULL);
    burnish_bins_destroy(&bins);
    burnish_geometry_destroy(&geometry);
}

static void check_scenes(int scenes) {
    static random_scene scene;
    uint64_t state = test_seed(1);
    int points = 0;
    for (int i = 0; i < scenes; ++i) {
        if (i / 6 % 4 == 3) { /* all numbers of samples */
            make_tiny_scene(&scene, &state);
        } else {
            make_scene(&scene, &state);
        }
        check_scene(&scene, i, &state, &points);
    }
    printf("%d scenes, %d points\n", scenes, points);
    CHECK(points > 2500 * scenes && scenes > 0, "the scenes show something: %d points", points);
}

/* --scenes N: fewer for slow machines. */
int main(int count, char **arguments) {
    test_begin(count, arguments, "--scenes");
    const int scenes = test_option() ? atoi(test_option()) : SCENES;
    RUN(check_scenes(scenes));
    RUN(check_forgetting());
    return test_end("visibility");
}
