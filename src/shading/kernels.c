/* The public face of the kernels: checks arguments and hands over to the table of an instruction
 * set. */
#include "burnish/kernels.h"

#include "base/error.h"
#include "base/memory.h"
#include "core/float_mode.h"
#include "shading/shading_ops.h"

#define OPS burnish_shading_ops
#include "simd/isa_table.h"

const burnish_kernels *burnish_kernels_for(burnish_isa isa) {
    const int runs = (unsigned)isa < BURNISH_ISA_COUNT && burnish_isa_available() >> isa & 1;
    return runs ? burnish_shading_ops_for(isa) : NULL;
}

const burnish_kernels *burnish_kernels_best(void) {
    burnish_isa isa;
    if (burnish_isa_choose(NULL, &isa, NULL) != BURNISH_STATUS_OK) {
        isa = burnish_isa_best(burnish_isa_available());
    }
    return burnish_shading_ops_for(isa);
}

/* NULL, as burnish_kernels_for returns it, means the best. */
static const burnish_kernels *or_best(const burnish_kernels *kernels) {
    return kernels ? kernels : burnish_kernels_best();
}

burnish_isa burnish_kernels_get_isa(const burnish_kernels *kernels) {
    return or_best(kernels)->isa;
}

/* ---- Lobes ---- */

/* Arrays of values, and what a lobe is evaluated from: BURNISH_LOBE_INPUT_... */
typedef struct lobe_values {
    int input;
    size_t count;
    const float *in;
    float *out;
} lobe_values;

static burnish_status lobe_array(const burnish_kernels *kernels, const burnish_lobe_spec *lobe,
                                 float exponent, lobe_values values, burnish_error *error) {
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    burnish_lobe_constants constants;
    float scale;
    burnish_status status = burnish_lobe_constants_make(lobe, exponent, &constants, &scale, error);
    if (status == BURNISH_STATUS_OK) {
        or_best(kernels)->lobe[constants.body][values.input](&constants, values.count, values.in,
                                                             values.out);
        for (size_t i = 0; scale != 1.0f && i < values.count; ++i) {
            values.out[i] *= scale;
        }
    }
    burnish_float_mode_leave(float_mode);
    return status;
}

burnish_status burnish_kernels_lobe_of_cosines(const burnish_kernels *kernels,
                                               const burnish_lobe_spec *lobe, float exponent,
                                               size_t count, const float *cosines, float *values,
                                               burnish_error *error) {
    const lobe_values arrays = {BURNISH_LOBE_INPUT_COSINE, count, cosines, values};
    return lobe_array(kernels, lobe, exponent, arrays, error);
}

burnish_status burnish_kernels_lobe_of_lambdas(const burnish_kernels *kernels,
                                               const burnish_lobe_spec *lobe, float exponent,
                                               size_t count, const float *lambdas, float *values,
                                               burnish_error *error) {
    const lobe_values arrays = {BURNISH_LOBE_INPUT_LAMBDA, count, lambdas, values};
    return lobe_array(kernels, lobe, exponent, arrays, error);
}

void burnish_kernels_normalize(const burnish_kernels *kernels, size_t count,
                               const float *const in[3], float *const out[3]) {
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    or_best(kernels)->normalize_array(count, in, out);
    burnish_float_mode_leave(float_mode);
}

/* ---- Lighting ---- */

/* A shader and its lights in one piece of memory. */
typedef struct owned_shader {
    burnish_kernels_shader shader;
    burnish_light_constants lights[];
} owned_shader;

static burnish_status make_shader(const burnish_kernels_lighting *lighting,
                                  const burnish_context *context, burnish_kernels_shader **shader,
                                  burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    burnish_status status = burnish_lighting_check(lighting, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t lights = (size_t)lighting->light_count * sizeof(burnish_light_constants);
    owned_shader *made = burnish_allocate_zeroed(&memory, 1, sizeof *made + lights, "a shader");
    if (!made) {
        return memory.status;
    }
    made->shader.context = context;
    status = burnish_shader_fold(lighting, &lighting->material, &lighting->lobe, made->lights,
                                 &made->shader, error);
    if (status != BURNISH_STATUS_OK) {
        burnish_release(context, made);
        return status;
    }
    *shader = &made->shader;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_kernels_shader_create(const burnish_kernels_lighting *lighting,
                                             const burnish_context *context,
                                             burnish_kernels_shader **shader,
                                             burnish_error *error) {
    if (!shader) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "shader: NULL; pass where to put it");
    }
    *shader = NULL;
    if (!lighting) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: NULL; start from burnish_kernels_lighting_default()");
    }
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    const burnish_status status = make_shader(lighting, context, shader, error);
    burnish_float_mode_leave(float_mode);
    return status;
}

void burnish_kernels_shader_destroy(burnish_kernels_shader *shader) {
    if (shader) {
        burnish_release(shader->context, shader); /* the first member of owned_shader */
    }
}

static burnish_status check_points(const burnish_kernels_shader *shader,
                                   const burnish_kernels_points *points, burnish_error *error) {
    if (!shader) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "shader: NULL; make it with burnish_kernels_shader_create()");
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

static burnish_status shade_points(const burnish_kernels *kernels,
                                   const burnish_kernels_shader *shader,
                                   const burnish_kernels_points *points, size_t count,
                                   uint8_t *rgba, float *const rgb[3], burnish_error *error) {
    const burnish_status status = check_points(shader, points, error);
    if (status == BURNISH_STATUS_OK) {
        const burnish_float_mode float_mode = burnish_float_mode_enter();
        const int output = rgba ? BURNISH_SHADE_RGBA8 : BURNISH_SHADE_FLOAT;
        or_best(kernels)->shade[shader->lobe.body][shader->geometry][output](shader, points, count,
                                                                             rgba, rgb);
        burnish_float_mode_leave(float_mode);
    }
    return status;
}

burnish_status burnish_kernels_shade_rgba8(const burnish_kernels *kernels,
                                           const burnish_kernels_shader *shader,
                                           const burnish_kernels_points *points, size_t count,
                                           uint8_t *rgba, burnish_error *error) {
    return shade_points(kernels, shader, points, count, rgba, NULL, error);
}

burnish_status burnish_kernels_shade_float(const burnish_kernels *kernels,
                                           const burnish_kernels_shader *shader,
                                           const burnish_kernels_points *points, size_t count,
                                           float *const rgb[3], burnish_error *error) {
    return shade_points(kernels, shader, points, count, NULL, rgb, error);
}

/* ---- Polygonal lights ---- */

static int has_arrays(const float *const arrays[3]) {
    return arrays[0] && arrays[1] && arrays[2];
}

static burnish_status check_polygon_arrays(const burnish_polygon_constants *polygon,
                                           const burnish_kernels_points *points,
                                           const burnish_kernels_axes *axes, float *const light[2],
                                           burnish_error *error) {
    if (!has_arrays(points->normal) && (light[0] || points->normal[0])) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "points: an array of normals is NULL");
    }
    if (!polygon->is_distant && !has_arrays(points->position)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "points: lights that are not distant need the arrays of positions");
    }
    if (polygon->lobe_count && (!axes || !has_arrays(axes->axis))) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "axes: lobes need all three arrays");
    }
    if (axes && axes->stretch[0] && !has_arrays(axes->stretch)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "axes: an array of stretch is NULL");
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_kernels_polygon_light(const burnish_kernels *kernels,
                                             const burnish_kernels_polygon *polygon,
                                             const burnish_kernels_points *points,
                                             const burnish_kernels_axes *axes, size_t count,
                                             float *const light[2], burnish_error *error) {
    burnish_polygon_constants constants;
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    burnish_status status = burnish_polygon_constants_make(polygon, &constants, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_polygon_arrays(&constants, points, axes, light, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_kernels_axes none = {.axis = {NULL}};
        or_best(kernels)->polygon_light(&constants, points, axes ? axes : &none, count, light);
    }
    burnish_float_mode_leave(float_mode);
    return status;
}
