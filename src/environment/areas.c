#include "environment/areas.h"

#include "base/numbers.h"
#include "core/vector.h"

static void find_corners(const burnish_area_light *light, burnish_kernels_polygon *polygon) {
    const int is_rect = light->shape == BURNISH_AREA_RECT;
    const int count = is_rect ? 4 : BURNISH_POLYGON_VERTEX_MAX;
    const burnish_vec3 center = burnish_vec3_load(light->center);
    const double scale = light->is_distant ? 1 / burnish_vec3_length(center) : 1;
    double sine, cosine, size;
    burnish_sincos(2 * BURNISH_PI / count, &sine, &cosine);
    size = is_rect ? burnish_sqrt(2) : burnish_sqrt(2 * BURNISH_PI / (count * sine));
    polygon->vertex_count = count;
    for (int i = 0; i < count; ++i) {
        burnish_sincos(2 * BURNISH_PI * (i + 0.5) / count, &sine, &cosine);
        const burnish_vec3 u = burnish_vec3_scale(burnish_vec3_load(light->half_u), size * cosine);
        const burnish_vec3 v = burnish_vec3_scale(burnish_vec3_load(light->half_v), size * sine);
        const burnish_vec3 corner = burnish_vec3_add(center, burnish_vec3_add(u, v));
        polygon->vertices[i][0] = (float)(corner.x * scale);
        polygon->vertices[i][1] = (float)(corner.y * scale);
        polygon->vertices[i][2] = (float)(corner.z * scale);
    }
}

int burnish_area_polygon(const burnish_area_light *light, const burnish_light_lobes *lobes,
                         burnish_polygon_constants *polygon) {
    burnish_kernels_polygon shape = burnish_kernels_polygon_default();
    shape.is_distant = light->is_distant;
    shape.is_two_sided = light->is_two_sided;
    shape.lobe_count = lobes ? lobes->count : 0;
    for (int j = 0; j < shape.lobe_count; ++j) {
        const burnish_light_lobe *lobe = &lobes->lobe[j];
        shape.lobes[j] = (burnish_kernels_lobe){lobe->order, lobe->zeta, lobe->weight};
    }
    find_corners(light, &shape);
    return burnish_polygon_constants_make(&shape, polygon, NULL) == BURNISH_STATUS_OK;
}
