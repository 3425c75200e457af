/* Streaming: files that are read piece by piece, straight into the arrays of the mesh. The file itself takes
 * no memory, and each piece stays in the second-level cache.
 *
 * Only the first bytes of such an input are in memory. A reader that finds anything unusual returns
 * an error or a warning, and the input is read again with all its bytes in memory, which gives the
 * mesh or the message. */
#ifndef BURNISH_MESH_READ_IO_STREAMING_H
#define BURNISH_MESH_READ_IO_STREAMING_H

#include "mesh/read/io/reader.h"

typedef struct burnish_streaming {
    int descriptor; /* of a regular file, from its beginning */
    size_t head;    /* bytes at its beginning that are in memory */
} burnish_streaming;

/* Bytes of the head; builds for sanitizers take fewer. */
#ifndef BURNISH_STREAMED_HEAD
#define BURNISH_STREAMED_HEAD 65536
#endif

/* Fails a streamed input, which must then be read whole. */
burnish_status burnish_stop_streaming(burnish_reader *reader);

/* How many of the input's bytes are in memory. */
size_t burnish_reader_head(const burnish_reader *reader);

/* Bytes of the input from an offset on: in memory, or read into the buffer. NULL: they can't be
 * read. */
const uint8_t *burnish_reader_peek(const burnish_reader *reader, size_t offset, size_t size,
                                   uint8_t *buffer);

/* Text of a streamed input: a window that moves over it. */
typedef struct burnish_window {
    const burnish_reader_input *input;
    uint8_t *bytes;
    size_t capacity;
    size_t offset, size; /* the part of the input that is there */
} burnish_window;

/* Moves the window's beginning to a byte in it or at its end, and fills it. Returns 0 if the
 * file can't be read. */
int burnish_window_move(burnish_window *window, size_t offset);

/* Handles rows [first, end); row `first` is at `rows`. */
typedef void burnish_rows_task(void *user_data, const uint8_t *rows, size_t first, size_t end);

/* Runs the task for `count` rows of row_size bytes each, some at a time, by all threads. They are
 * within the input.
 *
 * offset: of the first row, in bytes from the beginning of the input
 * Errors: MEMORY, CANCELLED; READ if the input is streamed and can't be read. */
burnish_status burnish_reader_rows(burnish_reader *reader, size_t offset, size_t row_size,
                                   size_t count, burnish_rows_task *task, void *user_data);

#endif
