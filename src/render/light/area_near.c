#include "render/light/area_near.h"

#include <string.h>

#include "core/numbers.h"
#include "core/vector.h"
#include "environment/lobes.h"

/* ---- A frame ---- */

/* The corners of a rectangle or, for a disc, of a polygon of its area. */
static void find_corners(const burnish_area_light *light, burnish_kernels_polygon *polygon) {
    const int is_rect = light->shape == BURNISH_AREA_RECT;
    const int count = is_rect ? 4 : BURNISH_POLYGON_VERTEX_MAX;
    const burnish_vec3 center = burnish_vec3_load(light->center);
    double sine, cosine, size;
    burnish_sincos(2 * BURNISH_PI / count, &sine, &cosine);
    size = is_rect ? burnish_sqrt(2) : burnish_sqrt(2 * BURNISH_PI / (count * sine));
    polygon->vertex_count = count;
    for (int i = 0; i < count; ++i) {
        burnish_sincos(2 * BURNISH_PI * (i + 0.5) / count, &sine, &cosine);
        const burnish_vec3 u = burnish_vec3_scale(burnish_vec3_load(light->half_u), size * cosine);
        const burnish_vec3 v = burnish_vec3_scale(burnish_vec3_load(light->half_v), size * sine);
        const burnish_vec3 corner = burnish_vec3_add(center, burnish_vec3_add(u, v));
        polygon->vertices[i][0] = (float)corner.x;
        polygon->vertices[i][1] = (float)corner.y;
        polygon->vertices[i][2] = (float)corner.z;
    }
}

void burnish_near_lights_add(burnish_near_lights *lights, const burnish_area_light *light) {
    burnish_polygon_constants made;
    burnish_kernels_polygon *polygon = &lights->shapes[lights->count];
    *polygon = burnish_kernels_polygon_default();
    polygon->is_two_sided = light->is_two_sided;
    polygon->lobe_count = 0;
    find_corners(light, polygon);
    if (burnish_polygon_constants_make(polygon, &made, NULL) == BURNISH_STATUS_OK) {
        memcpy(lights->color[lights->count], light->color, sizeof light->color);
        lights->count += 1;
    }
}

burnish_status burnish_near_lights_prepare(burnish_near_lights *lights, const float *alphas,
                                           int alpha_count, burnish_memory *memory) {
    const size_t count = (size_t)lights->count * ((size_t)alpha_count + 1);
    burnish_status status;
    lights->polygons = burnish_reserve_discard(memory, lights->polygons, &lights->polygon_capacity,
                                               count, sizeof *lights->polygons, "area lights");
    status = memory->status;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        const int alpha = (int)i / lights->count - 1;
        burnish_kernels_polygon polygon = lights->shapes[i % (size_t)lights->count];
        if (alpha >= 0) {
            const burnish_light_lobes lobes = burnish_light_lobes_for(alphas[alpha]);
            polygon.lobe_count = lobes.count;
            for (int j = 0; j < lobes.count; ++j) {
                const burnish_light_lobe *lobe = &lobes.lobe[j];
                polygon.lobes[j] = (burnish_kernels_lobe){lobe->order, lobe->zeta, lobe->weight};
            }
        }
        status = burnish_polygon_constants_make(&polygon, &lights->polygons[i], memory->error);
    }
    return status;
}

void burnish_near_lights_destroy(burnish_near_lights *lights, const burnish_context *context) {
    burnish_release(context, lights->polygons);
    memset(lights, 0, sizeof *lights);
}

/* ---- Points ---- */

static void add_colored(const float color[3], const float *light, int count,
                        float (*sum)[BURNISH_NEAR_BATCH]) {
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            sum[k][i] += color[k] * light[i];
        }
    }
}

/* The two levels next to the roughness of each point count, by their distance from it. */
static void weigh(const burnish_near_batch *batch, int level, float *light) {
    const float steps = (float)(batch->level_count - 1);
    for (int i = 0; i < batch->count; ++i) {
        const float distance = batch->roughness[i] * steps - (float)level;
        const float weight = 1 - (distance < 0 ? -distance : distance);
        light[i] = weight > 0 ? light[i] * weight : 0;
    }
}

/* The levels next to the roughness of some point: [first, end). */
static void find_levels(const burnish_near_batch *batch, int *first, int *end) {
    const float steps = (float)(batch->level_count - 1);
    float least = 1, most = 0;
    for (int i = 0; i < batch->count; ++i) {
        const float r = batch->roughness[i];
        least = r < least ? r : least;
        most = r > most ? r : most;
    }
    *first = least > 0 ? (int)(least * steps) : 0;
    *end = (most < 1 ? (int)(most * steps) : batch->level_count - 2) + 2;
}

void burnish_near_lights_shine(const burnish_near_lights *lights, const burnish_kernels *kernels,
                               const burnish_near_batch *batch, burnish_near_scratch *scratch) {
    const burnish_kernels_axes axes = {
        .axis = {scratch->axis[0], scratch->axis[1], scratch->axis[2]}};
    const size_t count = (size_t)batch->count;
    int first = batch->alpha, end = batch->alpha + 1;
    memset(scratch->diffuse, 0, sizeof scratch->diffuse);
    memset(scratch->specular, 0, sizeof scratch->specular);
    if (batch->level_count > 0) {
        find_levels(batch, &first, &end);
        first += batch->alpha;
        end += batch->alpha;
    }
    for (int l = 0; l < lights->count; ++l) {
        const burnish_polygon_constants *polygon = &lights->polygons[l];
        for (int i = first; i < end || i == first; ++i) {
            /* lobes are in the row after the alpha's number; diffuse light once */
            float *const light[2] = {i == first ? scratch->light[0] : NULL,
                                     batch->alpha < 0 ? NULL : scratch->light[1]};
            kernels->polygon_light(polygon + (i + 1) * lights->count, batch->points, &axes, count,
                                   light);
            if (i == first) {
                add_colored(lights->color[l], light[0], batch->count, scratch->diffuse);
            }
            if (batch->level_count > 0) {
                weigh(batch, i - batch->alpha, scratch->light[1]);
            }
            if (light[1]) {
                add_colored(lights->color[l], light[1], batch->count, scratch->specular);
            }
        }
    }
}
