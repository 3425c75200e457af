/* A file that grows piece by piece: frames of a turntable, bands of a picture. */
#ifndef TOOL_RENDER_STREAM_H
#define TOOL_RENDER_STREAM_H

#include "render/output/report.h"

/* Makes the file's next bytes, valid until the next call: those of piece 0, 1, ..., at last those
 * that end the file, piece == count. */
typedef burnish_status render_stream_next(void *context, int piece, const uint8_t **bytes,
                                          size_t *size, burnish_error *error);

typedef struct render_stream {
    render_result *result;
    const char *noun; /* of a piece, for who waits at a terminal */
    int count;
    render_stream_next *next;
    void *context;
    burnish_file_check *ready; /* gets result, when the file is written */
} render_stream;

/* Writes settings->output. Errors: those of next, of ready and of writing, after which no file
 * appears. */
burnish_status render_stream_write(const render_stream *stream, burnish_error *error);

#endif
