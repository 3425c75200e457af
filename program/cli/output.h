/* What commands write: whole files; tables as text, Markdown, CSV and JSON; numbers. */
#ifndef TOOL_CLI_OUTPUT_H
#define TOOL_CLI_OUTPUT_H

#include <cjson/cJSON.h>
#include <stdio.h>

#include "cli/options.h"
#include "cli/values.h"

typedef enum cli_format {
    CLI_FORMAT_TEXT,
    CLI_FORMAT_CSV,
    CLI_FORMAT_JSON,
    CLI_FORMAT_MARKDOWN
} cli_format;

/* text, csv, json and the same with markdown. */
extern const cli_word cli_format_words[];
extern const cli_word cli_table_format_words[];

enum { CLI_TEXT_WIDTH = 100, CLI_CELLS_MAX = 1 << 22 };

/* An output on its way; written when it is complete. */
typedef struct cli_output {
    FILE *stream; /* print to this */
    char *text;
    size_t size;
} cli_output;

/* Errors: MEMORY. */
burnish_status cli_output_begin(cli_output *output, burnish_error *error);

/* Ends the text, which is then the caller's to use and to free, also after an error. Errors:
 * MEMORY.
 */
burnish_status cli_output_close(cli_output *output, burnish_error *error);

/* Writes the whole text to a file, "-" for standard output, and releases it. With a status other
 * than OK, that of what was printed, nothing is written and it is returned. Errors: MEMORY, WRITE.
 */
burnish_status cli_output_end(cli_output *output, const char *path, burnish_status status,
                              burnish_error *error);

/* As cli_shortest: the shortest decimal that reads back as the same float. */
const char *cli_shortest_float(float value, char text[CLI_REAL_SIZE]);

/* Prints text wrapped at `width` columns; lines after the first begin with `indent` blanks, and the
 * first is taken to stand there already. */
void cli_print_wrapped(FILE *stream, const char *text, int indent, int width);

typedef struct cli_column {
    char key[48];     /* of CSV and JSON */
    char heading[32]; /* of text */
    char unit[16];    /* below the heading; "" for none */
    int decimals;     /* of text; below 0: so many significant digits; cells of text: 0 */
    int is_text;
    int is_yes_no; /* cells of numbers: 0 is no, else yes; JSON false and true */
} cli_column;

/* A cell: text where its column says so, otherwise a number, NaN where there is none. */
typedef union cli_value {
    const char *text;
    double number;
} cli_value;

typedef struct cli_table {
    const cli_column *columns;
    cli_value *cells; /* row after row */
    size_t column_count, row_count;
    size_t
        repeated; /* first columns that every part repeats when the text is too wide for a page */
    size_t rows_in_group; /* a blank line after so many rows; 0: none */
} cli_table;

/* Aligned, at most CLI_TEXT_WIDTH columns; columns that do not fit come in further parts.
 */
void cli_table_text(FILE *stream, const cli_table *table);

/* Fields of a line of CSV: text, quoted where it must be; a number, empty for NaN. */
void cli_csv_text(FILE *stream, const char *text);
void cli_csv_real(FILE *stream, double value);

/* Adds an item to an object, or to an array for a NULL key; a NULL item (out of memory) makes
 * *failed 1. */
void cli_json_add(cJSON *object, const char *key, cJSON *item, int *failed);

/* Values: numbers with the digits that read back, null when not finite; counts exactly; seconds to
 * the microsecond, more digits being noise; text with bytes that are not UTF-8, as file names may
 * hold, as '?', since JSON has no other text. NULL when out of memory. */
cJSON *cli_json_real(double value);
cJSON *cli_json_float(float value);
cJSON *cli_json_count(size_t value);
cJSON *cli_json_seconds(double value);
/* What is not UTF-8 becomes ?. NULL gives null. */
cJSON *cli_json_text(const char *text);
/* All bytes, those that RFC 3986 reserves as %XX. */
cJSON *cli_json_bytes(const char *text);
int cli_is_utf8(const char *text);

/* An array of the `size` items that make(values, i) gives; NULL when out of memory. */
cJSON *cli_json_array(size_t size, cJSON *(*make)(const void *values, size_t index),
                      const void *values);
cJSON *cli_json_reals(size_t size, const double *values);
cJSON *cli_json_floats(size_t size, const float *values);
cJSON *cli_json_integers(size_t size, const int *values);
cJSON *cli_json_texts(size_t size, char *const *values);

/* Prints and deletes the object. Errors: MEMORY, also where `failed` is set. */
burnish_status cli_json_print(FILE *stream, cJSON *object, int failed, burnish_error *error);

/* The row of --json. Its target is the name of the file, "-" for standard output, NULL where no
 * JSON is wanted; `section` of the man page lists the keys. */
#define CLI_JSON_FLAG(type, member, text, section)                                                 \
    .name = "json", .common = 1, .value = "FILE", .optional = 1, .help = text,                     \
    .manual = "Writes one JSON object to _FILE_, or to standard output where *=*_FILE_ is left "   \
              "out; see *" section "*.",                                                           \
    .handler = cli_flag_file, .takes_file = 1, .offset = offsetof(type, member)

/* A table and what a command says besides. */
typedef struct cli_document {
    const char *rows_key; /* of the rows in JSON, an array of objects; NULL: they are left out */
    void (*print_text)(FILE *stream, const cli_table *table, const void *context);
    void (*add_keys)(cJSON *root, const void *context, int *failed); /* JSON before the rows */
    const void *context; /* of both, which may be NULL */
} cli_document;

/* Writes it to a file, "-" for standard output: as text what print_text prints, without one the
 * table; as CSV a line of keys and the rows; as JSON one object that begins with the version; as
 * Markdown the table in GitHub's form. Errors: MEMORY, WRITE. */
burnish_status cli_document_write(const cli_document *document, const cli_table *table,
                                  cli_format format, const char *path, burnish_error *error);

#endif
