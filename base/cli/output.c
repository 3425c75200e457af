/* Output of commands: whole files, tables and numbers as text, Markdown, CSV and JSON. */
#include "base/cli/output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/file.h"
#include "base/cli/platform.h"
#include "base/show_text.h"
#include "burnish/core.h"

const cli_word cli_format_words[] = {
    {"text", CLI_FORMAT_TEXT}, {"csv", CLI_FORMAT_CSV}, {"json", CLI_FORMAT_JSON}, {NULL, 0}};
const cli_word cli_table_format_words[] = {{"text", CLI_FORMAT_TEXT},
                                           {"csv", CLI_FORMAT_CSV},
                                           {"json", CLI_FORMAT_JSON},
                                           {"markdown", CLI_FORMAT_MARKDOWN},
                                           {NULL, 0}};

enum { CELL_SIZE = 64 };

/* ---- Outputs ---- */

burnish_status cli_output_begin(cli_output *output, burnish_error *error) {
    *output = (cli_output){0};
    output->stream = cli_open_memory(&output->text, &output->size);
    return output->stream ? BURNISH_STATUS_OK
                          : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the output");
}

burnish_status cli_output_end(cli_output *output, const char *path, burnish_status status,
                              burnish_error *error) {
    if (cli_close_memory(output->stream, &output->text, &output->size) != 0 &&
        status == BURNISH_STATUS_OK) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the output");
    }
    if (status == BURNISH_STATUS_OK) {
        status = cli_file_write(path, output->text, output->size, error);
    }
    free(output->text);
    return status;
}

/* ---- Numbers and words ---- */

const char *cli_shortest_float(float value, char text[CLI_REAL_SIZE]) {
    for (int digits = 6; digits <= 9; ++digits) {
        snprintf(text, CLI_REAL_SIZE, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) {
            break;
        }
    }
    return text;
}

void cli_print_wrapped(FILE *stream, const char *text, int indent, int width) {
    int at = indent;
    while (*text) {
        int length = (int)strcspn(text, " ");
        if (at > indent && at + 1 + length > width) {
            fprintf(stream, "\n%*s", indent, "");
            at = indent;
        } else if (at > indent) {
            fputc(' ', stream);
            ++at;
        }
        fprintf(stream, "%.*s", length, text);
        at += length;
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', stream);
}

/* ---- Tables for reading ---- */

/* Numbers that would round to almost 0 are printed with two significant digits. */
static void format_number(const cli_column *column, double value, char text[CELL_SIZE]) {
    double magnitude = fabs(value);
    if (isnan(value)) {
        strcpy(text, "-");
    } else if (isinf(value)) {
        strcpy(text, value > 0 ? "inf" : "-inf");
    } else if (magnitude < 1e-13) { /* rounding noise */
        snprintf(text, CELL_SIZE, "%.*f", column->decimals > 0 ? column->decimals : 0, 0.0);
    } else if (column->decimals < 0) {
        snprintf(text, CELL_SIZE, "%.*g", -column->decimals, value);
    } else if (magnitude >= 1e9 ||
               (column->decimals > 0 && magnitude * pow(10, column->decimals) < 9.5)) {
        snprintf(text, CELL_SIZE, "%.2g", value);
    } else {
        snprintf(text, CELL_SIZE, "%.*f", column->decimals, value);
    }
}

static const cli_value *cell_of(const cli_table *table, size_t row, size_t column) {
    return &table->cells[row * table->column_count + column];
}

/* The cell as readable text; a number is written to `number`. */
static const char *cell_text(const cli_table *table, size_t row, size_t column,
                             char number[CELL_SIZE]) {
    const cli_value *cell = cell_of(table, row, column);
    if (table->columns[column].is_text) {
        return cell->text;
    }
    if (table->columns[column].is_yes_no) {
        return cell->number != 0 ? "yes" : "no";
    }
    format_number(&table->columns[column], cell->number, number);
    return number;
}

/* Row numbers of the two lines above the rows. */
static const size_t HEADINGS = SIZE_MAX, UNITS = SIZE_MAX - 1;

static const char *line_text(const cli_table *table, size_t line, size_t column,
                             char number[CELL_SIZE]) {
    return line == HEADINGS ? table->columns[column].heading
           : line == UNITS  ? table->columns[column].unit
                            : cell_text(table, line, column, number);
}

static int column_width(const cli_table *table, size_t column) {
    const cli_column *c = &table->columns[column];
    size_t width = strlen(c->heading) > strlen(c->unit) ? strlen(c->heading) : strlen(c->unit);
    for (size_t row = 0; row < table->row_count; ++row) {
        char number[CELL_SIZE];
        size_t length = strlen(cell_text(table, row, column, number));
        width = length > width ? length : width;
    }
    return (int)width;
}

/* The columns of one part: the repeated columns and first to end - 1. */
typedef struct part {
    const cli_table *table;
    const int *widths;
    size_t first, end;
} part;

static int shown(const part *p, size_t column) {
    return column < p->table->repeated || (column >= p->first && column < p->end);
}

/* Prints a row of the part, or the line of headings or units, without trailing blanks. */
static void print_line(FILE *stream, const part *p, size_t line) {
    int blanks = 0;
    for (size_t i = 0; i < p->table->column_count; ++i) {
        char number[CELL_SIZE];
        if (!shown(p, i)) {
            continue;
        }
        const char *text = line_text(p->table, line, i, number);
        int length = (int)strlen(text), left = p->widths[i] - length;
        int is_text = p->table->columns[i].is_text || p->table->columns[i].is_yes_no;
        blanks += is_text ? 0 : left;
        if (length > 0) {
            fprintf(stream, "%*s%s", blanks, "", text);
            blanks = 0;
        }
        blanks += (is_text ? left : 0) + 2;
    }
    fputc('\n', stream);
}

static void print_rule(FILE *stream, const part *p) {
    int first = 1;
    for (size_t i = 0; i < p->table->column_count; ++i) {
        if (shown(p, i)) {
            fprintf(stream, "%s", first ? "" : "  ");
            for (int k = 0; k < p->widths[i]; ++k) {
                fputc('-', stream);
            }
            first = 0;
        }
    }
    fputc('\n', stream);
}

static void print_part(FILE *stream, const part *p) {
    int has_units = 0;
    for (size_t i = 0; i < p->table->column_count; ++i) {
        has_units = has_units || (shown(p, i) && p->table->columns[i].unit[0]);
    }
    print_line(stream, p, HEADINGS);
    if (has_units) {
        print_line(stream, p, UNITS);
    }
    print_rule(stream, p);
    for (size_t row = 0; row < p->table->row_count; ++row) {
        if (row > 0 && p->table->rows_in_group > 0 && row % p->table->rows_in_group == 0) {
            fputc('\n', stream);
        }
        print_line(stream, p, row);
    }
}

void cli_table_text(FILE *stream, const cli_table *table) {
    int *widths = calloc(table->column_count, sizeof *widths);
    int repeated = 0;
    if (!widths) {
        return;
    }
    for (size_t i = 0; i < table->column_count; ++i) {
        widths[i] = column_width(table, i);
        repeated += i < table->repeated ? widths[i] + 2 : 0;
    }
    for (size_t first = table->repeated; first < table->column_count;) {
        size_t end = first;
        int width = repeated;
        while (end < table->column_count &&
               (end == first || width + widths[end] <= CLI_TEXT_WIDTH)) {
            width += widths[end++] + 2;
        }
        part p = {table, widths, first, end};
        if (first > table->repeated) {
            fputc('\n', stream);
        }
        print_part(stream, &p);
        first = end;
    }
    free(widths);
}

static void print_markdown(FILE *stream, const cli_table *table) {
    for (size_t i = 0; i < table->column_count; ++i) {
        const cli_column *c = &table->columns[i];
        fprintf(stream, "| %s%s%s ", c->heading, c->unit[0] ? ", " : "", c->unit);
    }
    fprintf(stream, "|\n");
    for (size_t i = 0; i < table->column_count; ++i) {
        fprintf(stream, "| %s ", table->columns[i].is_text ? "---" : "---:");
    }
    fprintf(stream, "|\n");
    for (size_t row = 0; row < table->row_count; ++row) {
        for (size_t i = 0; i < table->column_count; ++i) {
            char number[CELL_SIZE];
            fprintf(stream, "| %s ", cell_text(table, row, i, number));
        }
        fprintf(stream, "|\n");
    }
}

/* ---- Tables for programs ---- */

void cli_print_clean(FILE *stream, const char *text, char doubled) {
    for (size_t size; *text; text += size > 0 ? size : 1) {
        size = burnish_printable_size(text);
        if (size == 0 || *text == doubled) {
            fputc(size == 0 ? '?' : doubled, stream);
        }
        fwrite(text, 1, size, stream);
    }
}

void cli_csv_text(FILE *stream, const char *text) {
    const char *quote = strpbrk(text, ",\"") ? "\"" : "";
    fputs(quote, stream);
    cli_print_clean(stream, text, '"');
    fputs(quote, stream);
}

void cli_csv_real(FILE *stream, double value) {
    char text[CLI_REAL_SIZE];
    if (!isnan(value)) {
        fputs(cli_shortest(value, text), stream);
    }
}

static void print_csv(FILE *stream, const cli_table *table) {
    for (size_t i = 0; i < table->column_count; ++i) {
        fprintf(stream, "%s%s", i > 0 ? "," : "", table->columns[i].key);
    }
    fputc('\n', stream);
    for (size_t row = 0; row < table->row_count; ++row) {
        for (size_t i = 0; i < table->column_count; ++i) {
            const cli_value *cell = cell_of(table, row, i);
            fputs(i > 0 ? "," : "", stream);
            if (table->columns[i].is_text) {
                cli_csv_text(stream, cell->text);
            } else if (table->columns[i].is_yes_no) {
                fputs(cell->number != 0 ? "yes" : "no", stream);
            } else {
                cli_csv_real(stream, cell->number);
            }
        }
        fputc('\n', stream);
    }
}

void cli_json_add(cJSON *object, const char *key, cJSON *item, int *failed) {
    if (!item ||
        !(key ? cJSON_AddItemToObject(object, key, item) : cJSON_AddItemToArray(object, item))) {
        cJSON_Delete(item);
        *failed = 1;
    }
}

cJSON *cli_json_real(double value) {
    char text[CLI_REAL_SIZE];
    return isfinite(value) ? cJSON_CreateRaw(cli_shortest(value, text)) : cJSON_CreateNull();
}

cJSON *cli_json_float(float value) {
    char text[CLI_REAL_SIZE];
    return isfinite(value) ? cJSON_CreateRaw(cli_shortest_float(value, text)) : cJSON_CreateNull();
}

cJSON *cli_json_count(size_t value) {
    char text[24];
    snprintf(text, sizeof text, "%zu", value);
    return cJSON_CreateRaw(text);
}

void cli_json_add_outcome(cJSON *object, int code, const char *message, int *failed) {
    cli_json_add(object, "status", cJSON_CreateString(code == 0 ? "done" : "failed"), failed);
    cli_json_add(object, "code", cJSON_CreateNumber(code), failed);
    cli_json_add(object, "error", cli_json_text(message), failed);
}

cJSON *cli_json_seconds(double value) {
    char text[40];
    snprintf(text, sizeof text, "%.6f", value);
    return cJSON_CreateRaw(text);
}

cJSON *cli_json_text(const char *text) {
    if (!text) {
        return cJSON_CreateNull();
    }
    char *copy = strdup(text);
    size_t at = 0;
    while (copy && copy[at]) {
        const size_t length = burnish_character_size(copy + at);
        if (length == 0) {
            copy[at] = '?';
        }
        at += length > 0 ? length : 1;
    }
    cJSON *item = copy ? cJSON_CreateString(copy) : NULL;
    free(copy);
    return item;
}

cJSON *cli_json_bytes(const char *text) {
    static const char plain[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    char *escaped = malloc(3 * strlen(text) + 1), *to = escaped;
    for (const char *c = text; escaped && *c; ++c) {
        to += strchr(plain, *c) ? sprintf(to, "%c", *c) : sprintf(to, "%%%02X", (unsigned char)*c);
    }
    cJSON *item = escaped ? cJSON_CreateString(escaped) : NULL;
    free(escaped);
    return item;
}

int cli_is_utf8(const char *text) {
    size_t length = 1;
    while (*text && length > 0) {
        length = burnish_character_size(text);
        text += length;
    }
    return length > 0;
}

cJSON *cli_json_array(size_t size, cJSON *(*make)(const void *values, size_t index),
                      const void *values) {
    int failed = 0;
    cJSON *array = cJSON_CreateArray();
    for (size_t i = 0; i < size && !failed; ++i) {
        cli_json_add(array, NULL, make(values, i), &failed);
    }
    if (failed) {
        cJSON_Delete(array);
        return NULL;
    }
    return array;
}

static cJSON *real_at(const void *values, size_t i) {
    return cli_json_real(((const double *)values)[i]);
}
static cJSON *float_at(const void *values, size_t i) {
    return cli_json_float(((const float *)values)[i]);
}
static cJSON *integer_at(const void *values, size_t i) {
    return cJSON_CreateNumber(((const int *)values)[i]);
}
static cJSON *text_at(const void *values, size_t i) {
    return cli_json_text(((char *const *)values)[i]);
}

cJSON *cli_json_reals(size_t size, const double *values) {
    return cli_json_array(size, real_at, values);
}
cJSON *cli_json_floats(size_t size, const float *values) {
    return cli_json_array(size, float_at, values);
}
cJSON *cli_json_integers(size_t size, const int *values) {
    return cli_json_array(size, integer_at, values);
}
cJSON *cli_json_texts(size_t size, char *const *values) {
    return cli_json_array(size, text_at, values);
}

static cJSON *cell_json(const cli_column *column, const cli_value *cell) {
    return column->is_text     ? cli_json_text(cell->text)
           : column->is_yes_no ? cJSON_CreateBool(cell->number != 0)
                               : cli_json_real(cell->number);
}

static cJSON *rows_json(const cli_table *table, int *failed) {
    cJSON *rows = cJSON_CreateArray();
    for (size_t row = 0; row < table->row_count && !*failed; ++row) {
        cJSON *object = cJSON_CreateObject();
        for (size_t i = 0; i < table->column_count && !*failed; ++i) {
            const cli_value *cell = cell_of(table, row, i);
            cli_json_add(object, table->columns[i].key, cell_json(&table->columns[i], cell),
                         failed);
        }
        cli_json_add(rows, NULL, object, failed);
    }
    return rows;
}

char *cli_json_string(cJSON *object, int failed, int is_wrapped) {
    char *text = failed ? NULL : is_wrapped ? cJSON_Print(object) : cJSON_PrintUnformatted(object);
    size_t count = 0;
    cJSON_Delete(object);
    for (const char *c = text; c && *c; ++c) {
        count += burnish_control_code(c) >= 0x7F;
    }
    if (!text || count == 0) {
        return text;
    }
    char *escaped = malloc(strlen(text) + 5 * count + 1),
         *to = escaped; /* "\u009b" for 1 to 3 bytes */
    for (const char *c = text; escaped && *c;) {
        const unsigned code = burnish_control_code(c);
        const size_t known = burnish_character_size(c), size = known > 0 ? known : 1;
        if (code >= 0x7F) { /* cJSON escapes lower ones, except those between items */
            to += sprintf(to, "\\u%04x", code);
        } else {
            memcpy(to, c, size);
            to += size;
        }
        c += size;
    }
    if (escaped) {
        *to = 0;
    }
    free(text);
    return escaped;
}

burnish_status cli_json_print(FILE *stream, cJSON *object, int failed, burnish_error *error) {
    char *text = cli_json_string(object, failed, 1);
    if (!text) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the JSON output");
    }
    fprintf(stream, "%s\n", text);
    free(text);
    return BURNISH_STATUS_OK;
}

static burnish_status print_json(FILE *stream, const cli_document *document, const cli_table *table,
                                 burnish_error *error) {
    int failed = 0;
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), &failed);
    if (document->add_keys) {
        document->add_keys(root, document->context, &failed);
    }
    if (document->rows_key) {
        cli_json_add(root, document->rows_key, rows_json(table, &failed), &failed);
    }
    return cli_json_print(stream, root, failed, error);
}

burnish_status cli_document_write(const cli_document *document, const cli_table *table,
                                  cli_format format, const char *path, burnish_error *error) {
    cli_output output;
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    switch (format) {
    case CLI_FORMAT_TEXT:
        if (document->print_text) {
            document->print_text(output.stream, table, document->context);
        } else {
            cli_table_text(output.stream, table);
        }
        break;
    case CLI_FORMAT_MARKDOWN:
        print_markdown(output.stream, table);
        break;
    case CLI_FORMAT_CSV:
        print_csv(output.stream, table);
        break;
    case CLI_FORMAT_JSON:
        status = print_json(output.stream, document, table, error);
        break;
    }
    return cli_output_end(&output, path, status, error);
}
