/* Triangle setup with SIMD: one triangle per lane.
 *
 * Edge functions are whole numbers and exact. Small triangles are drawn stamp by stamp, weights
 * from their edges (stamps_simd.h), or several at once (tiny_simd.h); large ones cell by cell, by
 * planes (large_simd.h); points as discs (discs_simd.h). Operations have the order of
 * test/support/reference_tile.h. */
#ifndef BURNISH_RASTER_SETUP_SIMD_H
#define BURNISH_RASTER_SETUP_SIMD_H

#include "raster/geometry_simd.h"
#include "raster/tile.h"

enum { HALF_PIXEL = BURNISH_SUBPIXELS / 2, TILE_BITS = 6, BLOCK_MASK = BURNISH_BLOCK_SIZE - 1 };
_Static_assert(1 << TILE_BITS == BURNISH_TILE_SIZE, "a tile's edge");

/* A stamp: the pixels of a block that are one vector: 4 x 4, 4 x 2, 4 x 1 or one. */
enum {
    STAMP_WIDTH = LANES >= 4 ? 4 : 1,
    STAMP_HEIGHT = LANES / STAMP_WIDTH,
    STAMP_HEIGHT_BITS = STAMP_HEIGHT == 4   ? 2
                        : STAMP_HEIGHT == 2 ? 1
                                            : 0,
    STAMP_SIDE = 4 /* at most so many stamps across and down has a triangle that is queued */
};

/* As many primitives as a vector has lanes. */
typedef struct primitive_group {
    uint32_t vertices[3][LANES], id_and_facing[LANES];
} primitive_group;

/* As many triangles as a vector has lanes. Coordinates are 1/256 pixel from the tile's corner. The
 * edge function of edge i, opposite vertex i, which runs from vertex a = i + 1 to b = i + 2 (mod
 * 3): E(x, y) = dx (y - y_a) - dy (x - x_a) + bias,   dx = x_b - x_a, dy = y_b - y_a A point is
 * covered where all three are >= 0. E - bias is twice the area of the triangle of the point and the
 * edge; over the triangle's own it is the barycentric weight of vertex i. */
typedef struct triangle_setup {
    int32_t x[3][LANES], y[3][LANES];   /* vertices */
    int32_t dx[3][LANES], dy[3][LANES]; /* of the edges */
    int32_t bias[3][LANES];             /* -1 where the top-left rule excludes the edge, else 0 */
    int32_t start[3][LANES];            /* E at the centre of pixel (x0, y0) */
    int32_t stamp[3][LANES];            /* E at the centre of the first pixel of its stamp */
    int32_t slope[3][LANES]; /* -dy, dx packed: E(x + u, y + v) = E(x, y) + slope . (u, v) */
    int32_t x0[LANES], y0[LANES], x1[LANES], y1[LANES]; /* pixels that the bounds touch, x1 and y1
                                                           inclusive */
    float depth[3][LANES];                              /* of vertex 0; of 1 and 2 minus that */
    int32_t longest[LANES];                             /* edge, along an axis */
    float inverse_area[LANES]; /* of triangles whose edge functions fit 32 bits */
    float attributes[3][BURNISH_PLANE_COUNT][LANES];
    primitive_group primitives;
    const struct large_group *large; /* of triangles that are live and not small */
    /* bits: touch a pixel; are drawn by stamps; have edge functions of more than 32 bits; touch at
     * most 2 x 2 pixels, 3 x 3; touch too many stamps to be queued */
    unsigned live, small, beyond, tiny, tiny_3x3, wide;
} triangle_setup;

/* The primitives of some indices, `count` <= LANES. Prefetches their data: lists have the order of
 * the mesh, not of memory. */
BURNISH_INLINE void fetch_group(const burnish_tile *tile, const burnish_geometry *geometry,
                                const uint32_t *indices, size_t count, unsigned back,
                                primitive_group *group) {
    for (size_t lane = 0; lane < LANES && count > 0; ++lane) {
        const burnish_primitive found =
            burnish_geometry_primitive(geometry, indices[lane < count ? lane : 0], back);
        group->id_and_facing[lane] = found.id_and_facing;
        for (int i = 0; i < 3; ++i) {
            const size_t vertex = found.vertices[i];
            group->vertices[i][lane] = found.vertices[i];
            __builtin_prefetch(&geometry->vertices.items[vertex]);
            if (tile->options.planes > 0) {
                __builtin_prefetch(&tile->attributes[0][vertex]);
            }
        }
    }
}

/* Loads vertices and attributes of a group. */
BURNISH_INLINE void load_group(const burnish_tile *tile, const burnish_geometry *geometry,
                               triangle_setup *setup, vi x[3], vi y[3], vf depth[3]) {
    const primitive_group *group = &setup->primitives;
    /* 1 for front-facing triangles, -1 for back-facing ones: exact */
    const vi sign = vi_shl(vi_load((const int32_t *)group->id_and_facing), 31);
    const vf turn = vf_from_bits(vi_or(sign, vf_bits(vf_set(1.0f))));
    for (int i = 0; i < 3; ++i) {
        const void *from[LANES];
        vf at[4];
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = &geometry->vertices.items[group->vertices[i][lane]];
        }
        vf_load_aos4(from, at);
        x[i] = vi_sub(vf_bits(at[0]), vi_set(tile->x * BURNISH_SUBPIXELS));
        y[i] = vi_sub(vf_bits(at[1]), vi_set(tile->y * BURNISH_SUBPIXELS));
        depth[i] = at[2];
        if (tile->options.planes == 0) {
            continue;
        }
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = &tile->attributes[0][group->vertices[i][lane]];
        }
        vf_load_aos4(from, at);
        for (int k = 0; k < 3; ++k) {
            vf_store(setup->attributes[i][k], vf_mul(at[k], turn));
        }
        vf_store(setup->attributes[i][BURNISH_PLANE_W], at[3]);
        if (tile->options.planes <= BURNISH_PLANE_R) {
            continue;
        }
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = &tile->attributes[1][group->vertices[i][lane]];
        }
        vf_load_aos4(from, at);
        for (int k = 0; k < 3; ++k) {
            vf_store(setup->attributes[i][BURNISH_PLANE_R + k], at[k]);
        }
    }
}

/* Triangle setup: bounds, edges, depth. 32-bit numbers of large triangles wrap round and are not
 * used. */
BURNISH_INLINE void compute_setup(const burnish_tile *tile, size_t count, const vi x[3],
                                  const vi y[3], const vf depth[3], triangle_setup *setup) {
    const int samples = tile->options.samples;
    vi dx[3], dy[3], x0, y0, x1, y1, longest = vi_set(0);
    bound_pixels(samples, x, tile->width, &x0, &x1);
    bound_pixels(samples, y, tile->height, &y0, &y1);
    vi_store(setup->x0, x0);
    vi_store(setup->y0, y0);
    vi_store(setup->x1, x1);
    vi_store(setup->y1, y1);
    const vi wide = vi_sub(x1, x0), high = vi_sub(y1, y0);
    const vi at_x = vi_add(vi_shl(x0, BURNISH_SUBPIXEL_BITS), vi_set(HALF_PIXEL));
    const vi at_y = vi_add(vi_shl(y0, BURNISH_SUBPIXEL_BITS), vi_set(HALF_PIXEL));
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        dx[i] = vi_sub(x[b], x[a]);
        dy[i] = vi_sub(y[b], y[a]);
        longest = vi_max(longest, vi_max(vi_magnitude(dx[i]), vi_magnitude(dy[i])));
        /* the top-left rule */
        const vi zero = vi_set(0);
        vm left = vi_greater(zero, dy[i]);
        vm top = vm_and(vi_equal(dy[i], zero), vi_greater(dx[i], zero));
        vi bias = vi_blend(vm_or(left, top), zero, vi_set(-1));
        vi start = vi_sub(vi_mul(dx[i], vi_sub(at_y, y[a])), vi_mul(dy[i], vi_sub(at_x, x[a])));
        vi_store(setup->x[i], x[i]);
        vi_store(setup->y[i], y[i]);
        vi_store(setup->dx[i], dx[i]);
        vi_store(setup->dy[i], dy[i]);
        vi_store(setup->bias[i], bias);
        start = vi_add(start, bias);
        vi_store(setup->start[i], start);
        start = vi_add(start, vi_shl(vi_mul(dy[i], vi_and(x0, vi_set(STAMP_WIDTH - 1))),
                                     BURNISH_SUBPIXEL_BITS));
        start = vi_sub(start, vi_shl(vi_mul(dx[i], vi_and(y0, vi_set(STAMP_HEIGHT - 1))),
                                     BURNISH_SUBPIXEL_BITS));
        vi_store(setup->stamp[i], start);
        vi minus = vi_and(vi_sub(vi_set(0), dy[i]), vi_set(0xffff));
        vi_store(setup->slope[i], vi_or(minus, vi_shl(dx[i], 16)));
    }
    vf area = vf_from_int(vi_sub(vi_mul(dx[2], dy[0]), vi_mul(dy[2], dx[0])));
    vf_store(setup->inverse_area, vf_div(vf_set(1.0f), area));
    vi_store(setup->longest, longest);
    vf_store(setup->depth[0], depth[0]);
    vf_store(setup->depth[1], vf_sub(depth[1], depth[0]));
    vf_store(setup->depth[2], vf_sub(depth[2], depth[0]));
    const unsigned real = (unsigned)((1ull << count) - 1);
    setup->live = vm_bits(vi_not_negative(vi_or(wide, high))) & real;
    setup->small = vm_bits(vm_not(vi_greater(longest, vi_set(BURNISH_SMALL_EDGE))));
    setup->beyond = vm_bits(vi_greater(longest, vi_set(BURNISH_EDGE_32_BITS)));
    const vi longer = vi_max(wide, high);
    setup->tiny = setup->live & setup->small & vm_bits(vi_greater(vi_set(2), longer));
    setup->tiny_3x3 = setup->live & setup->small & vm_bits(vi_greater(vi_set(3), longer));
    const vi columns = vi_sub(vi_sar(x1, BURNISH_BLOCK_BITS), vi_sar(x0, BURNISH_BLOCK_BITS));
    const vi rows = vi_sub(vi_sar(y1, STAMP_HEIGHT_BITS), vi_sar(y0, STAMP_HEIGHT_BITS));
    setup->wide = setup->live &
                  ~(setup->small & vm_bits(vi_greater(vi_set(STAMP_SIDE), vi_max(columns, rows))));
}

/* Marks the block of a pixel as written, where it has been hit. */
BURNISH_INLINE void mark_dirty(burnish_tile *tile, int pixel, int hit) {
    tile->buffer.dirty_blocks[pixel / BURNISH_BLOCK_ROW_PIXELS] |=
        (uint16_t)(hit << (pixel / BURNISH_BLOCK_PIXELS) % BURNISH_TILE_BLOCKS);
}

#endif
