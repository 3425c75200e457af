/* PNG (ISO/IEC 15948): 8-bit RGB and RGBA, one IDAT chunk, compressed by libdeflate. */
#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/output.h"
#include "burnish/image.h"

enum {
    SIGNATURE_SIZE = 8,
    CHUNK_FRAME = 12, /* length, type, CRC */
    IHDR_SIZE = 13,
    SRGB_SIZE = 1,
    IDAT_OFFSET = SIGNATURE_SIZE + CHUNK_FRAME + IHDR_SIZE + CHUNK_FRAME + SRGB_SIZE,
    FILTER_UP = 2,
    COMPRESSION_LEVEL = 1
};

static const size_t chunk_limit = 0x7fffffff; /* a PNG chunk's length is a 31-bit number */

static uint8_t *put_u32(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)(value >> 24);
    to[1] = (uint8_t)(value >> 16);
    to[2] = (uint8_t)(value >> 8);
    to[3] = (uint8_t)value;
    return to + 4;
}

/* Writes length, type and CRC around `size` bytes that stand at to + 8 already; returns the end. */
static uint8_t *put_chunk_frame(uint8_t *to, const char type[4], size_t size) {
    put_u32(to, (uint32_t)size);
    memcpy(to + 4, type, 4);
    return put_u32(to + 8 + size, libdeflate_crc32(0, to + 4, size + 4));
}

static uint8_t *put_header(uint8_t *to, const burnish_image *image) {
    static const uint8_t signature[SIGNATURE_SIZE] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    memcpy(to, signature, SIGNATURE_SIZE);
    to += SIGNATURE_SIZE;
    uint8_t *header = to + 8;
    header = put_u32(header, (uint32_t)image->width);
    header = put_u32(header, (uint32_t)image->height);
    *header++ = 8;                            /* bits a channel */
    *header++ = image->channels == 4 ? 6 : 2; /* RGBA, RGB */
    *header++ = 0;                            /* deflate */
    *header++ = 0;                            /* adaptive filtering */
    *header = 0;                              /* not interlaced */
    to = put_chunk_frame(to, "IHDR", IHDR_SIZE);
    to[8] = 0; /* rendering intent: perceptual */
    return put_chunk_frame(to, "sRGB", SRGB_SIZE);
}

/* Every row as its difference to the row above: of the filters, the one with the best ratio of size
 * to time for rendered pictures at libdeflate's fastest level. */
static void filter_rows(const burnish_image *image, uint8_t *restrict filtered) {
    size_t stride = (size_t)image->width * (size_t)image->channels;
    const uint8_t *row = image->pixels;
    filtered[0] = FILTER_UP;
    memcpy(filtered + 1, row, stride);
    for (int y = 1; y < image->height; ++y) {
        const uint8_t *above = row;
        row += stride;
        filtered += stride + 1;
        filtered[0] = FILTER_UP;
        for (size_t i = 0; i < stride; ++i) {
            filtered[1 + i] = (uint8_t)(row[i] - above[i]);
        }
    }
}

/* Header and compressed rows in *bytes; rows: the filtered rows. */
static burnish_status put_file(const burnish_image *image, const void *rows, size_t rows_size,
                               uint8_t **bytes, size_t *size, burnish_error *error) {
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(COMPRESSION_LEVEL);
    if (!compressor) {
        return burnish_fail(error, BURNISH_STATUS_MEMORY,
                            "out of memory: the PNG compressor; free memory");
    }
    /* rows_size is at most 2^30 + 2^14 and the bound adds less than 1/1000: no overflow. */
    size_t room = libdeflate_zlib_compress_bound(compressor, rows_size);
    size_t total = IDAT_OFFSET + CHUNK_FRAME + room + CHUNK_FRAME;
    uint8_t *file = malloc(total);
    if (!file) {
        libdeflate_free_compressor(compressor);
        return burnish_fail_memory(error, "the PNG file", total);
    }
    uint8_t *chunk = put_header(file, image);
    size_t packed = libdeflate_zlib_compress(compressor, rows, rows_size, chunk + 8, room);
    libdeflate_free_compressor(compressor);
    if (packed == 0 || packed > chunk_limit) {
        free(file);
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "PNG: %d x %d pixels do not fit one chunk; use a smaller image",
                            image->width, image->height);
    }
    chunk = put_chunk_frame(chunk, "IDAT", packed);
    chunk = put_chunk_frame(chunk, "IEND", 0);
    *size = (size_t)(chunk - file);
    uint8_t *shrunk = realloc(file, *size);
    *bytes = shrunk ? shrunk : file;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_image_encode_png(const burnish_image *image, uint8_t **bytes, size_t *size,
                                        burnish_error *error) {
    *bytes = NULL;
    *size = 0;
    if (!image || !image->pixels) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "PNG: the image is empty; create or render it first");
    }
    size_t row = (size_t)image->width * (size_t)image->channels + 1;
    void *rows;
    burnish_status status =
        burnish_allocate(&rows, (size_t)image->height, row, "the PNG's filtered rows", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    filter_rows(image, rows);
    status = put_file(image, rows, row * (size_t)image->height, bytes, size, error);
    free(rows);
    return status;
}

burnish_status burnish_image_write_png(const burnish_image *image, const char *path,
                                       burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    burnish_status status = burnish_image_encode_png(image, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_write_file(path, bytes, size, error);
        free(bytes);
    }
    return status;
}
