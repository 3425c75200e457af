/* The light of points whose material has textures. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_SHADE_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_SHADE_H

#include "render/texture/texture.h"

/* Light of a batch.
 *   shader  of the batch's material
 *   rgb     receives linear light, >= 0; NULL: only opacity is wanted
 * The batch's scratch receives in opacity what the material's textures leave of its opacity, [0,
 * 1]; if its mask is smoothed 1, and in cover what the mask leaves of each sample. */
void burnish_texture_shade(const burnish_texturing *texturing, const burnish_kernels_shader *shader,
                           const burnish_kernels_points *points, const burnish_texture_batch *batch,
                           float *const rgb[3]);

#endif
