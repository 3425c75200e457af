/* Large triangles against the reference: rods, slivers, needles, fans, triangles without area, on
 * the borders of tiles and cells, clipped, and as large as the guard band allows, in images of up
 * to 16384 x 16384 pixels; and the precision of their planes against exact weights. */
#include <math.h>

#include "compare_scene.h"

enum { SCENES = 600, LARGEST_IMAGE = 16384, WANTED_TILES = 12, LONE_TRIANGLES = 4000 };

/* On the screen: pixels from the image's top left corner. */
typedef struct screen_point {
    double x, y;
} screen_point;

/* A power of two between 2^low and 2^high. */
static double random_scale(uint64_t *state, double low, double high) {
    return exp2(test_uniform(state, low, high));
}

static int one_in(uint64_t *state, uint32_t count) {
    return test_random32(state) % count == 0;
}

/* Onto a border of a tile or cell, a pixel's centre, a place where samples lie; or nowhere else. */
static double snap(double at, uint64_t *state) {
    switch (test_random32(state) % 8) {
    case 0:
        return floor(at / BURNISH_TILE_SIZE) * BURNISH_TILE_SIZE;
    case 1:
        return floor(at / BURNISH_HIZ_PIXELS) * BURNISH_HIZ_PIXELS;
    case 2:
        return floor(at) + 0.5;
    case 3:
        return floor(at * 16) / 16;
    default:
        return at;
    }
}

/* Mostly in the image, or near it. */
static screen_point random_point(const burnish_raster_view *view, uint64_t *state) {
    const double far = one_in(state, 8) ? BURNISH_GUARD_BAND : 40;
    return (screen_point){snap(test_uniform(state, -far, view->width + far), state),
                          snap(test_uniform(state, -far, view->height + far), state)};
}

/* Directions: any, or nearly horizontal, vertical or diagonal. */
static screen_point random_direction(uint64_t *state) {
    const double eighth = atan(1.0);
    const double turn = one_in(state, 2)
                            ? test_uniform(state, 0, 8 * eighth)
                            : (test_random32(state) % 8) * eighth +
                                  (one_in(state, 2) ? 0 : random_scale(state, -16, -5));
    return (screen_point){cos(turn), sin(turn)};
}

/* Appends a vertex. slope: of the plane in which all of a scene lies, or 0: then its depth is
 * anything. */
static uint32_t add_point(random_scene *scene, const burnish_raster_view *view, screen_point at,
                          double slope, uint64_t *state) {
    const double half_width = 0.5 * view->width, half_height = 0.5 * view->height;
    const float z = slope != 0 ? (float)((at.x - 2 * at.y) * slope)
                               : test_uniform_float(state, -200, one_in(state, 64) ? 300 : 200);
    const float p[3] = {(float)(at.x - half_width), (float)(half_height - at.y), z};
    add_vertex(scene, p, state);
    return (uint32_t)scene->vertex_count - 1;
}

/* Seen from either side. */
static void add_triangle(random_scene *scene, uint32_t a, uint32_t b, uint32_t c, uint64_t *state) {
    uint32_t *corners = scene->indices + 3 * scene->triangle_count;
    const int turned = one_in(state, 2);
    corners[0] = a;
    corners[1] = turned ? c : b;
    corners[2] = turned ? b : c;
    scene->materials[scene->triangle_count++] = (uint16_t)(test_random32(state) % 3);
}

/* The other corners of a rod: one is `length` from corner 0, the other is `width` away from that
 * edge. */
static void complete_rod(screen_point at[3], screen_point direction, double length, double width,
                         uint64_t *state) {
    const double along = test_uniform(state, 0, 1) * length;
    at[1].x = at[0].x + length * direction.x;
    at[1].y = at[0].y + length * direction.y;
    at[2].x = at[0].x + along * direction.x - width * direction.y;
    at[2].y = at[0].y + along * direction.y + width * direction.x;
}

/* Corners of a triangle that is difficult in one way or another. */
static void random_corners(const burnish_raster_view *view, screen_point at[3], uint64_t *state) {
    const double along = test_uniform(state, 0, 1);
    at[0] = random_point(view, state);
    at[1] = random_point(view, state);
    at[2] = random_point(view, state);
    switch (test_random32(state) % 8) {
    case 0: /* anything */
        return;
    case 1: /* between the corners of the guard band */
        for (int i = 0; i < 3; ++i) {
            const double band = BURNISH_GUARD_BAND * (one_in(state, 4) ? 1.5 : 1);
            at[i].x = 0.5 * view->width + (one_in(state, 2) ? band : -band);
            at[i].y = 0.5 * view->height + (one_in(state, 2) ? band : -band);
        }
        if (one_in(state, 2)) {
            at[2] = random_point(view, state);
        }
        return;
    case 2: /* a few steps of 1/256 pixel from the line, or on it */
        at[2].x = at[0].x + along * (at[1].x - at[0].x) + (int)(test_random32(state) % 5) / 256.0;
        at[2].y = at[0].y + along * (at[1].y - at[0].y) - (int)(test_random32(state) % 5) / 256.0;
        return;
    case 3: /* no area */
        at[2] = one_in(state, 2) ? at[0]
                                 : (screen_point){(at[0].x + at[1].x) / 2, (at[0].y + at[1].y) / 2};
        return;
    default:
        complete_rod(at, random_direction(state), random_scale(state, 5, 13),
                     random_scale(state, -9, 4), state);
    }
}

/* A fan around a point, closed, whose triangles share their edges. */
static void add_fan(random_scene *scene, const burnish_raster_view *view, double slope,
                    uint64_t *state) {
    const screen_point middle = random_point(view, state);
    const double radius = random_scale(state, 5, 12), turn = 8 * atan(1.0);
    const uint32_t count = 3 + test_random32(state) % 60;
    const uint32_t first = add_point(scene, view, middle, slope, state);
    for (uint32_t i = 0; i < count; ++i) {
        const screen_point at = {middle.x + radius * cos(turn * i / count),
                                 middle.y + radius * sin(turn * i / count)};
        add_point(scene, view, at, slope, state);
    }
    for (uint32_t i = 0; i < count; ++i) {
        add_triangle(scene, first, first + 1 + i, first + 1 + (i + 1) % count, state);
    }
}

static void make_scene(random_scene *scene, const burnish_raster_view *view, uint64_t *state) {
    const double slope = one_in(state, 3) ? random_scale(state, -20, -6) : 0;
    const size_t count = 1 + test_random32(state) % 60;
    scene->vertex_count = scene->triangle_count = 0;
    if (one_in(state, 4)) {
        add_fan(scene, view, slope, state);
    }
    while (scene->triangle_count < count) {
        screen_point at[3];
        random_corners(view, at, state);
        for (int i = 0; i < 3; ++i) {
            add_point(scene, view, at[i], slope, state);
        }
        const uint32_t end = (uint32_t)scene->vertex_count;
        add_triangle(scene, end - 3, end - 2, end - 1, state);
        if (one_in(state, 4)) { /* share an edge */
            const uint32_t other = add_point(scene, view, random_point(view, state), slope, state);
            add_triangle(scene, end - 2, end - 3, other, state);
        }
    }
}

static burnish_raster_view make_view(int number, uint64_t *state) {
    static const int counts[] = {1, 4, 1, 8, 1, 16};
    const int most = number % 4 == 0 ? LARGEST_IMAGE : number % 4 == 1 ? 2000 : 200;
    int width = 1 + (int)(test_random32(state) % (uint32_t)most);
    int height = 1 + (int)(test_random32(state) % (uint32_t)most);
    if (number % 16 == 0) {
        width = height = LARGEST_IMAGE;
    }
    burnish_raster_view view = parallel_view(width, height, counts[number % 6]);
    if (number % 5 == 4) { /* the eye in the midst of the scene */
        const float focal = test_uniform_float(state, 50, 400);
        view = perspective_view(width, height, counts[number % 6], focal,
                                test_uniform_float(state, -50, 300));
    }
    view.cull_back_faces = number % 7 == 6;
    return view;
}

/* The tile of a point, or the nearest one. */
static size_t tile_at(const burnish_raster_view *view, double x, double y) {
    x = x < 0 ? 0 : x > view->width - 1 ? view->width - 1 : x;
    y = y < 0 ? 0 : y > view->height - 1 ? view->height - 1 : y;
    const int columns = (view->width + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    return (size_t)((int)y / BURNISH_TILE_SIZE * columns + (int)x / BURNISH_TILE_SIZE);
}

/* Wants the image's corners, and tiles along the edges of some triangles. */
static void choose_tiles(const random_scene *scene, const burnish_raster_view *view,
                         uint8_t wanted[BURNISH_MAX_TILES * BURNISH_MAX_TILES], uint64_t *state) {
    memset(wanted, 0, (size_t)BURNISH_MAX_TILES * BURNISH_MAX_TILES);
    for (int i = 0; i < 4; ++i) {
        wanted[tile_at(view, (i & 1) * view->width, (i >> 1) * view->height)] = 1;
    }
    for (int i = 0; i < WANTED_TILES; ++i) {
        const uint32_t *corners =
            scene->indices + 3 * (test_random32(state) % scene->triangle_count);
        const uint32_t side = test_random32(state) % 3;
        float inverse_w;
        const burnish_screen_vertex a =
            reference_vertex(view, scene->positions + 3 * corners[side], &inverse_w);
        const burnish_screen_vertex b =
            reference_vertex(view, scene->positions + 3 * corners[(side + 1) % 3], &inverse_w);
        const double along = test_uniform(state, 0, 1);
        wanted[tile_at(view, (a.x + along * (b.x - a.x)) / BURNISH_SUBPIXELS,
                       (a.y + along * (b.y - a.y)) / BURNISH_SUBPIXELS)] = 1;
    }
}

static void check_scenes(int scenes) {
    static random_scene scene;
    static uint8_t wanted[BURNISH_MAX_TILES * BURNISH_MAX_TILES];
    uint64_t state = test_seed(2);
    int points = 0;
    for (int i = 0; i < scenes; ++i) {
        const burnish_raster_view view = make_view(i, &state);
        make_scene(&scene, &view, &state);
        choose_tiles(&scene, &view, wanted, &state);
        compare_scene(&scene, &view, i, view.width > 200 ? wanted : NULL, &state, &points);
    }
    printf("%d scenes, %d points\n", scenes, points);
    CHECK(points > 2500 * scenes && scenes > 0, "the scenes show something: %d points", points);
}

/* Triangles that cover all of the picture, one behind the other in any order: parallel or crossing,
 * at equal depths, some of them twice. HiZ looks ahead there. */
static void make_pile(random_scene *scene, const burnish_raster_view *view, uint64_t *state) {
    const double far = 3 * (view->width + view->height);
    const int is_parallel = one_in(state, 2), levels = 1 + (int)(test_random32(state) % 300);
    scene->vertex_count = scene->triangle_count = 0;
    for (int i = 0; i < 120; ++i) {
        const uint32_t first = (uint32_t)scene->vertex_count;
        const uint32_t level = test_random32(state) % (uint32_t)levels;
        for (int k = 0; k < 3 && scene->vertex_count < MOST_VERTICES; ++k) {
            const float x = (float)(k == 0 ? -far : k == 1 ? far : 0);
            const float y = (float)(k == 2 ? far : -far);
            const float z = is_parallel ? (float)level : test_uniform_float(state, -200, 200);
            add_vertex(scene, (const float[]){x, y, z}, state);
        }
        add_triangle(scene, first, first + 1, first + 2, state);
        if (one_in(state, 4)) {
            const uint32_t other = 3 * (test_random32(state) % (first / 3 + 1));
            const uint32_t turn = test_random32(state) % 3;
            add_triangle(scene, other + turn, other + (turn + 1) % 3, other + (turn + 2) % 3,
                         state);
        }
    }
}

static void check_piles(int scenes) {
    static random_scene scene;
    uint64_t state = test_seed(9);
    int points = 0;
    for (int i = 0; i < scenes; ++i) {
        burnish_raster_view view = make_view(2 + 4 * (i % 64) + i % 2, &state);
        make_pile(&scene, &view, &state);
        compare_scene(&scene, &view, i, NULL, &state, &points);
    }
    CHECK(points > 1000 * scenes, "the piles show something: %d points", points);
}

/* ---- Needles around samples ---- */

/* Extended Euclid: the greatest common divisor of a and b, which is a x + b y. */
static int64_t find_divisor(int64_t a, int64_t b, int64_t *x, int64_t *y) {
    int64_t next_x = 0, next_y = 1;
    *x = 1;
    *y = 0;
    while (b != 0) {
        const int64_t quotient = a / b, rest = a - quotient * b;
        const int64_t rest_x = *x - quotient * next_x, rest_y = *y - quotient * next_y;
        a = b;
        b = rest;
        *x = next_x;
        *y = next_y;
        next_x = rest_x;
        next_y = rest_y;
    }
    return a;
}

/* Corners of a needle with a sample inside, as narrow as there can be: in steps of 1/256 pixel from
 * the sample they are u, v, -(u + v) with u x v = 1. */
static void narrowest_corners(screen_point sample, int64_t length, screen_point at[3],
                              uint64_t *state) {
    int64_t u[2], x, y;
    do {
        u[0] = 1 + (int64_t)(test_random64(state) % (uint64_t)length);
        u[1] = 1 + (int64_t)(test_random64(state) % (uint64_t)length);
    } while (find_divisor(u[0], u[1], &x, &y) != 1);
    const int64_t v[2] = {-y, x};
    const double turn = one_in(state, 2) ? 1 : -1;
    at[0] = (screen_point){turn * (double)u[0], (double)u[1]};
    at[1] = (screen_point){turn * (double)v[0], (double)v[1]};
    at[2] = (screen_point){-turn * (double)(u[0] + v[0]), -(double)(u[1] + v[1])};
    for (int i = 0; i < 3; ++i) {
        at[i].x = sample.x + at[i].x / BURNISH_SUBPIXELS;
        at[i].y = sample.y + at[i].y / BURNISH_SUBPIXELS;
    }
}

/* Needles, hidden by a wall or not: what rounding makes of their depth must not depend on what HiZ
 * knows. */
static void check_needles(int scenes) {
    static random_scene scene;
    static const int counts[] = {1, 4, 1, 8, 1, 16};
    uint64_t state = test_seed(9);
    int points = 0;
    for (int i = 0; i < scenes; ++i) {
        burnish_raster_view view = make_view(2, &state);
        view.samples = counts[i % 6];
        view.width = view.height = 2 * BURNISH_TILE_SIZE;
        scene.vertex_count = scene.triangle_count = 0;
        const float wall = test_uniform_float(&state, -100, 100);
        for (int k = 0; k < 3; ++k) {
            const float p[3] = {k == 1 ? 900 : -300, k == 2 ? 900 : -300, wall};
            add_vertex(&scene, p, &state);
        }
        memcpy(scene.indices, (const uint32_t[3]){0, 1, 2}, 12);
        scene.materials[scene.triangle_count++] = 0;
        while (scene.triangle_count < 60) {
            const int8_t *offset = burnish_sample_offsets(
                view.samples)[test_random32(&state) % (uint32_t)view.samples];
            const screen_point sample = {test_random32(&state) % 128 + 0.5 + offset[0] / 16.0,
                                         test_random32(&state) % 128 + 0.5 + offset[1] / 16.0};
            screen_point at[3];
            narrowest_corners(sample, (int64_t)random_scale(&state, 12, 20), at, &state);
            for (int k = 0; k < 3; ++k) {
                const float depth =
                    wall + (float)random_scale(&state, -12, 5) * (one_in(&state, 3) ? 1.0f : -1.0f);
                const float p[3] = {(float)(at[k].x - 64), (float)(64 - at[k].y), depth};
                add_vertex(&scene, p, &state);
            }
            const uint32_t end = (uint32_t)scene.vertex_count;
            add_triangle(&scene, end - 3, end - 2, end - 1, &state);
        }
        compare_scene(&scene, &view, i, NULL, &state, &points);
    }
    CHECK(points > 16384 * scenes, "the scenes show something: %d points", points);
}

/* ---- Precision ---- */

/* Triangles by their narrowest width, in pixels. */
enum { FAT, THIN, SLIVER, NEEDLE, CLASSES };
static const char *const CLASS_NAMES[CLASSES] = {"fat", "thin", "sliver", "needle"};
static const double LEAST_WIDTHS[CLASSES] = {16, 1, 1.0 / 16, 0};

/* Largest errors, over the range of a triangle's values: of depth, of attributes; and over the
 * bound. */
typedef struct plane_errors {
    double depth, attributes, of_bound;
    int values;
} plane_errors;

/* Of a triangle `width` pixels wide where it is narrowest: rounding of the value, and of what the
 * planes change within a cell. */
static double bound_of(double width) {
    return 0x1p-21 + 0x1p-19 / width;
}

/* A number at a place, from exact weights: edge functions over the area. */
typedef struct exact_weights {
    long double weight[3];
} exact_weights;

static exact_weights weights_at(const triangle_edges *edges, int64_t x, int64_t y) {
    exact_weights made;
    int64_t sum = 0, e[3];
    for (int i = 0; i < 3; ++i) {
        e[i] = edge_at(edges, i, x, y);
        sum += e[i];
    }
    for (int i = 0; i < 3; ++i) {
        made.weight[i] = (long double)e[i] / (long double)sum;
    }
    return made;
}

/* The error of a number over its range at the vertices; 0 where that is too small. */
static double error_of(const exact_weights *weights, const float values[3], float got) {
    long double exact = 0;
    float low = values[0], high = values[0];
    for (int i = 0; i < 3; ++i) {
        exact += weights->weight[i] * (long double)values[i];
        low = values[i] < low ? values[i] : low;
        high = values[i] > high ? values[i] : high;
    }
    return high - low < 0.25f ? 0 : fabs((double)(exact - (long double)got) / (high - low));
}

enum { VALUES = 1 + BURNISH_PLANE_COUNT }; /* depth, then attributes */

static void add_errors(const burnish_tile *fast, const triangle_edges *edges,
                       float values[VALUES][3], double width, plane_errors *errors) {
    const int samples = fast->options.samples;
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    double depth = errors->depth, attributes = errors->attributes, most = 0;
    for (int pixel = 0; pixel < BURNISH_TILE_PIXELS; ++pixel) {
        const int64_t x = (fast->x + burnish_pixel_x(pixel)) * BURNISH_SUBPIXELS + 128;
        const int64_t y = (fast->y + burnish_pixel_y(pixel)) * BURNISH_SUBPIXELS + 128;
        int covered = 0;
        for (int s = 0; s < samples; ++s) {
            const float got = fast->buffer.depths[burnish_sample_index(samples, pixel, s)];
            if (got == BURNISH_FARTHEST) {
                continue;
            }
            const exact_weights at =
                weights_at(edges, x + SAMPLE_STEP * offsets[s][0], y + SAMPLE_STEP * offsets[s][1]);
            const double error = error_of(&at, values[0], got);
            depth = fmax(depth, error);
            most = fmax(most, error);
            ++covered;
        }
        for (int k = 0; k < BURNISH_PLANE_COUNT && covered == samples; ++k) {
            const exact_weights at = weights_at(edges, x, y);
            const double error = error_of(&at, values[1 + k], fast->buffer.planes[k][pixel]);
            attributes = fmax(attributes, error);
            most = fmax(most, error);
        }
        errors->values += covered;
    }
    errors->depth = depth;
    errors->attributes = attributes;
    errors->of_bound = fmax(errors->of_bound, most / bound_of(width));
}

/* Draws a triangle alone. */
static void draw_alone(const burnish_raster_view *view, const screen_point at[3],
                       burnish_tile *fast, plane_errors errors[CLASSES], uint64_t *state) {
    static random_scene scene;
    static burnish_geometry geometry;
    static burnish_bins bins;
    burnish_float4 attributes[2][3];
    float values[VALUES][3];
    triangle_edges edges;
    double longest = 0;
    scene.vertex_count = scene.triangle_count = 0;
    for (int i = 0; i < 3; ++i) {
        add_point(&scene, view, at[i], 0, state);
        for (int k = 0; k < 8; ++k) {
            attributes[k / 4][i][k % 4] = test_uniform_float(state, -1, 1);
        }
    }
    add_triangle(&scene, 0, 1, 2, state);
    const burnish_raster_ops *ops = burnish_raster_ops_for(pick_isa(state));
    const burnish_triangles triangles = {scene.positions, 3, scene.indices, 1, NULL, 0};
    list_triangles(ops, view, &triangles, &geometry, &bins);
    const int side = reference_side(&geometry, 0);
    if (side < 0) {
        return;
    }
    load_edges(&geometry, 0, &edges);
    const burnish_primitive corners = reference_corners(&geometry, 0);
    for (int i = 0; i < 3; ++i) {
        const uint32_t v = corners.vertices[i];
        values[0][i] = geometry.vertices.items[v].depth;
        for (int k = 0; k < BURNISH_PLANE_COUNT; ++k) {
            values[1 + k][i] = attributes[k / 4][v][k % 4] * (k < 3 && side ? -1.0f : 1.0f);
        }
        longest = fmax(longest, hypot((double)edges.dx[i], (double)edges.dy[i]));
    }
    const double area = (double)(edges.dx[2] * edges.dy[0]) - (double)(edges.dy[2] * edges.dx[0]);
    const double width = area / longest / BURNISH_SUBPIXELS;
    int class = FAT;
    while (width < LEAST_WIDTHS[class]) {
        ++class;
    }
    fast->attributes[0] = attributes[0];
    fast->attributes[1] = attributes[1];
    for (int row = 0; row < bins.rows; ++row) {
        for (int column = 0; column < bins.columns; ++column) {
            if (edges.is_large &&
                burnish_tile_draw(fast, ops, view, &geometry, &bins, column, row)) {
                add_errors(fast, &edges, values, width, &errors[class]);
            }
        }
    }
}

static void check_precision(int samples) {
    const burnish_raster_view view =
        parallel_view(4 * BURNISH_TILE_SIZE, 4 * BURNISH_TILE_SIZE, samples);
    plane_errors errors[CLASSES] = {{0, 0, 0, 0}};
    uint64_t state = test_seed(3 + (uint64_t)samples);
    burnish_tile fast;
    const burnish_tile_options options = {
        .samples = samples, .planes = BURNISH_PLANE_COUNT, .keep_ids = 1};
    burnish_tile_create(&fast, &options, NULL, NULL);
    for (int i = 0; i < LONE_TRIANGLES; ++i) {
        screen_point at[3];
        if (i % 8 == 0) {
            const screen_point sample = {test_random32(&state) % 256 + 0.5,
                                         test_random32(&state) % 256 + 0.5};
            narrowest_corners(sample, (int64_t)random_scale(&state, 14, 20), at, &state);
        } else {
            const double length = random_scale(&state, 6, 13);
            const double from = test_uniform(&state, -length, 0);
            const screen_point direction = random_direction(&state);
            at[0].x = test_uniform(&state, 0, view.width) + from * direction.x;
            at[0].y = test_uniform(&state, 0, view.height) + from * direction.y;
            complete_rod(at, direction, length, random_scale(&state, -9, 7), &state);
        }
        draw_alone(&view, at, &fast, errors, &state);
    }
    for (int i = 0; i < CLASSES; ++i) {
        printf("%d samples, %s: depth 2^%.2f, attributes 2^%.2f, %.2f of the bound, %d samples\n",
               samples, CLASS_NAMES[i], log2(errors[i].depth), log2(errors[i].attributes),
               errors[i].of_bound, errors[i].values);
        CHECK(errors[i].of_bound <= 1 && errors[i].values > 500,
              "%s: %.2f of the bound, %d samples", CLASS_NAMES[i], errors[i].of_bound,
              errors[i].values);
    }
    burnish_tile_destroy(&fast);
}

/* --scenes N: fewer for slow machines. */
int main(int count, char **arguments) {
    test_begin(count, arguments, "--scenes");
    const int scenes = test_option() ? atoi(test_option()) : SCENES;
    RUN(check_scenes(scenes));
    RUN(check_piles(scenes / 20));
    RUN(check_needles(scenes / 8));
    RUN(check_precision(1));
    RUN(check_precision(8));
    return test_end("large_triangles");
}
