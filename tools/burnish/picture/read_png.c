/* PNG through libpng's row interface: the simplified one converts 16 bits by the file's gamma. */
#include "picture/read_png.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

int picture_is_png(const uint8_t *bytes, size_t size) {
    static const uint8_t signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    return size >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

/* ---- Files ---- */

/* Appends what the stream still has. */
static burnish_status read_stream(const char *path, FILE *file, uint64_t max_bytes, uint8_t **bytes,
                                  size_t *size, burnish_error *error) {
    size_t capacity = 0;
    for (;;) {
        if (*size == capacity) {
            capacity = capacity ? 2 * capacity : 1 << 16;
            uint8_t *grown = capacity > *size ? realloc(*bytes, capacity) : NULL;
            if (!grown) {
                return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory for the file",
                                path);
            }
            *bytes = grown;
        }
        const size_t count = fread(*bytes + *size, 1, capacity - *size, file);
        *size += count;
        if (*size > max_bytes) {
            return cli_fail(error, BURNISH_STATUS_LIMIT,
                            "%.200s: larger than %llu bytes; raise --max-input-bytes", path,
                            (unsigned long long)max_bytes);
        }
        if (ferror(file)) {
            return cli_fail(error, BURNISH_STATUS_READ, "%.200s: can't be read: %s", path,
                            strerror(errno));
        }
        if (count == 0) {
            return BURNISH_STATUS_OK;
        }
    }
}

burnish_status picture_read_bytes(const char *path, uint64_t max_bytes, uint8_t **bytes,
                                  size_t *size, burnish_error *error) {
    const int standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    *bytes = NULL;
    *size = 0;
    if (!file) {
        return cli_fail(error, BURNISH_STATUS_READ, "%.200s: can't be opened: %s", path,
                        strerror(errno));
    }
    const burnish_status status =
        read_stream(standard ? "standard input" : path, file, max_bytes, bytes, size, error);
    if (!standard) {
        fclose(file);
    }
    if (status != BURNISH_STATUS_OK) {
        free(*bytes);
        *bytes = NULL;
        *size = 0;
    }
    return status;
}

burnish_status picture_read_png(const char *path, uint64_t max_bytes, burnish_image *image,
                                burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    *image = (burnish_image){0};
    burnish_status status = picture_read_bytes(path, max_bytes, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK) {
        status = picture_decode_png(path, bytes, size, image, error);
    }
    free(bytes);
    return status;
}

/* ---- Decoding ---- */

#if BURNISH_HAS_PNG
#include <png.h>

enum {
    MOST_CHUNK_BYTES = 8 << 20, /* of one chunk that libpng keeps: profiles, texts */
    MOST_CHUNKS = 1000,         /* of those */
    LARGEST_RATIO = 1032        /* deflate's: what a byte can at most become */
};

/* What libpng's functions are handed. */
typedef struct decoder {
    png_structp png;
    png_infop info;
    const uint8_t *bytes;
    size_t size, next;
    char reason[120]; /* libpng's */
} decoder;

static void take(png_structp png, png_bytep to, size_t count) {
    decoder *d = png_get_io_ptr(png);
    if (count > d->size - d->next) {
        png_error(png, "the file ends too early");
    }
    memcpy(to, d->bytes + d->next, count);
    d->next += count;
}

static void fail(png_structp png, png_const_charp reason) {
    decoder *d = png_get_error_ptr(png);
    snprintf(d->reason, sizeof d->reason, "%s", reason);
    png_longjmp(png, 1);
}

static void pass_over(png_structp png, png_const_charp reason) {
    (void)png, (void)reason;
}

/* Everything as 8 bits of RGB or RGBA. Returns the channels. */
static int ask_for_codes(decoder *d) {
    png_set_expand(d->png);
    png_set_scale_16(d->png);
    png_set_gray_to_rgb(d->png);
    png_set_interlace_handling(d->png);
    png_read_update_info(d->png, d->info);
    return png_get_channels(d->png, d->info);
}

/* Rows are never more than the file can hold, so that a small file can't ask for much memory. */
static burnish_status make_image(const char *name, decoder *d, burnish_image *image,
                                 burnish_error *error) {
    const uint64_t width = png_get_image_width(d->png, d->info);
    const uint64_t height = png_get_image_height(d->png, d->info);
    if (width > BURNISH_IMAGE_MAX_SIZE || height > BURNISH_IMAGE_MAX_SIZE) {
        return cli_fail(error, BURNISH_STATUS_LIMIT,
                        "%.200s: %llu x %llu pixels; pictures of up to %d x %d are read", name,
                        (unsigned long long)width, (unsigned long long)height,
                        BURNISH_IMAGE_MAX_SIZE, BURNISH_IMAGE_MAX_SIZE);
    }
    if (png_get_rowbytes(d->png, d->info) * height / LARGEST_RATIO > d->size) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "%.200s: %llu x %llu pixels can't be in a PNG of %zu bytes; it is cut off "
                        "or damaged",
                        name, (unsigned long long)width, (unsigned long long)height, d->size);
    }
    return burnish_image_create(image, (int)width, (int)height, ask_for_codes(d), error);
}

static burnish_status decode(const char *name, decoder *d, burnish_image *image, png_bytepp *rows,
                             burnish_error *error) {
    if (setjmp(png_jmpbuf(d->png))) {
        return cli_fail(error, BURNISH_STATUS_FORMAT, "%.200s: no sound PNG: %s", name, d->reason);
    }
    png_set_read_fn(d->png, d, take);
    png_set_user_limits(d->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* ours say it in our words */
    png_set_chunk_malloc_max(d->png, MOST_CHUNK_BYTES);
    png_set_chunk_cache_max(d->png, MOST_CHUNKS);
    png_set_crc_action(d->png, PNG_CRC_ERROR_QUIT, PNG_CRC_WARN_DISCARD);
    png_read_info(d->png, d->info);
    burnish_status status = make_image(name, d, image, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *rows = malloc((size_t)image->height * sizeof **rows);
    if (!*rows) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory for its rows", name);
    }
    for (int y = 0; y < image->height; ++y) {
        (*rows)[y] = image->pixels + (size_t)y * (size_t)image->width * (size_t)image->channels;
    }
    png_read_image(d->png, *rows);
    png_read_end(d->png, NULL);
    return BURNISH_STATUS_OK;
}

burnish_status picture_decode_png(const char *name, const uint8_t *bytes, size_t size,
                                  burnish_image *image, burnish_error *error) {
    decoder d = {.bytes = bytes, .size = size};
    png_bytepp rows = NULL;
    *image = (burnish_image){0};
    if (!picture_is_png(bytes, size)) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "%.200s: not a PNG file; convert the picture to PNG", name);
    }
    d.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &d, fail, pass_over);
    d.info = d.png ? png_create_info_struct(d.png) : NULL;
    burnish_status status =
        d.info ? decode(name, &d, image, &rows, error)
               : cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory", name);
    png_destroy_read_struct(&d.png, &d.info, NULL);
    free(rows);
    if (status != BURNISH_STATUS_OK) {
        burnish_image_destroy(image);
    }
    return status;
}

#else

burnish_status picture_decode_png(const char *name, const uint8_t *bytes, size_t size,
                                  burnish_image *image, burnish_error *error) {
    (void)bytes, (void)size;
    *image = (burnish_image){0};
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "%.200s: this burnish reads no pictures: it was built without libpng; compare "
                    "meshes, or build it with libpng",
                    name);
}

#endif
