/* Importers: separate programs that read formats unknown to burnish and write a mesh stream
 * (docs/importers.md). This header lists, finds and runs them.
 *
 * An importer gets the open input as standard input, the file extension as its only argument, and a
 * pipe as standard output. Neither the importer nor its output is trusted. */
#ifndef TOOL_IMPORT_IMPORT_H
#define TOOL_IMPORT_IMPORT_H

#include "burnish/mesh.h"

typedef struct import_program {
    const char *name; /* "burnish-import-assimp" */
    const char *from; /* how to get it, for a message */
    const char *
        endings; /* lower-case extensions with a blank before and after each: " .fbx .dae "; "": none */
    const char *argument;  /* its argument; NULL: the input's extension */
    const char *otherwise; /* an alternative, for a message */
} import_program;

/* The extension of a name in lower case, without the dot and without a following ".gz": "fbx"; "":
 * none, or too long. */
enum { IMPORT_ENDING_SIZE = 12 };
void import_get_ending(const char *name, char ending[IMPORT_ENDING_SIZE]);

/* The importer for a name's extension; NULL: burnish reads it itself, or it is unknown. */
const import_program *import_find(const char *name);

/* Whether a file in a folder may be a mesh for an importer. Extensions with other uses (.ac, .mdl,
 * .x ...) need the signature of the mesh format, .dxf needs faces. */
int import_may_hold_mesh(const char *path);

/* Describes a file that is not a mesh, by its first bytes: it is empty, a Git LFS pointer or a web
 * page. NULL: it is none of these. */
const char *import_describe_other(const unsigned char *bytes, size_t size);

/* The importer for an input, by the format of --input-format (cli_foreign in cli/input.h) or, if
 * that is auto, by file extension. NULL: none. ending receives the importer's argument. */
const import_program *import_choose(const char *input, int format, char ending[IMPORT_ENDING_SIZE]);

/* The name of a mesh's format; for an imported file its extension, not the stream's format.
 *   requested  the value of --input-format */
const char *import_format_word(const char *name, int requested, burnish_format format,
                               char ending[IMPORT_ENDING_SIZE]);

/* Whether the importer's program is installed. */
int import_is_installed(const import_program *importer);

/* Runs an importer on an open input.
 *   name   of the input, for messages
 *   ending the argument, unless the importer has a fixed one
 *   input  a descriptor, read from its start if it is seekable; it stays open
 *   max_bytes  a larger file is refused
 *   sink   receives the stream in pieces; take returns 0 to end the importer
 * On success the stream is complete, but not validated. It can have at most 64 MiB plus 256 times
 * the input's size. Limits of the importer: --max-memory (default: 4 GiB plus 64 times the input's
 * size) and --max-seconds, at least 300.
 * Errors: FORMAT (no such program, it crashed), LIMIT (time, bytes), MEMORY, READ. */
typedef int import_taker(void *context, const void *bytes, size_t size);
typedef struct import_sink {
    import_taker *take;
    void *context;
} import_sink;
burnish_status import_run(const import_program *importer, const char *name, const char *ending,
                          int input, uint64_t max_bytes, import_sink sink, burnish_error *error);

/* An import_taker that keeps all bytes. Start from zeros; free(bytes) at the end. */
typedef struct import_stream {
    unsigned char *bytes;
    size_t size, capacity;
    int is_short; /* 1: out of memory */
} import_stream;
int import_keep(void *stream, const void *bytes, size_t size);

/* Reserves room for `size` bytes. Returns 0 if there is no memory. */
int import_expect(import_stream *stream, uint64_t size);

/* Builds the mesh of a stream.
 *   companions  loads referenced textures */
burnish_status import_build(const import_program *importer, const char *name,
                            const import_stream *stream, const burnish_load_options *options,
                            burnish_file_loader companions, burnish_mesh **mesh,
                            burnish_error *error);

/* A decoder for load options that runs burnish-import-draco. `name`, the input's, must outlive it. */
burnish_stream_decoder import_decoder(const char *name);

/* Replaces the function by which such decoders decode `bytes` into an empty stream. */
typedef burnish_status import_decode_function(const char *name, const void *bytes, size_t size,
                                              import_stream *stream, burnish_error *error);
void import_set_decode(import_decode_function *function);

/* Decodes bytes from a file. */
burnish_status import_decode(const char *name, int file, import_sink sink, burnish_error *error);

/* Opens an input for import_run. Standard input ("-") is copied to an unnamed file if it is not a
 * file or was partly read. At most max_bytes and 1 GiB are copied, since a stream may be endless. Errors: READ, LIMIT, MEMORY. */
burnish_status import_open(const char *path, uint64_t max_bytes, int *input, burnish_error *error);

/* Runs import_run on `path`, or on its open descriptor `held`; -1: none. Standard input is not read
 * if the importer is not installed. */
burnish_status import_run_over(const import_program *importer, const char *ending, const char *path,
                               int held, uint64_t max_bytes, import_sink sink,
                               burnish_error *error);

/* An input's name for messages. */
const char *import_shown(const char *path);

/* A descriptor of an empty unnamed file; -1: failed. */
int import_unnamed_file(void);

/* As burnish_mesh_load, through the importer that import_choose returns for the path and
 * options->format, if any. */
burnish_status import_load(const char *path, const burnish_load_options *options,
                           burnish_mesh **mesh, burnish_error *error);

/* Whether burnish's own readers should try a file that an importer rejected. Extensions can be
 * wrong, but --input-format decides. */
int import_may_be_other(burnish_status status, int format);

#endif
