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
    burnish_row row; /* with one sample a pixel */
} tile_worker;

/* A point that has its pixel to itself is stored, others are added up. */
static void add_fragments(tile_worker *worker, int samples) {
    const burnish_fragments *fragments = &worker->fragments;
    const float all = (float)samples;
    for (int i = 0; i < fragments->count; ++i) {
        const int pixel = fragments->pixel[i];
        const int whole = fragments->weight[i] == samples;
        const float weight = whole ? all : (float)fragments->weight[i];
        for (int channel = 0; channel < 3; ++channel) {
            float value = worker->shaded.channel[channel][i];
            float *sum = &worker->sum[channel][pixel];
            value = weight * (value < 1.0f ? value : 1.0f);
            *sum = whole ? value : *sum + value;
        }
        worker->covered[pixel] =
            (uint8_t)(whole ? samples : worker->covered[pixel] + fragments->weight[i]);
    }
}

/* Adds a row of the tile to the counts. */
static void count_row(tile_worker *worker, int y) {
    const burnish_visibility *tile = &worker->tile;
    const uint8_t *covered = worker->covered + y * BURNISH_TILE_SIZE;
    int count = 0, first = tile->width, end = 0;
    for (int x = 0; x < tile->width; ++x) {
        count += covered[x] != 0;
    }
    if (count == 0) {
        return;
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
}

/* A row mixed with the background in linear light, and encoded. Where nothing is covered the
 * background comes back: coding its linear value gives its code. */
static void resolve_row(const burnish_frame *frame, const tile_worker *worker, int y,
                        uint8_t *out) {
    const int first = y * BURNISH_TILE_SIZE, samples = frame->options->samples;
    const uint8_t *covered = worker->covered + first;
    const float share = 1.0f / (float)samples; /* a power of two */
    float rgb[3][BURNISH_TILE_SIZE];
    uint8_t pixels[4 * BURNISH_TILE_SIZE];
    for (int channel = 0; channel < 3; ++channel) {
        const float behind = burnish_srgb_to_linear[frame->options->background[channel]];
        const float *sum = worker->sum[channel] + first;
        for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
            rgb[channel][x] = (sum[x] + (float)(samples - covered[x]) * behind) * share;
        }
    }
    const float *const rows[3] = {rgb[0], rgb[1], rgb[2]};
    frame->encode(frame->encoder, BURNISH_TILE_SIZE, rows, pixels);
    for (int x = 0; x < worker->tile.width; ++x) {
        memcpy(out + 3 * x, pixels + 4 * x, 3);
    }
}

/* The same with alpha: the colour is that of the covered samples alone. */
static void resolve_row_transparent(const burnish_frame *frame, const tile_worker *worker, int y,
                                    uint8_t *out) {
    const int samples = frame->options->samples;
    for (int x = 0; x < worker->tile.width; ++x, out += 4) {
        const int pixel = y * BURNISH_TILE_SIZE + x, covered = worker->covered[pixel];
        memset(out, 0, 4);
        if (covered) {
            const float share = 1.0f / (float)covered;
            for (int channel = 0; channel < 3; ++channel) {
                out[channel] = burnish_linear_to_srgb(worker->sum[channel][pixel] * share);
            }
            out[3] = (uint8_t)((255 * covered + samples / 2) / samples);
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

static void resolve_tile(const burnish_frame *frame, tile_worker *worker, int has_points) {
    const burnish_visibility *tile = &worker->tile;
    const size_t channels = (size_t)frame->image->channels;
    for (int y = 0; y < tile->height; ++y) {
        size_t first = (size_t)(tile->y + y) * (size_t)frame->image->width + (size_t)tile->x;
        uint8_t *out = frame->image->pixels + first * channels;
        if (!has_points) {
            fill_row(frame, tile->width, out);
            continue;
        }
        count_row(worker, y);
        if (frame->options->transparent) {
            resolve_row_transparent(frame, worker, y, out);
        } else {
            resolve_row(frame, worker, y, out);
        }
    }
}

/* One sample a pixel: rows go from owners to codes without sums. */
static void finish_row(const burnish_frame *frame, tile_worker *worker, int y, uint8_t *out) {
    const burnish_visibility *tile = &worker->tile;
    const int32_t *owners = tile->owners + y * BURNISH_TILE_SIZE;
    uint8_t *covered = worker->covered + y * BURNISH_TILE_SIZE;
    const int transparent = frame->options->transparent;
    uint8_t pixels[4 * BURNISH_TILE_SIZE];
    float rgb[3][BURNISH_TILE_SIZE];
    if (!burnish_shade_row(frame->shader, &worker->cache, tile, frame->view, y, &worker->row)) {
        fill_row(frame, tile->width, out);
        return;
    }
    for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
        covered[x] = owners[x] >= 0;
    }
    count_row(worker, y);
    for (int channel = 0; channel < 3; ++channel) {
        const float behind =
            transparent ? 0.0f : burnish_srgb_to_linear[frame->options->background[channel]];
        const float *light = worker->row.rgb[channel];
        for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
            const float value = light[x] < 1.0f ? light[x] : 1.0f;
            rgb[channel][x] = owners[x] >= 0 ? value : behind;
        }
    }
    const float *const rows[3] = {rgb[0], rgb[1], rgb[2]};
    frame->encode(frame->encoder, BURNISH_TILE_SIZE, rows, pixels);
    if (transparent) {
        for (int x = 0; x < tile->width; ++x) {
            pixels[4 * x + 3] = covered[x] ? 255 : 0;
        }
        memcpy(out, pixels, 4 * (size_t)tile->width);
        return;
    }
    for (int x = 0; x < tile->width; ++x) {
        memcpy(out + 3 * x, pixels + 4 * x, 3);
    }
}

static void finish_tile(const burnish_frame *frame, tile_worker *worker) {
    const burnish_visibility *tile = &worker->tile;
    const size_t channels = (size_t)frame->image->channels;
    for (int y = 0; y < tile->height; ++y) {
        size_t first = (size_t)(tile->y + y) * (size_t)frame->image->width + (size_t)tile->x;
        finish_row(frame, worker, y, frame->image->pixels + first * channels);
    }
}

static void shade_samples(const burnish_frame *frame, tile_worker *worker) {
    int has_points = 0;
    while (burnish_visibility_next(&worker->tile, frame->view, &worker->fragments)) {
        if (!has_points) {
            memset(worker->sum, 0, sizeof worker->sum);
            memset(worker->covered, 0, sizeof worker->covered);
            has_points = 1;
        }
        burnish_shade(frame->shader, &worker->cache, &worker->fragments, &worker->shaded);
        add_fragments(worker, frame->options->samples);
    }
    resolve_tile(frame, worker, has_points);
}

static void draw_tile(const burnish_frame *frame, const burnish_bins *bins, tile_worker *worker,
                      int column, int row) {
    if (!burnish_visibility_draw(&worker->tile, frame->visibility, frame->view, frame->geometry,
                                 bins, column, row)) {
        resolve_tile(frame, worker, 0);
        return;
    }
    if (frame->options->samples == 1) {
        finish_tile(frame, worker);
    } else {
        shade_samples(frame, worker);
    }
    if (frame->drawn) {
        burnish_visibility_mark(&worker->tile, frame->drawn);
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
