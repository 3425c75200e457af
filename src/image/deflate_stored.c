/* Deflate without compression (stored blocks of RFC 1951), for builds without ISA-L and zlib. */
#include <string.h>

#include "image/deflate.h"

enum { BLOCK_MAX = 65535, HEAD = 5, ADLER_MODULUS = 65521 };

static const uint32_t CRC_POLYNOMIAL = 0xEDB88320;

struct burnish_deflate {
    char unused;
};

burnish_deflate *burnish_deflate_create(burnish_memory *memory) {
    return burnish_allocate(memory, 1, sizeof(burnish_deflate), "the PNG's compressor");
}

void burnish_deflate_destroy(const burnish_context *context, burnish_deflate *deflate) {
    burnish_release(context, deflate);
}

size_t burnish_deflate_bound(size_t bytes) {
    return bytes + (bytes / BLOCK_MAX + 1) * HEAD;
}

size_t burnish_deflate_band(burnish_deflate *deflate, const uint8_t *bytes, size_t size, int last,
                            uint8_t *packed, size_t room) {
    (void)deflate;
    (void)room;
    uint8_t *to = packed;
    for (size_t left = size; left > 0;) {
        const size_t count = left < BLOCK_MAX ? left : BLOCK_MAX;
        *to++ = last && count == left;
        for (unsigned i = 0; i < 4; ++i) { /* the length, and its complement */
            *to++ = (uint8_t)((i < 2 ? count : ~count) >> 8 * (i % 2));
        }
        memcpy(to, bytes, count);
        to += count;
        bytes += count;
        left -= count;
    }
    return (size_t)(to - packed);
}

uint32_t burnish_deflate_crc32(const uint8_t *bytes, size_t size) {
    uint32_t table[16], crc = UINT32_MAX;
    for (uint32_t i = 0; i < 16; ++i) { /* what four bits add */
        table[i] = i;
        for (int bit = 0; bit < 4; ++bit) {
            table[i] = table[i] >> 1 ^ (table[i] & 1 ? CRC_POLYNOMIAL : 0);
        }
    }
    for (size_t i = 0; i < size; ++i) {
        crc ^= bytes[i];
        crc = crc >> 4 ^ table[crc & 15];
        crc = crc >> 4 ^ table[crc & 15];
    }
    return ~crc;
}

uint32_t burnish_deflate_adler32(const uint8_t *bytes, size_t size) {
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; ++i) {
        a = (a + bytes[i]) % ADLER_MODULUS;
        b = (b + a) % ADLER_MODULUS;
    }
    return b << 16 | a;
}
