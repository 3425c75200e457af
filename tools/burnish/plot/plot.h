/* The subcommand `lobe plot`: from a figure's name to a chart, from a chart to CSV, gnuplot or SVG.
 */
#ifndef BURNISH_TOOL_PLOT_PLOT_H
#define BURNISH_TOOL_PLOT_PLOT_H

#include <stdio.h>

#include "burnish/theory.h"
#include "cli/options.h"
#include "lobe/lobe.h"

enum {
    BURNISH_PLOT_LIST_MAX = 32,   /* items of --exponents, --lobes, --bits */
    BURNISH_PLOT_SERIES_MAX = 48, /* curves of a figure */
    BURNISH_PLOT_POINTS = 241,    /* of a curve */
    BURNISH_PLOT_NOTES_MAX = 64,
    BURNISH_PLOT_BANDS_MAX = 8,
    BURNISH_PLOT_TICKS_MAX = 64,
    BURNISH_PLOT_LOBE_SIZE = BURNISH_CLI_LOBE_NAME,
    BURNISH_PLOT_TEXT_SIZE = 96
};

/* The inks, each with a form for light and one for dark pages (lobe_plot_ink.c). */
typedef enum burnish_plot_ink {
    BURNISH_PLOT_INK_TEXT,
    BURNISH_PLOT_INK_AXIS,
    BURNISH_PLOT_INK_GRID,
    BURNISH_PLOT_INK_REFERENCE, /* the power */
    BURNISH_PLOT_INK_LOBE,      /* the first of BURNISH_PLOT_LOBE_INKS hues for lobes */
    BURNISH_PLOT_LOBE_INKS = 7,
    BURNISH_PLOT_INK_RAMP = BURNISH_PLOT_INK_LOBE + BURNISH_PLOT_LOBE_INKS,
    BURNISH_PLOT_RAMP_INKS = 8, /* an ordered ramp, for numbers */
    BURNISH_PLOT_INK_COUNT = BURNISH_PLOT_INK_RAMP + BURNISH_PLOT_RAMP_INKS
} burnish_plot_ink;

typedef struct burnish_plot_color {
    const char *light, *dark; /* "#rrggbb" */
} burnish_plot_color;

extern const burnish_plot_color burnish_plot_inks[BURNISH_PLOT_INK_COUNT];
extern const burnish_plot_color burnish_plot_panel; /* what is behind everything */

/* The ink for item i of `count` ordered ones, spread over the ramp. */
int burnish_plot_ramp_ink(size_t i, size_t count);

typedef enum burnish_plot_style {
    BURNISH_PLOT_LINE,
    BURNISH_PLOT_DASHED,
    BURNISH_PLOT_STAIRS, /* thin */
    BURNISH_PLOT_DOTTED,
    BURNISH_PLOT_DASH_DOT,
    BURNISH_PLOT_DISCS,
    BURNISH_PLOT_RINGS
} burnish_plot_style;

typedef struct burnish_plot_series {
    char name[BURNISH_PLOT_TEXT_SIZE]; /* for the CSV */
    char text[BURNISH_PLOT_TEXT_SIZE]; /* for the figure, gnuplot's enhanced text; "" for none */
    int ink;
    burnish_plot_style style;
    size_t count;
    double x[BURNISH_PLOT_POINTS], y[BURNISH_PLOT_POINTS]; /* y NaN: a gap */
} burnish_plot_series;

/* Text at the upper right of a point; texts of one column are kept apart. */
typedef struct burnish_plot_note {
    char text[BURNISH_PLOT_TEXT_SIZE];
    double x, y;
    int ink;
} burnish_plot_note;

typedef struct burnish_plot_tick {
    double at;
    int minor;
    char text[32]; /* enhanced */
} burnish_plot_tick;

typedef struct burnish_plot_axis {
    const char *title;  /* enhanced text */
    const char *column; /* heading in the CSV */
    int logarithmic;
    double low, high; /* both 0: from the data */
    burnish_plot_tick ticks[BURNISH_PLOT_TICKS_MAX];
    size_t tick_count; /* 0: made from the range */
} burnish_plot_axis;

/* A line across the chart that curves are read against. */
typedef struct burnish_plot_rule {
    const char *text; /* NULL: no rule */
    double y;
} burnish_plot_rule;

/* Columns of the chart under one heading, up to where the next band begins. */
typedef struct burnish_plot_band {
    const char *text;
    double low;
} burnish_plot_band;

typedef struct burnish_plot_chart {
    const char *name, *title;
    char condition[BURNISH_PLOT_TEXT_SIZE]; /* what holds for all curves, behind the title of y */
    int width, height;                      /* px */
    int labels_at_end; /* 1: names stand at the curves' right ends; 0: in a key */
    int key_inside;    /* 1: the key is in the lower right corner, not beside the plot */
    burnish_plot_axis x, y;
    burnish_plot_rule rule;
    burnish_plot_series series[BURNISH_PLOT_SERIES_MAX];
    size_t series_count;
    burnish_plot_note notes[BURNISH_PLOT_NOTES_MAX];
    size_t note_count;
    burnish_plot_band bands[BURNISH_PLOT_BANDS_MAX];
    size_t band_count;
} burnish_plot_chart;

/* What a figure is drawn for. */
typedef struct burnish_plot_request {
    double exponents[BURNISH_PLOT_LIST_MAX];
    size_t exponent_count;
    char lobes[BURNISH_PLOT_LIST_MAX][BURNISH_PLOT_LOBE_SIZE];
    size_t lobe_count;
    double bits[BURNISH_PLOT_LIST_MAX];
    size_t bits_count;
    int width, height;
    int lenient; /* 1: lobes or exponents are the figure's own, which need not all fit the others */
} burnish_plot_request;

/* One figure. Defaults are lists as the flags read them; NULL: the figure has no use for the flag.
 * exponents_are_range, bits_are_range: the axis runs from the least to the greatest of the list. */
typedef struct burnish_plot_figure {
    const char *name, *title;
    const char *exponents, *lobes, *bits;
    int exponents_are_range, bits_are_range;
    int single_exponent; /* 1: takes one exponent only */
    int width, height;
    /* Fills a chart that is zero but for name, title and size; NULL: a picture, see below. */
    burnish_status (*fill)(const burnish_plot_request *request, burnish_plot_chart *chart,
                           burnish_error *error);
} burnish_plot_figure;

/* All figures; `index` past the end gives NULL. */
const burnish_plot_figure *burnish_plot_figure_at(size_t index);

/* Says in the chart which exponent all its curves are for: the request's first. */
void burnish_plot_state_exponent(const burnish_plot_request *request, burnish_plot_chart *chart);

/* The figure `cost` (lobe_plot_cost.c). */
burnish_status burnish_plot_fill_cost(const burnish_plot_request *request,
                                      burnish_plot_chart *chart, burnish_error *error);

/* The lobe of a word at an exponent; messages begin with --lobes. */
burnish_status burnish_plot_model(const char *word, double exponent, burnish_theory_model *model,
                                  burnish_error *error);

/* Adds a series without points; NULL after an error. */
burnish_plot_series *burnish_plot_add_series(burnish_plot_chart *chart, burnish_error *error);

/* Ranges and ticks of both axes from the data, where the figure does not give them. */
void burnish_plot_finish_axes(burnish_plot_chart *chart);

/* The least size, in px, that leaves room for the names and some for the curves. */
int burnish_plot_least_width(const burnish_plot_chart *chart);
int burnish_plot_least_height(const burnish_plot_chart *chart);

/* Writes the points as CSV, or the script that makes gnuplot draw them on standard output. */
void burnish_plot_write_data(const burnish_plot_chart *chart, FILE *file);
void burnish_plot_write_script(const burnish_plot_chart *chart, FILE *file);

/* Runs gnuplot on a script and makes its SVG fit for light and dark pages. *svg is allocated. */
burnish_status burnish_plot_run(const burnish_plot_chart *chart, const char *script, size_t length,
                                char **svg, size_t *size, burnish_error *error);

/* The figure `object`: an object shaded with each lobe and how each differs from the first, as PNG,
 * or with data 1 the differences as CSV. */
burnish_status burnish_plot_object(const burnish_plot_request *request, int data, const char *path,
                                   burnish_error *error);

#endif
