#include "render/texture/texture_levels.h"

#include <string.h>

#include "core/srgb.h"
#include "render/texture/texture_reduce.h"

/* The least code of each channel of some texels. */
typedef struct least_codes {
    const burnish_texture *texture;
    _Atomic uint32_t least[4];
} least_codes;

static void find_least_rows(void *context, size_t first, size_t end) {
    least_codes *codes = context;
    const size_t row = 4 * (size_t)codes->texture->width;
    const uint8_t *texels = codes->texture->pixels;
    uint8_t least[4] = {255, 255, 255, 255};
    for (size_t i = row * first; i < row * end; i += 4) {
        for (int k = 0; k < 4; ++k) {
            least[k] = texels[i + (size_t)k] < least[k] ? texels[i + (size_t)k] : least[k];
        }
    }
    for (int k = 0; k < 4; ++k) {
        uint32_t known = atomic_load(&codes->least[k]);
        while (least[k] < known &&
               !atomic_compare_exchange_weak(&codes->least[k], &known, least[k])) {
        }
    }
}

static void find_least(burnish_texture_levels *levels, const burnish_texture *texture,
                       burnish_tasks *tasks) {
    least_codes codes = {texture, {255, 255, 255, 255}};
    burnish_tasks_ranges(tasks, (size_t)texture->height,
                         4 * burnish_texture_row_grain(texture->width), find_least_rows, &codes);
    for (int k = 0; k < 4; ++k) {
        levels->least[k] = (uint8_t)atomic_load(&codes.least[k]);
    }
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
    size_t width;
    int is_weighted;
    const uint16_t *light;
} level_widening;

static void find_light(uint16_t light[256]) {
    for (int code = 0; code < 256; ++code) {
        light[code] = (uint16_t)(burnish_srgb_to_linear[code] * (float)BURNISH_TEXEL_ONE + 0.5f);
    }
}

static void widen_texels(const uint16_t *light, int is_weighted, const uint8_t *from, size_t count,
                         uint16_t *to) {
    for (size_t i = 0; i < 4 * count && !is_weighted; i += 4) {
        to[i] = light[from[i]];
        to[i + 1] = light[from[i + 1]];
        to[i + 2] = light[from[i + 2]];
        to[i + 3] = (uint16_t)(from[i + 3] * (BURNISH_TEXEL_ONE / 255));
    }
    for (size_t i = 0; i < 4 * count && is_weighted; i += 4) {
        const uint32_t alpha = from[i + 3];
        for (size_t k = i; k < i + 3; ++k) {
            to[k] = (uint16_t)((light[from[k]] * alpha + 127) / 255);
        }
        to[i + 3] = (uint16_t)(alpha * (BURNISH_TEXEL_ONE / 255));
    }
}

static void widen_rows(void *context, size_t first, size_t end) {
    const level_widening *widening = context;
    const size_t row = 4 * (widening->width + 1); /* items */
    for (size_t y = first; y < end; ++y) {
        uint16_t *to = widening->to + row * y;
        widen_texels(widening->light, widening->is_weighted, widening->from + row * y,
                     widening->width, to);
        memcpy(to + row - 4, to, 4 * sizeof *to);
    }
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

static void fill_light(burnish_texture_levels *levels, int i, const uint16_t *light,
                       const uint8_t *codes, burnish_tasks *tasks) {
    const size_t row = 4 * ((size_t)levels->width[i] + 1), height = (size_t)levels->height[i];
    level_widening widening = {codes, levels->texels + 4 * (size_t)levels->offset[i],
                               (size_t)levels->width[i], levels->is_weighted, light};
    burnish_tasks_ranges(tasks, height, burnish_texture_row_grain(levels->width[i]), widen_rows,
                         &widening);
    memcpy(widening.to + row * height, widening.to, row * sizeof *widening.to);
}

/* ---- Level 0 ---- */

/* Normals become unit vectors; their alpha is ignored. */
static void copy_codes(const uint8_t *from, size_t count, int is_normals, uint8_t *to) {
    const size_t most = BURNISH_TEXTURE_NORMALS_MAX;
    memcpy(to, from, 4 * count);
    for (size_t x = 0; is_normals && x < count; x += most) {
        burnish_texture_unit_normals(to + 4 * x, (int)(count - x < most ? count - x : most));
    }
}

/* The rows of the whole image as codes. */
typedef struct level_copy {
    const burnish_texture *texture;
    uint8_t *codes;
    int is_normals;
} level_copy;

static void copy_rows(void *context, size_t first, size_t end) {
    const level_copy *copy = context;
    const size_t width = (size_t)copy->texture->width;
    for (size_t y = first; y < end; ++y) {
        copy_codes(copy->texture->pixels + 4 * width * y, width, copy->is_normals,
                   copy->codes + y * burnish_texture_row_size(copy->texture->width));
    }
}

/* The logarithm of a block's side, given the texels of the level's. */
static int block_bits(int side, int least) {
    int bits = least;
    while (side > BURNISH_TEXTURE_BLOCKS << bits) {
        ++bits;
    }
    return bits;
}

/* Blocks of level 0 on demand, but where the next level is made of level 0's own codes: of masks,
 * whose alpha changes, and of normals that are not halved. */
static burnish_status make_blocks(burnish_texture_levels *levels, const burnish_texture *texture,
                                  burnish_texture_kind kind, burnish_memory *memory) {
    enum { COLUMN_BITS = 6, ROW_BITS = 4 };
    const int width = levels->width[0] + 1, height = levels->height[0] + 1;
    const int is_even =
        levels->width[0] == 2 * levels->width[1] && levels->height[0] == 2 * levels->height[1];
    if (levels->count == 1 || kind == BURNISH_TEXTURE_MASKED ||
        (kind == BURNISH_TEXTURE_NORMALS && !is_even)) {
        return BURNISH_STATUS_OK;
    }
    levels->blocks = burnish_allocate_zeroed(memory, 1, sizeof *levels->blocks, "texture levels");
    if (levels->blocks) {
        burnish_texture_blocks *blocks = levels->blocks;
        blocks->column_bits = block_bits(width, COLUMN_BITS);
        blocks->row_bits = block_bits(height, ROW_BITS);
        const int columns = ((width - 1) >> blocks->column_bits) + 1;
        blocks->texture = texture;
        blocks->is_normals = kind == BURNISH_TEXTURE_NORMALS;
        blocks->rows = ((height - 1) >> blocks->row_bits) + 1;
        blocks->all = UINT64_MAX >> (64 - columns);
        atomic_init(&blocks->missing, blocks->rows * columns);
        find_light(blocks->light);
    }
    return memory->status;
}

/* Texels [first, end) of a row of level 0. Its last texel repeats the first, its last row too. */
static void make_texels(const burnish_texture_levels *levels, size_t y, size_t first, size_t end) {
    const burnish_texture_blocks *blocks = levels->blocks;
    const size_t width = (size_t)levels->width[0], height = (size_t)levels->height[0];
    const uint8_t *from = blocks->texture->pixels + 4 * width * (y == height ? 0 : y);
    const size_t to = (width + 1) * y;
    const size_t inside = end > width ? width : end;
    for (int part = 0; part < 2; ++part) {
        const size_t at = part ? width : first, count = part ? end - inside : inside - first;
        const uint8_t *texels = from + (part ? 0 : 4 * first);
        if (levels->codes) {
            copy_codes(texels, count, blocks->is_normals, levels->codes + 4 * (to + at));
        } else {
            widen_texels(blocks->light, levels->is_weighted, texels, count,
                         levels->texels + 4 * (to + at));
        }
    }
}

static void make_block(const burnish_texture_levels *levels, int row, int column) {
    burnish_texture_blocks *blocks = levels->blocks;
    const size_t width = (size_t)levels->width[0] + 1, height = (size_t)levels->height[0] + 1;
    const size_t first = (size_t)column << blocks->column_bits;
    const size_t top = (size_t)row << blocks->row_bits;
    const size_t end = first + ((size_t)1 << blocks->column_bits);
    const size_t bottom = top + ((size_t)1 << blocks->row_bits);
    for (size_t y = top; y < (bottom < height ? bottom : height); ++y) {
        make_texels(levels, y, first, end < width ? end : width);
    }
    atomic_fetch_sub_explicit(&blocks->missing, 1, memory_order_release);
    atomic_fetch_or_explicit(&blocks->ready[row], (uint64_t)1 << column, memory_order_release);
}

static inline int is_missing(const burnish_texture_blocks *blocks, int row, uint64_t wanted) {
    return (atomic_load_explicit(&blocks->ready[row], memory_order_acquire) & wanted) != wanted;
}

static void need_blocks(const burnish_texture_levels *levels, int row, uint64_t wanted) {
    burnish_texture_blocks *blocks = levels->blocks;
    uint64_t mine = wanted & ~atomic_fetch_or(&blocks->taken[row], wanted);
    for (; mine; mine &= mine - 1) {
        make_block(levels, row, __builtin_ctzll(mine));
    }
    /* another thread is making what is missing, and waits for nothing */
    while (is_missing(blocks, row, wanted)) {
    }
}

static int is_box_there(const burnish_texture_blocks *blocks, const burnish_texture_box *box) {
    const uint64_t wanted = UINT64_MAX << (box->first[0] >> blocks->column_bits) &
                            UINT64_MAX >> (63 - (box->last[0] >> blocks->column_bits));
    int missing = 0;
    for (int y = box->first[1] >> blocks->row_bits; y <= box->last[1] >> blocks->row_bits; ++y) {
        missing |= is_missing(blocks, y, wanted);
    }
    return !missing;
}

void burnish_texture_levels_need(const burnish_texture_levels *levels,
                                 const burnish_texture_box *box, const int32_t *indices,
                                 size_t count) {
    const burnish_texture_blocks *blocks = levels->blocks;
    const int stride = levels->width[0] + 1;
    const double per_row = 1.0 / stride;
    if (!blocks || box->first[0] > box->last[0] || is_box_there(blocks, box)) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        if (indices[i] < levels->offset[1]) {
            const int y = (int)((indices[i] + 0.5) * per_row), x = indices[i] - y * stride;
            const uint64_t wanted = (uint64_t)1 << (x >> blocks->column_bits) |
                                    (uint64_t)1 << ((x + 1) >> blocks->column_bits);
            for (int row = y >> blocks->row_bits; row <= (y + 1) >> blocks->row_bits; ++row) {
                if (is_missing(blocks, row, wanted)) {
                    need_blocks(levels, row, wanted);
                }
            }
        }
    }
}

int burnish_texture_levels_has_some(const burnish_texture_levels *levels) {
    for (int i = 0; levels->blocks && i < levels->blocks->rows; ++i) {
        if (atomic_load_explicit(&levels->blocks->ready[i], memory_order_acquire)) {
            return 1;
        }
    }
    return !levels->blocks;
}

static void need_rows(void *context, size_t first, size_t end) {
    const burnish_texture_levels *levels = context;
    for (size_t i = first; i < end; ++i) {
        need_blocks(levels, (int)i, levels->blocks->all);
    }
}

void burnish_texture_levels_need_all(const burnish_texture_levels *levels, burnish_tasks *tasks) {
    if (levels->blocks && atomic_load(&levels->blocks->missing) > 0) {
        burnish_tasks_ranges(tasks, (size_t)levels->blocks->rows, 1, need_rows, (void *)levels);
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

/* The step from level i to the next, level 0 as the image has it where it comes in blocks. */
static burnish_texture_step step_from(const burnish_texture_levels *levels,
                                      const burnish_texture *texture, const level_codes *codes,
                                      burnish_texture_kind kind, int i) {
    const int is_image = i == 0 && levels->blocks;
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
    uint16_t light[256];
    find_light(light);
    for (int i = 0; i < levels->count; ++i) {
        if (i > 0 || !levels->blocks) {
            if (levels->texels) {
                fill_light(levels, i, light, codes_at(levels, codes, i), tasks);
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
    const int is_light = kind == BURNISH_TEXTURE_COLORS || burnish_texture_is_weighted(kind);
    const size_t total = lay_out(levels, texture->width, texture->height);
    if (make_blocks(levels, texture, kind, memory) != BURNISH_STATUS_OK) {
        return memory->status;
    }
    level_codes codes = {.first = is_light && levels->blocks ? (size_t)levels->offset[1] : 0};
    codes.codes = burnish_allocate(memory, total - codes.first + BURNISH_TEXTURE_PAD, 4,
                                   "codes of texture levels");
    if (is_light) {
        levels->texels =
            burnish_allocate(memory, total, 4 * sizeof *levels->texels, "texture levels");
    } else {
        levels->codes = codes.codes;
    }
    if (memory->status == BURNISH_STATUS_OK) {
        find_least(levels, texture, tasks);
        levels->is_weighted = burnish_texture_is_weighted(kind) && levels->least[3] < 255;
        if (!levels->blocks) {
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
    burnish_release(context, levels->blocks);
    *levels = (burnish_texture_levels){0};
}
