#include "burnish/look.h"
#include "render/render.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/cli/platform.h"
#include "cli/main.h"
#include "font/font.h"
#include "picture/animation.h"
#include "render/output/projection.h"
#include "render/scene/color.h"
#include "render/scene/library_options.h"
#include "render/useless.h"

static int is_standard(const char *path) {
    return strcmp(path, "-") == 0;
}

/* NULL and "-" are no files. */
static int is_same_file(const char *a, const char *b) {
    return a && b && !is_standard(a) && !is_standard(b) && cli_same_output(a, b);
}

/* A flag that makes a sheet, or NULL. */
static const char *sheet_flag(const render_settings *settings) {
    return settings->input.load.plate < 0      ? "plate"
           : settings->picture.views.count > 1 ? "views"
           : settings->shading.lobes.count > 1 ? "lobe"
                                               : NULL;
}

/* A turntable replaces the picture. */
static burnish_status check_turntable(render_settings *settings, burnish_error *error) {
    const char *extra = settings->output.path               ? "output"
                        : settings->output.planes.count > 0 ? "plane"
                        : settings->picture.annotations     ? "annotate"
                        : settings->picture.callouts        ? "callouts"
                        : settings->output.reference        ? "reference"
                                                            : sheet_flag(settings);
    if (extra) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        settings->output.path
                            ? "--%s: --turntable already names a file; omit one of them"
                            : "--%s: a turntable shows only one view and one lobe; omit the flag",
                        extra);
    }
    if (settings->output.plays && is_standard(settings->input.name)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--play: reads INPUT for every frame; name a file");
    }
    if (settings->output.plays && settings->input.load.animation_time.given) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--animation-time: --play shows all times; omit one of them");
    }
    settings->input.load.animation_time.given |= settings->output.plays;
    settings->output.path = settings->output.turntable;
    return BURNISH_STATUS_OK;
}

/* The default name of the picture: the input's, in the current folder or another, with the extension of
 * --output-format. */
static burnish_status name_output(render_settings *settings, burnish_error *error) {
    const char *input = settings->input.name;
    if (settings->output.turntable) {
        return check_turntable(settings, error);
    }
    settings->output.plays = 0;
    if (settings->output.path) {
        return BURNISH_STATUS_OK;
    }
    if (is_standard(input) && !settings->output.place) {
        settings->output.path = "-";
        return BURNISH_STATUS_OK;
    }
    const char *base = is_standard(input) ? "" : cli_model_name(input);
    const size_t length = cli_stem_length(base);
    char *name = settings->output.derived;
    const char *place = settings->output.place ? settings->output.place : "";
    const char *gap = *place && place[strlen(place) - 1] != '/' ? "/" : "";
    const char *extension = picture_extension(settings->output.format == PICTURE_AUTO
                                                  ? PICTURE_PNG
                                                  : (picture_format)settings->output.format);
    if (length == 0 || strlen(place) + length + strlen(extension) + sizeof "/." >
                           sizeof settings->output.derived) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "\"%.60s\" has no name for the picture; name it with --output=FILE", input);
    }
    snprintf(name, sizeof settings->output.derived, "%s%s%.*s.%s", place, gap, (int)length, base,
             extension);
    settings->output.is_derived = 1;
    return BURNISH_STATUS_OK;
}

/* The report can not replace the picture. */
static burnish_status check_report(render_settings *settings, burnish_error *error) {
    return is_same_file(settings->output.json, render_output_path(&settings->output))
               ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--json: \"%.200s\" is the picture; name another file",
                          settings->output.json)
               : BURNISH_STATUS_OK;
}

/* Planes need separate files and a single picture. */
static burnish_status check_planes(render_settings *settings, burnish_error *error) {
    if (sheet_flag(settings) &&
        (settings->output.planes.count > 0 || settings->output.format == PICTURE_EXR ||
         settings->output.format == PICTURE_NPY)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: a sheet has no planes; draw one view and one lobe",
                        settings->output.planes.count > 0 ? "plane" : "output");
    }
    for (size_t i = 0; i < settings->output.planes.count; ++i) {
        render_plane *plane = &settings->output.planes.items[i];
        burnish_status status = picture_choose("plane", plane->path, PICTURE_PLANE, PICTURE_AUTO,
                                               &plane->format, error);
        int taken = is_same_file(plane->path, render_output_path(&settings->output)) ||
                    is_same_file(plane->path, settings->output.json);
        for (size_t k = 0; k < i; ++k) {
            taken |= is_same_file(plane->path, settings->output.planes.items[k].path);
        }
        if (status == BURNISH_STATUS_OK && taken) {
            status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                              "--plane: \"%.200s\" is another file of this run; name another one",
                              plane->path);
        }
        if (status == BURNISH_STATUS_OK && plane->kind == PLANE_COLOR &&
            plane->format == PICTURE_PNG) {
            status = cli_fail(
                error, BURNISH_STATUS_ARGUMENT,
                "--plane: linear colour can be written as NPY or EXR; --output writes PNG in sRGB");
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}

/* SVG, PDF, or another format that --output-format or the extension names. */
static picture_format drawing_format(const render_settings *settings) {
    const char *dot = strrchr(render_output_path(&settings->output), '.');
    if (settings->output.format != PICTURE_AUTO || !dot) {
        return (picture_format)settings->output.format;
    }
    return strcasecmp(dot, ".svg") == 0   ? PICTURE_SVG
           : strcasecmp(dot, ".pdf") == 0 ? PICTURE_PDF
                                          : PICTURE_AUTO;
}

/* An SVG or PDF holds the lines and flat areas of a drawing. */
static burnish_status choose_drawing(render_settings *settings, burnish_error *error) {
    const char *what = drawing_format(settings) == PICTURE_PDF ? "a PDF" : "an SVG";
    if (settings->shading.look != BURNISH_LOOK_DRAWING) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: \"%.200s\": %s has lines, not shading; use --look=drawing, or "
                        "the extension .png",
                        render_output_path(&settings->output), what);
    }
    if (settings->picture.background.environment) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--background-color: %s can't show an environment; use a colour, or the extension .png",
            what);
    }
    if (settings->picture.rows.count > 0) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--rows: %s has the lines of all rows; omit the flag, or use the extension .png", what);
    }
    settings->output.format = (int)drawing_format(settings);
    return BURNISH_STATUS_OK;
}

/* Finds the output's format, and checks the flags that it does not support. */
static burnish_status choose_format(render_settings *settings, burnish_error *error) {
    picture_format format;
    if (settings->picture.background.environment && !settings->shading.environment.name) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--background-color: there is no environment to show; use "
                        "--environment=sky, room or a file");
    }
    if (!settings->output.turntable && picture_is_drawing(drawing_format(settings))) {
        return choose_drawing(settings, error);
    }
    burnish_status status = picture_choose(
        settings->output.turntable ? "turntable" : "output", render_output_path(&settings->output),
        settings->output.turntable ? PICTURE_ANIMATION : PICTURE_STILL | PICTURE_LINES,
        (picture_format)settings->output.format, &format, error);
    settings->output.format = format;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (settings->picture.background.transparent &&
        (format == PICTURE_JPEG || format >= PICTURE_Y4M)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--no-background: .%s has no alpha; write %s", picture_extension(format),
                        format == PICTURE_JPEG ? "PNG or WebP" : "WebP or GIF");
    }
    if (picture_container(format) &&
        (settings->picture.size[0] < 2 || settings->picture.size[1] < 2)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--resolution: a .%s has at least 2 x 2 pixels; write WebP or GIF",
                        picture_extension(format));
    }
    if (format == PICTURE_GIF && settings->output.fps > PICTURE_GIF_FPS_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--fps: a GIF has at most %d frames per second; write WebP, MP4 or WebM",
                        PICTURE_GIF_FPS_MAX);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_output(render_settings *settings, burnish_error *error) {
    if (is_standard(render_output_path(&settings->output))) {
        if (settings->output.json && is_standard(settings->output.json)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--json: standard output is used for the picture; name a file with "
                            "--output=FILE or --json=FILE");
        }
        if (isatty(STDOUT_FILENO)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--output: standard output is a terminal; redirect it, or name a file "
                            "with --output=FILE");
        }
        return choose_format(settings, error);
    }
    if (cli_same_file(settings->input.name, render_output_path(&settings->output))) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: \"%.200s\" is the input; name another file",
                        render_output_path(&settings->output));
    }
    const burnish_status status = choose_format(settings, error);
    return status == BURNISH_STATUS_OK && !settings->output.overwrite
               ? picture_check_existing(render_output_path(&settings->output),
                                        settings->output.is_derived, error)
               : status;
}

/* Only a parallel projection has a scale, and only one flag sets it. */
static burnish_status check_scale_flags(const render_settings *settings, burnish_error *error) {
    const char *scale = settings->camera.orthographic_height.given ? "camera-orthographic-height"
                        : settings->camera.same_scale              ? "same-scale"
                                                                   : NULL;
    if (scale && settings->camera.projection == PROJECTION_PERSPECTIVE) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: a perspective has no scale; omit --camera-orthographic=no", scale);
    }
    if (settings->camera.orthographic_height.given && settings->camera.zoom.value != 1) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--zoom: --camera-orthographic-height already sets the scale; omit one of them");
    }
    return BURNISH_STATUS_OK;
}

/* A section sets the camera, or is one more view of a sheet of aligned views. */
static burnish_status check_section(render_settings *settings, burnish_error *error) {
    render_views *views = &settings->picture.views;
    const int is_sheet = render_is_projection(settings);
    const int is_set = views->count > 0 && views->items[views->count - 1] == VIEW_SECTION;
    if (settings->input.section.axis == 0 || is_set) {
        return BURNISH_STATUS_OK;
    }
    if (settings->camera.own || (views->count > 0 && !is_sheet)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: --section already sets the camera; omit one of them, or cut with "
                        "--clip",
                        settings->camera.own ? "camera" : "views");
    }
    views->items[views->count++] = VIEW_SECTION;
    return BURNISH_STATUS_OK;
}

static burnish_status check_camera_flags(const render_settings *settings, burnish_error *error) {
    const char *turn = settings->camera.azimuth.value != 0     ? "azimuth"
                       : settings->camera.elevation.value != 0 ? "elevation"
                                                               : NULL;
    const char *aim = settings->camera.direction.given ? "camera-direction" : turn;
    const char *extra = NULL, *fixed = NULL;
    if (settings->camera.position.given && aim) {
        extra = aim;
        fixed = "camera-position";
    } else if (settings->picture.views.count > 0) {
        extra = settings->camera.position.given  ? "camera-position"
                : settings->camera.view_up.given ? "camera-view-up"
                                                 : aim;
        fixed = settings->input.section.axis > 0 ? "section" : "views";
    }
    if (!extra) {
        return check_scale_flags(settings, error);
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: --%s already sets the camera; omit one of them", extra, fixed);
}

static burnish_status check_labels(render_settings *settings, burnish_error *error) {
    size_t views = settings->picture.views.count > 0 ? settings->picture.views.count : 1, texts = 1;
    size_t cells = views * settings->shading.lobes.count;
    for (const char *c = settings->picture.labels; c && *c; ++c) {
        texts += *c == ',';
    }
    const size_t length = settings->picture.labels ? strlen(settings->picture.labels) : 0;
    const size_t valid = length > 0 ? utf8_valid_length(settings->picture.labels, length) : 0;
    if (valid < length) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--labels: byte %zu, 0x%02x, is not UTF-8; use UTF-8", valid + 1,
                        (unsigned)(unsigned char)settings->picture.labels[valid]);
    }
    if (!settings->picture.labels || texts == cells || cells == 1) {
        return BURNISH_STATUS_OK;
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--labels: %zu labels for %zu cells; use one label per cell, between commas",
                    texts, cells);
}

/* --width and --height replace the sides of the size. One alone keeps the proportions. */
static void find_size(render_picture_settings *picture) {
    int *size = picture->size;
    for (int k = 0; k < 2; ++k) {
        const int side = picture->sides[k], other = picture->sides[1 - k];
        if (side > 0 && other == 0) {
            const int64_t scaled = ((int64_t)size[1 - k] * side + size[k] / 2) / size[k];
            size[1 - k] = scaled < 1                        ? 1
                          : scaled > BURNISH_IMAGE_MAX_SIZE ? BURNISH_IMAGE_MAX_SIZE
                                                            : (int)scaled;
            size[k] = side;
            break;
        }
        size[k] = side > 0 ? side : size[k];
    }
    memset(picture->sides, 0, sizeof picture->sides);
}

/* The lights of the look studio have no lobes. */
static burnish_status choose_look(render_settings *settings, burnish_error *error) {
    render_shading_settings *shading = &settings->shading;
    const int has_lobe = render_has_own_lobe(shading);
    if (has_lobe && !cli_is_given(&render_command, settings, "look")) {
        shading->look = BURNISH_LOOK_THREE_POINT;
    }
    return has_lobe && shading->look == BURNISH_LOOK_STUDIO && !shading->lights.given
               ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: the look studio has no lights with a lobe; use "
                          "--look=three-point, or omit the flag",
                          shading->equation == BURNISH_SPECULAR_BLINN ? "lobe" : "equation")
               : BURNISH_STATUS_OK;
}

burnish_status render_check(render_settings *settings, burnish_error *error) {
    burnish_status status = cli_choose_isa(settings->job.isa_name, &settings->job.isa, error);
    status = status == BURNISH_STATUS_OK ? render_check_projection(settings, error) : status;
    if (status == BURNISH_STATUS_OK && settings->input.load.plate < 0 &&
        (settings->picture.views.count > 1 || settings->shading.lobes.count > 1 ||
         (settings->input.name && is_standard(settings->input.name)))) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--plate=sheet: draws one view and one lobe of a named file");
    }
    find_size(&settings->picture);
    settings->input.coloring.no_legend |=
        settings->picture.callouts && render_names_parts(&settings->input.coloring);
    status = status == BURNISH_STATUS_OK ? choose_look(settings, error) : status;
    status = status == BURNISH_STATUS_OK ? check_section(settings, error) : status;
    return status == BURNISH_STATUS_OK ? check_camera_flags(settings, error) : status;
}

/* Rows need a single picture without annotations. */
static burnish_status check_rows(render_settings *settings, burnish_error *error) {
    const char *extra = settings->output.turntable      ? "turntable"
                        : settings->picture.annotations ? "annotate"
                        : settings->picture.callouts    ? "callouts"
                                                        : sheet_flag(settings);
    if (settings->picture.rows.count == 0) {
        return BURNISH_STATUS_OK;
    }
    if (settings->picture.rows.first > settings->picture.size[1] - settings->picture.rows.count) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--rows: the picture has no row %d; its %d are counted from 0",
                        settings->picture.rows.first + settings->picture.rows.count - 1,
                        settings->picture.size[1]);
    }
    return extra ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: not available with --rows; omit one of them", extra)
                 : BURNISH_STATUS_OK;
}

static burnish_status check_reference(render_settings *settings, burnish_error *error) {
    const char *reference = settings->output.reference,
               *difference = settings->output.reference_difference;
    if (!reference && difference) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--reference-difference: there is no reference; name it with --reference=FILE");
    }
    if (reference &&
        (settings->output.format == PICTURE_EXR || settings->output.format == PICTURE_NPY)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--reference: --output=%.200s has planes; name a picture",
                        render_output_path(&settings->output));
    }
    if (is_same_file(reference, render_output_path(&settings->output))) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: \"%.200s\" is the reference; name another file",
                        render_output_path(&settings->output));
    }
    const char *others[] = {render_output_path(&settings->output), settings->output.json};
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i) {
        if (is_same_file(difference, others[i])) {
            return cli_fail(
                error, BURNISH_STATUS_ARGUMENT,
                "--reference-difference: \"%.200s\" is used for another file; choose another name",
                difference);
        }
    }
    picture_format unused;
    return difference ? picture_choose("reference-difference", difference, PICTURE_8_BIT,
                                       PICTURE_AUTO, &unused, error)
                      : BURNISH_STATUS_OK;
}

/* Outputs that are measured have no ground unless a flag requests it, nor has a GIF without
 * background, which would show half of a shadow as black. */
static burnish_status check_ground(render_settings *settings, burnish_error *error) {
    const picture_format format = (picture_format)settings->output.format;
    const int is_black = format == PICTURE_GIF && settings->picture.background.transparent;
    (void)error;
    settings->shading.ground -= settings->shading.ground == 0 &&
                                (settings->output.planes.count > 0 || picture_is_drawing(format) ||
                                 format == PICTURE_EXR || format == PICTURE_NPY || is_black);
    return BURNISH_STATUS_OK;
}

/* The order matters: later checks need the output's name, and then its format. */
burnish_status render_finish(render_settings *settings, burnish_error *error) {
    typedef burnish_status check(render_settings * settings, burnish_error * error);
    static check *const checks[] = {
        render_check,         check_rows,   check_labels,    name_output,  check_output,
        render_check_drawing, check_planes, check_reference, check_report, check_ground};
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < sizeof checks / sizeof *checks && status == BURNISH_STATUS_OK; ++i) {
        status = checks[i](settings, error);
    }
    return status;
}
