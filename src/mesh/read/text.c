/* A cursor over text in memory, and the places that messages name. */
#include "mesh/read/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "mesh/read/decimal.h"

enum { MESSAGE_SIZE = 300, LINE_SIZE = MESSAGE_SIZE + sizeof(burnish_shown_name) + 64 };

/* The first byte from p on that is below `limit`, end when there is none; eight at a time. */
static inline const uint8_t *find_below(const uint8_t *p, const uint8_t *end, uint8_t limit) {
    const uint64_t each = UINT64_C(0x0101010101010101);
    while (end - p >= 8) {
        uint64_t word = burnish_load_characters(p);
        uint64_t below = (word - each * limit) & ~word & (each << 7);
        if (below) { /* the lowest is right: borrows go upwards */
            return p + __builtin_ctzll(below) / 8;
        }
        p += 8;
    }
    while (p < end && *p >= limit) {
        ++p;
    }
    return p;
}

static inline const uint8_t *find_line_end(const uint8_t *p, const uint8_t *end) {
    while ((p = find_below(p, end, '\r' + 1)) < end && !burnish_text_line_end(*p)) {
        ++p;
    }
    return p;
}

/* The blank or line end that ends a token. */
static inline const uint8_t *find_token_end(const uint8_t *p, const uint8_t *end) {
    while ((p = find_below(p, end, ' ' + 1)) < end && !burnish_text_blank(*p) &&
           !burnish_text_line_end(*p)) {
        ++p;
    }
    return p;
}

/* Bytes of the line end at p, 0 when there is none. */
static size_t line_end_size(const uint8_t *p, const uint8_t *end) {
    if (p == end || !burnish_text_line_end(*p)) {
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

/* The first byte behind blanks and joined line ends. */
static inline const uint8_t *skip_blanks(burnish_text *text) {
    const uint8_t *p = text->next, *end = text->end;
    for (;;) {
        while (p < end && burnish_text_blank(*p)) {
            ++p;
        }
        size_t joined = p < end && *p == '\\' && text->wavefront ? line_end_size(p + 1, end) : 0;
        if (joined == 0) {
            text->next = p;
            return p;
        }
        p += 1 + joined;
        ++text->line;
    }
}

int burnish_text_token(burnish_text *text, burnish_token *token) {
    const uint8_t *first = skip_blanks(text), *end = text->end;
    if (first == end || burnish_text_line_end(*first) || (text->wavefront && *first == '#')) {
        return 0;
    }
    const uint8_t *p = find_token_end(first, end);
    /* A '\' that joins lines belongs to no token, nor was it passed over as the first byte. */
    p -= text->wavefront && p < end && burnish_text_line_end(*p) && p[-1] == '\\';
    *token = (burnish_token){first, (size_t)(p - first)};
    text->next = p;
    return 1;
}

static inline int read_double(burnish_text *text, burnish_number_reader *numbers,
                              burnish_token *token, double *value, burnish_number_status *status) {
    const uint8_t *first = skip_blanks(text);
    if (text->end - first > BURNISH_DECIMAL_ROOM) {
        size_t size = burnish_scan_decimal(first, value);
        if (size > 0 && (burnish_text_blank(first[size]) || burnish_text_line_end(first[size]))) {
            *token = (burnish_token){first, size};
            *status = BURNISH_NUMBER_OK;
            text->next = first + size;
            return 1;
        }
    }
    if (!burnish_text_token(text, token)) {
        return 0;
    }
    *status = burnish_parse_double(numbers, token->bytes, token->size, value);
    return 1;
}

int burnish_text_double(burnish_text *text, burnish_number_reader *numbers, burnish_token *token,
                        double *value, burnish_number_status *status) {
    return read_double(text, numbers, token, value, status);
}

int burnish_text_float(burnish_text *text, burnish_number_reader *numbers, burnish_token *token,
                       float *value, burnish_number_status *status) {
    double wide;
    if (!read_double(text, numbers, token, &wide, status)) {
        return 0;
    }
    if (*status == BURNISH_NUMBER_OK && !burnish_double_to_float(wide, value)) {
        *status = BURNISH_NUMBER_RANGE;
    }
    return 1;
}

int burnish_text_count(burnish_text *text, uint64_t *value) {
    const uint8_t *p = text->next;
    uint64_t found = 0;
    while (p < text->end && *p == ' ') {
        ++p;
    }
    if (text->end - p <= BURNISH_DECIMAL_ROOM) {
        return 0;
    }
    unsigned digits = burnish_scan_digits(&p, &found);
    if (digits == 0 || digits > 18 || !(burnish_text_blank(*p) || burnish_text_line_end(*p))) {
        return 0;
    }
    *value = found;
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

int burnish_text_word_double(burnish_text *text, burnish_number_reader *numbers,
                             burnish_token *token, double *value, burnish_number_status *status) {
    while (!read_double(text, numbers, token, value, status)) {
        if (!burnish_text_next_line(text)) {
            return 0;
        }
    }
    return 1;
}

burnish_token burnish_text_rest(burnish_text *text) {
    const uint8_t *first = text->next;
    while (first < text->end && burnish_text_blank(*first)) {
        ++first;
    }
    const uint8_t *p = find_line_end(first, text->end);
    text->next = p;
    while (p > first && burnish_text_blank(p[-1])) {
        --p;
    }
    return (burnish_token){first, (size_t)(p - first)};
}

int burnish_text_next_line(burnish_text *text) {
    const uint8_t *p = find_line_end(text->next, text->end);
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
