/* From the flags of `burnish render` to what the library takes: names, load options, materials,
 * options. */
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "cli/platform.h"
#include "font/utf8.h"
#include "picture/animation.h"
#include "render/reference.h"
#include "render/settings.h"
#include "sandbox/sandbox.h"

static int is_standard(const char *path) {
    return strcmp(path, "-") == 0;
}

/* The name of the picture when none is given: the input's, in the current folder, with the ending
 * of --output-format. */
static burnish_status derive_output(render_settings *settings, burnish_error *error) {
    const char *input = settings->input;
    if (is_standard(input)) {
        settings->output = "-";
        return BURNISH_STATUS_OK;
    }
    const char *slash = strrchr(input, '/');
    const char *base = input[0] == ':' ? input + 1 : slash ? slash + 1 : input;
    const char *dot = strrchr(base, '.');
    size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    char *name = settings->default_output;
    const char *ending = picture_ending(
        settings->format == PICTURE_AUTO ? PICTURE_PNG : (picture_format)settings->format);
    if (length == 0 || length + strlen(ending) + sizeof "." > sizeof settings->default_output) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "\"%.60s\" gives the picture no name; name it with --output=FILE", input);
    }
    snprintf(name, sizeof settings->default_output, "%.*s.%s", (int)length, base, ending);
    settings->output = name;
    settings->is_default_output = 1;
    return BURNISH_STATUS_OK;
}

/* The report may replace neither the input nor the picture. */
static burnish_status check_report(const render_settings *settings, burnish_error *error) {
    const char *others[] = {settings->input, settings->output};
    for (int i = 0; i < 2 && settings->json && !is_standard(settings->json); ++i) {
        if (strcmp(settings->json, others[i]) == 0 || cli_same_file(settings->json, others[i])) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--json: \"%.200s\" is the %s; name another file", settings->json,
                            i == 0 ? "input" : "picture");
        }
    }
    return BURNISH_STATUS_OK;
}

/* Whether two names of files are the same, or stand for one file. */
static int is_same(const char *a, const char *b) {
    return a && b && !is_standard(a) && !is_standard(b) &&
           (strcmp(a, b) == 0 || cli_same_file(a, b));
}

/* Planes go into files that nothing else goes into, and exist of one picture. */
static burnish_status check_planes(render_settings *settings, burnish_error *error) {
    const int is_sheet = settings->views.count > 1 || settings->lobes.count > 1;
    if (is_sheet && (settings->planes.count > 0 || settings->format == PICTURE_EXR ||
                     settings->format == PICTURE_NPY)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: a sheet has no planes of numbers; draw one view and one lobe",
                        settings->planes.count > 0 ? "plane" : "output");
    }
    for (size_t i = 0; i < settings->planes.count; ++i) {
        render_plane *plane = &settings->planes.items[i];
        burnish_status status = picture_choose("plane", plane->path, PICTURE_PLANE, PICTURE_AUTO,
                                               &plane->format, error);
        int taken = is_same(plane->path, settings->output) ||
                    is_same(plane->path, settings->json) || is_same(plane->path, settings->input);
        for (size_t k = 0; k < i; ++k) {
            taken |= is_same(plane->path, settings->planes.items[k].path);
        }
        if (status == BURNISH_STATUS_OK && taken) {
            status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                              "--plane: \"%.200s\" is another file of this run; name another one",
                              plane->path);
        }
        if (status == BURNISH_STATUS_OK && plane->kind == PLANE_COLOR &&
            plane->format == PICTURE_PNG) {
            status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                              "--plane: linear colour goes into NPY or EXR; the PNG in sRGB is "
                              "--output's");
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}

static int is_svg(const render_settings *settings) {
    const char *dot = strrchr(settings->output, '.');
    return settings->format == PICTURE_SVG ||
           (settings->format == PICTURE_AUTO && dot && strcasecmp(dot, ".svg") == 0);
}

/* An SVG holds the lines and flat areas of a drawing. */
static burnish_status choose_svg(render_settings *settings, burnish_error *error) {
    if (settings->look != BURNISH_LOOK_DRAWING) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: \"%.200s\": an SVG holds lines, no shading; draw them with "
                        "--look=drawing, or end the name in .png",
                        settings->output);
    }
    if (settings->rows.count > 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--rows: an SVG holds the lines of all rows; leave it out, or end the name "
                        "in .png");
    }
    settings->format = PICTURE_SVG;
    return BURNISH_STATUS_OK;
}

/* The output's format, and flags that ask of it what it can't hold. */
static burnish_status choose_format(render_settings *settings, burnish_error *error) {
    picture_format format;
    if (!settings->turntable && is_svg(settings)) {
        return choose_svg(settings, error);
    }
    burnish_status status =
        picture_choose(settings->turntable ? "turntable" : "output", settings->output,
                       settings->turntable ? PICTURE_ANIMATION : PICTURE_STILL | PICTURE_LINES,
                       (picture_format)settings->format, &format, error);
    settings->format = format;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (settings->background.transparent && (format == PICTURE_JPEG || format == PICTURE_Y4M)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--no-background: %s has no alpha; write PNG or WebP",
                        format == PICTURE_JPEG ? "JPEG" : "Y4M");
    }
    if (format == PICTURE_GIF && settings->fps > PICTURE_GIF_FPS_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--fps: a GIF has at most %d frames per second; write PNG, WebP or Y4M",
                        PICTURE_GIF_FPS_MAX);
    }
    if (settings->quality > 0 && format != PICTURE_JPEG && format != PICTURE_WEBP) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--quality: only JPEG and WebP lose any; leave it out");
    }
    if (settings->dots_per_inch.given &&
        (settings->turntable || (format != PICTURE_PNG && format != PICTURE_JPEG))) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--dpi: only PNG, JPEG and SVG hold it; leave it out");
    }
    return BURNISH_STATUS_OK;
}

/* 1 for a PNG that says in its first chunks that burnish wrote it. */
static int is_own_picture(const char *path) {
    static const char mark[] = "tEXtSoftware\0burnish";
    char head[128];
    struct stat status;
    FILE *file = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    if (!file) {
        return 0;
    }
    const size_t size = fread(head, 1, sizeof head, file);
    int found = 0;
    fclose(file);
    for (size_t i = 0; i + sizeof mark - 1 <= size && !found; ++i) {
        found = memcmp(head + i, mark, sizeof mark - 1) == 0;
    }
    return found && memcmp(head, "\x89PNG", 4) == 0;
}

static burnish_status check_output(render_settings *settings, burnish_error *error) {
    if (is_standard(settings->output)) {
        if (settings->json && is_standard(settings->json)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--json: standard output already carries the picture; name a "
                            "file with --output=FILE or --json=FILE");
        }
        if (isatty(STDOUT_FILENO)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--output: standard output is a terminal, which can't show a "
                            "picture; redirect it, or name a file with --output=FILE");
        }
        return choose_format(settings, error);
    }
    if (cli_same_file(settings->input, settings->output)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: \"%.200s\" is the input; name another file", settings->output);
    }
    /* What happens to have the picture's name may be a texture of the mesh. */
    if (settings->is_default_output && !settings->overwrite && cli_name_exists(settings->output) &&
        !is_own_picture(settings->output)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%.200s: exists and is no picture by burnish; replace it with --overwrite, "
                        "or name the picture with --output=FILE",
                        settings->output);
    }
    return choose_format(settings, error);
}

/* A scale is one of a parallel projection, and there is one. */
static burnish_status check_scale_flags(const render_settings *settings, burnish_error *error) {
    const int parallel = settings->views.count > 0 ? settings->projection != PROJECTION_PERSPECTIVE
                                                   : settings->projection == PROJECTION_PARALLEL;
    const char *scale = settings->orthographic_height.given ? "camera-orthographic-height"
                        : settings->same_scale              ? "same-scale"
                                                            : NULL;
    if (scale && settings->projection == PROJECTION_PERSPECTIVE) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: a perspective has no scale; leave out --camera-orthographic=no",
                        scale);
    }
    if (settings->annotations == BURNISH_ANNOTATION_SCALE && !scale && !parallel &&
        !settings->own_camera) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--annotate: scale: a perspective has no scale; give --camera-orthographic, "
            "or leave it out");
    }
    if (settings->orthographic_height.given && settings->zoom.value != 1) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--camera-zoom-factor: --camera-orthographic-height already says how large "
                        "the object is; leave one out");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_camera_flags(const render_settings *settings, burnish_error *error) {
    const char *turn = settings->azimuth.value != 0     ? "camera-azimuth-angle"
                       : settings->elevation.value != 0 ? "camera-elevation-angle"
                                                        : NULL;
    const char *aim = settings->direction.given ? "camera-direction" : turn;
    const char *extra = NULL, *fixed = NULL;
    if (settings->position.given && aim) {
        extra = aim;
        fixed = "camera-position";
    } else if (settings->views.count > 0) {
        extra = settings->position.given  ? "camera-position"
                : settings->view_up.given ? "camera-view-up"
                                          : aim;
        fixed = "views";
    }
    if (!extra) {
        return check_scale_flags(settings, error);
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: --%s already says where the camera looks from; leave one out", extra,
                    fixed);
}

static burnish_status check_labels(const render_settings *settings, burnish_error *error) {
    size_t views = settings->views.count > 0 ? settings->views.count : 1, texts = 1;
    size_t cells = views * settings->lobes.count;
    for (const char *c = settings->labels; c && *c; ++c) {
        texts += *c == ',';
    }
    const size_t length = settings->labels ? strlen(settings->labels) : 0;
    const size_t valid = length > 0 ? utf8_valid_length(settings->labels, length) : 0;
    if (valid < length) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--labels: byte %zu, 0x%02x, is not UTF-8; give the texts in UTF-8",
                        valid + 1, (unsigned)(unsigned char)settings->labels[valid]);
    }
    if (!settings->labels || texts == cells) {
        return BURNISH_STATUS_OK;
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--labels: %zu texts for %zu cells; give one text per cell, between "
                    "commas",
                    texts, cells);
}

/* A turntable takes the place of the picture. */
static burnish_status check_turntable(render_settings *settings, burnish_error *error) {
    const char *extra = settings->output             ? "output"
                        : settings->planes.count > 0 ? "plane"
                        : settings->annotations      ? "annotate"
                        : settings->reference        ? "reference"
                        : settings->views.count > 1  ? "views"
                        : settings->lobes.count > 1  ? "lobe"
                                                     : NULL;
    if (extra) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            settings->output
                ? "--%s: --turntable already names a file; leave one out"
                : "--%s: a turntable shows one view and one lobe and nothing besides; leave it out",
            extra);
    }
    settings->output = settings->turntable;
    return BURNISH_STATUS_OK;
}

burnish_status render_check(render_settings *settings, burnish_error *error) {
    const burnish_status status = cli_choose_isa(settings->isa_name, &settings->isa, error);
    return status == BURNISH_STATUS_OK ? check_camera_flags(settings, error) : status;
}

/* Rows are those of one picture that nothing is drawn over. */
static burnish_status check_rows(const render_settings *settings, burnish_error *error) {
    const char *extra = settings->turntable         ? "turntable"
                        : settings->annotations     ? "annotate"
                        : settings->views.count > 1 ? "views"
                        : settings->lobes.count > 1 ? "lobe"
                                                    : NULL;
    if (settings->rows.first > settings->size[1] - settings->rows.count) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--rows: the picture has no row %d; its %d are counted from 0",
                        settings->rows.first + settings->rows.count - 1, settings->size[1]);
    }
    return extra ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: not with --rows, which are of one picture; leave one out", extra)
                 : BURNISH_STATUS_OK;
}

/* Others draw frames of a turntable, or bands of a picture, of which nothing but its file is made:
 * nobody holds all of it. */
static burnish_status check_runners(const render_settings *settings, burnish_error *error) {
    const char *flag = settings->runner ? "runner" : "runners";
    const char *extra = settings->turntable          ? NULL
                        : settings->rows.count > 0   ? "rows"
                        : settings->planes.count > 0 ? "plane"
                        : settings->annotations      ? "annotate"
                        : settings->reference        ? "reference"
                        : settings->views.count > 1  ? "views"
                        : settings->lobes.count > 1  ? "lobe"
                        : settings->json             ? "json"
                        : settings->fail_on_blank    ? "fail-on-blank"
                                                     : NULL;
    if (settings->sandbox) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: others draw without --sandbox; leave one out", flag);
    }
    return extra ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: not of a picture that others draw parts of; leave it out", extra)
                 : BURNISH_STATUS_OK;
}

int render_is_shared(const render_settings *settings) {
    return settings->runner || settings->runners > 0;
}

burnish_status render_finish(render_settings *settings, burnish_error *error) {
    burnish_status status = render_check(settings, error);
    if (status == BURNISH_STATUS_OK && render_is_shared(settings)) {
        status = check_runners(settings, error);
    }
    if (status == BURNISH_STATUS_OK && settings->rows.count > 0) {
        status = check_rows(settings, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_labels(settings, error);
    }
    if (status == BURNISH_STATUS_OK && settings->turntable) {
        status = check_turntable(settings, error);
    }
    if (status == BURNISH_STATUS_OK && !settings->output) {
        status = derive_output(settings, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_output(settings, error);
    }
    if (status == BURNISH_STATUS_OK && render_is_shared(settings) && !settings->turntable &&
        settings->format != PICTURE_PNG) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--output: others draw parts of a PNG or of a --turntable; end the name "
                          "in .png");
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_check_useless(settings, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_planes(settings, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_check_reference(settings, error);
    }
    return status == BURNISH_STATUS_OK ? check_report(settings, error) : status;
}

burnish_load_options render_load_options(const render_settings *settings) {
    burnish_load_options options = cli_load_options(&settings->load);
    if (settings->crease.given) {
        options.crease_angle = settings->crease.value;
    }
    options.threads = settings->threads;
    options.measure = settings->clip.count > 0; /* whether it is a solid, to be filled */
    return options;
}

burnish_status render_load(const render_settings *settings, burnish_mesh **mesh,
                           burnish_error *error) {
    const burnish_load_options options = render_load_options(settings);
    if (!settings->load_mesh) {
        return sandbox_load(settings->input, &options, mesh, error);
    }
    const burnish_status status = settings->loads_foreign
                                      ? BURNISH_STATUS_OK
                                      : cli_refuse_foreign(settings->load.format, error);
    return status == BURNISH_STATUS_OK
               ? settings->load_mesh(settings->load_context, settings->input, &options, mesh, error)
               : status;
}

/* One material as the flags want it. */
static burnish_material adjusted_material(const render_settings *settings,
                                          burnish_material material) {
    if (settings->color.given) {
        for (int k = 0; k < 3; ++k) {
            material.diffuse[k] = burnish_srgb_decode(settings->color.srgb[k]);
            material.ambient[k] = material.diffuse[k];
        }
        material.has_diffuse = 1;
    }
    if (settings->material > 0) {
        const render_preset *preset = &render_presets[settings->material - 1];
        for (int k = 0; k < 3; ++k) {
            float tint = 1 + preset->tint * (material.diffuse[k] - 1);
            material.specular[k] = preset->specular * tint;
            material.diffuse[k] *= preset->diffuse;
            material.ambient[k] *= preset->diffuse;
        }
        material.exponent = preset->exponent;
    }
    if (settings->specular.given) {
        for (int k = 0; k < 3; ++k) {
            material.specular[k] = (float)settings->specular.value;
        }
    }
    if (settings->exponent.given) {
        material.exponent = (float)settings->exponent.value;
    }
    if (settings->opacity.given) {
        material.transparency = 1 - (float)settings->opacity.value * (1 - material.transparency);
    }
    return material;
}

burnish_status render_adjust_materials(const render_settings *settings, burnish_mesh *mesh,
                                       burnish_error *error) {
    const size_t count = burnish_mesh_material_count(mesh);
    burnish_status status = burnish_look_set_materials((burnish_look)settings->look, mesh, error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_material material = adjusted_material(settings, *burnish_mesh_material(mesh, i));
        status = burnish_mesh_set_material(mesh, i, &material, error);
    }
    return status;
}

burnish_render_options render_make_options(const render_settings *settings) {
    burnish_render_options options = burnish_render_options_default();
    burnish_render_options_set_look(&options, (burnish_look)settings->look, NULL);
    options.width = settings->size[0];
    options.height = settings->size[1];
    options.first_row = settings->rows.first;
    options.row_count = settings->rows.count;
    options.samples = settings->samples;
    options.max_overdraw = settings->max_overdraw.value;
    options.threads = settings->threads;
    options.kernels = burnish_kernels_for(settings->isa);
    options.specular_model = (burnish_specular_model)settings->equation;
    options.local_viewer = settings->viewer;
    options.ignore_colors |= settings->color.given;
    options.cull_back_faces = settings->cull_back_faces;
    options.transparent = settings->background.transparent;
    if (settings->ambient.given) {
        memcpy(options.ambient_light, settings->ambient.linear, sizeof options.ambient_light);
    }
    if (settings->occlusion.given) {
        options.occlusion = settings->occlusion.directions;
    }
    if (settings->edges.given) {
        options.edges = settings->edges.kinds;
    }
    if (settings->wireframe) {
        options.edges = (options.edges & BURNISH_EDGES_FEATURES) | BURNISH_EDGES_ALL;
    }
    if (settings->edge_width.given) {
        options.edge_width = (float)settings->edge_width.value;
    }
    for (int k = 0; k < 3 && settings->edge_color.given; ++k) {
        options.edge_color[k] = cli_color_code(settings->edge_color.srgb[k]);
    }
    options.ground = settings->ground;
    options.shadow = settings->shadow;
    if (settings->lights.given) {
        memcpy(options.lights, settings->lights.items, sizeof options.lights);
        options.light_count = settings->lights.count;
    }
    if (settings->background.given) {
        for (int k = 0; k < 3; ++k) {
            options.background[k] = cli_color_code(settings->background.srgb[k]);
        }
    }
    return options;
}
