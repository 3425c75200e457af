/* The formats: extensions, uses, and whether this build supports them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/cli/platform.h"
#include "cli/input.h"
#include "picture/formats.h"
#include "picture/video.h"

typedef struct format_row {
    const char *name, *extension, *other_extension;
    int uses;
    const char *library; /* a library that this build lacks; NULL: supported */
} format_row;

#define WITH(has, package) ((has) ? NULL : (package))

static const format_row rows[PICTURE_COUNT] = {
    [PICTURE_PNG] = {"PNG", "png", NULL, PICTURE_STILL | PICTURE_8_BIT | PICTURE_PLANE, NULL},
    [PICTURE_JPEG] = {"JPEG", "jpg", "jpeg", PICTURE_STILL | PICTURE_8_BIT,
                      WITH(BURNISH_HAS_JPEG, "libjpeg")},
    [PICTURE_WEBP] = {"WebP", "webp", NULL, PICTURE_STILL | PICTURE_8_BIT | PICTURE_ANIMATION,
                      WITH(BURNISH_HAS_WEBP, "libwebp")},
    [PICTURE_EXR] = {"EXR", "exr", NULL, PICTURE_STILL | PICTURE_PLANE,
                     WITH(BURNISH_HAS_EXR, "OpenEXR")},
    [PICTURE_NPY] = {"NPY", "npy", NULL, PICTURE_STILL | PICTURE_PLANE, NULL},
    [PICTURE_SVG] = {"SVG", "svg", NULL, PICTURE_LINES, NULL},
    [PICTURE_PDF] = {"PDF", "pdf", NULL, PICTURE_LINES, NULL},
    [PICTURE_GIF] = {"GIF", "gif", NULL, PICTURE_ANIMATION, NULL},
    [PICTURE_Y4M] = {"Y4M", "y4m", NULL, 0, NULL}, /* only for standard output and videos */
    [PICTURE_MP4] = {"MP4", "mp4", NULL, PICTURE_ANIMATION, NULL},
    [PICTURE_WEBM] = {"WebM", "webm", NULL, PICTURE_ANIMATION, NULL},
};

/* Extensions of other picture formats. The second list has animations. */
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
static void list_formats(int use, int extensions, char *text, size_t size) {
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

/* "PNG, JPEG or WebP": the formats for one of these uses. */
typedef struct format_names {
    char text[96];
} format_names;

static format_names list_names(int uses) {
    format_names names;
    list_formats(uses, 0, names.text, sizeof names.text);
    return names;
}

static int is_extension(const char *path, const char *const *extensions, size_t count) {
    const char *dot = strrchr(cli_base_name(path), '.');
    for (size_t i = 0; dot && i < count; ++i) {
        if (strcasecmp(dot + 1, extensions[i]) == 0) {
            return 1;
        }
    }
    return 0;
}

static burnish_status fail_format(const char *flag, const char *path, int use,
                                  burnish_error *error) {
    const char *what = use & (PICTURE_STILL | PICTURE_8_BIT) ? "pictures are"
                       : use & PICTURE_PLANE                 ? "planes are"
                                                             : "turntables are";
    char extensions[96];
    if ((use & PICTURE_LINES) && is_extension(path, moving, sizeof moving / sizeof *moving)) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--%s: \"%.200s\": only a turntable moves; write one with --turntable=FILE, in %s",
            flag, path, list_names(PICTURE_ANIMATION).text);
    }
    if (use == PICTURE_ANIMATION && is_extension(path, moving, sizeof moving / sizeof *moving)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.200s\": turntables are written as %s; for other videos use "
                        "--turntable=- | ffmpeg -i - FILE",
                        flag, path, list_names(use).text);
    }
    list_formats(use, 1, extensions, sizeof extensions);
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: \"%.200s\": %s written as %s; end the name in %s", flag, path, what,
                    list_names(use).text, extensions);
}

/* The format for a path's extension; AUTO: no extension, COUNT: one that burnish does not write. */
static picture_format find_extension(const char *path) {
    const char *base = cli_base_name(path), *dot = strrchr(base, '.');
    for (int i = 1; dot && i < PICTURE_COUNT; ++i) {
        if (rows[i].uses &&
            (strcasecmp(dot + 1, rows[i].extension) == 0 ||
             (rows[i].other_extension && strcasecmp(dot + 1, rows[i].other_extension) == 0))) {
            return (picture_format)i;
        }
    }
    return dot && dot > base && dot[1] ? PICTURE_COUNT : PICTURE_AUTO;
}

/* Whether a name has an extension of files that burnish writes. */
static int is_written_name(const char *path) {
    const picture_format format = find_extension(path);
    return format != PICTURE_AUTO && format != PICTURE_COUNT;
}

int picture_is_name(const char *path) {
    return is_written_name(path) || is_extension(path, foreign, sizeof foreign / sizeof *foreign) ||
           is_extension(path, moving, sizeof moving / sizeof *moving);
}

int picture_is_animation(const char *path) {
    return is_extension(path, moving, sizeof moving / sizeof *moving);
}

/* What begins a file, and names burnish as its writer near the beginning or at the end. */
typedef struct own_mark {
    const char *magic, *mark;
    size_t magic_size, mark_size;
} own_mark;

#define MARK(magic, mark)                                                                          \
    { magic, mark, sizeof(magic) - 1, sizeof(mark) - 1 }

static int has_bytes(const char *text, size_t size, const char *bytes, size_t count) {
    for (size_t i = 0; i + count <= size; ++i) {
        if (memcmp(text + i, bytes, count) == 0) {
            return 1;
        }
    }
    return 0;
}

/* 1 for a picture, drawing or video that burnish wrote. */
static int is_own_picture(const char *path) {
    static const own_mark marks[] = {
        MARK("\x89PNG", "tEXtSoftware\0burnish"),
        MARK("\xFF\xD8", "\xFF\xFE\0\x09"
                         "burnish"),
        MARK("v/1\x01", "software\0string\0\7\0\0\0burnish"),
        MARK("GIF89a", "\x21\xFE\x07"
                       "burnish"),
        MARK("\x93NUMPY", "{'shape': "), /* NumPy itself sorts the keys */
        MARK("RIFF", "\0\0burnish"),
        MARK("<svg xmlns", "<!-- burnish -->"),
        MARK("%PDF-1.4", "%burnish\n"),
        MARK("\0\0\0", "data\0\0\0\1\0\0\0\0burnish"), /* MP4 and WebM: comments */
        MARK("\x1A\x45\xDF\xA3", "\x44\x87\x87"
                                 "burnish"),
    };
    enum { TAIL = 64 };
    char bytes[8192 + TAIL];
    struct stat status;
    FILE *file = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    if (!file) {
        return 0;
    }
    size_t size = fread(bytes, 1, sizeof bytes - TAIL, file);
    if (fseek(file, -TAIL, SEEK_END) == 0) { /* WebP's Exif */
        size += fread(bytes + size, 1, TAIL, file);
    }
    int found = 0;
    fclose(file);
    for (size_t i = 0; i < sizeof marks / sizeof *marks && !found; ++i) {
        const own_mark *m = &marks[i];
        found = size >= m->magic_size && memcmp(bytes, m->magic, m->magic_size) == 0 &&
                has_bytes(bytes, size, m->mark, m->mark_size);
    }
    return found;
}

burnish_status picture_check_existing(const char *path, int is_derived, burnish_error *error) {
    struct stat status;
    const int is_there = is_derived ? cli_name_exists(path)
                                    : !is_written_name(path) && stat(path, &status) == 0 &&
                                          S_ISREG(status.st_mode) && status.st_size > 0;
    return is_there && !is_own_picture(path)
               ? cli_fail(
                     error, BURNISH_STATUS_ARGUMENT,
                     "%.200s: exists and was not written by burnish; %s", path,
                     is_derived
                         ? "replace it with --overwrite, or name the picture with --output=FILE"
                         : "delete it, or name another file")
               : BURNISH_STATUS_OK;
}

burnish_status picture_choose(const char *flag, const char *path, int use, picture_format wanted,
                              picture_format *format, burnish_error *error) {
    *format = wanted != PICTURE_AUTO && !cli_is_mesh_name(path) ? wanted : find_extension(path);
    if (*format == PICTURE_AUTO && (use & (PICTURE_STILL | PICTURE_8_BIT))) {
        *format = PICTURE_PNG;
    } else if (*format == PICTURE_AUTO && use == PICTURE_ANIMATION && strcmp(path, "-") == 0) {
        *format = PICTURE_Y4M;
        return BURNISH_STATUS_OK;
    }
    if (*format == PICTURE_AUTO || *format == PICTURE_COUNT || !(rows[*format].uses & use)) {
        return fail_format(flag, path, use, error);
    }
    if (rows[*format].library) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--%s: \"%.200s\": this build writes no %s, since it was made without %s; write a PNG",
            flag, path, rows[*format].name, rows[*format].library);
    }
    return picture_container(*format) ? picture_check_video(flag, path, error)
           : use == PICTURE_8_BIT     ? picture_check_existing(path, 0, error)
                                      : BURNISH_STATUS_OK;
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
