/* Videos, encoded by an installed ffmpeg. */
#ifndef TOOL_PICTURE_VIDEO_H
#define TOOL_PICTURE_VIDEO_H

#include "burnish/core.h"

/* ARGUMENT if no ffmpeg is in the folders of PATH. `flag` and `path` name the output in the message. */
burnish_status picture_check_video(const char *flag, const char *path, burnish_error *error);

/* Encodes a stream of Y4M and writes the video as burnish_file_write_stream_checked does: the file
 * appears complete or not at all. ffmpeg gets the stream by a pipe and writes to an unnamed file.
 *   container  ffmpeg's name: "mp4", "webm"
 * Errors: WRITE (also if ffmpeg fails), MEMORY. */
burnish_status picture_write_video(const char *container, const char *path,
                                   burnish_file_source *source, void *context,
                                   burnish_file_check *ready, burnish_error *error);

#endif
