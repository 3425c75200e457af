/* The formats: extensions, uses, and whether this build supports them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "picture/formats.h"
#include "picture/jpeg.h"
#include "picture/video.h"
#include "picture/webp.h"

typedef struct format_row {
    const char *name, *extension, *other_extension;
    int uses;
    const char *library; /* a library that this build lacks; NULL: supported */
} format_row;

#define WITH(has, package) ((has) ? NULL : (package))

static const format_row rows[PICTURE_COUNT] = {
    [PICTURE_PNG] = {"PNG", "png", NULL, PICTURE_STILL | PICTURE_PLANE | PICTURE_ANIMATION, NULL},
    [PICTURE_JPEG] = {"JPEG", "jpg", "jpeg", PICTURE_STILL, WITH(BURNISH_HAS_JPEG, "libjpeg")},
    [PICTURE_WEBP] = {"WebP", "webp", NULL, PICTURE_STILL | PICTURE_ANIMATION,
                      WITH(BURNISH_HAS_WEBP, "libwebp")},
    [PICTURE_EXR] = {"EXR", "exr", NULL, PICTURE_STILL | PICTURE_PLANE,
                     WITH(BURNISH_HAS_EXR, "OpenEXR")},
    [PICTURE_NPY] = {"NPY", "npy", NULL, PICTURE_STILL | PICTURE_PLANE, NULL},
    [PICTURE_SVG] = {"SVG", "svg", NULL, PICTURE_LINES, NULL},
    [PICTURE_PDF] = {"PDF", "pdf", NULL, PICTURE_LINES, NULL},
    [PICTURE_GIF] = {"GIF", "gif", NULL, PICTURE_ANIMATION, NULL},
    [PICTURE_Y4M] = {"Y4M", "y4m", NULL, PICTURE_ANIMATION, NULL},
    [PICTURE_MP4] = {"MP4", "mp4", NULL, PICTURE_ANIMATION, NULL},
    [PICTURE_WEBM] = {"WebM", "webm", NULL, PICTURE_ANIMATION, NULL},
};

/* Extensions of other picture formats; a PNG with such a name would be misleading. The second list
 * has animations. */
static const char *const foreign[] = {"tif", "tiff", "bmp", "ppm", "pgm",  "pnm", "avif", "ico",
                                      "tga", "hdr",  "jxl", "eps", "heic", "jp2", "qoi"};
static const char *const moving[] = {"gif", "y4m", "apng", "mp4", "webm",
                                     "mov", "avi", "mkv",  "ogv"};

const char *picture_extension(picture_format format) {
    return rows[format].extension;
}

const char *picture_container(picture_format format) {
    return format == PICTURE_MP4 || format == PICTURE_WEBM ? rows[format].extension : NULL;
}

/* Lists names or extensions (with dots): "a", "a or b", "a, b or c". */
static void list(int use, int extensions, char *text, size_t size) {
    size_t used = 0;
    int left = 0;
    for (int i = 1; i < PICTURE_COUNT; ++i) {
        left += (rows[i].uses & use) != 0;
    }
    text[0] = 0;
    for (int i = 1; i < PICTURE_COUNT && used < size; ++i) {
        if (rows[i].uses & use) {
            --left;
            used += (size_t)snprintf(text + used, size - used, "%s%s%s", extensions ? "." : "",
                                     extensions ? rows[i].extension : rows[i].name,
                                     left > 1    ? ", "
                                     : left == 1 ? " or "
                                                 : "");
        }
    }
}

picture_names picture_list_names(int uses) {
    picture_names names;
    list(uses, 0, names.text, sizeof names.text);
    return names;
}

static int is_extension(const char *path, const char *const *extensions, size_t count) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; dot && i < count; ++i) {
        if (strcasecmp(dot + 1, extensions[i]) == 0) {
            return 1;
        }
    }
    return 0;
}

static burnish_status fail_format(const char *flag, const char *path, int use,
                                  burnish_error *error) {
    const char *what = use & PICTURE_STILL   ? "pictures are"
                       : use & PICTURE_PLANE ? "planes are"
                                             : "turntables are";
    char extensions[96];
    if ((use & PICTURE_LINES) && is_extension(path, moving, sizeof moving / sizeof *moving)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.200s\": only a turntable moves; write one with "
                        "--turntable=FILE, in %s",
                        flag, path, picture_list_names(PICTURE_ANIMATION).text);
    }
    if (use == PICTURE_ANIMATION && is_extension(path, moving, sizeof moving / sizeof *moving)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.200s\": turntables are written as %s; for other videos use "
                        "--turntable=- | ffmpeg -i - FILE",
                        flag, path, picture_list_names(use).text);
    }
    list(use, 1, extensions, sizeof extensions);
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: \"%.200s\": %s written as %s; end the name in %s", flag, path, what,
                    picture_list_names(use).text, extensions);
}

/* The format for a path's extension; AUTO: no known extension, COUNT: a format that burnish can't
 * write.
 */
static picture_format find_extension(const char *path) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    for (int i = 1; dot && i < PICTURE_COUNT; ++i) {
        if (strcasecmp(dot + 1, rows[i].extension) == 0 ||
            (rows[i].other_extension && strcasecmp(dot + 1, rows[i].other_extension) == 0)) {
            return (picture_format)i;
        }
    }
    return is_extension(path, foreign, sizeof foreign / sizeof *foreign) ||
                   is_extension(path, moving, sizeof moving / sizeof *moving)
               ? PICTURE_COUNT
               : PICTURE_AUTO;
}

int picture_is_name(const char *path) {
    return find_extension(path) != PICTURE_AUTO;
}

int picture_is_animation(const char *path) {
    return is_extension(path, moving, sizeof moving / sizeof *moving);
}

burnish_status picture_choose(const char *flag, const char *path, int use, picture_format wanted,
                              picture_format *format, burnish_error *error) {
    *format = wanted != PICTURE_AUTO ? wanted : find_extension(path);
    if (*format == PICTURE_AUTO && (use & PICTURE_STILL)) {
        *format = PICTURE_PNG;
    } else if (*format == PICTURE_AUTO && use == PICTURE_ANIMATION && strcmp(path, "-") == 0) {
        *format = PICTURE_Y4M;
    }
    if (*format == PICTURE_AUTO || *format == PICTURE_COUNT || !(rows[*format].uses & use)) {
        return fail_format(flag, path, use, error);
    }
    if (rows[*format].library) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.200s\": this build writes no %s, since it was made without %s; "
                        "write a PNG",
                        flag, path, rows[*format].name, rows[*format].library);
    }
    return picture_container(*format) ? picture_check_video(flag, path, error) : BURNISH_STATUS_OK;
}

void picture_release(picture_file *file) {
    (file->release ? file->release : free)(file->bytes);
    *file = (picture_file){0};
}

static void release_png(void *bytes) {
    burnish_release(NULL, bytes);
}

static burnish_status encode_png(const burnish_pixels *pixels, const picture_options *options,
                                 picture_file *file, burnish_error *error) {
    burnish_png_options png = burnish_png_options_default();
    png.threads = options->threads;
    png.dots_per_inch = options->dots_per_inch;
    png.is_data = options->is_data;
    file->release = release_png;
    return burnish_png_encode(pixels, &png, &file->bytes, &file->size, error);
}

burnish_status picture_encode(picture_format format, const burnish_pixels *pixels,
                              const picture_options *options, picture_file *file,
                              burnish_error *error) {
    *file = (picture_file){0};
    switch (format) {
    case PICTURE_JPEG:
        return picture_encode_jpeg(pixels, options, file, error);
    case PICTURE_WEBP:
        return picture_encode_webp(pixels, options, file, error);
    default:
        return encode_png(pixels, options, file, error);
    }
}
