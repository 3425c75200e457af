/* Ambient occlusion, by depth maps or rays, and light that bounces. */
#include <string.h>

#include "raster/raster_ops.h"
#include "render/frame/surface.h"

/* A point that sees no sky keeps so much of its light, by which the first light is divided. */
#define LEAST_OPEN 0x1p-10f

/* The walls of negative volumes see so much of the sky, or more: depth maps have the whole solid
 * before them. */
#define HOLLOW_OPEN 0.7f

void burnish_occlude_batch(const burnish_shading *shading, const burnish_fragment_batch *batch,
                           const burnish_kernels_points *points,
                           burnish_fragment_scratch *scratch) {
    burnish_share_points shared = {.w = points->w,
                                   .pixels = batch->pixels,
                                   .first_pixel = batch->first_pixel,
                                   .shown = batch->shown,
                                   .are_layers = batch->samples != NULL};
    for (int k = 0; k < 3; ++k) {
        shared.position[k] = points->position[k];
        shared.normal[k] = points->normal[k];
    }
    if (shading->ray_light) {
        burnish_ray_tile_look(scratch->rays, shading->ray_light, shading->ops, &shared,
                              batch->count, &scratch->share, scratch->lit);
    } else {
        burnish_occlude_points(shading->occlusion, shading->ops, &shared, batch->count,
                               &scratch->share);
    }
    const int values = shading->ray_light ? 1 : 2;
    for (int i = 0; shading->hollow_from > 0 && i < values * batch->count; ++i) {
        float *const own = &scratch->share.open[i % values][i / values];
        const int is_hollow = scratch->ids[i / values] >> 1 >= shading->hollow_from;
        *own = is_hollow && *own < HOLLOW_OPEN ? HOLLOW_OPEN : *own;
    }
    float *const open = scratch->share.open[0];
    for (int i = 0; i < batch->count && points->first_light && shading->occlusion; ++i) {
        open[i] = open[i] > LEAST_OPEN ? open[i] : LEAST_OPEN;
        scratch->lit[i] /= open[i];
    }
}

/* Whether metals mirror what comes over other surfaces: by rays. */
static int metals_mirror(const burnish_shading *shading) {
    return shading->ray_light && shading->area;
}

/* What a material reflects of light that comes over other surfaces. */
static const float *bounced_albedo(const burnish_shading *shading, size_t material) {
    return metals_mirror(shading) ? shading->area->materials[material].reflecting.diffuse
                                  : shading->shaders[material].albedo;
}

void burnish_add_bounces(const burnish_shading *shading, const burnish_kernels_points *points,
                         int count, int material, float (*open)[BURNISH_SHADE_BATCH],
                         const burnish_texture_scratch *textures, float *const rgb[3]) {
    const burnish_textured_material *textured =
        shading->texturing ? &shading->texturing->materials[material] : NULL;
    const int is_varied = textured && textured->is_special && textured->is_varied;
    const float *factor[3];
    float albedo[3];
    for (int k = 0; k < 3; ++k) {
        albedo[k] = is_varied ? 1 : bounced_albedo(shading, (size_t)material)[k];
        factor[k] = textured && textured->is_special ? textures->diffuse[k] : points->diffuse[k];
        if (is_varied && burnish_has_roughness(&textured->material) && !metals_mirror(shading)) {
            factor[k] = textures->ambient[k];
        }
    }
    shading->ops->add_bounces(shading->occlusion, albedo, factor, open, (size_t)count, rgb);
}

void burnish_add_bounces_mixed(const burnish_shading *shading, const burnish_fragment_batch *batch,
                               burnish_fragment_scratch *scratch, float *const rgb[3]) {
    static const float white[3] = {1, 1, 1};
    const float *const albedo[3] = {scratch->albedo[0], scratch->albedo[1], scratch->albedo[2]};
    for (int i = 0; i < batch->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            scratch->albedo[k][i] = bounced_albedo(shading, batch->material[i])[k];
        }
    }
    shading->ops->add_bounces(shading->occlusion, white, albedo, scratch->share.open,
                              (size_t)batch->count, rgb);
}

/* ---- The points of a tile from which rays are cast: of each pixel the one that most of it shows ---- */

/* Adds the points of a batch.
 *   ranks  0: of complex pixels in a row, whose fragments are added by themselves */
static void add_points(const burnish_shading *shading, const burnish_fragment_batch *batch,
                       const uint16_t *ranks, const uint32_t *triangles,
                       burnish_fragment_scratch *scratch) {
    float *const position[3] = {scratch->position[0], scratch->position[1], scratch->position[2]};
    shading->ops->position_from_depth(&shading->rays, &batch->points, (size_t)batch->count,
                                      position, scratch->w);
    for (int i = 0; i < batch->count; ++i) {
        const float inverse = 1.0f / scratch->w[i];
        const float p[3] = {position[0][i] * inverse, position[1][i] * inverse,
                            position[2][i] * inverse};
        const float normal[3] = {batch->normal[0][i], batch->normal[1][i], batch->normal[2][i]};
        const int pixel = batch->pixels ? batch->pixels[i] : batch->first_pixel + i;
        const int at = burnish_ray_place(burnish_pixel_x(pixel), burnish_pixel_y(pixel));
        if (ranks[i] > 0) {
            burnish_ray_tile_add(scratch->rays, shading->ray_light, at, ranks[i], p, normal,
                                 triangles[i]);
        }
    }
}

static void add_fragments(const burnish_surface *surface, const burnish_raster_ops *ops,
                          const burnish_tile *tile, burnish_fragments *fragments,
                          burnish_fragment_scratch *scratch) {
    uint16_t ranks[BURNISH_FRAGMENT_BATCH];
    int next_block = 0;
    while (ops->next_fragments(tile, surface->view, &next_block, fragments)) {
        const burnish_fragment_batch batch =
            burnish_shade_fragments(surface, tile, fragments, scratch, NULL);
        for (int i = 0; i < batch.count; ++i) {
            const int is_cap = surface->caps && scratch->hatch[i] != BURNISH_NO_CAP;
            ranks[i] = burnish_ray_rank(fragments->samples[i]);
            scratch->ids[i] = is_cap ? UINT32_MAX : scratch->ids[i];
        }
        add_points(surface->shading, &batch, ranks, scratch->ids, scratch);
    }
}

static void add_block_row(const burnish_surface *surface, const burnish_tile *tile, int number,
                          burnish_fragment_scratch *scratch, burnish_row_light *row) {
    const int start = number * BURNISH_BLOCK_ROW_PIXELS;
    uint16_t ranks[BURNISH_BLOCK_ROW_PIXELS];
    uint32_t triangles[BURNISH_BLOCK_ROW_PIXELS];
    burnish_fragment_batch batch = {.count = BURNISH_BLOCK_ROW_PIXELS,
                                    .first_pixel = start,
                                    .points = burnish_row_points(surface->view, tile, number)};
    batch.points.depth = tile->buffer.center_depths + start;
    for (int k = 0; k < 3; ++k) {
        batch.normal[k] = tile->buffer.planes[BURNISH_PLANE_X + k] + start;
    }
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        const int32_t simple = row->pixels.simple[i];
        const int is_there =
            simple >= 0 && tile->buffer.dirty_blocks[number] >> i / BURNISH_BLOCK_PIXELS & 1;
        const int is_cap = is_there && surface->caps && row->hatch[i] != BURNISH_NO_CAP;
        ranks[i] = is_there ? UINT16_MAX : 0;
        triangles[i] =
            is_there && !is_cap ? burnish_tile_id_and_facing(tile, number, i, simple) : UINT32_MAX;
    }
    add_points(surface->shading, &batch, ranks, triangles, scratch);
}

void burnish_surface_cast_rays(const burnish_surface *surface, const burnish_raster_ops *ops,
                               const burnish_tile *tile, burnish_fragments *fragments,
                               burnish_fragment_scratch *scratch, burnish_row_light *row) {
    memset(scratch->rays->rank, 0, sizeof scratch->rays->rank);
    if (tile->options.samples > 1) {
        add_fragments(surface, ops, tile, fragments, scratch);
    }
    for (int number = 0; number < BURNISH_TILE_BLOCKS; ++number) {
        if (tile->buffer.dirty_blocks[number]) {
            ops->classify_block_row(tile, number, &row->pixels);
            if (surface->caps) {
                burnish_cap_block_row(surface, tile, number, row);
            }
            add_block_row(surface, tile, number, scratch, row);
        }
    }
    burnish_ray_tile_add_margin(scratch->rays, surface->shading->ray_light, &surface->shading->rays,
                                tile, surface->view);
    burnish_ray_tile_cast(scratch->rays, surface->shading->ray_light, surface->shading->ops);
}
