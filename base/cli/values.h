/* Values of flags: numbers, vectors, words; strict and independent of the locale. */
#ifndef BASE_CLI_VALUES_H
#define BASE_CLI_VALUES_H

#include "base/cli/options.h"

#define CLI_PI 3.14159265358979323846

/* Optional values. */
typedef struct cli_real {
    int given;
    double value;
} cli_real;

typedef struct cli_vector {
    int given;
    double values[3];
} cli_vector;

/* Handlers for tables of flags; the comment names the type of the target. */
cli_handler cli_flag_switch;  /* int: becomes 1 */
cli_handler cli_flag_text;    /* const char *; empty is refused */
cli_handler cli_flag_file;    /* const char *; "-" where an optional value is not there */
cli_handler cli_flag_integer; /* int in [low, high] */
cli_handler cli_flag_count;   /* uint64_t in [low, high] */
cli_handler cli_flag_bytes;   /* uint64_t in [low, high], with K, M or G */
cli_handler cli_flag_size;    /* int[2] in [low, high]: W,H, WxH, or N for both */
cli_handler cli_flag_real;    /* cli_real in [low, high] */
cli_handler cli_flag_angle;   /* the same, low and high excluded */
cli_handler cli_flag_vector;  /* cli_vector */
cli_handler cli_flag_nonzero; /* the same, not 0,0,0; or an axis: +Z, -x */
cli_handler cli_flag_word;    /* int: value of one of flag->words */

/* The type of a flag's value, never CLI_TYPE_AUTO; and its word. */
cli_type cli_type_of(const cli_flag *flag);
const char *cli_type_word(cli_type type);

/* The whole text as a finite decimal number. Returns 0 if it is not one. */
int cli_read_real(const char *text, size_t length, double *value);

/* The shortest decimal that reads back as the same double, in any locale. "inf", "-inf"
 * and "nan" for numbers that are not finite. */
enum { CLI_REAL_SIZE = 40 };
const char *cli_shortest(double value, char text[CLI_REAL_SIZE]);

/* The whole text as `count` numbers between commas. Returns 0 if it is not. */
int cli_read_reals(const char *text, size_t length, double *values, size_t count);

/* Writes the names as "a, b, c". */
void cli_word_list(const cli_word *words, char *text, size_t size);

/* The item at *text up to the separator or the end; *text moves past it, NULL after the last. */
size_t cli_next_item(const char **text, char separator, const char **item);

#endif
