/* A cursor over text in memory, and the places that messages name. */
#include "oracle/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "oracle/decimal.h"

enum { MESSAGE_SIZE = 300, LINE_SIZE = MESSAGE_SIZE + sizeof(burnish_shown_name) + 64 };

/* The first byte from p on that is below `limit`, end when there is none; eight at a time. */
static inline const uint8_t *find_below(const uint8_t *p, const uint8_t *end, uint8_t limit) {
    const uint64_t each = UINT64_C(0x0101010101010101);
    while (end - p >= 8) {
        uint64_t word = oracle_load_characters(p);
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
    while ((p = find_below(p, end, '\r' + 1)) < end && !oracle_text_line_end(*p)) {
        ++p;
    }
    return p;
}

/* The blank or line end that ends a token. */
static inline const uint8_t *find_token_end(const uint8_t *p, const uint8_t *end) {
    while ((p = find_below(p, end, ' ' + 1)) < end && !oracle_text_blank(*p) &&
           !oracle_text_line_end(*p)) {
        ++p;
    }
    return p;
}

/* Bytes of the line end at p, 0 when there is none. */
static size_t line_end_size(const uint8_t *p, const uint8_t *end) {
    if (p == end || !oracle_text_line_end(*p)) {
        return 0;
    }
    return *p == '\r' && end - p > 1 && p[1] == '\n' ? 2 : 1;
}

oracle_text oracle_text_open(const uint8_t *bytes, size_t size, int wavefront) {
    static const uint8_t mark[3] = {0xEF, 0xBB, 0xBF};
    size_t skip = size >= sizeof mark && memcmp(bytes, mark, sizeof mark) == 0 ? sizeof mark : 0;
    if (size == 0) {
        return (oracle_text){NULL, NULL, 1, wavefront};
    }
    return (oracle_text){bytes + skip, bytes + size, 1, wavefront};
}

/* The first byte behind blanks and joined line ends. */
static inline const uint8_t *skip_blanks(oracle_text *text) {
    const uint8_t *p = text->next, *end = text->end;
    for (;;) {
        while (p < end && oracle_text_blank(*p)) {
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

int oracle_text_token(oracle_text *text, oracle_token *token) {
    const uint8_t *first = skip_blanks(text), *end = text->end;
    if (first == end || oracle_text_line_end(*first) || (text->wavefront && *first == '#')) {
        return 0;
    }
    const uint8_t *p = find_token_end(first, end);
    /* A '\' that joins lines belongs to no token, nor was it passed over as the first byte. */
    p -= text->wavefront && p < end && oracle_text_line_end(*p) && p[-1] == '\\';
    *token = (oracle_token){first, (size_t)(p - first)};
    text->next = p;
    return 1;
}

static inline int read_double(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                              double *value, oracle_number_status *status) {
    const uint8_t *first = skip_blanks(text);
    if (text->end - first > ORACLE_DECIMAL_ROOM) {
        size_t size = oracle_scan_decimal(first, value);
        if (size > 0 && (oracle_text_blank(first[size]) || oracle_text_line_end(first[size]))) {
            *token = (oracle_token){first, size};
            *status = ORACLE_NUMBER_OK;
            text->next = first + size;
            return 1;
        }
    }
    if (!oracle_text_token(text, token)) {
        return 0;
    }
    *status = oracle_parse_double(numbers, token->bytes, token->size, value);
    return 1;
}

int oracle_text_double(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                       double *value, oracle_number_status *status) {
    return read_double(text, numbers, token, value, status);
}

int oracle_text_float(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                      float *value, oracle_number_status *status) {
    double wide;
    if (!read_double(text, numbers, token, &wide, status)) {
        return 0;
    }
    if (*status == ORACLE_NUMBER_OK && !oracle_double_to_float(wide, value)) {
        *status = ORACLE_NUMBER_RANGE;
    }
    return 1;
}

int oracle_text_count(oracle_text *text, uint64_t *value) {
    const uint8_t *p = text->next;
    uint64_t found = 0;
    while (p < text->end && *p == ' ') {
        ++p;
    }
    if (text->end - p <= ORACLE_DECIMAL_ROOM) {
        return 0;
    }
    unsigned digits = oracle_scan_digits(&p, &found);
    if (digits == 0 || digits > 18 || !(oracle_text_blank(*p) || oracle_text_line_end(*p))) {
        return 0;
    }
    *value = found;
    text->next = p;
    return 1;
}

int oracle_text_word(oracle_text *text, oracle_token *token) {
    while (!oracle_text_token(text, token)) {
        if (!oracle_text_next_line(text)) {
            return 0;
        }
    }
    return 1;
}

int oracle_text_word_double(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                            double *value, oracle_number_status *status) {
    while (!read_double(text, numbers, token, value, status)) {
        if (!oracle_text_next_line(text)) {
            return 0;
        }
    }
    return 1;
}

oracle_token oracle_text_rest(oracle_text *text) {
    const uint8_t *first = text->next;
    while (first < text->end && oracle_text_blank(*first)) {
        ++first;
    }
    const uint8_t *p = find_line_end(first, text->end);
    text->next = p;
    while (p > first && oracle_text_blank(p[-1])) {
        --p;
    }
    return (oracle_token){first, (size_t)(p - first)};
}

int oracle_text_next_line(oracle_text *text) {
    const uint8_t *p = find_line_end(text->next, text->end);
    size_t size = line_end_size(p, text->end);
    text->next = size > 0 ? p + size : p;
    if (text->next == text->end) {
        return 0;
    }
    ++text->line;
    return 1;
}

int oracle_token_is(oracle_token token, const char *word) {
    size_t length = strlen(word);
    return token.size == length && memcmp(token.bytes, word, length) == 0;
}

int oracle_token_is_caseless(oracle_token token, const char *word) {
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

oracle_quote oracle_token_quote(oracle_token token) {
    enum { SHOWN = 40 };
    oracle_quote quote;
    size_t length = token.size <= SHOWN ? token.size : SHOWN - 3;
    for (size_t i = 0; i < length; ++i) {
        uint8_t c = token.bytes[i];
        quote.text[i] = (char)(c >= 32 && c < 127 ? c : '?');
    }
    strcpy(quote.text + length, token.size <= SHOWN ? "" : "...");
    return quote;
}

/* "NAME:LINE: message" into out. */
static void write_line(char *out, size_t out_size, oracle_place place, const char *message) {
    burnish_shown_name name = burnish_show_name(place.name ? place.name : "input");
    switch (place.kind) {
    case ORACLE_PLACE_LINE:
        snprintf(out, out_size, "%s:%zu: %s", name.text, place.at, message);
        break;
    case ORACLE_PLACE_BYTE:
        snprintf(out, out_size, "%s: byte %zu: %s", name.text, place.at, message);
        break;
    case ORACLE_PLACE_FILE:
        snprintf(out, out_size, "%s: %s", name.text, message);
        break;
    }
}

burnish_status oracle_fail_at(burnish_error *error, burnish_status status, oracle_place place,
                              const char *format, ...) {
    char message[MESSAGE_SIZE], line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    write_line(line, sizeof line, place, message);
    return burnish_fail(error, status, "%s", line);
}

void oracle_warn_at(oracle_source *source, oracle_place place, const char *format, ...) {
    if (!source) {
        return;
    }
    char message[MESSAGE_SIZE], line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    write_line(line, sizeof line, place, message);
    oracle_source_warn(source, "%s", line);
}

burnish_status oracle_fail_number(burnish_error *error, oracle_place place, const char *what,
                                  oracle_token token, oracle_number_status status) {
    oracle_quote quote = oracle_token_quote(token);
    switch (status) {
    case ORACLE_NUMBER_MEMORY:
        return oracle_fail_at(error, BURNISH_STATUS_MEMORY, place,
                              "out of memory while reading a number; free memory");
    case ORACLE_NUMBER_NOT_FINITE:
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, place,
                              "%s \"%s\" is not finite; repair or remove it", what, quote.text);
    case ORACLE_NUMBER_RANGE:
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, place,
                              "%s \"%s\" is out of range; scale it to below 3.4e38", what,
                              quote.text);
    case ORACLE_NUMBER_OK:
    case ORACLE_NUMBER_GARBAGE:
        break;
    }
    return oracle_fail_at(error, BURNISH_STATUS_FORMAT, place,
                          "%s \"%s\" is not a number; write it like 1.5 or -2e-3", what,
                          quote.text);
}
