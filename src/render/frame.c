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
} tile_worker;

static void add_fragments(const burnish_frame *frame, tile_worker *worker) {
    const burnish_fragments *fragments = &worker->fragments;
    for (int i = 0; i < fragments->count; ++i) {
        int pixel = fragments->pixel[i];
        float weight = (float)fragments->weight[i];
        for (int channel = 0; channel < 3; ++channel) {
            float value = worker->shaded.channel[channel][i];
            worker->sum[channel][pixel] += weight * (value < 1.0f ? value : 1.0f);
        }
        worker->covered[pixel] = (uint8_t)(worker->covered[pixel] + fragments->weight[i]);
        if (frame->drawn) {
            uint32_t source = frame->geometry->triangles[fragments->triangle[i]].source >> 1;
            __atomic_store_n(&frame->drawn[source], 1, __ATOMIC_RELAXED);
        }
    }
}

static void count_pixel(tile_worker *worker, int x, int y) {
    int *bounds = worker->bounds;
    if (worker->covered_pixels++ == 0) {
        bounds[0] = x;
        bounds[1] = y;
        bounds[2] = x + 1;
        bounds[3] = y + 1;
    }
    bounds[0] = x < bounds[0] ? x : bounds[0];
    bounds[1] = y < bounds[1] ? y : bounds[1];
    bounds[2] = x >= bounds[2] ? x + 1 : bounds[2];
    bounds[3] = y >= bounds[3] ? y + 1 : bounds[3];
}

/* Mixes a pixel with the background in linear light and encodes it. */
static void resolve_pixel(const burnish_frame *frame, const tile_worker *worker, int pixel,
                          uint8_t *out) {
    int samples = frame->options->samples, covered = worker->covered[pixel];
    const uint8_t *background = frame->options->background;
    if (covered == 0) {
        for (int channel = 0; channel < frame->image->channels; ++channel) {
            out[channel] = frame->options->transparent ? 0 : background[channel];
        }
        return;
    }
    float share = 1.0f / (float)(frame->options->transparent ? covered : samples);
    for (int channel = 0; channel < 3; ++channel) {
        float sum = worker->sum[channel][pixel];
        if (!frame->options->transparent) {
            float behind = burnish_srgb_to_linear[background[channel]];
            sum += (float)(samples - covered) * behind;
        }
        out[channel] = burnish_linear_to_srgb(sum * share);
    }
    if (frame->options->transparent) {
        out[3] = (uint8_t)((255 * covered + samples / 2) / samples);
    }
}

static void resolve_tile(const burnish_frame *frame, tile_worker *worker) {
    const burnish_visibility *tile = &worker->tile;
    size_t channels = (size_t)frame->image->channels;
    for (int y = 0; y < tile->height; ++y) {
        size_t first = (size_t)(tile->y + y) * (size_t)frame->image->width + (size_t)tile->x;
        uint8_t *out = frame->image->pixels + first * channels;
        for (int x = 0; x < tile->width; ++x, out += channels) {
            int pixel = y * BURNISH_TILE_SIZE + x;
            if (worker->covered[pixel]) {
                count_pixel(worker, tile->x + x, tile->y + y);
            }
            resolve_pixel(frame, worker, pixel, out);
        }
    }
}

static void draw_tile(const burnish_frame *frame, const burnish_bins *bins, tile_worker *worker,
                      int column, int row) {
    memset(worker->covered, 0, sizeof worker->covered);
    if (burnish_visibility_draw(&worker->tile, frame->visibility, frame->view, frame->geometry,
                                bins, column, row)) {
        memset(worker->sum, 0, sizeof worker->sum);
        while (burnish_visibility_next(&worker->tile, frame->view, &worker->fragments)) {
            burnish_shade(frame->shader, &worker->cache, &worker->fragments, &worker->shaded);
            add_fragments(frame, worker);
        }
    }
    resolve_tile(frame, worker);
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
