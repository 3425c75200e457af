/* Decodes compressed streams with an importer. */
#ifndef TOOL_IMPORT_DECODE_H
#define TOOL_IMPORT_DECODE_H

#include "import/run.h"

/* A decoder for load options that runs burnish-import-draco. `name`, the input's, must outlive it. */
burnish_stream_decoder import_decoder(const char *name);

/* Replaces the function by which such decoders decode `bytes` into an empty stream. NULL: there are
 * no decoders. */
typedef burnish_status import_decode_function(const char *name, const void *bytes, size_t size,
                                              import_stream *stream, burnish_error *error);
void import_set_decode(import_decode_function *function);

/* Decodes bytes from a file. */
burnish_status import_decode(const char *name, int file, import_sink sink, burnish_error *error);

#endif
