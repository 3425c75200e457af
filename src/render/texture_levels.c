#include "render/texture_levels.h"

#include <string.h>

#include "core/srgb.h"

/* From one level to the next. */
typedef struct level_step {
    const uint8_t *from;
    uint8_t *to;
    int from_width, from_height, to_width, to_height;
    burnish_texture_kind kind;
} level_step;

/* Bytes of a row of codes. */
static size_t row_size(int width) {
    return 4 * ((size_t)width + 1);
}

/* ---- Means ---- */

/* Sum of texels, each times its share of a texel of the next level. */
typedef struct texel_sum {
    float color[3], alpha, weight;
    float plain[3]; /* WEIGHTED: without alpha, for where all of it is 0 */
} texel_sum;

/* Vectors of texels of normals, so many at a time that loops over them become vectors. */
enum { NORMALS_AT_ONCE = 64 };
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
        for (int k = 0; k < 3; ++k) {
            to[k] = burnish_linear_to_srgb(
                (((light[from[k]] + light[from[k + 4]]) + light[below[k]]) + light[below[k + 4]]) *
                0.25f);
        }
        to[3] = (uint8_t)((from[3] + from[7] + below[3] + below[7] + 2) >> 2);
    }
}

static void halve_normals(const uint8_t *from, size_t row, int width, uint8_t *to) {
    enum { HALF = NORMALS_AT_ONCE / 2 };
    for (int x = 0; x < width; x += HALF) {
        const int count = width - x < HALF ? width - x : HALF;
        normal_vectors upper, lower, mean;
        load_normals(from + 8 * (size_t)x, 2 * count, &upper);
        load_normals(from + 8 * (size_t)x + row, 2 * count, &lower);
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

static int halve_row(const level_step *step, int y) {
    const size_t row = row_size(step->from_width);
    const uint8_t *from = step->from + 2 * (size_t)y * row;
    uint8_t *to = step->to + (size_t)y * row_size(step->to_width);
    if (step->from_width != 2 * step->to_width || step->from_height != 2 * step->to_height) {
        return 0;
    }
    if (step->kind == BURNISH_TEXTURE_NUMBERS) {
        halve_numbers(from, row, step->to_width, to);
    } else if (step->kind == BURNISH_TEXTURE_COLORS) {
        halve_colors(from, row, step->to_width, to);
    } else if (step->kind == BURNISH_TEXTURE_NORMALS) {
        halve_normals(from, row, step->to_width, to);
    }
    return !burnish_texture_is_weighted(step->kind);
}

static void reduce_row(const level_step *step, int y) {
    if (halve_row(step, y)) {
        return;
    }
    const span rows = span_of(y, step->from_height, step->to_height);
    uint8_t *to = step->to + (size_t)y * row_size(step->to_width);
    for (int x = 0; x < step->to_width; ++x, to += 4) {
        const span columns = span_of(x, step->from_width, step->to_width);
        texel_sum sum = {0};
        for (int j = rows.first; j < rows.end; ++j) {
            const float row_share = j == rows.first     ? rows.first_share
                                    : j == rows.end - 1 ? rows.last_share
                                                        : 1;
            const uint8_t *from =
                step->from + (size_t)j * row_size(step->from_width) + 4 * (size_t)columns.first;
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

/* Level 0 is the image, that of normals unit vectors whatever the image's alpha is. */
typedef struct level_copy {
    const uint8_t *from;
    uint8_t *to;
    int width, is_normals;
} level_copy;

static void unit_normals(uint8_t *texels, int count) {
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

static void copy_rows(void *context, size_t first, size_t end) {
    const level_copy *copy = context;
    const size_t size = 4 * (size_t)copy->width;
    for (size_t y = first; y < end; ++y) {
        uint8_t *to = copy->to + y * row_size(copy->width);
        memcpy(to, copy->from + y * size, size);
        for (int x = 0; copy->is_normals && x < copy->width; x += NORMALS_AT_ONCE) {
            const int rest = copy->width - x;
            const int count = rest < NORMALS_AT_ONCE ? rest : NORMALS_AT_ONCE;
            unit_normals(to + 4 * (size_t)x, count);
        }
    }
}

static void find_least(burnish_texture_levels *levels, const uint8_t *texels, size_t count) {
    uint8_t least[4] = {255, 255, 255, 255};
    for (size_t i = 0; i < 4 * count; i += 4) {
        for (int k = 0; k < 4; ++k) {
            least[k] = texels[i + (size_t)k] < least[k] ? texels[i + (size_t)k] : least[k];
        }
    }
    memcpy(levels->least, least, sizeof least);
}

/* ---- Masks ---- */

/* An image whose alpha is a mask, and its codes, whose alpha becomes coverage. */
typedef struct mask_cover {
    const burnish_texture *from;
    uint8_t *to;
    float cutoff;
} mask_cover;

/* The share of a texel that alpha from `cutoff` on covers: alpha is taken for a plane, and its
 * slope counts along the texel's diagonal as a box has it for edges along its sides. */
static uint8_t texel_cover(const mask_cover *cover, int x, int y) {
    const uint8_t *alpha = cover->from->pixels + 3;
    const int width = cover->from->width, height = cover->from->height;
    const int left = x > 0 ? x - 1 : 0, right = x + 1 < width ? x + 1 : x;
    const int up = y > 0 ? y - 1 : 0, down = y + 1 < height ? y + 1 : y;
    const size_t row = (size_t)y * (size_t)width;
    const int along_x = alpha[4 * (row + (size_t)right)] - alpha[4 * (row + (size_t)left)];
    const int along_y = alpha[4 * ((size_t)down * (size_t)width + (size_t)x)] -
                        alpha[4 * ((size_t)up * (size_t)width + (size_t)x)];
    const int sum = (along_x < 0 ? -along_x : along_x) + (along_y < 0 ? -along_y : along_y);
    const float margin = (float)alpha[4 * (row + (size_t)x)] * (1.0f / 255) - cover->cutoff;
    const float slope = (float)sum * (0.5f / 255);
    if (cover->cutoff <= 0 || cover->cutoff > 1 || sum == 0) {
        return margin >= 0 ? 255 : 0;
    }
    const float share = margin / slope + 0.5f;
    return (uint8_t)(255 * (share < 0 ? 0 : share > 1 ? 1 : share) + 0.5f);
}

static void cover_rows(void *context, size_t first, size_t end) {
    const mask_cover *cover = context;
    for (int y = (int)first; y < (int)end; ++y) {
        uint8_t *row = cover->to + (size_t)y * row_size(cover->from->width);
        for (int x = 0; x < cover->from->width; ++x) {
            row[4 * (size_t)x + 3] = texel_cover(cover, x, y);
        }
    }
}

/* Where levels lie; returns the texels of all. */
static size_t lay_out(burnish_texture_levels *levels, int width, int height) {
    size_t total = 0;
    int level = 0;
    for (; level < BURNISH_TEXTURE_LEVELS_MAX; ++level) {
        levels->offset[level] = (int32_t)total;
        levels->width[level] = width;
        levels->height[level] = height;
        total += ((size_t)width + 1) * ((size_t)height + 1);
        if (width == 1 && height == 1) {
            break;
        }
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
    }
    levels->count = level + 1;
    for (int i = level + 1; i < BURNISH_TEXTURE_LEVELS_MAX; ++i) {
        levels->offset[i] = levels->offset[level];
        levels->width[i] = levels->height[i] = 1;
    }
    return total;
}

/* ---- What the kernel reads ---- */

/* A level's codes, and the 16-bit texels that they become. */
typedef struct level_widening {
    const uint8_t *from;
    uint16_t *to;
    int width;
    int is_weighted;
    uint16_t light[256];
} level_widening;

static void widen_row(const level_widening *widening, size_t y) {
    const size_t width = (size_t)widening->width;
    const uint8_t *from = widening->from + y * row_size(widening->width);
    uint16_t *to = widening->to + 4 * (width + 1) * y;
    for (size_t i = 0; i < 4 * width; i += 4) {
        const uint32_t alpha = from[i + 3];
        for (size_t k = i; k < i + 3; ++k) {
            const uint32_t light = widening->light[from[k]];
            to[k] = (uint16_t)(widening->is_weighted ? (light * alpha + 127) / 255 : light);
        }
        to[i + 3] = (uint16_t)(alpha * (BURNISH_TEXEL_ONE / 255));
    }
    memcpy(to + 4 * width, to, 4 * sizeof *to);
}

static void widen_rows(void *context, size_t first, size_t end) {
    for (size_t y = first; y < end; ++y) {
        widen_row(context, y);
    }
}

/* Rows of `width` texels that are worth a task. */
static size_t row_grain(int width) {
    return 1 + 16384 / (size_t)width;
}

/* What of level i is wider than the image: rows' ends and a last row. */
static void repeat_first(burnish_texture_levels *levels, int i, uint8_t *codes) {
    const size_t size = row_size(levels->width[i]), height = (size_t)levels->height[i];
    for (size_t y = 0; y < height; ++y) {
        memcpy(codes + (y + 1) * size - 4, codes + y * size, 4);
    }
    memcpy(codes + height * size, codes, size);
}

static void fill_light(burnish_texture_levels *levels, int i, level_widening *widening,
                       const uint8_t *codes, burnish_tasks *tasks) {
    const size_t row = 4 * ((size_t)levels->width[i] + 1), height = (size_t)levels->height[i];
    widening->from = codes;
    widening->to = levels->texels + 4 * (size_t)levels->offset[i];
    widening->width = levels->width[i];
    burnish_tasks_ranges(tasks, height, row_grain(levels->width[i]), widen_rows, widening);
    memcpy(widening->to + row * height, widening->to, row * sizeof *widening->to);
}

/* Fills levels from the codes of level 0; codes: of all levels. */
static void fill_levels(burnish_texture_levels *levels, const burnish_texture *texture,
                        uint8_t *codes, burnish_texture_kind kind, burnish_tasks *tasks) {
    const mask_cover cover = {texture, codes, levels->cutoff};
    level_widening widening = {.is_weighted = levels->is_weighted};
    for (int i = 0; i < 256; ++i) {
        widening.light[i] = (uint16_t)(burnish_srgb_to_linear[i] * (float)BURNISH_TEXEL_ONE + 0.5f);
    }
    for (int i = 0; i < levels->count; ++i) {
        uint8_t *level = codes + 4 * (size_t)levels->offset[i];
        if (levels->texels) {
            fill_light(levels, i, &widening, level, tasks);
        } else {
            repeat_first(levels, i, level);
        }
        if (i == 0 && kind == BURNISH_TEXTURE_MASKED) { /* level 0 keeps its alpha */
            burnish_tasks_ranges(tasks, (size_t)texture->height, row_grain(texture->width),
                                 cover_rows, (void *)&cover);
        }
        if (i + 1 < levels->count) {
            level_step step = {level,
                               codes + 4 * (size_t)levels->offset[i + 1],
                               levels->width[i],
                               levels->height[i],
                               levels->width[i + 1],
                               levels->height[i + 1],
                               kind};
            burnish_tasks_ranges(tasks, (size_t)step.to_height, row_grain(step.to_width),
                                 reduce_rows, &step);
        }
    }
}

burnish_status burnish_texture_levels_create(burnish_texture_levels *levels,
                                             const burnish_texture *texture,
                                             burnish_texture_kind kind, burnish_tasks *tasks,
                                             burnish_memory *memory) {
    const size_t count = (size_t)texture->width * (size_t)texture->height;
    const int is_light = kind == BURNISH_TEXTURE_COLORS || burnish_texture_is_weighted(kind);
    const size_t total = lay_out(levels, texture->width, texture->height);
    levels->codes =
        burnish_allocate(memory, total + BURNISH_TEXTURE_PAD, 4, "codes of texture levels");
    if (is_light) {
        levels->texels =
            burnish_allocate(memory, total, 4 * sizeof *levels->texels, "texture levels");
    }
    if (memory->status == BURNISH_STATUS_OK) {
        level_copy copy = {texture->pixels, levels->codes, texture->width,
                           kind == BURNISH_TEXTURE_NORMALS};
        burnish_tasks_ranges(tasks, (size_t)texture->height, row_grain(texture->width), copy_rows,
                             &copy);
        find_least(levels, texture->pixels, count);
        levels->is_weighted = burnish_texture_is_weighted(kind) && levels->least[3] < 255;
        fill_levels(levels, texture, levels->codes, kind, tasks);
        memset(levels->codes + 4 * total, 0, sizeof(uint8_t[4]) * BURNISH_TEXTURE_PAD);
    }
    if (is_light) {
        burnish_release(memory->context, levels->codes);
        levels->codes = NULL;
    }
    return memory->status != BURNISH_STATUS_OK ? memory->status
                                               : burnish_tasks_check(tasks, memory->error);
}

void burnish_texture_levels_destroy(burnish_texture_levels *levels,
                                    const burnish_context *context) {
    burnish_release(context, levels->texels);
    burnish_release(context, levels->codes);
    *levels = (burnish_texture_levels){0};
}
