#include "render/light/area.h"

#include <string.h>

#include "environment/area_lights.h"

/* ---- A frame ---- */

void burnish_near_lights_add(burnish_near_lights *lights, const burnish_area_light *light) {
    burnish_polygon_constants polygon;
    if (burnish_area_polygon(light, NULL, &polygon)) {
        lights->lights[lights->count++] = *light;
    }
}

burnish_status burnish_near_lights_prepare(burnish_near_lights *lights, const float *alphas,
                                           int alpha_count, burnish_memory *memory) {
    const size_t count = (size_t)lights->count, rows = 2 * (size_t)alpha_count + 1;
    lights->alpha_count = alpha_count;
    lights->polygons =
        burnish_reserve_discard(memory, lights->polygons, &lights->polygon_capacity, count * rows,
                                sizeof *lights->polygons, "area lights");
    for (size_t i = 0; lights->polygons && i < count * rows; ++i) {
        const burnish_area_light *light = &lights->lights[i % count];
        const size_t row = i / count, stretched = (size_t)alpha_count;
        const float alpha = row > 0 ? alphas[(row - 1) % stretched] : 1;
        const burnish_light_lobes lobes = row > stretched && !light->is_distant
                                              ? burnish_light_lobes_near(alpha)
                                              : burnish_light_lobes_for(alpha);
        burnish_area_polygon(light, row > 0 ? &lobes : NULL, &lights->polygons[i]);
    }
    return memory->status;
}

void burnish_near_lights_destroy(burnish_near_lights *lights, const burnish_context *context) {
    burnish_release(context, lights->polygons);
    memset(lights, 0, sizeof *lights);
}

/* ---- Points ---- */

static void add_scaled(float scale, const float *light, int count, float *sum) {
    for (int i = 0; i < count; ++i) {
        sum[i] += scale * light[i];
    }
}

/* The two levels next to the roughness of each point count, by their distance from it. */
static void weigh_levels(const burnish_near_batch *batch, int level, float *light) {
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

int burnish_near_lights_row(const burnish_near_lights *lights, int alpha, int is_stretched) {
    return alpha < 0 ? 0 : (1 + alpha + (is_stretched ? lights->alpha_count : 0)) * lights->count;
}

/* Adds one light: diffuse light once, specular light for each alpha [first, end). */
static void add_light(const burnish_near_lights *lights, const burnish_kernels *kernels,
                      const burnish_near_batch *batch, int number, const int alphas[2],
                      burnish_near_scratch *scratch, float (*values)[BURNISH_NEAR_BATCH]) {
    const burnish_area_light *light = &lights->lights[number];
    const int leans = batch->is_stretched && !light->is_distant;
    float(*const axis)[BURNISH_NEAR_BATCH] = leans ? scratch->leaned : scratch->axis;
    burnish_kernels_axes axes = {.axis = {axis[0], axis[1], axis[2]}};
    for (int k = 0; k < 3 && leans; ++k) {
        axes.stretch[k] = axis[3 + k];
    }
    for (int i = alphas[0]; i < alphas[1]; ++i) {
        const int row = burnish_near_lights_row(lights, i, batch->is_stretched);
        float *const out[2] = {i == alphas[0] && !batch->only_specular ? scratch->light[0] : NULL,
                               batch->alpha < 0 ? NULL : scratch->light[1]};
        kernels->polygon_light(&lights->polygons[row + number], batch->points, &axes,
                               (size_t)batch->count, out);
        if (batch->level_count > 0) {
            weigh_levels(batch, i - batch->alpha, scratch->light[1]);
        }
        for (int k = 0; k < 2; ++k) {
            if (out[k] && number == lights->key) {
                add_scaled(1, out[k], batch->count, values[BURNISH_NEAR_KEY_DIFFUSE + k]);
            }
            for (int j = 0; out[k] && number != lights->key && j < 3; ++j) {
                add_scaled(light->color[j], out[k], batch->count, values[3 * k + j]);
            }
        }
    }
}

void burnish_near_lights_shine(const burnish_near_lights *lights, const burnish_kernels *kernels,
                               const burnish_near_batch *batch, burnish_near_scratch *scratch,
                               float (*values)[BURNISH_NEAR_BATCH]) {
    int alphas[2] = {batch->alpha, batch->alpha + 1};
    for (int k = 0; k < BURNISH_NEAR_VALUES; ++k) {
        memset(values[k], 0, (size_t)batch->count * sizeof *values[k]);
    }
    if (batch->level_count > 0) {
        find_levels(batch, &alphas[0], &alphas[1]);
        alphas[0] += batch->alpha;
        alphas[1] += batch->alpha;
    }
    for (int l = 0; l < lights->count; ++l) {
        add_light(lights, kernels, batch, l, alphas, scratch, values);
    }
}

void burnish_near_lights_add_key(const burnish_near_lights *lights, const float *lit, int count,
                                 float (*values)[BURNISH_NEAR_BATCH]) {
    for (int k = 0; lights->key >= 0 && k < 2; ++k) {
        const float *color = lights->lights[lights->key].color;
        float *key = values[BURNISH_NEAR_KEY_DIFFUSE + k];
        for (int i = 0; lit && i < count; ++i) {
            key[i] *= lit[i];
        }
        for (int j = 0; j < 3; ++j) {
            add_scaled(color[j], key, count, values[3 * k + j]);
        }
    }
}

void burnish_area_add_white(const burnish_area *area, const burnish_kernels *kernels,
                            const burnish_kernels_points *points, int count, float *const rgb[3]) {
    static const burnish_reflecting_material white = {.diffuse = {1, 1, 1}, .roughness = 1};
    const burnish_reflecting_points each = {.open = NULL};
    const burnish_kernels_axes axes = {{points->normal[0], points->normal[1], points->normal[2]},
                                       {NULL}};
    kernels->add_environment(&area->constants, &white, points, &each, (size_t)count, rgb);
    for (int l = 0; l < area->near_lights.count; ++l) {
        float light[BURNISH_NEAR_BATCH];
        const float *lit = l == area->near_lights.key ? points->first_light : NULL;
        kernels->polygon_light(&area->near_lights.polygons[l], points, &axes, (size_t)count,
                               (float *const[2]){light, NULL});
        for (int i = 0; i < 3 * count; ++i) {
            const float share = lit ? lit[i / 3] : 1;
            rgb[i % 3][i / 3] += area->near_lights.lights[l].color[i % 3] * light[i / 3] * share;
        }
    }
}
