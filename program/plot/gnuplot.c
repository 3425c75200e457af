/* Writes charts as CSV and gnuplot scripts, runs gnuplot, and adapts its drawing to light and dark
 * pages. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#ifndef _WIN32
#include <spawn.h>
#include <sys/wait.h>
#endif

#include "base/cli/output.h"
#include "plot/figures.h"
#include "plot/gnuplot.h"

/* ---- Input of gnuplot ---- */

static const char *script_text(const char *name) {
    const plot_script *script = plot_scripts;
    while (strcmp(script->name, name) != 0) {
        ++script;
    }
    return script->text;
}

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

void plot_write_script(const plot_chart *chart, const plot_figure *figure, int is_png, FILE *file) {
    char id[32]; /* letters, digits and _ */
    snprintf(id, sizeof id, "%s", chart->name);
    for (char *c = id; *c; ++c) {
        *c = *c == '-' ? '_' : *c;
    }
    fprintf(file,
            "# %s. Made by burnish lobe plot %s; gnuplot 5.4 writes the drawing to standard "
            "output.\nid = \"%s\"\nformat = \"%s\"\nwidth = %d.0\nheight = %d.0\n"
            "panel = \"%s\"\ncondition = \"%s\"\nlines = %zu\n",
            chart->title, chart->name, id, is_png ? "png" : "svg", chart->width, chart->height,
            figure->panel ? figure->panel : "", chart->condition, chart->series_count);
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
    fprintf(file, "EOD\n\n%s\n%s", script_text(figure->script), script_text("style"));
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
    "install it (Debian: gnuplot-nox), or take --format=gp to another machine, or --format=csv";

static burnish_status fail_run(burnish_error *error, int code) {
    if (code == ENOENT) {
        return cli_fail(error, BURNISH_STATUS_WRITE,
                        "gnuplot: not found, but needed to draw figures; %s", advice);
    }
    return cli_fail(error, BURNISH_STATUS_WRITE, "gnuplot: can't be started: %s", strerror(code));
}

#ifdef _WIN32
/* Not supported here: behaves as if gnuplot were not installed. */
static int spawn_gnuplot(FILE *streams[3], pid_t *child) {
    (void)streams, (void)child;
    return ENOENT;
}

static int wait_for(pid_t child) {
    (void)child;
    return -1;
}
#else
/* Starts gnuplot with files as its three standard streams. The environment is minimal:
 * no locale, start-up file or user default can change the output. */
static int spawn_gnuplot(FILE *streams[3], pid_t *child) {
    char path[4096] = "PATH=";
    char locale[] = "LC_ALL=C";
    char *environment[] = {path, locale, NULL};
    char name[] = "gnuplot", defaults[] = "--default-settings", from[] = "-";
    char *arguments[] = {name, defaults, from, NULL};
    const char *search = getenv("PATH");
    snprintf(path, sizeof path, "PATH=%s", search ? search : "/usr/local/bin:/usr/bin:/bin");
    posix_spawn_file_actions_t actions;
    int code = posix_spawn_file_actions_init(&actions);
    if (code != 0) {
        return code;
    }
    for (int i = 0; i < 3 && code == 0; ++i) {
        code = posix_spawn_file_actions_adddup2(&actions, fileno(streams[i]), i);
    }
    if (code == 0) {
        code = posix_spawnp(child, "gnuplot", &actions, NULL, arguments, environment);
    }
    posix_spawn_file_actions_destroy(&actions);
    return code;
}

/* Waits for gnuplot. Returns its exit code, or -1. */
static int wait_for(pid_t child) {
    int status;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            return -1;
        }
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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

/* Finds gnuplot's error message: the line that begins with "line N:", else the first non-empty one. */
static burnish_status fail_gnuplot(FILE *complaints, burnish_error *error) {
    size_t size = 0;
    char *text = read_stream(complaints, &size);
    const char *line = text ? strstr(text, "line ") : NULL;
    while (line && strncmp(line + strcspn(line, ":"), ": warning", 9) == 0) {
        line = strstr(line + 1, "line ");
    }
    line = line ? line : text ? text + strspn(text, "\n\t ^") : "";
    cli_fail(error, BURNISH_STATUS_WRITE, "gnuplot: failed: %.*s; version 5.4 is known to work",
             (int)strcspn(line, "\n"), line);
    free(text);
    return error->status;
}

static burnish_status run(FILE *streams[3], char **drawing, size_t *size, burnish_error *error) {
    pid_t child;
    int code = spawn_gnuplot(streams, &child);
    if (code != 0) {
        return fail_run(error, code);
    }
    int exit_code = wait_for(child);
    if (exit_code == 127) { /* older C libraries fork before they search for the program */
        return fail_run(error, ENOENT);
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

burnish_status plot_run(const char *script, size_t length, char **drawing, size_t *size,
                        burnish_error *error) {
    FILE *streams[3] = {tmpfile(), tmpfile(), tmpfile()};
    burnish_status status = BURNISH_STATUS_OK;
    *drawing = NULL;
    if (!streams[0] || !streams[1] || !streams[2] ||
        fwrite(script, 1, length, streams[0]) != length || fflush(streams[0]) != 0 ||
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
        fprintf(file, "[stroke=\"%s\"]{stroke:%.7s}[color=\"%s\"]{color:%.7s}\n", wide, dark, wide,
                dark);
    }
    if (strstr(svg, narrow)) {
        fprintf(file, "[fill=\"%s\"]{fill:%.7s}\n", narrow, dark);
    }
    if ((strstr(svg, "fill=\"#ffffff\"") || strstr(svg, "fill=\"#FFFFFF\"")) &&
        strncmp(light, "#ffffff", 7) == 0) {
        fprintf(file, "[fill=\"#ffffff\"],[fill=\"#FFFFFF\"]{fill:%.7s}\n", dark);
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

/* The two lists of inks in figures/style.gp, side by side. */
static void write_dark_rules(const char *svg, FILE *file) {
    const char *style = script_text("style");
    const char *light = strchr(strstr(style, "\nlight = "), '#');
    const char *dark = strchr(strstr(style, "\ndark = "), '#');
    for (; *light == '#' && *dark == '#'; light += 8, dark += 8) {
        write_rules(light, dark, svg, file);
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
    write_dark_rules(rest, file);
    fprintf(file, "}\n</style>%s", rest + strlen(end));
    status = cli_output_close(&output, error);
    free(raw);
    *svg = output.text;
    *size = output.size;
    return status;
}
