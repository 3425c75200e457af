/* Encodes WebP. */
#ifndef TOOL_PICTURE_WEBP_H
#define TOOL_PICTURE_WEBP_H

#include "picture/formats.h"

/* As picture_encode; always fails if the build lacks libwebp. */
burnish_status picture_encode_webp(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error);

#endif
