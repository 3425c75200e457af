/* JPEG through libjpeg-turbo. */
#include "image/decode/decode.h"

#if BURNISH_HAS_JPEG
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jpeglib.h>

#include <jerror.h>

#include "image/decode/sanitize.h"

enum {
    MOST_MEMORY = 256 << 20, /* of the library's own, for progressive files */
    /* A coded block of 64 coefficients takes 1 bit at least, in up to 64 progressive passes. */
    LARGEST_RATIO = 64 * 8 * 64,
    /* A scan may take a few bytes and goes over all pixels. Encoders write 10 or so; small pictures
     * may have more of them. */
    ENOUGH_SCANS = 16,
    MOST_SCANS = 500,
    SCANNED_PIXELS = 1 << 26
};

/* On an error the library ends the process, unless a callback jumps out of it. */
typedef struct jpeg_reader {
    struct jpeg_error_mgr manager;
    struct jpeg_progress_mgr progress;
    jmp_buf place;
    int most_scans;
    char reason[JMSG_LENGTH_MAX];
} jpeg_reader;

static void jpeg_fail(j_common_ptr codec) {
    jpeg_reader *reader = (jpeg_reader *)codec->err;
    codec->err->format_message(codec, reader->reason);
    longjmp(reader->place, 1);
}

static void pass_over(j_common_ptr codec, int level) {
    (void)codec, (void)level;
}

/* Called from time to time: rejects files with too many scans. */
static void jpeg_watch(j_common_ptr codec) {
    jpeg_reader *reader = (jpeg_reader *)codec->err;
    if (codec->is_decompressor &&
        ((j_decompress_ptr)codec)->input_scan_number > reader->most_scans) {
        reader->manager.msg_code = 0;
        snprintf(reader->reason, sizeof reader->reason, "more than %d scans", reader->most_scans);
        longjmp(reader->place, 1);
    }
}

static int most_scans(uint64_t pixels) {
    const uint64_t scans = SCANNED_PIXELS / (pixels + 1);
    return scans < ENOUGH_SCANS ? ENOUGH_SCANS : scans > MOST_SCANS ? MOST_SCANS : (int)scans;
}

/* Converts CMYK, mostly Adobe's inverted form, to the printed colour. */
static void print_row(const JSAMPLE *from, int channels, int width, uint8_t *to) {
    for (int x = 0; x < width; ++x, from += 4, to += channels) {
        for (int k = 0; k < 3; ++k) {
            to[k] = (uint8_t)(from[k] * from[3] / 255);
        }
        if (channels == 4) {
            to[3] = 255;
        }
    }
}

static burnish_status fail_codec(j_decompress_ptr codec, const burnish_encoded *from,
                                 burnish_memory *memory) {
    const jpeg_reader *reader = (const jpeg_reader *)codec->err;
    switch (reader->manager.msg_code) {
    case JERR_OUT_OF_MEMORY:
        return burnish_fail(memory->error, BURNISH_STATUS_MEMORY,
                            "%.200s: out of memory; free memory or use a smaller picture",
                            from->name);
    case JERR_NO_BACKING_STORE: /* the library's error beyond MOST_MEMORY */
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                            "%.200s: a progressive JPEG of %u x %u pixels needs more than %d MiB; "
                            "save it as a baseline one, or smaller",
                            from->name, codec->image_width, codec->image_height, MOST_MEMORY >> 20);
    default:
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT, "%.200s: no sound JPEG: %.200s",
                            from->name, reader->reason);
    }
}

static burnish_status jpeg_decode(j_decompress_ptr codec, const burnish_encoded *from,
                                  burnish_memory *memory, burnish_image *picture, uint8_t **line) {
    jpeg_reader *reader = (jpeg_reader *)codec->err;
    if (setjmp(reader->place)) {
        return fail_codec(codec, from, memory);
    }
    codec->mem->max_memory_to_use = MOST_MEMORY;
    codec->progress = &reader->progress;
    jpeg_mem_src(codec, from->bytes, (unsigned long)from->size);
    jpeg_read_header(codec, TRUE);
    const uint64_t pixels = (uint64_t)codec->image_width * codec->image_height;
    reader->most_scans = most_scans(pixels);
    if (pixels / LARGEST_RATIO > from->size) {
        return burnish_fail(
            memory->error, BURNISH_STATUS_FORMAT,
            "%.200s: %u x %u pixels can't be in a JPEG of %zu bytes; it is cut off or damaged",
            from->name, codec->image_width, codec->image_height, from->size);
    }
    const int is_cmyk = codec->jpeg_color_space == JCS_CMYK || codec->jpeg_color_space == JCS_YCCK;
    codec->out_color_space = is_cmyk               ? JCS_CMYK
                             : from->channels == 4 ? JCS_EXT_RGBA /* alpha is 255 */
                                                   : JCS_RGB;
    codec->dct_method = JDCT_ISLOW; /* the exact one: the same pixels everywhere */
    burnish_status status = burnish_decode_reserve(from, codec->image_width, codec->image_height,
                                                   from->channels == 4 ? 4 : 3, memory, picture);
    *line = burnish_allocate(memory, codec->image_width, 4, from->name);
    if (status != BURNISH_STATUS_OK || !*line) {
        return status == BURNISH_STATUS_OK ? memory->status : status;
    }
    jpeg_start_decompress(codec);
    const size_t row_size = (size_t)picture->width * (size_t)picture->channels;
    while (codec->output_scanline < codec->output_height) {
        uint8_t *row = picture->pixels + row_size * codec->output_scanline;
        JSAMPROW lines = is_cmyk ? *line : row;
        jpeg_read_scanlines(codec, &lines, 1);
        burnish_written_outside(lines, is_cmyk ? (size_t)picture->width * 4 : row_size);
        if (is_cmyk) {
            print_row(*line, picture->channels, picture->width, row);
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_decode_jpeg(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture) {
    struct jpeg_decompress_struct codec;
    jpeg_reader reader;
    uint8_t *line = NULL;
    memset(&codec, 0, sizeof codec);
    memset(&reader, 0, sizeof reader);
    codec.err = jpeg_std_error(&reader.manager);
    reader.manager.error_exit = jpeg_fail;
    reader.manager.emit_message = pass_over;
    reader.progress.progress_monitor = jpeg_watch;
    reader.most_scans = MOST_SCANS;
    if (setjmp(reader.place)) {
        jpeg_destroy_decompress(&codec);
        return fail_codec(&codec, from, memory);
    }
    jpeg_create_decompress(&codec);
    const burnish_status status = jpeg_decode(&codec, from, memory, picture, &line);
    jpeg_destroy_decompress(&codec);
    burnish_release(memory->context, line);
    return status;
}

#else

burnish_status burnish_decode_jpeg(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture) {
    (void)picture;
    return burnish_fail(memory->error, BURNISH_STATUS_ARGUMENT,
                        "%.200s: this burnish reads no JPEG: it was built without libjpeg",
                        from->name);
}

#endif
