/* `burnish-lobe plot`: the paper's figures and our own, drawn from code for any lobes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/core.h"
#include "program/figures.h"
#include "program/lobe.h"

typedef struct plot_settings {
    const char *exponents, *lobes, *bits, *output;
    int size[2]; /* 0,0: the figure's own */
    int format;
} plot_settings;

typedef enum plot_format {
    FORMAT_NONE,
    FORMAT_SVG,
    FORMAT_PNG,
    FORMAT_CSV,
    FORMAT_NUMBERS
} plot_format;

static const cli_word format_words[] = {{"svg", FORMAT_SVG},
                                        {"png", FORMAT_PNG},
                                        {"csv", FORMAT_CSV},
                                        {"gp", FORMAT_NUMBERS},
                                        {NULL, 0}};

enum {
    WIDTH = 720,
    HEIGHT = 440,
    CHART_WIDTH_MIN = 400,
    CHART_HEIGHT_MIN = 250,
    SIZE_MIN = 160,
    SIZE_MAX_PX = 4096,
    BITS_MAX = 64
};

static cli_work plot;

#define TARGET(member) .offset = offsetof(plot_settings, member)

static const cli_flag plot_flags[] = {
    {.group = "Contents",
     CLI_FLAG("exponents", "LIST", "from 1 to 65536, such as 3,10,30; or the ends of the axis",
              cli_flag_text, exponents),
     .default_label = "the figure's own",
     .manual = "Exponents to plot, between commas, or ranges as in *burnish-lobe table*. In "
               "figures whose horizontal axis is the exponent "
               "the axis runs from the least to the greatest of them."},
    {CLI_FLAG("lobes", "LIST", "such as power,energy:2,schlick", cli_flag_text, lobes),
     .default_label = "the figure's own",
     .manual = "Lobes to plot, between commas, in the words of *burnish-lobe table*."},
    {CLI_FLAG("bits", "LIST", "thresholds q: a lobe ends at 2^-q; ratio, widths", cli_flag_text,
              bits),
     .default_label = "the figure's own",
     .manual = "Thresholds of the figure *ratio*, from above 0 to 64 bits, between commas; for "
               "*widths* the range of the axis."},

    {.group = "Output",
     CLI_FLAG("output", "FILE", "output file; - is standard output", cli_flag_text, output),
     .letter = 'o',
     .file = CLI_REPORTS,
     .default_label = "FIGURE.svg",
     .manual = "File to write, whole or not at all; *-* is standard output, the default for "
               "*--format=csv* and *--format=gp*. Extensions: _.svg_, _.png_, _.csv_, _.gp_."},
    {CLI_FLAG("size", "W,H", "in pixels", cli_flag_size, size), CLI_RANGE(SIZE_MIN, SIZE_MAX_PX),
     .default_label = "by figure, most 720,440",
     .manual = "Width and height in pixels, from 400,250 to 4096,4096."},
    {CLI_FLAG("format", "WORD", "output format", cli_flag_word, format),
     .default_label = "by FILE's extension, else the drawing",
     .manual = "*svg* and *png* write the drawing (svg has a light and a dark theme), *csv* the "
               "points of the curves, *gp* the numbers from which *gnuplot -c figures.gp* draws. "
               "Default: by FILE's extension.",
     .words = format_words},
};

static const cli_example plot_examples[] = {
    {"burnish-lobe plot curves --exponents=50", "the paper's figure 3 for another exponent"},
    {"burnish-lobe plot error --lobes=energy:4 -o error.svg", "another lobe"},
    {"burnish-lobe plot ratio --bits=8,10 --format=csv", "the numbers of a figure"},
    {NULL, NULL},
};

const cli_command lobe_plot_command = {
    .name = "plot",
    .operand = "FIGURE",
    .summary = "the paper's figures and our own, as SVG by gnuplot",
    .operand_help = "the paper's error, curves, core, ratio, w1, w1-extreme (figures 2 to 6);\n"
                    "          cost, energy, orders, widths, radius, polygon, rough",
    .manual =
        "Computes and draws a figure. The paper's figures: *error* (2, "
        "absolute error of W against the angle), *curves* (3, cos^n, W and Schlick's function), "
        "*core* (4, largest relative error up to the inflection), *ratio* (5, R "
        "against the exponent), *w1* and *w1-extreme* (6, W1 with cos^n, and its extreme relative "
        "error).\n"
        "Other figures: *cost* (error of every lobe against its cost), *energy* (against the "
        "exponent), *orders* (error of every order), *widths* (R against the threshold), *radius* "
        "(radius of curvature against the angle), *polygon* (error of the evaluations of a "
        "polygon's "
        "light, for the order of the lobe), *rough* (GGX and sums of lobes).\n"
        "gnuplot draws the figures, by the installed file figures.gp or another one that "
        "BURNISH_FIGURES names; without it the command ends with exit code 7. "
        "Output is reproducible with the same version of gnuplot.",
    .operands_max = 1,
    .flags = plot_flags,
    .flag_count = sizeof plot_flags / sizeof *plot_flags,
    .examples = plot_examples,
    .settings_size = sizeof(plot_settings),
    .work = plot,
};

static burnish_status fail_count(const char *flag, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d items; leave some out",
                    flag, PLOT_LIST_MAX);
}

static burnish_status add_number(const char *flag, double value, plot_list *list,
                                 burnish_error *error) {
    if (list->count == PLOT_LIST_MAX) {
        return fail_count(flag, error);
    }
    list->low = list->count == 0 || value < list->low ? value : list->low;
    list->high = list->count == 0 || value > list->high ? value : list->high;
    list->items[list->count++] = value;
    return BURNISH_STATUS_OK;
}

static burnish_status read_exponents(const char *text, plot_list *list, burnish_error *error) {
    lobe_exponents exponents;
    burnish_status status = lobe_read_exponents("exponents", text, &exponents, error);
    for (size_t i = 0; status == BURNISH_STATUS_OK && i < exponents.count; ++i) {
        status = add_number("exponents", exponents.items[i], list, error);
    }
    free(exponents.items);
    return status;
}

static burnish_status read_bits(const char *text, plot_list *list, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    while (text && status == BURNISH_STATUS_OK) {
        const char *item;
        double value = 0;
        size_t length = cli_next_item(&text, ',', &item);
        if (!cli_read_real(item, length, &value) || !(value > 0 && value <= BITS_MAX)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--bits: \"%.*s\" is not a number above 0 up to %d",
                            (int)(length < 60 ? length : 60), item, BITS_MAX);
        }
        status = add_number("bits", value, list, error);
    }
    return status;
}

static burnish_status check_lists(const plot_figure *figure, const plot_request *request,
                                  burnish_error *error) {
    if (figure->axis != PLOT_AXIS_ANGLES && figure->axis != PLOT_AXIS_EXPONENTS &&
        request->exponents.count > 1) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--exponents: the figure %s is drawn for one exponent", figure->name);
    }
    if (figure->axis == PLOT_AXIS_EXPONENTS && request->exponents.low == request->exponents.high) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--exponents: the figure %s has an axis of exponents; give its two "
                        "ends, such as 2,1000",
                        figure->name);
    }
    if (figure->axis == PLOT_AXIS_BITS && request->bits.low == request->bits.high) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--bits: the figure %s has an axis of bits; give its two ends, "
                        "such as 1,16",
                        figure->name);
    }
    return BURNISH_STATUS_OK;
}

/* A figure's default lobes fit its default exponents; other exponents may be too low for some
 * orders. */
static void keep_existing_lobes(plot_request *request) {
    lobe_names *lobes = &request->lobes;
    size_t kept = 0;
    for (size_t i = 0; i < lobes->count; ++i) {
        burnish_theory_model model;
        if (burnish_theory_model_parse(lobes->items[i], request->exponents.high, &model, NULL) ==
            BURNISH_STATUS_OK) {
            memmove(lobes->items[kept++], lobes->items[i], sizeof lobes->items[i]);
        }
    }
    lobes->count = kept;
}

static burnish_status make_request(const plot_figure *figure, const plot_settings *settings,
                                   plot_request *request, burnish_error *error) {
    if (settings->bits && !figure->bits) {
        burnish_error line;
        cli_fail(&line, BURNISH_STATUS_OK, "--bits: no effect: the figure %s has no thresholds",
                 figure->name);
        cli_warn(line.text);
    }
    if (settings->size[0] > 0 &&
        (settings->size[0] < CHART_WIDTH_MIN || settings->size[1] < CHART_HEIGHT_MIN)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--size: the names in the figure %s take %d,%d or more", figure->name,
                        CHART_WIDTH_MIN, CHART_HEIGHT_MIN);
    }
    request->lenient = !settings->lobes || !settings->exponents;
    request->width = settings->size[0] > 0 ? settings->size[0]
                     : figure->width       ? figure->width
                                           : WIDTH;
    request->height = settings->size[0] > 0 ? settings->size[1]
                      : figure->height      ? figure->height
                                            : HEIGHT;
    burnish_status status = read_exponents(
        settings->exponents ? settings->exponents : figure->exponents, &request->exponents, error);
    if (status == BURNISH_STATUS_OK) {
        status = lobe_read_lobes("lobes", settings->lobes ? settings->lobes : figure->lobes,
                                 &request->lobes, error);
    }
    if (status == BURNISH_STATUS_OK && request->lobes.count > PLOT_LIST_MAX) {
        status = fail_count("lobes", error);
    }
    if (status == BURNISH_STATUS_OK && figure->bits) {
        status = read_bits(settings->bits ? settings->bits : figure->bits, &request->bits, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_lists(figure, request, error);
    }
    if (status == BURNISH_STATUS_OK && !settings->lobes) {
        keep_existing_lobes(request);
    }
    return status;
}

/* Writes the chart as CSV or numbers, or the drawing that gnuplot makes of the numbers. */
static burnish_status write_chart(const plot_chart *chart, plot_format format, const char *path,
                                  burnish_error *error) {
    cli_output output;
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (format == FORMAT_CSV) {
        plot_write_data(chart, output.stream);
    } else {
        plot_write_numbers(chart, format == FORMAT_PNG, output.stream);
    }
    if (format == FORMAT_CSV || format == FORMAT_NUMBERS) {
        return cli_output_end(&output, path, status, error);
    }
    char *drawing = NULL;
    size_t size = 0;
    status = cli_output_close(&output, error);
    if (status == BURNISH_STATUS_OK) {
        status = plot_run(output.text, output.size, &drawing, &size, error);
    }
    if (status == BURNISH_STATUS_OK && format == FORMAT_SVG) {
        status = plot_dress(chart, &drawing, &size, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_file_write(path, drawing, size, error);
    }
    free(drawing);
    free(output.text);
    return status;
}

static burnish_status draw_chart(const plot_figure *figure, const plot_request *request,
                                 plot_format format, const char *path, burnish_error *error) {
    plot_chart *chart = calloc(1, sizeof *chart);
    if (!chart) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the figure");
    }
    chart->name = figure->name;
    chart->title = figure->title;
    chart->panel = figure->panel;
    chart->y_column = figure->y_column;
    chart->width = request->width;
    chart->height = request->height;
    burnish_status status = plot_fill(figure, request, chart, error);
    if (status == BURNISH_STATUS_OK) {
        status = write_chart(chart, format, path, error);
    }
    free(chart);
    return status;
}

static const char *figure_name_at(const void *list, size_t index) {
    const plot_figure *figure = plot_figure_at(index);
    (void)list;
    return figure ? figure->name : NULL;
}

static const plot_figure *find_figure(const char *name, burnish_error *error) {
    const plot_figure *figure;
    for (size_t i = 0; (figure = plot_figure_at(i)) != NULL; ++i) {
        if (strcmp(figure->name, name) == 0) {
            return figure;
        }
    }
    cli_fail_unknown(error, "plot", "figure", name, figure_name_at, NULL,
                     "burnish-lobe plot --help");
    return NULL;
}

/* The format for a file extension; FORMAT_NONE: unknown. */
static plot_format format_of_path(const char *path) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    if (!dot || strcmp(path, "-") == 0) {
        return FORMAT_SVG;
    }
    for (const cli_word *word = format_words; word->name; ++word) {
        if (strcmp(dot + 1, word->name) == 0) {
            return (plot_format)word->value;
        }
    }
    return FORMAT_NONE;
}

static burnish_status plot(void *from, cli_call *call, burnish_error *error) {
    const plot_settings *settings = from;
    plot_request request = {0};
    char default_path[32];
    plot_format format = settings->format   ? (plot_format)settings->format
                         : settings->output ? format_of_path(settings->output)
                                            : FORMAT_SVG;
    if (call->operand_count == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "plot: no FIGURE; try \"burnish-lobe plot curves\" or "
                        "\"burnish-lobe plot --help\"");
    }
    const plot_figure *figure = find_figure(call->operands[0], error);
    if (!figure) {
        return error->status;
    }
    if (format == FORMAT_NONE) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: the figure %s is written as svg, png, csv or gp", figure->name);
    }
    burnish_status status = make_request(figure, settings, &request, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    snprintf(default_path, sizeof default_path, "%s.%s", figure->name,
             format == FORMAT_PNG ? "png" : "svg");
    int drawing = format == FORMAT_SVG || format == FORMAT_PNG;
    const char *path = settings->output ? settings->output : drawing ? default_path : "-";
    return draw_chart(figure, &request, format, path, error);
}
