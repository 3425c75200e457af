#include "render/frame/target.h"

#include <string.h>

int burnish_codes_are_direct(const burnish_surface *surface, const burnish_output *output) {
    const burnish_shading *shading = surface->shading;
    const burnish_target *target = &output->target;
    const int has_bytes =
        target->pixels.pixels && target->pixels.format != BURNISH_PIXELS_RGBA_FLOAT;
    const int has_more = surface->attributes->has_colors || surface->transparency ||
                         surface->caps || output->has_planes || output->ground ||
                         output->backdrop || output->outline;
    return output->samples == 1 && has_bytes && !has_more && shading->tones.is_linear &&
           !shading->texturing && !shading->area && !shading->occlusion && !shading->shadow &&
           shading->mixed_body != BURNISH_LOBE_BODY_NONE;
}

int32_t burnish_codes_of_face(void *coder, const float normal[3]) {
    burnish_face_coder *from = coder;
    return from->ops->face_code[from->shader->lobe.body](from->shader, from->encoder, normal,
                                                         &from->known);
}

/* The codes of a run of pixels. */
static void shade_run(const burnish_surface *surface, const burnish_output *output,
                      const burnish_tile *tile, burnish_block_run run,
                      burnish_fragment_scratch *scratch, burnish_row_light *row, uint32_t *codes) {
    const burnish_shading *shading = surface->shading;
    const size_t start = (size_t)(run.row * BURNISH_BLOCK_ROW_PIXELS + run.first);
    const size_t count = (size_t)(run.end - run.first);
    float *const *planes = tile->buffer.planes;
    const burnish_code_batch batch = {.normal = {planes[BURNISH_PLANE_X] + start,
                                                 planes[BURNISH_PLANE_Y] + start,
                                                 planes[BURNISH_PLANE_Z] + start},
                                      .depths = tile->buffer.depths + start,
                                      .encoder = output->encoder,
                                      .alpha = output->alpha,
                                      .background = output->background_code,
                                      .known = &scratch->known,
                                      .has_codes = tile->options.has_codes,
                                      .codes = codes + run.first};
    int32_t *materials = scratch->material + run.first;
    if (surface->triangle_materials &&
        !burnish_find_materials(surface, tile, run, &row->pixels, materials)) {
        float *const rgb[3] = {row->rgb[0] + run.first, row->rgb[1] + run.first,
                               row->rgb[2] + run.first};
        const float *const light[3] = {rgb[0], rgb[1], rgb[2]};
        const burnish_kernels_points points = {
            .normal = {batch.normal[0], batch.normal[1], batch.normal[2]}};
        shading->kernels->shade_mixed[shading->mixed_body][shading->is_alike](
            shading->shaders, materials, &points, count, rgb);
        output->ops->encode_pixels(output->encoder, count, light, row->pixels.simple + run.first,
                                   output->alpha, output->background_code, codes + run.first);
        return;
    }
    const burnish_kernels_shader *shader =
        &shading->shaders[surface->triangle_materials ? materials[0] : 0];
    output->ops->shade_codes[shader->lobe.body](shader, &batch, count);
}

void burnish_codes_shade_row(const burnish_surface *surface, const burnish_output *output,
                             const burnish_tile *tile, int number,
                             burnish_fragment_scratch *scratch, burnish_row_light *row,
                             uint32_t *codes) {
    const unsigned dirty = tile->buffer.dirty_blocks[number];
    for (int block = 0, end; block < BURNISH_TILE_BLOCKS; block = end) {
        const unsigned is_dirty = dirty >> block & 1;
        for (end = block + 1; end < BURNISH_TILE_BLOCKS && (dirty >> end & 1) == is_dirty; ++end) {
        }
        const burnish_block_run run = {number, block * BURNISH_BLOCK_PIXELS,
                                       end * BURNISH_BLOCK_PIXELS};
        if (is_dirty) {
            shade_run(surface, output, tile, run, scratch, row, codes);
        }
        for (int i = run.first; i < run.end && !is_dirty; ++i) {
            codes[i] = output->background_code;
        }
    }
}
