#include "render/frame.h"

#include <string.h>

#include "base/memory.h"
#include "base/srgb.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* What one thread needs to draw tiles, and what it counted. */
typedef struct tile_worker {
    burnish_visibility tile;
    burnish_fragments fragments;
    burnish_shaded shaded;
    burnish_shade_cache cache;
    float sum[3][BURNISH_TILE_PIXELS];    /* linear light times samples */
    uint8_t covered[BURNISH_TILE_PIXELS]; /* samples */
    size_t covered_pixels;
    int bounds[4];
    burnish_whole_row whole;
    burnish_row row;
} tile_worker;

static void add_fragments(tile_worker *worker) {
    const burnish_fragments *fragments = &worker->fragments;
    for (int i = 0; i < fragments->count; ++i) {
        const int pixel = fragments->pixel[i];
        const float weight = (float)fragments->weight[i];
        for (int channel = 0; channel < 3; ++channel) {
            const float value = worker->shaded.channel[channel][i];
            worker->sum[channel][pixel] += weight * (value < 1.0f ? value : 1.0f);
        }
        worker->covered[pixel] = (uint8_t)(worker->covered[pixel] + fragments->weight[i]);
    }
}

/* Adds a row of the tile to the counts; returns 0 when nothing covers it. */
static int count_row(tile_worker *worker, int y) {
    const burnish_visibility *tile = &worker->tile;
    const uint8_t *covered = worker->covered + y * BURNISH_TILE_SIZE;
    int count = 0, first = tile->width, end = 0;
    for (int x = 0; x < tile->width; ++x) {
        count += covered[x] != 0;
    }
    if (count == 0) {
        return 0;
    }
    for (first = 0; !covered[first]; ++first) {
    }
    for (end = tile->width; !covered[end - 1]; --end) {
    }
    int *bounds = worker->bounds;
    if (worker->covered_pixels == 0) {
        bounds[0] = tile->x + first;
        bounds[1] = tile->y + y;
    }
    worker->covered_pixels += (size_t)count;
    bounds[0] = tile->x + first < bounds[0] ? tile->x + first : bounds[0];
    bounds[1] = tile->y + y < bounds[1] ? tile->y + y : bounds[1];
    bounds[2] = tile->x + end > bounds[2] ? tile->x + end : bounds[2];
    bounds[3] = tile->y + y + 1 > bounds[3] ? tile->y + y + 1 : bounds[3];
    return 1;
}

/* a where the owner is one (>= 0), b elsewhere; without a branch, since owners are hard to foresee.
 */
static inline float pick(int32_t owner, float a, float b) {
    uint32_t none = (uint32_t)(owner >> 31), a_bits, b_bits;
    memcpy(&a_bits, &a, sizeof a_bits);
    memcpy(&b_bits, &b, sizeof b_bits);
    a_bits = (a_bits & ~none) | (b_bits & none);
    memcpy(&a, &a_bits, sizeof a);
    return a;
}

/* What a sum is multiplied with and how many samples the background fills, a pixel each. */
static void find_shares(const uint8_t *covered, int samples, int transparent,
                        float share[BURNISH_TILE_SIZE], float missing[BURNISH_TILE_SIZE]) {
    const float all = 1.0f / (float)samples; /* a power of two */
    for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
        share[x] = all;
        missing[x] = (float)(samples - covered[x]);
    }
    for (int x = 0; x < BURNISH_TILE_SIZE && transparent; ++x) {
        share[x] = covered[x] ? 1.0f / (float)covered[x] : 0.0f;
    }
}

/* The light of a row: whole pixels as they are, the others' sums mixed with the background, or with
 * alpha the mean of their covered samples. Pixels that nothing covers get the background, whose
 * code comes back from its linear value. */
static void mix_row(const burnish_frame *frame, const tile_worker *worker, int y,
                    float rgb[3][BURNISH_TILE_SIZE]) {
    const int first = y * BURNISH_TILE_SIZE, samples = frame->options->samples;
    const int transparent = frame->options->transparent;
    const int32_t *owners = worker->whole.owners;
    float share[BURNISH_TILE_SIZE], missing[BURNISH_TILE_SIZE];
    if (samples > 1) {
        find_shares(worker->covered + first, samples, transparent, share, missing);
    }
    for (int channel = 0; channel < 3; ++channel) {
        const float behind =
            transparent ? 0.0f : burnish_srgb_to_linear[frame->options->background[channel]];
        const float *light = worker->row.rgb[channel];
        if (samples == 1) {
            for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
                const float value = light[x] < 1.0f ? light[x] : 1.0f;
                rgb[channel][x] = pick(owners[x], value, behind);
            }
            continue;
        }
        const float *sum = worker->sum[channel] + first;
        for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
            const float value = light[x] < 1.0f ? light[x] : 1.0f;
            const float mixed = (sum[x] + missing[x] * behind) * share[x];
            rgb[channel][x] = pick(owners[x], value, mixed);
        }
    }
}

static void fill_row(const burnish_frame *frame, int width, uint8_t *out) {
    const uint8_t *background = frame->options->background;
    if (frame->options->transparent) {
        memset(out, 0, 4 * (size_t)width);
    } else if (background[0] == background[1] && background[0] == background[2]) {
        memset(out, background[0], 3 * (size_t)width);
    } else {
        for (int x = 0; x < width; ++x) {
            memcpy(out + 3 * x, background, 3);
        }
    }
}

static void store_row(const burnish_frame *frame, const tile_worker *worker, int y,
                      uint8_t pixels[4 * BURNISH_TILE_SIZE], uint8_t *out) {
    const uint8_t *covered = worker->covered + y * BURNISH_TILE_SIZE;
    const int width = worker->tile.width, samples = frame->options->samples;
    if (frame->options->transparent) {
        for (int x = 0; x < width; ++x) {
            pixels[4 * x + 3] = (uint8_t)((255 * covered[x] + samples / 2) / samples);
        }
        memcpy(out, pixels, 4 * (size_t)width);
        return;
    }
    for (int x = 0; x < width; ++x) {
        memcpy(out + 3 * x, pixels + 4 * x, 3);
    }
}

static void finish_row(const burnish_frame *frame, tile_worker *worker, int y, uint8_t *out) {
    uint8_t *covered = worker->covered + y * BURNISH_TILE_SIZE;
    const int samples = frame->options->samples;
    float rgb[3][BURNISH_TILE_SIZE];
    uint8_t pixels[4 * BURNISH_TILE_SIZE];
    burnish_visibility_row(&worker->tile, y, &worker->whole);
    (void)burnish_shade_row(frame->shader, &worker->cache, &worker->tile, &worker->whole,
                            frame->view, y, &worker->row);
    for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
        /* a whole pixel has no other points: nothing was counted there */
        covered[x] = (uint8_t)(covered[x] | (~(worker->whole.owners[x] >> 31) & samples));
    }
    if (!count_row(worker, y)) {
        fill_row(frame, worker->tile.width, out);
        return;
    }
    mix_row(frame, worker, y, rgb);
    const float *const rows[3] = {rgb[0], rgb[1], rgb[2]};
    frame->encode(frame->encoder, BURNISH_TILE_SIZE, rows, pixels);
    store_row(frame, worker, y, pixels, out);
}

static void finish_tile(const burnish_frame *frame, tile_worker *worker, int is_empty) {
    const burnish_visibility *tile = &worker->tile;
    const size_t channels = (size_t)frame->image->channels;
    for (int y = 0; y < tile->height; ++y) {
        size_t first = (size_t)(tile->y + y) * (size_t)frame->image->width + (size_t)tile->x;
        uint8_t *out = frame->image->pixels + first * channels;
        if (is_empty) {
            fill_row(frame, tile->width, out);
        } else {
            finish_row(frame, worker, y, out);
        }
    }
}

static void draw_tile(const burnish_frame *frame, const burnish_bins *bins, tile_worker *worker,
                      int column, int row) {
    burnish_visibility *tile = &worker->tile;
    if (!burnish_visibility_draw(tile, frame->visibility, frame->view, frame->geometry, bins,
                                 column, row)) {
        finish_tile(frame, worker, 1);
        return;
    }
    memset(worker->covered, 0, sizeof worker->covered);
    if (frame->options->samples > 1) {
        memset(worker->sum, 0, sizeof worker->sum);
    }
    while (burnish_visibility_next(tile, frame->view, &worker->fragments)) {
        burnish_shade(frame->shader, &worker->cache, &worker->fragments, &worker->shaded);
        add_fragments(worker);
    }
    finish_tile(frame, worker, 0);
    if (frame->drawn) {
        burnish_visibility_mark(tile, frame->drawn);
    }
}

static int thread_index(void) {
#ifdef _OPENMP
    return omp_get_thread_num();
#else
    return 0;
#endif
}

static burnish_status draw_bands(const burnish_frame *frame, tile_worker *workers,
                                 burnish_error *error) {
    burnish_bins bins;
    burnish_bins_begin(&bins);
    burnish_status status = BURNISH_STATUS_OK;
    do {
        status = burnish_bin_tiles(&bins, frame->geometry, frame->view, frame->threads, error);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        int tiles = bins.columns * (bins.end_row - bins.first_row);
#pragma omp parallel for num_threads(frame->threads) schedule(dynamic)
        for (int i = 0; i < tiles; ++i) {
            draw_tile(frame, &bins, &workers[thread_index()], i % bins.columns,
                      bins.first_row + i / bins.columns);
        }
    } while (bins.end_row < bins.rows);
    burnish_bins_destroy(&bins);
    return status;
}

/* Counts are sums and bounds extremes: their order does not matter. */
static void merge_counts(const tile_worker *workers, int threads, burnish_render_report *report) {
    for (int i = 0; i < threads; ++i) {
        const int *from = workers[i].bounds;
        int *to = report->bounds;
        if (workers[i].covered_pixels == 0) {
            continue;
        }
        if (report->covered_pixels == 0) {
            memcpy(to, from, sizeof report->bounds);
        }
        to[0] = from[0] < to[0] ? from[0] : to[0];
        to[1] = from[1] < to[1] ? from[1] : to[1];
        to[2] = from[2] > to[2] ? from[2] : to[2];
        to[3] = from[3] > to[3] ? from[3] : to[3];
        report->covered_pixels += workers[i].covered_pixels;
    }
}

burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_render_report *report,
                                  burnish_error *error) {
    tile_worker *workers;
    burnish_status status = burnish_allocate((void **)&workers, (size_t)frame->threads,
                                             sizeof *workers, "tiles", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    memset(workers, 0, (size_t)frame->threads * sizeof *workers);
    for (int i = 0; i < frame->threads && status == BURNISH_STATUS_OK; ++i) {
        workers[i].cache.material = -1;
        status = burnish_visibility_create(&workers[i].tile, frame->options->samples, error);
        workers[i].tile.needs_place = frame->shader->needs_place;
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw_bands(frame, workers, error);
    }
    if (status == BURNISH_STATUS_OK) {
        merge_counts(workers, frame->threads, report);
    }
    for (int i = 0; i < frame->threads; ++i) {
        burnish_visibility_destroy(&workers[i].tile);
    }
    free(workers);
    return status;
}
