/* The Phong equation for a block of visible points, by the kernels, a run of one material after
 * another. */
#include "shading/shade.h"

#include "shading/interpolate.h"

/* Places from the eye, times w. */
typedef struct block_places {
    float position[3][BURNISH_FRAGMENT_BATCH];
    float w[BURNISH_FRAGMENT_BATCH];
} block_places;

static void locate(const burnish_rays *view, const burnish_fragments *fragments,
                   block_places *places) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < fragments->count; ++i) {
            places->position[axis][i] = ((view->ray[axis] + fragments->x[i] * view->ray_x[axis]) +
                                         fragments->y[i] * view->ray_y[axis]) +
                                        (1.0f - fragments->depth[i]) * view->ray_depth[axis];
        }
    }
    for (int i = 0; i < fragments->count; ++i) {
        places->w[i] = fragments->depth[i] * view->q_per_depth + view->q_constant;
    }
}

static int run_end(const burnish_points *points, int first) {
    int end = first + 1;
    while (end < points->count && points->material[end] == points->material[first]) {
        ++end;
    }
    return end;
}

static burnish_status prepare(const burnish_shader *shader, size_t index,
                              burnish_kernels_shader *prepared, burnish_error *error) {
    const burnish_shade_material *material = &shader->materials[index];
    burnish_kernels_lighting lighting = shader->lighting;
    lighting.material = material->material;
    lighting.lobe = material->lobe;
    return burnish_kernels_prepare(&lighting, prepared, error);
}

burnish_status burnish_shader_check(const burnish_shader *shader, size_t material_count,
                                    burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    burnish_kernels_shader prepared;
    for (size_t i = 0; i < material_count && status == BURNISH_STATUS_OK; ++i) {
        status = prepare(shader, i, &prepared, error);
    }
    return status;
}

void burnish_shade_prepare(const burnish_shader *shader, int material, burnish_shade_cache *cache) {
    if (cache->material != material) {
        (void)prepare(shader, (size_t)material, &cache->prepared, NULL); /* checked before */
        cache->material = material;
    }
}

void burnish_shade(const burnish_shader *shader, burnish_shade_cache *cache,
                   const burnish_fragments *fragments, burnish_shaded *shaded) {
    burnish_points points;
    block_places places;
    burnish_interpolate(shader, fragments, &points);
    if (shader->needs_position) {
        locate(&shader->rays, fragments, &places);
    }
    for (int first = 0, end; first < points.count; first = end) {
        end = run_end(&points, first);
        burnish_shade_prepare(shader, points.material[first], cache);
        burnish_kernels_points run = {.w = places.w + first};
        float *rgb[3];
        for (int k = 0; k < 3; ++k) {
            run.normal[k] = points.normal[k] + first;
            run.diffuse[k] = shader->attributes->has_colors ? points.diffuse[k] + first : NULL;
            run.position[k] = places.position[k] + first;
            rgb[k] = shaded->channel[k] + first;
        }
        (void)burnish_kernels_shade_float(shader->batch, &cache->prepared, &run,
                                          (size_t)(end - first), rgb, NULL);
    }
}
