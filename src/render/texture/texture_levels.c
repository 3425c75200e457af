#include "render/texture/texture_levels.h"

#include <string.h>

#include "core/srgb.h"
#include "render/texture/texture_reduce.h"

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
        uint8_t *row = cover->to + (size_t)y * burnish_texture_row_size(cover->from->width);
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

static void widen_row(const level_widening *widening, const uint8_t *from, uint16_t *to) {
    const size_t width = (size_t)widening->width;
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
    const level_widening *widening = context;
    const size_t width = (size_t)widening->width;
    for (size_t y = first; y < end; ++y) {
        widen_row(widening, widening->from + y * burnish_texture_row_size(widening->width),
                  widening->to + 4 * (width + 1) * y);
    }
}

static level_widening make_widening(const burnish_texture_levels *levels, int i) {
    level_widening widening = {.is_weighted = levels->is_weighted, .width = levels->width[i]};
    for (int code = 0; code < 256; ++code) {
        widening.light[code] =
            (uint16_t)(burnish_srgb_to_linear[code] * (float)BURNISH_TEXEL_ONE + 0.5f);
    }
    return widening;
}

/* Texels of level i beyond the image: the ends of rows, and a last row. */
static void repeat_first(burnish_texture_levels *levels, int i, uint8_t *codes) {
    const size_t size = burnish_texture_row_size(levels->width[i]),
                 height = (size_t)levels->height[i];
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
    burnish_tasks_ranges(tasks, height, burnish_texture_row_grain(levels->width[i]), widen_rows,
                         widening);
    memcpy(widening->to + row * height, widening->to, row * sizeof *widening->to);
}

/* ---- Level 0 ---- */

/* Makes rows [first, end) of level 0 from the image; the last row of the level repeats the first.
 * Normals become unit vectors; their alpha is ignored. */
typedef struct level_copy {
    const burnish_texture *texture;
    uint8_t *codes; /* NULL: to texels, as light */
    uint16_t *texels;
    int is_normals;
    level_widening widening;
} level_copy;

static void copy_row(const level_copy *copy, size_t y) {
    const int width = copy->texture->width, most = BURNISH_TEXTURE_NORMALS_MAX;
    const size_t from_row = y == (size_t)copy->texture->height ? 0 : y;
    const uint8_t *from = copy->texture->pixels + 4 * (size_t)width * from_row;
    if (!copy->codes) {
        widen_row(&copy->widening, from, copy->texels + 4 * ((size_t)width + 1) * y);
        return;
    }
    uint8_t *to = copy->codes + y * burnish_texture_row_size(width);
    memcpy(to, from, 4 * (size_t)width);
    for (int x = 0; copy->is_normals && x < width; x += most) {
        burnish_texture_unit_normals(to + 4 * (size_t)x, width - x < most ? width - x : most);
    }
    memcpy(to + 4 * (size_t)width, to, 4);
}

static void copy_rows(void *context, size_t first, size_t end) {
    for (size_t y = first; y < end; ++y) {
        copy_row(context, y);
    }
}

/* Bands of level 0 on demand, but where the next level is made of level 0's own codes: of masks,
 * whose alpha changes, and of normals that are not halved. */
static burnish_status make_bands(burnish_texture_levels *levels, const burnish_texture *texture,
                                 burnish_texture_kind kind, burnish_memory *memory) {
    enum { BANDS = 64 };
    const int is_even =
        levels->width[0] == 2 * levels->width[1] && levels->height[0] == 2 * levels->height[1];
    if (levels->count == 1 || kind == BURNISH_TEXTURE_MASKED ||
        (kind == BURNISH_TEXTURE_NORMALS && !is_even)) {
        return BURNISH_STATUS_OK;
    }
    levels->bands = burnish_allocate_zeroed(memory, 1, sizeof *levels->bands, "texture levels");
    if (levels->bands) {
        const int rows = (levels->height[0] + BANDS) / BANDS; /* of height + 1 */
        const int count = levels->height[0] / rows + 1;
        levels->bands->texture = texture;
        levels->bands->is_normals = kind == BURNISH_TEXTURE_NORMALS;
        levels->bands->rows = rows;
        levels->bands->all = UINT64_MAX >> (BANDS - count);
    }
    return memory->status;
}

static void make_band(const burnish_texture_levels *levels, int band) {
    burnish_texture_bands *bands = levels->bands;
    const size_t first = (size_t)band * (size_t)bands->rows, rows = (size_t)levels->height[0] + 1;
    const size_t end = rows - first < (size_t)bands->rows ? rows : first + (size_t)bands->rows;
    level_copy copy = {bands->texture, levels->codes, levels->texels, bands->is_normals,
                       make_widening(levels, 0)};
    copy_rows(&copy, first, end);
    atomic_fetch_or_explicit(&bands->ready, (uint64_t)1 << band, memory_order_release);
}

static void need_bands(const burnish_texture_levels *levels, uint64_t wanted) {
    burnish_texture_bands *bands = levels->bands;
    if ((atomic_load_explicit(&bands->ready, memory_order_acquire) & wanted) == wanted) {
        return;
    }
    uint64_t mine = wanted & ~atomic_fetch_or(&bands->taken, wanted);
    for (; mine; mine &= mine - 1) {
        make_band(levels, __builtin_ctzll(mine));
    }
    /* another thread is making what is missing, and waits for nothing */
    while ((atomic_load_explicit(&bands->ready, memory_order_acquire) & wanted) != wanted) {
    }
}

void burnish_texture_levels_need(const burnish_texture_levels *levels, const int32_t *upper,
                                 const int32_t *lower, size_t count) {
    const burnish_texture_bands *bands = levels->bands;
    if (!bands || atomic_load_explicit(&bands->ready, memory_order_acquire) == bands->all) {
        return;
    }
    const int32_t size = levels->offset[1];
    int32_t first = size, last = -1;
    for (size_t i = 0; i < count; ++i) {
        const int32_t inside = lower[i] < size ? lower[i] : -1;
        first = upper[i] < first ? upper[i] : first;
        last = inside > last ? inside : last;
    }
    if (first < size) {
        const int per_band = (levels->width[0] + 1) * bands->rows;
        const int from = first / per_band, to = last / per_band;
        need_bands(levels, bands->all & UINT64_MAX << from & UINT64_MAX >> (63 - to));
    }
}

int burnish_texture_levels_has_some(const burnish_texture_levels *levels) {
    return !levels->bands || atomic_load_explicit(&levels->bands->ready, memory_order_acquire) > 0;
}

static void need_range(void *context, size_t first, size_t end) {
    const burnish_texture_levels *levels = context;
    need_bands(levels, UINT64_MAX << first & UINT64_MAX >> (64 - end));
}

void burnish_texture_levels_need_all(const burnish_texture_levels *levels, burnish_tasks *tasks) {
    const burnish_texture_bands *bands = levels->bands;
    if (bands && atomic_load_explicit(&bands->ready, memory_order_acquire) != bands->all) {
        const size_t count = (size_t)(levels->height[0] / bands->rows) + 1;
        burnish_tasks_ranges(tasks, count, 1, need_range, (void *)levels);
    }
}

/* ---- All levels ---- */

/* Memory for the codes of levels while they are filled: of all levels, or from level 1 on. */
typedef struct level_codes {
    uint8_t *codes;
    size_t first; /* texels before them */
} level_codes;

static uint8_t *codes_at(const burnish_texture_levels *levels, const level_codes *codes, int i) {
    return codes->codes + 4 * ((size_t)levels->offset[i] - codes->first);
}

/* The step from level i to the next, level 0 as the image has it where it comes in bands. */
static burnish_texture_step step_from(const burnish_texture_levels *levels,
                                      const burnish_texture *texture, const level_codes *codes,
                                      burnish_texture_kind kind, int i) {
    const int is_image = i == 0 && levels->bands;
    burnish_texture_step step = {.from = is_image ? texture->pixels : codes_at(levels, codes, i),
                                 .from_row = burnish_texture_row_size(levels->width[i]) -
                                             (is_image ? 4 : 0),
                                 .to = codes_at(levels, codes, i + 1),
                                 .from_width = levels->width[i],
                                 .from_height = levels->height[i],
                                 .to_width = levels->width[i + 1],
                                 .to_height = levels->height[i + 1],
                                 .is_image = is_image,
                                 .kind = kind};
    return step;
}

static void fill_levels(burnish_texture_levels *levels, const burnish_texture *texture,
                        const level_codes *codes, burnish_texture_kind kind, burnish_tasks *tasks) {
    const mask_cover cover = {texture, codes->codes, levels->cutoff};
    level_widening widening = make_widening(levels, 0);
    for (int i = 0; i < levels->count; ++i) {
        if (i > 0 || !levels->bands) {
            if (levels->texels) {
                fill_light(levels, i, &widening, codes_at(levels, codes, i), tasks);
            } else {
                repeat_first(levels, i, codes_at(levels, codes, i));
            }
        }
        if (i == 0 && kind == BURNISH_TEXTURE_MASKED) { /* level 0 keeps its alpha */
            burnish_tasks_ranges(tasks, (size_t)texture->height,
                                 burnish_texture_row_grain(texture->width), cover_rows,
                                 (void *)&cover);
        }
        if (i + 1 < levels->count) {
            burnish_texture_step step = step_from(levels, texture, codes, kind, i);
            burnish_texture_reduce(&step, tasks);
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
    if (make_bands(levels, texture, kind, memory) != BURNISH_STATUS_OK) {
        return memory->status;
    }
    level_codes codes = {.first = is_light && levels->bands ? (size_t)levels->offset[1] : 0};
    codes.codes = burnish_allocate(memory, total - codes.first + BURNISH_TEXTURE_PAD, 4,
                                   "codes of texture levels");
    if (is_light) {
        levels->texels =
            burnish_allocate(memory, total, 4 * sizeof *levels->texels, "texture levels");
    } else {
        levels->codes = codes.codes;
    }
    if (memory->status == BURNISH_STATUS_OK) {
        find_least(levels, texture->pixels, count);
        levels->is_weighted = burnish_texture_is_weighted(kind) && levels->least[3] < 255;
        if (!levels->bands) {
            level_copy copy = {.texture = texture,
                               .codes = codes.codes,
                               .is_normals = kind == BURNISH_TEXTURE_NORMALS};
            burnish_tasks_ranges(tasks, (size_t)texture->height,
                                 burnish_texture_row_grain(texture->width), copy_rows, &copy);
        }
        fill_levels(levels, texture, &codes, kind, tasks);
        if (!is_light) {
            memset(codes.codes + 4 * total, 0, sizeof(uint8_t[4]) * BURNISH_TEXTURE_PAD);
        }
    }
    if (is_light) {
        burnish_release(memory->context, codes.codes);
    }
    return memory->status != BURNISH_STATUS_OK ? memory->status
                                               : burnish_tasks_check(tasks, memory->error);
}

void burnish_texture_levels_destroy(burnish_texture_levels *levels,
                                    const burnish_context *context) {
    burnish_release(context, levels->texels);
    burnish_release(context, levels->codes);
    burnish_release(context, levels->bands);
    *levels = (burnish_texture_levels){0};
}
