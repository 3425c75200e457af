/* Recognises meshes by signature if their extension has other uses. */
#include <stdio.h>
#include <string.h>

#include "import/importers.h"

enum { LOOKED_AT = 512 };

/* Signatures by extension; one of several rows has to match. */
static const struct {
    const char *extension, *first;
    size_t size; /* of `first`, where it holds a 0; else 0 */
} rows[] = {
    {"3ds", "MM", 0},  /* games of a console */
    {"ac", "AC3D", 0}, /* autoconf */
    {"ac3d", "AC3D", 0},
    {"acc", "AC3D", 0},
    {"ase", "*3DSMAX_ASCIIEXPORT", 0}, /* sprites, swatches of colours */
    {"ask", "*3DSMAX_ASCIIEXPORT", 0},
    {"b3d", "BB3D", 0},
    {"cob", "Caligari", 0}, /* COBOL */
    {"hmp", "HMP", 0},
    {"lwo", "FORM", 0},
    {"lxo", "FORM", 0},
    {"md2", "IDP2", 0},
    {"md3", "IDP3", 0},
    {"mdc", "IDPC", 0}, /* Markdown */
    {"mdl", "IDPO", 0}, /* Simulink; a game's sequences, which are in files of their own (IDSQ) */
    {"mdl", "IDST", 0},
    {"mdl", "MDL", 0},
    {"mesh", "\0\x10[MeshSerializer", 17}, /* Medit */
    {"mesh", "\x10\0[MeshSerializer", 17},
    {"ms3d", "MS3D", 0},
    {"ndo", "nendo", 0},
    {"off", NULL, 0},
    {"p21", "ISO-10303-21", 0},
    {"p21", "/*", 0},
    {"pmx", "PMX", 0},
    {"q3o", "quick3D", 0},
    {"q3s", "quick3D", 0},
    {"scn", "Caligari", 0}, /* Godot */
    {"smd", "version", 0},  /* games of a console */
    {"smd", "//", 0},
    {"ter", "TERRAGENTERRAIN", 0},
    {"x", "xof ", 0}, /* lex, RPC */
};

/* Skips a UTF-8 byte order mark and blanks. */
static size_t skip_blanks(const unsigned char *bytes, size_t size) {
    size_t at = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    while (at < size && (bytes[at] == ' ' || (bytes[at] >= '\t' && bytes[at] <= '\r'))) {
        ++at;
    }
    return at;
}

static int begins_with(const unsigned char *bytes, size_t size, const char *first,
                       size_t first_size) {
    const size_t length = first_size > 0 ? first_size : strlen(first);
    return size >= length && memcmp(bytes, first, length) == 0;
}

static int is_lfs_pointer(const unsigned char *bytes, size_t size) {
    return begins_with(bytes, size, "version https://git-lfs.github.com/spec/", 0);
}

/* Content that can't be judged here: gzip, UTF-16, a Git LFS pointer. */
static int is_wrapped(const unsigned char *bytes, size_t size) {
    return begins_with(bytes, size, "\x1F\x8B", 0) || begins_with(bytes, size, "\xFF\xFE", 0) ||
           begins_with(bytes, size, "\xFE\xFF", 0) || is_lfs_pointer(bytes, size);
}

const char *import_describe_other(const unsigned char *bytes, size_t size) {
    const size_t at = skip_blanks(bytes, size);
    const int is_page = begins_with(bytes + at, size - at, "<!DOCTYPE html", 0) ||
                        begins_with(bytes + at, size - at, "<html", 0);
    return size == 0 ? "the file is empty"
           : is_lfs_pointer(bytes, size)
               ? "a Git LFS pointer, not the file; fetch the file (git lfs pull)"
           : is_page ? "a web page, which contradicts its name; fetch or export it again"
                     : NULL;
}

/* Most .dxf files are line drawings. Looks for an entity with faces, on a line of its own. */
static int has_faces(const char *path) {
    char line[64];
    int is_start = 1, found = 0;
    FILE *file = fopen(path, "rb");
    while (file && !found && fgets(line, sizeof line, file)) {
        const size_t size = strcspn(line, "\r\n"), first = strspn(line, " \t");
        const char *word = line + first;
        found = is_start && ((size - first == 6 && memcmp(word, "3DFACE", 6) == 0) ||
                             (size - first == 8 && memcmp(word, "POLYLINE", 8) == 0) ||
                             is_wrapped((const unsigned char *)line, size));
        is_start = line[size] != 0; /* a longer line goes on */
    }
    if (file) {
        fclose(file);
    }
    return found || !file;
}

/* Whether text begins as OFF: configuration that is switched off ends in .off, too. */
static int begins_as_off(const unsigned char *bytes, size_t size) {
    size_t word = 0;
    while (word < size && bytes[word] > ' ') {
        ++word;
    }
    return word > 0 && (*bytes == '#' || (*bytes >= '0' && *bytes <= '9') ||
                        (word >= 3 && strncasecmp((const char *)bytes + word - 3, "off", 3) == 0));
}

int import_may_hold_mesh(const char *path) {
    unsigned char bytes[LOOKED_AT];
    char extension[IMPORT_EXTENSION_SIZE];
    size_t size = 0;
    int is_known = 0, fits = 0;
    import_get_extension(path, extension);
    if (strcmp(extension, "dxf") == 0) {
        return has_faces(path);
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows && !fits; ++i) {
        if (strcmp(rows[i].extension, extension) != 0) {
            continue;
        }
        if (!is_known) {
            FILE *file = fopen(path, "rb");
            if (!file) {
                return 1; /* drawing it reports the error */
            }
            size = fread(bytes, 1, sizeof bytes, file);
            fclose(file);
            if (is_wrapped(bytes, size)) {
                return 1;
            }
        }
        is_known = 1;
        const size_t at = skip_blanks(bytes, size);
        fits = !rows[i].first ? begins_as_off(bytes + at, size - at)
                              : begins_with(bytes, size, rows[i].first, rows[i].size) ||
                                    begins_with(bytes + at, size - at, rows[i].first, rows[i].size);
    }
    return fits || !is_known;
}
