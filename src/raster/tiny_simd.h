/* Drawing points, and tiny triangles: the pixels, or the samples, of as many as a vector has lanes at once;
 * then what they cover goes into the tile, one triangle after another. */
#ifndef BURNISH_RASTER_TINY_SIMD_H
#define BURNISH_RASTER_TINY_SIMD_H

#include "raster/points.h"
#include "raster/stamps_simd.h"

/* ---- One sample per pixel ---- */

/* The four pixels that triangles of at most 2 x 2 may cover. */
typedef struct tiny_pixels {
    unsigned covered[4];
    float depth[4][LANES];
    float planes[4][BURNISH_PLANE_COUNT][LANES];
} tiny_pixels;

/* Coverage, depth and attributes of the pixels of all tiny triangles; of others, anything. */
BURNISH_INLINE void compute_tiny(const triangle_setup *setup, int planes, tiny_pixels *pixels) {
    const vi wide = vi_sub(vi_load(setup->x1), vi_load(setup->x0));
    const vi high = vi_sub(vi_load(setup->y1), vi_load(setup->y0));
    const vf inverse_area = vf_load(setup->inverse_area);
    vi start[3], right[3], down[3];
    for (int i = 0; i < 3; ++i) {
        start[i] = vi_load(setup->start[i]);
        right[i] = vi_sub(vi_set(0), vi_shl(vi_load(setup->dy[i]), BURNISH_SUBPIXEL_BITS));
        down[i] = vi_shl(vi_load(setup->dx[i]), BURNISH_SUBPIXEL_BITS);
    }
    for (int c = 0; c < 4; ++c) {
        vi e[3], inside = vi_set(0);
        for (int i = 0; i < 3; ++i) {
            e[i] = c & 1 ? vi_add(start[i], right[i]) : start[i];
            e[i] = c & 2 ? vi_add(e[i], down[i]) : e[i];
            inside = vi_or(inside, e[i]);
        }
        inside = c & 1 ? vi_or(inside, vi_sub(wide, vi_set(1))) : inside;
        inside = c & 2 ? vi_or(inside, vi_sub(high, vi_set(1))) : inside;
        pixels->covered[c] = vm_bits(vi_not_negative(inside)) & setup->tiny;
        if (!pixels->covered[c]) {
            continue;
        }
        const vf depth[3] = {vf_load(setup->depth[0]), vf_load(setup->depth[1]),
                             vf_load(setup->depth[2])};
        vf weight1 = vf_mul(vf_from_int(vi_sub(e[1], vi_load(setup->bias[1]))), inverse_area);
        vf weight2 = vf_mul(vf_from_int(vi_sub(e[2], vi_load(setup->bias[2]))), inverse_area);
        vf weight0 = vf_sub(vf_sub(vf_set(1.0f), weight1), weight2);
        vf_store(pixels->depth[c], depth_from(depth, weight1, weight2));
        for (int k = 0; k < planes; ++k) {
            vf sum = vf_add(vf_mul(vf_load(setup->attributes[0][k]), weight0),
                            vf_mul(vf_load(setup->attributes[1][k]), weight1));
            sum = vf_add(sum, vf_mul(vf_load(setup->attributes[2][k]), weight2));
            vf_store(pixels->planes[c][k], sum);
        }
    }
}

/* Bit i to bit 4 i. */
BURNISH_INLINE uint64_t spread(unsigned bits) {
    uint64_t x = bits;
    x = (x | x << 24) & 0x000000ff000000ffull;
    x = (x | x << 12) & 0x000f000f000f000full;
    x = (x | x << 6) & 0x0303030303030303ull;
    return (x | x << 3) & 0x1111111111111111ull;
}

/* Draws covered pixels: bit 4 lane + c of `hits`. */
BURNISH_INLINE void draw_tiny(burnish_tile *tile, const triangle_setup *setup,
                              const tiny_pixels *pixels, uint64_t hits, int planes, int ids) {
    for (; hits; hits &= hits - 1) {
        const int hit = __builtin_ctzll(hits), lane = hit >> 2, c = hit & 3;
        const int x = setup->x0[lane] + (c & 1), y = setup->y0[lane] + (c >> 1);
        const int pixel = burnish_pixel_index(x, y);
        if (!(pixels->depth[c][lane] > tile->buffer.depths[pixel])) {
            continue;
        }
        tile->buffer.depths[pixel] = pixels->depth[c][lane];
        for (int k = 0; k < planes; ++k) {
            tile->buffer.planes[k][pixel] = pixels->planes[c][k][lane];
        }
        if (ids) {
            tile->buffer.ids[pixel] = (int32_t)setup->primitives.id_and_facing[lane];
        }
        mark_dirty(tile, pixel, 1);
    }
}

/* ---- Four samples per pixel ---- */

enum {
    TINY_SIDE = 3,
    TINY_PIXELS = TINY_SIDE * TINY_SIDE,
    TINY_SAMPLE_BITS = 2,
    TINY_SAMPLES = 1 << TINY_SAMPLE_BITS
};

/* The samples of the pixels that triangles of at most 3 x 3 may cover. Pixels count row after row
 * from (x0, y0); sample s of pixel p has number p * TINY_SAMPLES + s. */
typedef struct tiny_samples {
    uint32_t covered[TINY_SIDE][LANES]; /* of each row of pixels: bits */
    float depth[TINY_PIXELS * TINY_SAMPLES][LANES];
    int32_t index[TINY_PIXELS][LANES]; /* burnish_sample_index of sample 0 */
} tiny_samples;

/* Coverage and depth of the samples of pixel p. e are the edge functions at its centre; `there` is
 * negative where a triangle's bounds have no such pixel. Returns bits of its row. */
BURNISH_INLINE vi cover_tiny(const triangle_setup *setup, const sample_steps *steps, const vi e[3],
                             vi there, int p, tiny_samples *found) {
    const vf depth[3] = {vf_load(setup->depth[0]), vf_load(setup->depth[1]),
                         vf_load(setup->depth[2])};
    vi covered = vi_set(0);
    for (int s = 0; s < TINY_SAMPLES; ++s) {
        vi at[3], inside = there;
        for (int i = 0; i < 3; ++i) {
            at[i] = vi_add(e[i], vi_load(steps->step[i][s]));
            inside = vi_or(inside, at[i]);
        }
        const vm is_covered = vi_not_negative(inside);
        if (!(vm_bits(is_covered) & setup->live)) {
            continue;
        }
        const vf inverse_area = vf_load(setup->inverse_area);
        const vi e1 = vi_sub(at[1], vi_load(setup->bias[1]));
        const vi e2 = vi_sub(at[2], vi_load(setup->bias[2]));
        const vf weight1 = vf_mul(vf_from_int(e1), inverse_area);
        const vf weight2 = vf_mul(vf_from_int(e2), inverse_area);
        vf_store(found->depth[p * TINY_SAMPLES + s], depth_from(depth, weight1, weight2));
        const vi bit = vi_set(1 << (p % TINY_SIDE * TINY_SAMPLES + s));
        covered = vi_or(covered, vi_blend(is_covered, bit, vi_set(0)));
    }
    return covered;
}

/* burnish_sample_index of the pixels' samples 0. */
BURNISH_INLINE vi sample_indices(vi x, vi y) {
    const vi within = vi_set(BLOCK_MASK), blocks = vi_set(~BLOCK_MASK);
    const vi block =
        vi_or(vi_shl(vi_and(y, blocks), TILE_BITS), vi_shl(vi_and(x, blocks), BURNISH_BLOCK_BITS));
    const vi rest = vi_or(vi_shl(vi_and(y, within), BURNISH_BLOCK_BITS), vi_and(x, within));
    return vi_add(vi_shl(block, TINY_SAMPLE_BITS), rest);
}

/* The same of all pixels; the triangles that touch one touch at most 3 x 3. */
static void compute_tiny_samples(const triangle_setup *setup, const sample_steps *steps,
                                 tiny_samples *found) {
    const vi x0 = vi_load(setup->x0), y0 = vi_load(setup->y0);
    const vi wide = vi_sub(vi_load(setup->x1), x0), high = vi_sub(vi_load(setup->y1), y0);
    vi row[3];
    for (int i = 0; i < 3; ++i) {
        row[i] = vi_load(setup->start[i]);
    }
    for (int y = 0; y < TINY_SIDE; ++y) {
        const vi at_y = vi_add(y0, vi_set(y)), below = vi_sub(high, vi_set(y));
        vi e[3] = {row[0], row[1], row[2]}, covered = vi_set(0);
        for (int x = 0; x < TINY_SIDE; ++x) {
            const int p = y * TINY_SIDE + x;
            const vi there = vi_or(below, vi_sub(wide, vi_set(x)));
            if (vm_bits(vi_not_negative(there)) & setup->live) {
                vi_store(found->index[p], sample_indices(vi_add(x0, vi_set(x)), at_y));
                covered = vi_or(covered, cover_tiny(setup, steps, e, there, p, found));
            }
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_sub(e[i], vi_shl(vi_load(setup->dy[i]), BURNISH_SUBPIXEL_BITS));
            }
        }
        vi_store((int32_t *)found->covered[y], covered);
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], vi_shl(vi_load(setup->dx[i]), BURNISH_SUBPIXEL_BITS));
        }
    }
}

/* Stores the centre of pixel p, all of whose samples show the triangle. */
BURNISH_INLINE void draw_center(const burnish_tile *tile, const triangle_setup *setup, size_t lane,
                                int p, int planes) {
    const int x = p % TINY_SIDE, y = p / TINY_SIDE;
    const int pixel = burnish_pixel_index(setup->x0[lane] + x, setup->y0[lane] + y);
    float weight[3];
    for (int i = 1; i < 3; ++i) {
        const int32_t step = y * setup->dx[i][lane] - x * setup->dy[i][lane];
        const int32_t e = setup->start[i][lane] - setup->bias[i][lane] + step * BURNISH_SUBPIXELS;
        weight[i] = (float)e * setup->inverse_area[lane];
    }
    weight[0] = (1.0f - weight[1]) - weight[2];
    if (tile->options.needs_position) {
        tile->buffer.center_depths[pixel] =
            (setup->depth[0][lane] + weight[1] * setup->depth[1][lane]) +
            weight[2] * setup->depth[2][lane];
    }
    for (int k = 0; k < planes; ++k) {
        const float sum =
            setup->attributes[0][k][lane] * weight[0] + setup->attributes[1][k][lane] * weight[1];
        tile->buffer.planes[k][pixel] = sum + setup->attributes[2][k][lane] * weight[2];
    }
}

/* Draws the samples `covered` of a triangle; returns bits of the nearer ones. These are
 * unpredictable, so this code has no branch. */
BURNISH_INLINE uint64_t draw_covered(burnish_tile *tile, const tiny_samples *found, size_t lane,
                                     uint64_t covered, int32_t id) {
    float *depths = tile->buffer.depths;
    int32_t *ids = tile->buffer.ids;
    uint64_t drawn = 0;
    for (; covered; covered &= covered - 1) {
        const unsigned number = (unsigned)__builtin_ctzll(covered);
        const int at = found->index[number / TINY_SAMPLES][lane] +
                       (int)(number % TINY_SAMPLES) * BURNISH_BLOCK_PIXELS;
        const float depth = found->depth[number][lane], before = depths[at];
        const int is_nearer = depth > before;
        depths[at] = depth > before ? depth : before;
        ids[at] ^= (ids[at] ^ id) & -is_nearer;
        drawn |= (uint64_t)is_nearer << number;
        mark_dirty(tile, at / TINY_SAMPLES, is_nearer); /* a pixel of the same block */
    }
    return drawn;
}

/* Draws a group whose triangles are all tiny. */
static void draw_tiny_samples(burnish_tile *tile, const triangle_setup *setup,
                              const tiny_samples *found, int planes, const int32_t *ids) {
    enum { ROW = TINY_SIDE * TINY_SAMPLES };
    for (unsigned rest = setup->live; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        const uint64_t covered = found->covered[0][lane] |
                                 (uint64_t)found->covered[1][lane] << ROW |
                                 (uint64_t)found->covered[2][lane] << 2 * ROW;
        const uint64_t drawn = draw_covered(tile, found, lane, covered, ids[lane]);
        const uint64_t pairs = drawn & drawn >> 1;
        uint64_t whole = pairs & pairs >> 2 & 0x111111111ull; /* pixels all of whose samples are */
        for (; whole; whole &= whole - 1) {
            draw_center(tile, setup, lane, __builtin_ctzll(whole) / TINY_SAMPLES, planes);
        }
    }
}

/* ---- Points: discs have few pixels, so they are drawn one after another ---- */

/* A disc in the tile: coordinates count from the tile's corner. */
typedef struct tile_disc {
    uint32_t point;
    int32_t id; /* what samples that show it get */
    int32_t x, y, radius;
    float depth, rise; /* of the sphere's centre; of its nearest point minus that */
} tile_disc;

BURNISH_INLINE float depth_in_disc(const tile_disc *disc, int32_t x, int32_t y) {
    return disc->depth + disc->rise * burnish_disc_position_of(x, y, disc->radius).toward;
}

/* Stores the attributes of a pixel at its centre, all of whose samples show the disc. */
BURNISH_INLINE void shade_disc(const burnish_tile *tile, const burnish_point_view *points,
                               const tile_disc *disc, int32_t x, int32_t y, int pixel) {
    const int planes = tile->options.planes;
    if (tile->options.samples > 1 && tile->options.needs_position) {
        tile->buffer.center_depths[pixel] = depth_in_disc(disc, x, y);
    }
    if (planes == 0) {
        return;
    }
    const burnish_float4 attribute = tile->attributes[0][disc->point];
    const burnish_disc_position at = burnish_disc_position_of(x, y, disc->radius);
    const float own[3] = {attribute[0], attribute[1], attribute[2]};
    const float step = 1.0f / BURNISH_SUBPIXELS;
    const int32_t left = points->center[0] - tile->x * BURNISH_SUBPIXELS - disc->x;
    const int32_t above = points->center[1] - tile->y * BURNISH_SUBPIXELS - disc->y;
    float normal[3];
    burnish_point_normal(points, own, &at, (float)(x - left) * step, (float)(above - y) * step,
                         normal);
    const float scale = own[0] == 0 && own[1] == 0 && own[2] == 0 ? attribute[3] : 1.0f;
    for (int k = 0; k < 3; ++k) {
        tile->buffer.planes[BURNISH_PLANE_X + k][pixel] = normal[k] * scale;
    }
    if (planes > BURNISH_PLANE_W) {
        tile->buffer.planes[BURNISH_PLANE_W][pixel] = attribute[3];
    }
    for (int k = 0; planes > BURNISH_PLANE_R && k < 3; ++k) {
        tile->buffer.planes[BURNISH_PLANE_R + k][pixel] = tile->attributes[1][disc->point][k];
    }
}

/* Draws the samples of a pixel; x, y: of its centre from the disc's. */
BURNISH_INLINE void draw_disc_pixel(burnish_tile *tile, const burnish_point_view *points,
                                    const tile_disc *disc, int32_t x, int32_t y, int pixel) {
    const int samples = tile->options.samples;
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    const int64_t most = (int64_t)disc->radius * disc->radius;
    int drawn = 0;
    for (int s = 0; s < samples; ++s) {
        const int32_t u = x + offsets[s][0] * BURNISH_SAMPLE_STEP;
        const int32_t v = y + offsets[s][1] * BURNISH_SAMPLE_STEP;
        const int sample = burnish_sample_index(samples, pixel, s);
        if ((int64_t)u * u + (int64_t)v * v > most) {
            continue;
        }
        const float depth = depth_in_disc(disc, u, v);
        if (!(depth > tile->buffer.depths[sample])) {
            continue;
        }
        tile->buffer.depths[sample] = depth;
        if (samples > 1 || tile->options.keep_ids) {
            tile->buffer.ids[sample] = disc->id;
        }
        ++drawn;
    }
    if (drawn == samples) {
        shade_disc(tile, points, disc, x, y, pixel);
    }
    mark_dirty(tile, pixel, drawn > 0);
}

BURNISH_INLINE int clamp_pixel(int32_t position) {
    const int pixel = position >> BURNISH_SUBPIXEL_BITS;
    return pixel < 0 ? 0 : pixel >= BURNISH_TILE_SIZE ? BURNISH_TILE_SIZE - 1 : pixel;
}

static void draw_disc(burnish_tile *tile, const burnish_point_view *points, const tile_disc *disc) {
    const int x0 = clamp_pixel(disc->x - disc->radius), x1 = clamp_pixel(disc->x + disc->radius);
    const int y0 = clamp_pixel(disc->y - disc->radius), y1 = clamp_pixel(disc->y + disc->radius);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            draw_disc_pixel(tile, points, disc, x * BURNISH_SUBPIXELS + HALF_PIXEL - disc->x,
                            y * BURNISH_SUBPIXELS + HALF_PIXEL - disc->y,
                            burnish_pixel_index(x, y));
        }
    }
}

static void append_disc(burnish_tile_primitives *primitives, tile_disc *disc, uint32_t id) {
    const size_t at = primitives->count++;
    primitives->edges[at] = (burnish_primitive_edges){{disc->x, disc->y}, {disc->radius, 0}};
    primitives->weights[at] = (burnish_primitive_weights){{0, 0}, 0, 0};
    primitives->depths[at] = (burnish_primitive_depths){{disc->depth, disc->rise, 0}, 0};
    primitives->primitives[at] = (burnish_primitive){{disc->point, disc->point, disc->point}, id};
    disc->id = (int32_t)at;
}

static void draw_points(burnish_tile *tile, const burnish_geometry *geometry,
                        const uint32_t *indices, size_t count) {
    const burnish_point_view *points = &geometry->points;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t point = indices[i];
        const burnish_screen_vertex *v = &geometry->vertices.items[point];
        const burnish_disc size =
            burnish_disc_of(points, v->depth, geometry->vertices.inverse_w[point]);
        tile_disc disc = {point,
                          (int32_t)(point * 2),
                          v->x - tile->x * BURNISH_SUBPIXELS,
                          v->y - tile->y * BURNISH_SUBPIXELS,
                          size.radius,
                          v->depth,
                          size.nearest - v->depth};
        if (tile->options.samples > 1) {
            append_disc(&tile->primitives, &disc, point * 2);
        }
        draw_disc(tile, points, &disc);
    }
}

#endif
