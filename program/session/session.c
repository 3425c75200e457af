#include "session.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/output.h"
#include "cli/contents.h"
#include "cli/main.h"
#include "render/flags.h"
#include "render/output/result.h"
#include "render/render.h"
#include "render/scene/cameras.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"
#include "render/useless.h"
#ifdef SESSION_HAS_IMPORTERS
#include "import/load_input.h"
#else
#define SESSION_HAS_IMPORTERS 0 /* bindings/wasm */
#define import_load burnish_mesh_load
#define import_load_memory burnish_mesh_load_memory
#endif

struct session {
    burnish_context *context;
    char *name;  /* of the input, for messages */
    char *texts; /* of the last call's options */
    cli_companions companions;
    burnish_mesh *mesh;
    render_camera_settings stance; /* up, stands_otherwise, flat_axis and slant of the mesh */
    render_coloring coloring;      /* of the mesh; has the name itself */
    render_section section;        /* of the mesh */
    burnish_material *materials;   /* of the input; options of a picture change those of the mesh */
    int is_strict;                 /* as the mesh was opened */
    size_t loading_warnings;       /* count; later warnings are about the picture */
    size_t final_warnings;         /* count; in later ones flags have dashes */
    burnish_renderer *renderer;
    render_settings settings;
    render_result result;
    render_cell cell;
    render_environment environment; /* of the last picture */
    char *environment_name;
    unsigned plane_kinds; /* requested */
    session_planes planes;
};

/* ---- Options ---- */

/* Options of loading a mesh, and of drawing a picture of it. */
static const cli_command open_command = {
    .name = "open",
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD,
    .heir = HEIR_SESSION,
    .settings_size = sizeof(render_settings),
};
static const cli_command draw_command = {
    .name = "render",
    .base = &render_command,
    .base_phases = CLI_PHASE_DRAW,
    .heir = HEIR_SESSION,
    .settings_size = sizeof(render_settings),
};

/* The flag's name: "cameraPosition", "camera_position" -> "camera-position". */
static void write_flag_name(const char *name, char flag[CLI_NAME_MAX + 1]) {
    size_t length = 0;
    for (; *name && length + 1 < CLI_NAME_MAX; ++name) {
        const int is_capital = *name >= 'A' && *name <= 'Z';
        if (is_capital) {
            flag[length++] = '-';
        }
        flag[length++] = is_capital ? (char)(*name + 'a' - 'A') : *name == '_' ? '-' : *name;
    }
    flag[length] = 0;
}

const cli_flag *session_flag_at(size_t index, unsigned *stages) {
    const cli_flag *flag = cli_flag_at(&render_options_command, index);
    *stages = flag ? flag->phases & (CLI_PHASE_LOAD | CLI_PHASE_DRAW) : 0;
    return flag;
}

/* ---- Messages ---- */

static int is_in_name(char c) {
    return isalnum((unsigned char)c) || (c && strchr("_/\\", c));
}

/* The length of the flag that text begins with, such as "--size"; 0: none, as for "--size.stl" and
 * the end of "dir/--size". Only at the beginning of a message it can be an unknown one. */
static size_t measure_flag(const char *text, char before) {
    const size_t length = 2 + strspn(text + 2, "abcdefghijklmnopqrstuvwxyz0123456789-");
    const char *end = text + length;
    const int is_part = is_in_name(before) || (before && strchr("-.", before)) ||
                        is_in_name(*end) || (*end == '.' && is_in_name(end[1]));
    const int is_flag = !before || cli_find_flag(&render_command, text + 2, length - 2);
    return is_flag && !is_part ? length : 0;
}

/* Copies the flag's name without dashes, as the caller spells it. Returns the end of the copy. */
static char *copy_flag(const char *flag, size_t length, session_naming naming, char *to) {
    for (size_t i = 2; i < length; ++i) {
        if (flag[i] != '-') {
            *to++ = flag[i];
        } else if (naming == SESSION_UNDERSCORES) {
            *to++ = '_';
        } else {
            *to++ = (char)toupper((unsigned char)flag[++i]);
        }
    }
    return to;
}

/* Changes "--camera-position" into "camera_position" or "cameraPosition", in place, but not within
 * the input's name and quoted values. */
static void rename_flags(char *text, const char *name, session_naming naming) {
    const size_t name_length = name ? strlen(name) : 0;
    char *to = text, before = 0;
    int is_quoted = 0;
    if (naming == SESSION_FLAGS) {
        return;
    }
    for (const char *from = text; *from;) {
        const int is_name = name_length > 0 && strncmp(from, name, name_length) == 0;
        const size_t length =
            is_name || is_quoted || strncmp(from, "--", 2) != 0 ? 0 : measure_flag(from, before);
        const size_t copied = length > 0 ? length : is_name ? name_length : 1;
        before = from[copied - 1];
        is_quoted ^= copied == 1 && before == '"';
        if (length > 0) {
            to = copy_flag(from, length, naming, to);
        } else {
            memmove(to, from, copied);
            to += copied;
        }
        from += copied;
    }
    *to = 0;
}

/* ---- Values ---- */

/* The options that are one value: a list has an item for each of its texts and vectors. */
static size_t count_items(session_options options, size_t first, const cli_flag *flag) {
    size_t end = first + 1;
    while (flag && !flag->repeats && end < options.count &&
           strcmp(options.items[end].name, options.items[first].name) == 0) {
        ++end;
    }
    return end - first;
}

/* Writes options as the value of one flag, with commas between them. Returns the end. */
static char *write_values(const session_option *options, size_t count, char *text) {
    *text = 0;
    for (size_t i = 0; i < count; ++i) {
        const session_option *option = &options[i];
        text += i > 0 ? sprintf(text, ",") : 0;
        text += option->text ? sprintf(text, "%s", option->text) : 0;
        for (size_t k = 0; k < option->count; ++k) {
            const double value = option->numbers[k];
            text += k > 0 ? sprintf(text, ",") : 0;
            if (value == floor(value) && fabs(value) < 1e18) { /* counts can not have exponents */
                text += sprintf(text, "%.0f", value);
            } else {
                text += strlen(cli_shortest(value, text));
            }
        }
    }
    return text;
}

/* Memory for the texts of all options. */
static char *allocate_texts(session_options options) {
    size_t size = 1;
    for (size_t i = 0; i < options.count; ++i) {
        const session_option *option = &options.items[i];
        size += option->count * (CLI_REAL_SIZE + 1) + (option->text ? strlen(option->text) : 0) + 2;
    }
    return malloc(size);
}

/* Sets what is false or an empty list: nothing if the flag is a switch or adds up, unless there is
 * one that begins with "no-". */
static burnish_status switch_off(const cli_command *command, const cli_flag *flag,
                                 render_settings *settings, burnish_error *error) {
    char opposite[CLI_NAME_MAX];
    const int length = snprintf(opposite, sizeof opposite, "no-%s", flag->name);
    if (flag->off) {
        return cli_set(command, flag->name, flag->off, settings, error);
    }
    if (!flag->value && cli_find_flag(command, opposite, (size_t)length)) {
        return cli_set(command, opposite, NULL, settings, error);
    }
    return flag->value && !flag->repeats
               ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: it can't be switched off; omit it, or give %s", flag->name,
                          flag->value)
               : BURNISH_STATUS_OK;
}

/* Sets options of a command. Settings point to *texts; free it when they are no longer used. */
static burnish_status set_options(const cli_command *command, session_options options,
                                  render_settings *settings, char **texts, burnish_error *error) {
    char *next = *texts = allocate_texts(options);
    burnish_status status = next ? cli_defaults(command, settings, error)
                                 : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    for (size_t i = 0, count; i < options.count && status == BURNISH_STATUS_OK; i += count) {
        const session_option *option = &options.items[i];
        char name[CLI_NAME_MAX + 1];
        write_flag_name(option->name, name);
        const cli_flag *flag = cli_find_flag(command, name, strlen(name));
        count = count_items(options, i, flag);
        if (flag && option->is_off) {
            status = switch_off(command, flag, settings, error);
            continue;
        }
        const int has_value = option->text || option->numbers;
        const char *text = has_value ? next : NULL;
        next = write_values(option, count, next) + 1;
        status = cli_set(command, name, text, settings, error);
    }
    return status;
}

/* The settings of one picture of a mesh, which can have a section. */
static burnish_status set_drawing(session_options options, render_section section,
                                  render_settings *settings, char **texts, burnish_error *error) {
    memset(settings, 0, sizeof *settings);
    burnish_status status = set_options(&draw_command, options, settings, texts, error);
    settings->input.section = section;
    const int views = settings->picture.views.count > 1;
    if (status == BURNISH_STATUS_OK && (views || settings->shading.lobes.count > 1)) {
        status =
            cli_fail(error, BURNISH_STATUS_ARGUMENT,
                     "--%s: one picture at a time; give one of them", views ? "views" : "lobe");
    }
    return status == BURNISH_STATUS_OK ? render_check(settings, error) : status;
}

burnish_status session_check(session_options options, burnish_error *error) {
    render_settings settings;
    char *texts = NULL;
    const burnish_status status =
        set_drawing(options, (render_section){0}, &settings, &texts, error);
    free(texts);
    if (status != BURNISH_STATUS_OK) {
        rename_flags(error->text, NULL, options.naming);
    }
    return status;
}

/* ---- Loading ---- */

session *session_create(burnish_context *context) {
    session *s = calloc(1, sizeof *s);
    if (s) {
        s->context = context;
    }
    return s;
}

static void release_planes(session_planes *planes) {
    free(planes->depth);
    free(planes->normals);
    free(planes->triangles);
    free(planes->coverage);
    *planes = (session_planes){0};
}

void session_destroy(session *s) {
    if (!s) {
        return;
    }
    release_planes(&s->planes);
    render_drop_warnings(&s->result.warnings, 0);
    burnish_image_destroy(&s->cell.image);
    burnish_renderer_destroy(s->renderer);
    render_release_environment(&s->environment);
    free(s->environment_name);
    burnish_mesh_destroy(s->mesh);
    free(s->materials);
    free(s->companions.items);
    free((char *)(uintptr_t)s->coloring.by);
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

void session_request_facts(session *s) {
    s->settings.input.measure = 1;
}

/* Ends a call: messages spell options as the caller does, except for those of the library, which
 * name no flags. */
static burnish_status end_call(session *s, burnish_status status, session_naming naming,
                               burnish_error *error) {
    free(s->texts);
    s->texts = NULL;
    while (s->final_warnings < s->result.warnings.count) {
        rename_flags(s->result.warnings.lines[s->final_warnings++], s->name, naming);
    }
    if (status != BURNISH_STATUS_OK && strncmp(error->text, "--", 2) == 0) {
        rename_flags(error->text, s->name, naming);
    }
    return status;
}

/* Sets the options of loading. Only files, which can be handed over, may be of an importer's format. */
static burnish_status set_loading(session *s, const char *name, int is_file, session_options given,
                                  burnish_load_options *options, burnish_error *error) {
    s->name = strdup(name);
    s->settings.input.name = s->name;
    s->result.settings = &s->settings;
    burnish_status status = s->name
                                ? set_options(&open_command, given, &s->settings, &s->texts, error)
                                : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    if (status == BURNISH_STATUS_OK && !(is_file && SESSION_HAS_IMPORTERS)) {
        status = cli_refuse_foreign(s->settings.input.load.format, error);
    }
    if (status == BURNISH_STATUS_OK && s->settings.input.load.plate < 0) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--plate: one picture at a time; give the number of a plate");
    }
    if (status == BURNISH_STATUS_OK) {
        *options = render_load_options(&s->settings.input, s->settings.job.threads);
        options->context = s->context;
    }
    return status;
}

/* Copies the materials of the input. */
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

static burnish_status warn_useless(session *s, burnish_error *error) {
    const burnish_status status = render_warn_useless(&s->result, NULL, error);
    return status == BURNISH_STATUS_OK ? render_warn_useless(&s->result, s->mesh, error) : status;
}

static render_scene list_scene(session *s, burnish_render_options *options) {
    return (render_scene){
        &s->settings,         s->mesh, options, &s->environment, &s->result.warnings,
        s->result.color_range};
}

/* Prepares a loaded mesh for pictures. */
static burnish_status prepare_mesh(session *s, burnish_status status, burnish_error *error) {
    render_scene scene = list_scene(s, NULL);
    render_warn_of_mesh(&s->result.warnings, s->mesh);
    s->final_warnings = s->result.warnings.count;
    if (status == BURNISH_STATUS_OK) {
        status = warn_useless(s, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_prepare_mesh(&scene, error);
        s->stance = s->settings.camera;
        s->section = s->settings.input.section;
        s->coloring = s->settings.input.coloring;
        s->coloring.by = s->coloring.by ? strdup(s->coloring.by) : NULL; /* NULL: no legend */
    }
    s->loading_warnings = s->result.warnings.count;
    s->is_strict = s->settings.input.load.strict;
    if (status == BURNISH_STATUS_OK) {
        status = keep_materials(s, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_create(s->context, &s->renderer, error);
    }
    return status;
}

burnish_status session_open(session *s, const char *name, const void *bytes, size_t size,
                            session_options given, burnish_error *error) {
    burnish_load_options options;
    burnish_status status = set_loading(s, name, !bytes, given, &options, error);
    if (status == BURNISH_STATUS_OK && bytes) {
        options.referenced_files = cli_companion_loader(&s->companions);
        status = import_load_memory(bytes, size, s->name, &options, &s->mesh, error);
        status = prepare_mesh(s, status, error);
    } else if (status == BURNISH_STATUS_OK) {
        status = prepare_mesh(s, import_load(s->name, &options, &s->mesh, error), error);
    }
    return end_call(s, status, given.naming, error);
}

static int is_given(session_options options, const char *name) {
    for (size_t i = 0; i < options.count; ++i) {
        if (strcmp(options.items[i].name, name) == 0) {
            return 1;
        }
    }
    return 0;
}

burnish_status session_build(session *s, const burnish_mesh_description *description,
                             session_options given, burnish_error *error) {
    burnish_load_options options;
    burnish_status status =
        set_loading(s, description->name ? description->name : "mesh", 0, given, &options, error);
    if (!is_given(given, "up")) { /* the description's */
        s->settings.camera.up = UP_FORMAT;
    }
    if (status == BURNISH_STATUS_OK) {
        status =
            prepare_mesh(s, burnish_mesh_create(description, &options, &s->mesh, error), error);
    }
    return end_call(s, status, given.naming, error);
}

/* ---- Drawing ---- */

/* Undoes what the options of the last picture have changed. */
static burnish_status restore_materials(session *s, burnish_error *error) {
    const size_t count = burnish_mesh_get_material_count(s->mesh);
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = burnish_mesh_set_material(s->mesh, i, &s->materials[i], error);
    }
    return status;
}

void session_request_planes(session *s, unsigned kinds) {
    s->plane_kinds = kinds;
}

/* Draws the requested planes, with the options of the picture. */
static burnish_status draw_planes(session *s, const burnish_render_options *options,
                                  burnish_error *error) {
    const size_t width = (size_t)options->width, count = width * (size_t)options->height;
    const unsigned kinds = s->plane_kinds;
    session_planes *p = &s->planes;
    if (!kinds) {
        return BURNISH_STATUS_OK;
    }
    p->depth = kinds & SESSION_DEPTH ? malloc(count * sizeof *p->depth) : NULL;
    p->normals = kinds & SESSION_NORMAL ? malloc(count * 3 * sizeof *p->normals) : NULL;
    p->triangles = kinds & SESSION_TRIANGLE ? malloc(count * sizeof *p->triangles) : NULL;
    p->coverage = kinds & SESSION_COVERAGE ? malloc(count) : NULL;
    if ((kinds & SESSION_DEPTH && !p->depth) || (kinds & SESSION_NORMAL && !p->normals) ||
        (kinds & SESSION_TRIANGLE && !p->triangles) || (kinds & SESSION_COVERAGE && !p->coverage)) {
        return cli_fail(error, BURNISH_STATUS_MEMORY,
                        "out of memory: the planes; draw a smaller picture");
    }
    burnish_target target = burnish_target_default();
    target.depth = p->depth;
    target.depth_stride = width * sizeof *p->depth;
    target.normals = p->normals;
    target.normal_stride = width * 3 * sizeof *p->normals;
    target.triangles = p->triangles;
    target.triangle_stride = width * sizeof *p->triangles;
    target.coverage = p->coverage;
    target.coverage_stride = width;
    target.pixels.width = options->width;
    target.pixels.height = options->height;
    return burnish_renderer_draw_into(s->renderer, s->mesh, options, &target, NULL, error);
}

/* Drops the environment unless this picture has the same. */
static void keep_environment(session *s) {
    const char *name = s->settings.shading.environment.name;
    if (!s->environment_name || !name || strcmp(s->environment_name, name) != 0) {
        render_release_environment(&s->environment);
        free(s->environment_name);
        s->environment_name = name ? strdup(name) : NULL;
    }
}

static burnish_status draw_picture(session *s, burnish_error *error) {
    burnish_render_options options;
    render_scene scene = list_scene(s, &options);
    render_room room = {.is_given = 0};
    render_cell *cell = &s->cell;
    cell->view =
        s->settings.picture.views.count > 0 ? s->settings.picture.views.items[0] : VIEW_FREE;
    cell->lobe = s->settings.shading.lobes.items[0];
    s->result.mesh = s->mesh;
    s->result.options = &options;
    s->result.renderer = s->renderer;
    s->result.cells = cell;
    s->result.cell_count = 1;
    keep_environment(s);
    burnish_status status = restore_materials(s, error);
    if (status == BURNISH_STATUS_OK) {
        status = render_prepare_picture(&scene, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_camera(s->mesh, &s->settings, cell->view, &room, &cell->camera, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_draw_cell(&s->result, cell, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw_planes(s, &options, error);
    }
    s->result.options = NULL; /* they end here */
    cell->hash = status == BURNISH_STATUS_OK ? burnish_image_hash(&cell->image) : 0;
    return status;
}

burnish_status session_draw(session *s, session_options options, burnish_error *error) {
    burnish_image_destroy(&s->cell.image);
    s->cell = (render_cell){.hash = 0};
    release_planes(&s->planes);
    render_drop_warnings(&s->result.warnings, s->loading_warnings);
    s->final_warnings = s->loading_warnings;
    burnish_status status = set_drawing(options, s->section, &s->settings, &s->texts, error);
    s->settings.input.name = s->name;
    s->coloring.no_legend = s->settings.input.coloring.no_legend;
    s->settings.input.coloring = s->coloring;
    s->settings.camera.up = s->stance.up;
    s->settings.camera.stands_otherwise = s->stance.stands_otherwise;
    s->settings.camera.flat_axis = s->stance.flat_axis;
    memcpy(s->settings.camera.slant, s->stance.slant, sizeof s->stance.slant);
    s->settings.input.load.strict = s->is_strict;
    if (status == BURNISH_STATUS_OK) {
        status = warn_useless(s, error);
    }
    return end_call(s, status == BURNISH_STATUS_OK ? draw_picture(s, error) : status,
                    options.naming, error);
}

/* ---- Results ---- */

const burnish_image *session_image(const session *s) {
    return &s->cell.image;
}

burnish_image session_take_image(session *s) {
    const burnish_image image = s->cell.image;
    s->cell.image = (burnish_image){0};
    return image;
}

session_planes session_take_planes(session *s) {
    const session_planes planes = s->planes;
    s->planes = (session_planes){0};
    return planes;
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

char *session_contents(const session *s) {
    burnish_box *boxes = cli_bound_parts(s->mesh);
    int failed = !boxes;
    cJSON *contents = boxes ? cli_contents_json(s->mesh, boxes, &failed) : NULL;
    free(boxes);
    return cli_json_string(contents, failed, 0);
}

int session_up_number(const session *s) {
    return (int)render_up_in_use(s->mesh, &s->settings.camera, (double[3]){0});
}

const char *session_warning(const session *s, size_t index) {
    return index < s->result.warnings.count ? s->result.warnings.lines[index] : NULL;
}
