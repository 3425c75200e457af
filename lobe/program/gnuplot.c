/* Writes charts as CSV and as numbers for figures.gp, runs gnuplot, and adapts its drawing to light
 * and dark pages. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#ifndef _WIN32
#include <signal.h>
#include <sys/wait.h>
#endif

#include "base/cli/output.h"
#include "base/cli/process.h"
#include "program/figures.h"

/* Inks on light and on dark pages: text, axis, grid, paper, cos^n; seven hues for lobes; eight steps for
 * numbers. Source of the hues: Okabe and Ito 2008, which people with any colour vision distinguish;
 * darkened or lightened to a contrast of at least 3 to 1. The steps differ in lightness, so their order
 * survives in grey. */
static const char *const inks[][2] = {
    {"#2f363f", "#c9d1d9"}, {"#6a737d", "#7d8791"}, {"#e7eaee", "#2a313a"}, {"#ffffff", "#161b22"},
    {"#1b1f24", "#f0f3f6"}, {"#0072b2", "#58a6e8"}, {"#d55e00", "#f5874a"}, {"#008561", "#33c39a"},
    {"#aa4f8d", "#de8fc0"}, {"#a87400", "#e3ad3e"}, {"#6f3b00", "#d8b48c"}, {"#767676", "#a0a7ae"},
    {"#440154", "#c886e0"}, {"#463480", "#a394f2"}, {"#365c8d", "#79a8f0"}, {"#277f8e", "#55bcd0"},
    {"#1a8f78", "#45cfa8"}, {"#2f9a50", "#7ad97f"}, {"#6b951c", "#b5d64e"}, {"#c77700", "#ffb454"},
};
enum { INK_COUNT = sizeof inks / sizeof *inks };

/* ---- Input of gnuplot ---- */

static void write_integers(const char *name, const plot_chart *chart, size_t offset, FILE *file) {
    fprintf(file, "array %s[%zu] = [", name, chart->series_count);
    for (size_t i = 0; i < chart->series_count; ++i) {
        const char *series = (const char *)&chart->series[i];
        fprintf(file, "%s%d", i > 0 ? ", " : "", *(const int *)(const void *)(series + offset));
    }
    fprintf(file, "]\n");
}

/* Approximate number of visible letters, without markup and font names. */
static size_t visible_letters(const char *text) {
    size_t length = 0;
    for (; *text; ++text) {
        text += strncmp(text, "{/:Italic ", 10) == 0 ? 10 : 0;
        length += !strchr("{}_^", *text) && ((unsigned char)*text & 0xC0) != 0x80;
    }
    return length;
}

/* The last drawn value of a curve. */
static double end_of(const plot_series *series) {
    size_t last = series->count;
    while (last > 0 && !isfinite(series->y[last - 1])) {
        --last;
    }
    return last > 0 ? series->y[last - 1] : 0;
}

/* The ends of the x axes, and least and greatest y; greatest > 0. */
static void write_ranges(const plot_chart *chart, FILE *file) {
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < chart->series_count; ++i) {
        for (size_t k = 0; k < chart->series[i].count; ++k) {
            double y = chart->series[i].y[k];
            low = y < low ? y : low;
            high = y > high && isfinite(y) ? y : high;
        }
    }
    high = high > 1e-12 ? high : 1; /* no values, or only rounding errors */
    low = low < high ? low : high;
    fprintf(file, "x_low = %.9g\nx_high = %.9g\ny_low = %.9g\ny_high = %.9g\n", chart->x_low,
            chart->x_high, low, high);
}

static void write_points(const plot_series *series, FILE *file) {
    for (size_t k = 0; k < series->count; ++k) {
        if (isfinite(series->y[k])) {
            fprintf(file, "%.7g %.7g\n", series->x[k], series->y[k]);
        } else {
            fprintf(file, "%.7g NaN\n", series->x[k]);
        }
    }
    fprintf(file, "\n\n");
}

void plot_write_numbers(const plot_chart *chart, int is_png, FILE *file) {
    char id[32]; /* letters, digits and _ */
    snprintf(id, sizeof id, "%s", chart->name);
    for (char *c = id; *c; ++c) {
        *c = *c == '-' ? '_' : *c;
    }
    fprintf(file,
            "# %s. Made by burnish-lobe plot %s; gnuplot -c figures.gp THIS draws it.\n"
            "figure = \"%s\"\nid = \"%s\"\nformat = \"%s\"\nwidth = %d.0\nheight = %d.0\n"
            "panel = \"%s\"\ncondition = \"%s\"\nlines = %zu\nlight = \"",
            chart->title, chart->name, chart->name, id, is_png ? "png" : "svg", chart->width,
            chart->height, chart->panel ? chart->panel : "", chart->condition, chart->series_count);
    for (size_t i = 0; i < INK_COUNT; ++i) {
        fprintf(file, "%s%s", i > 0 ? " " : "", inks[i][0]);
    }
    fprintf(file, "\"\n");
    write_integers("color", chart, offsetof(plot_series, ink), file);
    write_integers("dash", chart, offsetof(plot_series, dash), file);
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        if (i == 0) {
            fprintf(file, "array text[lines]\narray letters[lines]\narray end_y[lines]\n");
        }
        fprintf(file, "text[%zu] = \"%s\"; letters[%zu] = %zu; end_y[%zu] = %.9g\n", i + 1,
                series->text, i + 1, visible_letters(series->text), i + 1, end_of(series));
    }
    write_ranges(chart, file);
    fprintf(file, "$data << EOD\n");
    for (size_t i = 0; i < chart->series_count; ++i) {
        write_points(&chart->series[i], file);
    }
    fprintf(file, "EOD\n");
}

void plot_write_data(const plot_chart *chart, FILE *file) {
    fprintf(file, "series,%s,%s\n", chart->x_column, chart->y_column);
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        for (size_t k = 0; k < series->count; ++k) {
            if (isfinite(series->y[k])) {
                fprintf(file, "%s,%.10g,%.10g\n", series->name, series->x[k], series->y[k]);
            }
        }
    }
}

static const char advice[] =
    "install it (Debian: gnuplot-nox), or take --format=gp and figures.gp to another machine, or "
    "--format=csv";

static burnish_status fail_run(burnish_error *error, int code) {
    if (code == ENOENT) {
        return cli_fail(error, BURNISH_STATUS_WRITE,
                        "gnuplot: not found, but needed to draw figures; %s", advice);
    }
    return cli_fail(error, BURNISH_STATUS_WRITE, "gnuplot: can't be started: %s", strerror(code));
}

#ifdef _WIN32
/* Not supported here: behaves as if gnuplot were not installed. */
static burnish_status run_gnuplot(FILE *streams[3], int *code, burnish_error *error) {
    (void)streams, (void)code;
    return fail_run(error, ENOENT);
}
#else
/* Finds figures.gp: BURNISH_FIGURES, or the installed file, or the one in the program's own folder, as
 * in a build. */
static int find_figures(char path[CLI_PATH_SIZE]) {
    static const char *const places[] = {"/" BURNISH_FIGURES_FOLDER, ""};
    const char *given = getenv("BURNISH_FIGURES");
    char folder[CLI_PATH_SIZE];
    if (given && *given) {
        return snprintf(path, CLI_PATH_SIZE, "%s", given) < CLI_PATH_SIZE;
    }
    const int is_known = cli_program_folder(folder, sizeof folder);
    for (size_t i = 0; is_known && i < sizeof places / sizeof *places; ++i) {
        if (snprintf(path, CLI_PATH_SIZE, "%s%s/figures.gp", folder, places[i]) < CLI_PATH_SIZE &&
            access(path, R_OK) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Runs gnuplot with files as its three standard streams. The environment is minimal: no locale,
 * start-up file or user default can change the output. *code is the exit code; -1: ended otherwise. */
static burnish_status run_gnuplot(FILE *streams[3], int *code, burnish_error *error) {
    char program[CLI_PATH_SIZE], figures[CLI_PATH_SIZE], path[CLI_PATH_SIZE];
    char locale[] = "LC_ALL=C";
    char *minimal[] = {path, locale, NULL};
    const char *const arguments[] = {"gnuplot", "--default-settings", "-c",
                                     figures,   "/dev/stdin",         NULL};
    if (!find_figures(figures)) {
        return cli_fail(
            error, BURNISH_STATUS_WRITE,
            "figures.gp: not found beside the program; name the file in BURNISH_FIGURES");
    }
    if (!cli_find_program(arguments[0], program)) {
        return fail_run(error, ENOENT);
    }
    const char *search = getenv("PATH");
    snprintf(path, sizeof path, "PATH=%s", search ? search : "");
    const pid_t child =
        cli_fork(&(cli_plan){.kept = {fileno(streams[0]), fileno(streams[1]), fileno(streams[2])},
                             .count = 3,
                             .ended_by = SIGKILL});
    if (child == 0) {
        environ = minimal;
        cli_execute(program, arguments);
    }
    if (child < 0) {
        return fail_run(error, errno);
    }
    const int state = cli_wait(child);
    *code = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
    return BURNISH_STATUS_OK;
}
#endif

/* Reads a whole temporary file, zero-terminated; NULL: out of memory. */
static char *read_stream(FILE *file, size_t *size) {
    struct stat state;
    if (fstat(fileno(file), &state) != 0) {
        return NULL;
    }
    *size = (size_t)state.st_size;
    char *text = malloc(*size + 1);
    if (!text) {
        return NULL;
    }
    rewind(file);
    *size = fread(text, 1, *size, file);
    text[*size] = 0;
    return text;
}

/* gnuplot's message is the last line that it prints. */
static burnish_status fail_gnuplot(FILE *complaints, burnish_error *error) {
    size_t size = 0;
    char *text = read_stream(complaints, &size);
    while (size > 0 && strchr("\n\t ^", text[size - 1])) {
        text[--size] = 0;
    }
    const char *line = text ? strrchr(text, '\n') : NULL;
    cli_fail(error, BURNISH_STATUS_WRITE, "gnuplot: failed: %s; version 5.4 is known to work",
             line   ? line + 1
             : text ? text
                    : "");
    free(text);
    return error->status;
}

static burnish_status run(FILE *streams[3], char **drawing, size_t *size, burnish_error *error) {
    int exit_code = 0;
    const burnish_status status = run_gnuplot(streams, &exit_code, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (exit_code != 0) {
        return fail_gnuplot(streams[2], error);
    }
    *drawing = read_stream(streams[1], size);
    if (!*drawing) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the figure");
    }
    return *size > 0 ? BURNISH_STATUS_OK
                     : cli_fail(error, BURNISH_STATUS_WRITE,
                                "gnuplot: wrote no drawing; version 5.4 is known to work");
}

burnish_status plot_run(const char *numbers, size_t length, char **drawing, size_t *size,
                        burnish_error *error) {
    FILE *streams[3] = {tmpfile(), tmpfile(), tmpfile()};
    burnish_status status = BURNISH_STATUS_OK;
    *drawing = NULL;
    if (!streams[0] || !streams[1] || !streams[2] ||
        fwrite(numbers, 1, length, streams[0]) != length || fflush(streams[0]) != 0 ||
        fseek(streams[0], 0, SEEK_SET) != 0) {
        status = cli_fail(error, BURNISH_STATUS_WRITE,
                          "temporary file: can't be written: %s; free some space", strerror(errno));
    }
    if (status == BURNISH_STATUS_OK) {
        status = run(streams, drawing, size, error);
    }
    for (int i = 0; i < 3; ++i) {
        if (streams[i]) {
            fclose(streams[i]);
        }
    }
    return status;
}

/* ---- Dark pages ---- */

/* Writes rules that replace an ink, for each notation of it in the drawing. */
static void write_rules(const char *light, const char *dark, const char *svg, FILE *file) {
    unsigned rgb = (unsigned)strtoul(light + 1, NULL, 16);
    unsigned red = rgb >> 16, green = rgb >> 8 & 255, blue = rgb & 255;
    char wide[32], narrow[32];
    snprintf(wide, sizeof wide, "rgb(%3u, %3u, %3u)", red, green, blue);
    snprintf(narrow, sizeof narrow, "rgb(%u,%u,%u)", red, green, blue);
    if (strstr(svg, wide)) {
        fprintf(file, "[stroke=\"%s\"]{stroke:%s}[color=\"%s\"]{color:%s}\n", wide, dark, wide,
                dark);
    }
    if (strstr(svg, narrow)) {
        fprintf(file, "[fill=\"%s\"]{fill:%s}\n", narrow, dark);
    }
    if ((strstr(svg, "fill=\"#ffffff\"") || strstr(svg, "fill=\"#FFFFFF\"")) &&
        strcmp(light, "#ffffff") == 0) {
        fprintf(file, "[fill=\"#ffffff\"],[fill=\"#FFFFFF\"]{fill:%s}\n", dark);
    }
}

/* gnuplot raises superscripts by 0.5 letters and lowers subscripts by 0.3, too much within a line of
 * text. Reduces both to 3/4 without changing the length of the drawing. */
static void settle_scripts(char *svg) {
    static const char *const shifts[][2] = {{"dy=\"-6.50", "dy=\"-4.90"},
                                            {"dy=\"6.50", "dy=\"4.90"},
                                            {"dy=\"-3.90", "dy=\"-2.90"},
                                            {"dy=\"3.90", "dy=\"2.90"}};
    for (char *at = strstr(svg, "dy=\""); at; at = strstr(at + 1, "dy=\"")) {
        for (size_t i = 0; i < sizeof shifts / sizeof shifts[0]; ++i) {
            size_t length = strlen(shifts[i][0]);
            if (strncmp(at, shifts[i][0], length) == 0) {
                memcpy(at, shifts[i][1], length);
                break;
            }
        }
    }
}

burnish_status plot_dress(const plot_chart *chart, char **svg, size_t *size, burnish_error *error) {
    static const char root[] = "<svg ", start[] = "<title>", end[] = "</title>";
    char *raw = *svg;
    settle_scripts(raw);
    const char *body = strstr(raw, root), *title = body ? strstr(body, start) : NULL;
    const char *rest = title ? strstr(title, end) : NULL;
    if (!rest) {
        return cli_fail(error, BURNISH_STATUS_WRITE,
                        "gnuplot: wrote no drawing; version 5.4 is known to work");
    }
    cli_output output;
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    FILE *file = output.stream;
    /* keeps spaces next to font changes, which some viewers drop */
    fprintf(file, "%.*s<svg xml:space=\"preserve\" ", (int)(body - raw), raw);
    body += strlen(root);
    fprintf(file, "%.*s<title>%s</title>\n<style>\n", (int)(title - body), body, chart->title);
    fprintf(file, "text,tspan{font-family:\"DejaVu Sans\",Verdana,sans-serif}\n"
                  "@media (prefers-color-scheme:dark){\n");
    for (size_t i = 0; i < INK_COUNT; ++i) {
        write_rules(inks[i][0], inks[i][1], rest, file);
    }
    fprintf(file, "}\n</style>%s", rest + strlen(end));
    status = cli_output_close(&output, error);
    free(raw);
    *svg = output.text;
    *size = output.size;
    return status;
}
