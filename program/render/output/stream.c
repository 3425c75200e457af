#include "render/output/stream.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/cli/file.h"
#include "base/clock.h"
#include "picture/formats.h"
#include "picture/video.h"
#include "sandbox/worker.h"

/* The state of writing. */
typedef struct writer {
    const render_stream *stream;
    int piece; /* the next one */
    const uint8_t *bytes;
    size_t size, taken;
    int progress;
    burnish_status status;
    burnish_error error;
} writer;

static void next_piece(writer *w) {
    const render_stream *s = w->stream;
    if (w->progress && w->piece < s->count) {
        fprintf(stderr, "\rburnish: %s %d of %d\033[K", s->noun, w->piece + 1, s->count);
    }
    w->size = w->taken = 0;
    w->status = s->next(s->context, w->piece++, &w->bytes, &w->size, &w->error);
}

/* burnish_file_source */
static size_t take_bytes(void *context, char *buffer, size_t size) {
    writer *w = context;
    while (w->taken == w->size && w->status == BURNISH_STATUS_OK && w->piece <= w->stream->count) {
        next_piece(w);
    }
    if (w->status != BURNISH_STATUS_OK) {
        return 0;
    }
    const size_t left = w->size - w->taken, count = left < size ? left : size;
    if (count > 0) {
        memcpy(buffer, w->bytes + w->taken, count);
    }
    w->taken += count;
    return count;
}

/* burnish_file_check */
static burnish_status finish(void *context, burnish_error *error) {
    const writer *w = context;
    render_result *result = w->stream->result;
    if (w->status != BURNISH_STATUS_OK) {
        *error = w->error;
        return w->status;
    }
    result->encoded = burnish_seconds_now();
    result->written = 1;
    return w->stream->ready(result, error);
}

burnish_status render_stream_write(const render_stream *stream, burnish_error *error) {
    const render_settings *settings = stream->result->settings;
    writer w = {.stream = stream, .progress = !settings->job.quiet && isatty(STDERR_FILENO)};
    const char *path = render_output_path(&settings->output);
    const char *container = picture_container((picture_format)settings->output.format);
    burnish_status status =
        container && !sandbox_is_worker() /* the broker runs ffmpeg */
            ? picture_write_video(container, path, take_bytes, &w, finish, error)
            : cli_file_write_stream_checked(path, take_bytes, &w, finish, error);
    if (w.status != BURNISH_STATUS_OK) { /* ffmpeg complains about a stream that was cut off */
        *error = w.error;
        status = w.status;
    }
    if (w.progress) {
        fprintf(stderr, "\r\033[K");
    }
    return status;
}
