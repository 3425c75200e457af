/* A frame's materials, each folded with the lights, once per frame. */
#ifndef BURNISH_SHADING_SHADER_TABLE_H
#define BURNISH_SHADING_SHADER_TABLE_H

#include "core/memory.h"
#include "shading/shader.h"

/* A material and its lobe, before they are folded with the lights. */
typedef struct burnish_shade_material {
    burnish_material material;
    burnish_lobe_spec lobe;
} burnish_shade_material;

/* Owned. All zero before the first frame, a later frame uses the arrays again. */
typedef struct burnish_shader_table {
    burnish_kernels_shader *shaders; /* one per material */
    burnish_light_constants *lights; /* light_count per shader */
    size_t shader_capacity, light_capacity;
} burnish_shader_table;

/* One shader per material. lighting's own material and lobe are not read.
 * Errors: ARGUMENT where one of them can't be shaded, MEMORY. */
burnish_status burnish_shader_table_update(burnish_shader_table *table,
                                           const burnish_kernels_lighting *lighting,
                                           const burnish_shade_material *materials, size_t count,
                                           burnish_memory *memory);
void burnish_shader_table_destroy(burnish_shader_table *table, const burnish_context *context);

#endif
