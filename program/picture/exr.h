/* Encodes OpenEXR. */
#ifndef TOOL_PICTURE_EXR_H
#define TOOL_PICTURE_EXR_H

#include "picture/npy.h"

/* A channel of an OpenEXR file: FLOAT, or INT, which is written without its sign. */
typedef struct picture_channel {
    const char *name;
    picture_kind kind;
    const void *values;
    size_t step; /* bytes from one pixel to the next; rows follow each other */
} picture_channel;

enum { PICTURE_CHANNELS_MAX = 16 };

typedef struct picture_channels {
    int width, height, count;
    picture_channel items[PICTURE_CHANNELS_MAX]; /* all names differ */
} picture_channels;

/* Errors: MEMORY; ARGUMENT in a build without OpenEXR. */
burnish_status picture_encode_exr(const picture_channels *channels, picture_file *file,
                                  burnish_error *error);

#endif
