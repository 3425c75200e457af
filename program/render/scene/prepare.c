#include "render/scene/prepare.h"

#include "render/scene/cameras.h"
#include "render/scene/color.h"
#include "render/scene/library_options.h"
#include "render/scene/up.h"
#include "render/scene/winding.h"

void render_warn_of_mesh(render_warnings *warnings, const burnish_mesh *mesh) {
    for (size_t i = 0; i < burnish_mesh_get_warning_count(mesh); ++i) {
        render_warn(warnings, 1, "%s", burnish_mesh_get_warning(mesh, i));
    }
}

/* ---- Coordinates ---- */

static void subtract_origin(double position[3], const double origin[3]) {
    for (int k = 0; k < 3; ++k) {
        position[k] -= origin[k];
    }
}

/* normal . origin: the offset in coordinates of the file minus the offset in the mesh's */
static double dot_origin(const burnish_clip_plane *plane, const double origin[3]) {
    const double *n = plane->normal;
    return n[0] * origin[0] + n[1] * origin[1] + n[2] * origin[2];
}

double render_file_offset(const burnish_clip_plane *plane, const double origin[3]) {
    return plane->offset + dot_origin(plane, origin);
}

static void move_cuts(render_clip *clip, const double origin[3]) {
    for (int i = 0; i < clip->count; ++i) {
        clip->items[i].offset -= dot_origin(&clip->items[i], origin);
    }
}

static void move_camera_and_lights(render_camera_settings *camera, burnish_render_options *options,
                                   const double origin[3]) {
    subtract_origin(camera->position.values, origin);
    subtract_origin(camera->focal_point.values, origin);
    for (int i = 0; i < options->light_count; ++i) {
        burnish_light *light = &options->lights[i];
        if (light->kind == BURNISH_LIGHT_POINT && !light->follows_camera) {
            subtract_origin(light->vector, origin);
        }
    }
    for (int i = 0; i < options->area_light_count; ++i) {
        burnish_area_light *light = &options->area_lights[i];
        if (!light->is_distant && !light->follows_camera) {
            subtract_origin(light->center, origin);
        }
    }
}

/* ---- Cuts ---- */

/* Why a cut is not filled. */
static void warn_open(const render_scene *scene) {
    const burnish_mesh_facts *facts = burnish_mesh_get_facts(scene->mesh);
    const char *input = scene->settings->input.name;
    if (!facts) {
        render_warn(scene->warnings, 1, "%.300s: cut but not filled: %s have no volume", input,
                    burnish_mesh_get_info(scene->mesh)->line_count > 0 ? "lines" : "points");
    } else if (!facts->is_closed) {
        render_warn(scene->warnings, 1,
                    "%.300s: cut but not filled: the mesh is not closed; %zu of its edges are open",
                    input, facts->open_edge_count);
    } else {
        render_warn(scene->warnings, 1,
                    "%.300s: cut but not filled: the mesh is not a solid; its winding is "
                    "inconsistent or it has no volume",
                    input);
    }
}

static burnish_status cut_mesh(const render_scene *scene, const render_clip *clip,
                               burnish_error *error) {
    const burnish_mesh_view *view = burnish_mesh_get_view(scene->mesh);
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < clip->count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_clip_plane *plane = &clip->items[i];
        const int before = view->cut_count;
        status = burnish_mesh_clip(scene->mesh, plane, error);
        if (status == BURNISH_STATUS_ARGUMENT) { /* "clip: ..." is a flag in the program */
            const burnish_error reason = *error;
            cli_fail(error, status, "--%s", reason.text);
        }
        if (status == BURNISH_STATUS_OK && view->cut_count == before) {
            render_warn(scene->warnings, 1,
                        "%.300s: no part of the mesh is beyond the plane %g,%g,%g,%g; "
                        "--section=x cuts through its middle",
                        scene->settings->input.name, plane->normal[0], plane->normal[1],
                        plane->normal[2], render_file_offset(plane, view->origin));
        }
    }
    if (status == BURNISH_STATUS_OK && view->cut_count > 0 &&
        view->inside == BURNISH_INSIDE_UNKNOWN) {
        warn_open(scene);
    }
    return status;
}

burnish_status render_cut_section(const render_scene *scene, burnish_error *error) {
    const render_clip clip = {{scene->settings->input.section.plane}, 1};
    return cut_mesh(scene, &clip, error);
}

/* Sets the plane of --section in the mesh's coordinates, and unless the picture is a sheet that also
 * shows the whole object, cuts by it. */
static burnish_status section_mesh(const render_scene *scene, burnish_error *error) {
    render_section *section = &scene->settings->input.section;
    const burnish_mesh_view *view = burnish_mesh_get_view(scene->mesh);
    const int k = section->axis - 1;
    const double low = (double)view->bounds_min[k], high = (double)view->bounds_max[k];
    const double at =
        section->offset.given ? section->offset.value - view->origin[k] : (low + high) / 2;
    if (!(at > low && at < high)) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--section: %c = %g does not cut the object; use an offset between %g and %g", 'x' + k,
            at + view->origin[k], low + view->origin[k], high + view->origin[k]);
    }
    render_section_view(scene->mesh, scene->settings, section->plane.normal);
    section->plane.offset = section->plane.normal[k] * at;
    return scene->settings->picture.views.layout == VIEW_FREE ? render_cut_section(scene, error)
                                                              : BURNISH_STATUS_OK;
}

/* ---- Lights ---- */

/* Forgets --light=file if the mesh has no lights: the look's shine, unless there are others. */
static void drop_file_lights(render_lights *lights, const burnish_mesh *mesh) {
    if (lights->of_file && burnish_mesh_get_light_count(mesh) == 0) {
        lights->of_file = 0;
        lights->given = lights->count + lights->area_count > 0;
    }
}

/* Adds the mesh's own lights, which are in its coordinates. */
static burnish_status add_file_lights(const render_scene *scene, burnish_error *error) {
    burnish_render_options *options = scene->options;
    const size_t count = burnish_mesh_get_light_count(scene->mesh);
    if (count > (size_t)(BURNISH_LIGHT_MAX - options->light_count)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--light: %d lights and %zu of the input are more than %d; omit some",
                        options->light_count, count, BURNISH_LIGHT_MAX);
    }
    for (size_t i = 0; i < count; ++i) {
        options->lights[options->light_count++] = *burnish_mesh_get_light(scene->mesh, i);
    }
    return BURNISH_STATUS_OK;
}

/* As the renderer chooses the light of the shadow. */
static int casts_shadow(const burnish_render_options *options) {
    return options->light_count > 0 ? options->lights[0].kind == BURNISH_LIGHT_DIRECTIONAL
                                    : options->area_light_count > 0;
}

static burnish_status drop_shadow(const render_scene *scene, burnish_error *error) {
    static const char why[] = "--shadow: no effect: a directional light that comes first casts it, "
                              "or an area light; use --light=directional:X,Y,Z";
    if (!scene->options->shadow || casts_shadow(scene->options)) {
        return BURNISH_STATUS_OK;
    }
    scene->options->shadow = 0;
    if (scene->settings->input.load.strict) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "%s", why);
    }
    render_warn(scene->warnings, 1, "%s", why);
    return BURNISH_STATUS_OK;
}

/* Whether to draw the ground if neither flags nor outputs decide. */
static int wants_ground(const render_scene *scene) {
    const render_settings *settings = scene->settings;
    double up[3];
    render_upward(scene->mesh, &settings->camera, up);
    return settings->shading.ground == 0 && settings->shading.look == BURNISH_LOOK_STUDIO &&
           scene->options->occlusion != 0 && settings->picture.views.count == 0 &&
           render_stands(scene->mesh, up);
}

/* ---- The environment ---- */

static void log_warning(void *warnings, const char *line) {
    render_warn(warnings, 1, "%s", line);
}

static burnish_status make_environment(const render_scene *scene, burnish_error *error) {
    burnish_context_options logging = burnish_context_options_default();
    burnish_context *context;
    logging.log = log_warning;
    logging.log_user_data = scene->warnings;
    burnish_status status = burnish_context_create(&logging, &context, error);
    if (status == BURNISH_STATUS_OK) {
        status = render_make_environment(scene->settings, context, scene->environment, error);
        burnish_context_destroy(context);
    }
    scene->options->environment = scene->environment->environment;
    return status;
}

/* ---- All ---- */

burnish_status render_prepare_mesh(render_scene *scene, burnish_error *error) {
    render_settings *settings = scene->settings;
    move_cuts(&settings->input.clip, burnish_mesh_get_view(scene->mesh)->origin);
    render_set_stance(scene->mesh, &settings->camera); /* the whole object's */
    burnish_status status = cut_mesh(scene, &settings->input.clip, error);
    if (status == BURNISH_STATUS_OK && settings->input.section.axis > 0) {
        status = section_mesh(scene, error);
    }
    return status == BURNISH_STATUS_OK /* colours of what is left, by height above the ground */
               ? render_color(settings, scene->mesh, scene->color_range, error)
               : status;
}

burnish_status render_prepare_picture(render_scene *scene, burnish_error *error) {
    render_settings *settings = scene->settings;
    burnish_status status = BURNISH_STATUS_OK;
    drop_file_lights(&settings->shading.lights, scene->mesh);
    *scene->options = render_make_options(settings);
    move_camera_and_lights(&settings->camera, scene->options,
                           burnish_mesh_get_view(scene->mesh)->origin);
    if (settings->shading.lights.of_file) {
        status = add_file_lights(scene, error);
    }
    scene->options->ground |= wants_ground(scene);
    scene->options->cull_back_faces |=
        settings->picture.cull_back_faces == 0 && render_is_room(scene->mesh);
    if (status == BURNISH_STATUS_OK) {
        status = drop_shadow(scene, error);
    }
    if (status == BURNISH_STATUS_OK) { /* whose presets depend on the kinds of lights */
        render_blacks blacks;
        status = render_adjust_materials(&settings->shading, scene->mesh, &blacks, error);
        if (blacks.are_all) {
            render_warn(scene->warnings, 1,
                        "no material reflects light: drawn in the look's grey; use --color=black "
                        "--look=plain for black");
        }
        if (blacks.lifted > 0) {
            render_warn(scene->warnings, 1,
                        "materials that reflect almost nothing: %zu; drawn as dark grey with a "
                        "highlight, use --look=plain to see them black",
                        blacks.lifted);
        }
    }
    return status == BURNISH_STATUS_OK ? make_environment(scene, error) : status;
}

burnish_status render_prepare(render_scene *scene, burnish_error *error) {
    const burnish_status status = render_prepare_mesh(scene, error);
    return status == BURNISH_STATUS_OK ? render_prepare_picture(scene, error) : status;
}
