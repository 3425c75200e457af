#include "mesh/read/io/base64.h"

/* The six bits of a character of base64, either alphabet; 64: none. */
static unsigned sextet(uint8_t c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26u;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52u;
    }
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : 64;
}

size_t burnish_decode_base64(const uint8_t *text, size_t size, uint8_t *out) {
    size_t written = 0;
    uint32_t bits = 0;
    int held = 0;
    while (size > 0 && text[size - 1] == '=') {
        --size;
    }
    for (size_t i = 0; i < size; ++i) {
        const unsigned six = sextet(text[i]);
        if (six == 64) {
            return SIZE_MAX;
        }
        bits = bits << 6 | six;
        held += 6;
        if (held >= 8) {
            held -= 8;
            out[written++] = (uint8_t)(bits >> held);
        }
    }
    return written;
}
