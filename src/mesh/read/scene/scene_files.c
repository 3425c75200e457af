/* The files of a scene. */
#include <stdio.h>
#include <string.h>

#include "base/show_text.h"
#include "mesh/read/archive.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/companions.h"
#include "mesh/read/read.h"
#include "mesh/read/scene/scene.h"

/* In a scene of files that state no limit: as of one large file. */
#define BURNISH_SCENE_TEXELS ((uint64_t)1 << 28)

enum { WARNINGS_MOST = 64, HEAD = 1 << 16 };

/* A file while it is read. */
typedef struct scene_file {
    burnish_scene *scene;
    const char *given; /* as the loader takes it */
    const char *path;  /* the same without parts that are empty or "." */
    char *shown;       /* its name for messages, allocated */
    char folder[BURNISH_COMPANION_SIZE];
    const void *bytes; /* the loader's */
    size_t size;
    burnish_scene_source *source;
    burnish_error *error;
} scene_file;

burnish_scene_source *burnish_scene_make(burnish_scene *scene) {
    burnish_mesh_data *mesh = scene->reader->mesh;
    burnish_memory *memory = &mesh->memory;
    burnish_scene_source *source = burnish_allocate_zeroed(memory, 1, sizeof *source, "a scene");
    scene->sources = burnish_reserve(memory, scene->sources, &scene->source_capacity,
                                     scene->source_count + 1, sizeof *scene->sources, "a scene");
    if (memory->status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, source);
        return NULL;
    }
    source->mesh = burnish_mesh_data_begin(memory->context, mesh->tasks, memory->error);
    source->mesh.is_silent = mesh->is_silent;
    scene->sources[scene->source_count++] = source;
    return source;
}

burnish_scene_item *burnish_scene_add(burnish_scene *scene, burnish_scene_source *source) {
    burnish_memory *memory = &scene->reader->mesh->memory;
    if (scene->item_count == BURNISH_SCENE_ITEMS) {
        return NULL;
    }
    scene->items = burnish_reserve(memory, scene->items, &scene->item_capacity,
                                   scene->item_count + 1, sizeof *scene->items, "a scene");
    if (memory->status != BURNISH_STATUS_OK) {
        return NULL;
    }
    scene->items[scene->item_count] =
        (burnish_scene_item){.source = source, .transform = BURNISH_MATRIX_IDENTITY};
    return &scene->items[scene->item_count++];
}

void burnish_scene_close(burnish_scene *scene) {
    const burnish_context *context = scene->reader->mesh->memory.context;
    for (size_t i = 0; i < scene->source_count; ++i) {
        burnish_mesh_data_destroy(&scene->sources[i]->mesh);
        burnish_release(context, scene->sources[i]->shown);
        burnish_release(context, scene->sources[i]);
    }
    burnish_release(context, scene->sources);
    burnish_release(context, scene->items);
    burnish_release(context, scene->joint_found);
}

/* ---- Reading ---- */

/* Whether an importer should make a mesh stream of a file; its extension in lower case. */
static int needs_importer(const scene_file *file, char extension[BURNISH_EXTENSION_SIZE]) {
    burnish_lower_extension(file->path, strlen(file->path), extension);
    return file->scene->reader->input->options->decoder.decode && *extension &&
           burnish_format_of_name(file->path) == BURNISH_FORMAT_AUTO &&
           burnish_guess_format(file->bytes, file->size, file->path) == BURNISH_FORMAT_AUTO;
}

/* A scene may contain a robot, and a robot meshes: no deeper. */
static burnish_status refuse_nested(const scene_file *file, burnish_format format) {
    const int in_robot = file->scene->is_robot;
    if (format != BURNISH_FORMAT_SCENE && !(format == BURNISH_FORMAT_URDF && in_robot)) {
        return BURNISH_STATUS_OK;
    }
    return burnish_fail(
        file->error, BURNISH_STATUS_FORMAT, "%s: a %s in a %s; list its files instead",
        burnish_show_name(file->shown).text, format == BURNISH_FORMAT_SCENE ? "scene" : "robot",
        in_robot ? "robot" : "scene");
}

/* Texels that the next file may have. */
static uint64_t texels_left(const burnish_scene *scene) {
    const uint64_t asked = scene->reader->input->options->max_texture_pixels;
    const uint64_t most = asked == BURNISH_TEXTURE_PIXELS_AUTO ? BURNISH_SCENE_TEXELS : asked;
    return asked == BURNISH_TEXTURE_PIXELS_AUTO && scene->texels < BURNISH_SCENE_TEXELS / 2 ? asked
           : most > scene->texels ? most - scene->texels
                                  : 0;
}

/* Options for a file, whose coordinates are moved only in the scene. */
static burnish_load_options options_of(const burnish_scene *scene) {
    burnish_load_options options = *scene->reader->input->options;
    options.format = BURNISH_FORMAT_AUTO;
    options.max_texture_pixels = texels_left(scene);
    options.origin = NULL;
    options.scalar_property = NULL;
    options.thumbnail = BURNISH_THUMBNAIL_NEVER;
    return options;
}

/* Loads what a file names, for the outer reader, which counts it once for all files. */
static burnish_status load_companion(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error) {
    burnish_reader *outer = user_data;
    const burnish_file_loader *from = &outer->input->companions;
    const burnish_status status = from->load(from->user_data, name, max_bytes, bytes, size, error);
    if (status == BURNISH_STATUS_OK) { /* failing memory fails the scene later */
        burnish_budget_companion(outer, burnish_companion_key(name), *size);
    }
    return status;
}

static void release_companion(void *user_data, const void *bytes, size_t size) {
    const burnish_file_loader *from = &((burnish_reader *)user_data)->input->companions;
    if (from->release) {
        from->release(from->user_data, bytes, size);
    }
}

/* Reads bytes as a format, or as what they are. */
static burnish_status read_bytes(scene_file *file, const uint8_t *bytes, size_t size,
                                 burnish_format format) {
    burnish_reader *outer = file->scene->reader;
    burnish_mesh_data *mesh = &file->source->mesh;
    burnish_load_options options = options_of(file->scene);
    burnish_reader_input input = {.bytes = bytes,
                                  .size = size,
                                  .name = file->shown,
                                  .options = &options,
                                  .companions = {load_companion, release_companion, outer},
                                  .folder = file->folder,
                                  .joint_found = file->scene->joint_found,
                                  .is_archived = outer->input->is_archived};
    burnish_reader reader = {.input = &input, .mesh = mesh, .error = file->error};
    burnish_archive archive = {.zip = {0}};
    uint8_t *unpacked;
    mesh->memory.error = file->error;
    burnish_status status = burnish_unpack_input(&input, &mesh->memory, &unpacked);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_archive_open(&archive, &input, mesh, file->error);
    }
    if (status == BURNISH_STATUS_OK && format == BURNISH_FORMAT_AUTO) {
        format = burnish_guess_format(input.bytes, input.size, input.name);
        status = refuse_nested(file, format);
    }
    if (status == BURNISH_STATUS_OK) {
        options.format = format;
        status = burnish_read(&reader, &format);
    }
    burnish_archive_close(&archive);
    burnish_release(mesh->memory.context, unpacked);
    if (mesh->up_axis[0] == 0 && mesh->up_axis[1] == 0 && mesh->up_axis[2] == 0) {
        memcpy(mesh->up_axis, burnish_format_get_info(format)->up_axis, sizeof mesh->up_axis);
    }
    return status;
}

/* COLLADA states its up axis near the beginning; importers turn it to +Y. */
static int has_z_up(const scene_file *file) {
    static const char word[] = "Z_UP<";
    const size_t looked = file->size < HEAD ? file->size : HEAD;
    int found = 0;
    for (size_t i = 0; i + sizeof word - 1 <= looked && !found; ++i) {
        found = memcmp((const char *)file->bytes + i, word, sizeof word - 1) == 0;
    }
    return found;
}

static burnish_status import_bytes(scene_file *file, const char *extension) {
    const burnish_stream_decoder *decoder = &file->scene->reader->input->options->decoder;
    const uint8_t *stream;
    size_t size;
    burnish_error why = {0};
    burnish_status status = decoder->decode(decoder->user_data, extension, file->bytes, file->size,
                                            &stream, &size, &why);
    if (status != BURNISH_STATUS_OK) {
        return burnish_fail(file->error, status, "%s: %s", burnish_show_name(file->shown).text,
                            why.text);
    }
    status = read_bytes(file, stream, size, BURNISH_FORMAT_BMS);
    file->source->is_turned = has_z_up(file);
    if (decoder->release) {
        decoder->release(decoder->user_data, stream, size);
    }
    return status;
}

/* Warnings of a file are those of the scene; the context has them already. */
static void take_warnings(burnish_scene *scene, burnish_mesh_data *from) {
    burnish_mesh_data *to = scene->reader->mesh;
    const size_t room = to->warning_count < WARNINGS_MOST ? WARNINGS_MOST - to->warning_count : 0;
    const size_t taken = from->warning_count < room ? from->warning_count : room;
    scene->more_warnings += from->warning_count - taken;
    for (size_t i = 0; i < taken; ++i) {
        to->warnings = burnish_reserve(&to->memory, to->warnings, &to->warning_capacity,
                                       to->warning_count + 1, sizeof *to->warnings, "warnings");
        if (to->memory.status == BURNISH_STATUS_OK) {
            to->warnings[to->warning_count++] = from->warnings[i];
            from->warnings[i] = NULL;
        }
    }
}

burnish_status burnish_scene_count(burnish_scene *scene, const burnish_mesh_data *mesh) {
    const uint64_t limit = scene->reader->input->options->max_triangles;
    scene->vertices += mesh->streams[BURNISH_POSITION].count;
    scene->triangles += mesh->triangle_count;
    for (size_t i = 0; i < mesh->texture_count; ++i) {
        scene->texels += (uint64_t)mesh->textures[i].width * (uint64_t)mesh->textures[i].height;
    }
    return scene->triangles > limit
               ? burnish_fail_triangles(scene->reader, NULL)
               : burnish_budget_check(scene->reader, scene->vertices, scene->triangles);
}

/* The file's name in the root, or next to the input's, and its folder. */
static burnish_status name_file(scene_file *file) {
    burnish_memory *memory = &file->scene->reader->mesh->memory;
    const burnish_reader_input *input = file->scene->reader->input;
    const char *root = input->folder ? input->options->root : NULL;
    const char *slash = strrchr(input->name, '/');
    const size_t size = root ? strlen(root) : slash ? (size_t)(slash - input->name) : 0;
    file->shown = burnish_allocate(memory, size + strlen(file->path) + 2, 1, "a name");
    if (file->shown) {
        memcpy(file->shown, root ? root : input->name, size);
        const int has_slash = size > 0 && file->shown[size - 1] != '/';
        strcpy(file->shown + size, has_slash ? "/" : "");
        strcat(file->shown + size, file->path);
    }
    const char *end = strrchr(file->path, '/');
    memcpy(file->folder, file->path, end ? (size_t)(end - file->path) : 0);
    return memory->status;
}

static burnish_status load_file(scene_file *file) {
    burnish_reader *reader = file->scene->reader;
    const burnish_file_loader *companions = &reader->input->companions;
    const uint64_t key = burnish_companion_key(file->given);
    char extension[BURNISH_EXTENSION_SIZE];
    burnish_status status = companions->load(companions->user_data, file->given,
                                             reader->input->options->max_input_bytes, &file->bytes,
                                             &file->size, file->error);
    if (status != BURNISH_STATUS_OK) {
        burnish_companion_missing(reader->input, file->error);
        return status;
    }
    file->source = name_file(file) == BURNISH_STATUS_OK ? burnish_scene_make(file->scene) : NULL;
    if (file->source) {
        file->source->shown = file->shown;
        file->source->path = file->shown + strlen(file->shown) - strlen(file->path);
    }
    if (!file->source || !burnish_budget_companion(reader, key, file->size)) {
        status = reader->mesh->memory.status != BURNISH_STATUS_OK
                     ? reader->mesh->memory.status
                     : burnish_fail(file->error, BURNISH_STATUS_LIMIT, "%s: referenced too often",
                                    file->shown);
    } else {
        status = needs_importer(file, extension)
                     ? import_bytes(file, extension)
                     : read_bytes(file, file->bytes, file->size, BURNISH_FORMAT_AUTO);
        take_warnings(file->scene, &file->source->mesh);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_scene_count(file->scene, &file->source->mesh);
        }
    }
    if (companions->release) {
        companions->release(companions->user_data, file->bytes, file->size);
    }
    return status;
}

burnish_status burnish_scene_load(burnish_scene *scene, const char *name,
                                  burnish_scene_source **source, burnish_error *error) {
    burnish_reader *reader = scene->reader;
    char given[BURNISH_COMPANION_SIZE], path[BURNISH_COMPANION_SIZE];
    const burnish_reader_input here = {.folder = "."};
    *source = NULL;
    if (!reader->input->companions.load) {
        return burnish_fail(error, BURNISH_STATUS_READ,
                            "the files that it names are not available here");
    }
    if (!burnish_companion_path(reader->input, name, given)) {
        return burnish_companion_outside(reader->input, name, error);
    }
    if (!burnish_companion_path(&here, given, path)) {
        strcpy(path, given);
    }
    for (size_t i = 0; i < scene->source_count; ++i) {
        burnish_scene_source *known = scene->sources[i];
        if (known->path && strcmp(known->path, path) == 0) {
            *source = known->status == BURNISH_STATUS_OK ? known : NULL;
            *error = known->why;
            return known->status;
        }
    }
    scene_file file = {.scene = scene, .given = given, .path = path, .error = error};
    const burnish_status status = load_file(&file);
    if (!file.source) {
        burnish_release(reader->mesh->memory.context, file.shown);
    } else if (status != BURNISH_STATUS_OK) { /* nothing of it is used */
        burnish_mesh_data_destroy(&file.source->mesh);
        file.source->status = status;
        file.source->why = *error;
    }
    *source = status == BURNISH_STATUS_OK ? file.source : NULL;
    return status;
}
