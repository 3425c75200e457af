/* Materials and a lobe choice become what the shading kernels take. */
#ifndef BURNISH_RENDER_MATERIALS_H
#define BURNISH_RENDER_MATERIALS_H

#include "burnish/render.h"
#include "shading/shade.h"

/* One shade material a scene material, in *materials (released with free()). fallbacks gets how
 * many were given a lower order than the choice's because their exponent allows no more. */
burnish_status burnish_materials_create(const burnish_mesh *scene,
                                        const burnish_render_options *options,
                                        burnish_shade_material **materials, size_t *fallbacks,
                                        burnish_error *error);

#endif
