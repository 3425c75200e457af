/* Input flags of the commands that load a mesh. */
#include "cli/input.h"
#include "base/cli/platform.h"
#include "base/inputs.h"
#include "base/platform.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define WORD(name, word, ...)                                                                      \
    , {                                                                                            \
#word, BURNISH_FORMAT_##name                                                               \
    }
const cli_word cli_input_formats[] = {{"auto", BURNISH_FORMAT_AUTO} BURNISH_FORMAT_LIST(WORD),
                                      {NULL, 0}};
#define MANUAL(name, word, ...) "*" #word "*, "
#define FOREIGN_MANUAL(word) " *" #word "*"
const char cli_input_format_manual[] =
    "Format of _INPUT_, regardless of its name: " BURNISH_FORMAT_LIST(
        MANUAL) "or *auto*, which checks the file extension and the first bytes. If an importer is "
                "installed (docs/importers.md), also the extensions that it reads, without the "
                "dot:" CLI_OCCT_LIST(FOREIGN_MANUAL) CLI_ASSIMP_LIST(FOREIGN_MANUAL) ".";

const cli_word cli_thumbnails[] = {{"auto", BURNISH_THUMBNAIL_AUTO},
                                   {"never", BURNISH_THUMBNAIL_NEVER},
                                   {"only", BURNISH_THUMBNAIL_ONLY},
                                   {NULL, 0}};

#define LISTED(name, word, ...) ", " #word
#define FOREIGN_NAME(word) #word,
static const char *const foreign[] = {CLI_OCCT_LIST(FOREIGN_NAME) CLI_ASSIMP_LIST(FOREIGN_NAME)};

const char *cli_foreign_extension(int format) {
    return format > CLI_FOREIGN_BEFORE && format < CLI_FOREIGN_COUNT
               ? foreign[format - CLI_FOREIGN_BEFORE - 1]
               : NULL;
}

/* Whether the name is longer than this extension, and ends with it: ".stl". */
static int ends_in(const char *name, size_t length, const char *extension, size_t size) {
    return length > size && strncasecmp(name + length - size, extension, size) == 0;
}

burnish_format cli_own_format(const char *name) {
    const size_t whole = strlen(name), length = whole - (ends_in(name, whole, ".gz", 3) ? 3 : 0);
    for (int i = 0; i < burnish_format_count(); ++i) {
        const char *extension = burnish_format_get_info((burnish_format)i)->extensions;
        while (*extension) {
            const size_t size = strcspn(extension, " ");
            if (ends_in(name, length, extension, size)) {
                return (burnish_format)i;
            }
            extension += size + (extension[size] == ' ');
        }
    }
    return BURNISH_FORMAT_AUTO;
}

int cli_is_mesh_name(const char *name) {
    const char *dot = strrchr(cli_base_name(name), '.');
    for (size_t i = 0; dot && i < sizeof foreign / sizeof *foreign; ++i) {
        if (strcasecmp(dot + 1, foreign[i]) == 0) {
            return 1;
        }
    }
    return cli_own_format(name) != BURNISH_FORMAT_AUTO;
}

const char *cli_model_name(const char *input) {
    const char *member = burnish_archive_member(input);
    return *input == ':' ? input + 1 : cli_base_name(member ? member : input);
}

size_t cli_stem_length(const char *base) {
    const size_t whole = strlen(base);
    size_t end =
        whole -
        (ends_in(base, whole, ".gz", 3) && cli_own_format(base) != BURNISH_FORMAT_AUTO ? 3 : 0);
    for (size_t i = end; i-- > 1;) {
        if (base[i] == '.') {
            return i;
        }
    }
    return end;
}

burnish_status cli_refuse_foreign(int format, burnish_error *error) {
    const char *extension = cli_foreign_extension(format);
    return extension ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                "--input-format: %s needs an importer, which is not available "
                                "here; convert the file to glTF, OBJ, PLY or STL",
                                extension)
                     : BURNISH_STATUS_OK;
}

burnish_status cli_flag_texture_pixels(const cli_flag *flag, const char *text, void *target,
                                       burnish_error *error) {
    if (strcmp(text, "auto") != 0) {
        return cli_flag_count(flag, text, target, error);
    }
    *(uint64_t *)target = BURNISH_TEXTURE_PIXELS_AUTO;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_input_format(const cli_flag *flag, const char *text, void *target,
                                     burnish_error *error) {
    for (int i = CLI_FOREIGN_BEFORE + 1; i < CLI_FOREIGN_COUNT; ++i) {
        if (strcmp(cli_foreign_extension(i), text) == 0) {
            *(int *)target = i;
            return BURNISH_STATUS_OK;
        }
    }
    burnish_error unused;
    return cli_flag_word(flag, text, target, &unused) == BURNISH_STATUS_OK
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: \"%.60s\" is not one of auto" BURNISH_FORMAT_LIST(
                              LISTED) ", nor a file extension of an importer (fbx, step ...; "
                                      "docs/importers.md)",
                          flag->name, text);
}

burnish_status cli_flag_joint(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    cli_joints *joints = target;
    burnish_joint joint = {.name = ""};
    const char *colon = strrchr(text, ':');
    if (!colon || colon == text || (size_t)(colon - text) >= sizeof joint.name ||
        !cli_read_reals(colon + 1, strlen(colon + 1), &joint.value, 1) ||
        !(joint.value >= -1e6 && joint.value <= 1e6)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not NAME:VALUE, such as elbow:0.5", flag->name, text);
    }
    if (joints->count == CLI_JOINTS_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d joints; omit some",
                        flag->name, CLI_JOINTS_MAX);
    }
    memcpy(joint.name, text, (size_t)(colon - text));
    joints->items[joints->count++] = joint;
    return BURNISH_STATUS_OK;
}

void cli_list_input_needs(const burnish_mesh *mesh, cli_need needs[CLI_INPUT_NEEDS]) {
    const burnish_mesh_info *info = mesh ? burnish_mesh_get_info(mesh) : NULL;
    needs[0] = (cli_need){"animation,animation-time", info && info->format == BURNISH_FORMAT_GLTF,
                          "only glTF files have animations; omit the flag"};
    needs[1] = (cli_need){"tessellation", info && info->format == BURNISH_FORMAT_BUILTIN,
                          "only built-in objects such as :teapot have patches; omit the flag"};
    needs[2] = (cli_need){"point-size", info && info->point_count + info->line_count > 0,
                          "only points and lines have a size, and INPUT has faces; omit the flag"};
    needs[3] = (cli_need){"variant", burnish_mesh_get_variant_count(mesh) > 0,
                          "INPUT has no variants; omit the flag"};
    needs[4] = (cli_need){"plate", mesh && burnish_mesh_get_contents(mesh)->plate_count > 0,
                          "INPUT has no plates; omit the flag"};
    needs[5] = (cli_need){"hide,only", mesh && burnish_mesh_get_contents(mesh)->part_count > 0,
                          "INPUT has no parts; omit the flag"};
    needs[6] = (cli_need){
        "thumbnail",
        info && (info->format == BURNISH_FORMAT_3MF || info->format == BURNISH_FORMAT_GCODE),
        "only 3MF files and G-code hold pictures of themselves; omit the flag"};
    needs[7] = (cli_need){"explode", mesh && burnish_mesh_get_contents(mesh)->part_count > 1,
                          "INPUT does not have two parts; omit the flag"};
    needs[9] = (cli_need){"callouts", mesh && burnish_mesh_get_contents(mesh)->part_count > 0,
                          "INPUT has no parts; omit the flag"};
    needs[8] = (cli_need){
        "joint",
        info && (info->format == BURNISH_FORMAT_URDF || info->format == BURNISH_FORMAT_SCENE),
        "only robots (URDF) have joints; omit the flag"};
}

burnish_status cli_flag_plate(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    const int is_sheet = strcmp(text, "sheet") == 0;
    if (!is_sheet && strcmp(text, "all") != 0) {
        return cli_flag_integer(flag, text, target, error);
    }
    *(int *)target = is_sheet ? CLI_PLATE_SHEET : 0;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_part_names(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error) {
    char *names = target;
    const size_t used = strlen(names);
    if (!*text) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: the value is empty: --%s=%s",
                        flag->name, flag->name, flag->value);
    }
    if (used + strlen(text) + 2 > CLI_NAMES_SIZE) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: more than %d bytes of names; use * for several", flag->name,
                        CLI_NAMES_SIZE - 2);
    }
    snprintf(names + used, CLI_NAMES_SIZE - used, "%s%s", used > 0 ? "," : "", text);
    return BURNISH_STATUS_OK;
}

burnish_load_options cli_load_options(const cli_input *input) {
    burnish_load_options options = burnish_load_options_default();
    options.format = (burnish_format)input->format;
    options.tessellation = input->tessellation;
    options.strict = input->strict;
    if (input->animation_time.given) {
        options.animation_time = input->animation_time.value;
    }
    options.animation = input->animation;
    options.variant = input->variant;
    options.root = input->root;
    options.plate = input->plate > 0 ? input->plate : 0;
    options.project = input->project;
    options.hidden_parts = *input->hidden_parts ? input->hidden_parts : NULL;
    options.only_parts = *input->only_parts ? input->only_parts : NULL;
    options.explode = input->explode.given ? input->explode.value : 0;
    options.thumbnail = (burnish_thumbnail)input->thumbnail;
    options.ignore_referenced_files = input->no_libraries;
    options.point_size = input->point_size.given ? input->point_size.value : 0;
    options.max_memory = input->max_memory;
    options.max_triangles = input->max_triangles;
    options.max_input_bytes = input->max_input_bytes;
    options.ignore_textures = input->no_textures;
    options.max_texture_pixels = input->max_texture_pixels;
    options.joints = input->joints.items;
    options.joint_count = input->joints.count;
    return options;
}

static burnish_status load_companion(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error) {
    const cli_companions *companions = user_data;
    for (size_t i = 0; i < companions->count; ++i) {
        const cli_companion *found = &companions->items[i];
        if (strcmp(found->name, name) == 0 && found->size <= max_bytes) {
            *bytes = found->bytes;
            *size = found->size;
            return BURNISH_STATUS_OK;
        }
    }
    return cli_fail(error, BURNISH_STATUS_READ,
                    "%.300s: is not one of the files that were passed with the input; pass it too",
                    name);
}

burnish_file_loader cli_companion_loader(cli_companions *companions) {
    return (burnish_file_loader){.load = load_companion, .user_data = companions};
}

/* Reads the rest of the stream, or the beginning of one that is not recognised. */
static burnish_status read_stream(const char *path, FILE *file, uint64_t max_bytes,
                                  cli_recognise *recognise, uint8_t **bytes, size_t *size,
                                  burnish_error *error) {
    size_t capacity = 0;
    for (;;) {
        if (*size + 1 >= capacity) {
            capacity = capacity ? 2 * capacity : 1 << 16;
            uint8_t *grown = capacity > *size ? realloc(*bytes, capacity) : NULL;
            if (!grown) {
                return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory for the file",
                                path);
            }
            *bytes = grown;
        }
        const size_t count = fread(*bytes + *size, 1, capacity - *size - 1, file);
        *size += count;
        if (*size > max_bytes) {
            return cli_fail(error, BURNISH_STATUS_LIMIT,
                            "%.200s: larger than %llu bytes; raise --max-input-bytes", path,
                            (unsigned long long)max_bytes);
        }
        if (ferror(file)) {
            return cli_fail(error, cli_errno_status(errno), "%.200s: can't be read: %s", path,
                            strerror(errno));
        }
        if (count == 0 || (recognise && !recognise(*bytes, *size))) {
            (*bytes)[*size] = 0;
            return BURNISH_STATUS_OK;
        }
    }
}

burnish_status cli_read_bytes(const char *path, uint64_t max_bytes, cli_recognise *recognise,
                              uint8_t **bytes, size_t *size, burnish_error *error) {
    const int standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    *bytes = NULL;
    *size = 0;
    if (!file) {
        return cli_fail(error, cli_errno_status(errno), "%.200s: can't be opened: %s", path,
                        cli_open_reason(path, errno));
    }
    const burnish_status status = read_stream(standard ? "standard input" : path, file, max_bytes,
                                              recognise, bytes, size, error);
    if (!standard) {
        fclose(file);
    }
    if (status != BURNISH_STATUS_OK) {
        free(*bytes);
        *bytes = NULL;
        *size = 0;
    }
    return status;
}
