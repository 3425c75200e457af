/* Output of commands: whole files, tables and numbers as text, Markdown, CSV and JSON. */
#ifndef BASE_CLI_OUTPUT_H
#define BASE_CLI_OUTPUT_H

#include <cjson/cJSON.h>
#include <stdio.h>

#include "base/cli/options.h"
#include "base/cli/values.h"

typedef enum cli_format {
    CLI_FORMAT_TEXT,
    CLI_FORMAT_CSV,
    CLI_FORMAT_JSON,
    CLI_FORMAT_MARKDOWN
} cli_format;

/* text, csv and json; the second also has markdown. */
extern const cli_word cli_format_words[];
extern const cli_word cli_table_format_words[];

enum { CLI_TEXT_WIDTH = 100, CLI_CELLS_MAX = 1 << 22 };

/* An output, which is written when it is complete. */
typedef struct cli_output {
    FILE *stream; /* print to this */
    char *text;
    size_t size;
} cli_output;

/* Errors: MEMORY. */
burnish_status cli_output_begin(cli_output *output, burnish_error *error);

/* Writes the whole text to a file, "-" for standard output, and releases it. If `status` is not OK,
 * nothing is written and it is returned. Errors: MEMORY, WRITE. */
burnish_status cli_output_end(cli_output *output, const char *path, burnish_status status,
                              burnish_error *error);

/* As cli_shortest: the shortest decimal that reads back as the same float. */
const char *cli_shortest_float(float value, char text[CLI_REAL_SIZE]);

/* Prints text wrapped at `width` columns. The first line starts at column `indent`, and the others
 * begin with `indent` blanks. */
void cli_print_wrapped(FILE *stream, const char *text, int indent, int width);

typedef struct cli_column {
    char key[48];     /* of CSV and JSON */
    char heading[32]; /* of text */
    char unit[16];    /* below the heading; "" for none */
    int decimals;     /* of numbers; below 0: -decimals significant digits; 0 for text */
    int is_text;
    int is_yes_no; /* cells are numbers: 0 is no or false, others are yes or true */
} cli_column;

/* A cell: text or a number, as its column says; NaN for a missing number. */
typedef union cli_value {
    const char *text;
    double number;
} cli_value;

typedef struct cli_table {
    const cli_column *columns;
    cli_value *cells; /* row after row */
    size_t column_count, row_count;
    size_t repeated;      /* first columns, repeated in every part of a table that is too wide */
    size_t rows_in_group; /* rows between blank lines; 0: no blank lines */
} cli_table;

/* Aligned, at most CLI_TEXT_WIDTH characters wide; further columns are in further parts. */
void cli_table_text(FILE *stream, const cli_table *table);

/* Prints text as cli_clean leaves it; each `doubled` twice, 0: none. */
void cli_print_clean(FILE *stream, const char *text, char doubled);

/* Fields of a line of CSV: text, cleaned, quoted if necessary; a number, empty for NaN. */
void cli_csv_text(FILE *stream, const char *text);
void cli_csv_real(FILE *stream, double value);

/* Adds an item to an object, or to an array if key is NULL. Sets *failed to 1 if the item is NULL
 * (out of memory). */
void cli_json_add(cJSON *object, const char *key, cJSON *item, int *failed);

/* JSON values; NULL when out of memory. Numbers have enough digits to read back exactly, and null
 * if they are not finite; counts are exact; seconds have microseconds. */
cJSON *cli_json_real(double value);
cJSON *cli_json_float(float value);
cJSON *cli_json_count(size_t value);
cJSON *cli_json_seconds(double value);
/* Adds the keys that finished and failed runs share: status, code, and error, NULL if there is none. */
void cli_json_add_outcome(cJSON *object, int code, const char *message, int *failed);

/* Bytes that are not UTF-8, as in some file names, become '?'. NULL gives null. */
cJSON *cli_json_text(const char *text);
/* All bytes; bytes that RFC 3986 reserves as %XX. */
cJSON *cli_json_bytes(const char *text);
int cli_is_utf8(const char *text);

/* An array of the `size` items that make(values, i) gives; NULL when out of memory. */
cJSON *cli_json_array(size_t size, cJSON *(*make)(const void *values, size_t index),
                      const void *values);
cJSON *cli_json_reals(size_t size, const double *values);
cJSON *cli_json_floats(size_t size, const float *values);
cJSON *cli_json_integers(size_t size, const int *values);
cJSON *cli_json_texts(size_t size, char *const *values);

/* The object as text, on one line unless is_wrapped, and deletes it. Control characters are escaped,
 * also those that JSON allows as they are, such as U+009B: a terminal obeys them. Release with free.
 * NULL: out of memory, also where `failed` is set. */
char *cli_json_string(cJSON *object, int failed, int is_wrapped);

/* Prints and deletes the object. Errors: MEMORY. */
burnish_status cli_json_print(FILE *stream, cJSON *object, int failed, burnish_error *error);

/* The row of --json. Its target is the name of the file, "-" for standard output, NULL for no JSON;
 * `section` of the man page lists the keys. */
#define CLI_JSON_FLAG(type, member, text, section)                                                 \
    .name = "json", .common = 1, .value = "FILE", .optional = 1, .help = text,                     \
    .manual =                                                                                      \
        "Writes one JSON object to _FILE_, or to standard output without *=*_FILE_; see *" section \
        "*.",                                                                                      \
    .handler = cli_flag_file, .file = CLI_REPORTS, .offset = offsetof(type, member)

/* A table and the text around it. */
typedef struct cli_document {
    const char *rows_key; /* of the rows in JSON, an array of objects; NULL: no rows */
    void (*print_text)(FILE *stream, const cli_table *table, const void *context);
    void (*add_keys)(cJSON *root, const void *context, int *failed); /* JSON before the rows */
    const void *context; /* of both, which can be NULL */
} cli_document;

/* Writes it to a file, "-" for standard output. Text is the output of print_text or, without it,
 * the table; CSV is a line of keys and the rows; JSON is one object that begins with the version;
 * Markdown is a table in GitHub's form. Errors: MEMORY, WRITE. */
burnish_status cli_document_write(const cli_document *document, const cli_table *table,
                                  cli_format format, const char *path, burnish_error *error);

#endif
