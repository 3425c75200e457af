/* The fast renderer against the reference: thousands of random scenes, every tier and number of
 * samples; the same owner of every sample, the same visible points, the same colours, bit for bit.
 */
#include <stdint.h>

#include "harness.h"
#include "raster/visibility.h"
#include "reference_tile.h"
#include "shade/row.h"

enum { MOST_VERTICES = 1200, MOST_TRIANGLES = 400, SCENES = 2000 };

typedef struct random_scene {
    float positions[3 * MOST_VERTICES], normals[3 * MOST_VERTICES];
    uint8_t colors[4 * MOST_VERTICES];
    uint32_t indices[3 * MOST_TRIANGLES];
    uint16_t materials[MOST_TRIANGLES];
    size_t vertex_count, triangle_count;
} random_scene;

static uint32_t next_random(uint32_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static float uniform(uint32_t *state, float low, float high) {
    return low + (high - low) * (float)(next_random(state) >> 8) * 0x1p-24f;
}

static void add_vertex(random_scene *scene, const float p[3], uint32_t *state) {
    size_t i = scene->vertex_count++;
    for (int k = 0; k < 3; ++k) {
        scene->positions[3 * i + (size_t)k] = p[k];
        scene->normals[3 * i + (size_t)k] = uniform(state, -1, 1);
    }
    for (int k = 0; k < 4; ++k) {
        scene->colors[4 * i + (size_t)k] = (uint8_t)next_random(state);
    }
}

/* Triangles around random places, from a fraction of a pixel to far larger than the picture; some
 * share vertices, some lie exactly on one another, seen from either side. */
static void make_scene(random_scene *scene, uint32_t *state) {
    static const float sizes[] = {0.3f, 1.5f, 4, 12, 40, 300, 4000, 60000};
    scene->vertex_count = scene->triangle_count = 0;
    size_t count = 1 + next_random(state) % (MOST_TRIANGLES - 1);
    float size = sizes[next_random(state) % 8];
    while (scene->triangle_count < count) {
        uint32_t *corners = scene->indices + 3 * scene->triangle_count;
        uint32_t base = (uint32_t)scene->vertex_count;
        float center[3];
        if (next_random(state) % 16 == 0) {
            size = sizes[next_random(state) % 8];
        }
        for (int k = 0; k < 3; ++k) {
            center[k] = uniform(state, -90, 90);
        }
        for (uint32_t i = 0; i < 3; ++i) {
            float p[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = center[k] + uniform(state, -size, size);
                if (next_random(state) % 4 == 0) { /* on the grid of samples */
                    p[k] = (float)(int)p[k] + 0.5f;
                }
            }
            corners[i] = base + i;
            add_vertex(scene, p, state);
        }
        if (scene->triangle_count > 0 && next_random(state) % 3 == 0) { /* share an edge */
            const uint32_t *before = corners - 3;
            corners[0] = before[1];
            corners[1] = before[0];
            corners[2] = next_random(state) % 4 ? corners[2] : before[2];
        }
        scene->materials[scene->triangle_count++] = (uint16_t)(next_random(state) % 3);
    }
}

/* A pixel a unit, or in perspective with the eye in the midst of the scene. */
static burnish_raster_view make_view(int width, int height, int samples, uint32_t *state) {
    burnish_raster_view view;
    memset(&view, 0, sizeof view);
    view.width = width;
    view.height = height;
    view.samples = samples;
    view.rows[0][0] = view.rows[1][1] = 1;
    if (next_random(state) % 2) {
        view.rows[0][0] = view.rows[1][1] = uniform(state, 50, 400);
        view.rows[2][3] = 0x1p-14f;
        view.rows[3][2] = -1;
        view.rows[3][3] = uniform(state, -50, 200);
    } else {
        view.rows[2][2] = 0.002f;
        view.rows[2][3] = 0.5f;
        view.rows[3][3] = 1;
    }
    return view;
}

static burnish_visibility_function *const TIERS[] = {
    burnish_visibility_scalar,
#if defined(__SSE2__)
    burnish_visibility_sse2,   burnish_visibility_avx2, burnish_visibility_avx512,
#endif
#if defined(__aarch64__)
    burnish_visibility_neon,
#endif
};

static burnish_visibility_function *pick_tier(uint32_t *state) {
    static const burnish_isa isas[] = {
        BURNISH_ISA_SCALAR,
#if defined(__SSE2__)
        BURNISH_ISA_SSE2,
        BURNISH_ISA_AVX2,
        BURNISH_ISA_AVX512
#elif defined(__aarch64__)
        BURNISH_ISA_NEON
#endif
    };
    uint32_t available = burnish_isa_available(), i;
    do {
        i = next_random(state) % (sizeof isas / sizeof isas[0]);
    } while (!(available >> isas[i] & 1));
    return TIERS[i];
}

static int same_corners(const burnish_corners *a, const burnish_setup_triangle *b) {
    return memcmp(a->vertices, b->vertices, sizeof a->vertices) == 0 && a->source == b->source;
}

/* Samples of the tile whose owners differ. */
static int compare_owners(const reference_tile *tile, const burnish_visibility *fast,
                          const burnish_geometry *geometry) {
    int wrong = 0;
    for (int y = 0; y < tile->height; ++y) {
        for (int x = 0; x < tile->width; ++x) {
            int pixel = y * BURNISH_TILE_SIZE + x;
            for (int s = 0; s < tile->samples; ++s) {
                uint32_t triangle = tile->triangles[pixel * tile->samples + s];
                int32_t owner = fast->owners[s * BURNISH_TILE_PIXELS + pixel];
                if (triangle == BURNISH_NO_TRIANGLE || owner < 0) {
                    wrong += triangle != BURNISH_NO_TRIANGLE || owner >= 0;
                } else {
                    wrong += !same_corners(&fast->triangles[owner].corners,
                                           &geometry->triangles[triangle]);
                }
            }
        }
    }
    return wrong;
}

/* A visible point by the reference, with its colour. */
typedef struct point {
    int pixel, weight;
    burnish_corners corners;
    float x, y, depth, weights[2], color[3];
} point;

static point take_point(const burnish_fragments *fragments, const burnish_shaded *shaded, int i) {
    point made;
    memset(&made, 0, sizeof made);
    made.pixel = fragments->pixel[i];
    made.weight = fragments->weight[i];
    made.corners = fragments->corners[i];
    made.x = fragments->x[i];
    made.y = fragments->y[i];
    made.depth = fragments->depth[i];
    made.weights[0] = fragments->weight1[i];
    made.weights[1] = fragments->weight2[i];
    for (int k = 0; k < 3; ++k) {
        made.color[k] = shaded->channel[k][i];
    }
    return made;
}

/* What the fast renderer makes of a pixel that is one triangle's alone. */
static int same_whole(const burnish_visibility *fast, const burnish_whole_row *whole,
                      const burnish_row *row, const point *expected) {
    const int x = expected->pixel % BURNISH_TILE_SIZE;
    if (whole->owners[x] < 0) {
        return 0;
    }
    const float got[6] = {whole->weights[0][x], whole->weights[1][x], whole->depths[x],
                          row->rgb[0][x],       row->rgb[1][x],       row->rgb[2][x]};
    const float want[6] = {expected->weights[0], expected->weights[1], expected->depth,
                           expected->color[0],   expected->color[1],   expected->color[2]};
    return memcmp(got, want, sizeof got) == 0 &&
           memcmp(&fast->triangles[whole->owners[x]].corners, &expected->corners,
                  sizeof expected->corners) == 0;
}

/* All points of a tile by both paths; *points counts them. */
static int compare_points(reference_tile *tile, burnish_visibility *fast,
                          const burnish_raster_view *view, const burnish_geometry *geometry,
                          const burnish_shader *shader, burnish_shade_cache *cache, int *points) {
    static point expected[BURNISH_TILE_PIXELS * BURNISH_MAX_SAMPLES];
    static burnish_fragments fragments;
    static burnish_shaded shaded;
    static burnish_whole_row whole;
    static burnish_row row;
    int count = 0, wrong = 0, at = 0, known = -1;
    while (reference_next_fragments(tile, view, geometry, &fragments)) {
        burnish_shade(shader, cache, &fragments, &shaded);
        for (int i = 0; i < fragments.count; ++i) {
            expected[count++] = take_point(&fragments, &shaded, i);
        }
    }
    *points += count;
    for (int i = 0; i < count; ++i) { /* whole pixels, a row after another */
        const int y = expected[i].pixel / BURNISH_TILE_SIZE;
        if (y != known) {
            burnish_visibility_row(fast, y, &whole);
            burnish_shade_row(shader, cache, fast, &whole, view, y, &row);
            known = y;
        }
        wrong +=
            expected[i].weight == tile->samples && !same_whole(fast, &whole, &row, &expected[i]);
    }
    while (burnish_visibility_next(fast, view, &fragments)) {
        burnish_shade(shader, cache, &fragments, &shaded);
        for (int i = 0; i < fragments.count; ++i, ++at) {
            while (at < count && expected[at].weight == tile->samples) {
                ++at;
            }
            point got = take_point(&fragments, &shaded, i);
            wrong += at >= count || memcmp(&got, &expected[at], sizeof got) != 0;
        }
    }
    while (at < count && expected[at].weight == tile->samples) {
        ++at;
    }
    return wrong + (at != count);
}

static void make_shader(burnish_shader *shader, burnish_shade_material materials[3],
                        const random_scene *scene, const burnish_geometry *geometry,
                        uint32_t *state) {
    memset(shader, 0, sizeof *shader);
    shader->batch = burnish_batch_best();
    shader->lighting = burnish_batch_lighting_default();
    shader->lighting.near_viewer = (int)(next_random(state) & 1);
    shader->lighting.viewer[2] = shader->lighting.near_viewer ? 0 : 1;
    shader->lighting.lyon = next_random(state) % 4 == 0;
    shader->needs_place = 1; /* the reference always gives places */
    shader->view.q_per_depth = 0x1p14f;
    shader->view.ray[2] = -1;
    shader->view.ray_x[0] = shader->view.ray_y[1] = 0.01f;
    for (int i = 0; i < 3; ++i) {
        memset(&materials[i], 0, sizeof materials[i]);
        materials[i].lobe = shader->lighting.lobe;
        materials[i].diffuse[i] = 0.75f;
        materials[i].specular[2 - i] = 0.5f;
    }
    shader->materials = materials;
    shader->triangle_materials = next_random(state) & 1 ? scene->materials : NULL;
    burnish_attributes_create(&shader->attributes, geometry, scene->normals,
                              next_random(state) & 1 ? scene->colors : NULL, scene->indices, 1,
                              NULL);
}

static void check_scene(const random_scene *scene, int number, uint32_t *state, int *points) {
    static const int counts[] = {1, 4, 1, 8, 1, 16};
    const int samples = counts[number % 6];
    burnish_raster_view view = make_view(65 + (int)(next_random(state) % 90),
                                         1 + (int)(next_random(state) % 130), samples, state);
    burnish_geometry geometry;
    burnish_bins bins;
    reference_tile tile;
    burnish_visibility fast;
    burnish_shader shader;
    burnish_shade_material materials[3];
    burnish_shade_cache cache = {.material = -1};
    burnish_visibility_function *draw = pick_tier(state);
    burnish_geometry_create(&geometry, &view, scene->positions, scene->vertex_count, scene->indices,
                            scene->triangle_count, 1, NULL);
    make_shader(&shader, materials, scene, &geometry, state);
    reference_tile_create(&tile, samples, NULL);
    burnish_visibility_create(&fast, samples, NULL);
    fast.needs_place = 1;
    if (next_random(state) % 4 == 0) { /* forget triangles often; samples own at most half */
        size_t least = 2 * (size_t)BURNISH_TILE_PIXELS * (size_t)samples;
        fast.triangle_capacity = least < fast.triangle_capacity ? least : fast.triangle_capacity;
    }
    burnish_bins_begin(&bins);
    do {
        burnish_bin_tiles(&bins, &geometry, &view, 1, NULL);
        for (int row = bins.first_row; row < bins.end_row; ++row) {
            for (int column = 0; column < bins.columns; ++column) {
                int drawn = reference_draw_tile(&tile, &view, &geometry, &bins, column, row);
                int wrong = burnish_visibility_draw(&fast, draw, &view, &geometry, &bins, column,
                                                    row) != drawn;
                if (drawn && !wrong) {
                    wrong = compare_owners(&tile, &fast, &geometry);
                    CHECK(wrong == 0, "scene %d, %d samples, tile %d,%d: %d owners differ", number,
                          samples, column, row, wrong);
                    wrong = compare_points(&tile, &fast, &view, &geometry, &shader, &cache, points);
                }
                CHECK(wrong == 0, "scene %d, %d samples, tile %d,%d: points or colours differ",
                      number, samples, column, row);
            }
        }
    } while (bins.end_row < bins.rows);
    burnish_bins_destroy(&bins);
    burnish_visibility_destroy(&fast);
    reference_tile_destroy(&tile);
    burnish_attributes_destroy(&shader.attributes);
    burnish_geometry_destroy(&geometry);
}

/* More triangles than a tile remembers, each nearer than the last: old ones must be forgotten. */
static void check_forgetting(void) {
    enum { LAYERS = 3 * BURNISH_TILE_TRIANGLES };
    static float positions[9 * LAYERS];
    static uint32_t indices[3 * LAYERS];
    for (uint32_t i = 0; i < LAYERS; ++i) {
        const float z = (float)i * (200.0f / LAYERS), x = (float)(i % 61) - 30;
        const float p[9] = {x - 3, -3, z, x + 3, -3, z, x, 3, z};
        memcpy(positions + 9 * i, p, sizeof p);
        for (uint32_t k = 0; k < 3; ++k) {
            indices[3 * i + k] = 3 * i + k;
        }
    }
    burnish_raster_view view;
    memset(&view, 0, sizeof view);
    view.width = view.height = BURNISH_TILE_SIZE;
    view.samples = 1;
    view.rows[0][0] = view.rows[1][1] = view.rows[3][3] = 1;
    view.rows[2][2] = 0.004f;
    burnish_geometry geometry;
    burnish_bins bins;
    reference_tile tile;
    burnish_visibility fast;
    burnish_geometry_create(&geometry, &view, positions, 3 * (size_t)LAYERS, indices, LAYERS, 1,
                            NULL);
    burnish_bins_begin(&bins);
    burnish_bin_tiles(&bins, &geometry, &view, 1, NULL);
    reference_tile_create(&tile, 1, NULL);
    burnish_visibility_create(&fast, 1, NULL);
    reference_draw_tile(&tile, &view, &geometry, &bins, 0, 0);
    burnish_visibility_draw(&fast, burnish_visibility_scalar, &view, &geometry, &bins, 0, 0);
    CHECK(geometry.triangle_count == LAYERS, "all may be seen: %zu", geometry.triangle_count);
    CHECK(fast.triangle_count < LAYERS, "forgot some: %zu", fast.triangle_count);
    CHECK(compare_owners(&tile, &fast, &geometry) == 0, "owners after forgetting");
    burnish_visibility_destroy(&fast);
    reference_tile_destroy(&tile);
    burnish_bins_destroy(&bins);
    burnish_geometry_destroy(&geometry);
}

/* An argument: how many scenes, for slow machines. */
int main(int count, char **arguments) {
    static random_scene scene;
    const int scenes = count > 1 ? atoi(arguments[1]) : SCENES;
    uint32_t state = 0x9e3779b9;
    int points = 0;
    for (int i = 0; i < scenes; ++i) {
        make_scene(&scene, &state);
        check_scene(&scene, i, &state, &points);
    }
    printf("%d scenes, %d points\n", scenes, points);
    CHECK(points > 2500 * scenes && scenes > 0, "the scenes show something: %d points", points);
    check_forgetting();
    return test_end("visibility");
}
