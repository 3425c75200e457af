/* A tile from its lists of triangles to whole pixels and blocks of visible points; the drawing
 * itself is in visibility_body.h. */
#include "raster/visibility.h"

#include <string.h>

#include "base/memory.h"
#include "raster/tier.h"

static burnish_status allocate_floats(float **array, size_t count, burnish_error *error) {
    burnish_status status =
        burnish_allocate((void **)array, count, sizeof **array, "a tile", error);
    if (status == BURNISH_STATUS_OK) {
        memset(*array, 0, count * sizeof **array); /* what no triangle covers may be shaded too */
    }
    return status;
}

/* The table of offset_sums. */
static void add_offsets(burnish_visibility *visibility) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(visibility->options.samples);
    for (int s = 0; s < visibility->options.samples; ++s) {
        for (int bits = 0; bits < 256; ++bits) {
            int8_t *sum = visibility->offset_sums[s / 8][bits];
            sum[0] = (int8_t)(sum[0] + (bits >> s % 8 & 1) * offsets[s][0]);
            sum[1] = (int8_t)(sum[1] + (bits >> s % 8 & 1) * offsets[s][1]);
        }
    }
}

burnish_status burnish_visibility_create(burnish_visibility *visibility,
                                         const burnish_visibility_options *options,
                                         burnish_error *error) {
    const int samples = options->samples;
    const size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)samples;
    memset(visibility, 0, sizeof *visibility);
    visibility->options = *options;
    burnish_status status = allocate_floats(&visibility->depths, count, error);
    for (int k = 0; k < options->planes && status == BURNISH_STATUS_OK; ++k) {
        status = allocate_floats(&visibility->planes[k], BURNISH_TILE_PIXELS, error);
    }
    if (samples == 1) {
        visibility->center_depths = visibility->depths;
    } else if (status == BURNISH_STATUS_OK) {
        status = allocate_floats(&visibility->center_depths, BURNISH_TILE_PIXELS, error);
    }
    if (status == BURNISH_STATUS_OK && (samples > 1 || options->keep_owners)) {
        status = burnish_allocate((void **)&visibility->owners, count, sizeof *visibility->owners,
                                  "a tile", error);
    }
    if (status == BURNISH_STATUS_OK && samples > 1) {
        add_offsets(visibility);
        visibility->triangle_capacity = (size_t)BURNISH_TILE_TRIANGLES * (size_t)samples;
        status = burnish_allocate((void **)&visibility->triangles, visibility->triangle_capacity,
                                  sizeof *visibility->triangles, "a tile's triangles", error);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_allocate((void **)&visibility->places, visibility->triangle_capacity,
                                      sizeof *visibility->places, "a tile's triangles", error);
        }
    }
    return status;
}

void burnish_visibility_destroy(burnish_visibility *visibility) {
    if (visibility->center_depths != visibility->depths) {
        free(visibility->center_depths);
    }
    free(visibility->depths);
    for (int k = 0; k < BURNISH_PLANE_COUNT; ++k) {
        free(visibility->planes[k]);
    }
    free(visibility->owners);
    free(visibility->triangles);
    free(visibility->places);
    memset(visibility, 0, sizeof *visibility);
}

/* Samples own at most half of the triangles that the tile can remember, so that half are free
 * afterwards. Triangles keep their order. */
void burnish_visibility_compact(burnish_visibility *visibility) {
    const size_t samples = (size_t)BURNISH_TILE_PIXELS * (size_t)visibility->options.samples;
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

/* Finds the coarse depth. */
static void find_coarse(burnish_visibility *visibility, const burnish_raster_tier *tier) {
    enum { LAST = BURNISH_TILE_BLOCKS - 1 };
    tier->find_least(visibility);
    for (int y = 0; y <= LAST; ++y) {
        const float *row = visibility->coarse[0][y],
                    *below = visibility->coarse[0][y < LAST ? y + 1 : y];
        for (int x = 0; x <= LAST; ++x) {
            const int next = x < LAST ? x + 1 : x;
            const float first = row[x] < row[next] ? row[x] : row[next];
            const float second = below[x] < below[next] ? below[x] : below[next];
            visibility->coarse[1][y][x] = first < second ? first : second;
        }
    }
}

enum {
    LIST_PART = 128, /* entries read at once */
    /* triangles drawn before the coarse depth is found again: as much work as a few of them */
    COARSE_AGE = 2048
};

/* The slots of some entries; returns how many. */
static size_t find_slots(const burnish_list_entry *entries, size_t count, uint32_t *slots) {
    size_t found = 0;
    for (size_t i = 0; i < count; ++i) {
        for (unsigned rest = entries[i].lanes; rest; rest &= rest - 1) {
            slots[found++] = entries[i].block * BURNISH_SETUP_BLOCK + (uint32_t)__builtin_ctz(rest);
        }
    }
    return found;
}

/* Draws a list. Those triangles that the coarse depth hides are left out; before any is drawn, if
 * `is_behind` others. */
static void draw_list(burnish_visibility *visibility, const burnish_raster_tier *tier,
                      const burnish_geometry *geometry, burnish_list_reader reader, unsigned back,
                      int is_behind) {
    burnish_list_entry part[LIST_PART];
    uint32_t slots[LIST_PART * BURNISH_SETUP_BLOCK];
    size_t age = is_behind ? COARSE_AGE : 0, count;
    int is_coarse = 0;
    while ((count = burnish_list_read(&reader, part, LIST_PART)) > 0) {
        if (age >= COARSE_AGE) {
            find_coarse(visibility, tier);
            is_coarse = 1;
            age = 0;
        }
        if (is_coarse) {
            count = tier->find_seen(visibility, geometry, part, count);
        }
        count = find_slots(part, count, slots);
        tier->draw(visibility, geometry, slots, count, back);
        age += count;
    }
}

/* Vectors may have drawn beyond the image's right and lower edge. */
static void clear_outside(burnish_visibility *visibility) {
    const int samples = visibility->options.samples;
    for (int place = 0; place < BURNISH_TILE_PIXELS; ++place) {
        if (burnish_place_x(place) < visibility->width &&
            burnish_place_y(place) < visibility->height) {
            continue;
        }
        for (int s = 0; s < samples; ++s) {
            const int sample = burnish_sample_place(samples, place, s);
            visibility->depths[sample] = BURNISH_FARTHEST;
            if (samples > 1) {
                visibility->owners[sample] = -1;
            }
        }
    }
}

int burnish_visibility_draw(burnish_visibility *visibility, const burnish_raster_tier *tier,
                            const burnish_raster_view *view, const burnish_geometry *geometry,
                            const burnish_bins *bins, int column, int row) {
    const burnish_list_reader fronts = burnish_list_begin(bins, column, row, 0);
    const burnish_list_reader backs = burnish_list_begin(bins, column, row, 1);
    visibility->x = column * BURNISH_TILE_SIZE;
    visibility->y = row * BURNISH_TILE_SIZE;
    int right = view->width - visibility->x, below = view->height - visibility->y;
    visibility->width = right < BURNISH_TILE_SIZE ? right : BURNISH_TILE_SIZE;
    visibility->height = below < BURNISH_TILE_SIZE ? below : BURNISH_TILE_SIZE;
    visibility->next_block = 0;
    visibility->tier = tier;
    visibility->triangle_count = 0;
    if (burnish_list_is_empty(fronts) && burnish_list_is_empty(backs)) {
        return 0;
    }
    const size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)visibility->options.samples;
    for (size_t i = 0; i < count; ++i) {
        visibility->depths[i] = BURNISH_FARTHEST;
    }
    if (visibility->options.samples > 1) {
        memset(visibility->owners, 0xff, count * sizeof *visibility->owners);
    }
    memset(visibility->touched, 0, sizeof visibility->touched);
    draw_list(visibility, tier, geometry, fronts, 0, 0);
    draw_list(visibility, tier, geometry, backs, 1, !burnish_list_is_empty(fronts));
    if (visibility->width % BURNISH_BLOCK_SIZE || visibility->height % BURNISH_BLOCK_SIZE) {
        clear_outside(visibility);
    }
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
                         int place, int32_t owner, int weight, int x, int y,
                         burnish_fragments *fragments) {
    const burnish_tile_triangle *triangle = &visibility->triangles[owner];
    const int i = fragments->count++;
    float weight1, weight2;
    weights_at(triangle, x, y, &weight1, &weight2);
    fragments->place[i] = (uint16_t)place;
    fragments->weight[i] = (uint8_t)weight;
    fragments->corners[i] = triangle->corners;
    fragments->weight1[i] = weight1;
    fragments->weight2[i] = weight2;
    if (visibility->options.needs_place) {
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

/* The point of some samples of a pixel that show one triangle. */
static void append_samples(const burnish_visibility *visibility, const burnish_raster_view *view,
                           int place, unsigned samples, int32_t owner,
                           burnish_fragments *fragments) {
    const int step = BURNISH_SUBPIXELS / 16, weight = __builtin_popcount(samples);
    const int8_t *first = visibility->offset_sums[0][samples & 255],
                 *last = visibility->offset_sums[1][samples >> 8];
    const int x = mean_of((first[0] + last[0]) * step, weight);
    const int y = mean_of((first[1] + last[1]) * step, weight);
    append_point(visibility, view, place, owner, weight, center_of(burnish_place_x(place)) + x,
                 center_of(burnish_place_y(place)) + y, fragments);
}

int burnish_visibility_next(burnish_visibility *visibility, const burnish_raster_view *view,
                            burnish_fragments *fragments) {
    burnish_shared_points points;
    int block = visibility->next_block;
    fragments->count = 0;
    for (; visibility->options.samples > 1 && block < BURNISH_TILE_PIXELS / BURNISH_BLOCK_PIXELS;
         ++block) {
        if (!(visibility->touched[block / BURNISH_TILE_STRIPS] >> block % BURNISH_TILE_STRIPS &
              1)) {
            continue;
        }
        visibility->tier->find_shared(visibility, block, &points);
        if (fragments->count + points.count > BURNISH_FRAGMENT_BLOCK) {
            break;
        }
        for (int i = 0; i < points.count; ++i) {
            append_samples(visibility, view, block * BURNISH_BLOCK_PIXELS + points.pixel[i],
                           points.samples[i], points.owner[i], fragments);
        }
    }
    visibility->next_block = block;
    return fragments->count > 0;
}
