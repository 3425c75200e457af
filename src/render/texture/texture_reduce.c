#include "render/texture/texture_reduce.h"

#include <string.h>

#include "core/srgb.h"

/* ---- Means ---- */

/* Sum of texels, each times its share of a texel of the next level. */
typedef struct texel_sum {
    float color[3], alpha, weight;
    float plain[3]; /* WEIGHTED: without alpha, for where all of it is 0 */
} texel_sum;

/* Vectors of texels of normals, so many at a time that loops over them become vectors. */
enum { NORMALS_AT_ONCE = BURNISH_TEXTURE_NORMALS_MAX };
typedef struct normal_vectors {
    float v[3][NORMALS_AT_ONCE];
} normal_vectors;

/* Lengths are below 1 where normals are means. */
static void load_normals(const uint8_t *texels, int count, normal_vectors *to) {
    for (int i = 0; i < count; ++i) {
        const float shortened = 1.0f - (float)texels[4 * i + 3] * (1.0f / 255);
        const float x = (float)texels[4 * i] * (2.0f / 255) - 1.0f;
        const float y = (float)texels[4 * i + 1] * (2.0f / 255) - 1.0f;
        const float z = (float)texels[4 * i + 2] * (2.0f / 255) - 1.0f;
        const float squared = (x * x + y * y) + z * z;
        const float divisor = squared > 0 ? squared : 1;
        const float scaled = (1.0f - shortened * shortened) / __builtin_sqrtf(divisor);
        const float scale = squared > 0 ? scaled : 0;
        to->v[0][i] = x * scale;
        to->v[1][i] = y * scale;
        to->v[2][i] = z * scale;
    }
}

static void store_normals(const normal_vectors *from, int count, uint8_t *texels) {
    for (int i = 0; i < count; ++i) {
        const float x = from->v[0][i], y = from->v[1][i], z = from->v[2][i];
        const float length = __builtin_sqrtf((x * x + y * y) + z * z);
        const float missing = length < 1 ? 1 - length : 0;
        const float divisor = length > 0 ? length : 1;
        const float up = length > 0 ? z / divisor : 1;
        const float shortened = 1.0f - __builtin_sqrtf(missing);
        texels[4 * i] = (uint8_t)(int)((x / divisor * 0.5f + 0.5f) * 255.0f + 0.5f);
        texels[4 * i + 1] = (uint8_t)(int)((y / divisor * 0.5f + 0.5f) * 255.0f + 0.5f);
        texels[4 * i + 2] = (uint8_t)(int)((up * 0.5f + 0.5f) * 255.0f + 0.5f);
        texels[4 * i + 3] = (uint8_t)(int)(shortened * 255.0f + 0.5f);
    }
}

static void add_texel(burnish_texture_kind kind, const uint8_t *texel, float share,
                      texel_sum *sum) {
    normal_vectors normal;
    sum->weight += share;
    sum->alpha += share * (float)texel[3];
    switch (kind) {
    case BURNISH_TEXTURE_NORMALS:
        load_normals(texel, 1, &normal);
        for (int k = 0; k < 3; ++k) {
            sum->color[k] += share * normal.v[k][0];
        }
        break;
    case BURNISH_TEXTURE_NUMBERS:
        for (int k = 0; k < 3; ++k) {
            sum->color[k] += share * (float)texel[k];
        }
        break;
    default:
        for (int k = 0; k < 3; ++k) {
            const float light = share * burnish_srgb_to_linear[texel[k]];
            sum->plain[k] += light;
            sum->color[k] += light * (float)texel[3];
        }
    }
}

static void store_texel(burnish_texture_kind kind, const texel_sum *sum, uint8_t *texel) {
    const int is_weighted = burnish_texture_is_weighted(kind) && sum->alpha > 0;
    if (kind == BURNISH_TEXTURE_NORMALS) {
        normal_vectors mean;
        for (int k = 0; k < 3; ++k) {
            mean.v[k][0] = sum->color[k] / sum->weight;
        }
        store_normals(&mean, 1, texel);
        return;
    }
    for (int k = 0; k < 3; ++k) {
        texel[k] = kind == BURNISH_TEXTURE_NUMBERS
                       ? (uint8_t)(sum->color[k] / sum->weight + 0.5f)
                       : burnish_linear_to_srgb(is_weighted ? sum->color[k] / sum->alpha
                                                            : sum->plain[k] / sum->weight);
    }
    texel[3] = (uint8_t)(sum->alpha / sum->weight + 0.5f);
}

/* ---- Levels ---- */

/* Texels [first, end) of a side of `from` that texel i of `to` covers, and the shares of the first
 * and the last; those between count whole. */
typedef struct span {
    int first, end;
    float first_share, last_share;
} span;

static span span_of(int i, int from, int to) {
    if (from == 2 * to) {
        return (span){2 * i, 2 * i + 2, 1, 1};
    }
    /* in units of 1 / to texels */
    const int64_t low = (int64_t)i * from, high = low + from;
    span s = {(int)(low / to), (int)((high + to - 1) / to), 1, 1};
    s.first_share = (float)((int64_t)(s.first + 1) * to - low) / (float)to;
    s.last_share = (float)(high - (int64_t)(s.end - 1) * to) / (float)to;
    if (s.end - s.first == 1) {
        s.first_share = 1;
    }
    return s;
}

/* Row y where sides are halved, as nearly all are: the same sums in the same order. */
static void halve_numbers(const uint8_t *from, size_t row, int width, uint8_t *to) {
    for (size_t x = 0; x < (size_t)width; ++x) {
        for (size_t k = 4 * x; k < 4 * x + 4; ++k) {
            const size_t i = 8 * x + (k & 3);
            to[k] = (uint8_t)((from[i] + from[i + 4] + from[i + row] + from[i + row + 4] + 2) >> 2);
        }
    }
}

static void halve_colors(const uint8_t *from, size_t row, int width, uint8_t *to) {
    const float *light = burnish_srgb_to_linear;
    for (int x = 0; x < width; ++x, from += 8, to += 4) {
        const uint8_t *below = from + row;
        uint64_t upper, lower;
        memcpy(&upper, from, sizeof upper);
        memcpy(&lower, below, sizeof lower);
        if (upper == lower && upper >> 32 == (uint32_t)upper) { /* one colour, which stays */
            memcpy(to, from, 4);
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            to[k] = burnish_linear_to_srgb(
                (((light[from[k]] + light[from[k + 4]]) + light[below[k]]) + light[below[k + 4]]) *
                0.25f);
        }
        to[3] = (uint8_t)((from[3] + from[7] + below[3] + below[7] + 2) >> 2);
    }
}

void burnish_texture_unit_normals(uint8_t *texels, int count) {
    normal_vectors vectors;
    for (int i = 0; i < count; ++i) {
        texels[4 * i + 3] = 255;
    }
    load_normals(texels, count, &vectors);
    store_normals(&vectors, count, texels);
    for (int i = 0; i < count; ++i) {
        texels[4 * i + 3] = 255;
    }
}

static void load_image_normals(const uint8_t *texels, int count, normal_vectors *to) {
    uint8_t units[4 * NORMALS_AT_ONCE];
    memcpy(units, texels, 4 * (size_t)count);
    burnish_texture_unit_normals(units, count);
    load_normals(units, count, to);
}

static void halve_normals(const uint8_t *from, size_t row, int width, int is_image, uint8_t *to) {
    enum { HALF = NORMALS_AT_ONCE / 2 };
    for (int x = 0; x < width; x += HALF) {
        const int count = width - x < HALF ? width - x : HALF;
        const uint8_t *above = from + 8 * (size_t)x;
        normal_vectors upper, lower, mean;
        if (is_image) {
            load_image_normals(above, 2 * count, &upper);
            load_image_normals(above + row, 2 * count, &lower);
        } else {
            load_normals(above, 2 * count, &upper);
            load_normals(above + row, 2 * count, &lower);
        }
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i < count; ++i) {
                mean.v[k][i] = (((upper.v[k][2 * i] + upper.v[k][2 * i + 1]) + lower.v[k][2 * i]) +
                                lower.v[k][2 * i + 1]) *
                               0.25f;
            }
        }
        store_normals(&mean, count, to + 4 * (size_t)x);
    }
}

static int halve_row(const burnish_texture_step *step, int y) {
    const size_t row = step->from_row;
    const uint8_t *from = step->from + 2 * (size_t)y * row;
    uint8_t *to = step->to + (size_t)y * burnish_texture_row_size(step->to_width);
    if (!burnish_texture_is_halved(step)) {
        return 0;
    }
    if (step->kind == BURNISH_TEXTURE_NUMBERS) {
        halve_numbers(from, row, step->to_width, to);
    } else if (step->kind == BURNISH_TEXTURE_COLORS) {
        halve_colors(from, row, step->to_width, to);
    } else if (step->kind == BURNISH_TEXTURE_NORMALS) {
        halve_normals(from, row, step->to_width, step->is_image, to);
    }
    return !burnish_texture_is_weighted(step->kind);
}

static void reduce_row(const burnish_texture_step *step, int y) {
    if (halve_row(step, y)) {
        return;
    }
    const span rows = span_of(y, step->from_height, step->to_height);
    uint8_t *to = step->to + (size_t)y * burnish_texture_row_size(step->to_width);
    for (int x = 0; x < step->to_width; ++x, to += 4) {
        const span columns = span_of(x, step->from_width, step->to_width);
        texel_sum sum = {0};
        for (int j = rows.first; j < rows.end; ++j) {
            const float row_share = j == rows.first     ? rows.first_share
                                    : j == rows.end - 1 ? rows.last_share
                                                        : 1;
            const uint8_t *from =
                step->from + (size_t)j * step->from_row + 4 * (size_t)columns.first;
            for (int i = columns.first; i < columns.end; ++i, from += 4) {
                const float share = i == columns.first     ? columns.first_share
                                    : i == columns.end - 1 ? columns.last_share
                                                           : 1;
                add_texel(step->kind, from, row_share * share, &sum);
            }
        }
        store_texel(step->kind, &sum, to);
    }
}

static void reduce_rows(void *context, size_t first, size_t end) {
    for (size_t y = first; y < end; ++y) {
        reduce_row(context, (int)y);
    }
}

void burnish_texture_reduce(burnish_texture_step *step, burnish_tasks *tasks) {
    burnish_tasks_ranges(tasks, (size_t)step->to_height, burnish_texture_row_grain(step->to_width),
                         reduce_rows, step);
}
