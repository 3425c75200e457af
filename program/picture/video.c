#include "picture/video.h"

#include "base/cli/options.h"

#ifdef _WIN32

burnish_status picture_check_video(const char *flag, const char *path, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: \"%.200s\": videos are not supported on this system; use --turntable=- "
                    "| ffmpeg -i - FILE",
                    flag, path);
}

burnish_status picture_write_video(const char *container, const char *path,
                                   burnish_file_source *source, void *context,
                                   burnish_file_check *ready, burnish_error *error) {
    (void)container, (void)source, (void)context, (void)ready;
    return picture_check_video("turntable", path, error);
}

#else

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cli/process.h"

enum { PIECE = 1 << 16 };

burnish_status picture_check_video(const char *flag, const char *path, burnish_error *error) {
    char file[CLI_PATH_SIZE];
    return cli_find_program("ffmpeg", file)
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: \"%.200s\": ffmpeg encodes videos and is not in "
                          "PATH; install it, or write .gif or .webp",
                          flag, path);
}

/* ffmpeg's descriptors: the pipe's end, the unnamed files of the video and of its messages. */
typedef struct encoder {
    pid_t process;
    int frames, video, messages;
} encoder;

/* In the new process. A width or height that is odd loses a row of pixels, since chroma has half the
 * resolution. */
static void become_ffmpeg(const char *file, const char *container) {
    char line[500];
    const char *arguments[40] = {NULL};
    size_t count = 0;
    snprintf(line, sizeof line,
             "ffmpeg -nostdin -loglevel error -f yuv4mpegpipe -i pipe:0 -vf "
             "crop=trunc(iw/2)*2:trunc(ih/2)*2 -crf 20 -b:v 0 -pix_fmt yuv420p -colorspace bt709 "
             "-color_primaries bt709 -color_trc iec61966-2-1 -color_range tv -metadata "
             "comment=burnish -movflags +faststart -f %s -y /dev/fd/1",
             container);
    for (char *word = strtok(line, " "); word; word = strtok(NULL, " ")) {
        arguments[count++] = word;
    }
    cli_execute(file, arguments);
}

static int ffmpeg_start(encoder *e, const char *container) {
    char file[CLI_PATH_SIZE];
    int ends[2] = {-1, -1};
    *e = (encoder){-1, -1, cli_unnamed_file(), cli_unnamed_file()};
    if (e->video < 0 || e->messages < 0 || !cli_find_program("ffmpeg", file) || pipe(ends) != 0) {
        return 0;
    }
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    e->process = cli_fork(
        &(cli_plan){.kept = {ends[0], e->video, e->messages}, .count = 3, .ended_by = SIGKILL});
    if (e->process == 0) {
        become_ffmpeg(file, container);
    }
    close(ends[0]);
    e->frames = ends[1];
    return e->process > 0;
}

/* Closes the pipe and waits. Returns 1 if ffmpeg has succeeded and written something. */
static int ffmpeg_finish(encoder *e) {
    if (e->frames >= 0) {
        close(e->frames);
    }
    const int state = e->process > 0 ? cli_wait(e->process) : -1;
    return WIFEXITED(state) && WEXITSTATUS(state) == 0 && lseek(e->video, 0, SEEK_END) > 0;
}

/* The first line of ffmpeg's messages. */
static burnish_status fail_ffmpeg(const encoder *e, const char *path, burnish_error *error) {
    char line[200];
    const ssize_t size = e->messages < 0 ? 0 : pread(e->messages, line, sizeof line - 1, 0);
    line[size > 0 ? size : 0] = 0;
    line[strcspn(line, "\r\n")] = 0;
    cli_clean(line);
    return cli_fail(error, BURNISH_STATUS_WRITE, "%.200s: ffmpeg failed%s%s; no file was written",
                    path, *line ? ": " : "", line);
}

/* The encoded video as the source of the file. */
typedef struct video {
    int file;
    burnish_file_check *ready; /* or NULL */
    void *context;
} video;

static size_t take_video(void *context, char *buffer, size_t size) {
    const ssize_t count = read(((const video *)context)->file, buffer, size);
    return count > 0 ? (size_t)count : 0;
}

static burnish_status check_video(void *context, burnish_error *error) {
    const video *v = context;
    return v->ready ? v->ready(v->context, error) : BURNISH_STATUS_OK;
}

burnish_status picture_write_video(const char *container, const char *path,
                                   burnish_file_source *source, void *context,
                                   burnish_file_check *ready, burnish_error *error) {
    static char piece[PIECE];
    encoder e;
    size_t size;
    int is_open = ffmpeg_start(&e, container);
    while (is_open && (size = source(context, piece, sizeof piece)) > 0) {
        is_open = cli_write_all(e.frames, piece, size);
    }
    burnish_status status;
    if (ffmpeg_finish(&e) && is_open) {
        video v = {e.video, ready, context};
        lseek(e.video, 0, SEEK_SET);
        status = burnish_file_write_stream(path, take_video, &v, check_video, error);
    } else {
        status = fail_ffmpeg(&e, path, error);
    }
    if (e.video >= 0) {
        close(e.video);
    }
    if (e.messages >= 0) {
        close(e.messages);
    }
    return status;
}

#endif
