/* Texture coordinates of visible points. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_POINTS_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_POINTS_H

#include "render/texture/texture.h"

/* To be called before the first point of a frame: forgets the last frame's triangles. */
void burnish_texture_begin(burnish_texture_scratch *scratch);

/* Fills scratch->points for scratch->ids; points whose material needs none get some numbers.
 *   materials  of points; NULL: all have material 0 */
void burnish_texture_locate(const burnish_texturing *texturing, const burnish_rays *rays,
                            const burnish_screen_points *points, const int32_t *materials,
                            int count, burnish_texture_scratch *scratch);

#endif
