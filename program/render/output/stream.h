/* A file that is written piece by piece: frames of a turntable, bands of a picture. */
#ifndef TOOL_RENDER_STREAM_H
#define TOOL_RENDER_STREAM_H

#include "render/output/report.h"

/* Makes the bytes of piece 0, 1, ..., and of the end of the file, with piece == count. They are
 * valid until the next call. */
typedef burnish_status render_stream_next(void *context, int piece, const uint8_t **bytes,
                                          size_t *size, burnish_error *error);

typedef struct render_stream {
    render_result *result;
    const char *noun; /* of a piece, for progress on a terminal */
    int count;
    render_stream_next *next;
    void *context;
    burnish_file_check *ready; /* receives result when the file is written */
} render_stream;

/* Writes the output. Errors: as for next, ready and writing; no file appears then. */
burnish_status render_stream_write(const render_stream *stream, burnish_error *error);

#endif
