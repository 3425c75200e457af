#include "shading/shader_table.h"

#include <string.h>

burnish_status burnish_shader_table_update(burnish_shader_table *table,
                                           const burnish_kernels_lighting *lighting,
                                           const burnish_shade_material *materials, size_t count,
                                           burnish_memory *memory) {
    burnish_status status = burnish_lighting_check(lighting, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t lights = (size_t)lighting->light_count;
    table->shaders = burnish_reserve_discard(memory, table->shaders, &table->shader_capacity, count,
                                             sizeof *table->shaders, "shaders");
    table->lights = burnish_reserve_discard(memory, table->lights, &table->light_capacity,
                                            count * lights, sizeof *table->lights, "lights");
    status = memory->status;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = burnish_shader_fold(lighting, &materials[i].material, &materials[i].lobe,
                                     lights ? table->lights + i * lights : NULL, &table->shaders[i],
                                     memory->error);
    }
    return status;
}

void burnish_shader_table_destroy(burnish_shader_table *table, const burnish_context *context) {
    burnish_release(context, table->shaders);
    burnish_release(context, table->lights);
    memset(table, 0, sizeof *table);
}
