#include "environment/environment_builder.h"

#include <string.h>

#include "base/numbers.h"
#include "core/vec3.h"
#include "image/xxh64.h"

/* ---- Shares ---- */

/* The height on the unit sphere at boundary i of `count` rows. */
static double row_edge(int i, int count) {
    double sine, cosine;
    burnish_sincos(BURNISH_PI * i / count, &sine, &cosine);
    return i == 0 ? 1 : i == count ? -1 : cosine;
}

/* Boundaries of `from` and `to` intervals that cover the same range: columns are equal, rows have
 * the heights of their zones, so both share out areas. */
static double edge_at(int i, int count, int is_row) {
    return is_row ? (1 - row_edge(i, count)) / 2 : (double)i / count;
}

static void share_out(burnish_environment_share *shares, int from, int to, int is_row) {
    int k = 0;
    for (int i = 0; i < from; ++i) {
        const double begin = edge_at(i, from, is_row), end = edge_at(i + 1, from, is_row);
        burnish_environment_share *s = &shares[i];
        while (k > 0 && edge_at(k, to, is_row) > begin) {
            --k;
        }
        while (k + 1 < to && edge_at(k + 1, to, is_row) <= begin) {
            ++k;
        }
        *s = (burnish_environment_share){.first = k};
        for (; s->count < 3 && k + s->count < to; ++s->count) {
            const double a = edge_at(k + s->count, to, is_row);
            const double b = edge_at(k + s->count + 1, to, is_row);
            if (a >= end) {
                break;
            }
            s->weights[s->count] = ((end < b ? end : b) - (begin > a ? begin : a)) / (b - a);
        }
    }
}

/* ---- Building ---- */

static burnish_status check_size(uint64_t width, uint64_t height, const char *name,
                                 burnish_error *error) {
    if (width < 1 || height < 1) {
        return burnish_fail(error, BURNISH_STATUS_FORMAT,
                            "%.200s: %llu x %llu pixels; use an image with pixels", name,
                            (unsigned long long)width, (unsigned long long)height);
    }
    if (width > BURNISH_ENVIRONMENT_MAX_SIDE || height > BURNISH_ENVIRONMENT_MAX_SIDE) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "%.200s: %llu x %llu pixels; environments of up to %d x %d are read",
                            name, (unsigned long long)width, (unsigned long long)height,
                            BURNISH_ENVIRONMENT_MAX_SIDE, BURNISH_ENVIRONMENT_MAX_SIDE);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_environment_builder_begin(burnish_environment_builder *builder,
                                                 uint64_t width, uint64_t height, const char *name,
                                                 burnish_memory *memory) {
    *builder = (burnish_environment_builder){.memory = memory, .name = name};
    const burnish_status status = check_size(width, height, name, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    builder->width = (int)width;
    builder->height = (int)height;
    builder->to_width = BURNISH_ENVIRONMENT_LEAST;
    while (builder->to_width < BURNISH_ENVIRONMENT_WIDTH &&
           (builder->to_width < builder->width || builder->to_width < 2 * builder->height)) {
        builder->to_width *= 2;
    }
    builder->to_height = builder->to_width / 2;
    builder->columns = burnish_allocate(memory, (size_t)width, sizeof *builder->columns, name);
    builder->rows = burnish_allocate(memory, (size_t)height, sizeof *builder->rows, name);
    builder->sums = burnish_allocate_zeroed(
        memory, 3 * (size_t)builder->to_width * (size_t)builder->to_height, sizeof(double), name);
    if (memory->status == BURNISH_STATUS_OK) {
        share_out(builder->columns, builder->width, builder->to_width, 0);
        share_out(builder->rows, builder->height, builder->to_height, 1);
    }
    return memory->status;
}

void burnish_environment_builder_add(burnish_environment_builder *builder, int x, int y,
                                     const float rgb[3]) {
    const burnish_environment_share *column = &builder->columns[x], *row = &builder->rows[y];
    double value[3];
    for (int k = 0; k < 3; ++k) {
        const int is_usual = rgb[k] >= 0 && rgb[k] <= BURNISH_RADIANCE_MAX;
        value[k] = is_usual ? (double)rgb[k] : rgb[k] > 0 ? (double)BURNISH_RADIANCE_MAX : 0;
        builder->clamped += !is_usual;
    }
    for (int j = 0; j < row->count; ++j) {
        double *to = builder->sums + 3 * ((size_t)(row->first + j) * (size_t)builder->to_width +
                                          (size_t)column->first);
        for (int i = 0; i < column->count; ++i, to += 3) {
            const double weight = row->weights[j] * column->weights[i];
            for (int k = 0; k < 3; ++k) {
                to[k] += weight * value[k];
            }
        }
    }
}

void burnish_environment_builder_cancel(burnish_environment_builder *builder) {
    const burnish_context *context = builder->memory->context;
    burnish_release(context, builder->columns);
    burnish_release(context, builder->rows);
    burnish_release(context, builder->sums);
    builder->columns = builder->rows = NULL;
    builder->sums = NULL;
}

/* ---- Levels ---- */

static size_t level_floats(int width) {
    const size_t w = (size_t)width, h = w / 2;
    return 3 * w * h + 2 * w + 3 * h;
}

/* Fills everything but the texels. */
static void fill_directions(burnish_environment_level *level, float *columns, float *rows) {
    const int width = level->width, height = level->height;
    double sine, cosine;
    for (int i = 0; i < width; ++i) {
        burnish_sincos(2 * BURNISH_PI * (i + 0.5) / width - BURNISH_PI, &sine, &cosine);
        columns[i] = (float)cosine;
        columns[width + i] = (float)sine;
    }
    for (int j = 0; j < height; ++j) {
        burnish_sincos(BURNISH_PI * (j + 0.5) / height, &sine, &cosine);
        rows[j] = (float)cosine;
        rows[height + j] = (float)sine;
        rows[2 * height + j] =
            (float)((row_edge(j, height) - row_edge(j + 1, height)) * 2 * BURNISH_PI / width);
    }
}

/* Places a level in memory; returns its end. Its texels are `*texels`, planes. */
static float *place_level(burnish_environment_level *level, int width, float *memory,
                          float **texels) {
    const size_t plane = (size_t)width * (size_t)(width / 2);
    float *columns = memory + 3 * plane, *rows = columns + 2 * width;
    level->width = width;
    level->height = width / 2;
    for (size_t k = 0; k < 3; ++k) {
        level->texels[k] = memory + k * plane;
    }
    level->columns[0] = columns;
    level->columns[1] = columns + width;
    level->rows[0] = rows;
    level->rows[1] = rows + level->height;
    level->weights = rows + 2 * level->height;
    fill_directions(level, columns, rows);
    *texels = memory;
    return memory + level_floats(width);
}

/* Each texel is the mean of four of the level before, by solid angle. */
static void reduce_level(const burnish_environment_level *from, const burnish_environment_level *to,
                         float *texels) {
    const size_t width = (size_t)to->width;
    for (size_t k = 0; k < 3; ++k) {
        for (size_t j = 0; j < (size_t)to->height; ++j) {
            const float *above = from->texels[k] + 4 * j * width, *below = above + 2 * width;
            const float a = from->weights[2 * j], b = from->weights[2 * j + 1];
            const float upper = 0.5f * a / (a + b), lower = 0.5f * b / (a + b);
            for (size_t i = 0; i < width; ++i) {
                texels[(k * (size_t)to->height + j) * width + i] =
                    upper * (above[2 * i] + above[2 * i + 1]) +
                    lower * (below[2 * i] + below[2 * i + 1]);
            }
        }
    }
}

static void fill_levels(burnish_environment *environment, int width, const double *sums) {
    const size_t count = (size_t)width * (size_t)(width / 2);
    float *next = environment->memory, *texels;
    for (int i = 0; width >= BURNISH_ENVIRONMENT_LEAST; ++i, width /= 2) {
        burnish_environment_level *level = &environment->levels[i];
        next = place_level(level, width, next, &texels);
        if (i > 0) {
            reduce_level(level - 1, level, texels);
        }
        for (size_t j = 0; i == 0 && j < count; ++j) {
            for (size_t k = 0; k < 3; ++k) {
                texels[k * count + j] = (float)sums[3 * j + k];
            }
        }
        environment->level_count = i + 1;
    }
    burnish_xxh64 hash = burnish_xxh64_begin();
    burnish_xxh64_update(&hash, (const uint8_t *)environment->memory, 3 * count * sizeof(float));
    environment->hash = burnish_xxh64_end(&hash);
}

burnish_status burnish_environment_builder_end(burnish_environment_builder *builder,
                                               burnish_environment **environment) {
    burnish_memory *memory = builder->memory;
    size_t floats = 0;
    for (int width = builder->to_width; width >= BURNISH_ENVIRONMENT_LEAST; width /= 2) {
        floats += level_floats(width);
    }
    burnish_environment *made = burnish_allocate_zeroed(memory, 1, sizeof *made, builder->name);
    float *texels = burnish_allocate(memory, floats, sizeof(float), builder->name);
    if (memory->status == BURNISH_STATUS_OK) {
        made->owner = burnish_memory_owner(memory->context);
        made->memory = texels;
        fill_levels(made, builder->to_width, builder->sums);
    } else {
        burnish_release(memory->context, texels);
        burnish_release(memory->context, made);
        made = NULL;
    }
    burnish_environment_builder_cancel(builder);
    *environment = made;
    return memory->status;
}
