/* File formats of pictures, planes and animations, and their encoders. They are not in libburnish,
 * so its users do not need libjpeg. */
#ifndef TOOL_PICTURE_FORMATS_H
#define TOOL_PICTURE_FORMATS_H

#include "base/cli/values.h"
#include "burnish/image.h"

typedef enum picture_format {
    PICTURE_AUTO, /* by file extension */
    PICTURE_PNG,
    PICTURE_JPEG,
    PICTURE_WEBP,
    PICTURE_EXR,
    PICTURE_NPY,
    PICTURE_SVG, /* line drawings; not written by picture_encode */
    PICTURE_PDF,
    PICTURE_GIF,
    PICTURE_Y4M, /* frames on standard output, for other encoders */
    PICTURE_MP4, /* Y4M that ffmpeg encodes */
    PICTURE_WEBM,
    PICTURE_COUNT
} picture_format;

/* Uses of a file, as bits. */
typedef enum picture_use {
    PICTURE_STILL = 1,
    PICTURE_PLANE = 2, /* numbers per pixel */
    PICTURE_LINES = 4,
    PICTURE_ANIMATION = 8,
    PICTURE_8_BIT = 16,   /* what picture_encode writes */
    PICTURE_REPLACES = 32 /* with PICTURE_8_BIT: any file (--overwrite) */
} picture_use;

/* 1: lines and areas, written from a burnish_drawing. */
static inline int picture_is_drawing(picture_format format) {
    return format == PICTURE_SVG || format == PICTURE_PDF;
}

/* The file extension of a format, without the dot: "jpg". */
const char *picture_extension(picture_format format);

/* The container of a video, for picture_write_video(): "mp4"; NULL for other formats. */
const char *picture_container(picture_format format);

/* Whether a name has an extension of pictures or videos, known to burnish or not, so it is not a
 * mesh. */
int picture_is_name(const char *path);

/* Whether it has an extension of videos and other moving pictures. */
int picture_is_animation(const char *path);

/* Finds the format of an output.
 *   flag    names the output in messages: "output"
 *   path    of the file; "-" is standard output
 *   use     a sum of picture_use
 *   wanted  a format, or PICTURE_AUTO: by file extension. Still pictures without an extension are
 *           PNG, animations on standard output Y4M
 * Errors: ARGUMENT for an extension of other files, meshes always included, for a format that does
 * not serve the use, or that this build lacks, and for a video without ffmpeg. */
burnish_status picture_choose(const char *flag, const char *path, int use, picture_format wanted,
                              picture_format *format, burnish_error *error);

/* ARGUMENT if a picture would replace a file that may not be one: only pictures of burnish and empty
 * files are replaced. With is_derived, for names that nobody typed, the extension proves nothing,
 * since the file can be a texture; otherwise a file with an extension of burnish's formats is
 * replaced. */
burnish_status picture_check_existing(const char *path, int is_derived, burnish_error *error);

/* How a still picture is encoded. */
typedef struct picture_options {
    int threads;
    int quality;          /* [1, 100]; 0: JPEG 90, WebP without loss */
    double dots_per_inch; /* 0: none; PNG and JPEG hold it */
    int is_data;          /* 1: PNG without an sRGB chunk */
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

/* As picture_encode; always fails if the build lacks libjpeg. */
burnish_status picture_encode_jpeg(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error);

/* As picture_encode; always fails if the build lacks libwebp. */
burnish_status picture_encode_webp(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error);

#endif
