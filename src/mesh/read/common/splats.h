/* Gaussian splats: from what files state to burnish_splat. */
#ifndef BURNISH_MESH_READ_COMMON_SPLATS_H
#define BURNISH_MESH_READ_COMMON_SPLATS_H

#include "base/elementary.h"
#include "mesh/read/io/reader.h"

/* A splat as files state it. */
typedef struct burnish_splat_values {
    float scale[3], rotation[4]; /* standard deviations; quaternion w, x, y, z of any length */
    float color[3], opacity;
} burnish_splat_values;

/* e^x, or e^80; of NaN NaN. */
static inline double burnish_splat_exp(double x) {
    return burnish_expm1(x > 80 ? 80 : x) + 1;
}

/* The colour of the constant spherical harmonic's factor. */
static inline float burnish_splat_color(double harmonic) {
    return (float)(0.5 + 0.28209479177387814 * harmonic); /* sqrt(1 / pi) / 2 */
}

/* What stands for a value that is not finite: an infinite logit of an opacity has a meaning. */
static inline float burnish_splat_odd(double value, int is_opacity) {
    return is_opacity && value == value ? value > 0 ? 1e3F : -1e3F : __builtin_nanf("");
}

burnish_splat burnish_splat_of(const burnish_splat_values *values);

/* Makes room for positions and splats. Errors: LIMIT, MEMORY. */
burnish_status burnish_reserve_splats(burnish_reader *reader, size_t count);

/* Completes mesh data that has a splat for each position: a point cloud. Splats with a value that
 * is not finite are left out.
 *   is_trained  1: the stream's items begin with burnish_splat_values as training has them:
 *               logarithms of scales, factors of the constant spherical harmonic as colour, the
 *               logit of opacity; bad positions have been noted
 * Errors: as burnish_make_points. */
burnish_status burnish_make_splats(burnish_reader *reader, int is_trained);

/* The same for reader->mesh->splats, which are left out if none remains. */
burnish_status burnish_make_splats_beside(burnish_reader *reader);

/* The positions of splats that show: those opaque to a tenth at least, or all if these are few.
 * *positions is the caller's to release; *size: the mean length of their longest axes.
 * Errors: MEMORY. */
burnish_status burnish_visible_splats(burnish_mesh_data *mesh, float **positions, size_t *count,
                                      double *size);

#endif
