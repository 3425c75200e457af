/* Encodes JPEG. */
#ifndef TOOL_PICTURE_JPEG_H
#define TOOL_PICTURE_JPEG_H

#include "picture/formats.h"

/* As picture_encode; always fails if the build lacks libjpeg. */
burnish_status picture_encode_jpeg(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error);

#endif
