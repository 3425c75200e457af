/* Reads BMP (Microsoft, "Bitmap Storage"), the format of textures in older files: palettes of 1, 4
 * and 8 bits, and colours of 16, 24 and 32 bits, also with masks. Run-length encoding and embedded
 * JPEG are rejected; textures do not use them. Like TGA it needs no library. */
#include <string.h>

#include "base/bytes.h"
#include "image/decode/decode.h"

enum {
    FILE_HEADER = 14,
    CORE = 12, /* sizes of the second header, which identify its version */
    INFO = 40,
    WITH_ALPHA = 56,
    PLAIN = 0, /* compressions */
    MASKS = 3,
    ALPHA_MASKS = 6
};

typedef struct bmp {
    const uint8_t *bytes;
    size_t size, width, height, depth, stride, pixels_at; /* depth: bits of a pixel */
    int from_top;
    unsigned compression;
    uint32_t masks[4]; /* red, green, blue, alpha */
    const uint8_t *palette;
    size_t entries, entry_size;
} bmp;

/* Finds the bits of each channel in a pixel without a palette. */
static void find_masks(bmp *b, size_t header) {
    static const uint32_t of_16[3] = {0x7C00, 0x03E0, 0x001F},
                          of_32[3] = {0xFF0000, 0x00FF00, 0x0000FF};
    memcpy(b->masks, b->depth == 16 ? of_16 : of_32, sizeof of_16);
    if (b->compression != PLAIN) {
        for (size_t i = 0; i < 3; ++i) {
            b->masks[i] = burnish_load32(b->bytes + FILE_HEADER + INFO + 4 * i);
        }
        b->masks[3] =
            header >= WITH_ALPHA ? burnish_load32(b->bytes + FILE_HEADER + INFO + 12) : b->masks[3];
    }
}

/* NULL, or what is wrong with the file. */
static const char *read_header(const burnish_encoded *from, bmp *b) {
    static const char truncated[] = "the file ends before its pixels; it is truncated";
    const uint8_t *bytes = from->bytes;
    const size_t header =
        from->size >= FILE_HEADER + CORE ? burnish_load32(bytes + FILE_HEADER) : 0;
    const int is_core = header == CORE;
    *b = (bmp){.bytes = bytes, .size = from->size, .entry_size = is_core ? 3 : 4};
    if ((!is_core && header < INFO) || header > from->size - FILE_HEADER) {
        return truncated;
    }
    const uint8_t *at = bytes + FILE_HEADER + 4;
    const uint32_t height = is_core ? burnish_load16(at + 2) : burnish_load32(at + 4);
    b->from_top = (int)(height >> 31);
    b->width = is_core ? burnish_load16(at) : burnish_load32(at);
    b->height = b->from_top ? 0u - height : height;
    b->depth = burnish_load16(is_core ? at + 6 : at + 10);
    b->compression = is_core ? PLAIN : burnish_load32(at + 12);
    b->pixels_at = burnish_load32(bytes + 10);
    const int has_masks = b->compression == MASKS || b->compression == ALPHA_MASKS;
    const int is_wide = b->depth == 16 || b->depth == 32;
    if (!(is_wide || b->depth == 1 || b->depth == 4 || b->depth == 8 || b->depth == 24) ||
        (b->compression != PLAIN && !(has_masks && is_wide))) {
        return "a BMP with runs, or of an unknown kind; convert it to PNG";
    }
    if (b->width > INT32_MAX / 32 || b->height > INT32_MAX) {
        return "its header is damaged";
    }
    b->stride = (b->width * b->depth + 31) / 32 * 4;
    const size_t masks_end = INFO + 12, /* of a shorter header the masks follow it */
        masks_size = has_masks && header < masks_end ? masks_end - header : 0;
    const size_t palette_at = FILE_HEADER + header + masks_size;
    const size_t last_row = (b->width * b->depth + 7) / 8; /* whose padding may be missing */
    if (palette_at > b->size || b->pixels_at > b->size || b->height < 1 ||
        b->size - b->pixels_at < last_row ||
        (b->size - b->pixels_at - last_row) / (b->stride ? b->stride : 1) < b->height - 1) {
        return truncated;
    }
    if (b->depth <= 8) {
        const size_t room = (b->size - palette_at) / b->entry_size, all = (size_t)1 << b->depth;
        const size_t used = is_core ? 0 : burnish_load32(at + 28);
        b->entries = used > 0 && used < all ? used : all;
        b->entries = b->entries < room ? b->entries : room;
        b->palette = bytes + palette_at;
    } else {
        find_masks(b, header);
    }
    return NULL;
}

/* The bits under a mask, to 255. */
static uint8_t masked_byte(uint32_t pixel, uint32_t mask) {
    const uint32_t lowest = mask & (0u - mask);
    const uint64_t most = lowest ? mask / lowest : 0, value = lowest ? (pixel & mask) / lowest : 0;
    return (uint8_t)(most ? (value * 255 + most / 2) / most : 0);
}

static void write_pixel(const bmp *b, const uint8_t *row, size_t x, uint8_t rgba[4]) {
    rgba[3] = 255;
    if (b->depth <= 8) {
        const size_t bit = x * b->depth;
        const unsigned shift = (unsigned)(8 - b->depth - bit % 8);
        const size_t index = row[bit / 8] >> shift & ((1u << b->depth) - 1);
        const uint8_t *entry = b->palette + b->entry_size * index;
        for (size_t i = 0; i < 3; ++i) {
            rgba[i] = index < b->entries ? entry[2 - i] : 0;
        }
        return;
    }
    const uint8_t *at = row + x * (b->depth / 8);
    if (b->depth == 24) {
        rgba[0] = at[2];
        rgba[1] = at[1];
        rgba[2] = at[0];
        return;
    }
    const uint32_t pixel = b->depth == 16 ? burnish_load16(at) : burnish_load32(at);
    for (size_t i = 0; i < 3 + (size_t)(b->masks[3] != 0); ++i) {
        rgba[i] = masked_byte(pixel, b->masks[i]);
    }
}

burnish_status burnish_decode_bmp(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture) {
    bmp b;
    const char *wrong = read_header(from, &b);
    if (wrong) {
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT, "%.200s: %s", from->name, wrong);
    }
    const size_t channels = from->channels == 4 || b.masks[3] != 0 ? 4 : 3;
    burnish_status status =
        burnish_decode_reserve(from, b.width, b.height, (int)channels, memory, picture);
    for (size_t y = 0; y < b.height && status == BURNISH_STATUS_OK; ++y) {
        const uint8_t *row = b.bytes + b.pixels_at + b.stride * y;
        const size_t to = b.from_top ? y : b.height - 1 - y;
        for (size_t x = 0; x < b.width; ++x) {
            uint8_t rgba[4];
            write_pixel(&b, row, x, rgba);
            memcpy(picture->pixels + channels * (to * b.width + x), rgba, channels);
        }
    }
    return status;
}
