/* Transparency: overlapping squares against the closed form of compositing, layers of random scenes
 * against triangles drawn one by one, planes and counts against those of an opaque mesh. */
#include <math.h>

#include "compare_scene.h"
#include "pictures.h"
#include "raster/layers.h"

/* ---- Closed form ---- */

enum { SQUARES = 260, SIZE = 24 };

typedef struct stack {
    int count;
    float heights[SQUARES], transparency[SQUARES], color[SQUARES][3]; /* colours linear */
} stack;

static stack make_stack(int count, float least, uint64_t *state) {
    stack s = {.count = count};
    for (int i = 0; i < count; ++i) {
        s.heights[i] = (float)i * 0.0625f; /* the first one is the farthest */
        s.transparency[i] = test_uniform_float(state, least, least < 0.9f ? 0.95f : 0.999f);
        for (int k = 0; k < 3; ++k) {
            s.color[i][k] = test_uniform_float(state, 0, 1);
        }
    }
    return s;
}

/* Squares of 2 x 2, a material each, in any order and wound either way. */
static burnish_mesh *make_squares(const stack *s, uint64_t *state) {
    static float positions[12 * SQUARES];
    static uint16_t triangle_materials[2 * SQUARES];
    burnish_material materials[SQUARES];
    int order[SQUARES];
    for (int i = 0; i < s->count; ++i) {
        const int other = (int)(test_random32(state) % (uint32_t)(i + 1));
        order[i] = order[other];
        order[other] = i;
    }
    for (int i = 0; i < s->count; ++i) {
        const int at = order[i];
        const float z = s->heights[at];
        const float corners[12] = {-1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z};
        memcpy(positions + 12 * i, corners, sizeof corners);
        if (test_random32(state) % 2) {
            memcpy(positions + 12 * i + 3, corners + 9, 3 * sizeof *corners);
            memcpy(positions + 12 * i + 9, corners + 3, 3 * sizeof *corners);
        }
        triangle_materials[2 * i] = triangle_materials[2 * i + 1] = (uint16_t)i;
        materials[i] = (burnish_material){.exponent = 1, .transparency = s->transparency[at]};
        memcpy(materials[i].ambient, s->color[at], sizeof materials[i].ambient);
    }
    burnish_mesh_description arrays = describe_quads(positions, NULL, (size_t)s->count);
    arrays.triangle_materials = (burnish_array){triangle_materials, 2 * (size_t)s->count, 0};
    give_materials(&arrays, materials, (size_t)s->count);
    return create_mesh(&arrays, NULL);
}

/* Ambient light of 1 and nothing else: every surface has its material's colour. Half of the picture
 * shows squares, whose edges are on the edges of pixels or in their middle. */
static burnish_render_options square_options(int samples, int is_odd) {
    burnish_render_options options =
        front_options(SIZE + is_odd, SIZE + is_odd, 4.0 * (SIZE + is_odd) / SIZE);
    options.max_overdraw = 1e9; /* small pictures with many layers */
    options.samples = samples;
    options.camera.position[2] = 30;
    light_evenly(&options);
    for (int k = 0; k < 3; ++k) {
        options.background[k] = (uint8_t)(60 * k + 100);
    }
    return options;
}

/* Front to back, in double precision: (r, g, b, alpha), premultiplied. */
static void composite(const stack *s, double sum[4]) {
    double through = 1;
    memset(sum, 0, 4 * sizeof *sum);
    for (int i = s->count - 1; i >= 0; --i) {
        const double opacity = 1 - (double)s->transparency[i];
        for (int k = 0; k < 3; ++k) {
            sum[k] += through * opacity * (double)s->color[i][k];
        }
        through *= 1 - opacity;
    }
    sum[3] = 1 - through;
}

static void check_squares(int count, float least, int samples, int transparent, int is_odd,
                          uint64_t *state) {
    static float pixels[(SIZE + 1) * (SIZE + 1)][4];
    const stack s = make_stack(count, least, state);
    burnish_mesh *mesh = make_squares(&s, state);
    burnish_render_options options = square_options(samples, is_odd);
    burnish_render_report report;
    double sum[4];
    options.transparent = transparent;
    draw_floats(mesh, &options, pixels[0], &report);
    composite(&s, sum);
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const double u = fabs(x + 0.5 - options.width / 2.0);
            const double v = fabs(y + 0.5 - options.height / 2.0), half = SIZE / 4.0;
            const double inside = half - (u > v ? u : v); /* pixels from the edge */
            const float *pixel = pixels[y * options.width + x];
            if (fabs(inside) < 0.6 && (samples > 1 || is_odd)) {
                continue; /* in part, or on an edge */
            }
            double expected[4] = {0, 0, 0, transparent ? 0 : 1};
            for (int k = 0; k < 3; ++k) {
                const double light =
                    (double)burnish_srgb_decode((float)options.background[k] / 255);
                expected[k] = inside > 0 ? sum[k] : 0;
                expected[k] = transparent ? (inside > 0 ? sum[k] / sum[3] : 0)
                                          : expected[k] + (inside > 0 ? 1 - sum[3] : 1) * light;
            }
            expected[3] = transparent && inside > 0 ? sum[3] : expected[3];
            for (int k = 0; k < 4; ++k) {
                CHECK(fabs((double)pixel[k] - expected[k]) < 2e-6,
                      "%d squares, %d samples, transparent %d, pixel %d,%d[%d]: %.8f, not %.8f",
                      count, samples, transparent, x, y, k, (double)pixel[k], expected[k]);
            }
        }
    }
    CHECK(report.triangles_drawn == 2 * (size_t)count && report.layers_dropped == 0,
          "%zu triangles, %zu dropped", report.triangles_drawn, report.layers_dropped);
    CHECK(is_odd || report.covered_pixels == SIZE * SIZE / 4, "%zu pixels", report.covered_pixels);
    burnish_mesh_destroy(mesh);
}

static void test_squares(void) {
    uint64_t state = test_seed(1);
    for (int round = 0; round < 24; ++round) {
        static const int counts[] = {1, 4, 8, 16};
        check_squares(1 + round % 12 * 2, 0.05f, counts[round % 4], round / 4 % 2, round / 8 % 2,
                      &state);
    }
    check_squares(BURNISH_LAYERS_MAX, 0.05f, 4, 1, 0, &state);
    check_squares(BURNISH_LAYERS_MAX + 1, 0.97f, 4, 0, 0, &state);
    check_squares(BURNISH_LAYERS_MAX * 5 / 2, 0.97f, 1, 1, 0, &state);
    check_squares(BURNISH_TRANSPARENT_LAYERS_MAX, 0.98f, 4, 1, 0, &state);
}

/* Of more layers than are kept the nearest stay, and the others are counted. */
static void check_limit(int limit, double max_overdraw) {
    static float more[SIZE * SIZE][4], kept[SIZE * SIZE][4];
    uint64_t state = test_seed(2);
    const int extra = SQUARES - limit;
    stack s = make_stack(SQUARES, 0.98f, &state);
    stack nearest = {.count = limit};
    for (int i = 0; i < nearest.count; ++i) {
        nearest.heights[i] = s.heights[i + extra];
        nearest.transparency[i] = s.transparency[i + extra];
        memcpy(nearest.color[i], s.color[i + extra], sizeof s.color[i]);
    }
    burnish_render_options options = square_options(4, 0);
    burnish_mesh *first = make_squares(&s, &state), *second = make_squares(&nearest, &state);
    burnish_render_report report;
    options.max_overdraw = max_overdraw;
    draw_floats(first, &options, more[0], &report);
    CHECK(report.layers_dropped == (size_t)extra * 4 * SIZE * SIZE / 4, "%d of %g: %zu", limit,
          report.overdraw, report.layers_dropped);
    draw_floats(second, &options, kept[0], &report);
    CHECK1(report.layers_dropped == 0);
    CHECK1(memcmp(more, kept, sizeof more) == 0);
    burnish_mesh_destroy(first);
    burnish_mesh_destroy(second);
}

/* Collecting layers takes as many passes as max_overdraw allows, and no more than are kept. */
static void test_limit(void) {
    uint64_t state = test_seed(2);
    stack s = make_stack(SQUARES, 0.98f, &state);
    burnish_mesh *mesh = make_squares(&s, &state);
    const burnish_render_options options = square_options(4, 0);
    static float pixels[SIZE * SIZE][4];
    burnish_render_report report;
    draw_floats(mesh, &options, pixels[0], &report);
    burnish_mesh_destroy(mesh);
    const int passes = BURNISH_TRANSPARENT_LAYERS_MAX / BURNISH_LAYERS_MAX;
    check_limit(BURNISH_TRANSPARENT_LAYERS_MAX, HUGE_VAL);
    const double small = SIZE * SIZE / (512.0 * 512.0); /* pictures may be covered more often */
    for (int pass = 1; pass <= passes; ++pass) {
        check_limit(pass * BURNISH_LAYERS_MAX, (pass + 0.01) * report.overdraw * small);
    }
}

/* ---- Layers against triangles drawn one by one ---- */

/* Small, large and piercing triangles, some exactly on one another. */
static void make_triangles(random_scene *scene, uint64_t *state) {
    static const float sizes[] = {1.5f, 6, 20, 60, 300};
    const size_t count = 1 + test_random32(state) % 50;
    scene->vertex_count = scene->triangle_count = 0;
    while (scene->triangle_count < count) {
        uint32_t *corners = scene->indices + 3 * scene->triangle_count++;
        const float size = sizes[test_random32(state) % 5];
        const float center[3] = {test_uniform_float(state, -40, 40),
                                 test_uniform_float(state, -40, 40),
                                 test_uniform_float(state, -40, 40)};
        for (uint32_t i = 0; i < 3; ++i) {
            float p[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = center[k] + test_uniform_float(state, -size, size);
            }
            corners[i] = (uint32_t)scene->vertex_count;
            add_vertex(scene, p, state);
        }
        if (scene->triangle_count > 1 && test_random32(state) % 4 == 0) {
            memcpy(corners, corners - 3, 3 * sizeof *corners);
            if (test_random32(state) % 2) {
                corners[0] = corners[-2];
                corners[1] = corners[-3];
            }
        }
    }
}

typedef struct reference_layer {
    float depth;
    uint32_t index; /* * 2 + 1 where it is back-facing */
} reference_layer;

typedef struct expected_layers {
    int counts[BURNISH_TILE_PIXELS * BURNISH_MAX_SAMPLES];
    reference_layer items[BURNISH_TILE_PIXELS * BURNISH_MAX_SAMPLES][64];
} expected_layers;

/* Every transparent triangle alone: where it is nearer than the opaque ones it is a layer. */
static void draw_layers(const reference_tile *opaque, const burnish_raster_view *view,
                        const burnish_geometry *geometry, const uint32_t *indices, size_t count,
                        expected_layers *layers) {
    const int column = opaque->x / BURNISH_TILE_SIZE, row = opaque->y / BURNISH_TILE_SIZE;
    reference_tile alone;
    CHECK1(reference_tile_create(&alone, opaque->samples, NULL) == BURNISH_STATUS_OK);
    memset(layers->counts, 0, sizeof layers->counts);
    for (size_t t = 0; t < count; ++t) {
        reference_draw_indices(&alone, view, geometry, column, row, &indices[t], 1);
        const uint32_t back = reference_side(geometry, indices[t]) == 1;
        for (int i = 0; i < BURNISH_TILE_PIXELS * opaque->samples; ++i) {
            const float depth = alone.depths[i];
            if (alone.triangles[i] == REFERENCE_NO_TRIANGLE || !(depth > opaque->depths[i])) {
                continue;
            }
            int at = layers->counts[i]++;
            for (; at > 0 && depth > layers->items[i][at - 1].depth; --at) {
                layers->items[i][at] = layers->items[i][at - 1];
            }
            layers->items[i][at] = (reference_layer){depth, indices[t] * 2 + back};
        }
    }
    reference_tile_destroy(&alone);
}

/* Samples whose layers differ. */
static int compare_layers(const burnish_tile *fast, const expected_layers *expected, int *seen) {
    const int samples = fast->options.samples;
    int wrong = 0;
    for (int i = 0; i < BURNISH_TILE_PIXELS * samples; ++i) {
        const int pixel = i / samples, x = pixel % BURNISH_TILE_SIZE, y = pixel / BURNISH_TILE_SIZE;
        if (x >= fast->width || y >= fast->height) {
            continue;
        }
        const int at = burnish_sample_index(samples, burnish_pixel_index(x, y), i % samples);
        const int count = fast->layers->has_some ? fast->layers->counts[at] : 0;
        const int wanted =
            expected->counts[i] < BURNISH_LAYERS_MAX ? expected->counts[i] : BURNISH_LAYERS_MAX;
        *seen += count;
        wrong += count != wanted;
        for (int k = 0; k < count && k < wanted; ++k) {
            const size_t item =
                burnish_layer_index(fast->layers, at) + (size_t)(k * fast->layers->block_samples);
            wrong += memcmp(&fast->layers->depths[item], &expected->items[i][k].depth,
                            sizeof(float)) != 0;
            wrong += fast->layers->indices[item] != expected->items[i][k].index;
        }
    }
    return wrong;
}

/* Barycentric weights are in [0, 1], and each sample is in one fragment. */
static void check_fragments(const burnish_tile *fast, const burnish_raster_view *view,
                            const burnish_geometry *geometry) {
    static burnish_fragments fragments;
    burnish_layer_cursor cursor = {0};
    int expected = 0, samples = 0, wrong = 0;
    for (int i = 0; fast->layers->has_some && i < BURNISH_TILE_PIXELS * fast->options.samples;
         ++i) {
        expected += fast->layers->counts[i];
    }
    while (burnish_layers_next(fast, view, geometry, &cursor, &fragments)) {
        for (int i = 0; i < fragments.count; ++i) {
            const float weight1 = fragments.weight1[i], weight2 = fragments.weight2[i];
            samples += fragments.weight[i];
            wrong += fragments.weight[i] != __builtin_popcount(fragments.samples[i]);
            wrong += !(weight1 >= -1e-5f && weight2 >= -1e-5f && weight1 + weight2 <= 1 + 1e-5f);
        }
        if (!fast->layers->has_some) {
            break;
        }
    }
    CHECK(wrong == 0 && (samples == expected || !fast->layers->has_some),
          "%d fragments wrong, %d samples of %d", wrong, samples, expected);
}

static void check_layers(const random_scene *scene, const burnish_raster_view *view, int number,
                         uint64_t *state, int *seen) {
    static burnish_geometry geometry;
    static burnish_bins bins;
    static expected_layers layers;
    static uint16_t masks[2 * MOST_TRIANGLES];
    const burnish_raster_ops *ops = burnish_raster_ops_for(pick_isa(state));
    const burnish_triangles triangles = {
        scene->positions, scene->vertex_count, scene->indices, scene->triangle_count, NULL, 0};
    const burnish_tile_options options = {.samples = view->samples, .keep_ids = 1, .has_layers = 1};
    reference_tile tile;
    burnish_tile fast;
    list_triangles(ops, view, &triangles, &geometry, &bins);
    uint32_t *indices = malloc((reference_primitive_count(&geometry) + 1) * sizeof *indices);
    uint32_t *parts[2] = {malloc((reference_primitive_count(&geometry) + 1) * sizeof *indices),
                          malloc((reference_primitive_count(&geometry) + 1) * sizeof *indices)};
    for (size_t i = 0; i < geometry.batch_count; ++i) {
        masks[i] = (uint16_t)(test_random32(state) | test_random32(state));
    }
    reference_tile_create(&tile, view->samples, NULL);
    burnish_tile_create(&fast, &options, NULL, NULL);
    fast.transparent = masks;
    for (int i = 0; i < bins.columns * bins.end_row; ++i) {
        const int column = i % bins.columns, row = i / bins.columns;
        size_t counts[2] = {0, 0};
        const size_t count = reference_read_lists(&bins, column, row, indices);
        for (size_t k = 0; k < count; ++k) {
            const unsigned part =
                masks[indices[k] / BURNISH_BATCH_SIZE] >> indices[k] % BURNISH_BATCH_SIZE & 1;
            parts[part][counts[part]++] = indices[k];
        }
        reference_draw_indices(&tile, view, &geometry, column, row, indices, 0);
        for (int k = 0; k < BURNISH_TILE_PIXELS * view->samples; ++k) {
            tile.depths[k] = -1e30f;
            tile.triangles[k] = REFERENCE_NO_TRIANGLE;
        }
        reference_draw_indices(&tile, view, &geometry, column, row, parts[0], counts[0]);
        draw_layers(&tile, view, &geometry, parts[1], counts[1], &layers);
        if (burnish_tile_draw(&fast, ops, view, &geometry, &bins, column, row)) {
            CHECK(compare_owners(&tile, &fast, &geometry) == 0, "scene %d: opaque triangles",
                  number);
            CHECK(compare_layers(&fast, &layers, seen) == 0, "scene %d: layers", number);
            check_fragments(&fast, view, &geometry);
        }
    }
    free(indices);
    free(parts[0]);
    free(parts[1]);
    burnish_tile_destroy(&fast);
    reference_tile_destroy(&tile);
}

static void test_layers(int scenes) {
    static random_scene scene;
    uint64_t state = test_seed(3);
    int seen = 0;
    for (int i = 0; i < scenes; ++i) {
        static const int counts[] = {4, 1, 8, 1, 16, 1};
        const burnish_raster_view view = /* the eye is among them: some are clipped */
            i % 2 ? perspective_view(80, 70, counts[i % 6], 100, 60)
                  : parallel_view(80, 70, counts[i % 6]);
        make_triangles(&scene, &state);
        check_layers(&scene, &view, i, &state, &seen);
    }
    CHECK(seen > 1000 * scenes, "%d layers", seen);
}

/* ---- Pictures ---- */

static void set_transparency(burnish_mesh *mesh, float value) {
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    material.transparency = value;
    set_material(mesh, &material);
}

typedef struct drawn_planes {
    uint8_t pixels[83][97 * 4], coverage[83][97];
    float depth[83][97], normals[83][97 * 3];
    uint32_t triangles[83][97];
} drawn_planes;

static void draw_planes(const burnish_mesh *mesh, const burnish_render_options *options,
                        drawn_planes *to, burnish_render_report *report) {
    const burnish_target target = make_target(
        (burnish_pixels){97, 83, BURNISH_PIXELS_RGBA8, sizeof to->pixels[0], to->pixels[0]},
        to->depth[0], to->normals[0], to->triangles[0], to->coverage[0]);
    memset(to, 0, sizeof *to);
    draw_into(mesh, options, &target, report);
}

/* Planes show the nearest triangle, transparent or not. */
static void test_planes(int samples) {
    static drawn_planes stone, glass;
    burnish_mesh *mesh = load_tessellated(":knot", 6);
    burnish_render_options options = framed_options(mesh, 97, 83);
    burnish_render_report opaque, transparent;
    options.samples = samples;
    options.transparent = 1;
    options.occlusion = 4;
    draw_planes(mesh, &options, &stone, &opaque);
    set_transparency(mesh, 0.5f);
    draw_planes(mesh, &options, &glass, &transparent);
    CHECK1(memcmp(stone.depth, glass.depth, sizeof stone.depth) == 0);
    CHECK1(memcmp(stone.normals, glass.normals, sizeof stone.normals) == 0);
    CHECK1(memcmp(stone.triangles, glass.triangles, sizeof stone.triangles) == 0);
    CHECK1(memcmp(stone.coverage, glass.coverage, sizeof stone.coverage) == 0);
    CHECK1(memcmp(stone.pixels, glass.pixels, sizeof stone.pixels) != 0);
    CHECK1(opaque.covered_pixels == transparent.covered_pixels);
    CHECK1(memcmp(opaque.bounds, transparent.bounds, sizeof opaque.bounds) == 0);
    CHECK(opaque.triangles_drawn < transparent.triangles_drawn, "%zu, then %zu",
          opaque.triangles_drawn, transparent.triangles_drawn);
    burnish_mesh_destroy(mesh);
}

/* Alpha of vertices is interpolated, and ignored with their colours. */
static void test_vertex_alpha(void) {
    static const float positions[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static float pixels[SIZE * SIZE][4];
    const uint8_t colors[16] = {255, 255, 255, 0,   255, 255, 255, 255,
                                255, 255, 255, 255, 255, 255, 255, 0};
    burnish_render_options options = square_options(4, 0);
    burnish_mesh *mesh = create_quads(positions, colors, 1);
    CHECK1(burnish_mesh_get_view(mesh)->has_transparent_colors);
    options.transparent = 1;
    draw_floats(mesh, &options, pixels[0], NULL);
    for (int x = SIZE / 4; x < SIZE * 3 / 4; ++x) {
        const double expected = (x + 0.5 - SIZE / 4.0) / (SIZE / 2.0);
        CHECK(fabs((double)pixels[SIZE / 2 * SIZE + x][3] - expected) < 1e-5, "column %d: %g", x,
              (double)pixels[SIZE / 2 * SIZE + x][3]);
    }
    options.ignore_colors = 1;
    draw_floats(mesh, &options, pixels[0], NULL);
    CHECK1(pixels[SIZE / 2 * SIZE + SIZE / 4][3] == 1);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, "--scenes");
    const int scenes = test_option() ? atoi(test_option()) : 150;
    RUN(test_squares());
    RUN(test_limit());
    RUN(test_layers(scenes));
    RUN(test_planes(1));
    RUN(test_planes(4));
    RUN(test_planes(16));
    RUN(test_vertex_alpha());
    return test_end("transparency");
}
