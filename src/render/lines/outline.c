#include "render/lines/outline.h"

#include <string.h>

#include "core/srgb.h"

enum { WORD = sizeof(uint64_t), ROWS = 16 /* per task */ };

int burnish_outline_is_wanted(const burnish_render_options *options) {
    return options->outline_contrast > 0 && !options->transparent &&
           !options->background_environment;
}

/* ---- Coverage ---- */

static uint8_t *row_at(const burnish_outline *outline, int y) {
    return outline->samples + (size_t)(y - outline->first + 1) * outline->stride + WORD;
}

burnish_status burnish_outline_begin(burnish_outline *outline,
                                     const burnish_render_options *options, int continues,
                                     int rows[2], burnish_memory *memory) {
    const int count = options->row_count > 0 ? options->row_count : options->height;
    const int first = options->first_row, end = first + count, width = options->width;
    const burnish_outline last = *outline;
    const int is_kept = continues && last.end == first && last.width == width &&
                        last.sample_count == options->samples;
    if (is_kept) { /* before the rows move */
        memmove(last.samples, row_at(&last, last.end - 1) - WORD, last.stride);
    }
    outline->stride = (size_t)(width + WORD - 1) / WORD * WORD + 2 * WORD;
    outline->samples = burnish_reserve(memory, outline->samples, &outline->capacity,
                                       (size_t)(count + 2) * outline->stride, 1, "an outline");
    if (!outline->samples) {
        *outline = (burnish_outline){0};
        return memory->status;
    }
    outline->first = first;
    outline->end = end;
    outline->width = width;
    outline->sample_count = options->samples;
    for (int y = first - 1; y <= end; ++y) {
        uint8_t *row = row_at(outline, y);
        memset(row - WORD, options->samples, WORD);
        memset(row + width, options->samples, outline->stride - WORD - (size_t)width);
    }
    rows[0] = first > 0 && !is_kept ? first - 1 : -1;
    rows[1] = end < options->height ? end : -1;
    if (first == 0) {
        memset(row_at(outline, -1), options->samples, (size_t)width);
    }
    if (end == options->height) {
        memset(row_at(outline, end), options->samples, (size_t)width);
    }
    return BURNISH_STATUS_OK;
}

/* Samples of the pixels of a row of blocks, in the order of the blocks. */
static void count_samples(const burnish_outline_pixels *pixels, int number, uint8_t all,
                          uint8_t *samples) {
    static const uint8_t none[BURNISH_BLOCK_ROW_PIXELS] = {0};
    const uint8_t *covered =
        pixels->covered ? pixels->covered + number * BURNISH_BLOCK_ROW_PIXELS : none;
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        samples[i] = pixels->simple[i] >= 0 ? all : covered[i];
    }
    for (int block = 0; pixels->layered && block < BURNISH_TILE_BLOCKS; ++block) {
        const unsigned bits = pixels->layered[number * BURNISH_TILE_BLOCKS + block];
        for (unsigned rest = bits; rest; rest &= rest - 1) {
            samples[block * BURNISH_BLOCK_PIXELS + __builtin_ctz(rest)] = all;
        }
    }
}

void burnish_outline_store(const burnish_outline *outline, const burnish_tile *tile, int number,
                           int first, int end, const burnish_outline_pixels *pixels) {
    enum { SIZE = BURNISH_BLOCK_SIZE };
    const size_t width = (size_t)tile->width;
    uint8_t samples[BURNISH_BLOCK_ROW_PIXELS], sorted[BURNISH_TILE_SIZE];
    if (pixels) {
        count_samples(pixels, number, (uint8_t)outline->sample_count, samples);
    } else {
        memset(sorted, 0, sizeof sorted);
    }
    for (int y = first; y < end; ++y) {
        for (int block = 0; pixels && block < BURNISH_TILE_BLOCKS; ++block) {
            memcpy(sorted + block * SIZE, samples + block * BURNISH_BLOCK_PIXELS + y * SIZE, SIZE);
        }
        memcpy(row_at(outline, tile->y + number * SIZE + y) + tile->x, sorted, width);
    }
}

/* ---- The line ---- */

typedef struct drawing {
    const burnish_outline *outline;
    const burnish_pixels *pixels;
    int contrast;
    int flip;          /* 255: on a dark background values count from white, else 0 */
    int background[3]; /* 8-bit values, in the order of the pixels */
    size_t pixel_size;
} drawing;

/* The 8-bit values of a pixel, and back. */
static void load_values(const drawing *d, const uint8_t *pixel, int values[3]) {
    for (int k = 0; k < 3; ++k) {
        float light;
        if (d->pixels->format == BURNISH_PIXELS_RGBA_FLOAT) {
            memcpy(&light, pixel + sizeof light * (size_t)k, sizeof light);
            values[k] = burnish_linear_to_srgb(light) ^ d->flip;
        } else {
            values[k] = pixel[k] ^ d->flip;
        }
    }
}

static void store_values(const drawing *d, const int values[3], uint8_t *pixel) {
    for (int k = 0; k < 3; ++k) {
        const uint8_t value = (uint8_t)(values[k] ^ d->flip);
        if (d->pixels->format == BURNISH_PIXELS_RGBA_FLOAT) {
            const float light = burnish_srgb_to_linear[value];
            memcpy(pixel + sizeof light * (size_t)k, &light, sizeof light);
        } else {
            pixel[k] = value;
        }
    }
}

static int least_of(int a, int b) {
    return a < b ? a : b;
}

/* Twice the samples of a pixel that are in the line, which is a pixel wide: those that an erosion by
 * four neighbours takes away, and by eight. */
static int line_samples(const uint8_t *at, size_t stride) {
    const uint8_t *up = at - stride, *down = at + stride;
    const int four = least_of(least_of(least_of(*up, *down), least_of(at[-1], at[1])), *at);
    const int corners = least_of(least_of(up[-1], up[1]), least_of(down[-1], down[1]));
    return 2 * *at - four - least_of(four, corners);
}

/* The values by which a pixel gets darker. An outline through the middle of a pixel leaves half of
 * the line in it and half in its neighbour; each of them then has the wanted contrast. */
static int outline_darkening(const drawing *d, const int values[3], int covered, int line) {
    const int samples = d->outline->sample_count, contrast = d->contrast;
    int darker = -255, brighter = -255;
    for (int k = 0; k < 3; ++k) {
        const int difference = d->background[k] - values[k];
        darker = difference > darker ? difference : darker;
        brighter = -difference > brighter ? -difference : brighter;
    }
    darker = darker * samples / covered; /* of what is in front of the background */
    brighter = brighter * samples / covered;
    if (darker >= contrast || brighter >= contrast) {
        return 0;
    }
    const int half = (contrast + 1) / 2, room = least_of(contrast - brighter, half); /* fades out */
    const int need = (contrast - darker) * room / half;
    const int share = least_of(4 * line, 5 * samples), whole = 4 * samples;
    return (need * share + whole - 1) / whole;
}

static void draw_pixel(const drawing *d, const uint8_t *at, uint8_t *pixel) {
    const int line = line_samples(at, d->outline->stride);
    int values[3];
    if (line == 0) {
        return;
    }
    load_values(d, pixel, values);
    const int step = outline_darkening(d, values, *at, line);
    for (int k = 0; k < 3; ++k) {
        values[k] = values[k] > step ? values[k] - step : 0;
    }
    if (step > 0) {
        store_values(d, values, pixel);
    }
}

static uint64_t load_8_bytes(const uint8_t *at) {
    uint64_t word;
    memcpy(&word, at, sizeof word);
    return word;
}

/* Whether eight pixels and all their neighbours are covered. */
static int is_inside(const uint8_t *at, size_t stride, uint64_t all) {
    uint64_t other = 0;
    for (int y = -1; y <= 1; ++y) {
        const uint8_t *row = y < 0 ? at - stride : at + (size_t)y * stride;
        other |= (load_8_bytes(row - 1) ^ all) | (load_8_bytes(row + 1) ^ all);
    }
    return other == 0;
}

static void draw_rows(void *context, size_t first, size_t end) {
    const drawing *d = context;
    const burnish_outline *outline = d->outline;
    const uint64_t all = 0x0101010101010101u * (uint64_t)outline->sample_count;
    for (size_t y = first; y < end; ++y) {
        const uint8_t *row = row_at(outline, outline->first + (int)y);
        uint8_t *pixels = d->pixels->pixels + y * d->pixels->stride;
        for (int x = 0; x < outline->width; x += WORD) {
            if (load_8_bytes(row + x) == 0 || is_inside(row + x, outline->stride, all)) {
                continue;
            }
            for (int i = x; i < least_of(x + WORD, outline->width); ++i) {
                if (row[i]) {
                    draw_pixel(d, row + i, pixels + (size_t)i * d->pixel_size);
                }
            }
        }
    }
}

void burnish_outline_draw(const burnish_outline *outline, const burnish_render_options *options,
                          const burnish_pixels *pixels, burnish_tasks *tasks) {
    const uint8_t *background = options->background;
    const int sum = background[0] + background[1] + background[2];
    const int is_light = pixels->format == BURNISH_PIXELS_RGBA_FLOAT;
    drawing d = {outline,
                 pixels,
                 options->outline_contrast,
                 sum < 3 * 128 ? 255 : 0,
                 {0},
                 is_light                                ? 4 * sizeof(float)
                 : pixels->format == BURNISH_PIXELS_RGB8 ? 3
                                                         : 4};
    for (int k = 0; k < 3; ++k) {
        const int from = pixels->format == BURNISH_PIXELS_BGRA8 ? 2 - k : k;
        d.background[k] = background[from] ^ d.flip;
    }
    burnish_tasks_ranges(tasks, (size_t)(outline->end - outline->first), ROWS, draw_rows, &d);
}
