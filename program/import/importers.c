/* The list of importers, and how their streams become meshes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/options.h"
#include "cli/input.h"
#include "import/folder.h"
#include "import/importers.h"

#define EXTENSION(word) "." #word " "
#define OF_DEBIAN(option, library)                                                                 \
    "the Debian package of that name, build it (-DBURNISH_IMPORT_" option "=ON, Debian's " library \
    ")"
static const char otherwise[] = "convert the file to glTF, OBJ, PLY or STL";
static const import_program importers[] = {
    {"burnish-import-occt", OF_DEBIAN("OCCT", "libocct-data-exchange-dev"),
     " " CLI_OCCT_LIST(EXTENSION), NULL, otherwise},
    {"burnish-import-assimp", OF_DEBIAN("ASSIMP", "libassimp-dev"), " " CLI_ASSIMP_LIST(EXTENSION),
     NULL, otherwise}};

void import_get_extension(const char *name, char extension[IMPORT_EXTENSION_SIZE]) {
    const size_t size = strlen(name);
    const int is_packed = size >= 3 && burnish_is_same_name(name + size - 3, ".gz");
    burnish_lower_extension(name, size - (is_packed ? 3 : 0), extension);
}

/* The importer whose extensions contain that word: " .fbx ". */
static const import_program *find_word(const char *word) {
    for (size_t i = 0; i < sizeof importers / sizeof *importers; ++i) {
        if (strstr(importers[i].extensions, word)) {
            return &importers[i];
        }
    }
    return NULL;
}

const import_program *import_of_extension(const char *extension) {
    char word[IMPORT_EXTENSION_SIZE + 4];
    snprintf(word, sizeof word, " .%.*s ", IMPORT_EXTENSION_SIZE, extension);
    return find_word(word);
}

#ifndef _WIN32

const import_program *import_find(const char *name) {
    char extension[IMPORT_EXTENSION_SIZE], word[IMPORT_EXTENSION_SIZE + 4];
    import_get_extension(name, extension);
    if (!*extension || *name == ':' || burnish_archive_member(name)) { /* the reader asks */
        return NULL;
    }
    snprintf(word, sizeof word, " .%s ", extension);
    for (int i = 0; i < burnish_format_count(); ++i) {
        const burnish_format_info *info = burnish_format_get_info((burnish_format)i);
        char own[64];
        snprintf(own, sizeof own, " %s ", info->extensions);
        if (strstr(own, word)) {
            return NULL;
        }
    }
    return find_word(word);
}

const import_program *import_choose(const char *input, int format,
                                    char extension[IMPORT_EXTENSION_SIZE]) {
    const char *named = cli_foreign_extension(format);
    char word[IMPORT_EXTENSION_SIZE + 4];
    if (!named) {
        import_get_extension(input, extension);
        return format == BURNISH_FORMAT_AUTO && strcmp(input, "-") != 0 ? import_find(input) : NULL;
    }
    snprintf(extension, IMPORT_EXTENSION_SIZE, "%s", named);
    snprintf(word, sizeof word, " .%s ", named);
    return *input == ':' ? NULL : find_word(word);
}

#else

const import_program *import_find(const char *name) {
    (void)name, (void)find_word;
    return NULL;
}

const import_program *import_choose(const char *input, int format,
                                    char extension[IMPORT_EXTENSION_SIZE]) {
    (void)input, (void)format, (void)extension;
    return NULL;
}

#endif

const char *import_format_word(const char *name, int requested, const burnish_mesh_info *info,
                               char extension[IMPORT_EXTENSION_SIZE]) {
    return *info->imported ? info->imported
           : info->format == BURNISH_FORMAT_BMS && import_choose(name, requested, extension)
               ? extension
               : burnish_format_get_info(info->format)->name;
}

int import_keep(void *context, const void *bytes, size_t size) {
    import_stream *stream = context;
    if (size > stream->capacity - stream->size) {
        size_t capacity = stream->capacity > 0 ? stream->capacity : (size_t)1 << 20;
        while (capacity - stream->size < size && capacity <= SIZE_MAX / 2) {
            capacity *= 2;
        }
        unsigned char *larger = capacity - stream->size >= size && !stream->is_short
                                    ? realloc(stream->bytes, capacity)
                                    : NULL;
        if (!larger) {
            stream->is_short = 1;
            return 0;
        }
        stream->bytes = larger;
        stream->capacity = capacity;
    }
    memcpy(stream->bytes + stream->size, bytes, size);
    stream->size += size;
    return 1;
}

int import_expect(import_stream *stream, uint64_t size) {
    const size_t capacity = size > 0 ? (size_t)size : 1;
    stream->bytes = capacity == size || size == 0 ? malloc(capacity) : NULL;
    stream->capacity = stream->bytes ? capacity : 0;
    stream->is_short = !stream->bytes;
    return !stream->is_short;
}

/* The end of a path that is too long for a message. */
static const char *shown_end(const char *name) {
    const size_t size = strlen(name);
    return size > 200 ? name + size - 200 : name;
}

burnish_status import_build(const import_program *importer, const char *name,
                            const import_stream *stream, const burnish_load_options *options,
                            burnish_mesh **mesh, burnish_error *error) {
    burnish_load_options handed = *options;
    char whole[256];
    *mesh = NULL;
    if (stream->is_short) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory for what %s makes",
                        shown_end(name), importer->name);
    }
    if (stream->size == 0) {
        return cli_fail(error, BURNISH_STATUS_FORMAT, "%.200s: %s ended without a mesh",
                        shown_end(name), importer->name);
    }
    snprintf(whole, sizeof whole, "%.200s: %s", shown_end(name), importer->name);
    handed.format = BURNISH_FORMAT_BMS;
    handed.max_input_bytes = UINT64_MAX; /* max_input_bytes limits the imported file only */
    return burnish_mesh_load_memory(stream->bytes, stream->size, whole, &handed, mesh, error);
}

int import_may_be_other(burnish_status status, int format) {
    return status == BURNISH_STATUS_FORMAT && !cli_foreign_extension(format);
}

const char *import_shown(const char *path) {
    return strcmp(path, "-") == 0 ? "standard input" : path;
}
