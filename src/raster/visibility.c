/* A tile from its lists of triangles to blocks of visible points; the drawing itself is in
 * visibility_body.h. */
#include "raster/visibility.h"

#include <string.h>

#include "base/memory.h"

/* No triangle is that far away. */
#define FARTHEST -1e30f

burnish_status burnish_visibility_create(burnish_visibility *visibility, int samples,
                                         burnish_error *error) {
    memset(visibility, 0, sizeof *visibility);
    visibility->samples = samples;
    visibility->triangle_capacity = (size_t)BURNISH_TILE_TRIANGLES * (size_t)samples;
    size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)samples;
    burnish_status status = burnish_allocate((void **)&visibility->owners, count,
                                             sizeof *visibility->owners, "a tile", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&visibility->depths, count, sizeof *visibility->depths,
                                  "a tile", error);
    }
    for (int k = 0; k < 2 && samples == 1 && status == BURNISH_STATUS_OK; ++k) {
        status = burnish_allocate((void **)&visibility->weights[k], count,
                                  sizeof *visibility->weights[k], "a tile", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&visibility->triangles, visibility->triangle_capacity,
                                  sizeof *visibility->triangles, "a tile's triangles", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&visibility->places, visibility->triangle_capacity,
                                  sizeof *visibility->places, "a tile's triangles", error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_visibility_destroy(visibility);
    }
    return status;
}

void burnish_visibility_destroy(burnish_visibility *visibility) {
    free(visibility->owners);
    free(visibility->depths);
    free(visibility->weights[0]);
    free(visibility->weights[1]);
    free(visibility->triangles);
    free(visibility->places);
    memset(visibility, 0, sizeof *visibility);
}

/* Samples own at most half of the triangles that the tile can remember, so that half are free
 * afterwards. Triangles keep their order. */
void burnish_visibility_compact(burnish_visibility *visibility) {
    const size_t samples = (size_t)BURNISH_TILE_PIXELS * (size_t)visibility->samples;
    burnish_tile_triangle *triangles = visibility->triangles;
    int32_t *places = visibility->places, kept = 0;
    memset(places, 0, visibility->triangle_count * sizeof *places);
    for (size_t i = 0; i < samples; ++i) {
        if (visibility->owners[i] >= 0) {
            places[visibility->owners[i]] = 1;
        }
    }
    for (size_t i = 0; i < visibility->triangle_count; ++i) {
        if (places[i]) {
            triangles[kept] = triangles[i];
            places[i] = kept++;
        }
    }
    for (size_t i = 0; i < samples; ++i) {
        if (visibility->owners[i] >= 0) {
            visibility->owners[i] = places[visibility->owners[i]];
        }
    }
    visibility->triangle_count = (size_t)kept;
}

/* The least depth of each block, over all samples. */
static void find_coarse(burnish_visibility *visibility) {
    float columns[BURNISH_TILE_SIZE];
    for (int block = 0; block < BURNISH_TILE_BLOCKS; ++block) {
        for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
            columns[x] = 1e30f;
        }
        for (int s = 0; s < visibility->samples; ++s) {
            const float *depths = visibility->depths + (size_t)s * BURNISH_TILE_PIXELS +
                                  (size_t)(block * BURNISH_TILE_BLOCK * BURNISH_TILE_SIZE);
            for (int y = 0; y < BURNISH_TILE_BLOCK; ++y, depths += BURNISH_TILE_SIZE) {
                for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
                    columns[x] = depths[x] < columns[x] ? depths[x] : columns[x];
                }
            }
        }
        for (int x = 0; x < BURNISH_TILE_BLOCKS; ++x) {
            float least = columns[x * BURNISH_TILE_BLOCK];
            for (int k = 1; k < BURNISH_TILE_BLOCK; ++k) {
                float depth = columns[x * BURNISH_TILE_BLOCK + k];
                least = depth < least ? depth : least;
            }
            visibility->coarse[block][x] = least;
        }
    }
}

int burnish_visibility_draw(burnish_visibility *visibility, burnish_visibility_function *draw,
                            const burnish_raster_view *view, const burnish_geometry *geometry,
                            const burnish_bins *bins, int column, int row) {
    size_t list = 2 * ((size_t)(row - bins->first_row) * (size_t)bins->columns + (size_t)column);
    const size_t *offsets = bins->offsets + list;
    visibility->x = column * BURNISH_TILE_SIZE;
    visibility->y = row * BURNISH_TILE_SIZE;
    int right = view->width - visibility->x, below = view->height - visibility->y;
    visibility->width = right < BURNISH_TILE_SIZE ? right : BURNISH_TILE_SIZE;
    visibility->height = below < BURNISH_TILE_SIZE ? below : BURNISH_TILE_SIZE;
    visibility->next_pixel = 0;
    visibility->triangle_count = 0;
    if (offsets[0] == offsets[2]) {
        return 0;
    }
    size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)visibility->samples;
    memset(visibility->owners, 0xff, count * sizeof *visibility->owners);
    for (size_t i = 0; i < count; ++i) {
        visibility->depths[i] = FARTHEST;
    }
    draw(visibility, geometry, bins->entries + offsets[0], offsets[1] - offsets[0], 0);
    if (offsets[1] < offsets[2]) {
        find_coarse(visibility);
        draw(visibility, geometry, bins->entries + offsets[1], offsets[2] - offsets[1], 1);
    }
    memset(visibility->places, 0, visibility->triangle_count * sizeof *visibility->places);
    return 1;
}

/* 1/256 pixel from the tile's edge to a pixel's centre. */
static int center_of(int pixel) {
    return pixel * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2;
}

/* Weights of a triangle's vertices 1 and 2 at (x, y) in 1/256 pixel from the tile's corner. */
static void weights_at(const burnish_tile_triangle *triangle, int x, int y, float *weight1,
                       float *weight2) {
    const int64_t edge1 = (int64_t)triangle->dx[0] * y - (int64_t)triangle->dy[0] * x;
    const int64_t edge2 = (int64_t)triangle->dx[1] * y - (int64_t)triangle->dy[1] * x;
    *weight1 = (float)(edge1 + triangle->constant[0]) * triangle->inverse_area;
    *weight2 = (float)(edge2 + triangle->constant[1]) * triangle->inverse_area;
}

static float depth_at(const burnish_tile_triangle *triangle, float weight1, float weight2) {
    return (triangle->depth[0] + weight1 * triangle->depth[1]) + weight2 * triangle->depth[2];
}

/* Appends the point at (x, y) in 1/256 pixel from the tile's corner. */
static void append_point(const burnish_visibility *visibility, const burnish_raster_view *view,
                         int pixel, int32_t owner, int weight, int x, int y,
                         burnish_fragments *fragments) {
    const burnish_tile_triangle *triangle = &visibility->triangles[owner];
    const int i = fragments->count++;
    float weight1, weight2;
    weights_at(triangle, x, y, &weight1, &weight2);
    visibility->places[owner] = 1;
    fragments->pixel[i] = (uint16_t)pixel;
    fragments->weight[i] = (uint8_t)weight;
    fragments->corners[i] = triangle->corners;
    fragments->weight1[i] = weight1;
    fragments->weight2[i] = weight2;
    if (visibility->needs_place) {
        x += visibility->x * BURNISH_SUBPIXELS - view->width * (BURNISH_SUBPIXELS / 2);
        y += visibility->y * BURNISH_SUBPIXELS - view->height * (BURNISH_SUBPIXELS / 2);
        fragments->x[i] = (float)x / BURNISH_SUBPIXELS;
        fragments->y[i] = (float)-y / BURNISH_SUBPIXELS;
        fragments->depth[i] = depth_at(triangle, weight1, weight2);
    }
}

/* sum / count, towards 0, for abs(sum) <= 4096 and count in [1, 16]: the factor is 65536 / count
 * rounded up, so that the product is too large by less than 1/16. */
static int mean_of(int sum, int count) {
    static const int32_t factors[BURNISH_MAX_SAMPLES + 1] = {
        0,    65536, 32768, 21846, 16384, 13108, 10923, 9363, 8192,
        7282, 6554,  5958,  5462,  5042,  4682,  4370,  4096};
    return sum < 0 ? -(-sum * factors[count] >> 16) : sum * factors[count] >> 16;
}

/* Groups a pixel's samples by triangle, in the order of each triangle's first sample. */
static void append_samples(const burnish_visibility *visibility, const burnish_raster_view *view,
                           int pixel, const int32_t *owners, burnish_fragments *fragments) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(visibility->samples);
    const int samples = visibility->samples, step = BURNISH_SUBPIXELS / 16;
    const int x = center_of(pixel % BURNISH_TILE_SIZE), y = center_of(pixel / BURNISH_TILE_SIZE);
    unsigned taken = 0;
    for (int s = 0; s < samples; ++s) {
        if ((taken >> s & 1) || owners[s] < 0) {
            continue;
        }
        int weight = 0, sum_x = 0, sum_y = 0;
        for (int other = s; other < samples; ++other) {
            if (owners[other] == owners[s]) {
                taken |= 1u << other;
                weight += 1;
                sum_x += offsets[other][0];
                sum_y += offsets[other][1];
            }
        }
        append_point(visibility, view, pixel, owners[s], weight, x + mean_of(sum_x * step, weight),
                     y + mean_of(sum_y * step, weight), fragments);
    }
}

/* Differences between the samples' owners of row y: 0 where one has them all. */
static void find_differences(const burnish_visibility *visibility, int y,
                             int32_t different[BURNISH_TILE_SIZE]) {
    const int32_t *first = visibility->owners + y * BURNISH_TILE_SIZE;
    memset(different, 0, BURNISH_TILE_SIZE * sizeof *different);
    for (int s = 1; s < visibility->samples; ++s) {
        const int32_t *owners = first + s * BURNISH_TILE_PIXELS;
        for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
            different[x] |= owners[x] ^ first[x];
        }
    }
}

int burnish_visibility_next(burnish_visibility *visibility, const burnish_raster_view *view,
                            burnish_fragments *fragments) {
    const int samples = visibility->samples;
    int32_t different[BURNISH_TILE_SIZE], owners[BURNISH_MAX_SAMPLES];
    int pixel = visibility->next_pixel, known = -1;
    fragments->count = 0;
    for (; samples > 1 && pixel < visibility->height * BURNISH_TILE_SIZE; ++pixel) {
        const int x = pixel % BURNISH_TILE_SIZE, y = pixel / BURNISH_TILE_SIZE;
        if (y != known) {
            find_differences(visibility, y, different);
            known = y;
        }
        if (x >= visibility->width || !different[x]) {
            continue;
        }
        if (fragments->count + samples > BURNISH_FRAGMENT_BLOCK) {
            break;
        }
        for (int s = 0; s < samples; ++s) {
            owners[s] = visibility->owners[s * BURNISH_TILE_PIXELS + pixel];
        }
        append_samples(visibility, view, pixel, owners, fragments);
    }
    visibility->next_pixel = pixel;
    return fragments->count > 0;
}

void burnish_visibility_row(const burnish_visibility *visibility, int y, burnish_whole_row *row) {
    const int first = y * BURNISH_TILE_SIZE;
    row->owners = visibility->owners + first;
    row->depths = visibility->depths + first;
    if (visibility->samples == 1) {
        row->weights[0] = visibility->weights[0] + first;
        row->weights[1] = visibility->weights[1] + first;
        return;
    }
    int32_t different[BURNISH_TILE_SIZE];
    find_differences(visibility, y, different);
    for (int x = 0; x < BURNISH_TILE_SIZE; ++x) {
        /* all ones where there is a difference */
        row->own_owners[x] =
            row->owners[x] | (different[x] | (int32_t)(0u - (uint32_t)different[x])) >> 31;
    }
    for (int x = 0; x < visibility->width; ++x) {
        if (row->own_owners[x] >= 0) {
            const burnish_tile_triangle *triangle = &visibility->triangles[row->own_owners[x]];
            float *weight1 = &row->own_weights[0][x], *weight2 = &row->own_weights[1][x];
            weights_at(triangle, center_of(x), center_of(y), weight1, weight2);
            row->own_depths[x] = depth_at(triangle, *weight1, *weight2);
        }
    }
    row->owners = row->own_owners;
    row->weights[0] = row->own_weights[0];
    row->weights[1] = row->own_weights[1];
    row->depths = row->own_depths;
}

void burnish_visibility_mark(const burnish_visibility *visibility, uint8_t *drawn) {
    for (size_t i = 0; i < visibility->triangle_count; ++i) {
        if (visibility->places[i]) {
            __atomic_store_n(&drawn[visibility->triangles[i].corners.source >> 1], 1,
                             __ATOMIC_RELAXED);
        }
    }
}
