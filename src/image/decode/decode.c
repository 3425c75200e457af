#include "image/decode/decode.h"

#include <string.h>

#include "image/decode/sanitize.h"

typedef burnish_status decode_function(const burnish_encoded *from, burnish_memory *memory,
                                       burnish_image *picture);

/* Signatures: bytes at an offset. */
static const struct {
    size_t offset, size;
    uint8_t bytes[8];
    decode_function *decode;
} formats[] = {
    {0, 8, {137, 'P', 'N', 'G', 13, 10, 26, 10}, burnish_decode_png},
    {0, 3, {0xff, 0xd8, 0xff}, burnish_decode_jpeg},
    {8, 4, {'W', 'E', 'B', 'P'}, burnish_decode_webp},
    {0, 2, {'B', 'M'}, burnish_decode_bmp},
};

burnish_status burnish_decode_check(const burnish_encoded *from, uint64_t width, uint64_t height,
                                    const burnish_memory *memory) {
    const uint64_t side = (uint64_t)from->max_side;
    if (width > side || height > side) {
        return burnish_fail(memory->error, BURNISH_STATUS_LIMIT,
                            "%.200s: %llu x %llu pixels; pictures of up to %d x %d are read",
                            from->name, (unsigned long long)width, (unsigned long long)height,
                            from->max_side, from->max_side);
    }
    if (width < 1 || height < 1) {
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                            "%.200s: %llu x %llu pixels; it is damaged", from->name,
                            (unsigned long long)width, (unsigned long long)height);
    }
    if (width * height > from->max_pixels) {
        return burnish_fail(memory->error, BURNISH_STATUS_LIMIT,
                            "%.200s: %llu x %llu pixels, and %llu are left of the limit of all "
                            "textures; raise it, or make them smaller",
                            from->name, (unsigned long long)width, (unsigned long long)height,
                            (unsigned long long)from->max_pixels);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_decode_reserve(const burnish_encoded *from, uint64_t width, uint64_t height,
                                      int channels, burnish_memory *memory,
                                      burnish_image *picture) {
    const burnish_status status = burnish_decode_check(from, width, height, memory);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    uint8_t *pixels =
        burnish_allocate(memory, (size_t)(width * height), (size_t)channels, from->name);
    if (pixels) {
        *(from->decoded ? from->decoded : &(uint64_t){0}) += width * height;
        *picture = (burnish_image){(int)width, (int)height, channels, pixels,
                                   burnish_memory_owner(memory->context)};
    }
    return memory->status;
}

/* NULL: not a supported format. */
static decode_function *find_decoder(const uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        const size_t end = formats[i].offset + formats[i].size;
        if (size >= end &&
            memcmp(bytes + formats[i].offset, formats[i].bytes, formats[i].size) == 0) {
            return formats[i].decode;
        }
    }
    return burnish_is_tga(bytes, size) ? burnish_decode_tga : NULL;
}

/* Why an image of a common format is not decoded; NULL: it is another one. */
static const char *describe_undecoded(const uint8_t *bytes, size_t size) {
    return size >= 7 && memcmp(bytes, "\xabKTX 20", 7) == 0
               ? "KTX2 textures (Basis Universal) need a decoder that burnish does not have"
           : size >= 12 && memcmp(bytes + 4, "ftypavif", 8) == 0 ? "AVIF is not supported"
           : size >= 4 && memcmp(bytes, "DDS ", 4) == 0          ? "DDS is not supported"
                                                                 : NULL;
}

burnish_status burnish_decode(const burnish_encoded *from, burnish_memory *memory,
                              burnish_image *picture) {
    decode_function *decode = find_decoder(from->bytes, from->size);
    *picture = (burnish_image){0};
    if (!decode) {
        const char *what = describe_undecoded(from->bytes, from->size);
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT, "%.200s: %s; convert it to %s",
                            from->name,
                            what ? what : "neither PNG nor JPEG nor WebP nor BMP nor TGA",
                            what ? "PNG" : "one of them");
    }
    burnish_outside_begin();
    burnish_status status = decode(from, memory, picture);
    burnish_outside_end();
    if (status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, picture->pixels);
        *picture = (burnish_image){0};
    }
    return status;
}

burnish_status burnish_decode_floats(const burnish_encoded *from, burnish_memory *memory,
                                     const burnish_float_sink *sink) {
    static const uint8_t exr[4] = {0x76, 0x2f, 0x31, 0x01};
    if (from->size >= 2 && memcmp(from->bytes, "#?", 2) == 0) {
        return burnish_decode_hdr(from, memory, sink);
    }
    if (from->size < sizeof exr || memcmp(from->bytes, exr, sizeof exr) != 0) {
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                            "%.200s: neither Radiance HDR nor EXR; convert it to one of them",
                            from->name);
    }
    burnish_outside_begin();
    const burnish_status status = burnish_decode_exr(from, memory, sink);
    burnish_outside_end();
    return status;
}

burnish_status burnish_image_decode(const burnish_context *context, const void *bytes, size_t size,
                                    const char *name, burnish_image *image, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    if (!image || (!bytes && size > 0)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL; pass one",
                            image ? "bytes" : "image");
    }
    const burnish_encoded from = {.bytes = bytes,
                                  .size = size,
                                  .name = name ? name : "picture",
                                  .max_side = BURNISH_IMAGE_MAX_SIZE,
                                  .max_pixels = UINT64_MAX};
    return burnish_decode(&from, &memory, image);
}
