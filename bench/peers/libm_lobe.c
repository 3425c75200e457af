/* Blocks of points in L1: cosines by a loop that the compiler vectorises, one powf per point,
 * sums by another such loop. Only the lobe differs from the kernel that it replaces. */
#include "libm_lobe.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 256 };

typedef struct block_sums {
    float diffuse[3][BLOCK], specular[3][BLOCK];
    float inverse[BLOCK], cosine[BLOCK], lit[BLOCK];
} block_sums;

static void add_light(const burnish_kernels_shader *shader, const burnish_light_constants *light,
                      int output, const float *const normal[3], int count, block_sums *sums) {
    for (int i = 0; i < count; ++i) {
        float n_dot_l = (normal[0][i] * light->vector[0] + normal[1][i] * light->vector[1] +
                         normal[2][i] * light->vector[2]) *
                        sums->inverse[i];
        float n_dot_h = (normal[0][i] * light->half[0] + normal[1][i] * light->half[1] +
                         normal[2][i] * light->half[2]) *
                        sums->inverse[i];
        sums->lit[i] = n_dot_l > 0 ? n_dot_l : 0;
        sums->cosine[i] = n_dot_l > 0 && n_dot_h > 0 ? n_dot_h : 0;
    }
    for (int i = 0; i < count; ++i) { /* most of the object is lit and faces H: no branch pays */
        sums->cosine[i] = powf(sums->cosine[i], shader->lobe.exponent);
    }
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            sums->diffuse[k][i] += sums->lit[i] * light->diffuse[output][k];
            sums->specular[k][i] += sums->cosine[i] * light->specular[output][k];
        }
    }
}

static void shade_block(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                        size_t first, int count, int output, block_sums *sums) {
    const float *normal[3];
    for (int k = 0; k < 3; ++k) {
        normal[k] = points->normal[k] + first;
    }
    for (int i = 0; i < count; ++i) {
        float squared =
            normal[0][i] * normal[0][i] + normal[1][i] * normal[1][i] + normal[2][i] * normal[2][i];
        sums->inverse[i] = squared > 0 ? 1.0f / sqrtf(squared) : 0;
        for (int k = 0; k < 3; ++k) {
            sums->diffuse[k][i] = shader->ambient[output][k];
            sums->specular[k][i] = 0;
        }
    }
    for (int l = 0; l < shader->light_count; ++l) {
        add_light(shader, &shader->lights[l], output, normal, count, sums);
    }
    for (int k = 0; k < 3; ++k) {
        const float *color = points->diffuse[0] ? points->diffuse[k] + first : NULL;
        for (int i = 0; i < count; ++i) {
            sums->diffuse[k][i] = (color ? sums->diffuse[k][i] * color[i] : sums->diffuse[k][i]) +
                                  sums->specular[k][i];
        }
    }
}

static void shade_float(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                        size_t count, uint8_t *rgba, float *const rgb[3]) {
    block_sums sums;
    (void)rgba;
    for (size_t first = 0; first < count; first += BLOCK) {
        int n = count - first < BLOCK ? (int)(count - first) : BLOCK;
        shade_block(shader, points, first, n, BURNISH_SHADE_FLOAT, &sums);
        for (int k = 0; k < 3; ++k) {
            memcpy(rgb[k] + first, sums.diffuse[k], (size_t)n * sizeof(float));
        }
    }
}

static void shade_rgba8(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                        size_t count, uint8_t *rgba, float *const rgb[3]) {
    block_sums sums;
    (void)rgb;
    for (size_t first = 0; first < count; first += BLOCK) {
        int n = count - first < BLOCK ? (int)(count - first) : BLOCK;
        shade_block(shader, points, first, n, BURNISH_SHADE_RGBA8, &sums);
        for (int i = 0; i < n; ++i) {
            uint8_t *pixel = rgba + 4 * (first + (size_t)i);
            for (int k = 0; k < 3; ++k) {
                pixel[k] = (uint8_t)(fminf(sums.diffuse[k][i], 255.0f) + 0.5f);
            }
            pixel[3] = 255;
        }
    }
}

static void shade_dark(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                       size_t count, uint8_t *rgba, float *const rgb[3]) {
    (void)shader;
    (void)points;
    if (rgba) {
        memset(rgba, 0, 4 * count);
        return;
    }
    for (int k = 0; k < 3; ++k) {
        memset(rgb[k], 0, count * sizeof(float));
    }
}

static burnish_shading_ops with_power(const burnish_kernels *batch,
                                      burnish_shade_function *const shade[2]) {
    burnish_shading_ops made = *batch;
    for (int output = 0; output < 2; ++output) {
        made.shade[BURNISH_LOBE_BODY_POWER][BURNISH_SHADE_DISTANT][output] = shade[output];
    }
    return made;
}

burnish_shading_ops burnish_peers_libm_batch(const burnish_kernels *batch) {
    return with_power(
        batch, (burnish_shade_function *const[]){
                   [BURNISH_SHADE_RGBA8] = shade_rgba8, [BURNISH_SHADE_FLOAT] = shade_float});
}

burnish_shading_ops burnish_peers_dark_batch(const burnish_kernels *batch) {
    return with_power(batch, (burnish_shade_function *const[]){shade_dark, shade_dark});
}
