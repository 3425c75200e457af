/* Measured samples of a lobe, read from CSV. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/lobe.h"
#include "lobe/samples.h"

enum { LINE_BYTES = 4096, SAMPLES_MAX = 1000000, INPUT_BYTES_MAX = 1 << 28 };

typedef struct reader {
    const char *path;
    FILE *file;
    lobe_unit unit;
    size_t line, bytes;
    int seen_heading;
    burnish_error *error;
} reader;

/* Result of reading a line. */
typedef enum line_result { LINE_READ, LINE_END, LINE_FAILED } line_result;

static line_result fail_line(reader *r, burnish_status status, const char *what) {
    cli_fail(r->error, status, "%.200s:%zu: %s", r->path, r->line, what);
    return LINE_FAILED;
}

/* Reads the next line without its end (LF, CR LF or CR). */
static line_result next_line(reader *r, char line[LINE_BYTES]) {
    size_t length = 0;
    int c;
    ++r->line;
    while ((c = getc(r->file)) != EOF && c != '\n' && c != '\r') {
        if (c == 0) {
            return fail_line(r, BURNISH_STATUS_FORMAT,
                             "a zero byte: not a text file; give CSV with angle and intensity");
        }
        if (length + 1 == LINE_BYTES) {
            return fail_line(
                r, BURNISH_STATUS_FORMAT,
                "the line is longer than 4095 bytes; give angle and intensity, one pair per line");
        }
        line[length++] = (char)c;
    }
    line[length] = 0;
    r->bytes += length + 1;
    if (ferror(r->file)) {
        cli_fail(r->error, cli_errno_status(errno), "%.200s: can't be read: %s", r->path,
                 strerror(errno));
        return LINE_FAILED;
    }
    if (c == EOF && length == 0) {
        return LINE_END;
    }
    if (c == '\r' && (c = getc(r->file)) != '\n' && c != EOF) {
        ungetc(c, r->file);
    }
    return r->bytes > INPUT_BYTES_MAX
               ? fail_line(r, BURNISH_STATUS_LIMIT,
                           "more than 256 MiB; give fewer samples, or only two columns")
               : LINE_READ;
}

/* Trims blanks and quotes around a field. */
typedef struct field {
    const char *text;
    size_t length;
} field;

static int is_blank(char c) {
    return c == ' ' || c == '\t';
}

static field trim(const char *text, size_t length) {
    while (length > 0 && is_blank(*text)) {
        ++text;
        --length;
    }
    while (length > 0 && is_blank(text[length - 1])) {
        --length;
    }
    if (length >= 2 && text[0] == '"' && text[length - 1] == '"') {
        ++text;
        length -= 2;
    }
    return (field){text, length};
}

/* Splits a line into fields and keeps two. The separator is the first of semicolon, comma and tab
 * that occurs in the line, else runs of blanks. */
static size_t split(const char *line, field fields[2]) {
    char separator = strchr(line, ';')    ? ';'
                     : strchr(line, ',')  ? ','
                     : strchr(line, '\t') ? '\t'
                                          : ' ';
    size_t count = 0;
    line += strspn(line, separator == ' ' ? " " : "");
    for (const char *rest = line; rest;) {
        const char *item;
        size_t length = cli_next_item(&rest, separator, &item);
        if (count < 2) {
            fields[count] = trim(item, length);
        }
        ++count;
        if (rest && separator == ' ') {
            rest += strspn(rest, " ");
            rest = *rest ? rest : NULL;
        }
    }
    return count;
}

static int is_passed_over(const char *line) {
    line += strspn(line, " \t");
    return !*line || *line == '#';
}

/* 1 - cosine of the first field. */
static burnish_status read_lambda(const reader *r, double x, double *lambda) {
    double radians = r->unit == LOBE_UNIT_DEGREES ? x * CLI_DEGREE : x;
    if (r->unit == LOBE_UNIT_COSINE) {
        *lambda = 1 - x;
        return fabs(x) <= 1 ? BURNISH_STATUS_OK
                            : cli_fail(r->error, BURNISH_STATUS_FORMAT,
                                       "%.200s:%zu: the cosine %g is not from -1 to 1; use "
                                       "--unit=deg or rad for angles",
                                       r->path, r->line, x);
    }
    double half = sin(radians / 2);
    *lambda = 2 * half * half;
    if (fabs(radians) > 2 * CLI_RIGHT_ANGLE * (1 + 1e-12)) {
        return cli_fail(r->error, BURNISH_STATUS_FORMAT,
                        "%.200s:%zu: the angle %g is not from %s; is --unit right?", r->path,
                        r->line, x,
                        r->unit == LOBE_UNIT_DEGREES ? "-180 to 180 degrees" : "-pi to pi radians");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status store(reader *r, lobe_samples *samples, double x, double intensity) {
    double lambda;
    burnish_status status = read_lambda(r, x, &lambda);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (samples->count == SAMPLES_MAX) {
        fail_line(r, BURNISH_STATUS_LIMIT, "more than 1000000 samples; give fewer");
        return r->error->status;
    }
    if (samples->count == samples->capacity) {
        size_t capacity = samples->capacity > 0 ? 2 * samples->capacity : 256;
        lobe_sample *grown = realloc(samples->items, capacity * sizeof *grown);
        if (!grown) {
            return cli_fail(r->error, BURNISH_STATUS_MEMORY, "out of memory for %zu samples",
                            capacity);
        }
        samples->items = grown;
        samples->capacity = capacity;
    }
    samples->items[samples->count++] = (lobe_sample){x, lambda, intensity};
    return BURNISH_STATUS_OK;
}

static burnish_status fail_field(const reader *r, field f, const char *what) {
    const char *advice =
        memchr(f.text, ',', f.length) ? "; write numbers with a decimal point" : "";
    return cli_fail(r->error, BURNISH_STATUS_FORMAT,
                    "%.200s:%zu: the %s \"%.*s\" is not a number%s", r->path, r->line, what,
                    f.length < 40 ? (int)f.length : 40, f.text, advice);
}

/* A line that is neither empty nor a comment. */
static burnish_status read_pair(reader *r, const char *line, lobe_samples *samples) {
    field fields[2] = {{"", 0}, {"", 0}};
    double x, intensity;
    size_t count = split(line, fields);
    int has_x = cli_read_real(fields[0].text, fields[0].length, &x);
    int has_intensity = cli_read_real(fields[1].text, fields[1].length, &intensity);
    int may_be_heading = samples->count == 0 && !r->seen_heading;
    if (!has_x && !has_intensity && may_be_heading) {
        r->seen_heading = 1;
        return BURNISH_STATUS_OK;
    }
    if (count != 2) {
        return cli_fail(r->error, BURNISH_STATUS_FORMAT,
                        "%.200s:%zu: %zu field%s; give two: angle and intensity", r->path, r->line,
                        count, count == 1 ? "" : "s");
    }
    if (!has_x) {
        return fail_field(r, fields[0], r->unit == LOBE_UNIT_COSINE ? "cosine" : "angle");
    }
    return has_intensity ? store(r, samples, x, intensity) : fail_field(r, fields[1], "intensity");
}

static burnish_status read_all(reader *r, lobe_samples *samples) {
    char line[LINE_BYTES];
    for (;;) {
        line_result result = next_line(r, line);
        if (result != LINE_READ) {
            return result == LINE_END ? BURNISH_STATUS_OK : r->error->status;
        }
        const char *text = line;
        if (r->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0) {
            text += 3; /* the byte order mark that spreadsheets write */
        }
        burnish_status status =
            is_passed_over(text) ? BURNISH_STATUS_OK : read_pair(r, text, samples);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
}

burnish_status lobe_read_samples(const char *path, lobe_unit unit, lobe_samples *samples,
                                 burnish_error *error) {
    int is_stdin = strcmp(path, "-") == 0;
    reader r = {.path = is_stdin ? "standard input" : path,
                .file = is_stdin ? stdin : fopen(path, "rb"),
                .unit = unit,
                .error = error};
    *samples = (lobe_samples){0};
    if (!r.file) {
        return cli_fail(error, cli_errno_status(errno), "%.200s: can't be opened: %s", path,
                        strerror(errno));
    }
    burnish_status status = read_all(&r, samples);
    if (!is_stdin) {
        fclose(r.file);
    }
    return status;
}
