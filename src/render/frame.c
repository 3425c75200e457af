#include "render/frame.h"

#include <string.h>

#include "core/memory.h"
#include "core/srgb.h"

/* What one thread needs to draw tiles, and what it counted. */
struct burnish_tile_worker {
    burnish_tile tile;
    burnish_fragments fragments;
    burnish_shaded shaded;
    burnish_shade_cache cache;
    burnish_strip strip;
    float sum[3][BURNISH_TILE_PIXELS];    /* of shared pixels: linear light times samples */
    uint8_t covered[BURNISH_TILE_PIXELS]; /* of shared pixels: samples */
    uint32_t pixels[BURNISH_BLOCK_ROW_PIXELS];
    const uint8_t *background; /* a row of the image where nothing is */
    size_t covered_pixels;
    int bounds[4];
};

static void add_fragments(burnish_tile_worker *worker) {
    const burnish_fragments *fragments = &worker->fragments;
    for (int i = 0; i < fragments->count; ++i) {
        const int place = fragments->pixels[i];
        const float weight = (float)fragments->weight[i];
        for (int channel = 0; channel < 3; ++channel) {
            const float value = worker->shaded.channel[channel][i];
            worker->sum[channel][place] += weight * (value < 1.0f ? value : 1.0f);
        }
        worker->covered[place] = (uint8_t)(worker->covered[place] + fragments->weight[i]);
    }
}

/* The bits of a strip's row y: its columns that show something. */
static uint64_t row_bits(const burnish_tile_worker *worker, int y) {
    const uint64_t all = ~0ull >> (BURNISH_TILE_SIZE - worker->tile.width);
    uint64_t bits = 0;
    for (int x = 0; x < BURNISH_TILE_BLOCKS; ++x) {
        bits |= (uint64_t)(worker->strip.pixels.covered[x] >> 4 * y & 15) << 4 * x;
    }
    return bits & all;
}

/* Counts the pixels of a strip that show something, and their bounds. */
static void count_strip(burnish_tile_worker *worker, int number) {
    const burnish_tile *tile = &worker->tile;
    int *bounds = worker->bounds;
    for (int y = 0; y < BURNISH_BLOCK_SIZE; ++y) {
        const uint64_t bits = row_bits(worker, y);
        const int row = tile->y + number * BURNISH_BLOCK_SIZE + y;
        if (!bits || number * BURNISH_BLOCK_SIZE + y >= tile->height) {
            continue;
        }
        const int first = tile->x + __builtin_ctzll(bits);
        const int end = tile->x + BURNISH_TILE_SIZE - __builtin_clzll(bits);
        if (worker->covered_pixels == 0) {
            bounds[0] = first;
            bounds[1] = row;
        }
        worker->covered_pixels += (size_t)__builtin_popcountll(bits);
        bounds[0] = first < bounds[0] ? first : bounds[0];
        bounds[1] = row < bounds[1] ? row : bounds[1];
        bounds[2] = end > bounds[2] ? end : bounds[2];
        bounds[3] = row + 1 > bounds[3] ? row + 1 : bounds[3];
    }
}

/* a where the id is one (>= 0), b elsewhere; without a branch, since ids are hard to foresee.
 */
static inline float pick(int32_t id, float a, float b) {
    uint32_t none = (uint32_t)(id >> 31), a_bits, b_bits;
    memcpy(&a_bits, &a, sizeof a_bits);
    memcpy(&b_bits, &b, sizeof b_bits);
    a_bits = (a_bits & ~none) | (b_bits & none);
    memcpy(&a, &a_bits, sizeof a);
    return a;
}

/* With several samples, the light of a strip in place: whole pixels as they are, the others' sums
 * mixed with the background, or with alpha the mean of their covered samples. Pixels that nothing
 * covers get the background, whose code comes back from its linear value. */
static void mix_strip(const burnish_frame *frame, burnish_tile_worker *worker, int number) {
    const int base = number * BURNISH_BLOCK_ROW_PIXELS, samples = frame->options->samples;
    const int transparent = frame->options->transparent;
    const uint8_t *covered = worker->covered + base;
    const float all = 1.0f / (float)samples; /* a power of two */
    for (int channel = 0; channel < 3; ++channel) {
        const float behind =
            transparent ? 0.0f : burnish_srgb_to_linear[frame->options->background[channel]];
        const float *sum = worker->sum[channel] + base;
        float *light = worker->strip.rgb[channel];
        for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
            const float missing = (float)(samples - covered[i]);
            float mixed = (sum[i] + missing * behind) * all;
            if (transparent) {
                mixed = covered[i] ? sum[i] * (1.0f / (float)covered[i]) : 0.0f;
            }
            const float value = light[i] < 1.0f ? light[i] : 1.0f;
            light[i] = pick(worker->strip.pixels.simple[i], value, mixed);
        }
    }
}

/* A pixel's code where nothing is. */
static uint32_t code_behind(const burnish_render_options *options) {
    const uint8_t *code = options->background;
    return options->transparent
               ? 0
               : (uint32_t)code[0] | (uint32_t)code[1] << 8 | (uint32_t)code[2] << 16;
}

/* With one sample a pixel: the blocks that show a triangle, the others are background. */
static void encode_blocks(const burnish_frame *frame, burnish_tile_worker *worker, int number,
                          uint32_t alpha) {
    const burnish_strip *strip = &worker->strip;
    const uint32_t behind = code_behind(frame->options);
    const unsigned dirty_blocks = worker->tile.dirty_blocks[number];
    for (int block = 0; block < BURNISH_TILE_BLOCKS; ++block) {
        const int first = block * BURNISH_BLOCK_PIXELS;
        uint32_t *pixels = worker->pixels + first;
        if (dirty_blocks >> block & 1) {
            const float *const rgb[3] = {strip->rgb[0] + first, strip->rgb[1] + first,
                                         strip->rgb[2] + first};
            frame->ops->encode_pixels(frame->encoder, BURNISH_BLOCK_PIXELS, rgb,
                                      strip->pixels.simple + first, alpha, behind, pixels);
        } else {
            for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
                pixels[i] = behind;
            }
        }
    }
}

static void encode_strip(const burnish_frame *frame, burnish_tile_worker *worker, int number) {
    const burnish_strip *strip = &worker->strip;
    const float *const rgb[3] = {strip->rgb[0], strip->rgb[1], strip->rgb[2]};
    const int samples = frame->options->samples;
    const uint32_t alpha = frame->options->transparent ? 0xff000000u : 0;
    if (samples == 1) {
        encode_blocks(frame, worker, number, alpha);
        return;
    }
    mix_strip(frame, worker, number);
    frame->ops->encode_pixels(frame->encoder, BURNISH_BLOCK_ROW_PIXELS, rgb, NULL, 0, 0,
                              worker->pixels);
    const uint8_t *covered = worker->covered + number * BURNISH_BLOCK_ROW_PIXELS;
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS && alpha; ++i) {
        const int count = strip->pixels.simple[i] >= 0 ? samples : covered[i];
        worker->pixels[i] |= (uint32_t)((255 * count + samples / 2) / samples) << 24;
    }
}

/* Where nothing is: `width` pixels of the row that has been prepared. */
static void fill_row(const burnish_frame *frame, const uint8_t *background, int width,
                     uint8_t *out) {
    memcpy(out, background, (size_t)width * (size_t)frame->image->channels);
}

/* Row y of the strip's pixels into the image. */
static void store_row(const burnish_frame *frame, const burnish_tile_worker *worker, int y,
                      uint8_t *out) {
    const uint32_t *pixels = worker->pixels + y * BURNISH_BLOCK_SIZE;
    const int width = worker->tile.width;
    if (frame->options->transparent) {
        for (int x = 0; x < width; ++x) {
            const uint32_t pixel = pixels[x / 4 * BURNISH_BLOCK_PIXELS + x % 4];
            for (int k = 0; k < 4; ++k) {
                out[4 * x + k] = (uint8_t)(pixel >> 8 * k);
            }
        }
        return;
    }
    uint8_t bytes[3 * BURNISH_TILE_SIZE + 4];
    frame->ops->pack_groups(BURNISH_TILE_SIZE / BURNISH_BLOCK_SIZE, pixels, BURNISH_BLOCK_PIXELS,
                            bytes);
    if (width == BURNISH_TILE_SIZE) {
        memcpy(out, bytes, 3 * BURNISH_TILE_SIZE);
    } else {
        memcpy(out, bytes, 3 * (size_t)width);
    }
}

static uint8_t *pixels_at(const burnish_frame *frame, int x, int y) {
    const size_t place = (size_t)y * (size_t)frame->image->width + (size_t)x;
    return frame->image->pixels + place * (size_t)frame->image->channels;
}

static void finish_tile(const burnish_frame *frame, burnish_tile_worker *worker, int is_empty) {
    const burnish_tile *tile = &worker->tile;
    for (int y = 0; y < tile->height; ++y) {
        const int number = y / BURNISH_BLOCK_SIZE;
        uint8_t *to = pixels_at(frame, tile->x, tile->y + y);
        if (is_empty || !tile->dirty_blocks[number]) {
            fill_row(frame, worker->background, tile->width, to);
            continue;
        }
        if (y % BURNISH_BLOCK_SIZE == 0) {
            burnish_shade_strip(frame->shader, &worker->cache, frame->ops, tile, frame->view,
                                number, &worker->strip);
            if (frame->wants_counts) {
                count_strip(worker, number);
            }
            encode_strip(frame, worker, number);
        }
        store_row(frame, worker, y % BURNISH_BLOCK_SIZE, to);
    }
}

static void draw_tile(const burnish_frame *frame, const burnish_bins *bins,
                      burnish_tile_worker *worker, int column, int row) {
    burnish_tile *tile = &worker->tile;
    if (!burnish_tile_draw(tile, frame->ops, frame->view, frame->geometry, bins, column, row)) {
        finish_tile(frame, worker, 1);
        return;
    }
    if (frame->options->samples > 1) {
        memset(worker->covered, 0, sizeof worker->covered);
        memset(worker->sum, 0, sizeof worker->sum);
    }
    while (burnish_tile_next_fragments(tile, frame->view, &worker->fragments)) {
        burnish_shade(frame->shader, &worker->cache, &worker->fragments, &worker->shaded);
        add_fragments(worker);
    }
    finish_tile(frame, worker, 0);
    if (frame->drawn) {
        frame->ops->mark_drawn(tile, frame->drawn);
    }
}

/* What the tasks of a band share. */
typedef struct band_context {
    const burnish_frame *frame;
    const burnish_bins *bins;
    burnish_tile_worker *workers;
} band_context;

static void draw_task(void *of, size_t index, int thread) {
    const band_context *context = of;
    const burnish_bins *bins = context->bins;
    draw_tile(context->frame, bins, &context->workers[thread], (int)index % bins->columns,
              bins->first_row + (int)index / bins->columns);
}

/* Neighbouring tiles share cache lines of the image, so a thread takes some of them at once; but so
 * few that the last ones are not waited for. */
static size_t tiles_at_once(int count, int threads) {
    enum { MOST = 8, TURNS = 32 };
    const int share = count / (threads * TURNS);
    return (size_t)(share < 1 ? 1 : share > MOST ? MOST : share);
}

static burnish_status draw_bands(const burnish_frame *frame, burnish_tiles *tiles,
                                 burnish_error *error) {
    burnish_bins *bins = &tiles->bins;
    burnish_status status = BURNISH_STATUS_OK;
    burnish_bins_begin(bins, NULL);
    do {
        status =
            burnish_bin_tiles(bins, frame->ops, frame->geometry, frame->view, frame->pool, error);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        const int count = bins->columns * (bins->end_row - bins->first_row);
        band_context context = {frame, bins, tiles->workers};
        burnish_tasks_run(frame->pool, (size_t)count, tiles_at_once(count, tiles->worker_count),
                          tiles->worker_count, draw_task, &context);
    } while (bins->end_row < bins->rows);
    return status;
}

/* Counts are sums and bounds extremes: their order does not matter. */
static void merge_counts(const burnish_tiles *tiles, burnish_render_report *report) {
    for (int i = 0; i < tiles->worker_count; ++i) {
        const int *from = tiles->workers[i].bounds;
        int *to = report->bounds;
        if (tiles->workers[i].covered_pixels == 0) {
            continue;
        }
        if (report->covered_pixels == 0) {
            memcpy(to, from, sizeof report->bounds);
        }
        to[0] = from[0] < to[0] ? from[0] : to[0];
        to[1] = from[1] < to[1] ? from[1] : to[1];
        to[2] = from[2] > to[2] ? from[2] : to[2];
        to[3] = from[3] > to[3] ? from[3] : to[3];
        report->covered_pixels += tiles->workers[i].covered_pixels;
    }
}

static void destroy_workers(burnish_tiles *tiles) {
    for (int i = 0; i < tiles->worker_count; ++i) {
        burnish_tile_destroy(&tiles->workers[i].tile);
    }
    free(tiles->workers);
    tiles->workers = NULL;
    tiles->worker_count = 0;
}

static burnish_status create_workers(burnish_tiles *tiles, int count,
                                     const burnish_tile_options *options, burnish_error *error) {
    burnish_status status = burnish_legacy_allocate((void **)&tiles->workers, (size_t)count,
                                                    sizeof *tiles->workers, "tiles", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    memset(tiles->workers, 0, (size_t)count * sizeof *tiles->workers);
    tiles->worker_count = count;
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = burnish_tile_create(&tiles->workers[i].tile, options, error);
    }
    if (status != BURNISH_STATUS_OK) {
        destroy_workers(tiles); /* no later frame takes a half-made one for its own */
    }
    return status;
}

/* A worker a thread, but no more than there are tiles. */
static int worker_count(const burnish_frame *frame) {
    const int columns = (frame->view->width + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    const int rows = (frame->view->height + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    const int threads = burnish_tasks_threads(frame->pool);
    return threads < columns * rows ? threads : columns * rows;
}

/* A row of the image where nothing is. */
static burnish_status prepare_background(const burnish_frame *frame, burnish_tiles *tiles,
                                         burnish_error *error) {
    enum { MOST_CHANNELS = 4 };
    const size_t channels = (size_t)frame->image->channels, width = (size_t)frame->image->width;
    burnish_status status =
        burnish_legacy_reserve_discard((void **)&tiles->background, &tiles->background_capacity,
                                       width, MOST_CHANNELS, "a row", error);
    for (size_t i = 0; i < width && status == BURNISH_STATUS_OK; ++i) {
        const uint8_t *code = frame->options->background;
        for (size_t k = 0; k < channels; ++k) {
            tiles->background[channels * i + k] = frame->options->transparent ? 0 : code[k];
        }
    }
    return status;
}

/* Workers that can draw the frame: those of the last one where they do. */
static burnish_status prepare_workers(const burnish_frame *frame, burnish_tiles *tiles,
                                      burnish_error *error) {
    const burnish_shader *shader = frame->shader;
    const burnish_tile_options wanted = {.samples = frame->options->samples,
                                         .planes = burnish_shade_planes(shader),
                                         .keep_ids = shader->triangle_materials != NULL ||
                                                     frame->drawn != NULL,
                                         .needs_position = shader->needs_position};
    burnish_status status = prepare_background(frame, tiles, error);
    const int threads = worker_count(frame);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (tiles->worker_count != threads ||
        memcmp(&tiles->workers[0].tile.options, &wanted, sizeof wanted) != 0) {
        destroy_workers(tiles);
        status = create_workers(tiles, threads, &wanted, error);
    }
    for (int i = 0; i < tiles->worker_count; ++i) {
        tiles->workers[i].cache.material = -1;
        tiles->workers[i].background = tiles->background;
        tiles->workers[i].covered_pixels = 0;
        memset(tiles->workers[i].bounds, 0, sizeof tiles->workers[i].bounds);
        tiles->workers[i].tile.attributes[0] = shader->attributes->normals;
        tiles->workers[i].tile.attributes[1] = shader->attributes->colors;
    }
    return status;
}

burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_tiles *tiles,
                                  burnish_render_report *report, burnish_error *error) {
    burnish_status status = prepare_workers(frame, tiles, error);
    if (status == BURNISH_STATUS_OK) {
        status = draw_bands(frame, tiles, error);
    }
    if (status == BURNISH_STATUS_OK) {
        merge_counts(tiles, report);
    }
    return status;
}

void burnish_tiles_destroy(burnish_tiles *tiles) {
    destroy_workers(tiles);
    free(tiles->background);
    tiles->background = NULL;
    tiles->background_capacity = 0;
    burnish_bins_destroy(&tiles->bins);
}
