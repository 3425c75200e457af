/* Which importers there are, and what is done with their streams. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "import/folder.h"
#include "import/import.h"

/* Of two with the same ending the first counts. Endings that mean other things more often (.xml,
 * .raw, .bvh, .csm ...) are left out. */
static const char otherwise[] = "convert the file to glTF, OBJ, PLY or STL";
static const import_program importers[] = {
    {"burnish-import-occt", "-DBURNISH_IMPORT_OCCT=ON, Debian's libocct-data-exchange-dev",
     " .step .stp .p21 .iges .igs .brep .brp ", NULL, otherwise},
    {"burnish-import-assimp", "-DBURNISH_IMPORT_ASSIMP=ON, Debian's libassimp-dev",
     " .3ds .ac .ac3d .acc .amf .ase .ask .b3d .blend .cob .dae .dxf .enff .fbx .hmp .ifc "
     ".ifczip .iqm .irrmesh .lwo .lxo .md2 .md3 .md5mesh .mdc .mdl .mesh .ms3d .ndo .nff .ogex "
     ".pmx "
     ".q3o .q3s .scn .sib .smd .ter .x .x3d .x3db .xgl .zae .zgl ",
     NULL, otherwise}};

static int lower(int c) {
    return c >= 'A' && c <= 'Z' ? c + 'a' - 'A' : c;
}

void import_get_ending(const char *name, char ending[IMPORT_ENDING_SIZE]) {
    static const char packed[] = ".gz";
    size_t end = strlen(name), size = sizeof packed - 1, tail = 0;
    while (tail < size && tail < end && lower(name[end - 1 - tail]) == packed[size - 1 - tail]) {
        ++tail;
    }
    end -= tail == size ? size : 0;
    size_t first = end;
    while (first > 0 && name[first - 1] != '.' && name[first - 1] != '/') {
        --first;
    }
    size = first > 0 && name[first - 1] == '.' ? end - first : 0;
    size = size < IMPORT_ENDING_SIZE ? size : 0;
    for (size_t i = 0; i < size; ++i) {
        ending[i] = (char)lower(name[first + i]);
    }
    ending[size] = 0;
}

const import_program *import_find(const char *name) {
#ifndef _WIN32
    char ending[IMPORT_ENDING_SIZE], word[IMPORT_ENDING_SIZE + 4];
    import_get_ending(name, ending);
    if (!*ending || *name == ':') {
        return NULL;
    }
    snprintf(word, sizeof word, " .%s ", ending);
    for (int i = 0; i < burnish_format_count(); ++i) {
        const burnish_format_info *info = burnish_format_get_info((burnish_format)i);
        char own[64];
        snprintf(own, sizeof own, " %s ", info->endings);
        if (strstr(own, word)) {
            return NULL;
        }
    }
    for (size_t i = 0; i < sizeof importers / sizeof *importers; ++i) {
        if (strstr(importers[i].endings, word)) {
            return &importers[i];
        }
    }
#else
    (void)name, (void)importers;
#endif
    return NULL;
}

const char *import_format_word(const char *name, burnish_format format,
                               char ending[IMPORT_ENDING_SIZE]) {
    if (format == BURNISH_FORMAT_BMS && import_find(name)) {
        import_get_ending(name, ending);
        return ending;
    }
    return burnish_format_get_info(format)->name;
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

/* The end of a path that is too long for a message. */
static const char *shown(const char *name) {
    const size_t size = strlen(name);
    return size > 200 ? name + size - 200 : name;
}

burnish_status import_build(const import_program *importer, const char *name,
                            const import_stream *stream, const burnish_load_options *options,
                            burnish_file_loader companions, burnish_mesh **mesh,
                            burnish_error *error) {
    burnish_load_options handed = *options;
    char whole[256];
    *mesh = NULL;
    if (stream->is_short) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory for what %s makes",
                        shown(name), importer->name);
    }
    if (stream->size == 0) {
        return cli_fail(error, BURNISH_STATUS_FORMAT, "%.200s: %s ended without a mesh",
                        shown(name), importer->name);
    }
    snprintf(whole, sizeof whole, "%.200s: %s", shown(name), importer->name);
    handed.format = BURNISH_FORMAT_BMS;
    handed.max_input_bytes = UINT64_MAX; /* of the file that was imported */
    handed.companions = companions;
    return burnish_mesh_load_memory(stream->bytes, stream->size, whole, &handed, mesh, error);
}

int import_may_be_other(burnish_status status) {
    return status == BURNISH_STATUS_FORMAT;
}
