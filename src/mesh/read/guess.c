/* Which format a file has. */
#include <string.h>

#include "mesh/read/reader.h"
#include "mesh/read/text.h"

static int ends_with(const char *name, const char *ending) {
    size_t length = strlen(name), size = strlen(ending);
    return length >= size &&
           burnish_token_is_caseless((burnish_token){(const uint8_t *)name + length - size, size},
                                     ending);
}

static int is_ply(const uint8_t *bytes, size_t size) {
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r');
}

static int is_binary_stl(const uint8_t *bytes, size_t size) {
    if (size < 84 || (size - 84) % 50 != 0) {
        return 0;
    }
    uint32_t count = (uint32_t)bytes[80] | (uint32_t)bytes[81] << 8 | (uint32_t)bytes[82] << 16 |
                     (uint32_t)bytes[83] << 24;
    return (size - 84) / 50 == count;
}

/* The first word of the first line that is no comment is one of the format's. */
static int is_obj(const uint8_t *bytes, size_t size) {
    static const char *const words[] = {"v", "vn", "vt", "f",      "o",      "g",
                                        "s", "l",  "p",  "mtllib", "usemtl", "vp"};
    burnish_text text = burnish_text_open(bytes, size, 1);
    burnish_token token;
    if (!burnish_text_word(&text, &token)) {
        return 0;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        if (burnish_token_is(token, words[i])) {
            return 1;
        }
    }
    return 0;
}

static int is_text_stl(const uint8_t *bytes, size_t size) {
    burnish_text text = burnish_text_open(bytes, size, 0);
    burnish_token token;
    return burnish_text_word(&text, &token) && burnish_token_is_caseless(token, "solid");
}

burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name) {
    /* PLY is sure by its first line, whatever the name says; the others are not. */
    if (is_ply(bytes, size)) {
        return BURNISH_FORMAT_PLY;
    }
    if (name && ends_with(name, ".obj")) {
        return BURNISH_FORMAT_OBJ;
    }
    if (name && ends_with(name, ".ply")) {
        return BURNISH_FORMAT_PLY;
    }
    if (name && ends_with(name, ".stl")) {
        return BURNISH_FORMAT_STL;
    }
    if (is_binary_stl(bytes, size) || is_text_stl(bytes, size)) {
        return BURNISH_FORMAT_STL;
    }
    return is_obj(bytes, size) ? BURNISH_FORMAT_OBJ : BURNISH_FORMAT_AUTO;
}
