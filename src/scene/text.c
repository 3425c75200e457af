/* A cursor over text in memory, and the places that messages name. */
#include "scene/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MESSAGE_SIZE = 300, LINE_SIZE = MESSAGE_SIZE + sizeof(burnish_shown_name) + 64 };

static int is_blank(uint8_t c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
static int is_line_end(uint8_t c) {
    return c == '\n' || c == '\r';
}

/* Bytes of the line end at p, 0 when there is none. */
static size_t line_end_size(const uint8_t *p, const uint8_t *end) {
    if (p == end || !is_line_end(*p)) {
        return 0;
    }
    return *p == '\r' && end - p > 1 && p[1] == '\n' ? 2 : 1;
}

burnish_text burnish_text_open(const uint8_t *bytes, size_t size, int wavefront) {
    static const uint8_t mark[3] = {0xEF, 0xBB, 0xBF};
    size_t skip = size >= sizeof mark && memcmp(bytes, mark, sizeof mark) == 0 ? sizeof mark : 0;
    if (size == 0) {
        return (burnish_text){NULL, NULL, 1, wavefront};
    }
    return (burnish_text){bytes + skip, bytes + size, 1, wavefront};
}

int burnish_text_token(burnish_text *text, burnish_token *token) {
    const uint8_t *p = text->next, *end = text->end;
    for (;;) {
        while (p < end && is_blank(*p)) {
            ++p;
        }
        size_t joined = text->wavefront && p < end && *p == '\\' ? line_end_size(p + 1, end) : 0;
        if (joined == 0) {
            break;
        }
        p += 1 + joined;
        ++text->line;
    }
    text->next = p;
    if (p == end || is_line_end(*p) || (text->wavefront && *p == '#')) {
        return 0;
    }
    token->bytes = p;
    while (p < end && !is_blank(*p) && !is_line_end(*p)) {
        if (*p == '\\' && text->wavefront && line_end_size(p + 1, end) > 0) {
            break;
        }
        ++p;
    }
    token->size = (size_t)(p - token->bytes);
    text->next = p;
    return 1;
}

int burnish_text_word(burnish_text *text, burnish_token *token) {
    while (!burnish_text_token(text, token)) {
        if (!burnish_text_next_line(text)) {
            return 0;
        }
    }
    return 1;
}

burnish_token burnish_text_rest(burnish_text *text) {
    const uint8_t *first = text->next;
    while (first < text->end && is_blank(*first)) {
        ++first;
    }
    const uint8_t *p = first;
    while (p < text->end && !is_line_end(*p)) {
        ++p;
    }
    text->next = p;
    while (p > first && is_blank(p[-1])) {
        --p;
    }
    return (burnish_token){first, (size_t)(p - first)};
}

int burnish_text_next_line(burnish_text *text) {
    const uint8_t *p = text->next;
    while (p < text->end && !is_line_end(*p)) {
        ++p;
    }
    size_t size = line_end_size(p, text->end);
    text->next = size > 0 ? p + size : p;
    if (text->next == text->end) {
        return 0;
    }
    ++text->line;
    return 1;
}

int burnish_token_is(burnish_token token, const char *word) {
    size_t length = strlen(word);
    return token.size == length && memcmp(token.bytes, word, length) == 0;
}

int burnish_token_is_caseless(burnish_token token, const char *word) {
    if (token.size != strlen(word)) {
        return 0;
    }
    for (size_t i = 0; i < token.size; ++i) {
        uint8_t c = token.bytes[i];
        if ((c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c) != (uint8_t)word[i]) {
            return 0;
        }
    }
    return 1;
}

burnish_quote burnish_token_quote(burnish_token token) {
    enum { SHOWN = 40 };
    burnish_quote quote;
    size_t length = token.size <= SHOWN ? token.size : SHOWN - 3;
    for (size_t i = 0; i < length; ++i) {
        uint8_t c = token.bytes[i];
        quote.text[i] = (char)(c >= 32 && c < 127 ? c : '?');
    }
    strcpy(quote.text + length, token.size <= SHOWN ? "" : "...");
    return quote;
}

/* "NAME:LINE: message" into out. */
static void write_line(char *out, size_t out_size, burnish_place place, const char *message) {
    burnish_shown_name name = burnish_show_name(place.name ? place.name : "input");
    switch (place.kind) {
    case BURNISH_PLACE_LINE:
        snprintf(out, out_size, "%s:%zu: %s", name.text, place.at, message);
        break;
    case BURNISH_PLACE_BYTE:
        snprintf(out, out_size, "%s: byte %zu: %s", name.text, place.at, message);
        break;
    case BURNISH_PLACE_FILE:
        snprintf(out, out_size, "%s: %s", name.text, message);
        break;
    }
}

burnish_status burnish_fail_at(burnish_error *error, burnish_status status, burnish_place place,
                               const char *format, ...) {
    char message[MESSAGE_SIZE], line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    write_line(line, sizeof line, place, message);
    return burnish_fail(error, status, "%s", line);
}

void burnish_warn_at(burnish_source *source, burnish_place place, const char *format, ...) {
    if (!source) {
        return;
    }
    char message[MESSAGE_SIZE], line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    write_line(line, sizeof line, place, message);
    burnish_source_warn(source, "%s", line);
}

burnish_status burnish_fail_number(burnish_error *error, burnish_place place, const char *what,
                                   burnish_token token, burnish_number_status status) {
    burnish_quote quote = burnish_token_quote(token);
    switch (status) {
    case BURNISH_NUMBER_MEMORY:
        return burnish_fail_at(error, BURNISH_STATUS_MEMORY, place,
                               "out of memory while reading a number; free memory");
    case BURNISH_NUMBER_NOT_FINITE:
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, place,
                               "%s \"%s\" is not finite; repair or remove it", what, quote.text);
    case BURNISH_NUMBER_RANGE:
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, place,
                               "%s \"%s\" is out of range; scale it to below 3.4e38", what,
                               quote.text);
    case BURNISH_NUMBER_OK:
    case BURNISH_NUMBER_GARBAGE:
        break;
    }
    return burnish_fail_at(error, BURNISH_STATUS_FORMAT, place,
                           "%s \"%s\" is not a number; write it like 1.5 or -2e-3", what,
                           quote.text);
}
