#include "render/frame/surface.h"

#include <string.h>

#include "raster/discs.h"
#include "render/texture/texture.h"

/* ---- Planes ---- */

/* Whether attributes are needed themselves, not times 1/w: colours, and normals whose length
 * matters. */
static int needs_division(const burnish_surface *surface) {
    return surface->attributes->has_colors || surface->shading->is_lyon;
}

int burnish_surface_planes(const burnish_surface *surface) {
    const int has_colors = surface->attributes->has_colors;
    if (has_colors) {
        return BURNISH_PLANE_COUNT;
    }
    return needs_division(surface) ? BURNISH_PLANE_W + 1 : BURNISH_PLANE_Z + 1;
}

/* ---- Batches: attributes divided by 1/w, positions from depths, then the kernels, a run of one
 * material after another ---- */

static int padded_count(int count) {
    return (count + BURNISH_SHADE_PAD - 1) / BURNISH_SHADE_PAD * BURNISH_SHADE_PAD;
}

/* Clears what is between the last item and the end of its vector: it is read, though not used. */
static void clear_tail(float *items, int count) {
    memset(items + count, 0, (size_t)(padded_count(count) - count) * sizeof *items);
}

/* attribute / (1/w) in three arrays. */
static void divide_by_inverse_w(int count, const float *const attribute[3], const float *inverse_w,
                                float (*out)[BURNISH_SHADE_BATCH]) {
    float w[BURNISH_SHADE_BATCH];
    for (int i = 0; i < count; ++i) {
        w[i] = 1.0f / inverse_w[i];
    }
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            out[k][i] = attribute[k][i] * w[i];
        }
    }
}

void burnish_shade_material(const burnish_shading *shading, const burnish_fragment_batch *batch,
                            const burnish_kernels_points *points,
                            float (*streams)[BURNISH_SHADE_BATCH], int material,
                            burnish_fragment_scratch *scratch, float *const rgb[3]) {
    const int count = batch->count;
    const burnish_kernels_shader *shader = &shading->shaders[material];
    const burnish_texturing *texturing = shading->texturing;
    burnish_area_batch lit = {.points = points,
                              .material = material,
                              .count = count,
                              .textures = scratch->texture,
                              .scratch = &scratch->near,
                              .cells = &scratch->cells,
                              .screen = &batch->points,
                              .shown = batch->shown};
    if (shading->ray_light && shading->occlusion) {
        lit.open = points->w == scratch->group.w ? scratch->group.open : scratch->share.open;
    }
    if (texturing && texturing->materials[material].is_special) {
        const float *from[2][BURNISH_TEXTURE_SECOND];
        for (int k = 0; k < BURNISH_TEXTURE_SECOND; ++k) {
            from[0][k] = streams[k];
            from[1][k] = streams[k < BURNISH_TEXTURE_TANGENT ? BURNISH_TEXTURE_SECOND + k : k];
        }
        const burnish_texture_batch textured = {shading->ops,
                                                &texturing->materials[material],
                                                {from[0], from[1]},
                                                count,
                                                scratch->texture};
        burnish_texture_shade(texturing, shader, points, &textured, rgb);
        lit.textured = textured.material;
    } else {
        shading->kernels->shade[shader->lobe.body][shader->geometry][BURNISH_SHADE_FLOAT](
            shader, points, (size_t)count, NULL, rgb);
    }
    if (shading->area) {
        burnish_area_add(shading->area, shading->kernels, shading->ops, &lit, rgb);
    }
    if (texturing && texturing->materials[material].passes) {
        burnish_pass_light(shading, points, material, count, scratch, rgb);
    }
}

static int has_one_material(const burnish_fragment_batch *batch) {
    const int32_t *material = batch->material;
    int32_t different = 0;
    for (int i = 0; i < (material && !batch->has_one_material ? batch->count : 0); ++i) {
        different |= material[i] ^ material[0];
    }
    return different == 0;
}

static void add_stream(burnish_batch_streams *streams, const float *from, float *to) {
    streams->from[streams->count] = from;
    streams->to[streams->count] = to;
    streams->count += 1;
}

/* Samples whose cover a material leaves in scratch. */
static int smooth_samples(const burnish_shading *shading, int material,
                          const burnish_fragment_scratch *scratch) {
    const burnish_texturing *texturing = shading->texturing;
    return scratch->texture->has_shifts && texturing->materials[material].is_smooth
               ? texturing->smooth_samples
               : 0;
}

/* Takes the opacity of a group's points back to the batch. */
static void scatter_opacity(const burnish_shading *shading, const burnish_fragment_batch *batch,
                            int material, int size, burnish_fragment_scratch *scratch) {
    float *const alpha = scratch->texture->alpha;
    const float *const from[3] = {scratch->texture->opacity, scratch->texture->opacity,
                                  scratch->texture->opacity};
    float *const to[3] = {alpha, alpha, alpha};
    shading->ops->scatter_material(material, batch->material, size, scratch->group.starts, from,
                                   to);
    for (int s = 0; s < smooth_samples(shading, material, scratch); s += 2) { /* an even number */
        float(*cover)[BURNISH_TEXTURE_BATCH] = scratch->texture->cover + s;
        float(*covers)[BURNISH_TEXTURE_BATCH] = scratch->texture->covers + s;
        const float *const part[3] = {cover[0], cover[1], cover[1]};
        float *const all[3] = {covers[0], covers[1], covers[1]};
        shading->ops->scatter_material(material, batch->material, size, scratch->group.starts, part,
                                       all);
    }
}

/* Texture coordinates of a batch; all fragments are opaque until their material is shaded. */
static void locate_textures(const burnish_shading *shading, const burnish_fragment_batch *batch,
                            burnish_texture_scratch *scratch) {
    if (shading->texturing->needs_points) {
        burnish_texture_locate(shading->texturing, &shading->rays, &batch->points, batch->material,
                               batch->count, scratch);
    }
    for (int i = 0; i < BURNISH_SHADE_BATCH && shading->texturing->has_alpha; ++i) {
        scratch->alpha[i] = 1.0f;
    }
    burnish_masks_begin(shading->texturing, batch->samples, batch->count, scratch);
}

/* Shades a batch of several materials, one after another: the vectors that show it are brought
 * together, shaded, and its pixels of them taken back. */
static void shade_mixed(const burnish_shading *shading, const burnish_fragment_batch *batch,
                        const burnish_kernels_points *points, burnish_fragment_scratch *scratch,
                        float *const rgb[3]) {
    burnish_material_group *group = &scratch->group;
    burnish_kernels_points brought = {.w = group->w};
    float *const light[3] = {group->light[0], group->light[1], group->light[2]};
    const float *const shaded[3] = {light[0], light[1], light[2]};
    burnish_batch_streams streams = {0};
    for (int k = 0; k < 3; ++k) {
        brought.normal[k] = group->normal[k];
        brought.diffuse[k] = points->diffuse[k] ? group->diffuse[k] : NULL;
        brought.position[k] = group->position[k];
        add_stream(&streams, points->normal[k], group->normal[k]);
        if (points->diffuse[k]) {
            add_stream(&streams, points->diffuse[k], group->diffuse[k]);
        }
        if (shading->needs_position) {
            add_stream(&streams, points->position[k], group->position[k]);
        }
    }
    if (shading->needs_position) {
        add_stream(&streams, points->w, group->w);
        add_stream(&streams, batch->points.x_offset, group->x);
        add_stream(&streams, batch->points.y_offset, group->y);
    }
    if (shading->texturing && shading->texturing->has_passing) {
        add_stream(&streams, scratch->facing, group->facing);
    }
    burnish_fragment_batch part = {.points = batch->points};
    part.points.x_offset = group->x;
    part.points.y_offset = group->y;
    if (points->first_light) {
        brought.first_light = group->lit;
        add_stream(&streams, points->first_light, group->lit);
    }
    const int seen = shading->ray_light ? BURNISH_SEEN_VALUES : BURNISH_SEEN_SKY + 1;
    for (int k = 0; shading->occlusion && k < seen; ++k) {
        add_stream(&streams, scratch->share.open[k], group->open[k]);
    }
    for (int k = 0; shading->texturing && k < BURNISH_TEXTURE_STREAMS; ++k) {
        if (k < BURNISH_TEXTURE_SHIFT_X ||
            (k < BURNISH_TEXTURE_SECOND ? scratch->texture->has_shifts
                                        : shading->texturing->needs_second)) {
            add_stream(&streams, scratch->texture->points[k], scratch->texture->brought[k]);
        }
    }
    memcpy(group->left, batch->material, (size_t)padded_count(batch->count) * sizeof *group->left);
    for (int i = 0; i < batch->count; ++i) {
        const int32_t material = group->left[i];
        if (material >= 0) {
            const int size = shading->ops->collect_material(material, i, batch->count, group->left,
                                                            &streams, group->starts);
            part.count = size;
            burnish_shade_layers(shading, &part, &brought,
                                 shading->texturing ? scratch->texture->brought : NULL, material,
                                 scratch, light);
            if (shading->occlusion) {
                burnish_add_bounces(shading, &brought, size, material, group->open,
                                    scratch->texture, light);
            }
            shading->ops->scatter_material(material, batch->material, size, group->starts, shaded,
                                           rgb);
            if (shading->texturing && shading->texturing->materials[material].is_alpha) {
                scatter_opacity(shading, batch, material, size, scratch);
            }
            burnish_keep_passed(shading, batch->material, material, size, scratch);
        }
    }
}

/* rgb gets the colours: light >= 0 for the target, not clamped above. */
static void shade_batch(const burnish_shading *shading, const burnish_fragment_batch *batch,
                        burnish_fragment_scratch *scratch, float *const rgb[3]) {
    burnish_kernels_points points = {.w = scratch->w};
    float *const position[3] = {scratch->position[0], scratch->position[1], scratch->position[2]};
    for (int k = 0; k < 3; ++k) {
        points.normal[k] = shading->is_lyon ? scratch->divided_normal[k] : batch->normal[k];
        points.diffuse[k] = batch->color[k] ? scratch->divided_color[k] : NULL;
        points.position[k] = position[k];
    }
    if (shading->is_lyon) {
        divide_by_inverse_w(batch->count, batch->normal, batch->inverse_w, scratch->divided_normal);
    }
    if (batch->color[0]) {
        divide_by_inverse_w(batch->count, batch->color, batch->inverse_w, scratch->divided_color);
    }
    if (shading->needs_position) {
        shading->ops->position_from_depth(&shading->rays, &batch->points, (size_t)batch->count,
                                          position, scratch->w);
        for (int k = 0; k < 3; ++k) {
            clear_tail(position[k], batch->count);
        }
        clear_tail(scratch->w, batch->count);
    }
    if (shading->shadow) {
        shading->ops->cast_shadow(shading->shadow, &points, (size_t)batch->count, scratch->lit);
    }
    if (shading->shadow || (shading->ray_light && shading->ray_light->key >= 0)) {
        points.first_light = scratch->lit;
    }
    if (shading->occlusion || shading->ray_light) {
        burnish_occlude_batch(shading, batch, &points, scratch);
    }
    if (shading->texturing) {
        locate_textures(shading, batch, scratch->texture);
    }
    if (has_one_material(batch)) {
        const int material = batch->material ? batch->material[0] : 0;
        burnish_shade_layers(shading, batch, &points,
                             shading->texturing ? scratch->texture->points : NULL, material,
                             scratch, rgb);
        if (shading->occlusion) {
            burnish_add_bounces(shading, &points, batch->count, material, scratch->share.open,
                                scratch->texture, rgb);
        }
        burnish_keep_passed(shading, NULL, material, batch->count, scratch);
        if (shading->texturing && shading->texturing->materials[material].is_alpha) {
            memcpy(scratch->texture->alpha, scratch->texture->opacity,
                   sizeof scratch->texture->alpha);
            for (int s = 0; s < smooth_samples(shading, material, scratch); ++s) {
                memcpy(scratch->texture->covers[s], scratch->texture->cover[s],
                       (size_t)batch->count * sizeof *scratch->texture->covers[s]);
            }
        }
    } else if (shading->mixed_body != BURNISH_LOBE_BODY_NONE && !shading->area &&
               !shading->texturing && !points.first_light) {
        shading->kernels->shade_mixed[shading->mixed_body][shading->is_alike](
            shading->shaders, batch->material, &points, (size_t)batch->count, rgb);
        if (shading->occlusion) {
            burnish_add_bounces_mixed(shading, batch, scratch, rgb);
        }
    } else {
        shade_mixed(shading, batch, &points, scratch, rgb);
    }
    if (!shading->tones.is_linear) {
        shading->ops->map_tones(&shading->tones, (size_t)batch->count, rgb);
    }
}

void burnish_surface_begin_tile(const burnish_surface *surface, const burnish_tile *tile,
                                burnish_fragment_scratch *scratch) {
    const burnish_shading *shading = surface->shading;
    const burnish_near_field field = {shading->area, shading->kernels,
                                      shading->ops,  &shading->rays,
                                      surface->view, surface->triangle_materials};
    scratch->known.shader = NULL;
    if (shading->area && shading->area->near_lights.count > 0) {
        burnish_near_cells_make(&scratch->cells, &field, tile, &scratch->near);
    }
}

/* ---- Caps ---- */

/* Caps have no vertices, so they have this colour instead of vertex colours. */
#define CAP_COLOR 0.5f

/* ---- Simple pixels: attributes are in the tile's planes ---- */

/* The pixels of a row of blocks from its first one. */
#define BLOCK_X(x)                                                                                 \
    x, x + 1, x + 2, x + 3, x, x + 1, x + 2, x + 3, x, x + 1, x + 2, x + 3, x, x + 1, x + 2, x + 3
#define BLOCK_Y 0, 0, 0, 0, -1, -1, -1, -1, -2, -2, -2, -2, -3, -3, -3, -3
static const float PIXEL_X[BURNISH_BLOCK_ROW_PIXELS] = {
    BLOCK_X(0),  BLOCK_X(4),  BLOCK_X(8),  BLOCK_X(12), BLOCK_X(16), BLOCK_X(20),
    BLOCK_X(24), BLOCK_X(28), BLOCK_X(32), BLOCK_X(36), BLOCK_X(40), BLOCK_X(44),
    BLOCK_X(48), BLOCK_X(52), BLOCK_X(56), BLOCK_X(60)};
static const float PIXEL_Y[BURNISH_BLOCK_ROW_PIXELS] = {
    BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y,
    BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y, BLOCK_Y};
_Static_assert((int)BURNISH_BLOCK_ROW_PIXELS == 256 &&
                   (int)BURNISH_BLOCK_ROW_PIXELS <= (int)BURNISH_SHADE_BATCH,
               "a row of blocks is one batch");
_Static_assert((int)BURNISH_BATCH_STREAMS == 25 + (int)BURNISH_TEXTURE_STREAMS, "all streams fit");
_Static_assert((int)BURNISH_FRAGMENT_BATCH <= (int)BURNISH_SHADE_BATCH,
               "so is a group of fragments");

int burnish_find_materials(const burnish_surface *surface, const burnish_tile *tile,
                           burnish_block_run run, const burnish_block_row *pixels,
                           int32_t *material) {
    const burnish_primitive *primitives =
        tile->options.samples > 1 ? tile->primitives.primitives : NULL;
    const int32_t *ids = tile->buffer.ids + run.row * BURNISH_BLOCK_ROW_PIXELS + run.first;
    if (surface->triangle_count == 1) {
        for (int i = 0; i < run.end - run.first; ++i) {
            material[i] = surface->triangle_materials[0];
        }
        return 1;
    }
    return surface->shading->ops->find_materials(
        surface->triangle_materials, surface->triangle_count, ids, primitives,
        pixels->simple + run.first, (size_t)(run.end - run.first), material);
}

/* Whether all pixels of a block are simple, and show one triangle unless there is one sample. */
static int is_plain_block(const burnish_tile *tile, const int32_t *simple) {
    const int32_t first = tile->options.samples == 1 ? 0 : ~0;
    int32_t any = 0, different = 0;
    for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
        any |= simple[i];
        different |= simple[i] ^ simple[0];
    }
    return any >= 0 && (different & first) == 0;
}

/* The triangles of a run's pixels; complex pixels get the triangle of the pixel before. */
static void find_triangles(const burnish_tile *tile, burnish_block_run run,
                           const burnish_block_row *pixels, uint32_t *ids) {
    uint32_t last = 0;
    for (int block = run.first; block < run.end; block += BURNISH_BLOCK_PIXELS) {
        const int32_t *simple = pixels->simple + block;
        uint32_t *to = ids + (block - run.first);
        if (!is_plain_block(tile, simple)) {
            for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
                if (simple[i] >= 0) {
                    last = burnish_tile_id_and_facing(tile, run.row, block + i, simple[i]);
                }
                to[i] = last;
            }
            continue;
        }
        if (tile->options.samples == 1) {
            memcpy(to, tile->buffer.ids + run.row * BURNISH_BLOCK_ROW_PIXELS + block,
                   BURNISH_BLOCK_PIXELS * sizeof *to);
        } else {
            last = burnish_tile_id_and_facing(tile, run.row, block, simple[0]);
            for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
                to[i] = last;
            }
        }
        last = to[BURNISH_BLOCK_PIXELS - 1];
    }
}

burnish_screen_points burnish_row_points(const burnish_raster_view *view, const burnish_tile *tile,
                                         int number) {
    const int y = tile->y + number * BURNISH_BLOCK_SIZE;
    return (burnish_screen_points){.x = (float)(2 * tile->x + 1 - view->width) * 0.5f,
                                   .y = (float)(view->height - 2 * y - 1) * 0.5f,
                                   .x_offset = PIXEL_X,
                                   .y_offset = PIXEL_Y};
}

/* The batch of a run: its arrays are the tile's planes. */
static burnish_fragment_batch run_batch(const burnish_surface *surface, const burnish_tile *tile,
                                        burnish_block_run run) {
    const int start = run.row * BURNISH_BLOCK_ROW_PIXELS + run.first;
    const int has_colors = surface->attributes->has_colors;
    burnish_fragment_batch batch = {.count = run.end - run.first,
                                    .points = burnish_row_points(surface->view, tile, run.row)};
    batch.points.x_offset += run.first;
    batch.points.y_offset += run.first;
    batch.points.depth = tile->buffer.center_depths + start;
    for (int k = 0; k < 3; ++k) {
        batch.normal[k] = tile->buffer.planes[BURNISH_PLANE_X + k] + start;
        batch.color[k] = has_colors ? tile->buffer.planes[BURNISH_PLANE_R + k] + start : NULL;
    }
    if (needs_division(surface)) {
        batch.inverse_w = tile->buffer.planes[BURNISH_PLANE_W] + start;
    }
    return batch;
}

static void shade_run(const burnish_surface *surface, const burnish_tile *tile,
                      burnish_block_run run, burnish_fragment_scratch *scratch,
                      burnish_row_light *row) {
    burnish_fragment_batch batch = run_batch(surface, tile, run);
    float *const rgb[3] = {row->rgb[0] + run.first, row->rgb[1] + run.first,
                           row->rgb[2] + run.first};
    batch.first_pixel = run.row * BURNISH_BLOCK_ROW_PIXELS + run.first;
    batch.shown = row->pixels.simple + run.first;
    if (surface->triangle_materials) {
        batch.has_one_material =
            burnish_find_materials(surface, tile, run, &row->pixels, scratch->material + run.first);
        batch.material = scratch->material + run.first;
    }
    if (surface->shading->texturing || surface->shading->hollow_from > 0) {
        find_triangles(tile, run, &row->pixels, scratch->ids);
    }
    shade_batch(surface->shading, &batch, scratch, rgb);
}

void burnish_cap_block_row(const burnish_surface *surface, const burnish_tile *tile, int number,
                           burnish_row_light *row) {
    const burnish_raster_view *view = surface->view;
    float *const *planes = tile->buffer.planes;
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        const int pixel = number * BURNISH_BLOCK_ROW_PIXELS + i;
        const int x = tile->x + burnish_pixel_x(pixel), y = tile->y + burnish_pixel_y(pixel);
        const int simple = row->pixels.simple[i];
        row->hatch[i] = BURNISH_NO_CAP;
        if (simple < 0) {
            continue;
        }
        const uint32_t id = burnish_tile_id_and_facing(tile, number, i, simple);
        const burnish_cap *cap = burnish_caps_hold(surface->caps, id)
                                     ? burnish_caps_find(surface->caps, x + 0.5 - view->width * 0.5,
                                                         view->height * 0.5 - y - 0.5,
                                                         &tile->buffer.center_depths[pixel])
                                     : NULL;
        if (!cap) {
            continue;
        }
        const float inverse_w = needs_division(surface) ? planes[BURNISH_PLANE_W][pixel] : 1;
        for (int k = 0; k < 3; ++k) {
            planes[BURNISH_PLANE_X + k][pixel] = cap->normal[k] * inverse_w;
            if (surface->attributes->has_colors) {
                planes[BURNISH_PLANE_R + k][pixel] = CAP_COLOR * inverse_w;
            }
        }
        row->hatch[i] = burnish_cap_hatch(
            burnish_hatch_style(cap->number, surface->caps->regions, id >> 1), x, y);
    }
}

void burnish_shade_block_row(const burnish_surface *surface, const burnish_tile *tile, int number,
                             burnish_fragment_scratch *scratch, burnish_row_light *row) {
    const unsigned dirty = tile->buffer.dirty_blocks[number];
    for (int block = 0, end; block < BURNISH_TILE_BLOCKS; block = end + 1) {
        for (end = block; end < BURNISH_TILE_BLOCKS && dirty >> end & 1; ++end) {
        }
        if (end > block) {
            const burnish_block_run run = {number, block * BURNISH_BLOCK_PIXELS,
                                           end * BURNISH_BLOCK_PIXELS};
            shade_run(surface, tile, run, scratch, row);
        }
    }
    for (int i = 0; surface->caps && i < 3 * BURNISH_BLOCK_ROW_PIXELS; ++i) {
        const int k = i / BURNISH_BLOCK_ROW_PIXELS, at = i % BURNISH_BLOCK_ROW_PIXELS;
        row->rgb[k][at] *= burnish_cap_light(row->hatch[at], k);
    }
}

/* ---- Complex pixels: attributes are gathered ---- */

/* An attribute at barycentric weights. In perspective an attribute times 1/w is linear on the
 * screen. */
static burnish_float4 interpolate_attribute(const burnish_float4 *attribute, const uint32_t v[3],
                                            float weight1, float weight2) {
    const float weight0 = (1.0f - weight1) - weight2;
    return (attribute[v[0]] * weight0 + attribute[v[1]] * weight1) + attribute[v[2]] * weight2;
}

static burnish_float4 point_normal(const burnish_surface *surface,
                                   const burnish_fragments *fragments, int i) {
    const burnish_float4 own = surface->attributes->normals[fragments->primitives[i].vertices[0]];
    const float x = fragments->weight1[i], y = fragments->weight2[i];
    const float rest = 1.0f - (x * x + y * y);
    const burnish_disc_position at = {x, y, __builtin_sqrtf(rest > 0 ? rest : 0)};
    const float of_point[3] = {own[0], own[1], own[2]};
    float normal[3];
    burnish_point_normal(surface->points, of_point, &at, fragments->x[i], fragments->y[i], normal);
    const float scale = own[0] == 0 && own[1] == 0 && own[2] == 0 ? own[3] : 1.0f;
    return (burnish_float4){normal[0] * scale, normal[1] * scale, normal[2] * scale, own[3]};
}

static void gather_fragments(const burnish_surface *surface, burnish_fragments *fragments,
                             burnish_fragment_scratch *scratch) {
    const burnish_attributes *attributes = surface->attributes;
    for (int i = 0; i < fragments->count; ++i) {
        const burnish_primitive *primitive = &fragments->primitives[i];
        const float weight1 = fragments->weight1[i], weight2 = fragments->weight2[i];
        const float side = scratch->facing[i] = primitive->id_and_facing & 1 ? -1.0f : 1.0f;
        const burnish_float4 normal =
            surface->points
                ? point_normal(surface, fragments, i)
                : interpolate_attribute(attributes->normals, primitive->vertices, weight1, weight2);
        scratch->normal[0][i] = normal[0] * side;
        scratch->normal[1][i] = normal[1] * side;
        scratch->normal[2][i] = normal[2] * side;
        scratch->inverse_w[i] = normal[3];
        if (attributes->has_colors) {
            const burnish_float4 color =
                surface->points ? attributes->colors[primitive->vertices[0]]
                                : interpolate_attribute(attributes->colors, primitive->vertices,
                                                        weight1, weight2);
            scratch->color[0][i] = color[0];
            scratch->color[1][i] = color[1];
            scratch->color[2][i] = color[2];
        }
        if (surface->triangle_materials) {
            scratch->material[i] = surface->triangle_materials[primitive->id_and_facing >> 1];
        }
        scratch->ids[i] = primitive->id_and_facing;
    }
    for (int k = 0; k < 3; ++k) {
        clear_tail(scratch->normal[k], fragments->count);
        clear_tail(scratch->color[k], fragments->count);
    }
    memset(scratch->material + fragments->count, 0,
           (size_t)(padded_count(fragments->count) - fragments->count) * sizeof *scratch->material);
    clear_tail(fragments->x, fragments->count);
    clear_tail(fragments->y, fragments->count);
}

/* Replaces gathered fragments that are seen from inside by caps. */
static void cap_fragments(const burnish_surface *surface, const burnish_tile *tile,
                          burnish_fragments *fragments, burnish_fragment_scratch *scratch) {
    for (int i = 0; i < fragments->count; ++i) {
        const uint32_t id = fragments->primitives[i].id_and_facing;
        const int pixel = fragments->pixels[i];
        const burnish_cap *cap =
            burnish_caps_hold(surface->caps, id)
                ? burnish_caps_find(surface->caps, (double)fragments->x[i], (double)fragments->y[i],
                                    &fragments->depth[i])
                : NULL;
        for (int k = 0; cap && k < 3; ++k) {
            scratch->normal[k][i] = cap->normal[k] * scratch->inverse_w[i];
            scratch->color[k][i] = CAP_COLOR * scratch->inverse_w[i];
        }
        scratch->hatch[i] =
            cap ? burnish_cap_hatch(
                      burnish_hatch_style(cap->number, surface->caps->regions, id >> 1),
                      tile->x + burnish_pixel_x(pixel), tile->y + burnish_pixel_y(pixel))
                : BURNISH_NO_CAP;
    }
}

burnish_fragment_batch burnish_shade_fragments(const burnish_surface *surface,
                                               const burnish_tile *tile,
                                               burnish_fragments *fragments,
                                               burnish_fragment_scratch *scratch,
                                               float *const *rgb) {
    burnish_fragment_batch batch = {.count = fragments->count,
                                    .inverse_w = scratch->inverse_w,
                                    .pixels = fragments->pixels,
                                    .samples = surface->is_layers ? fragments->samples : NULL,
                                    .points = {0, 0, fragments->x, fragments->y, fragments->depth},
                                    .material =
                                        surface->triangle_materials ? scratch->material : NULL};
    for (int k = 0; k < 3; ++k) {
        batch.normal[k] = scratch->normal[k];
        batch.color[k] = surface->attributes->has_colors ? scratch->color[k] : NULL;
    }
    gather_fragments(surface, fragments, scratch);
    if (surface->caps) {
        cap_fragments(surface, tile, fragments, scratch);
    }
    if (rgb && surface->is_layers) {
        burnish_find_first_volumes(surface, fragments, scratch);
    }
    if (rgb) {
        shade_batch(surface->shading, &batch, scratch, rgb);
    }
    for (int k = 0; surface->caps && rgb && k < 3; ++k) {
        for (int i = 0; i < batch.count; ++i) {
            rgb[k][i] *= burnish_cap_light(scratch->hatch[i], k);
        }
    }
    return batch;
}

float burnish_fragment_alpha(const burnish_attributes *attributes,
                             const burnish_fragments *fragments, int i) {
    const uint32_t *v = fragments->primitives[i].vertices;
    const float weight1 = fragments->weight1[i], weight2 = fragments->weight2[i];
    const burnish_float4 color = interpolate_attribute(attributes->colors, v, weight1, weight2);
    const burnish_float4 normal = interpolate_attribute(attributes->normals, v, weight1, weight2);
    return color[3] / normal[3];
}
