/* A cursor over text in memory: lines, tokens, places for messages. Nothing is copied, nothing is
 * assumed to follow the last byte. */
#ifndef BURNISH_MESH_READ_TEXT_H
#define BURNISH_MESH_READ_TEXT_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "mesh/read/number.h"
#include "mesh/read/source.h"

/* Some bytes of the text, without blanks around them. */
typedef struct burnish_token {
    const uint8_t *bytes;
    size_t size;
} burnish_token;

typedef struct burnish_text {
    const uint8_t *next;
    const uint8_t *end;
    size_t line;   /* of next, counted from 1 */
    int wavefront; /* 1: '#' begins a comment, and '\' before a line end joins lines (OBJ, MTL) */
} burnish_text;

static inline int burnish_text_blank(uint8_t c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
static inline int burnish_text_line_end(uint8_t c) {
    return c == '\n' || c == '\r';
}

/* A byte order mark in front is passed over. */
burnish_text burnish_text_open(const uint8_t *bytes, size_t size, int wavefront);

/* The next token of this line; 0 at its end. */
int burnish_text_token(burnish_text *text, burnish_token *token);

/* The next token of this line and the number that it is, as burnish_parse_double() or
 * burnish_parse_float() would give it, in one look; *value is set only where *status is OK. */
int burnish_text_double(burnish_text *text, burnish_number_reader *numbers, burnish_token *token,
                        double *value, burnish_number_status *status);
int burnish_text_float(burnish_text *text, burnish_number_reader *numbers, burnish_token *token,
                       float *value, burnish_number_status *status);

/* The next token of this line where it is nothing but digits, fewer than 19 and not at the very end
 * of the text; returns 0 and moves nothing for any other. */
int burnish_text_count(burnish_text *text, uint64_t *value);

/* The next token of this line or a later one; 0 at the end of the text. */
int burnish_text_word(burnish_text *text, burnish_token *token);

/* The same as a number. */
int burnish_text_word_double(burnish_text *text, burnish_number_reader *numbers,
                             burnish_token *token, double *value, burnish_number_status *status);

/* What is left of this line, comments included, without blanks around it; possibly empty. */
burnish_token burnish_text_rest(burnish_text *text);

/* Moves to the start of the next line ("\n", "\r\n" or "\r" end one); 0 at the end of the text. */
int burnish_text_next_line(burnish_text *text);

int burnish_token_is(burnish_token token, const char *word);
int burnish_token_is_caseless(burnish_token token, const char *word); /* word in small letters */

/* A token for a message: at most 40 characters, "..." where it was cut, '?' for anything outside
 * printable ASCII. */
typedef struct burnish_quote {
    char text[44];
} burnish_quote;
burnish_quote burnish_token_quote(burnish_token token);

/* Where something is: "NAME: ", "NAME:LINE: " or "NAME: byte N: ". */
typedef struct burnish_place {
    const char *name;
    enum { BURNISH_PLACE_FILE, BURNISH_PLACE_LINE, BURNISH_PLACE_BYTE } kind;
    size_t at;
} burnish_place;

static inline burnish_place burnish_place_file(const char *name) {
    return (burnish_place){name, BURNISH_PLACE_FILE, 0};
}
static inline burnish_place burnish_place_line(const char *name, size_t line) {
    return (burnish_place){name, BURNISH_PLACE_LINE, line};
}
static inline burnish_place burnish_place_byte(const char *name, size_t offset) {
    return (burnish_place){name, BURNISH_PLACE_BYTE, offset};
}

/* burnish_fail() and burnish_source_warn() with the place in front. A long name loses its
 * beginning, so that the message itself always fits. */
__attribute__((format(printf, 4, 5))) burnish_status burnish_fail_at(burnish_error *error,
                                                                     burnish_status status,
                                                                     burnish_place place,
                                                                     const char *format, ...);
__attribute__((format(printf, 3, 4))) void
burnish_warn_at(burnish_source *source, burnish_place place, const char *format, ...);

/* FORMAT (or MEMORY) for a number that could not be read; `what` is "coordinate", "Kd" ... */
burnish_status burnish_fail_number(burnish_error *error, burnish_place place, const char *what,
                                   burnish_token token, burnish_number_status status);

#endif
