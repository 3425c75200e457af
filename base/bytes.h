/* Little-endian numbers at any address, and text. */
#ifndef BURNISH_BASE_BYTES_H
#define BURNISH_BASE_BYTES_H

#include <stdint.h>
#include <string.h>

static inline uint32_t burnish_load16(const uint8_t *p) {
    return (uint32_t)p[0] | (uint32_t)p[1] << 8;
}
static inline uint32_t burnish_load24(const uint8_t *p) {
    return burnish_load16(p) | (uint32_t)p[2] << 16;
}
static inline uint32_t burnish_load32(const uint8_t *p) {
    return burnish_load16(p) | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}
static inline uint64_t burnish_load64(const uint8_t *p) {
    return burnish_load32(p) | (uint64_t)burnish_load32(p + 4) << 32;
}
static inline float burnish_load_float(const uint8_t *p) {
    const uint32_t bits = burnish_load32(p);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void burnish_store32(uint8_t *p, uint32_t value) {
    p[0] = (uint8_t)value;
    p[1] = (uint8_t)(value >> 8);
    p[2] = (uint8_t)(value >> 16);
    p[3] = (uint8_t)(value >> 24);
}

/* Whether bytes are text: without control characters but white space and DEL, which some names
 * have. */
static inline int burnish_are_text(const uint8_t *bytes, size_t size) {
    int are_text = 1;
    for (size_t i = 0; i < size; ++i) {
        are_text &= bytes[i] >= ' ' || (bytes[i] >= '\t' && bytes[i] <= '\r');
    }
    return are_text;
}

#endif
