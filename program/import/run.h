/* Runs importers. */
#ifndef TOOL_IMPORT_RUN_H
#define TOOL_IMPORT_RUN_H

#include "import/importers.h"

/* Whether the importer's program is installed; the error for the input `name` if it is not. */
int import_is_installed(const import_program *importer);
burnish_status import_check_installed(const import_program *importer, const char *name,
                                      burnish_error *error);

/* Receives bytes in pieces; take returns 0 to end the importer. */
typedef int import_taker(void *context, const void *bytes, size_t size);
typedef struct import_sink {
    import_taker *take;
    void *context;
} import_sink;

/* Runs an importer on an open input.
 *   name   of the input, for messages
 *   extension the argument, unless the importer has a fixed one
 *   input  a descriptor, read from its start if it is seekable; it stays open
 *   max_bytes  a larger file is refused
 *   sink   receives the stream
 * On success the stream is complete, but not validated. It can have at most 64 MiB plus 256 times
 * the input's size. Limits of the importer: --max-memory (default: 4 GiB plus 64 times the input's
 * size) and --max-seconds (default: 300), ten times as much in wall-clock time.
 * Errors: FORMAT (no such program, it crashed), LIMIT (time, bytes), MEMORY, READ. */
burnish_status import_run(const import_program *importer, const char *name, const char *extension,
                          int input, uint64_t max_bytes, import_sink sink, burnish_error *error);

/* ---- Compressed streams in glTF, and files of scenes (decoder.c) ---- */

/* Decodes `bytes` of an input into an empty stream. The form is one of burnish_stream_decoder. */
typedef burnish_status import_decode(const char *name, const char *form, const void *bytes,
                                     size_t size, import_stream *stream, burnish_error *error);

/* The same with an importer, from memory and from a file; and whether there is one. */
import_decode import_decode_bytes;
burnish_status import_decode_file(const char *name, const char *form, int file, import_sink sink,
                                  burnish_error *error);
int import_can_decode(const char *form);

/* A decoder for load options. *decoding must outlive it. */
typedef struct import_decoding {
    import_decode *decode; /* NULL: there is no decoder */
    const char *name;      /* of the input */
} import_decoding;
burnish_stream_decoder import_decoder(const import_decoding *decoding);

#endif
