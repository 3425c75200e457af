/* Drawing points as discs. They have few pixels, so they are drawn one after another. */
#ifndef BURNISH_RASTER_DISCS_SIMD_H
#define BURNISH_RASTER_DISCS_SIMD_H

#include "raster/discs.h"
#include "raster/samples_simd.h"

/* A disc in the tile: coordinates count from the tile's corner. */
typedef struct tile_disc {
    uint32_t point;
    int32_t id; /* what samples that show it get */
    int32_t x, y, radius;
    float depth, rise; /* of the sphere's centre; of its nearest point minus that */
    float nearest;     /* their sum */
    unsigned samples;  /* bits of those that show it, whatever the pixel: fewer if transparent */
} tile_disc;

BURNISH_INLINE float depth_in_disc(const tile_disc *disc, int32_t x, int32_t y) {
    return disc->depth + disc->rise * burnish_disc_position_of(x, y, disc->radius).toward;
}

/* The normal at a position in a disc: x, y from its centre. */
BURNISH_INLINE void disc_normal(const burnish_tile *tile, const burnish_point_view *points,
                                const tile_disc *disc, const burnish_disc_position *at, int32_t x,
                                int32_t y, float normal[3]) {
    const burnish_float4 attribute = tile->attributes[0][disc->point];
    const float own[3] = {attribute[0], attribute[1], attribute[2]};
    const float step = 1.0f / BURNISH_SUBPIXELS;
    const int32_t left = points->center[0] - tile->x * BURNISH_SUBPIXELS - disc->x;
    const int32_t above = points->center[1] - tile->y * BURNISH_SUBPIXELS - disc->y;
    burnish_point_normal(points, own, at, (float)(x - left) * step, (float)(above - y) * step,
                         normal);
    const float scale = own[0] == 0 && own[1] == 0 && own[2] == 0 ? attribute[3] : 1.0f;
    for (int k = 0; k < 3; ++k) {
        normal[k] *= scale;
    }
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
    const burnish_disc_position at = burnish_disc_position_of(x, y, disc->radius);
    float normal[3];
    disc_normal(tile, points, disc, &at, x, y, normal);
    for (int k = 0; k < 3; ++k) {
        tile->buffer.planes[BURNISH_PLANE_X + k][pixel] = normal[k];
    }
    if (planes > BURNISH_PLANE_W) {
        tile->buffer.planes[BURNISH_PLANE_W][pixel] = tile->attributes[0][disc->point][3];
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
        if (!(disc->samples >> s & 1) || !(disc->nearest > tile->buffer.depths[sample]) ||
            (int64_t)u * u + (int64_t)v * v > most) {
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

/* The samples that show a point: all of an opaque one, else as large a share as its opacity. They
 * are the same for all points, so overlapping discs do not add up: a surface has the opacity of its
 * points and shows what is behind it, but for points that are no more opaque. */
BURNISH_INLINE unsigned choose_samples(const burnish_tile *tile, float opacity, uint32_t point) {
    const int samples = tile->options.samples;
    const unsigned all = (1u << samples) - 1;
    if (tile->options.planes == 0) {
        return all;
    }
    if (tile->attributes[1]) {
        opacity *= tile->attributes[1][point][3] / tile->attributes[0][point][3];
    }
    if (!(opacity < 0.996f)) {
        return all;
    }
    const int count = (int)(opacity * (float)samples + 0.5f);
    return count > 0 ? (1u << count) - 1 : 0;
}

BURNISH_INLINE tile_disc make_disc(const burnish_tile *tile, const burnish_geometry *geometry,
                                   uint32_t point) {
    const burnish_screen_vertex *v = &geometry->vertices.items[point];
    const burnish_disc size =
        burnish_disc_of(&geometry->points, v->depth, geometry->vertices.inverse_w[point]);
    const float rise = size.nearest - v->depth;
    return (tile_disc){.point = point,
                       .id = (int32_t)(point * 2),
                       .x = v->x - tile->x * BURNISH_SUBPIXELS,
                       .y = v->y - tile->y * BURNISH_SUBPIXELS,
                       .radius = size.radius,
                       .depth = v->depth,
                       .rise = rise,
                       .nearest = v->depth + rise,
                       .samples = choose_samples(tile, geometry->points.opacity, point)};
}

/* Returns the largest radius. */
static int32_t draw_points(burnish_tile *tile, const burnish_geometry *geometry,
                           const uint32_t *indices, size_t count) {
    enum { AHEAD = 8 };
    int32_t largest = 0;
    for (size_t i = 0; i < count; ++i) {
        if (i + AHEAD < count) {
            __builtin_prefetch(&geometry->vertices.items[indices[i + AHEAD]]);
            __builtin_prefetch(&geometry->vertices.inverse_w[indices[i + AHEAD]]);
        }
        tile_disc disc = make_disc(tile, geometry, indices[i]);
        if (tile->options.samples > 1) {
            append_disc(&tile->primitives, &disc, indices[i] * 2);
        }
        draw_disc(tile, &geometry->points, &disc);
        largest = disc.radius > largest ? disc.radius : largest;
    }
    return largest;
}

/* ---- Blended points ----
 *
 * Where discs overlap, their normals and colours are averaged, so a surface of few points shows no
 * facets. This follows the drawing of a tile's points, so the depth of each pixel is known, and goes
 * over them again. A disc counts at a pixel's centre with (1 - d^2)^2 t: d is the distance from the
 * disc's centre in radii, and t falls from 1 at the visible depth to 0 at the depth of a radius
 * behind. HiZ has room for that (bound_point). Pixels at outlines, and points without a normal, stay
 * as they are. */

/* Discs that are smaller are not blended: no facet is seen. */
enum { BLEND_RADIUS = 3 * BURNISH_SUBPIXELS / 2 };

typedef struct point_blend {
    float fronts[BURNISH_TILE_PIXELS];  /* visible depths; BURNISH_NEAREST: stays as it is */
    float weights[BURNISH_TILE_PIXELS]; /* so far */
} point_blend;

/* The sample of a pixel that is nearest; -1 unless all show a disc, at depths of one surface. */
static int front_sample(const burnish_tile *tile, int pixel) {
    const int samples = tile->options.samples;
    const float *depths = tile->buffer.depths;
    int front = burnish_sample_index(samples, pixel, 0);
    float least = depths[front];
    for (int s = 1; s < samples; ++s) {
        const int sample = burnish_sample_index(samples, pixel, s);
        front = depths[sample] > depths[front] ? sample : front;
        least = depths[sample] < least ? depths[sample] : least;
    }
    if (!(least > BURNISH_FARTHEST) || !(depths[front] < BURNISH_NEAREST)) {
        return -1;
    }
    if (samples == 1) {
        return front;
    }
    const size_t id = (size_t)tile->buffer.ids[front];
    const float rise = tile->primitives.depths[id].depth[1];
    const burnish_float4 own = tile->attributes[0][tile->primitives.primitives[id].vertices[0]];
    return depths[front] - least < rise && !(own[0] == 0 && own[1] == 0 && own[2] == 0) ? front
                                                                                        : -1;
}

static void blend_disc(burnish_tile *tile, const burnish_point_view *points, const tile_disc *disc,
                       point_blend *blend) {
    const burnish_float4 attribute = tile->attributes[0][disc->point];
    const float own[3] = {attribute[0], attribute[1], attribute[2]};
    const int is_ball = own[0] == 0 && own[1] == 0 && own[2] == 0;
    const int colors = tile->options.planes > BURNISH_PLANE_R ? 3 : 0;
    const int x0 = clamp_pixel(disc->x - disc->radius), x1 = clamp_pixel(disc->x + disc->radius);
    const int y0 = clamp_pixel(disc->y - disc->radius), y1 = clamp_pixel(disc->y + disc->radius);
    const int64_t most = (int64_t)disc->radius * disc->radius;
    for (int i = 0; i < (y1 - y0 + 1) * (x1 - x0 + 1); ++i) {
        const int px = x0 + i % (x1 - x0 + 1), py = y0 + i / (x1 - x0 + 1);
        const int pixel = burnish_pixel_index(px, py);
        const int32_t x = px * BURNISH_SUBPIXELS + HALF_PIXEL - disc->x;
        const int32_t y = py * BURNISH_SUBPIXELS + HALF_PIXEL - disc->y;
        const float front = blend->fronts[pixel];
        if (!(disc->nearest > front - disc->rise) || (int64_t)x * x + (int64_t)y * y >= most) {
            continue;
        }
        const burnish_disc_position at = burnish_disc_position_of(x, y, disc->radius);
        const float behind = (front - (disc->depth + disc->rise * at.toward)) / disc->rise;
        const float near = behind > 0 ? 1.0f - behind : 1.0f;
        const float inner = at.toward * at.toward;
        if (!(near > 0) || (is_ball && behind > 0)) {
            continue;
        }
        const float weight = is_ball ? 1e6f : inner * inner * near;
        const float before = blend->weights[pixel];
        float values[6];
        disc_normal(tile, points, disc, &at, x, y, values);
        for (int k = 0; k < colors; ++k) {
            values[3 + k] = tile->attributes[1][disc->point][k] / attribute[3];
        }
        for (int k = 0; k < 3 + colors; ++k) {
            float *sum =
                &tile->buffer.planes[k < 3 ? BURNISH_PLANE_X + k : BURNISH_PLANE_R + k - 3][pixel];
            *sum = before > 0 ? *sum + weight * values[k] : weight * values[k];
        }
        blend->weights[pixel] = before + weight;
    }
}

static void blend_points(burnish_tile *tile, const burnish_geometry *geometry,
                         const uint32_t *indices, size_t count, point_blend *blend) {
    for (size_t i = 0; i < count; ++i) {
        const tile_disc disc = make_disc(tile, geometry, indices[i]);
        if (disc.radius >= BLEND_RADIUS && disc.samples == (1u << tile->options.samples) - 1) {
            blend_disc(tile, &geometry->points, &disc, blend);
        }
    }
}

static void begin_blend(const burnish_tile *tile, point_blend *blend) {
    for (int pixel = 0; pixel < BURNISH_TILE_PIXELS; ++pixel) {
        const int front = front_sample(tile, pixel);
        blend->fronts[pixel] = front >= 0 ? tile->buffer.depths[front] : BURNISH_NEAREST;
        blend->weights[pixel] = 0;
    }
}

/* Pixels that were blended show one disc, the nearest. */
static void end_blend(burnish_tile *tile, const point_blend *blend) {
    const int samples = tile->options.samples, planes = tile->options.planes;
    for (int pixel = 0; pixel < BURNISH_TILE_PIXELS; ++pixel) {
        const float weight = blend->weights[pixel];
        if (!(weight > 0)) {
            continue;
        }
        const int front = front_sample(tile, pixel);
        if (samples > 1) {
            const int32_t id = tile->buffer.ids[front];
            for (int s = 0; s < samples; ++s) {
                tile->buffer.ids[burnish_sample_index(samples, pixel, s)] = id;
            }
            if (planes > BURNISH_PLANE_W) {
                const uint32_t point = tile->primitives.primitives[id].vertices[0];
                tile->buffer.planes[BURNISH_PLANE_W][pixel] = tile->attributes[0][point][3];
            }
            if (tile->options.needs_position) {
                tile->buffer.center_depths[pixel] = blend->fronts[pixel];
            }
        }
        for (int k = 0; k < planes; ++k) { /* colours are divided by w, as W is */
            const float scale =
                k > BURNISH_PLANE_W ? tile->buffer.planes[BURNISH_PLANE_W][pixel] : 1;
            if (k != BURNISH_PLANE_W) {
                tile->buffer.planes[k][pixel] = tile->buffer.planes[k][pixel] * scale / weight;
            }
        }
    }
}

#endif
