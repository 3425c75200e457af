/* Files that pictures, planes of numbers and animations go into: which formats there are, and how
 * their bytes are made. Here and not in libburnish, so that who links that needs no libjpeg. */
#ifndef TOOL_PICTURE_PICTURE_H
#define TOOL_PICTURE_PICTURE_H

#include "burnish/image.h"
#include "cli/values.h"

typedef enum picture_format {
    PICTURE_AUTO, /* by the ending of the file's name */
    PICTURE_PNG,
    PICTURE_JPEG,
    PICTURE_WEBP,
    PICTURE_EXR,
    PICTURE_NPY,
    PICTURE_SVG, /* of lines: picture_encode does not make it */
    PICTURE_GIF,
    PICTURE_Y4M,
    PICTURE_COUNT
} picture_format;

/* What a file is for; a set of bits says what a format serves. */
typedef enum picture_use {
    PICTURE_STILL = 1,
    PICTURE_PLANE = 2, /* numbers per pixel */
    PICTURE_LINES = 4,
    PICTURE_ANIMATION = 8 /* PNG is APNG */
} picture_use;

/* What comes after the dot in names of that format: "jpg". */
const char *picture_ending(picture_format format);

/* "PNG, JPEG or WebP": the formats that serve one of these uses. */
typedef struct picture_names {
    char text[96];
} picture_names;
picture_names picture_list_names(int uses);

/* Whether a name ends as that of a picture or a video, burnish's own formats or others: never a
 * mesh. */
int picture_is_name(const char *path);

/* Finds the format of an output.
 *   flag    names the output in messages: "output"
 *   path    of the file; "-" is standard output
 *   use     a sum of picture_use
 *   wanted  a format whatever the name says, or PICTURE_AUTO: by the ending; still pictures whose
 *           name has none, or one that no format of pictures has, are PNG, animations on standard
 *           output Y4M
 * Errors: ARGUMENT for a format that does not serve the use, or that this build lacks. */
burnish_status picture_choose(const char *flag, const char *path, int use, picture_format wanted,
                              picture_format *format, burnish_error *error);

/* How a still picture is encoded. */
typedef struct picture_options {
    int threads;
    int quality;          /* [1, 100]; 0: JPEG 90, WebP without loss */
    double dots_per_inch; /* 0: none; PNG and JPEG hold it */
    int is_data;          /* 1: PNG does not say that the values are sRGB */
} picture_options;

enum { PICTURE_JPEG_QUALITY = 90 };

/* A file's bytes. Empty: {0}. */
typedef struct picture_file {
    uint8_t *bytes;
    size_t size;
    void (*release)(void *bytes); /* NULL: free */
} picture_file;
void picture_release(picture_file *file);

/* Encodes pixels as PNG, or RGB8 and RGBA8 as JPEG and WebP. Errors: ARGUMENT (alpha, a size or a
 * format that the file can't hold), MEMORY. */
burnish_status picture_encode(picture_format format, const burnish_pixels *pixels,
                              const picture_options *options, picture_file *file,
                              burnish_error *error);

/* The same for one format; picture_encode finds it. Those without their library always fail. */
burnish_status picture_encode_jpeg(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error);
burnish_status picture_encode_webp(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error);

/* ---- Numbers ---- */

typedef enum picture_kind { PICTURE_FLOAT, PICTURE_INT, PICTURE_BYTE } picture_kind;

/* height rows of width items of `channels` numbers, nothing between them. With one channel the
 * array has two axes, else three. */
typedef struct picture_array {
    picture_kind kind;
    int width, height, channels;
    const void *values;
} picture_array;

/* Errors: MEMORY. */
burnish_status picture_encode_npy(const picture_array *array, picture_file *file,
                                  burnish_error *error);

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
