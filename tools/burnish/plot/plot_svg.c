/* From a script to an SVG: gnuplot as a child process, its drawing made fit for light and dark
 * pages. */
#include <errno.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plot/plot.h"

static const char advice[] =
    "install it (Debian: gnuplot-nox), or take --format=gp to another machine, or --format=csv";

static burnish_status fail_run(burnish_error *error, int code) {
    if (code == ENOENT) {
        return cli_fail(error, BURNISH_STATUS_WRITE,
                        "gnuplot: not found, and it draws the figures; %s", advice);
    }
    return cli_fail(error, BURNISH_STATUS_WRITE, "gnuplot: can't be started: %s", strerror(code));
}

/* Starts gnuplot with files as its three standard streams. The environment holds what matters
 * only, so that no locale, start-up file or default of the user changes a byte. */
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

static int wait_for(pid_t child) {
    int status;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            return -1;
        }
    }
    return status;
}

/* Everything in a temporary file, zero-terminated; NULL without memory. */
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

/* gnuplot's complaint: the line that begins with "line N:", else the first that says something. */
static burnish_status fail_gnuplot(FILE *complaints, burnish_error *error) {
    size_t size = 0;
    char *text = read_stream(complaints, &size);
    const char *line = text ? strstr(text, "line ") : NULL;
    line = line ? line : text ? text + strspn(text, "\n\t ^") : "";
    cli_fail(error, BURNISH_STATUS_WRITE, "gnuplot: failed: %.*s; version 5.4 is known to work",
             (int)strcspn(line, "\n"), line);
    free(text);
    return error->status;
}

/* The rules that replace an ink on dark pages, for each of gnuplot's ways to write one that the
 * drawing has. */
static void write_rules(const plot_color *color, const char *svg, FILE *file) {
    unsigned rgb = (unsigned)strtoul(color->light + 1, NULL, 16);
    unsigned red = rgb >> 16, green = rgb >> 8 & 255, blue = rgb & 255;
    char wide[32], narrow[32];
    snprintf(wide, sizeof wide, "rgb(%3u, %3u, %3u)", red, green, blue);
    snprintf(narrow, sizeof narrow, "rgb(%u,%u,%u)", red, green, blue);
    if (strstr(svg, wide)) {
        fprintf(file, "[stroke=\"%s\"]{stroke:%s}[color=\"%s\"]{color:%s}\n", wide, color->dark,
                wide, color->dark);
    }
    if (strstr(svg, narrow)) {
        fprintf(file, "[fill=\"%s\"]{fill:%s}\n", narrow, color->dark);
    }
}

/* Copies the drawing and keeps the spaces beside changes of font, which some readers drop. */
static void write_texts(const char *svg, FILE *file) {
    static const char plain[] = "<text>", keeping[] = "<text xml:space=\"preserve\">";
    const char *next;
    while ((next = strstr(svg, plain)) != NULL) {
        fwrite(svg, 1, (size_t)(next - svg), file);
        fputs(keeping, file);
        svg = next + strlen(plain);
    }
    fputs(svg, file);
}

/* Puts a panel behind the drawing and a style sheet that turns both dark where the page is. */
static burnish_status dress(const plot_chart *chart, const char *raw, char **svg, size_t *size,
                            burnish_error *error) {
    static const char start[] = "<title>", end[] = "</title>";
    const char *title = strstr(raw, start), *rest = title ? strstr(title, end) : NULL;
    if (!rest) {
        return cli_fail(error, BURNISH_STATUS_WRITE,
                        "gnuplot: wrote no SVG; version 5.4 is known to work");
    }
    FILE *file = open_memstream(svg, size);
    if (!file) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the figure");
    }
    fwrite(raw, 1, (size_t)(title - raw), file);
    fprintf(file, "<title>%s</title>\n<style>\n", chart->title);
    fprintf(file, "text,tspan{font-family:\"DejaVu Sans\",Verdana,sans-serif}\n");
    fprintf(file, "@media (prefers-color-scheme:dark){\n.panel{fill:%s}\n", plot_panel.dark);
    for (int i = 0; i < PLOT_INK_COUNT; ++i) {
        write_rules(&plot_inks[i], rest, file);
    }
    fprintf(file,
            "}\n</style>\n<rect class=\"panel\" width=\"%d\" height=\"%d\" rx=\"8\" fill=\"%s\"/>",
            chart->width, chart->height, plot_panel.light);
    write_texts(rest + strlen(end), file);
    int failed = ferror(file);
    if (fclose(file) != 0 || failed) {
        free(*svg);
        *svg = NULL;
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the figure");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status run(FILE *streams[3], const plot_chart *chart, char **svg, size_t *size,
                          burnish_error *error) {
    pid_t child;
    int code = spawn_gnuplot(streams, &child);
    if (code != 0) {
        return fail_run(error, code);
    }
    int status = wait_for(child);
    if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        /* Older C libraries start a child first and let it exit with 127 when there is no program.
         */
        return status != -1 && WIFEXITED(status) && WEXITSTATUS(status) == 127
                   ? fail_run(error, ENOENT)
                   : fail_gnuplot(streams[2], error);
    }
    size_t raw_size = 0;
    char *raw = read_stream(streams[1], &raw_size);
    if (!raw) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the figure");
    }
    burnish_status result = dress(chart, raw, svg, size, error);
    free(raw);
    return result;
}

burnish_status plot_run(const plot_chart *chart, const char *script, size_t length, char **svg,
                        size_t *size, burnish_error *error) {
    FILE *streams[3] = {tmpfile(), tmpfile(), tmpfile()};
    burnish_status status = BURNISH_STATUS_OK;
    *svg = NULL;
    if (!streams[0] || !streams[1] || !streams[2] ||
        fwrite(script, 1, length, streams[0]) != length || fflush(streams[0]) != 0 ||
        fseek(streams[0], 0, SEEK_SET) != 0) {
        status = cli_fail(error, BURNISH_STATUS_WRITE,
                          "temporary file: can't be written: %s; free some space", strerror(errno));
    }
    if (status == BURNISH_STATUS_OK) {
        status = run(streams, chart, svg, size, error);
    }
    for (int i = 0; i < 3; ++i) {
        if (streams[i]) {
            fclose(streams[i]);
        }
    }
    return status;
}
