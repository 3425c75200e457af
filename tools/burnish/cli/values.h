/* Values of flags: numbers, vectors, colours, words; strict and independent of the locale. */
#ifndef BURNISH_TOOL_CLI_VALUES_H
#define BURNISH_TOOL_CLI_VALUES_H

#include "cli/options.h"

/* Values that may be left out. */
typedef struct burnish_cli_real {
    int given;
    double value;
} burnish_cli_real;

typedef struct burnish_cli_vector {
    int given;
    double values[3];
} burnish_cli_vector;

typedef struct burnish_cli_color {
    int given;
    float srgb[3]; /* [0, 1] */
} burnish_cli_color;

/* Handlers for tables of flags; the comment names the type of the target. */
burnish_cli_handler burnish_cli_flag_switch;  /* int: becomes 1 */
burnish_cli_handler burnish_cli_flag_text;    /* const char *; empty is refused */
burnish_cli_handler burnish_cli_flag_integer; /* int in [low, high] */
burnish_cli_handler burnish_cli_flag_count;   /* uint64_t in [low, high] */
burnish_cli_handler burnish_cli_flag_bytes;   /* uint64_t in [low, high], with K, M or G */
burnish_cli_handler burnish_cli_flag_real;    /* burnish_cli_real in [low, high] */
burnish_cli_handler burnish_cli_flag_angle;   /* the same, low and high excluded */
burnish_cli_handler burnish_cli_flag_vector;  /* burnish_cli_vector */
burnish_cli_handler burnish_cli_flag_nonzero; /* the same, not 0,0,0 */
burnish_cli_handler burnish_cli_flag_word;    /* int: value of one of flag->words */
burnish_cli_handler burnish_cli_flag_color;   /* burnish_cli_color */
burnish_cli_handler burnish_cli_flag_isa;     /* burnish_isa */

/* The whole text as a finite decimal number. Returns 0 when it is none. */
int burnish_cli_read_real(const char *text, size_t length, double *value);

/* The whole text as `count` numbers between commas. Returns 0 when it is not that. */
int burnish_cli_read_reals(const char *text, size_t length, double *values, size_t count);

/* #rgb, #rrggbb, r,g,b in [0, 1] or a name. Returns 0 when it is none of these. */
int burnish_cli_read_color(const char *text, size_t length, float srgb[3]);

/* What the messages say about a colour. */
extern const char burnish_cli_color_forms[];

/* The table of colour names, for the man page: NULL past the end. */
const char *burnish_cli_color_name(size_t index);

/* Writes the names as "a, b, c". */
void burnish_cli_word_list(const burnish_cli_word *words, char *text, size_t size);

/* 8-bit code of an sRGB value in [0, 1]. */
uint8_t burnish_cli_color_code(float srgb);

/* The item at *text up to the separator or the end; *text moves past it, NULL after the last. */
size_t burnish_cli_next_item(const char **text, char separator, const char **item);

#endif
