/* Importers: programs of their own which read formats that burnish does not, and write a mesh
 * stream (docs/importers.md). Here: which there are, where they lie, and how one is run.
 *
 * An importer gets the input as standard input, already open, the name's ending as its one
 * argument, and a pipe as standard output. It is not trusted, nor is what it writes. */
#ifndef TOOL_IMPORT_IMPORT_H
#define TOOL_IMPORT_IMPORT_H

#include "burnish/mesh.h"

typedef struct import_program {
    const char *name; /* "burnish-import-assimp" */
    const char *from; /* how to get it, for a message */
    const char
        *endings; /* lower case, with a blank before and after each: " .fbx .dae "; "": none */
    const char *argument;  /* what it is told; NULL: the ending of the input's name */
    const char *otherwise; /* what else helps, for a message */
} import_program;

/* What a name ends with, lower case, without the point and without ".gz" behind it: "fbx"; "":
 * nothing, or something too long. */
enum { IMPORT_ENDING_SIZE = 12 };
void import_get_ending(const char *name, char ending[IMPORT_ENDING_SIZE]);

/* The importer for a name's ending; NULL: readers of burnish know it, or nobody does. */
const import_program *import_find(const char *name);

/* Whether a file of a folder may be what its ending says to import_find: endings that other
 * programs use for other things (.ac, .mdl, .x ...) count where the file begins as their format
 * does, .dxf where it names faces. */
int import_may_hold_mesh(const char *path);

/* What to say of a file that no importer has to look at, by its first bytes: it is empty, a pointer
 * of Git LFS, or a web page. NULL: it is none of these. */
const char *import_describe_other(const unsigned char *bytes, size_t size);

/* The importer for an input: that of the cli_foreign (cli/input.h) which --input-format named,
 * else, of a file whose format is to be guessed, that of its name's ending. NULL: none. ending
 * receives what it is told */
const import_program *import_choose(const char *input, int format, char ending[IMPORT_ENDING_SIZE]);

/* What to call a mesh's format: of a file that an importer read its ending, and not that of the
 * stream between them.
 *   asked  what --input-format said */
const char *import_format_word(const char *name, int asked, burnish_format format,
                               char ending[IMPORT_ENDING_SIZE]);

/* Whether its program is there. */
int import_is_installed(const import_program *importer);

/* Runs it over an open input.
 *   name   of the input, for messages
 *   ending what it is told, if the program has no argument of its own
 *   input  a descriptor, which is read from its start where it has one, and stays open
 *   max_bytes  a larger file is refused
 *   take   gets the stream's bytes as they come; returns 0 to end the importer
 * The stream is complete on success, but nobody has looked at it. At most 64 MiB and 256 times as
 * many bytes as the input has are taken. The importer may use --max-memory, 4 GiB and 64 times the
 * input where that is not given, and --max-seconds, at least 300.
 * Errors: FORMAT (no such program, it crashed), LIMIT (time, bytes), MEMORY, READ. */
typedef int import_taker(void *context, const void *bytes, size_t size);
burnish_status import_run(const import_program *importer, const char *name, const char *ending,
                          int input, uint64_t max_bytes, import_taker *take, void *context,
                          burnish_error *error);

/* A taker that keeps them all: start from zeros, free(bytes) at the end. */
typedef struct import_stream {
    unsigned char *bytes;
    size_t size, capacity;
    int is_short; /* of memory */
} import_stream;
int import_keep(void *stream, const void *bytes, size_t size);

/* Makes room for as many bytes before the first are kept. Returns 0 if there is no memory. */
int import_expect(import_stream *stream, uint64_t size);

/* The mesh of a stream.
 *   companions  for the textures that it names */
burnish_status import_build(const import_program *importer, const char *name,
                            const import_stream *stream, const burnish_load_options *options,
                            burnish_file_loader companions, burnish_mesh **mesh,
                            burnish_error *error);

/* A decoder for load options, which runs burnish-import-draco. `name` is the input's, and has to
 * stay. */
burnish_stream_decoder import_decoder(const char *name);

/* What such decoders do from now on to have `bytes` decoded into an empty stream. */
typedef burnish_status import_decode_function(const char *name, const void *bytes, size_t size,
                                              import_stream *stream, burnish_error *error);
void import_set_decode(import_decode_function *function);

/* The same where the bytes are in a file. */
burnish_status import_decode(const char *name, int file, import_taker *take, void *context,
                             burnish_error *error);

/* An input for import_run: a file, or what standard input ("-") holds, copied to a file without a
 * name where it is none or has been read from. At most max_bytes are copied, and 1 GiB: a stream
 * need not end. Errors: READ, LIMIT, MEMORY. */
burnish_status import_open(const char *path, uint64_t max_bytes, int *input, burnish_error *error);

/* import_run over what `path` names, or over an open descriptor of it, held; -1: none. Standard
 * input is not read where the program is not there. */
burnish_status import_run_over(const import_program *importer, const char *ending, const char *path,
                               int held, uint64_t max_bytes, import_taker *take, void *context,
                               burnish_error *error);

/* What messages call an input. */
const char *import_shown(const char *path);

/* A descriptor of an empty file without a name; -1: there is none. */
int import_unnamed_file(void);

/* burnish_mesh_load, through an importer where import_choose has one for the path and
 * options->format. */
burnish_status import_load(const char *path, const burnish_load_options *options,
                           burnish_mesh **mesh, burnish_error *error);

/* Whether what an importer refused shall be tried by burnish's own readers: files are called
 * anything, unless --input-format says what they are. */
int import_may_be_other(burnish_status status, int format);

#endif
