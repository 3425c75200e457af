/* Text and names as messages show them: a terminal obeys control characters. This is a
 * header because the program links another copy of the library, and both must print the same. */
#ifndef BURNISH_BASE_SHOW_TEXT_H
#define BURNISH_BASE_SHOW_TEXT_H

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Bytes of the character of UTF-8 at text (RFC 3629: no overlong forms, no surrogates); 0: none. */
static inline size_t burnish_character_size(const char *text) {
    const unsigned char *bytes = (const unsigned char *)text;
    const unsigned first = bytes[0];
    const size_t size = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    const unsigned low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    const unsigned high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
    if (size == 1) {
        return 1;
    }
    if (first < 0xC2 || first > 0xF4 || bytes[1] < low || bytes[1] > high) {
        return 0;
    }
    for (size_t i = 2; i < size; ++i) {
        if ((bytes[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    return size;
}

/* The code of the character at text if it controls a terminal or the order of other characters; else
 * 0. C1 controls (U+009B is ESC [), line and paragraph separators, embeddings, overrides and isolates
 * count as well. Right-to-left marks do not: names in such scripts need them, and they move no
 * letters. */
static inline unsigned burnish_control_code(const char *text) {
    const unsigned char *bytes = (const unsigned char *)text;
    const unsigned first = bytes[0];
    if (first < 32 || first == 0x7F) {
        return first;
    }
    const unsigned second = first >= 0xC2 ? bytes[1] : 0;
    if (first == 0xC2 && second >= 0x80 && second < 0xA0) {
        return second;
    }
    const unsigned third = first == 0xE2 && (second == 0x80 || second == 0x81) ? bytes[2] : 0;
    const unsigned code = 0x2000 + ((second & 1) << 6) + (third & 0x3F);
    const int is_control =
        third >= 0x80 && third < 0xC0 &&
        ((code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069));
    return is_control ? code : 0;
}

/* Bytes of the character at text that can be printed; 0: it is replaced, byte by byte. */
static inline size_t burnish_printable_size(const char *text) {
    return *text && burnish_control_code(text) == 0 ? burnish_character_size(text) : 0;
}

/* Replaces what can't be printed by '?'. */
static inline void burnish_clean_text(char *text) {
    while (*text) {
        const size_t size = burnish_printable_size(text);
        if (size == 0) {
            *text = '?';
        }
        text += size > 0 ? size : 1;
    }
}

/* The whole name, or "..." and its end, to keep the message short. */
typedef struct burnish_shown_name {
    char text[164];
} burnish_shown_name;

static inline burnish_shown_name burnish_show_name(const char *name) {
    burnish_shown_name shown;
    const char *cut = "";
    const size_t most = sizeof shown.text - sizeof "...";
    size_t length = strlen(name);
    if (length > most) {
        name += length - most;
        cut = "...";
        while (((unsigned char)*name & 0xC0) == 0x80) { /* not from the middle of a character */
            ++name;
        }
    }
    snprintf(shown.text, sizeof shown.text, "%s%s", cut, name);
    return shown;
}

#endif
