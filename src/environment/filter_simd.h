/* Sums over the texels of an environment. Sixteen sums are kept, for columns that are equal modulo
 * 16, and added in a fixed order: the same bits for every length of a vector. */
#ifndef BURNISH_ENVIRONMENT_FILTER_SIMD_H
#define BURNISH_ENVIRONMENT_FILTER_SIMD_H

#include "base/elementary.h"
#include "base/numbers.h"
#include "environment/environment_ops.h"
#include "simd/vector.h"

enum { FILTER_GROUP = 16, FILTER_VECTORS = FILTER_GROUP / LANES };

typedef struct filter_sums {
    vf sum[4][FILTER_VECTORS]; /* red, green, blue, weight */
} filter_sums;

/* A row as one lobe sees it: the base is offset + cosine a + sine b. */
typedef struct filter_row {
    const float *texels[3];
    float offset, cosine, sine, weight;
} filter_row;

BURNISH_INLINE void filter_group(const burnish_environment_filter *filter, const filter_row *row,
                                 size_t first, filter_sums *sums) {
    const burnish_environment_level *level = filter->level;
    for (int v = 0; v < FILTER_VECTORS; ++v) {
        const size_t i = first + (size_t)(v * LANES);
        const vf a = vf_mul(vf_load(level->columns[0] + i), vf_set(row->cosine));
        const vf b = vf_mul(vf_load(level->columns[1] + i), vf_set(row->sine));
        vf u = vf_max(vf_add(vf_add(a, b), vf_set(row->offset)), vf_set(0.0f));
        for (int k = 0; k < filter->squarings; ++k) {
            u = vf_mul(u, u);
        }
        u = vf_mul(u, vf_set(row->weight));
        for (int k = 0; k < 3; ++k) {
            sums->sum[k][v] = vf_add(sums->sum[k][v], vf_mul(u, vf_load(row->texels[k] + i)));
        }
        sums->sum[3][v] = vf_add(sums->sum[3][v], u);
    }
}

/* The arc cosine of x, clamped to [-1, 1], at most 1e-4 off: Hastings, Approximations for Digital Computers,
 * 1955, sheet 35 has the form. */
BURNISH_INLINE float filter_acos(float x) {
    const float size = x < 0 ? -x : x, y = size < 1 ? size : 1;
    const float p = 1.5707288f + y * (-0.2121144f + y * (0.0742610f + y * -0.0187293f));
    const float angle = __builtin_sqrtf(1 - y) * p;
    return x < 0 ? 3.14159265f - angle : angle;
}

/* Adds the columns of a row within `half` radians of the azimuth, in groups; texels outside of the
 * cap add 0. */
BURNISH_INLINE void filter_columns(const burnish_environment_filter *filter, const filter_row *row,
                                   float azimuth, float half, filter_sums *sums) {
    const int width = filter->level->width, groups = width / FILTER_GROUP;
    const float per_radian = (float)width * 0.159154943f;
    const float begin = (azimuth + 3.14159265f - half) * per_radian - 1.5f;
    const float end = (azimuth + 3.14159265f + half) * per_radian + 1.5f;
    int first = (int)(begin + (float)width) / FILTER_GROUP; /* begin > -width */
    int last = (int)(end + (float)width) / FILTER_GROUP;
    if (last - first >= groups) {
        first = 0;
        last = groups - 1;
    }
    for (int g = first; g <= last; ++g) {
        filter_group(filter, row, (size_t)(g & (groups - 1)) * FILTER_GROUP, sums);
    }
}

BURNISH_INLINE void filter_rows(const burnish_environment_filter *filter, const float axis[3],
                                filter_sums *sums) {
    const burnish_environment_level *level = filter->level;
    const float zeta = filter->zeta, cutoff = 1 - 1 / zeta;
    const float radius = __builtin_sqrtf(axis[0] * axis[0] + axis[2] * axis[2]);
    const float azimuth = (float)burnish_atan2((double)axis[2], (double)axis[0]);
    const float per_radian = (float)level->height * 0.318309886f;
    const float polar = filter_acos(axis[1]) * per_radian - 0.5f;
    const float reach = (cutoff > -1 ? filter_acos(cutoff) : 3.2f) * per_radian + 1.5f;
    const int first = polar - reach > 0 ? (int)(polar - reach) : 0;
    const int last =
        polar + reach < (float)(level->height - 1) ? (int)(polar + reach) + 1 : level->height - 1;
    for (int j = first; j <= last && j < level->height; ++j) {
        const size_t at = (size_t)j * (size_t)level->width;
        const float along = level->rows[0][j] * axis[1], across = level->rows[1][j] * radius;
        const float needed =
            cutoff - along; /* across times the cosine of the azimuth's difference */
        if (needed >= across) {
            continue;
        }
        const filter_row row = {
            {level->texels[0] + at, level->texels[1] + at, level->texels[2] + at},
            1 + zeta * (along - 1),
            zeta * level->rows[1][j] * axis[0],
            zeta * level->rows[1][j] * axis[2],
            level->weights[j]};
        filter_columns(filter, &row, azimuth,
                       needed <= -across ? 3.2f : filter_acos(needed / across), sums);
    }
}

static void filter_environment(const burnish_environment_filter *filter, float scale,
                               const float *const axis[3], size_t count, float *const rgb[3]) {
    for (size_t i = 0; i < count; ++i) {
        const float w[3] = {axis[0][i], axis[1][i], axis[2][i]};
        float lanes[4][FILTER_GROUP];
        filter_sums sums;
        for (int k = 0; k < 4 * FILTER_VECTORS; ++k) {
            sums.sum[k / FILTER_VECTORS][k % FILTER_VECTORS] = vf_set(0.0f);
        }
        filter_rows(filter, w, &sums);
        for (int k = 0; k < 4; ++k) {
            for (int v = 0; v < FILTER_VECTORS; ++v) {
                vf_store(lanes[k] + v * LANES, sums.sum[k][v]);
            }
            for (int step = FILTER_GROUP / 2; step > 0; step /= 2) {
                for (int lane = 0; lane < step; ++lane) {
                    lanes[k][lane] += lanes[k][lane + step];
                }
            }
        }
        for (int k = 0; k < 3; ++k) {
            rgb[k][i] += scale * (lanes[k][0] / (lanes[3][0] > 0 ? lanes[3][0] : 1));
        }
    }
}

#endif
