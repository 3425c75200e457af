/* A batch of fragments: attributes divided by 1/w, positions from depths, then the kernels, a run
 * of one material after another. */
#include "shading/shade.h"

#include "core/arithmetic.h"

/* attribute / (1/w) in three arrays. */
static void divide(int count, const float *const attribute[3], const float *inverse_w,
                   float (*out)[BURNISH_SHADE_BATCH]) {
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            out[k][i] = attribute[k][i] * (1.0f / inverse_w[i]);
        }
    }
}

/* The fragments [first, end), which have one material. */
static void shade_run(const burnish_shading *shading, const burnish_kernels_points *points,
                      const burnish_kernels_shader *shader, int first, int end,
                      float *const rgb[3]) {
    burnish_kernels_points run = {.w = points->w + first};
    float *to[3];
    for (int k = 0; k < 3; ++k) {
        run.normal[k] = points->normal[k] + first;
        run.diffuse[k] = points->diffuse[k] ? points->diffuse[k] + first : NULL;
        run.position[k] = points->position[k] + first;
        to[k] = rgb[k] + first;
    }
    shading->ops->shade[shader->lobe.body][shader->geometry][BURNISH_SHADE_FLOAT](
        shader, &run, (size_t)(end - first), NULL, to);
}

static int run_end(const burnish_fragment_batch *batch, int first) {
    const uint16_t *material = batch->material;
    int end = first + 1;
    while (end < batch->count && material[end] == material[first]) {
        ++end;
    }
    return end;
}

void burnish_shade(const burnish_shading *shading, const burnish_fragment_batch *batch,
                   burnish_shade_scratch *scratch, float *const rgb[3]) {
    burnish_kernels_points points = {.w = scratch->w};
    float *const position[3] = {scratch->position[0], scratch->position[1], scratch->position[2]};
    for (int k = 0; k < 3; ++k) {
        points.normal[k] = shading->is_lyon ? scratch->normal[k] : batch->normal[k];
        points.diffuse[k] = batch->color[k] ? scratch->diffuse[k] : NULL;
        points.position[k] = position[k];
    }
    if (shading->is_lyon) {
        divide(batch->count, batch->normal, batch->inverse_w, scratch->normal);
    }
    if (batch->color[0]) {
        divide(batch->count, batch->color, batch->inverse_w, scratch->diffuse);
    }
    if (shading->needs_position) {
        shading->ops->position_from_depth(&shading->rays, &batch->points, (size_t)batch->count,
                                          position, scratch->w);
    }
    for (int first = 0, end; first < batch->count; first = end) {
        end = batch->material ? run_end(batch, first) : batch->count;
        const int material = batch->material ? batch->material[first] : 0;
        shade_run(shading, &points, &shading->shaders[material], first, end, rgb);
    }
}
