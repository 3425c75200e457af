/* From a lighting's description to the constants that the kernels read. */
#include <string.h>

#include "core/elementary.h"
#include "core/error.h"
#include "shading/table.h"

#define LIGHTING_COOKIE 0x6c676874u
#define LARGEST_COLOR 1e6f

static int squarings_of(int order) {
    int squarings = 0;
    while (order > 1) {
        order /= 2;
        ++squarings;
    }
    return squarings;
}

static burnish_status family_constants(const burnish_lobe *family,
                                       burnish_kernels_lobe_constants *constants,
                                       burnish_error *error) {
    if (family->order == 0 && family->zeta == 0.0f) {
        return BURNISH_STATUS_OK; /* dark */
    }
    burnish_lobe checked;
    if (burnish_lobe_from_zeta(&checked, family->zeta, family->order) != BURNISH_LOBE_OK) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: order %d, zeta %g: make it with burnish_lobe_create()",
                            family->order, (double)family->zeta);
    }
    constants->body = family->order == 2 ? BURNISH_LOBE_BODY_SQUARE : BURNISH_LOBE_BODY_SQUARES;
    constants->squarings = squarings_of(family->order);
    constants->zeta = family->zeta;
    return BURNISH_STATUS_OK;
}

/* The exponent's constants; all fields are set, whichever the body reads. */
static void exponent_constants(float n, int body, burnish_kernels_lobe_constants *constants) {
    const double ln2 = 0.693147180559945309417, log2_e = 1.44269504088896340736;
    constants->body = body;
    constants->exponent = n;
    constants->whole = (uint32_t)n;
    constants->least = (float)(1.0 + burnish_expm1(-126.0 * ln2 / (double)n));
    constants->slope =
        body == BURNISH_LOBE_BODY_GAUSSIAN ? (float)(-((double)n + 0.775) * log2_e) : 0.5f * n;
}

burnish_status burnish_lobe_constants_make(const burnish_kernels_lobe *lobe,
                                           burnish_kernels_lobe_constants *constants,
                                           burnish_error *error) {
    static const int bodies[BURNISH_KERNELS_LOBE_KIND_COUNT] = {
        [BURNISH_KERNELS_POWER] = BURNISH_LOBE_BODY_POWER,
        [BURNISH_KERNELS_WHOLE_POWER] = BURNISH_LOBE_BODY_MULTIPLY,
        [BURNISH_KERNELS_SCHLICK] = BURNISH_LOBE_BODY_SCHLICK,
        [BURNISH_KERNELS_GAUSSIAN] = BURNISH_LOBE_BODY_GAUSSIAN,
        [BURNISH_KERNELS_GX] = BURNISH_LOBE_BODY_GX,
    };
    memset(constants, 0, sizeof *constants);
    constants->body = BURNISH_LOBE_BODY_NONE;
    if ((unsigned)lobe->kind >= BURNISH_KERNELS_LOBE_KIND_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: kind %d does not exist",
                            (int)lobe->kind);
    }
    if (lobe->kind == BURNISH_KERNELS_FAMILY) {
        return family_constants(&lobe->family, constants, error);
    }
    if (lobe->kind == BURNISH_KERNELS_DARK) {
        return BURNISH_STATUS_OK;
    }
    const float n = lobe->exponent;
    if (!(n >= BURNISH_LOBE_EXPONENT_MIN && n <= BURNISH_LOBE_EXPONENT_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: exponent %g is not in [1, 65536]", (double)n);
    }
    if (lobe->kind == BURNISH_KERNELS_WHOLE_POWER && n != (float)(uint32_t)n) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: exponent %g is not a whole number; take BURNISH_KERNELS_POWER",
                            (double)n);
    }
    exponent_constants(n, bodies[lobe->kind], constants);
    return BURNISH_STATUS_OK;
}

burnish_kernels_lighting burnish_kernels_lighting_default(void) {
    burnish_kernels_lighting lighting;
    memset(&lighting, 0, sizeof lighting);
    lighting.cookie = LIGHTING_COOKIE;
    for (int k = 0; k < 3; ++k) {
        lighting.ambient[k] = 0.05f;
        lighting.diffuse[k] = 0.6f;
        lighting.specular[k] = 0.35f;
        lighting.lights[0].color[k] = 1.0f;
    }
    lighting.lobe.kind = BURNISH_KERNELS_FAMILY;
    (void)burnish_lobe_create(&lighting.lobe.family, BURNISH_FIT_ENERGY, 2, 32.0f);
    lighting.lobe.exponent = 32.0f;
    lighting.viewer[2] = 1.0f;
    lighting.light_count = 1;
    lighting.lights[0].vector[0] = -0.48f;
    lighting.lights[0].vector[1] = 0.6f;
    lighting.lights[0].vector[2] = 0.64f;
    return lighting;
}

static int is_color(const float color[3]) {
    for (int k = 0; k < 3; ++k) {
        if (!(color[k] >= 0.0f && color[k] <= LARGEST_COLOR)) {
            return 0;
        }
    }
    return 1;
}

static int is_place(const float place[3]) {
    const float limit = 0x1p60f;
    for (int k = 0; k < 3; ++k) {
        if (!(place[k] >= -limit && place[k] <= limit)) {
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

static burnish_status check_lights(const burnish_kernels_lighting *lighting, burnish_error *error) {
    if (lighting->light_count < 0 || lighting->light_count > BURNISH_KERNELS_LIGHT_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lights: %d is not in [0, %d]",
                            lighting->light_count, BURNISH_KERNELS_LIGHT_MAX);
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        const burnish_kernels_light *light = &lighting->lights[i];
        int good =
            light->kind == BURNISH_KERNELS_POINT ? is_place(light->vector) : is_unit(light->vector);
        if ((unsigned)light->kind > BURNISH_KERNELS_POINT || !good || !is_color(light->color)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "light %d: needs a place within 2^60 or a unit vector, and a "
                                "colour in [0, 1e6]",
                                i + 1);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_lighting(const burnish_kernels_lighting *lighting,
                                     burnish_error *error) {
    if (lighting->cookie != LIGHTING_COOKIE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: start from burnish_kernels_lighting_default()");
    }
    if (!is_color(lighting->ambient) || !is_color(lighting->diffuse) ||
        !is_color(lighting->specular)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: ambient, diffuse and specular must be in [0, 1e6]");
    }
    if ((unsigned)lighting->highlight > BURNISH_KERNELS_PHONG) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lighting: highlight %d does not exist",
                            (int)lighting->highlight);
    }
    if (lighting->lyon && (lighting->highlight != BURNISH_KERNELS_BLINN ||
                           lighting->lobe.kind != BURNISH_KERNELS_FAMILY)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: lyon goes with the family and Blinn's cosine only");
    }
    if (lighting->near_viewer ? !is_place(lighting->viewer) : !is_unit(lighting->viewer)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lighting: the viewer must be a place within 2^60 or a unit vector");
    }
    return check_lights(lighting, error);
}

/* The unit vector between two. Opposite ones have none: (0, 0, 0). */
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

static void fold_light(const burnish_kernels_lighting *lighting, const burnish_kernels_light *light,
                       const burnish_kernels_shader *shader,
                       burnish_kernels_light_constants *constants) {
    double half[3], slope = shader->lobe.zeta > 0.0f ? (double)shader->lobe.zeta : 1.0;
    constants->is_point = light->kind == BURNISH_KERNELS_POINT;
    find_half(light->vector, lighting->viewer, half);
    for (int k = 0; k < 3; ++k) {
        const float diffuse = lighting->diffuse[k] * light->color[k];
        const float specular = lighting->specular[k] * light->color[k];
        constants->vector[k] = light->vector[k];
        constants->half[k] = (float)(half[k] * slope);
        constants->diffuse[BURNISH_SHADE_FLOAT][k] = diffuse;
        constants->diffuse[BURNISH_SHADE_RGBA8][k] = 255.0f * diffuse;
        constants->specular[BURNISH_SHADE_FLOAT][k] = specular;
        constants->specular[BURNISH_SHADE_RGBA8][k] = 255.0f * specular;
    }
}

/* Below this cosine the family is dark whatever the rounding: 1e-5 is ten times what the cosine of
 * a point can be off. */
static float find_cutoff(const burnish_kernels_lobe_constants *lobe) {
    double cutoff = lobe->zeta > 0.0f ? 1.0 - 1.0 / (double)lobe->zeta - 1e-5 : -1.0;
    return cutoff > 0.0 ? (float)cutoff : -1.0f;
}

burnish_status burnish_kernels_prepare(const burnish_kernels_lighting *lighting,
                                       burnish_kernels_shader *shader, burnish_error *error) {
    shader->cookie = 0;
    burnish_status status = check_lighting(lighting, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_lobe_constants_make(&lighting->lobe, &shader->lobe, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const float *ks = lighting->specular;
    if (ks[0] == 0.0f && ks[1] == 0.0f && ks[2] == 0.0f) {
        shader->lobe.body = BURNISH_LOBE_BODY_NONE;
    }
    shader->phong = lighting->highlight == BURNISH_KERNELS_PHONG;
    shader->lyon = lighting->lyon != 0;
    shader->near_viewer = lighting->near_viewer != 0;
    shader->needs_position = shader->near_viewer;
    shader->light_count = lighting->light_count;
    shader->offset = (float)(1.0 - (double)shader->lobe.zeta);
    shader->cutoff = shader->lyon ? -1.0f : find_cutoff(&shader->lobe);
    for (int k = 0; k < 3; ++k) {
        shader->viewer[k] = lighting->viewer[k];
        shader->ambient[BURNISH_SHADE_FLOAT][k] = lighting->ambient[k];
        shader->ambient[BURNISH_SHADE_RGBA8][k] = 255.0f * lighting->ambient[k];
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        fold_light(lighting, &lighting->lights[i], shader, &shader->lights[i]);
        shader->needs_position |= shader->lights[i].is_point;
    }
    shader->geometry = shader->phong || shader->lyon || shader->needs_position
                           ? BURNISH_SHADE_GENERAL
                           : BURNISH_SHADE_DISTANT;
    shader->cookie = BURNISH_SHADER_COOKIE;
    return BURNISH_STATUS_OK;
}
