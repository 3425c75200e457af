/* The depth maps of ambient occlusion: their directions, and when they are drawn. */
#include "render/occlusion.h"

#include <string.h>

#include "render/space.h"

/* How far points are moved off the surface, in texels: less makes a curved surface hide itself,
 * more opens creases. */
#define OFFSET 2.5

/* The sky below is this bright where above it is 1. */
#define DARK_SKY 0.35

/* Point i of a spherical Fibonacci set. */
static burnish_map_view map_view(int i, int count, int size) {
    const double golden_angle = 2.39996322972865332;
    const double z = 1 - (2.0 * i + 1) / count, radius = burnish_sqrt(1 - z * z);
    double sine, cosine;
    burnish_sincos(golden_angle * i, &sine, &cosine);
    return burnish_map_view_make((burnish_vec3){radius * cosine, radius * sine, z},
                                 (burnish_vec3){-sine, cosine, 0}, /* no point is a pole */
                                 size);
}

/* As many directions as do not show as silhouettes where a mesh is smooth and small, and as few as
 * do not take too long where it is large: those are rough. */
static int choose_count(const burnish_mesh_view *mesh) {
    static const struct {
        size_t triangles;
        int count;
    } steps[] = {{40000, 128}, {131072, 48}, {524288, 32}, {2097152, 24}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
        if (mesh->triangle_count <= steps[i].triangles) {
            return steps[i].count;
        }
    }
    return 16;
}

static burnish_status draw_maps(burnish_occlusion *occlusion, const burnish_isa_ops *ops,
                                const burnish_mesh_view *mesh, int count, int size,
                                burnish_tasks *tasks, burnish_memory *memory) {
    const size_t texels = (size_t)size * (size_t)size;
    occlusion->mesh = 0;
    occlusion->depths =
        burnish_reserve_discard(memory, occlusion->depths, &occlusion->capacity,
                                (size_t)count * texels, sizeof *occlusion->depths, "depth maps");
    burnish_status status = memory->status;
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_map_view view = map_view(i, count, size);
        status = burnish_map_draw(&occlusion->drawer, ops, mesh, &view,
                                  occlusion->depths + (size_t)i * texels, tasks, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        occlusion->mesh = mesh->serial;
        occlusion->count = count;
        occlusion->size = size;
    }
    return status;
}

burnish_status burnish_occlusion_update(burnish_occlusion *occlusion, const burnish_isa_ops *ops,
                                        const burnish_mesh_view *mesh, int wanted, int size,
                                        const double eye[3], const double up[3],
                                        burnish_tasks *tasks, burnish_memory *memory,
                                        burnish_occlusion_lookup *lookup) {
    const int count = wanted == BURNISH_OCCLUSION_AUTO ? choose_count(mesh) : wanted;
    double texels = 1;
    if (occlusion->mesh != mesh->serial || occlusion->count != count || occlusion->size != size) {
        burnish_status status = draw_maps(occlusion, ops, mesh, count, size, tasks, memory);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    for (int i = 0; i < count; ++i) {
        const burnish_map_view view = map_view(i, count, size);
        burnish_occlusion_direction *direction = &occlusion->directions[i];
        texels = view.texels;
        direction->map = burnish_map_rows_make(&view, eye);
        burnish_space_store(view.toward, direction->toward);
        const double height =
            burnish_vec3_dot(burnish_vec3_loadf(direction->toward), burnish_vec3_load(up));
        direction->weight = (float)(DARK_SKY + (1 - DARK_SKY) * (0.5 + 0.5 * height));
        direction->depths = occlusion->depths + (size_t)i * (size_t)size * (size_t)size;
    }
    lookup->count = count;
    lookup->size = size;
    lookup->directions = occlusion->directions;
    lookup->offset = (float)(OFFSET * (1 / texels));
    lookup->slope = (float)(BURNISH_MAP_RANGE / (BURNISH_MAP_CODES * (1 / texels)));
    return BURNISH_STATUS_OK;
}

void burnish_occlusion_destroy(burnish_occlusion *occlusion, const burnish_context *context) {
    burnish_map_drawer_destroy(&occlusion->drawer, context);
    burnish_release(context, occlusion->depths);
    memset(occlusion, 0, sizeof *occlusion);
}
