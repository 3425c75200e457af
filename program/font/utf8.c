/* UTF-8, as Unicode defines it. */
#include "font/font.h"

#include <string.h>

size_t utf8_decode(const char *text, size_t length, uint32_t *code) {
    static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000}; /* of a form so long */
    const unsigned char *bytes = (const unsigned char *)text;
    const unsigned char first = length > 0 ? bytes[0] : 0x80;
    if (first < 0x80) {
        *code = first;
        return 1;
    }
    const size_t count = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC0 || first > 0xF7 || length < count) {
        return 0;
    }
    uint32_t value = first & (0x7Fu >> count);
    for (size_t i = 1; i < count; ++i) {
        if ((bytes[i] & 0xC0) != 0x80) {
            return 0;
        }
        value = value << 6 | (bytes[i] & 0x3Fu);
    }
    if (value < least[count] || value > 0x10FFFF || (value >= 0xD800 && value <= 0xDFFF)) {
        return 0;
    }
    *code = value;
    return count;
}

size_t utf8_valid_length(const char *text, size_t length) {
    size_t at = 0, step = 1;
    for (uint32_t code; at < length && step > 0; at += step) {
        step = utf8_decode(text + at, length - at, &code);
    }
    return at;
}

size_t utf8_cut(const char *text, size_t most) {
    size_t length = strlen(text);
    if (length > most) {
        for (length = most; length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80;) {
            --length;
        }
    }
    return length;
}
