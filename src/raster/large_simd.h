/* Drawing large triangles row by row of the tile, edge functions in double precision: exact. */
#ifndef BURNISH_RASTER_LARGE_SIMD_H
#define BURNISH_RASTER_LARGE_SIMD_H

#include "raster/setup_simd.h"

/* A row of a tile while a large triangle is drawn. */
typedef struct large_row {
    int x0, x1;
    /* edge function of pixel x: start + step x, without bias; covered where it is >= limit = -bias
     */
    double start[3], step[3], limit[3];
    int32_t nearer[BURNISH_TILE_SIZE], simple[BURNISH_TILE_SIZE]; /* masks */
    float before[BURNISH_TILE_SIZE], values[BURNISH_TILE_SIZE];
    float weight1[BURNISH_TILE_SIZE], weight2[BURNISH_TILE_SIZE];
} large_row;

/* Edge functions of row `line`, x and y in 1/256 pixel from a pixel's corner. Returns 0 when the
 * triangle does not cover the row. */
static int start_row(const triangle_setup *setup, size_t lane, int line, int64_t x, int64_t y,
                     large_row *row) {
    y += line * BURNISH_SUBPIXELS;
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1;
        int64_t e = setup->dx[i][lane] * (y - setup->y[a][lane]) -
                    setup->dy[i][lane] * (x - setup->x[a][lane]);
        int64_t along = -(int64_t)setup->dy[i][lane] * BURNISH_SUBPIXELS;
        int64_t at0 = e + along * row->x0, at1 = e + along * row->x1;
        if ((at0 > at1 ? at0 : at1) + setup->bias[i][lane] < 0) {
            return 0;
        }
        row->start[i] = (double)e;
        row->step[i] = (double)along;
        row->limit[i] = -setup->bias[i][lane];
    }
    return 1;
}

static void compute_weights(large_row *row, float inverse_area) {
    const double start1 = row->start[1], start2 = row->start[2];
    const double step1 = row->step[1], step2 = row->step[2];
    for (int x = row->x0; x <= row->x1; ++x) {
        row->weight1[x] = (float)(start1 + step1 * x) * inverse_area;
        row->weight2[x] = (float)(start2 + step2 * x) * inverse_area;
    }
}

/* Copies a row of pixels out of blocks that lie `stride` numbers apart. */
static void load_row(const float *from, int stride, int x0, int x1, float *to) {
    enum { SIZE = BURNISH_BLOCK_SIZE };
    for (int block = x0 / SIZE; block <= x1 / SIZE; ++block) {
        memcpy(to + SIZE * block, from + block * stride, SIZE * sizeof *to);
    }
}

/* And back where the mask holds. */
static void store_row(const float *from, const int32_t *mask, int stride, int x0, int x1,
                      float *to) {
    enum { SIZE = BURNISH_BLOCK_SIZE };
    for (int x = x0; x <= x1; ++x) {
        float *kept = to + x / SIZE * stride + x % SIZE;
        if (x % SIZE == 0 && x + 3 <= x1 && (mask[x] & mask[x + 1] & mask[x + 2] & mask[x + 3])) {
            memcpy(kept, from + x, SIZE * sizeof *kept); /* most are */
            x += SIZE - 1;
        } else {
            *kept = mask[x] ? from[x] : *kept;
        }
    }
}

/* Draws one sample of a row's pixels; `sample` is the index of the first pixel's. Returns whether
 * any was nearer. */
static int draw_row(const burnish_tile *tile, const triangle_setup *setup, size_t lane, int ids,
                    int32_t id, int sample, large_row *row) {
    const double start0 = row->start[0], step0 = row->step[0];
    const double start1 = row->start[1], step1 = row->step[1];
    const double start2 = row->start[2], step2 = row->step[2];
    const float depth0 = setup->depth[0][lane], depth1 = setup->depth[1][lane],
                depth2 = setup->depth[2][lane];
    const int stride = BURNISH_BLOCK_PIXELS * tile->options.samples;
    int32_t drawn = 0;
    compute_weights(row, setup->inverse_area[lane]);
    load_row(tile->buffer.depths + sample, stride, row->x0, row->x1, row->before);
    for (int x = row->x0; x <= row->x1; ++x) {
        const float depth = (depth0 + row->weight1[x] * depth1) + row->weight2[x] * depth2;
        row->nearer[x] = (start0 + step0 * x >= row->limit[0]) &
                         (start1 + step1 * x >= row->limit[1]) &
                         (start2 + step2 * x >= row->limit[2]) & (depth > row->before[x]);
        row->values[x] = depth;
        row->simple[x] &= row->nearer[x];
        drawn |= row->nearer[x];
    }
    if (drawn) {
        store_row(row->values, row->nearer, stride, row->x0, row->x1, tile->buffer.depths + sample);
        for (int x = row->x0; x <= row->x1 && ids; ++x) {
            int32_t *kept = tile->buffer.ids + sample + x / BURNISH_BLOCK_SIZE * stride +
                            x % BURNISH_BLOCK_SIZE;
            *kept = row->nearer[x] ? id : *kept;
        }
    }
    return drawn;
}

/* Interpolates the attributes of a row's simple pixels. */
static void interpolate_row(const burnish_tile *tile, const triangle_setup *setup, size_t lane,
                            int pixel, large_row *row) {
    const int samples = tile->options.samples;
    if (samples > 1 && tile->options.needs_position) {
        for (int x = row->x0; x <= row->x1; ++x) {
            row->values[x] = (setup->depth[0][lane] + row->weight1[x] * setup->depth[1][lane]) +
                             row->weight2[x] * setup->depth[2][lane];
        }
        store_row(row->values, row->simple, BURNISH_BLOCK_PIXELS, row->x0, row->x1,
                  tile->buffer.center_depths + pixel);
    }
    for (int k = 0; k < tile->options.planes; ++k) {
        const float a = setup->attributes[0][k][lane], b = setup->attributes[1][k][lane],
                    c = setup->attributes[2][k][lane];
        for (int x = row->x0; x <= row->x1; ++x) {
            const float weight0 = (1.0f - row->weight1[x]) - row->weight2[x];
            row->values[x] = (a * weight0 + b * row->weight1[x]) + c * row->weight2[x];
        }
        store_row(row->values, row->simple, BURNISH_BLOCK_PIXELS, row->x0, row->x1,
                  tile->buffer.planes[k] + pixel);
    }
}

static void mark_row_dirty(burnish_tile *tile, const large_row *row, int line) {
    unsigned dirty_blocks = 0;
    for (int x = row->x0; x <= row->x1; ++x) {
        dirty_blocks |= (unsigned)(row->nearer[x] != 0) << x / BURNISH_BLOCK_SIZE;
    }
    tile->buffer.dirty_blocks[line / BURNISH_BLOCK_SIZE] |= (uint16_t)dirty_blocks;
}

/* Draws a triangle of any size: its edge functions are below 2^49. Returns whether a sample was
 * nearer. */
static int draw_large(burnish_tile *tile, triangle_setup *setup, size_t lane, int ids, int32_t id,
                      const int8_t (*offsets)[2]) {
    const int64_t area = (int64_t)setup->dx[2][lane] * setup->dy[0][lane] -
                         (int64_t)setup->dy[2][lane] * setup->dx[0][lane];
    const int samples = tile->options.samples;
    int drawn = 0;
    large_row row = {.x0 = setup->x0[lane], .x1 = setup->x1[lane]};
    setup->inverse_area[lane] = 1.0f / (float)area;
    for (int line = setup->y0[lane]; line <= setup->y1[lane]; ++line) {
        const int pixel = burnish_pixel_index(0, line);
        int simple = 1;
        memset(row.simple, 0xff, sizeof row.simple);
        for (int s = 0; s < samples; ++s) {
            if (!start_row(setup, lane, line, HALF_PIXEL + offsets[s][0] * BURNISH_SAMPLE_STEP,
                           HALF_PIXEL + offsets[s][1] * BURNISH_SAMPLE_STEP, &row)) {
                simple = 0;
                continue;
            }
            const int hit =
                draw_row(tile, setup, lane, ids, id, burnish_sample_index(samples, pixel, s), &row);
            if (hit) {
                mark_row_dirty(tile, &row, line);
            }
            simple &= hit;
            drawn |= hit;
        }
        if (simple) {
            if (samples > 1) {
                start_row(setup, lane, line, HALF_PIXEL, HALF_PIXEL, &row);
                compute_weights(&row, setup->inverse_area[lane]);
            }
            interpolate_row(tile, setup, lane, pixel, &row);
        }
    }
    return drawn;
}

#endif
