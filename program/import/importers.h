/* Importers: separate programs that read formats unknown to burnish and write a mesh stream
 * (docs/importers.md). This header lists and finds them.
 *
 * An importer gets the open input as standard input, the file extension as its only argument, and a
 * pipe as standard output. Neither the importer nor its output is trusted. */
#ifndef TOOL_IMPORT_IMPORTERS_H
#define TOOL_IMPORT_IMPORTERS_H

#include "base/inputs.h"
#include "burnish/mesh.h"

typedef struct import_program {
    const char *name; /* "burnish-import-assimp" */
    const char *from; /* what to install, for a message */
    const char *
        extensions; /* lower-case extensions with a blank before and after each: " .fbx .dae "; "": none */
    const char *argument;  /* its argument; NULL: the input's extension */
    const char *otherwise; /* an alternative, for a message */
} import_program;

/* The extension of a name in lower case, without the dot and without a following ".gz": "fbx"; "":
 * none, or too long. */
enum { IMPORT_EXTENSION_SIZE = BURNISH_EXTENSION_SIZE };
void import_get_extension(const char *name, char extension[IMPORT_EXTENSION_SIZE]);

/* The importer of an extension in lower case; NULL: there is none. */
const import_program *import_of_extension(const char *extension);

/* The importer for a name's extension; NULL: burnish reads it itself, or it is unknown. */
const import_program *import_find(const char *name);

/* The importer for an input, by the format of --input-format (cli_foreign in cli/input.h) or, if
 * that is auto, by file extension. NULL: none. extension receives the importer's argument. */
const import_program *import_choose(const char *input, int format,
                                    char extension[IMPORT_EXTENSION_SIZE]);

/* The name of a mesh's format; for an imported file its extension, not the stream's format.
 *   requested  the value of --input-format */
const char *import_format_word(const char *name, int requested, const burnish_mesh_info *info,
                               char extension[IMPORT_EXTENSION_SIZE]);

/* An import_taker that keeps all bytes. Start from zeros; free(bytes) at the end. */
typedef struct import_stream {
    unsigned char *bytes;
    size_t size, capacity;
    int is_short; /* 1: out of memory */
} import_stream;
int import_keep(void *stream, const void *bytes, size_t size);

/* Reserves room for `size` bytes. Returns 0 if there is no memory. */
int import_expect(import_stream *stream, uint64_t size);

/* Builds the mesh of a stream. options->referenced_files loads referenced textures. */
burnish_status import_build(const import_program *importer, const char *name,
                            const import_stream *stream, const burnish_load_options *options,
                            burnish_mesh **mesh, burnish_error *error);

/* An input's name for messages. */
const char *import_shown(const char *path);

/* Whether burnish's own readers should try a file that an importer rejected. Extensions can be
 * wrong, but --input-format decides. */
int import_may_be_other(burnish_status status, int format);

/* ---- First bytes of files ---- */

/* Whether a file in a folder may be a mesh for an importer. Extensions with other uses (.ac, .mdl,
 * .x ...) need the signature of the mesh format, .dxf needs faces. */
int import_may_hold_mesh(const char *path);

/* Describes a file that is not a mesh, by its first bytes: it is empty, a Git LFS pointer or a web
 * page. NULL: it is none of these. */
const char *import_describe_other(const unsigned char *bytes, size_t size);

#endif
