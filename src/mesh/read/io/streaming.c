#include "mesh/read/io/streaming.h"

#include <errno.h>
#include <string.h>

#include "base/platform.h"

enum {
    PIECE = 4 * BURNISH_STREAMED_HEAD, /* bytes that are read at once, by each thread */
    GRAIN = BURNISH_STREAMED_HEAD / 8  /* rows that a thread takes at once if all are in memory */
};

size_t burnish_reader_head(const burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    return input->streamed ? input->streamed->head : input->size;
}

burnish_status burnish_stop_streaming(burnish_reader *reader) {
    return burnish_reader_fail(reader, BURNISH_STATUS_READ, NULL, "to be read whole");
}

/* Returns 0 if the file has become shorter or can't be read. */
static int read_at(int descriptor, size_t offset, uint8_t *bytes, size_t size) {
#if BURNISH_HAS_PREAD
    while (size > 0) {
        const ssize_t count = pread(descriptor, bytes, size, (off_t)offset);
        if (count == 0 || (count < 0 && errno != EINTR)) {
            return 0;
        }
        const size_t got = count > 0 ? (size_t)count : 0;
        bytes += got;
        offset += got;
        size -= got;
    }
    return 1;
#else
    (void)descriptor, (void)offset, (void)bytes, (void)size;
    return 0;
#endif
}

const uint8_t *burnish_reader_peek(const burnish_reader *reader, size_t offset, size_t size,
                                   uint8_t *buffer) {
    const burnish_streaming *streaming = reader->input->streamed;
    if (!streaming || offset + size <= streaming->head) {
        return reader->input->bytes + offset;
    }
    return read_at(streaming->descriptor, offset, buffer, size) ? buffer : NULL;
}

int burnish_window_move(burnish_window *window, size_t offset) {
    const size_t passed = offset - window->offset, kept = window->size - passed;
    const size_t left = window->input->size - offset;
    memmove(window->bytes, window->bytes + passed, kept);
    window->offset = offset;
    window->size = left < window->capacity ? left : window->capacity;
    return read_at(window->input->streamed->descriptor, offset + kept, window->bytes + kept,
                   window->size - kept);
}

/* Shared by the threads that read rows. */
typedef struct rows_context {
    const burnish_reader_input *input;
    size_t offset, row_size, count;
    size_t piece_rows, piece_size;
    uint8_t *buffers; /* one per thread */
    atomic_int failed;
    burnish_rows_task *task;
    void *user_data;
} rows_context;

static void take_rows(void *context, size_t first, size_t end) {
    const rows_context *c = context;
    c->task(c->user_data, c->input->bytes + c->offset + first * c->row_size, first, end);
}

static void take_piece(void *context, size_t index, int thread) {
    rows_context *c = context;
    const size_t first = index * c->piece_rows, left = c->count - first;
    const size_t count = left < c->piece_rows ? left : c->piece_rows;
    uint8_t *rows = c->buffers + (size_t)thread * c->piece_size;
    if (atomic_load_explicit(&c->failed, memory_order_relaxed)) {
        return;
    }
    if (read_at(c->input->streamed->descriptor, c->offset + first * c->row_size, rows,
                count * c->row_size)) {
        c->task(c->user_data, rows, first, first + count);
    } else {
        atomic_store(&c->failed, 1);
    }
}

static burnish_status read_rows(burnish_reader *reader, rows_context *c) {
    burnish_mesh_data *mesh = reader->mesh;
    const size_t threads = (size_t)burnish_tasks_threads(mesh->tasks);
    c->piece_rows = c->row_size < PIECE ? PIECE / c->row_size : 1;
    const size_t pieces = (c->count + c->piece_rows - 1) / c->piece_rows;
    c->piece_size = c->piece_rows * c->row_size;
    c->buffers = burnish_allocate(&mesh->memory, threads < pieces ? threads : pieces, c->piece_size,
                                  "a piece of the file");
    if (!c->buffers) {
        return mesh->memory.status;
    }
    burnish_tasks_run(mesh->tasks, pieces, 1, (int)(threads < pieces ? threads : pieces),
                      take_piece, c);
    burnish_release(mesh->memory.context, c->buffers);
    return atomic_load(&c->failed) ? burnish_stop_streaming(reader) : BURNISH_STATUS_OK;
}

burnish_status burnish_reader_rows(burnish_reader *reader, size_t offset, size_t row_size,
                                   size_t count, burnish_rows_task *task, void *user_data) {
    rows_context context = {.input = reader->input,
                            .offset = offset,
                            .row_size = row_size,
                            .count = count,
                            .task = task,
                            .user_data = user_data};
    burnish_status status = BURNISH_STATUS_OK;
    atomic_init(&context.failed, 0);
    if (reader->input->streamed && count > 0) {
        status = read_rows(reader, &context);
    } else {
        burnish_tasks_ranges(reader->mesh->tasks, count, GRAIN, take_rows, &context);
    }
    return status == BURNISH_STATUS_OK ? burnish_tasks_check(reader->mesh->tasks, reader->error)
                                       : status;
}
