/* Lighting and lobes over arrays in structure-of-arrays form. Each kernel is a plain loop of IEEE
 * operations without branches, in a fixed order: the same bits on every instruction set.
 *
 * Arrays do not overlap unless a line says so; count may be 0. */
#ifndef BURNISH_KERNELS_KERNELS_H
#define BURNISH_KERNELS_KERNELS_H

#include <stddef.h>

#include "burnish/lobe.h"

/* Scales (x, y, z) to unit length in place; length gets the old length (NULL: not wanted). A vector
 * without length stays zero. */
void burnish_kernel_normalize(size_t count, float *x, float *y, float *z, float *length);

/* out = ax bx + ay by + az bz */
void burnish_kernel_dot(size_t count, const float *ax, const float *ay, const float *az,
                        const float *bx, const float *by, const float *bz, float *out);

/* out = ax bx + ay by + az bz with the same b everywhere */
void burnish_kernel_dot_uniform(size_t count, const float *ax, const float *ay, const float *az,
                                const float b[3], float *out);

/* A specular lobe with its exponent worked in. */
typedef enum burnish_lobe_kernel_kind {
    BURNISH_LOBE_KERNEL_FAMILY,
    BURNISH_LOBE_KERNEL_POWER,
    BURNISH_LOBE_KERNEL_SCHLICK,
    BURNISH_LOBE_KERNEL_GAUSSIAN,
    BURNISH_LOBE_KERNEL_GX
} burnish_lobe_kernel_kind;

typedef struct burnish_lobe_kernel {
    burnish_lobe_kernel_kind kind;
    burnish_lobe family; /* FAMILY */
    float exponent;      /* the others */
} burnish_lobe_kernel;

/* values = lobe(cosines), each in [0, 1]; values may be cosines. */
void burnish_kernel_lobe(const burnish_lobe_kernel *lobe, size_t count, const float *cosines,
                         float *values);

/* values = the family's lobe of lambdas (1 - cosine); values may be lambdas. */
void burnish_kernel_lobe_lambda(burnish_lobe lobe, size_t count, const float *lambdas,
                                float *values);

/* Cosine of the Phong lobe, R.V = 2 (N.L) (N.V) - L.V; out may be any of the inputs. */
void burnish_kernel_reflect(size_t count, const float *n_dot_l, const float *n_dot_v,
                            const float *l_dot_v, float *out);

/* sum += light (kd max(0, N.L) + ks S where N.L > 0), one colour channel. diffuse: kd a point. */
void burnish_kernel_accumulate(size_t count, float light, const float *diffuse, float specular,
                               const float *n_dot_l, const float *lobe_values, float *sum);

#endif
