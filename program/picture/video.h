/* Videos, encoded by an installed ffmpeg. */
#ifndef TOOL_PICTURE_VIDEO_H
#define TOOL_PICTURE_VIDEO_H

#include <stdint.h>

#include "burnish/core.h"

/* The Y4M stream of a turntable, in which only pixels are unknown. */
typedef struct picture_frames {
    char head[120];
    uint64_t head_size, frame_size; /* frame_size: with its marker */
    uint64_t total, next;           /* bytes of the stream; next: how many came */
} picture_frames;

picture_frames picture_expect_frames(int width, int height, int fps, int frames);

/* Takes the next bytes of the stream. Returns 0 if they are not what comes next in it. */
int picture_check_frames(picture_frames *frames, const void *bytes, size_t size);

/* ARGUMENT if no ffmpeg is in the folders of PATH. `flag` and `path` name the output in the message. */
burnish_status picture_check_video(const char *flag, const char *path, burnish_error *error);

/* Encodes a stream of Y4M and writes the video as burnish_file_write_stream does: the file
 * appears complete or not at all. ffmpeg gets the stream by a pipe and writes to an unnamed file.
 *   container  ffmpeg's name: "mp4", "webm"
 * Errors: WRITE (also if ffmpeg fails), MEMORY. */
burnish_status picture_write_video(const char *container, const char *path,
                                   burnish_file_source *source, void *context,
                                   burnish_file_check *ready, burnish_error *error);

#endif
