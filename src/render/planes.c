#include "render/planes.h"

#include <string.h>

int burnish_target_has_planes(const burnish_target *target) {
    return target->depth || target->triangles || target->normals || target->coverage;
}

/* Where pixel (x, y) of the image lies in a plane, NULL where the plane is not wanted. */
static void *plane_at(void *plane, size_t stride, int x, int y, size_t size) {
    return plane ? (char *)plane + (size_t)y * stride + (size_t)x * size : NULL;
}

/* What a pixel of each plane holds. */
typedef struct plane_pixel {
    float distance;
    uint32_t triangle;
    float normal[3];
} plane_pixel;

/* All planes but coverage. */
static void store_pixel(const burnish_target *target, int x, int y, const plane_pixel *pixel) {
    float *depth = plane_at(target->depth, target->depth_stride, x, y, sizeof *depth);
    uint32_t *triangle =
        plane_at(target->triangles, target->triangle_stride, x, y, sizeof *triangle);
    float *normal = plane_at(target->normals, target->normal_stride, x, y, sizeof pixel->normal);
    if (depth) {
        *depth = pixel->distance;
    }
    if (triangle) {
        *triangle = pixel->triangle;
    }
    if (normal) {
        memcpy(normal, pixel->normal, sizeof pixel->normal);
    }
}

static float distance_of(const burnish_plane_writer *writer, float depth) {
    const burnish_rays *rays = &writer->surface->shading->rays;
    const float q = depth * rays->q_per_depth + rays->q_constant;
    return (writer->distance.constant + (1.0f - depth) * writer->distance.slope) / q;
}

void burnish_planes_clear(const burnish_plane_writer *writer, const burnish_tile *tile,
                          uint8_t weights[BURNISH_TILE_PIXELS]) {
    const burnish_target *target = &writer->output->target;
    const plane_pixel nothing = {__builtin_inff(), BURNISH_TRIANGLE_NONE, {0, 0, 0}};
    for (int y = tile->y; y < tile->y + tile->height; ++y) {
        for (int x = tile->x; x < tile->x + tile->width; ++x) {
            store_pixel(target, x, y, &nothing);
        }
        if (target->coverage) {
            memset(plane_at(target->coverage, target->coverage_stride, tile->x, y, 1), 0,
                   (size_t)tile->width);
        }
    }
    memset(weights, 0, BURNISH_TILE_PIXELS);
}

/* Unit normals of a batch. */
static void unit_normals(const burnish_plane_writer *writer, const float *const normal[3],
                         int count, float (*out)[BURNISH_SHADE_BATCH]) {
    float *const to[3] = {out[0], out[1], out[2]};
    if (writer->output->target.normals) {
        writer->output->ops->normalize_array((size_t)count, normal, to);
    }
}

static plane_pixel pixel_of(const burnish_plane_writer *writer, float depth, uint32_t source,
                            float (*normals)[BURNISH_SHADE_BATCH], int i) {
    const burnish_target *target = &writer->output->target;
    plane_pixel pixel = {0, source >> 1, {0, 0, 0}};
    if (target->depth) {
        pixel.distance = distance_of(writer, depth);
    }
    for (int k = 0; k < 3 && target->normals; ++k) {
        pixel.normal[k] = normals[k][i];
    }
    return pixel;
}

void burnish_planes_add_fragments(const burnish_plane_writer *writer, const burnish_tile *tile,
                                  const burnish_fragments *fragments,
                                  const burnish_fragment_batch *batch,
                                  uint8_t weights[BURNISH_TILE_PIXELS]) {
    float normals[3][BURNISH_SHADE_BATCH];
    unit_normals(writer, batch->normal, batch->count, normals);
    for (int i = 0; i < batch->count; ++i) {
        const int at = fragments->pixels[i];
        const int x = burnish_pixel_x(at), y = burnish_pixel_y(at);
        if (fragments->weight[i] <= weights[at] || x >= tile->width || y >= tile->height) {
            continue;
        }
        const float depth = writer->output->target.depth ? fragments->depth[i] : 0;
        const plane_pixel pixel =
            pixel_of(writer, depth, fragments->primitives[i].id_and_facing, normals, i);
        weights[at] = fragments->weight[i];
        store_pixel(&writer->output->target, tile->x + x, tile->y + y, &pixel);
    }
}

static void store_coverage(const burnish_plane_writer *writer, int x, int y, int covered) {
    const burnish_target *target = &writer->output->target;
    uint8_t *coverage = plane_at(target->coverage, target->coverage_stride, x, y, 1);
    const int samples = writer->output->samples;
    if (coverage) {
        *coverage = (uint8_t)((255 * covered + samples / 2) / samples);
    }
}

void burnish_planes_store_row(const burnish_plane_writer *writer, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number,
                              const burnish_block_row *pixels) {
    const burnish_target *target = &writer->output->target;
    const int base = number * BURNISH_BLOCK_ROW_PIXELS;
    const float *const normal[3] = {tile->buffer.planes[BURNISH_PLANE_X] + base,
                                    tile->buffer.planes[BURNISH_PLANE_Y] + base,
                                    tile->buffer.planes[BURNISH_PLANE_Z] + base};
    float normals[3][BURNISH_SHADE_BATCH];
    unit_normals(writer, normal, BURNISH_BLOCK_ROW_PIXELS, normals);
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        const int x = burnish_pixel_x(base + i), y = burnish_pixel_y(base + i);
        if (x >= tile->width || y >= tile->height) {
            continue;
        }
        const int simple = pixels->simple[i];
        if (simple >= 0) {
            const uint32_t source =
                target->triangles ? burnish_tile_id_and_facing(tile, number, i, simple) : 0;
            const plane_pixel pixel =
                pixel_of(writer, tile->buffer.center_depths[base + i], source, normals, i);
            store_pixel(target, tile->x + x, tile->y + y, &pixel);
        }
        const int covered = simple >= 0                    ? writer->output->samples
                            : writer->output->samples == 1 ? 0
                                                           : sums->covered[base + i];
        store_coverage(writer, tile->x + x, tile->y + y, covered);
    }
}
