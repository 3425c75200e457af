/* From a lighting's description to the constants that the kernels read. */
#include <string.h>

#include "base/elementary.h"
#include "base/error.h"
#include "base/layout.h"
#include "shading/shader.h"

#define COOKIE BURNISH_COOKIE(0x6c676874, burnish_kernels_lighting)
#define LARGEST_COLOR 1e6f

static int squarings_of(int order) {
    int squarings = 0;
    while (order > 1) {
        order /= 2;
        ++squarings;
    }
    return squarings;
}

static burnish_status family_constants(const burnish_lobe_spec *lobe, float exponent,
                                       burnish_lobe_constants *constants, float *scale,
                                       burnish_error *error) {
    burnish_lobe family;
    double zeta, peak;
    burnish_lobe_status status = burnish_lobe_solve(lobe, (double)exponent, &zeta, &peak);
    if (status == BURNISH_LOBE_OK) {
        status = burnish_lobe_from_zeta(&family, (float)zeta, lobe->order);
    }
    if (status != BURNISH_LOBE_OK) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: order %d at exponent %g: %s",
                            lobe->order, (double)exponent, burnish_lobe_status_text(status));
    }
    constants->body = family.order == 2 ? BURNISH_LOBE_BODY_SQUARE : BURNISH_LOBE_BODY_SQUARES;
    constants->squarings = squarings_of(family.order);
    constants->zeta = family.zeta;
    *scale = (float)peak;
    return BURNISH_STATUS_OK;
}

static burnish_status composite_constants(const burnish_lobe_spec *lobe, float exponent,
                                          burnish_lobe_constants *constants, burnish_error *error) {
    burnish_composite made;
    const burnish_lobe_status status =
        burnish_composite_create(&made, lobe->aim, lobe->order, exponent);
    if (status != BURNISH_LOBE_OK) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: composite at exponent %g: %s",
                            (double)exponent, burnish_lobe_status_text(status));
    }
    constants->body = BURNISH_LOBE_BODY_COMPOSITE;
    constants->squarings = made.multiplications - 1;
    constants->zeta = made.slope;
    constants->top = made.top;
    memcpy(constants->offset, made.offset, sizeof made.offset);
    return BURNISH_STATUS_OK;
}

/* The exponent's constants; all fields are set, whichever the body reads. */
static void exponent_constants(float n, int body, burnish_lobe_constants *constants) {
    const double ln2 = 0.693147180559945309417, log2_e = 1.44269504088896340736;
    constants->body = body;
    constants->exponent = n;
    constants->whole = (uint32_t)n;
    constants->least = (float)(1.0 + burnish_expm1(-126.0 * ln2 / (double)n));
    constants->slope =
        body == BURNISH_LOBE_BODY_GAUSSIAN ? (float)(-((double)n + 0.775) * log2_e) : 0.5f * n;
}

burnish_status burnish_lobe_constants_make(const burnish_lobe_spec *lobe, float exponent,
                                           burnish_lobe_constants *constants, float *scale,
                                           burnish_error *error) {
    static const int bodies[BURNISH_LOBE_KIND_COUNT] = {
        [BURNISH_LOBE_POWER] = BURNISH_LOBE_BODY_POWER,
        [BURNISH_LOBE_INTEGER_POWER] = BURNISH_LOBE_BODY_MULTIPLY,
        [BURNISH_LOBE_SCHLICK] = BURNISH_LOBE_BODY_SCHLICK,
        [BURNISH_LOBE_GAUSSIAN] = BURNISH_LOBE_BODY_GAUSSIAN,
        [BURNISH_LOBE_GX] = BURNISH_LOBE_BODY_GX,
    };
    burnish_lobe_spec exact;
    const float n = exponent;
    if (lobe->kind == BURNISH_LOBE_EXACT) {
        exact = burnish_lobe_exact(exponent);
        lobe = &exact;
    }
    memset(constants, 0, sizeof *constants);
    constants->body = BURNISH_LOBE_BODY_NONE;
    constants->top = 1.0f;
    *scale = 1.0f;
    burnish_status status = burnish_lobe_spec_check(lobe, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (lobe->kind == BURNISH_LOBE_FAMILY || lobe->kind == BURNISH_LOBE_LYON) {
        return family_constants(lobe, n, constants, scale, error);
    }
    if (lobe->kind == BURNISH_LOBE_COMPOSITE) {
        return composite_constants(lobe, n, constants, error);
    }
    if (!(n >= BURNISH_LOBE_EXPONENT_MIN && n <= BURNISH_LOBE_EXPONENT_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: exponent %g is not in [1, 65536]", (double)n);
    }
    if (lobe->kind == BURNISH_LOBE_INTEGER_POWER && n != (float)(uint32_t)n) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: exponent %g is not a whole number; take BURNISH_LOBE_POWER",
                            (double)n);
    }
    exponent_constants(n, bodies[lobe->kind], constants);
    return BURNISH_STATUS_OK;
}

void burnish_kernels_lighting_init(burnish_kernels_lighting *lighting, uint64_t layout) {
    const burnish_kernels_lighting defaults = {
        .cookie = COOKIE,
        .material = {.ambient = {0.05f, 0.05f, 0.05f},
                     .diffuse = {0.6f, 0.6f, 0.6f},
                     .specular = {0.35f, 0.35f, 0.35f},
                     .exponent = 32},
        .lobe = {.fit = BURNISH_FIT_ENERGY, .order = 2},
        .ambient_light = {1, 1, 1},
        .viewer = {0, 0, 1},
        .lights = {{.vector = {-0.48, 0.6, 0.64}, .color = {1, 1, 1}}},
        .light_count = 1};
    burnish_layout_init(lighting, layout, BURNISH_LAYOUT(burnish_kernels_lighting), &defaults);
}

static int is_color(const float color[3]) {
    for (int k = 0; k < 3; ++k) {
        if (!(color[k] >= 0.0f && color[k] <= LARGEST_COLOR)) {
            return 0;
        }
    }
    return 1;
}

static int is_position(const float position[3]) {
    const float limit = 0x1p60f;
    for (int k = 0; k < 3; ++k) {
        if (!(position[k] >= -limit && position[k] <= limit)) {
            return 0;
        }
    }
    return 1;
}

static int is_unit(const float v[3]) {
    double x = (double)v[0], y = (double)v[1], z = (double)v[2];
    double squared = (x * x + y * y) + z * z;
    return squared > 0.998 && squared < 1.002;
}

static void round_vector(const double vector[3], float rounded[3]) {
    for (int k = 0; k < 3; ++k) {
        rounded[k] = (float)vector[k];
    }
}

static int is_distance(double value) {
    return value == 0 || (value >= 0x1p-60 && value <= 0x1p60);
}

static int has_axis(const burnish_light *light) {
    return light->axis[0] != 0 || light->axis[1] != 0 || light->axis[2] != 0;
}

/* What is for point lights only. */
static int is_beam(const burnish_light *light) {
    float axis[3];
    round_vector(light->axis, axis);
    return is_distance(light->distance) && is_distance(light->range) &&
           (!has_axis(light) || (is_unit(axis) && light->cone[1] >= -1 &&
                                 light->cone[0] >= light->cone[1] && light->cone[0] <= 1));
}

static burnish_status check_lights(const burnish_kernels_lighting *lighting, burnish_error *error) {
    if (lighting->light_count < 0 || lighting->light_count > BURNISH_LIGHT_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lights: %d is not in [0, %d]",
                            lighting->light_count, BURNISH_LIGHT_MAX);
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        const burnish_light *light = &lighting->lights[i];
        float vector[3];
        round_vector(light->vector, vector);
        int good = light->kind == BURNISH_LIGHT_POINT ? is_position(vector) : is_unit(vector);
        if ((unsigned)light->kind > BURNISH_LIGHT_POINT || !good || !is_color(light->color)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "light %d: needs a position within 2^60 or a unit vector, and a "
                                "colour in [0, 1e6]",
                                i + 1);
        }
        if (light->kind == BURNISH_LIGHT_POINT && !is_beam(light)) {
            return burnish_fail(
                error, BURNISH_STATUS_ARGUMENT,
                "light %d: needs distances within 2^60, and of a cone a unit vector "
                "and cosines, the larger one first",
                i + 1);
        }
        if (light->follows_camera) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "light %d: follows a camera, which only burnish_render knows; give "
                                "it in the points' space",
                                i + 1);
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_lighting_check(const burnish_kernels_lighting *lighting,
                                      burnish_error *error) {
    const burnish_status status =
        burnish_layout_check(lighting, COOKIE, "lighting", "kernels_lighting", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (!is_color(lighting->ambient_light)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: ambient light must be in [0, 1e6]");
    }
    if ((unsigned)lighting->specular_model > BURNISH_SPECULAR_PHONG) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: specular model %d does not exist",
                            (int)lighting->specular_model);
    }
    if (lighting->local_viewer ? !is_position(lighting->viewer) : !is_unit(lighting->viewer)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: the viewer must be a position within 2^60 or a unit vector");
    }
    return check_lights(lighting, error);
}

/* The unit vector between two. (0, 0, 0) for opposite vectors. */
static void find_half(const float a[3], const float b[3], double half[3]) {
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
        half[k] = (double)a[k] + (double)b[k];
        squared += half[k] * half[k];
    }
    for (int k = 0; k < 3; ++k) {
        half[k] = squared > 0 ? half[k] / burnish_sqrt(squared) : 0;
    }
}

/* What a point light loses by distance, and outside its cone. */
static void fold_beam(const burnish_light *light, burnish_light_constants *constants) {
    const float distance = (float)light->distance, range = (float)light->range;
    const double width = light->cone[0] - light->cone[1];
    const double scale = has_axis(light) ? 1 / (width > 0.001 ? width : 0.001) : 0;
    constants->squared_distance = distance * distance;
    constants->squared_range = range * range;
    constants->cone_scale = (float)scale;
    constants->cone_offset = (float)(scale * -light->cone[1]);
    for (int k = 0; k < 3; ++k) {
        constants->to_light[k] = -(float)light->axis[k];
    }
    constants->is_lessened = distance > 0 || range > 0 || scale > 0;
}

/* scale is the lobe's value at its peak, which is folded into the specular colour. */
static void fold_light(const burnish_kernels_lighting *lighting, const burnish_material *material,
                       const burnish_light *light, float zeta, float scale,
                       burnish_light_constants *constants) {
    double half[3], slope = zeta > 0.0f ? (double)zeta : 1.0;
    constants->is_point = light->kind == BURNISH_LIGHT_POINT;
    constants->is_lessened = 0;
    if (constants->is_point) {
        fold_beam(light, constants);
    }
    round_vector(light->vector, constants->vector);
    find_half(constants->vector, lighting->viewer, half);
    for (int k = 0; k < 3; ++k) {
        const float diffuse = material->diffuse[k] * light->color[k];
        const float specular = (material->specular[k] * scale) * light->color[k];
        constants->half[k] = (float)(half[k] * slope);
        constants->diffuse[BURNISH_SHADE_FLOAT][k] = diffuse;
        constants->diffuse[BURNISH_SHADE_RGBA8][k] = 255.0f * diffuse;
        constants->specular[BURNISH_SHADE_FLOAT][k] = specular;
        constants->specular[BURNISH_SHADE_RGBA8][k] = 255.0f * specular;
    }
}

/* Below this cosine lobes with a base are dark whatever the rounding: 1e-5 is ten times what the
 * cosine of a point can be off. */
static float find_cutoff(const burnish_lobe_constants *lobe) {
    double cutoff = lobe->zeta > 0.0f ? 1.0 - (double)lobe->top / (double)lobe->zeta - 1e-5 : -1.0;
    return cutoff > 0.0 ? (float)cutoff : -1.0f;
}

static int is_dark(const float color[3]) {
    return color[0] == 0.0f && color[1] == 0.0f && color[2] == 0.0f;
}

burnish_status burnish_shader_fold(const burnish_kernels_lighting *lighting,
                                   const burnish_material *material, const burnish_lobe_spec *lobe,
                                   burnish_light_constants *lights, burnish_kernels_shader *shader,
                                   burnish_error *error) {
    float scale;
    if (!is_color(material->ambient) || !is_color(material->diffuse) ||
        !is_color(material->specular)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "material: ambient, diffuse and specular must be in [0, 1e6]");
    }
    burnish_status status =
        burnish_lobe_constants_make(lobe, material->exponent, &shader->lobe, &scale, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (is_dark(material->specular)) {
        shader->lobe.body = BURNISH_LOBE_BODY_NONE;
    }
    shader->phong = lighting->specular_model == BURNISH_SPECULAR_PHONG;
    shader->lyon = lobe->kind == BURNISH_LOBE_LYON && !shader->phong;
    shader->local_viewer = lighting->local_viewer != 0;
    shader->needs_position = shader->local_viewer;
    shader->lights = lights;
    shader->light_count = lighting->light_count;
    shader->offset = (float)((double)shader->lobe.top - (double)shader->lobe.zeta);
    shader->cutoff = shader->lyon ? -1.0f : find_cutoff(&shader->lobe);
    for (int k = 0; k < 3; ++k) {
        const float ambient = lighting->ambient_light[k] * material->ambient[k];
        shader->viewer[k] = lighting->viewer[k];
        shader->ambient[BURNISH_SHADE_FLOAT][k] = ambient;
        shader->ambient[BURNISH_SHADE_RGBA8][k] = 255.0f * ambient;
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        fold_light(lighting, material, &lighting->lights[i], shader->lobe.zeta, scale, &lights[i]);
        shader->needs_position |= lights[i].is_point;
    }
    shader->geometry = shader->phong || shader->lyon || shader->needs_position
                           ? BURNISH_SHADE_GENERAL
                           : BURNISH_SHADE_DISTANT;
    return BURNISH_STATUS_OK;
}
