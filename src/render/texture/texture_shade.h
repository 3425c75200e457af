/* The light of points whose material has textures. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_SHADE_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_SHADE_H

#include "render/texture/texture.h"

/* Light of `count` points of one special material.
 *   shader   of the material
 *   streams  BURNISH_TEXTURE_STREAMS arrays of the points
 *   rgb      receives linear light, >= 0; NULL: only opacity is wanted
 *   scratch  opacity becomes what the material's textures leave of its opacity, [0, 1]; where its
 *            mask is smoothed 1, and cover what the mask leaves of each sample */
void burnish_texture_shade(const burnish_texturing *texturing, const burnish_render_ops *ops,
                           const burnish_kernels_shader *shader, int material,
                           const burnish_kernels_points *points, const float *const *streams,
                           int count, burnish_texture_scratch *scratch, float *const rgb[3]);

#endif
