#include "render/light/maps/occlusion_share.h"

/* Least cosine between normals that share: 10 degrees. */
#define ALIKE 0.985f

/* In large pictures, squares of 4 x 4 pixels that lose more than this share of what they can lose
 * are looked up again as squares of 2 x 2: a grid would be visible there. */
#define DEEP 0.2f

enum { NO_KEY = 0xffff };

void burnish_share_prepare(const burnish_render_ops *ops, const burnish_share_points *points,
                           int count, burnish_share_scratch *scratch) {
    float *const normal[3] = {scratch->normal[0], scratch->normal[1], scratch->normal[2]};
    float inverse[BURNISH_SHARE_BATCH];
    for (int i = 0; i < count; ++i) {
        inverse[i] = 1.0f / points->w[i];
    }
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            scratch->position[k][i] = points->position[k][i] * inverse[i];
        }
    }
    ops->normalize_array((size_t)count, points->normal, normal);
}

/* The square of 2 x 2 or 4 x 4 pixels in which a pixel of a tile lies. */
static int square_of(int pixel, int share) {
    const int block = pixel / BURNISH_BLOCK_PIXELS * 4;
    return share == 4 ? block : block + (pixel >> 2 & 2) + (pixel >> 1 & 1);
}

static int is_alike(const burnish_share_scratch *scratch, int point, int key, float reach_squared) {
    float distance = 0, cosine = 0;
    for (int k = 0; k < 3; ++k) {
        const float step = scratch->position[k][point] - scratch->key_position[k][key];
        distance += step * step;
        cosine += scratch->normal[k][point] * scratch->key_normal[k][key];
    }
    return distance < reach_squared && cosine > ALIKE;
}

/* Makes a point a key; `next` is the key before of its square. */
static int add_key(int point, int square, int next, int *count, burnish_share_scratch *scratch) {
    const int key = (*count)++;
    for (int k = 0; k < 3; ++k) {
        scratch->key_position[k][key] = scratch->position[k][point];
        scratch->key_normal[k][key] = scratch->normal[k][point];
    }
    scratch->square[key] = (uint16_t)square;
    scratch->next[key] = (uint16_t)next;
    scratch->first[square] = (uint16_t)key;
    return key;
}

/* The key of a point: one of its square that is alike, or a new one. */
static int find_key(float reach_squared, int point, int square, int *count,
                    burnish_share_scratch *scratch) {
    const int first = scratch->first[square];
    const int is_known = first < *count && scratch->square[first] == square;
    for (int key = is_known ? first : NO_KEY; key != NO_KEY; key = scratch->next[key]) {
        if (is_alike(scratch, point, key, reach_squared)) {
            return key;
        }
    }
    return add_key(point, square, is_known ? first : NO_KEY, count, scratch);
}

/* Gives the shown pixels of a block one key where find_key() would: where all are like the first.
 * Returns 0 where not. */
static int share_block(const burnish_occlusion_lookup *lookup, const burnish_render_ops *ops,
                       const burnish_share_points *points, int at, int *count,
                       burnish_share_scratch *scratch) {
    const float *const position[3] = {scratch->position[0] + at, scratch->position[1] + at,
                                      scratch->position[2] + at};
    const float *const normal[3] = {scratch->normal[0] + at, scratch->normal[1] + at,
                                    scratch->normal[2] + at};
    const float limits[2] = {lookup->reach * lookup->reach, ALIKE};
    unsigned alike;
    const unsigned shown = ops->compare_block(
        position, normal, points->shown ? points->shown + at : NULL, limits, &alike);
    int key = NO_KEY;
    if (shown & ~alike) {
        return 0;
    }
    if (shown) {
        const int square = square_of(points->first_pixel + at, 4);
        key = add_key(at + __builtin_ctz(shown), square, NO_KEY, count, scratch);
    }
    for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
        scratch->key[at + i] = (uint16_t)(shown >> i & 1 ? key : NO_KEY);
    }
    return 1;
}

/* Sorts the points by pixel, keeping the order within a pixel. The order of fragments within a
 * block depends on the length of vectors, and it decides which points become keys. */
static void sort_points(const burnish_share_points *points, int count, uint16_t *order) {
    for (int first = 0, end; first < count; first = end) {
        const int block = points->pixels[first] / BURNISH_BLOCK_PIXELS;
        int next[BURNISH_BLOCK_PIXELS + 1] = {0};
        for (end = first; end < count && points->pixels[end] / BURNISH_BLOCK_PIXELS == block;
             ++end) {
            ++next[points->pixels[end] % BURNISH_BLOCK_PIXELS + 1];
        }
        next[0] = first;
        for (int i = 1; i < BURNISH_BLOCK_PIXELS; ++i) {
            next[i] += next[i - 1];
        }
        for (int i = first; i < end; ++i) {
            order[next[points->pixels[i] % BURNISH_BLOCK_PIXELS]++] = (uint16_t)i;
        }
    }
}

/* Chooses the points that are looked up; returns how many. */
static int find_keys(const burnish_occlusion_lookup *lookup, const burnish_render_ops *ops,
                     const burnish_share_points *points, int count, int share,
                     burnish_share_scratch *scratch) {
    const float reach_squared = lookup->reach * lookup->reach;
    uint16_t order[BURNISH_SHARE_BATCH];
    int keys = 0;
    if (points->pixels) {
        sort_points(points, count, order);
    }
    for (int i = 0; i < count; ++i) {
        const int at = points->pixels ? order[i] : i;
        if (!points->pixels && share == 4 && i % BURNISH_BLOCK_PIXELS == 0 &&
            share_block(lookup, ops, points, i, &keys, scratch)) {
            i += BURNISH_BLOCK_PIXELS - 1;
            continue;
        }
        const int pixel = points->pixels ? points->pixels[at] : points->first_pixel + at;
        scratch->key[at] = NO_KEY;
        if (!points->shown || points->shown[at] >= 0) {
            scratch->key[at] =
                (uint16_t)find_key(reach_squared, at, square_of(pixel, share), &keys, scratch);
        }
    }
    return keys;
}

/* Writes what each point sees of the light and the sky, [0, 1], if it is looked up. */
static void look_up(const burnish_occlusion_lookup *lookup, const burnish_render_ops *ops,
                    const burnish_share_points *points, int count, int share,
                    burnish_share_scratch *scratch) {
    const float *const position[3] = {scratch->key_position[0], scratch->key_position[1],
                                      scratch->key_position[2]};
    const float *const normal[3] = {scratch->key_normal[0], scratch->key_normal[1],
                                    scratch->key_normal[2]};
    const int keys = find_keys(lookup, ops, points, count, share, scratch);
    ops->occlude(lookup, position, normal, (size_t)keys,
                 (float *const[2]){scratch->key_open[0], scratch->key_open[1]});
    for (int i = 0; i < count; ++i) {
        if (scratch->key[i] != NO_KEY) {
            scratch->open[0][i] = scratch->key_open[0][scratch->key[i]];
            scratch->open[1][i] = scratch->key_open[1][scratch->key[i]];
        }
    }
}

void burnish_occlude_points(const burnish_occlusion_lookup *lookup, const burnish_render_ops *ops,
                            const burnish_share_points *points, int count,
                            burnish_share_scratch *scratch) {
    burnish_share_prepare(ops, points, count, scratch);
    for (int i = 0; i < count; ++i) {
        scratch->open[0][i] = scratch->open[1][i] = 1.0f;
    }
    look_up(lookup, ops, points, count, lookup->share, scratch);
    if (lookup->share == 4) {
        const float limit = 1.0f - DEEP * lookup->strength;
        burnish_share_points again = *points;
        int32_t shown[BURNISH_SHARE_BATCH], none = -1;
        for (int i = 0; i < count; ++i) {
            shown[i] = scratch->open[0][i] < limit ? 0 : -1;
            none &= shown[i];
        }
        again.shown = shown;
        if (none == 0) {
            look_up(lookup, ops, &again, count, 2, scratch);
        }
    }
}
