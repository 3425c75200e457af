/* The public face of the kernels: checks arguments and hands over to the table of an instruction
 * set. */
#include "burnish/kernels.h"

#include <string.h>

#include "core/error.h"
#include "simd/isa_ops.h"

const burnish_kernels *burnish_kernels_for(burnish_isa isa) {
    const int runs = (unsigned)isa < BURNISH_ISA_COUNT && burnish_isa_available() >> isa & 1;
    return runs ? burnish_isa_ops_for(isa) : NULL;
}

const burnish_kernels *burnish_kernels_best(void) {
    burnish_isa isa;
    if (burnish_isa_choose(NULL, &isa, NULL) != BURNISH_STATUS_OK) {
        isa = burnish_isa_best(burnish_isa_available());
    }
    return burnish_isa_ops_for(isa);
}

burnish_isa burnish_kernels_isa(const burnish_kernels *batch) {
    return batch->isa;
}

static burnish_status lobe_array(const burnish_kernels *batch, const burnish_lobe_spec *lobe,
                                 float exponent, int input, size_t count, const float *in,
                                 float *out, burnish_error *error) {
    burnish_kernels_lobe_constants constants;
    float scale;
    burnish_status status = burnish_lobe_constants_make(lobe, exponent, &constants, &scale, error);
    if (status == BURNISH_STATUS_OK) {
        batch->lobe[constants.body][input](&constants, count, in, out);
        for (size_t i = 0; scale != 1.0f && i < count; ++i) {
            out[i] *= scale;
        }
    }
    return status;
}

burnish_status burnish_kernels_lobe_of_cosines(const burnish_kernels *batch,
                                               const burnish_lobe_spec *lobe, float exponent,
                                               size_t count, const float *cosines, float *values,
                                               burnish_error *error) {
    return lobe_array(batch, lobe, exponent, BURNISH_LOBE_INPUT_COSINE, count, cosines, values,
                      error);
}

burnish_status burnish_kernels_lobe_of_lambdas(const burnish_kernels *batch,
                                               const burnish_lobe_spec *lobe, float exponent,
                                               size_t count, const float *lambdas, float *values,
                                               burnish_error *error) {
    return lobe_array(batch, lobe, exponent, BURNISH_LOBE_INPUT_LAMBDA, count, lambdas, values,
                      error);
}

void burnish_kernels_normalize(const burnish_kernels *batch, size_t count, const float *const in[3],
                               float *const out[3]) {
    batch->normalize_array(count, in, out);
}

static burnish_status check_points(const burnish_kernels_shader *shader,
                                   const burnish_kernels_points *points, burnish_error *error) {
    if (shader->cookie != BURNISH_SHADER_COOKIE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "shader: make it with burnish_kernels_prepare()");
    }
    const float *const *d = points->diffuse, *const *p = points->position;
    if (!points->normal[0] || !points->normal[1] || !points->normal[2]) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "points: an array of normals is NULL");
    }
    if (!d[0] != !d[1] || !d[0] != !d[2]) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "points: give all three arrays of diffuse colours or none");
    }
    if (shader->needs_position && (!p[0] || !p[1] || !p[2])) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "points: point lights and local viewers need the arrays of positions");
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_kernels_shade_rgba8(const burnish_kernels *batch,
                                           const burnish_kernels_shader *shader,
                                           const burnish_kernels_points *points, size_t count,
                                           uint8_t *rgba, burnish_error *error) {
    burnish_status status = check_points(shader, points, error);
    if (status == BURNISH_STATUS_OK) {
        batch->shade[shader->lobe.body][shader->geometry][BURNISH_SHADE_RGBA8](shader, points,
                                                                               count, rgba, NULL);
    }
    return status;
}

burnish_status burnish_kernels_shade_float(const burnish_kernels *batch,
                                           const burnish_kernels_shader *shader,
                                           const burnish_kernels_points *points, size_t count,
                                           float *const rgb[3], burnish_error *error) {
    burnish_status status = check_points(shader, points, error);
    if (status == BURNISH_STATUS_OK) {
        batch->shade[shader->lobe.body][shader->geometry][BURNISH_SHADE_FLOAT](shader, points,
                                                                               count, NULL, rgb);
    }
    return status;
}
