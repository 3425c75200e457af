/* Materials and a lobe become what shaders are folded from. */
#ifndef BURNISH_RENDER_MATERIALS_H
#define BURNISH_RENDER_MATERIALS_H

#include "burnish/render.h"
#include "shading/shader_table.h"

/* Kept from frame to frame. All zero before the first. */
typedef struct burnish_materials {
    burnish_shade_material *items; /* one per material of the mesh */
    size_t capacity;
} burnish_materials;

/* fallbacks gets how many materials were given a lower order than the lobe's because their exponent
 * allows no more. Errors: MEMORY. */
burnish_status burnish_materials_update(burnish_materials *materials, const burnish_mesh *mesh,
                                        const burnish_render_options *options, size_t *fallbacks,
                                        burnish_memory *memory);

#endif
