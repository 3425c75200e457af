/* Looks: sets of options by name. docs/gallery.md shows them. */
#include <string.h>

#include "render/frame.h"

typedef struct look {
    burnish_light rig[3];
    float ambient, grey[3], specular;
    uint8_t background[3];
    int occlusion;
    float occlusion_strength;
    int is_uniform; /* 1: every material becomes the look's */
} look;

/* Directions of key, fill and rim light, as in the default rig. */
#define KEY                                                                                        \
    { -0.55, 0.75, 0.85 }
#define FILL                                                                                       \
    { 0.90, 0.15, 0.55 }
#define RIM                                                                                        \
    { 0.35, 0.60, -0.80 }
#define LIGHT BURNISH_LIGHT_DIRECTIONAL, 1

/* A surface that faces the key light gets key + ambient + a little fill = 0.79 linear, 0.9 of
 * white. The greys are as bright under these lights as burnish's 0.34 under the default rig. */
static const look LOOKS[BURNISH_LOOK_COUNT] = {
    [BURNISH_LOOK_STUDIO] = {.rig = {{LIGHT, KEY, {0.70f, 0.685f, 0.65f}},
                                     {LIGHT, FILL, {0.16f, 0.185f, 0.22f}},
                                     {LIGHT, RIM, {0.36f, 0.36f, 0.38f}}},
                             .ambient = 0.08f,
                             .grey = {0.54f, 0.54f, 0.54f},
                             .specular = 0.75f,
                             .background = {238, 239, 241},
                             .occlusion = BURNISH_OCCLUSION_AUTO,
                             .occlusion_strength = 0.8f},
    [BURNISH_LOOK_CLAY] = {.rig = {{LIGHT, KEY, {0.60f, 0.59f, 0.57f}},
                                   {LIGHT, FILL, {0.14f, 0.16f, 0.19f}},
                                   {LIGHT, RIM, {0.25f, 0.25f, 0.26f}}},
                           .ambient = 0.18f,
                           .grey = {0.62f, 0.50f, 0.40f},
                           .specular = 0.03f,
                           .background = {238, 239, 241},
                           .occlusion = BURNISH_OCCLUSION_AUTO,
                           .occlusion_strength = 0.95f,
                           .is_uniform = 1},
};

static burnish_status set_materials(burnish_mesh *mesh, const look *wanted, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    const size_t count = mesh ? burnish_mesh_material_count(mesh) : 0;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_material material = *burnish_mesh_material(mesh, i);
        if (material.has_diffuse && !wanted->is_uniform) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            material.ambient[k] = material.diffuse[k] = wanted->grey[k];
            material.specular[k] = wanted->specular;
        }
        material.transparency = wanted->is_uniform ? 0 : material.transparency;
        status = burnish_mesh_set_material(mesh, i, &material, error);
    }
    return status;
}

burnish_status burnish_render_options_set_look(burnish_render_options *options, burnish_look name,
                                               burnish_mesh *mesh, burnish_error *error) {
    const burnish_render_options plain = burnish_render_options_default();
    if (!options || options->cookie != plain.cookie || (unsigned)name >= BURNISH_LOOK_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "look %d: options from burnish_render_options_default(), and a look "
                            "below %d, are expected",
                            (int)name, BURNISH_LOOK_COUNT);
    }
    const look *wanted = &LOOKS[name];
    const int is_plain = name == BURNISH_LOOK_PLAIN;
    memcpy(options->lights, is_plain ? plain.lights : wanted->rig, sizeof wanted->rig);
    options->light_count = 3;
    options->occlusion = wanted->occlusion;
    options->occlusion_strength = is_plain ? plain.occlusion_strength : wanted->occlusion_strength;
    options->ignore_colors = wanted->is_uniform;
    for (int k = 0; k < 3; ++k) {
        options->ambient_light[k] = is_plain ? plain.ambient_light[k] : wanted->ambient;
        options->background[k] = is_plain ? plain.background[k] : wanted->background[k];
    }
    return is_plain ? BURNISH_STATUS_OK : set_materials(mesh, wanted, error);
}
