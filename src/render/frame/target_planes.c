/* The planes of a target: depth, triangles, normals and coverage. */
#include "render/frame/target.h"

#include <string.h>

/* Where pixel x of a plane's row y lies, NULL where the plane is not wanted. */
static void *plane_at(void *plane, size_t stride, int x, int y, size_t size) {
    return plane ? (char *)plane + (size_t)y * stride + (size_t)x * size : NULL;
}

/* The row of the planes for a pixel of a tile; -1 if that row is not drawn. */
static int plane_row(const burnish_output *output, const burnish_tile *tile, int pixel) {
    const int y = tile->y + burnish_pixel_y(pixel);
    return y >= output->rows.first && y < output->rows.end ? y - output->rows.first : -1;
}

static float distance_of(const burnish_view *view, float depth) {
    const burnish_rays *rays = &view->shading.rays;
    const float q = depth * rays->q_per_depth + rays->q_constant;
    return (view->distance.constant + (1.0f - depth) * view->distance.slope) / q;
}

/* Row by row and plane by plane: pixel by pixel it took a tenth of a frame. */
void burnish_planes_clear(const burnish_output *output, const burnish_tile *tile,
                          burnish_tile_sums *sums) {
    const burnish_target *t = &output->target;
    const size_t width = (size_t)tile->width;
    const int top = tile->y - output->rows.first, bottom = top + tile->height;
    const int count = output->rows.end - output->rows.first;
    for (int y = top > 0 ? top : 0; y < bottom && y < count; ++y) {
        float *depths = plane_at(t->depth, t->depth_stride, tile->x, y, sizeof *depths);
        uint32_t *triangles =
            plane_at(t->triangles, t->triangle_stride, tile->x, y, sizeof *triangles);
        float *normals = plane_at(t->normals, t->normal_stride, tile->x, y, 3 * sizeof *normals);
        uint8_t *coverage = plane_at(t->coverage, t->coverage_stride, tile->x, y, 1);
        for (size_t x = 0; depths && x < width; ++x) {
            depths[x] = __builtin_inff();
        }
        for (size_t x = 0; triangles && x < width; ++x) {
            triangles[x] = BURNISH_TRIANGLE_NONE;
        }
        if (normals) {
            memset(normals, 0, 3 * width * sizeof *normals);
        }
        if (coverage) {
            memset(coverage, 0, width);
        }
    }
    memset(sums->weights, 0, sizeof sums->weights);
}

/* Unit normals of a batch. */
static void unit_normals(const burnish_output *output, const float *const normal[3], int count,
                         float (*out)[BURNISH_SHADE_BATCH]) {
    float *const to[3] = {out[0], out[1], out[2]};
    if (output->target.normals) {
        output->ops->normalize_array((size_t)count, normal, to);
    }
}

/* All planes but coverage. normals: of a batch, of which the pixel's is number i. */
static inline void store_pixel(const burnish_output *output, int x, int y, const float *depth,
                               uint32_t source, float (*normals)[BURNISH_SHADE_BATCH], int i) {
    const burnish_target *t = &output->target;
    if (t->depth) {
        float *to = plane_at(t->depth, t->depth_stride, x, y, sizeof *to);
        *to = distance_of(output->view, *depth);
    }
    if (t->triangles) {
        uint32_t *to = plane_at(t->triangles, t->triangle_stride, x, y, sizeof *to);
        const uint32_t triangle = source >> 1;
        *to = output->hosts && triangle >= output->own_triangles
                  ? output->hosts[triangle - output->own_triangles]
                  : triangle;
    }
    float *normal = plane_at(t->normals, t->normal_stride, x, y, 3 * sizeof *normal);
    for (int k = 0; k < 3 && normal; ++k) {
        normal[k] = normals[k][i];
    }
}

void burnish_planes_store_fragments(const burnish_output *output, const burnish_tile *tile,
                                    const burnish_fragments *fragments,
                                    const burnish_fragment_batch *batch, uint8_t *weights) {
    float normals[3][BURNISH_SHADE_BATCH];
    unit_normals(output, batch->normal, batch->count, normals);
    for (int i = 0; i < batch->count; ++i) {
        const int at = fragments->pixels[i];
        const int x = burnish_pixel_x(at), y = plane_row(output, tile, at);
        if (fragments->weight[i] <= weights[at] || x >= tile->width || y < 0) {
            continue;
        }
        weights[at] = fragments->weight[i];
        store_pixel(output, tile->x + x, y, &fragments->depth[i],
                    fragments->primitives[i].id_and_facing, normals, i);
    }
}

void burnish_planes_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number,
                              const burnish_block_row *pixels) {
    const burnish_target *target = &output->target;
    const int base = number * BURNISH_BLOCK_ROW_PIXELS;
    const float *const normal[3] = {tile->buffer.planes[BURNISH_PLANE_X] + base,
                                    tile->buffer.planes[BURNISH_PLANE_Y] + base,
                                    tile->buffer.planes[BURNISH_PLANE_Z] + base};
    float normals[3][BURNISH_SHADE_BATCH];
    unit_normals(output, normal, BURNISH_BLOCK_ROW_PIXELS, normals);
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        const int x = burnish_pixel_x(base + i), y = plane_row(output, tile, base + i);
        if (x >= tile->width || y < 0) {
            continue;
        }
        const int simple = pixels->simple[i];
        if (simple >= 0) {
            const uint32_t source =
                target->triangles ? burnish_tile_id_and_facing(tile, number, i, simple) : 0;
            store_pixel(output, tile->x + x, y, &tile->buffer.center_depths[base + i], source,
                        normals, i);
        }
        uint8_t *coverage =
            plane_at(target->coverage, target->coverage_stride, tile->x + x, y, sizeof *coverage);
        if (coverage) { /* where layers alone cover a pixel, it counts, but hides no splat */
            const unsigned samples = (unsigned)output->samples, on = simple >= 0 ? samples : 0;
            const unsigned covered = on || samples == 1 ? on : sums->covered[base + i];
            const unsigned layers = burnish_layered_pixels(sums, number, i / BURNISH_BLOCK_PIXELS);
            const unsigned code = (255 * covered + samples / 2) / samples;
            *coverage = (uint8_t)(code > 0 ? code : layers >> i % BURNISH_BLOCK_PIXELS & 1);
        }
    }
}
