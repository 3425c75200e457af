/* Meshes and their pictures, by the flags of `burnish render`. */
#include "session.h"

#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "render/camera.h"
#include "render/check.h"
#include "render/options.h"
#include "render/origin.h"
#include "render/output/report.h"
#include "render/up.h"

struct session {
    burnish_context *context;
    char *name; /* of the input, for messages */
    cli_companions companions;
    burnish_mesh *mesh;
    int stands_otherwise;
    burnish_material *materials; /* the input's own: options of a picture change the mesh's */
    size_t loading_warnings;     /* the first ones are the mesh's, the others the picture's */
    burnish_renderer *renderer;
    render_settings settings;
    render_result result;
    render_cell cell;
};

/* ---- Flags ---- */

/* How a mesh is loaded, and how it is drawn: each picture of a mesh may be drawn otherwise. */
const cli_command session_open_command = {
    .name = "open",
    .base = &render_command,
    .base_flags = "input-format,clip,crease-angle,tessellation,animation-time,animation,point-size,"
                  "strict,no-textures,no-libraries,max-triangles,max-texture-pixels,"
                  "max-input-bytes,up,threads",
    .settings_size = sizeof(render_settings),
};
const cli_command session_draw_command = {
    .name = "render",
    .base = &render_command,
    .base_topics = "light",
    .base_flags = "resolution,size,cull-back-faces,samples,background-color,no-background,views,"
                  "annotate,camera-direction,camera-azimuth-angle,camera-elevation-angle,camera,"
                  "camera-position,camera-focal-point,camera-view-up,camera-view-angle,"
                  "camera-zoom-factor,camera-orthographic,camera-orthographic-height,margin,"
                  "max-overdraw,isa,threads",
    .settings_size = sizeof(render_settings),
};

burnish_status session_parse(const cli_command *command, session_flags flags, void *settings,
                             cli_call *call, burnish_error *error) {
    const char *text = flags.texts;
    char **list = calloc((size_t)flags.count + 1, sizeof *list);
    burnish_status status = list ? cli_defaults(command, settings, error)
                                 : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    for (int i = 0; i < flags.count && list; ++i) {
        list[i] = (char *)text; /* as of argv: the parser changes none */
        text += strlen(text) + 1;
    }
    if (status == BURNISH_STATUS_OK) {
        status = cli_parse(command, flags.count, list, settings, call, error);
    }
    if (status == BURNISH_STATUS_OK && call->help) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "--help: unknown flag");
    }
    free(list);
    return status;
}

static burnish_status parse(const cli_command *command, session_flags flags,
                            render_settings *settings, burnish_error *error) {
    cli_call call = {0};
    return session_parse(command, flags, settings, &call, error);
}

/* The settings of one picture. */
static burnish_status parse_drawing(session_flags flags, render_settings *settings,
                                    burnish_error *error) {
    memset(settings, 0, sizeof *settings);
    burnish_status status = parse(&session_draw_command, flags, settings, error);
    if (status == BURNISH_STATUS_OK &&
        (settings->picture.views.count > 1 || settings->shading.lobes.count > 1)) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: one picture at a time; give one of them",
                          settings->picture.views.count > 1 ? "views" : "lobe");
    }
    return status == BURNISH_STATUS_OK ? render_check(settings, error) : status;
}

burnish_status session_check(session_flags flags, burnish_error *error) {
    render_settings settings;
    return parse_drawing(flags, &settings, error);
}

/* ---- Loading ---- */

session *session_create(burnish_context *context) {
    session *s = calloc(1, sizeof *s);
    if (s) {
        s->context = context;
    }
    return s;
}

static void drop_warnings(render_result *result, size_t kept) {
    while (result->warning_count > kept) {
        free(result->warnings[--result->warning_count]);
    }
}

void session_destroy(session *s) {
    if (!s) {
        return;
    }
    drop_warnings(&s->result, 0);
    free(s->result.warnings);
    burnish_image_destroy(&s->cell.image);
    burnish_renderer_destroy(s->renderer);
    burnish_mesh_destroy(s->mesh);
    free(s->materials);
    free(s->companions.items);
    free(s->name);
    free(s);
}

int session_offer(session *s, const char *name, const void *bytes, size_t size) {
    cli_companions *list = &s->companions;
    cli_companion *grown = realloc(list->items, (list->count + 1) * sizeof *grown);
    if (!grown) {
        return 0;
    }
    list->items = grown;
    list->items[list->count++] = (cli_companion){name, bytes, size};
    return 1;
}

/* Reads the flags of loading. */
static burnish_status begin(session *s, const char *name, session_flags flags,
                            burnish_load_options *options, burnish_error *error) {
    s->name = strdup(name);
    s->settings.input.name = s->name;
    s->result.settings = &s->settings;
    burnish_status status = s->name ? parse(&session_open_command, flags, &s->settings, error)
                                    : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    if (status == BURNISH_STATUS_OK) {
        status = cli_refuse_foreign(s->settings.input.load.format, error);
    }
    if (status == BURNISH_STATUS_OK) {
        *options = render_load_options(&s->settings.input, s->settings.job.threads);
        options->context = s->context;
    }
    return status;
}

/* What the input says of its surfaces. */
static burnish_status keep_materials(session *s, burnish_error *error) {
    const size_t count = burnish_mesh_get_material_count(s->mesh);
    s->materials = calloc(count, sizeof *s->materials);
    for (size_t i = 0; i < count && s->materials; ++i) {
        s->materials[i] = *burnish_mesh_get_material(s->mesh, i);
    }
    return s->materials
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu materials", count);
}

/* What follows once there is a mesh. */
static burnish_status finish(session *s, burnish_status status, burnish_error *error) {
    burnish_render_options no_lights = {.light_count = 0};
    for (size_t i = 0; i < burnish_mesh_get_warning_count(s->mesh); ++i) {
        render_result_warn(&s->result, 1, "%s", burnish_mesh_get_warning(s->mesh, i));
    }
    if (status == BURNISH_STATUS_OK) {
        render_subtract_origin(&s->settings.camera, &s->settings.input.clip, &no_lights,
                               burnish_mesh_get_view(s->mesh)->origin);
        status = render_cut(&s->result, s->mesh, error);
    }
    s->loading_warnings = s->result.warning_count;
    if (status == BURNISH_STATUS_OK) {
        status = keep_materials(s, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_create(s->context, &s->renderer, error);
    }
    s->stands_otherwise = status == BURNISH_STATUS_OK && s->settings.camera.up == UP_AUTO &&
                          render_stands_otherwise(burnish_mesh_get_view(s->mesh));
    return status;
}

burnish_status session_open(session *s, const char *name, const void *bytes, size_t size,
                            session_flags flags, burnish_error *error) {
    burnish_load_options options;
    burnish_status status = begin(s, name, flags, &options, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (bytes) {
        options.referenced_files = cli_companion_loader(&s->companions);
    }
    status = bytes ? burnish_mesh_load_memory(bytes, size, s->name, &options, &s->mesh, error)
                   : burnish_mesh_load(s->name, &options, &s->mesh, error);
    return finish(s, status, error);
}

burnish_status session_build(session *s, const burnish_mesh_description *description,
                             session_flags flags, burnish_error *error) {
    burnish_load_options options;
    burnish_status status =
        begin(s, description->name ? description->name : "mesh", flags, &options, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    status = burnish_mesh_create(description, &options, &s->mesh, error);
    return finish(s, status, error);
}

/* ---- Drawing ---- */

static burnish_status set_materials(session *s, burnish_error *error) {
    const size_t count = burnish_mesh_get_material_count(s->mesh);
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = burnish_mesh_set_material(s->mesh, i, &s->materials[i], error);
    }
    return status == BURNISH_STATUS_OK
               ? render_adjust_materials(&s->settings.shading, s->mesh, error)
               : status;
}

static burnish_status draw(session *s, burnish_error *error) {
    burnish_render_options options = render_make_options(&s->settings);
    render_room room = {.is_given = 0};
    render_cell *cell = &s->cell;
    render_subtract_origin(&s->settings.camera, &s->settings.input.clip, &options,
                           burnish_mesh_get_view(s->mesh)->origin);
    cell->view =
        s->settings.picture.views.count > 0 ? s->settings.picture.views.items[0] : VIEW_FREE;
    cell->lobe = s->settings.shading.lobes.items[0];
    s->result.mesh = s->mesh;
    s->result.options = &options;
    s->result.cells = cell;
    s->result.cell_count = 1;
    const char *warning;
    burnish_status status =
        render_add_own_lights(&s->settings.shading.lights, s->mesh, &options, &warning, error);
    if (warning) {
        render_result_warn(&s->result, 1, "%s", warning);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_camera(s->mesh, &s->settings, cell->view, &room, &cell->camera, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_draw_cell(&s->result, s->renderer, &options, cell, error);
    }
    cell->hash = status == BURNISH_STATUS_OK ? burnish_image_hash(&cell->image) : 0;
    return status;
}

burnish_status session_draw(session *s, session_flags flags, burnish_error *error) {
    const int up = s->settings.camera.up;
    burnish_image_destroy(&s->cell.image);
    s->cell = (render_cell){.hash = 0};
    drop_warnings(&s->result, s->loading_warnings);
    burnish_status status = parse_drawing(flags, &s->settings, error);
    s->settings.input.name = s->name;
    s->settings.camera.up = up; /* the mesh's */
    s->settings.camera.stands_otherwise = s->stands_otherwise;
    if (status == BURNISH_STATUS_OK) {
        status = set_materials(s, error);
    }
    return status == BURNISH_STATUS_OK ? draw(s, error) : status;
}

/* ---- What there is to know ---- */

const burnish_image *session_image(const session *s) {
    return &s->cell.image;
}

burnish_image session_take_image(session *s) {
    const burnish_image image = s->cell.image;
    s->cell.image = (burnish_image){0};
    return image;
}

uint64_t session_hash(const session *s) {
    return s->cell.hash;
}

const burnish_render_report *session_report(const session *s) {
    return &s->cell.report;
}

burnish_camera session_camera(const session *s) {
    const double *origin = burnish_mesh_get_view(s->mesh)->origin;
    burnish_camera camera = s->cell.camera;
    for (int k = 0; k < 3; ++k) {
        camera.position[k] += origin[k];
        camera.focal_point[k] += origin[k];
    }
    return camera;
}

const burnish_mesh *session_mesh(const session *s) {
    return s->mesh;
}

void session_bounds(const session *s, double minimum[3], double maximum[3]) {
    const double *origin = burnish_mesh_get_view(s->mesh)->origin;
    float low[3], high[3];
    burnish_mesh_get_bounds(s->mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        minimum[k] = low[k] + origin[k];
        maximum[k] = high[k] + origin[k];
    }
}

int session_up_number(const session *s) {
    return (int)render_up_in_use(s->mesh, &s->settings.camera, (double[3]){0});
}

const char *session_up(const session *s) {
    return render_up_name(s->mesh, &s->settings.camera);
}

const char *session_warning(const session *s, size_t index) {
    return index < s->result.warning_count ? s->result.warnings[index] : NULL;
}
