/* A flag without an effect is an error, so users notice it. */
#include "render/useless.h"

#include <string.h>

#include "cli/main.h"
#include "picture/formats.h"
#include "render/scene/options.h"

static int is_given(const render_settings *settings, const char *flag) {
    return cli_is_given(&render_command, settings, flag);
}

/* Flags with a condition. */
typedef struct need {
    const char *flags; /* between commas */
    int is_met;
    const char *why; /* after "--flag: " */
} need;

/* The first flag of a list that was given, or NULL. */
static const char *find_given(const render_settings *settings, const char *flags, char *name,
                              size_t size) {
    for (size_t length; *flags; flags += length + (flags[length] == ',')) {
        length = strcspn(flags, ",");
        if (length < size) {
            memcpy(name, flags, length);
            name[length] = 0;
        }
        if (length < size && is_given(settings, name)) {
            return name;
        }
    }
    return NULL;
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

/* Flags that do not affect an SVG. --ambient, --color and --material change areas' colours. */
static burnish_status check_svg(const render_settings *settings, burnish_error *error) {
    static const char unshown[] = "light,shadow,ground,opacity,specular,exponent,lobe,equation,"
                                  "viewer,samples,quality,outline-contrast";
    char name[32];
    const char *flag =
        settings->shading.occlusion.given && settings->shading.occlusion.directions != 0
            ? "occlusion"
            : find_given(settings, unshown, name, sizeof name);
    return flag ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                           "--%s: it does not affect the lines and areas of %s; omit the flag, "
                           "or use the extension .png",
                           flag, settings->output.format == PICTURE_PDF ? "a PDF" : "an SVG")
                : BURNISH_STATUS_OK;
}

burnish_status render_check_useless(render_settings *settings, burnish_error *error) {
    const int is_sheet = settings->picture.views.count > 1 || settings->shading.lobes.count > 1;
    const int is_framed = !settings->camera.own && !settings->camera.position.given;
    const need needs[] = {
        {"frames,fps", settings->output.turntable != NULL,
         "only a turntable has frames; use --turntable=FILE, or omit the flag"},
        {"columns,labels,no-labels,font", is_sheet,
         "only a sheet has them; use several --views or lobes, or omit the flag"},
        {"color-by", settings->shading.look != BURNISH_LOOK_DRAWING,
         "a drawing has no colours; use another --look, or omit the flag"},
        {"color-map,color-range,no-legend", settings->input.coloring.by != NULL,
         "no quantity is shown by colours; use --color-by, or omit the flag"},
        {"edge-width,edge-color", has_lines(settings, is_parallel(settings)),
         "no lines are drawn; use --edges, or omit the flag"},
        {"camera-view-angle", is_perspective(settings),
         "a parallel projection has no angle; use --camera-orthographic=no, or omit the flag"},
        {"margin",
         (is_framed || settings->picture.views.count > 0 || is_parallel(settings)) &&
             !settings->camera.orthographic_height.given,
         "the object is not framed, because other flags set the camera; omit the flag"},
    };
    for (size_t i = 0; i < sizeof needs / sizeof *needs; ++i) {
        char name[32];
        const char *flag =
            needs[i].is_met ? NULL : find_given(settings, needs[i].flags, name, sizeof name);
        if (flag) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: %s", flag, needs[i].why);
        }
    }
    return picture_is_drawing((picture_format)settings->output.format) ? check_svg(settings, error)
                                                                       : BURNISH_STATUS_OK;
}
