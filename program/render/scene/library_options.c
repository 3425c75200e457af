#include "render/scene/library_options.h"
#include "burnish/look.h"

#include <string.h>

#include "import/load_input.h"
#include "render/scene/color.h"
#include "render/settings/flag_values.h"

burnish_load_options render_load_options(const render_input_settings *input, int threads) {
    burnish_load_options options = cli_load_options(&input->load);
    if (input->crease.given) {
        options.crease_angle = input->crease.value;
    }
    options.normals = (burnish_normals_source)input->normals;
    if (render_colors_by_property(&input->coloring)) {
        options.scalar_property = input->coloring.by;
        options.keep_texture_coordinates = 1;
    }
    options.threads = threads;
    options.measure = /* only solids are filled */
        input->measure || input->clip.count > 0 || input->section.axis > 0;
    return options;
}

burnish_status render_load(const render_input_settings *input, int threads, burnish_mesh **mesh,
                           burnish_error *error) {
    const burnish_load_options options = render_load_options(input, threads);
    return input->load.items
               ? import_load_items(input->name, input->load.items, &options, mesh, error)
               : import_load(input->name, &options, mesh, error);
}

int render_has_own_lobe(const render_shading_settings *shading) {
    const burnish_lobe_spec *lobe = &shading->lobes.items[0];
    const burnish_lobe_spec usual = burnish_render_options_default().lobe;
    return shading->lobes.count > 1 || lobe->kind != usual.kind || lobe->fit != usual.fit ||
           lobe->order != usual.order || lobe->by_material != usual.by_material ||
           shading->equation != BURNISH_SPECULAR_BLINN;
}

/* Makes wide light take the exponent of a material that has a roughness. */
static void make_phong(burnish_material *material) {
    if (!material->is_metallic) {
        material->metallic = material->roughness = 0;
        memset(material->reflectance, 0, sizeof material->reflectance);
    }
}

/* Whether light comes from more than points and single directions. */
static int has_wide_light(const render_shading_settings *shading) {
    return shading->environment.name ||
           (shading->lights.given ? shading->lights.area_count > 0
                                  : shading->look == BURNISH_LOOK_STUDIO);
}

static void drop_layers(burnish_material *material) {
    memset(material->sheen, 0, sizeof material->sheen);
    memset(material->anisotropy, 0, sizeof material->anisotropy);
    material->coat = material->edge_loss = material->iridescence = 0;
}

static void apply_preset(const render_preset *preset, int is_wide, burnish_material *material) {
    if (is_wide) { /* the roughness of a texture, too, would be another material */
        material->metallic = preset->metallic;
        material->roughness = preset->roughness;
        memset(&material->textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS], 0,
               sizeof *material->textures);
    } else {
        make_phong(material);
    }
    for (int k = 0; k < 3; ++k) {
        float tint = 1 + preset->tint * (material->diffuse[k] - 1);
        float factor = is_wide ? 1 : preset->diffuse;
        material->specular[k] = preset->specular * tint;
        material->reflectance[k] = is_wide ? preset->reflectance : material->reflectance[k];
        material->diffuse[k] *= factor;
        material->ambient[k] *= factor; /* the base colour in wide light */
    }
    material->exponent = preset->exponent;
    material->has_exponent = 1;
    drop_layers(material);
}

/* A solid of clear glass, which the object's own colour tints where light enters. */
static void make_glass(const render_preset *preset, burnish_material *material) {
    for (int k = 0; k < 3; ++k) {
        const float base = material->is_metallic ? material->diffuse[k] : material->ambient[k];
        material->diffuse[k] = material->ambient[k] = material->has_diffuse ? base : 1;
        material->reflectance[k] = preset->reflectance;
    }
    for (int i = 0; i < BURNISH_TEXTURE_SLOT_COUNT; ++i) {
        if (i != BURNISH_TEXTURE_COLOR && i != BURNISH_TEXTURE_OPACITY &&
            i != BURNISH_TEXTURE_NORMAL) {
            memset(&material->textures[i], 0, sizeof material->textures[i]);
        }
    }
    memset(material->anisotropy, 0, sizeof material->anisotropy);
    material->metallic = material->edge_loss = 0;
    material->roughness = preset->roughness;
    material->is_metallic = 1;
    material->is_unlit = 0;
    material->transmission = 1;
    material->thickness = 1;
    material->refractive_index = 1.5F;
    material->attenuation_distance = 0;
    material->transparency =
        material->alpha_mode == BURNISH_ALPHA_MASK ? material->transparency : 0;
}

/* One material, changed by the flags. */
static burnish_material adjusted_material(const render_shading_settings *shading,
                                          burnish_material material) {
    if (shading->color.given) {
        for (int k = 0; k < 3; ++k) {
            material.diffuse[k] = burnish_srgb_decode(shading->color.srgb[k]);
            material.ambient[k] = material.diffuse[k];
        }
        material.has_diffuse = 1;
    }
    if (shading->material == RENDER_GLASS) {
        make_glass(&render_presets[RENDER_GLASS - 1], &material);
    } else if (shading->material > 0) {
        apply_preset(&render_presets[shading->material - 1], has_wide_light(shading), &material);
    }
    if (shading->specular.given || shading->exponent.given) {
        make_phong(&material);
    }
    if (shading->specular.given) {
        drop_layers(&material);
    }
    for (int k = 0; k < 3 && shading->specular.given; ++k) {
        material.specular[k] = (float)shading->specular.value;
    }
    if (shading->exponent.given) {
        material.exponent = (float)shading->exponent.value;
        material.has_exponent = 1;
    }
    if (shading->opacity.given) {
        material.transparency = 1 - (float)shading->opacity.value * (1 - material.transparency);
    }
    return material;
}

/* What a surface reflects at least in the studio: black plastic. */
#define LEAST_REFLECTED 0.035F

static float largest_of(const float color[3]) {
    float largest = 0;
    for (int k = 0; k < 3; ++k) {
        largest = color[k] > largest ? color[k] : largest;
    }
    return largest;
}

/* Whether a material reflects less than `least` and emits nothing, so no light can show its shape. */
static int is_black(const burnish_material *material, float least) {
    const float specular = material->is_metallic ? 0 : largest_of(material->specular);
    const float reflectance = largest_of(material->reflectance) * (1 - material->metallic);
    int is_textured = 0;
    for (int i = 0; i < BURNISH_TEXTURE_SLOT_COUNT; ++i) {
        is_textured |= material->textures[i].texture != 0;
    }
    return material->has_diffuse && !material->is_unlit && !is_textured && material->coat == 0 &&
           material->iridescence == 0 && largest_of(material->sheen) == 0 &&
           largest_of(material->emissive) == 0 && largest_of(material->diffuse) < least &&
           specular < least && reflectance < least;
}

/* Whether a file states that nothing of it reflects light, as exporters do by mistake. */
static int is_wholly_black(const burnish_mesh *mesh) {
    const size_t count = burnish_mesh_get_material_count(mesh);
    int is_black_so_far = count > 0 && !burnish_mesh_get_view(mesh)->colors;
    for (size_t i = 0; i < count && is_black_so_far; ++i) {
        is_black_so_far = is_black(burnish_mesh_get_material(mesh, i), 1.0F / 512);
    }
    return is_black_so_far;
}

/* Keeps what hue there is, and adds the highlight of smooth plastic. */
static void lift_black(burnish_material *material) {
    const float more = LEAST_REFLECTED - largest_of(material->diffuse);
    for (int k = 0; k < 3; ++k) {
        material->diffuse[k] += more;
        material->ambient[k] = material->diffuse[k];
        material->specular[k] = 0.35F;
        material->reflectance[k] = 0.04F;
    }
    material->metallic = material->edge_loss = 0;
    material->roughness = 0.35F;
}

/* Takes the look's materials; if is_plain, of a mesh without colours. */
static burnish_status take_look(burnish_look look, int is_plain, burnish_mesh *mesh,
                                burnish_error *error) {
    const size_t count = is_plain ? burnish_mesh_get_material_count(mesh) : 0;
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_material plain = burnish_material_default();
        plain.transparency = burnish_mesh_get_material(mesh, i)->transparency;
        status = burnish_mesh_set_material(mesh, i, &plain, error);
    }
    return status == BURNISH_STATUS_OK ? burnish_look_set_materials(look, mesh, error) : status;
}

burnish_status render_adjust_materials(const render_shading_settings *shading, burnish_mesh *mesh,
                                       render_blacks *blacks, burnish_error *error) {
    const burnish_look look = (burnish_look)shading->look;
    const size_t count = burnish_mesh_get_material_count(mesh);
    burnish_status status = take_look(look, shading->no_colors, mesh, error);
    *blacks = (render_blacks){0, !shading->color.given && is_wholly_black(mesh)};
    if (blacks->are_all && status == BURNISH_STATUS_OK) {
        status = take_look(look, 1, mesh, error);
    }
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_material material = adjusted_material(shading, *burnish_mesh_get_material(mesh, i));
        if (look == BURNISH_LOOK_STUDIO && !shading->specular.given &&
            is_black(&material, LEAST_REFLECTED)) {
            lift_black(&material);
            ++blacks->lifted;
        }
        status = burnish_mesh_set_material(mesh, i, &material, error);
    }
    return status;
}

int render_is_calibrated(const render_settings *settings) {
    const render_camera_settings *camera = &settings->camera;
    return camera->intrinsics.given && camera->position.given &&
           settings->picture.views.count == 0 && camera->projection != PROJECTION_PARALLEL &&
           !camera->orthographic_height.given && !camera->same_scale;
}

burnish_render_options render_make_options(const render_settings *settings) {
    const render_shading_settings *shading = &settings->shading;
    const render_picture_settings *picture = &settings->picture;
    burnish_render_options options; /* made where it is returned: it is large */
    burnish_render_options_init(&options, BURNISH_LAYOUT(burnish_render_options));
    burnish_render_options_set_look(&options, (burnish_look)shading->look, NULL);
    if (render_is_calibrated(settings)) {
        const double *k = settings->camera.intrinsics.values;
        options.pixel_aspect = k[1] / k[0];
        options.principal_point[0] = k[2] + 0.5 - picture->size[0] / 2.0;
        options.principal_point[1] = picture->size[1] / 2.0 - k[3] - 0.5;
    }
    options.width = picture->size[0];
    options.height = picture->size[1];
    options.first_row = picture->rows.first;
    options.row_count = picture->rows.count;
    options.samples = picture->samples;
    options.max_overdraw = settings->job.max_overdraw.value;
    options.threads = settings->job.threads;
    options.kernels = burnish_kernels_for(settings->job.isa);
    options.specular_model = (burnish_specular_model)shading->equation;
    options.local_viewer = shading->viewer;
    options.ignore_colors |= shading->color.given || shading->no_colors;
    options.cull_back_faces = picture->cull_back_faces > 0;
    options.transparent = picture->background.transparent;
    options.background_environment = picture->background.environment;
    if (shading->environment.name) { /* instead of the rig */
        options.light_count = options.area_light_count = options.has_dome = 0;
        memset(options.ambient_light, 0, sizeof options.ambient_light);
    }
    options.environment_strength = (float)shading->environment.strength.value;
    options.environment_turn = shading->environment.turn.value;
    if (shading->ambient.given) {
        memcpy(options.ambient_light, shading->ambient.linear, sizeof options.ambient_light);
    }
    if (shading->occlusion.given) {
        options.occlusion = shading->occlusion.directions;
    }
    if (shading->edges.given) {
        options.edges = shading->edges.kinds;
    }
    if (shading->wireframe) {
        options.edges = (options.edges & BURNISH_EDGES_FEATURES) | BURNISH_EDGES_ALL;
    }
    if (shading->hidden_lines || shading->center_lines) {
        options.edges = (options.edges & ~(unsigned)BURNISH_EDGES_AXIS_VIEWS) |
                        (options.edges & (BURNISH_EDGES_FEATURES | BURNISH_EDGES_ALL)
                             ? 0
                             : BURNISH_EDGES_FEATURES) |
                        (shading->hidden_lines ? BURNISH_EDGES_HIDDEN : 0) |
                        (shading->center_lines ? BURNISH_EDGES_CENTERS : 0);
    }
    if (shading->edge_width.given) {
        options.edge_width = (float)shading->edge_width.value;
    }
    for (int k = 0; k < 3 && shading->edge_color.given; ++k) {
        options.edge_color[k] = cli_color_code(shading->edge_color.srgb[k]);
    }
    if (shading->outline_contrast.given) {
        options.outline_contrast = (int)shading->outline_contrast.value;
    }
    const int is_drawing = shading->look == BURNISH_LOOK_DRAWING;
    options.exposure = is_drawing ? 0 : (float)shading->exposure.value;
    if (!is_drawing && shading->tone_mapping) {
        options.tone_mapping = (burnish_tone_mapping)(shading->tone_mapping - 1);
    }
    options.ground = shading->ground > 0;
    options.shadow = shading->shadow;
    options.raytracing = shading->raytracing;
    if (shading->raytracing && !is_drawing && !shading->occlusion.given && options.occlusion == 0) {
        options.occlusion = BURNISH_OCCLUSION_AUTO;
    }
    if (shading->lights.given) {
        memcpy(options.lights, shading->lights.items, sizeof options.lights);
        options.light_count = shading->lights.count;
        memcpy(options.area_lights, shading->lights.areas, sizeof options.area_lights);
        options.area_light_count = shading->lights.area_count;
        options.has_dome = 0;
        options.reflection_distance = 0;
    }
    if (picture->background.given) {
        for (int k = 0; k < 3; ++k) {
            options.background[k] = cli_color_code(picture->background.srgb[k]);
        }
    }
    return options;
}
