#include "render/scene/origin.h"
#include "render/scene/options.h"

static void subtract(double position[3], const double origin[3]) {
    for (int k = 0; k < 3; ++k) {
        position[k] -= origin[k];
    }
}

/* normal . origin: the offset in coordinates of the file minus the offset in the mesh's */
static double along(const burnish_clip_plane *plane, const double origin[3]) {
    const double *n = plane->normal;
    return n[0] * origin[0] + n[1] * origin[1] + n[2] * origin[2];
}

double render_file_offset(const burnish_clip_plane *plane, const double origin[3]) {
    return plane->offset + along(plane, origin);
}

void render_subtract_origin(render_camera_settings *camera, render_clip *clip,
                            burnish_render_options *options, const double origin[3]) {
    subtract(camera->position.values, origin);
    subtract(camera->focal_point.values, origin);
    for (int i = 0; i < clip->count; ++i) {
        clip->items[i].offset -= along(&clip->items[i], origin);
    }
    for (int i = 0; i < options->light_count; ++i) {
        burnish_light *light = &options->lights[i];
        if (light->kind == BURNISH_LIGHT_POINT && !light->follows_camera) {
            subtract(light->vector, origin);
        }
    }
    for (int i = 0; i < options->area_light_count; ++i) {
        burnish_area_light *light = &options->area_lights[i];
        if (!light->is_distant && !light->follows_camera) {
            subtract(light->center, origin);
        }
    }
}

void render_drop_file_lights(render_settings *settings, const burnish_mesh *mesh,
                             burnish_render_options *options) {
    render_lights *lights = &settings->shading.lights;
    if (lights->of_file && burnish_mesh_get_light_count(mesh) == 0) {
        lights->of_file = 0;
        lights->given = lights->count + lights->area_count > 0;
        *options = render_make_options(settings);
    }
}

static burnish_status add_own_lights(const burnish_mesh *mesh, burnish_render_options *options,
                                     render_light_warnings *warnings, burnish_error *error) {
    const size_t count = burnish_mesh_get_light_count(mesh);
    if (count > (size_t)(BURNISH_LIGHT_MAX - options->light_count)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--light: %d lights and %zu of the input are more than %d; omit some",
                        options->light_count, count, BURNISH_LIGHT_MAX);
    }
    for (size_t i = 0; i < count; ++i) {
        const burnish_file_light *own = burnish_mesh_get_light(mesh, i);
        options->lights[options->light_count++] = own->light;
        if (own->is_spot) {
            warnings->spot = "--light=file: spot lights shine in all directions, like point lights";
        }
    }
    return BURNISH_STATUS_OK;
}

/* As the renderer chooses the light of the shadow. */
static int casts_shadow(const burnish_render_options *options) {
    return options->light_count > 0 ? options->lights[0].kind == BURNISH_LIGHT_DIRECTIONAL
                                    : options->area_light_count > 0;
}

burnish_status render_add_own_lights(const render_settings *settings, const burnish_mesh *mesh,
                                     burnish_render_options *options,
                                     render_light_warnings *warnings, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    *warnings = (render_light_warnings){0};
    if (settings->shading.lights.of_file) {
        status = add_own_lights(mesh, options, warnings, error);
    }
    if (status == BURNISH_STATUS_OK && options->shadow && !casts_shadow(options)) {
        options->shadow = 0;
        static const char text[] =
            "--shadow: no effect: a directional light that comes first casts it, "
            "or an area light; use --light=directional:X,Y,Z";
        if (settings->input.load.strict) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "%s", text);
        }
        warnings->shadow = text;
    }
    return status;
}
