#include "render/light/maps/shadow.h"

#include <string.h>

#include "render/space.h"

/* In texels: the offset of points from the surface, which keeps it from shadowing itself, and the
 * radius of the filter, for an area light the one with the least error (test_shadow.c). */
#define OFFSET 2.0
#define RADIUS 2.5f
#define AREA_RADIUS 6.0f

static burnish_status draw_shadow_map(burnish_shadow *shadow, burnish_map_drawer *drawer,
                                      const burnish_mesh_view *mesh, const burnish_map_view *view,
                                      burnish_tasks *tasks, burnish_memory *memory) {
    const size_t texels = (size_t)view->size * (size_t)view->size;
    shadow->mesh = 0;
    shadow->depths = burnish_reserve_discard(memory, shadow->depths, &shadow->capacity, texels,
                                             sizeof *shadow->depths, "the shadow's depth map");
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = burnish_map_draw(drawer, mesh, view, shadow->depths, tasks, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        shadow->mesh = mesh->serial;
        shadow->max_overdraw = drawer->max_overdraw;
        shadow->toward = view->toward;
        shadow->size = view->size;
    }
    return status;
}

burnish_status burnish_shadow_update(burnish_shadow *shadow, burnish_map_drawer *drawer,
                                     const burnish_mesh_view *mesh,
                                     const burnish_shadow_options *options, burnish_tasks *tasks,
                                     burnish_memory *memory, burnish_shadow_lookup *lookup) {
    const burnish_vec3 toward = options->toward;
    const int size = options->size;
    const burnish_map_view view = burnish_map_view_make(toward, burnish_space_across(toward), size);
    const burnish_vec3 turned = burnish_vec3_sub(shadow->toward, toward);
    burnish_status status = BURNISH_STATUS_OK;
    if (shadow->mesh != mesh->serial || shadow->size != size ||
        shadow->max_overdraw > drawer->max_overdraw || burnish_vec3_length(turned) > 0) {
        status = draw_shadow_map(shadow, drawer, mesh, &view, tasks, memory);
    }
    lookup->map = burnish_map_rows_make(&view, options->eye);
    burnish_space_store(toward, lookup->toward);
    lookup->depths = shadow->depths;
    lookup->size = size;
    lookup->offset = (float)(OFFSET / view.texels);
    lookup->slope = (float)(BURNISH_MAP_RANGE * view.texels / BURNISH_MAP_CODES);
    lookup->plane = (float)burnish_map_plane(&view);
    lookup->radius = options->is_area ? AREA_RADIUS : RADIUS;
    return status;
}

void burnish_shadow_destroy(burnish_shadow *shadow, const burnish_context *context) {
    burnish_release(context, shadow->depths);
    memset(shadow, 0, sizeof *shadow);
}
