/* A cursor over text in memory: lines, tokens, places for messages. Nothing is copied, nothing is
 * assumed to follow the last byte. */
#ifndef ORACLE_MESH_READ_TEXT_H
#define ORACLE_MESH_READ_TEXT_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "oracle/number.h"
#include "oracle/source.h"

/* Some bytes of the text, without blanks around them. */
typedef struct oracle_token {
    const uint8_t *bytes;
    size_t size;
} oracle_token;

typedef struct oracle_text {
    const uint8_t *next;
    const uint8_t *end;
    size_t line;   /* of next, counted from 1 */
    int wavefront; /* 1: '#' begins a comment, and '\' before a line end joins lines (OBJ, MTL) */
} oracle_text;

static inline int oracle_text_blank(uint8_t c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
static inline int oracle_text_line_end(uint8_t c) {
    return c == '\n' || c == '\r';
}

/* A byte order mark in front is passed over. */
oracle_text oracle_text_open(const uint8_t *bytes, size_t size, int wavefront);

/* The next token of this line; 0 at its end. */
int oracle_text_token(oracle_text *text, oracle_token *token);

/* The next token of this line and the number that it is, as oracle_parse_double() or
 * oracle_parse_float() would give it, in one look; *value is set only where *status is OK. */
int oracle_text_double(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                       double *value, oracle_number_status *status);
int oracle_text_float(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                      float *value, oracle_number_status *status);

/* The next token of this line where it is nothing but digits, fewer than 19 and not at the very end
 * of the text; returns 0 and moves nothing for any other. */
int oracle_text_count(oracle_text *text, uint64_t *value);

/* The next token of this line or a later one; 0 at the end of the text. */
int oracle_text_word(oracle_text *text, oracle_token *token);

/* The same as a number. */
int oracle_text_word_double(oracle_text *text, oracle_number_reader *numbers, oracle_token *token,
                            double *value, oracle_number_status *status);

/* What is left of this line, comments included, without blanks around it; possibly empty. */
oracle_token oracle_text_rest(oracle_text *text);

/* Moves to the start of the next line ("\n", "\r\n" or "\r" end one); 0 at the end of the text. */
int oracle_text_next_line(oracle_text *text);

int oracle_token_is(oracle_token token, const char *word);
int oracle_token_is_caseless(oracle_token token, const char *word); /* word in small letters */

/* A token for a message: at most 40 characters, "..." where it was cut, '?' for anything outside
 * printable ASCII. */
typedef struct oracle_quote {
    char text[44];
} oracle_quote;
oracle_quote oracle_token_quote(oracle_token token);

/* Where something is: "NAME: ", "NAME:LINE: " or "NAME: byte N: ". */
typedef struct oracle_place {
    const char *name;
    enum { ORACLE_PLACE_FILE, ORACLE_PLACE_LINE, ORACLE_PLACE_BYTE } kind;
    size_t at;
} oracle_place;

static inline oracle_place oracle_place_file(const char *name) {
    return (oracle_place){name, ORACLE_PLACE_FILE, 0};
}
static inline oracle_place oracle_place_line(const char *name, size_t line) {
    return (oracle_place){name, ORACLE_PLACE_LINE, line};
}
static inline oracle_place oracle_place_byte(const char *name, size_t offset) {
    return (oracle_place){name, ORACLE_PLACE_BYTE, offset};
}

/* burnish_fail() and oracle_source_warn() with the place in front. A long name loses its
 * beginning, so that the message itself always fits. */
__attribute__((format(printf, 4, 5))) burnish_status oracle_fail_at(burnish_error *error,
                                                                    burnish_status status,
                                                                    oracle_place place,
                                                                    const char *format, ...);
__attribute__((format(printf, 3, 4))) void oracle_warn_at(oracle_source *source, oracle_place place,
                                                          const char *format, ...);

/* FORMAT (or MEMORY) for a number that could not be read; `what` is "coordinate", "Kd" ... */
burnish_status oracle_fail_number(burnish_error *error, oracle_place place, const char *what,
                                  oracle_token token, oracle_number_status status);

#endif
