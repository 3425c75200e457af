/* The same steps as interpolate.c and shade.c for whole pixels, whose attributes the raster has
 * interpolated. */
#include "shading/strip.h"

int burnish_shade_planes(const burnish_shader *shader) {
    if (shader->attributes->has_colors) {
        return BURNISH_PLANE_COUNT;
    }
    return burnish_shader_is_lyon(shader) ? BURNISH_PLANE_W + 1 : BURNISH_PLANE_Z + 1;
}

/* Colours and Lyon's lobe need the attributes themselves, not times 1/w. */
static void divide_w(const burnish_shader *shader, const burnish_tile *tile, int base, int first,
                     int end, burnish_strip *strip) {
    const float *inverse_w = tile->planes[BURNISH_PLANE_W] + base;
    for (int k = 0; k < 3 && shader->attributes->has_colors; ++k) {
        const float *color = tile->planes[BURNISH_PLANE_R + k] + base;
        for (int i = first; i < end; ++i) {
            strip->diffuse[k][i] = color[i] * (1.0f / inverse_w[i]);
        }
    }
    for (int k = 0; k < 3 && burnish_shader_is_lyon(shader); ++k) {
        const float *normal = tile->planes[BURNISH_PLANE_X + k] + base;
        for (int i = first; i < end; ++i) {
            strip->normal[k][i] = normal[i] * (1.0f / inverse_w[i]);
        }
    }
}

/* Places of the pixels [first, end), whole blocks. */
static void locate(const burnish_shader *shader, const burnish_tile *tile,
                   const burnish_raster_view *raster, int base, int first, int end,
                   burnish_strip *strip) {
    const int x = tile->x + burnish_pixel_x(base + first);
    const int y = tile->y + burnish_pixel_y(base + first);
    float *const position[3] = {strip->position[0] + first, strip->position[1] + first,
                                strip->position[2] + first};
    shader->batch->locate_pixels(&shader->rays, (float)(2 * x + 1 - raster->width) * 0.5f,
                                 (float)(raster->height - 2 * y - 1) * 0.5f, (size_t)(end - first),
                                 tile->center_depths + base + first, position, strip->w + first);
}

static void shade_run(const burnish_shader *shader, burnish_shade_cache *cache,
                      const burnish_tile *tile, int base, int material, int first, int end,
                      burnish_strip *strip) {
    burnish_kernels_points run = {.w = strip->w + first};
    float *rgb[3];
    burnish_shade_prepare(shader, material, cache);
    for (int k = 0; k < 3; ++k) {
        run.normal[k] = burnish_shader_is_lyon(shader)
                            ? strip->normal[k] + first
                            : tile->planes[BURNISH_PLANE_X + k] + base + first;
        run.diffuse[k] = shader->attributes->has_colors ? strip->diffuse[k] + first : NULL;
        run.position[k] = strip->position[k] + first;
        rgb[k] = strip->rgb[k] + first;
    }
    (void)burnish_kernels_shade_float(shader->batch, &cache->prepared, &run, (size_t)(end - first),
                                      rgb, NULL);
}

/* Pixels that are not whole go with what is before them. */
static void find_materials(const burnish_shader *shader, const burnish_tile *tile, int number,
                           int first, int end, burnish_strip *strip) {
    uint16_t material = 0;
    for (int i = first; i < end; ++i) {
        if (strip->pixels.simple[i] >= 0) {
            uint32_t source = burnish_tile_id_and_facing(tile, number, i, strip->pixels.simple[i]);
            material = shader->triangle_materials[source >> 1];
        }
        strip->material[i] = material;
    }
}

/* Neighbouring blocks that show a triangle. */
static void shade_blocks(const burnish_shader *shader, burnish_shade_cache *cache,
                         const burnish_tile *tile, const burnish_raster_view *view, int number,
                         int first, int end, burnish_strip *strip) {
    const int base = number * BURNISH_BLOCK_ROW_PIXELS;
    if (burnish_shade_planes(shader) > BURNISH_PLANE_W) {
        divide_w(shader, tile, base, first, end, strip);
    }
    if (shader->needs_position) {
        locate(shader, tile, view, base, first, end, strip);
    }
    if (!shader->triangle_materials) {
        shade_run(shader, cache, tile, base, 0, first, end, strip);
        return;
    }
    find_materials(shader, tile, number, first, end, strip);
    for (int at = first, next; at < end; at = next) {
        for (next = at + 1; next < end && strip->material[next] == strip->material[at]; ++next) {
        }
        shade_run(shader, cache, tile, base, strip->material[at], at, next, strip);
    }
}

void burnish_shade_strip(const burnish_shader *shader, burnish_shade_cache *cache,
                         const burnish_isa_ops *ops, const burnish_tile *tile,
                         const burnish_raster_view *view, int number, burnish_strip *strip) {
    const unsigned dirty_blocks = tile->dirty_blocks[number];
    ops->classify_block_row(tile, number, &strip->pixels);
    for (int block = 0, end; block < BURNISH_TILE_BLOCKS; block = end + 1) {
        for (end = block; end < BURNISH_TILE_BLOCKS && dirty_blocks >> end & 1; ++end) {
        }
        if (end > block) {
            shade_blocks(shader, cache, tile, view, number, block * BURNISH_BLOCK_PIXELS,
                         end * BURNISH_BLOCK_PIXELS, strip);
        }
    }
}
