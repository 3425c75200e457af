#include "render/light/ray_light.h"

#include <string.h>

#include "base/elementary.h"
#include "core/vec3.h"
#include "environment/area_lights.h"

/* Normals of one surface differ by less than this cosine's angle, 26 degrees. */
#define ALIKE 0.9f

/* A point around which pixels stand for less than so many casts rays of its own. */
#define FEW 3.0f

/* Shares of a lamp that are hidden from neighbouring pixels differ by less, except at a sharp edge. */
#define LEAST_STEP 0.15f

/* From so much on the mean of the pixels around blurs such an edge more than it takes noise away; from
 * twice as much on it does not count. */
#define BLURRED_STEP 0.1f

/* Patterns of rays where one is not enough. */
enum { MORE_PATTERNS = 4 };

/* ---- Directions ---- */

burnish_vec3 burnish_ray_light_direction(int i) {
    enum { EDGE = BURNISH_RAY_LIGHT_EDGE };
    double x = 2.0 * (i % EDGE) / (EDGE - 1) - 1, y = 2.0 * (i / EDGE) / (EDGE - 1) - 1;
    const double across = x < 0 ? -x : x, down = y < 0 ? -y : y, z = 1 - across - down;
    if (z < 0) {
        x = x < 0 ? down - 1 : 1 - down;
        y = y < 0 ? across - 1 : 1 - across;
    }
    return burnish_vec3_normalize((burnish_vec3){x, y, z});
}

/* Number i of Sobol's sequence: of its first 4^k points, one is in each of 2^k x 2^k squares, and so it
 * is of the next. */
static void place_sample(uint32_t i, double *u, double *v) {
    uint32_t first = 0, second = 0, row = 0x80000000u;
    for (int bit = 0; bit < 32; ++bit, row ^= row >> 1) {
        first |= (i >> bit & 1) << (31 - bit);
        second ^= i >> bit & 1 ? row : 0;
    }
    const uint32_t count =
        i < BURNISH_RAY_DIRECTIONS ? BURNISH_RAY_DIRECTIONS : BURNISH_RAY_DIRECTIONS_MAX;
    const double middle = 0.5 / count;
    *u = first * 0x1p-32 + middle;
    *v = second * 0x1p-32 + middle;
}

void burnish_ray_light_prepare(burnish_ray_light *light) {
    for (int i = 0; i < BURNISH_RAY_DIRECTIONS_MAX; ++i) {
        double u, v, sine, cosine;
        place_sample((uint32_t)i, &u, &v);
        burnish_sincos(6.283185307179586 * v, &sine, &cosine);
        const double radius = burnish_sqrt(u);
        light->places[0][i][0] = (float)(2 * u - 1);
        light->places[0][i][1] = (float)(2 * v - 1);
        light->places[1][i][0] = light->directions[i][0] = (float)(radius * cosine);
        light->places[1][i][1] = light->directions[i][1] = (float)(radius * sine);
        light->directions[i][2] = (float)burnish_sqrt(1 - u);
    }
}

void burnish_ray_light_add(burnish_ray_light *light, const burnish_area_light *from) {
    const double pi = 3.14159265358979;
    burnish_ray_lamp *lamp = &light->lamps[light->lamp_count++];
    const int is_flat = burnish_area_is_flat(from);
    const int is_round = from->shape == BURNISH_AREA_DISC || from->shape == BURNISH_AREA_SPHERE;
    const double luminance = 0.2126 * (double)from->color[0] + 0.7152 * (double)from->color[1] +
                             0.0722 * (double)from->color[2];
    memset(lamp, 0, sizeof *lamp); /* padding, too: the ground compares them */
    lamp->shape = from->shape;
    lamp->is_distant = from->is_distant;
    lamp->is_two_sided = from->is_two_sided || !is_flat;
    lamp->radius = is_flat ? 0 : (float)burnish_area_radius(from);
    lamp->strength = (float)(luminance * (is_round ? pi : 4) / pi);
    for (int k = 0; k < 3; ++k) {
        lamp->center[k] = (float)from->center[k];
        lamp->half[0][k] = (float)from->half_u[k];
        lamp->half[1][k] = (float)from->half_v[k];
    }
}

/* ---- A tile ---- */

void burnish_ray_tile_begin(burnish_ray_tile *tile, int width, int height) {
    memset(tile->rank, 0, sizeof tile->rank);
    tile->width = width;
    tile->height = height;
}

static int row_major(int pixel) {
    return burnish_pixel_y(pixel) * BURNISH_TILE_SIZE + burnish_pixel_x(pixel);
}

/* The normal of a triangle, on the side of another one; that one if it has no area. */
static burnish_vec3 face_of(const burnish_mesh_view *mesh, uint32_t triangle, burnish_vec3 normal) {
    burnish_vec3 corner[3];
    if (triangle / 2 >= mesh->triangle_count) {
        return normal;
    }
    for (size_t k = 0; k < 3; ++k) {
        const size_t vertex = mesh->indices[3 * (size_t)(triangle / 2) + k];
        corner[k] = burnish_vec3_loadf(mesh->positions + 3 * vertex);
    }
    const burnish_vec3 face = burnish_vec3_cross(burnish_vec3_sub(corner[1], corner[0]),
                                                 burnish_vec3_sub(corner[2], corner[0]));
    const double length = burnish_vec3_length(face), side = burnish_vec3_dot(face, normal);
    return length > 0 ? burnish_vec3_scale(face, (side < 0 ? -1 : 1) / length) : normal;
}

void burnish_ray_tile_add(burnish_ray_tile *tile, const burnish_ray_light *light, int pixel,
                          uint16_t rank, const float position[3], const float normal[3],
                          uint32_t triangle) {
    const int at = row_major(pixel);
    if (rank <= tile->rank[at]) {
        return;
    }
    const burnish_vec3 along = burnish_vec3_loadf(normal);
    const double length = burnish_vec3_length(along);
    const burnish_vec3 unit = length > 0 ? burnish_vec3_scale(along, 1 / length) : along;
    const burnish_vec3 face = face_of(light->mesh, triangle, unit);
    const float of_normal[3] = {(float)unit.x, (float)unit.y, (float)unit.z};
    const float of_face[3] = {(float)face.x, (float)face.y, (float)face.z};
    tile->rank[at] = rank;
    for (int k = 0; k < 3; ++k) {
        tile->position[k][at] = position[k];
        tile->normal[k][at] = of_normal[k];
        tile->face[k][at] = of_face[k];
    }
}

/* Points that are brought together to cast rays. */
typedef struct gathered_points {
    float values[9][BURNISH_OCCLUDED_MAX + 16];
    float sums[3][BURNISH_OCCLUDED_MAX + 16];
    uint16_t from[BURNISH_OCCLUDED_MAX];
    size_t count;
} gathered_points;

/* Rays to lamp `lamp`, or with -1 to the sky. */
static void cast_rays(gathered_points *points, const burnish_ray_light *light,
                      const burnish_render_ops *ops, int lamp, int pattern, int patterns) {
    const burnish_ray_points cast = {{points->values[0], points->values[1], points->values[2]},
                                     {points->values[3], points->values[4], points->values[5]},
                                     {points->values[6], points->values[7], points->values[8]},
                                     points->count};
    float *const sums[3] = {points->sums[0], points->sums[1], points->sums[2]};
    const int first = pattern * BURNISH_RAY_SAMPLES, count = patterns * BURNISH_RAY_SAMPLES;
    for (int k = 0; k < 9; ++k) {
        memset(points->values[k] + points->count, 0, 16 * sizeof *points->values[k]);
    }
    if (lamp < 0) {
        ops->sample_sky(light, &cast, first, count, sums);
    } else {
        ops->sample_lamp(light, lamp, &cast, first, count, sums);
    }
}

/* Where the sums of a lamp are; -1: of the sky. */
static int sums_of(int lamp) {
    return BURNISH_RAY_LAMPS + 2 * lamp;
}

static int is_wanted(const burnish_ray_light *light, int lamp) {
    return light->has_sky || (lamp >= 0 && lamp == light->key);
}

static void store_sums(burnish_ray_tile *tile, const gathered_points *points, size_t i, int lamp,
                       float scale) {
    tile->sums[sums_of(lamp)][points->from[i]] = scale * points->sums[1][i];
    tile->sums[sums_of(lamp) + 1][points->from[i]] = scale * points->sums[2][i];
}

/* The share of a lamp that is hidden from a pixel. */
static float share_at(const burnish_ray_tile *tile, int at, int sums) {
    return tile->sums[sums][at] > 0 ? tile->sums[sums + 1][at] / tile->sums[sums][at] : 0;
}

/* Whether the rays of a pixel to a lamp do not agree, with one another or with those of its neighbours
 * on the same surface. */
static int is_mixed(const burnish_ray_tile *tile, int at, int sums) {
    const float share = share_at(tile, at, sums);
    const int x = at % BURNISH_TILE_SIZE, y = at / BURNISH_TILE_SIZE;
    int is_mixed = share > 0 && (share < 1 || tile->cut[at] >> (sums - BURNISH_RAY_LAMPS) / 2 & 1);
    for (int i = 0; i < 4 && !is_mixed; ++i) {
        const int column = x + i % 2 * (i - 2), row = y + (1 - i % 2) * (i - 1);
        const int beside = row * BURNISH_TILE_SIZE + column;
        if (column < 0 || row < 0 || column >= tile->width || row >= tile->height ||
            tile->rank[beside] == 0) {
            continue;
        }
        const float step = share_at(tile, beside, sums) - share;
        float cosine = 0;
        for (int k = 0; k < 3; ++k) {
            cosine += tile->normal[k][at] * tile->normal[k][beside];
        }
        is_mixed = cosine > ALIKE && (step > LEAST_STEP || step < -LEAST_STEP);
    }
    return is_mixed;
}

/* Casts the rays of a pattern's pixels to a lamp. */
static void cast_to_lamp(burnish_ray_tile *tile, const burnish_ray_light *light,
                         const burnish_render_ops *ops, int lamp, int pattern,
                         gathered_points *points) {
    cast_rays(points, light, ops, lamp, pattern, 1);
    for (size_t i = 0; i < points->count; ++i) {
        store_sums(tile, points, i, lamp, 1);
        tile->cut[points->from[i]] |=
            (uint16_t)((points->sums[0][i] < BURNISH_RAY_SAMPLES) << lamp);
    }
}

/* Casts more where a pattern's rays do not agree. */
static void refine_lamp(burnish_ray_tile *tile, const burnish_ray_light *light,
                        const burnish_render_ops *ops, int lamp, int pattern,
                        const gathered_points *points) {
    gathered_points mixed;
    mixed.count = 0;
    for (size_t i = 0; i < points->count; ++i) {
        if (tile->mixed[points->from[i]] >> lamp & 1) {
            for (int k = 0; k < 9; ++k) {
                mixed.values[k][mixed.count] = points->values[k][i];
            }
            mixed.from[mixed.count++] = points->from[i];
        }
    }
    if (mixed.count > 0) {
        cast_rays(&mixed, light, ops, lamp, pattern / MORE_PATTERNS * MORE_PATTERNS, MORE_PATTERNS);
    }
    for (size_t i = 0; i < mixed.count; ++i) {
        store_sums(tile, &mixed, i, lamp, 1.0f / MORE_PATTERNS);
        if (mixed.sums[0][i] < MORE_PATTERNS * BURNISH_RAY_SAMPLES) {
            tile->cut[mixed.from[i]] |= (uint16_t)(1u << lamp);
        }
    }
}

/* Every other bit of i. */
static int even_bits(int i) {
    return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8);
}

/* The pattern of a block's pixel to lamps. The four that make one finer are two pixels apart, so that
 * fine ones alternate from pixel to pixel; to the sky, they lie side by side. */
static int lamp_pattern(int pixel) {
    const int x = pixel % 4, y = pixel / 4;
    return x / 2 + y / 2 * 2 + x % 2 * 4 + y % 2 * 8;
}

/* Brings pixel `pixel` of all blocks together, in squares: their rays stay together. */
static void gather_pixels(const burnish_ray_tile *tile, int pixel, gathered_points *points) {
    enum { BLOCKS = BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS };
    _Static_assert((int)BLOCKS <= (int)BURNISH_OCCLUDED_MAX, "a pixel of all blocks is a batch");
    points->count = 0;
    for (int block = 0; block < BLOCKS; ++block) {
        const int x = even_bits(block) * 4 + pixel % 4;
        const int y = even_bits(block >> 1) * 4 + pixel / 4;
        const int at = y * BURNISH_TILE_SIZE + x;
        if (tile->rank[at] > 0) {
            for (int k = 0; k < 3; ++k) {
                points->values[k][points->count] = tile->position[k][at];
                points->values[3 + k][points->count] = tile->normal[k][at];
                points->values[6 + k][points->count] = tile->face[k][at];
            }
            points->from[points->count++] = (uint16_t)at;
        }
    }
}

void burnish_ray_tile_cast(burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops) {
    gathered_points points;
    if (!light->has_sky) {
        memset(tile->sums, 0, sizeof tile->sums);
    }
    memset(tile->cut, 0, sizeof tile->cut);
    memset(tile->mixed, 0, sizeof tile->mixed);
    for (int pixel = 0; pixel < BURNISH_BLOCK_PIXELS; ++pixel) {
        gather_pixels(tile, pixel, &points);
        if (is_wanted(light, -1)) {
            cast_rays(&points, light, ops, -1, pixel, 1);
        }
        for (size_t i = 0; i < points.count && is_wanted(light, -1); ++i) {
            tile->sums[BURNISH_RAY_COVERED][points.from[i]] = points.sums[0][i];
            store_sums(tile, &points, i, -1, 1);
        }
        for (int lamp = 0; lamp < light->lamp_count; ++lamp) {
            if (!is_wanted(light, lamp)) {
                continue;
            }
            cast_to_lamp(tile, light, ops, lamp, lamp_pattern(pixel), &points);
        }
    }
    for (int at = 0; at < BURNISH_TILE_PIXELS; ++at) {
        for (int lamp = 0; lamp < light->lamp_count && tile->rank[at] > 0; ++lamp) {
            tile->mixed[at] |= (uint16_t)(is_mixed(tile, at, sums_of(lamp)) << lamp);
        }
    }
    for (int pixel = 0; pixel < BURNISH_BLOCK_PIXELS && light->lamp_count > 0; ++pixel) {
        gather_pixels(tile, pixel, &points);
        for (int lamp = 0; lamp < light->lamp_count; ++lamp) {
            refine_lamp(tile, light, ops, lamp, lamp_pattern(pixel), &points);
        }
    }
}

/* ---- What points see ---- */

/* What is hidden of a lamp, as a share: of the pixels around, unless the pixel itself sees so much more
 * or less that an edge lies there, which their mean would blur. */
static float hidden_share(float around, float own) {
    const float step = own > around ? own - around : around - own;
    const float edge = (step - BLURRED_STEP) * (1 / BLURRED_STEP);
    return edge <= 0 ? around : around + (own - around) * (edge < 1 ? edge : 1);
}

/* Adds what pixels around a point found, each of a pattern's weight. Returns the weight of all. */
static float gather_sums(const burnish_ray_tile *tile, const burnish_ray_light *light, int pixel,
                         const float p[3], const float n[3], float sums[BURNISH_RAY_SUMS]) {
    static const float tent[5] = {0.5f, 1, 1, 1, 0.5f}; /* each pattern once */
    const int column = burnish_pixel_x(pixel), row = burnish_pixel_y(pixel);
    const int sum_count = sums_of(light->lamp_count);
    float all = 0;
    int own = -1;
    for (int i = 0; i < 25; ++i) {
        const int x = column + i % 5 - 2, y = row + i / 5 - 2, at = y * BURNISH_TILE_SIZE + x;
        if (x < 0 || y < 0 || x >= tile->width || y >= tile->height || tile->rank[at] == 0) {
            continue;
        }
        float height = 0, cosine = 0;
        for (int k = 0; k < 3; ++k) {
            height += (tile->position[k][at] - p[k]) * n[k];
            cosine += tile->normal[k][at] * n[k];
        }
        height = (height < 0 ? -height : height) / light->near;
        if (height < 1 && cosine > ALIKE) {
            const float weight = tent[i % 5] * tent[i / 5] * (1 - height * height) *
                                 ((cosine - ALIKE) / (1 - ALIKE));
            for (int s = 0; s < sum_count; ++s) {
                sums[s] += weight * tile->sums[s][at];
            }
            all += weight;
            own = x == column && y == row ? at : own;
        }
    }
    for (int lamp = 0; lamp < light->lamp_count && own >= 0; ++lamp) {
        float *const of = sums + sums_of(lamp);
        if (of[0] > 0 && tile->mixed[own] >> lamp & 1 && !(tile->cut[own] >> lamp & 1)) {
            of[1] = of[0] * hidden_share(of[1] / of[0], share_at(tile, own, sums_of(lamp)));
        }
    }
    return all;
}

/* The sums of points that cast all rays by themselves. */
static void cast_own(gathered_points *points, const burnish_ray_light *light,
                     const burnish_render_ops *ops, float (*sums)[BURNISH_RAY_SUMS]) {
    memset(sums, 0, points->count * sizeof *sums);
    for (int lamp = -1; lamp < light->lamp_count; ++lamp) {
        if (!is_wanted(light, lamp)) {
            continue;
        }
        cast_rays(points, light, ops, lamp, 0, MORE_PATTERNS);
        for (size_t i = 0; i < points->count; ++i) {
            if (lamp < 0) {
                sums[i][BURNISH_RAY_COVERED] = points->sums[0][i];
            }
            sums[i][sums_of(lamp)] = points->sums[1][i];
            sums[i][sums_of(lamp) + 1] = points->sums[2][i];
        }
    }
}

/* What a point sees, from sums of so many pixels' rays. */
static void set_seen(const burnish_ray_light *light, const float sums[BURNISH_RAY_SUMS],
                     float weight, int i, burnish_share_scratch *scratch, float *lit) {
    const float covered = sums[BURNISH_RAY_COVERED] / (weight * BURNISH_RAY_SAMPLES);
    float all = 0, hidden = 0;
    lit[i] = 1;
    for (int lamp = -1; lamp < light->lamp_count; ++lamp) {
        const float *own = sums + sums_of(lamp);
        if (lamp >= 0 && lamp == light->key) {
            lit[i] = own[0] > 0 ? 1 - own[1] / own[0] : 1;
        } else {
            all += own[0];
            hidden += own[1];
        }
    }
    scratch->open[0][i] = all > 0 ? 1 - light->strength * (hidden / all) : 1;
    scratch->open[1][i] = 1 - light->strength * covered;
}

void burnish_ray_tile_look(const burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops, const burnish_share_points *points,
                           int count, burnish_share_scratch *scratch, float *lit) {
    gathered_points own;
    float of_own[BURNISH_OCCLUDED_MAX][BURNISH_RAY_SUMS];
    own.count = 0;
    burnish_share_prepare(ops, points, count, scratch);
    for (int i = 0; i < count; ++i) {
        const int pixel = points->pixels ? points->pixels[i] : points->first_pixel + i;
        float p[3], n[3], sums[BURNISH_RAY_SUMS] = {0};
        scratch->open[0][i] = scratch->open[1][i] = lit[i] = 1;
        if (points->shown && points->shown[i] < 0) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            p[k] = scratch->position[k][i];
            n[k] = scratch->normal[k][i];
        }
        const float weight = gather_sums(tile, light, pixel, p, n, sums);
        if (weight >= FEW) {
            set_seen(light, sums, weight, i, scratch, lit);
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            own.values[k][own.count] = p[k];
            own.values[3 + k][own.count] = own.values[6 + k][own.count] = n[k];
        }
        own.from[own.count++] = (uint16_t)i;
    }
    if (own.count > 0) {
        cast_own(&own, light, ops, of_own);
    }
    for (size_t i = 0; i < own.count; ++i) {
        set_seen(light, of_own[i], MORE_PATTERNS, own.from[i], scratch, lit);
    }
}
