/* A flag without an effect is a warning, so users notice it. */
#include "render/useless.h"

#include <stdio.h>
#include <string.h>

#include "cli/main.h"
#include "picture/formats.h"
#include "render/output/projection.h"
#include "render/scene/library_options.h"

static int is_given(const render_settings *settings, const char *flag) {
    return cli_is_given(&render_command, settings, flag);
}

/* Whether a flag of a list was given. */
static int is_any_given(const render_settings *settings, const char *flags) {
    char name[CLI_NAME_MAX];
    for (const char *item = flags; item; item = strchr(item, ',')) {
        item += *item == ',';
        snprintf(name, sizeof name, "%.*s", (int)strcspn(item, ","), item);
        if (is_given(settings, name)) {
            return 1;
        }
    }
    return 0;
}

/* Whether any picture can have lines. Looks with lines only in views along an axis need a parallel
 * projection. */
static int has_lines(const render_settings *settings, int is_parallel) {
    const burnish_render_options options = render_make_options(settings);
    return options.edges == BURNISH_EDGES_AXIS_VIEWS ? is_parallel : options.edges != 0;
}

/* Whether some picture is a perspective, and whether some is parallel. A camera of the input can be
 * either. */
static int is_perspective(const render_settings *settings) {
    return settings->camera.own || settings->camera.projection == PROJECTION_PERSPECTIVE ||
           (settings->camera.projection == PROJECTION_AUTO && settings->picture.views.count == 0 &&
            !settings->camera.orthographic_height.given && !settings->camera.same_scale);
}

static int is_parallel(const render_settings *settings) {
    return settings->camera.own || !is_perspective(settings);
}

/* Whether light and opacity can change pixels. The areas of a drawing are as white as its paper, unless
 * a flag gives either another colour or a shade. */
static int is_shaded(const render_settings *settings) {
    static const char shades[] =
        "color,material,ambient,environment,occlusion,ground,shadow,clip,section,"
        "background-color,no-background,outline-contrast";
    return settings->shading.look != BURNISH_LOOK_DRAWING || is_any_given(settings, shades);
}

/* Refuses flags that do not affect an SVG, except --occlusion=none. */
static burnish_status check_svg(const render_settings *settings, burnish_error *error) {
    const int has_occlusion =
        settings->shading.occlusion.given && settings->shading.occlusion.directions != 0;
    for (size_t i = 0; i < render_command.flag_count; ++i) {
        const cli_flag *flag = &render_command.flags[i];
        if (flag->svg == CLI_SVG_REFUSED && is_given(settings, flag->name) &&
            (has_occlusion || strcmp(flag->name, "occlusion") != 0)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: it does not affect the lines and areas of %s; omit the flag, or "
                            "use the extension .png",
                            flag->name,
                            settings->output.format == PICTURE_PDF ? "a PDF" : "an SVG");
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status render_check_drawing(render_settings *settings, burnish_error *error) {
    if (settings->input.coloring.by && settings->shading.look == BURNISH_LOOK_DRAWING) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--color-by: a drawing has no colours; use another --look, or omit the flag");
    }
    return picture_is_drawing((picture_format)settings->output.format) ? check_svg(settings, error)
                                                                       : BURNISH_STATUS_OK;
}

/* The needs of flags for what is drawn: sheets, projections, colours and light. */
static size_t list_scene_needs(const render_settings *settings, cli_need *needs) {
    const render_camera_settings *camera = &settings->camera;
    const render_shading_settings *shading = &settings->shading;
    const int is_sheet = settings->picture.views.count > 1 || shading->lobes.count > 1 ||
                         settings->input.load.plate < 0;
    const int is_parallel_anyway = camera->orthographic_height.given ||
                                   settings->picture.views.count > 0 ||
                                   camera->projection == PROJECTION_PARALLEL;
    const int has_shades = is_shaded(settings);
    const char *by = settings->input.coloring.by;
    const cli_need list[] = {
        {"camera-orthographic-height,zoom,camera-focal-point,columns,labels,no-labels,font",
         !render_is_projection(settings),
         "a sheet of aligned views has its own layout; use other --views"},
        {"paper", render_is_projection(settings),
         "only aligned views have a page; use --views=third-angle"},
        {"resolution,size,width,height",
         settings->picture.paper == 0 || !render_is_projection(settings),
         "--paper sets the size of the page; omit one of them"},
        {"columns", is_sheet || settings->picture.is_on_sheet,
         "only a sheet has cells; use several --views or lobes"},
        {"labels,no-labels,font", is_sheet, "only a sheet has cells; use several --views or lobes"},
        {"labels,font", settings->input.load.plate >= 0,
         "a sheet of plates has their names; omit the flag"},
        {"labels,font", !is_sheet || !settings->picture.no_labels,
         "--no-labels omits the labels; omit it"},
        {"same-scale", is_sheet || !is_parallel_anyway,
         "only a sheet has several scales; use several --views or lobes"},
        {"same-scale", !is_sheet || !camera->orthographic_height.given,
         "--camera-orthographic-height already sets the scale; omit it"},
        {"camera", settings->picture.views.count == 0,
         "--views already sets the camera; omit one of them"},
        {"camera-view-angle", is_perspective(settings) || settings->picture.background.environment,
         "a parallel projection has no angle; use --camera-orthographic=no"},
        {"camera-intrinsics", render_is_calibrated(settings),
         "they belong to one perspective at an exact position; use --camera-position"},
        {"camera-view-angle,zoom,annotate,callouts", !render_is_calibrated(settings),
         "it is not possible with --camera-intrinsics; omit one of them"},
        {"viewer", is_perspective(settings),
         "the viewer of a parallel projection is distant; use --camera-orthographic=no"},
        {"margin",
         (!camera->position.given || settings->picture.views.count > 0 || is_parallel(settings)) &&
             !camera->orthographic_height.given,
         "other flags set the camera, so the object is not framed; omit one of them"},
        {"color-map,color-range,no-legend", by != NULL,
         "values of vertices are not shown; use --color-by"},
        {"color-map,color-range,no-legend", !by || strcmp(by, "normal") != 0,
         "the colours of --color-by=normal are directions; use another value"},
        {"raytracing",
         !shading->occlusion.given || shading->occlusion.directions != 0 || shading->shadow,
         "there is no occlusion or shadow to find; omit --occlusion=none"},
        {"raytracing",
         shading->look != BURNISH_LOOK_DRAWING || shading->occlusion.given || shading->shadow,
         "a drawing is not shaded; use another --look"},
        {"exposure,tone-mapping", settings->shading.look != BURNISH_LOOK_DRAWING,
         "a drawing is not shaded; use another --look"},
        {"opacity,specular,exponent,equation,viewer,light", has_shades,
         "a drawing is not shaded; use another --look"},
        {"lobe", has_shades || shading->lobes.count > 1,
         "a drawing is not shaded; use another --look"},
        {"environment-strength,environment-turn", shading->environment.name != NULL,
         "there is no environment; use --environment=sky, room or a file"},
        {"edge-width,edge-color", has_lines(settings, is_parallel(settings)),
         "no lines are drawn; use --edges"},
        {"outline-contrast", !settings->picture.background.transparent,
         "a transparent background has no colour; omit --no-background"},
    };
    _Static_assert(sizeof list / sizeof *list + 8 <= RENDER_NEEDS_MAX, "with those of files");
    memcpy(needs, list, sizeof list);
    return sizeof list / sizeof *list;
}

size_t render_list_needs(const render_settings *settings, cli_need needs[RENDER_NEEDS_MAX]) {
    const render_output_settings *output = &settings->output;
    const picture_format format = (picture_format)output->format;
    size_t count = list_scene_needs(settings, needs);
    needs[count++] =
        (cli_need){"resolution,size", !is_given(settings, "width") || !is_given(settings, "height"),
                   "--width and --height replace it; omit one of them"};
    needs[count++] = (cli_need){"camera", output->turntable == NULL,
                                "a turntable has cameras of its own; omit one of them"};
    needs[count++] = (cli_need){"frames,fps,play", output->turntable != NULL,
                                "only a turntable has frames; use --turntable=FILE"};
    needs[count++] = (cli_need){"quality", format == PICTURE_JPEG || format == PICTURE_WEBP,
                                "only JPEG and WebP have it; use the extension .jpg or .webp"};
    needs[count++] = (cli_need){
        "dpi",
        !output->turntable && (format == PICTURE_PNG || format == PICTURE_JPEG ||
                               picture_is_drawing(format) || render_is_projection(settings)),
        "only PNG, JPEG, SVG and PDF state it; use one of their extensions"};
    needs[count++] =
        (cli_need){"exposure,tone-mapping", format != PICTURE_EXR && format != PICTURE_NPY,
                   "EXR and NPY hold linear light; use another extension"};
    needs[count++] = (cli_need){"reference-threshold", output->reference != NULL,
                                "there is no reference; use --reference=FILE"};
    return count;
}

size_t render_list_input_needs(const render_settings *settings, const burnish_mesh *mesh,
                               cli_need needs[RENDER_NEEDS_MAX]) {
    size_t count = CLI_INPUT_NEEDS;
    const int is_free = settings->picture.views.count == 0 && !settings->output.turntable;
    const int has_camera = mesh && burnish_mesh_get_camera_count(mesh) > 0;
    cli_list_input_needs(mesh, needs);
    needs[count++] = (cli_need){"camera", has_camera || (mesh && !is_free),
                                "INPUT has no cameras; omit the flag"};
    needs[count++] = (cli_need){
        "light=file",
        mesh && (!settings->shading.lights.of_file || burnish_mesh_get_light_count(mesh)),
        "INPUT has no lights; omit the flag"};
    needs[count++] = (cli_need){
        "camera-direction,azimuth,elevation,camera-position,camera-view-up,camera-view-angle,"
        "camera-orthographic,camera-orthographic-height,same-scale,margin",
        mesh && !(settings->camera.own && is_free && has_camera),
        "the picture has a camera of INPUT; omit --camera"};
    needs[count++] = (cli_need){"edges,wireframe,hidden-lines,center-lines,edge-width,edge-color",
                                mesh && (burnish_mesh_get_info(mesh)->point_count == 0 ||
                                         burnish_mesh_get_view(mesh)->splats),
                                "points have no edges; omit the flag"};
    needs[count++] = (cli_need){
        "color,no-colors,material,opacity,specular,exponent,lobe,equation,viewer,light,ambient,"
        "exposure,tone-mapping,occlusion,ground,shadow,edges,wireframe,hidden-lines,"
        "center-lines,outline-contrast,samples,normals,point-size",
        mesh && !burnish_mesh_get_view(mesh)->splats,
        "splats have colours of their own and no light; omit the flag"};
    needs[count++] =
        (cli_need){"raytracing", mesh && burnish_mesh_get_view(mesh)->point_radius == 0,
                   "rays are cast at triangles, not at points or splats; omit the flag"};
    return count;
}

burnish_status render_warn_needs(render_result *result, const cli_need *needs, size_t count,
                                 burnish_error *error) {
    burnish_error line;
    for (size_t at = 0;
         cli_next_useless(&render_command, result->settings, needs, count, &at, &line);) {
        if (result->settings->input.load.strict) {
            *error = line;
            return line.status;
        }
        render_warn(&result->warnings, 1, "%s", line.text);
    }
    return BURNISH_STATUS_OK;
}

burnish_status render_warn_useless(render_result *result, const burnish_mesh *mesh,
                                   burnish_error *error) {
    cli_need needs[RENDER_NEEDS_MAX];
    const size_t count = mesh ? render_list_input_needs(result->settings, mesh, needs)
                              : render_list_needs(result->settings, needs);
    if (!result->settings->job.is_one_of_many) {
        return render_warn_needs(result, needs, count, error);
    }
    for (size_t i = 0; mesh && i < count; ++i) {
        result->unmet |= needs[i].is_met ? 0 : 1U << i;
    }
    return BURNISH_STATUS_OK;
}
