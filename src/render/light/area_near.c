#include "render/light/area_near.h"

#include <string.h>

#include "environment/areas.h"

/* ---- A frame ---- */

void burnish_near_lights_add(burnish_near_lights *lights, const burnish_area_light *light) {
    burnish_polygon_constants polygon;
    if (burnish_area_polygon(light, NULL, &polygon)) {
        lights->lights[lights->count++] = *light;
    }
}

burnish_status burnish_near_lights_prepare(burnish_near_lights *lights, const float *alphas,
                                           int alpha_count, burnish_memory *memory) {
    const size_t count = (size_t)lights->count;
    lights->polygons = burnish_reserve_discard(memory, lights->polygons, &lights->polygon_capacity,
                                               count * ((size_t)alpha_count + 1),
                                               sizeof *lights->polygons, "area lights");
    for (size_t i = 0; lights->polygons && i < count * ((size_t)alpha_count + 1); ++i) {
        const burnish_area_light *light = &lights->lights[i % count];
        const burnish_light_lobes lobes =
            burnish_light_lobes_for(i < count ? 1 : alphas[i / count - 1]);
        burnish_area_polygon(light, i < count ? NULL : &lobes, &lights->polygons[i]);
    }
    return memory->status;
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

static void cast_shadow(const float *lit, int count, float *light) {
    for (int i = 0; i < count; ++i) {
        light[i] *= lit[i];
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
            for (int k = 0; l == lights->key && batch->points->first_light && k < 2; ++k) {
                if (light[k]) {
                    cast_shadow(batch->points->first_light, batch->count, light[k]);
                }
            }
            if (i == first) {
                add_colored(lights->lights[l].color, light[0], batch->count, scratch->diffuse);
            }
            if (batch->level_count > 0) {
                weigh(batch, i - batch->alpha, scratch->light[1]);
            }
            if (light[1]) {
                add_colored(lights->lights[l].color, light[1], batch->count, scratch->specular);
            }
        }
    }
}
