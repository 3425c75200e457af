#include "view/scene.h"
#include "burnish/look.h"
#include "render/flags.h"
#include "render/scene/library_options.h"
#include "render/settings/flag_values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/output.h"
#include "cli/main.h"
#include "render/scene/prepare.h"
#include "render/useless.h"

static int is_cancelled(void *user_data) {
    const view_scene *scene = user_data;
    return scene->may_stop && scene->interrupted && scene->interrupted(scene->user_data);
}

burnish_status view_scene_begin(view_scene *scene, burnish_error *error) {
    burnish_context_options options = burnish_context_options_default();
    options.cancelled = is_cancelled;
    options.cancelled_user_data = scene;
    const burnish_status status = burnish_context_create(&options, &scene->context, error);
    return status == BURNISH_STATUS_OK
               ? burnish_renderer_create(scene->context, &scene->renderer, error)
               : status;
}

void view_scene_end(view_scene *scene) {
    burnish_mesh_destroy(scene->mesh);
    render_release_environment(&scene->environment);
    burnish_renderer_destroy(scene->renderer);
    burnish_context_destroy(scene->context);
}

/* ---- Loading ---- */

/* The section as one more plane of --clip. */
static void add_section(const view_scene *scene, render_clip *clip) {
    const view_section *section = &scene->section;
    if (section->is_on && clip->count < BURNISH_CUTS_MAX) {
        const int axis = section->axis;
        const double at =
            scene->low[axis] + section->share * (scene->high[axis] - scene->low[axis]);
        burnish_clip_plane *plane = &clip->items[clip->count++];
        *plane = (burnish_clip_plane){.offset = section->side * at};
        plane->normal[axis] = section->side;
    }
}

/* Flags in vain, once. Keys change views, projection and look: what flags need of those can come. */
static burnish_status warn_useless(const render_settings *settings, const burnish_mesh *mesh,
                                   burnish_error *error) {
    cli_need needs[RENDER_NEEDS_MAX];
    size_t count = render_list_input_needs(settings, mesh, needs);
    needs[count++] = render_environment_need(settings);
    return cli_check_needs(&render_command, settings, needs, count, settings->input.load.strict, 0,
                           error);
}

/* Prepares a mesh; prints its warnings once for each input. */
static burnish_status prepare_scene(view_scene *scene, render_scene *prepared,
                                    burnish_error *error) {
    render_warnings warnings = {.print = scene->warned == scene->input ? NULL : cli_warn};
    prepared->warnings = &warnings;
    render_warn_of_mesh(&warnings, prepared->mesh);
    burnish_status status = BURNISH_STATUS_OK;
    if (!scene->mesh) {
        status = warn_useless(prepared->settings, prepared->mesh, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_prepare(prepared, error);
    }
    render_drop_warnings(&warnings, 0);
    scene->warned = scene->input;
    return status;
}

burnish_status view_scene_load(view_scene *scene, burnish_error *error) {
    render_settings settings = scene->given;
    burnish_render_options options;
    burnish_mesh *mesh = NULL;
    render_environment read = {0};
    double range[2];
    const int reads = !scene->environment.environment || scene->environment_is_old;
    settings.input.name = scene->input;
    add_section(scene, &settings.input.clip);
    burnish_status status = render_load(&settings.input, settings.job.threads, &mesh, error);
    const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
    for (int k = 0; k < 3 && view && !scene->section.is_on; ++k) {
        scene->low[k] = view->bounds_min[k] + view->origin[k];
        scene->high[k] = view->bounds_max[k] + view->origin[k];
        scene->triangles = view->triangle_count;
    }
    if (status == BURNISH_STATUS_OK) {
        render_scene prepared = {.settings = &settings,
                                 .mesh = mesh,
                                 .options = &options,
                                 .environment = reads ? &read : &scene->environment,
                                 .color_range = range};
        status = prepare_scene(scene, &prepared, error);
    }
    if (status != BURNISH_STATUS_OK) {
        render_release_environment(&read);
        burnish_mesh_destroy(mesh);
        return status;
    }
    if (reads) {
        render_release_environment(&scene->environment);
        scene->environment = read;
        scene->environment_is_old = 0;
    }
    burnish_mesh_destroy(scene->mesh);
    scene->mesh = mesh;
    scene->settings = settings;
    scene->options = options;
    return BURNISH_STATUS_OK;
}

burnish_status view_scene_set_exponent(view_scene *scene, double exponent, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    scene->given.shading.exponent = (cli_real){1, exponent};
    for (size_t i = 0; i < burnish_mesh_get_material_count(scene->mesh); ++i) {
        burnish_material material = *burnish_mesh_get_material(scene->mesh, i);
        render_make_phong(&material);
        material.exponent = (float)exponent;
        material.has_exponent = 1;
        if (!material.is_metallic) { /* lights would prefer the file's roughness */
            material.metallic = material.roughness = 0;
            memset(material.reflectance, 0, sizeof material.reflectance);
        }
        status = status == BURNISH_STATUS_OK
                     ? burnish_mesh_set_material(scene->mesh, i, &material, error)
                     : status;
    }
    return status;
}

double view_scene_exponent(const view_scene *scene) {
    return (double)burnish_mesh_get_material(scene->mesh, 0)->exponent;
}

/* ---- Camera ---- */

void view_scene_up(const view_scene *scene, double up[3]) {
    render_upward(scene->mesh, &scene->settings.camera, up);
}

double view_scene_radius(const view_scene *scene) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double side = scene->high[k] - scene->low[k];
        sum += side * side;
    }
    return sqrt(sum) / 2;
}

burnish_status view_scene_aim(view_scene *scene, render_view view, burnish_error *error) {
    render_room room = {0};
    burnish_camera camera;
    memcpy(scene->settings.picture.size, scene->given.picture.size,
           sizeof scene->settings.picture.size);
    const burnish_status status =
        render_camera(scene->mesh, &scene->settings, view, &room, &camera, error);
    if (status == BURNISH_STATUS_OK) {
        scene->camera = camera;
        scene->view = view;
        scene->is_framed = 1;
    }
    return status;
}

/* ---- Drawing ---- */

static void simplify(burnish_render_options *options, view_quality quality) {
    if (quality >= VIEW_PLAIN) {
        options->occlusion = 0;
        options->edges &= ~BURNISH_EDGES_AXIS_VIEWS;
    }
    if (quality >= VIEW_FAST) {
        options->ground = options->shadow = 0;
        options->samples = 1;
    }
}

burnish_status view_scene_draw(view_scene *scene, const burnish_lobe_spec *lobe,
                               view_quality quality, const burnish_pixels *pixels,
                               burnish_error *error) {
    burnish_render_options options = scene->options;
    burnish_target target = burnish_target_default();
    options.width = pixels->width;
    options.height = pixels->height;
    options.lobe = *lobe;
    options.camera = scene->camera;
    options.counts = BURNISH_COUNTS_NONE;
    if (scene->given.shading.wireframe) {
        options.edges = (options.edges & BURNISH_EDGES_FEATURES) | BURNISH_EDGES_ALL;
    }
    view_scene_up(scene, options.up);
    simplify(&options, quality);
    target.pixels = *pixels;
    return burnish_renderer_draw_into(scene->renderer, scene->mesh, &options, &target, NULL, error);
}

/* ---- The command ---- */

static void print_vector(const char *flag, const double values[3], const double origin[3]) {
    char text[3][CLI_REAL_SIZE];
    for (int k = 0; k < 3; ++k) {
        cli_shortest(values[k] + (origin ? origin[k] : 0), text[k]);
    }
    printf(" --%s=%s,%s,%s", flag, text[0], text[1], text[2]);
}

static void print_real(const char *flag, double value) {
    char text[CLI_REAL_SIZE];
    printf(" --%s=%s", flag, cli_shortest(value, text));
}

static void print_camera(const view_scene *scene) {
    const burnish_camera *camera = &scene->camera;
    const double *origin = burnish_mesh_get_view(scene->mesh)->origin;
    if (scene->is_framed) {
        if (scene->view != VIEW_FREE) {
            printf(" --views=%s", render_view_name(scene->view));
        }
        return;
    }
    print_vector("camera-position", camera->position, origin);
    print_vector("camera-focal-point", camera->focal_point, origin);
    print_vector("camera-view-up", camera->view_up, NULL);
    if (camera->orthographic_height > 0) {
        print_real("camera-orthographic-height", camera->orthographic_height);
    } else {
        print_real("camera-view-angle", camera->view_angle);
    }
}

/* In quotes for a shell: $'...' has escapes for what a terminal would obey. */
static void print_quoted(const char *text) {
    char *clean = strdup(text);
    if (clean) {
        cli_clean(clean);
    }
    const int is_clean = clean && strcmp(clean, text) == 0;
    printf(is_clean ? "'" : "$'");
    for (; *text; ++text) {
        if (!is_clean) {
            printf("\\%03o", (unsigned)(unsigned char)*text);
        } else {
            fputs(*text == '\'' ? "'\\''" : (char[2]){*text, 0}, stdout);
        }
    }
    putchar('\'');
    free(clean);
}

void view_scene_print(const view_scene *scene, const burnish_lobe_spec *lobe) {
    char name[32];
    render_clip clip = {0};
    burnish_lobe_spec_name(lobe, name, sizeof name);
    printf("burnish render ");
    print_quoted(scene->input);
    printf(" --resolution=%d,%d", scene->given.picture.size[0], scene->given.picture.size[1]);
    for (const cli_word *word = render_look_words; word->name; ++word) {
        if (word->value == scene->given.shading.look && word->value != BURNISH_LOOK_STUDIO) {
            printf(" --lobe=%s --look=%s", name, word->name);
        }
    }
    if (scene->given.shading.exponent.given) {
        print_real("exponent", scene->given.shading.exponent.value);
    }
    add_section(scene, &clip);
    if (clip.count > 0) {
        char text[CLI_REAL_SIZE];
        const double *n = clip.items[0].normal;
        printf(" --clip=%g,%g,%g,%s", n[0], n[1], n[2], cli_shortest(clip.items[0].offset, text));
    }
    printf("%s", scene->given.shading.wireframe ? " --wireframe" : "");
    print_camera(scene);
    putchar('\n');
    fflush(stdout);
}
