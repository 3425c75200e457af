/* The subcommand `lobe plot`: from a figure's name to a chart, from a chart to CSV, gnuplot or SVG.
 */
#ifndef TOOL_PLOT_PLOT_H
#define TOOL_PLOT_PLOT_H

#include <stdio.h>

#include "burnish/theory.h"
#include "cli/options.h"
#include "lobe/lobe.h"

enum {
    PLOT_LIST_MAX = 32,   /* items of --exponents, --lobes, --bits */
    PLOT_SERIES_MAX = 48, /* curves of a figure */
    PLOT_POINTS = 241,    /* of a curve */
    PLOT_NOTES_MAX = 64,
    PLOT_BANDS_MAX = 8,
    PLOT_TICKS_MAX = 64,
    PLOT_LOBE_SIZE = LOBE_NAME,
    PLOT_TEXT_SIZE = 96
};

/* The inks, each with a form for light and one for dark pages (lobe_plot_ink.c). */
typedef enum plot_ink {
    PLOT_INK_TEXT,
    PLOT_INK_AXIS,
    PLOT_INK_GRID,
    PLOT_INK_REFERENCE, /* the power */
    PLOT_INK_LOBE,      /* the first of PLOT_LOBE_INKS hues for lobes */
    PLOT_LOBE_INKS = 7,
    PLOT_INK_RAMP = PLOT_INK_LOBE + PLOT_LOBE_INKS,
    PLOT_RAMP_INKS = 8, /* an ordered ramp, for numbers */
    PLOT_INK_COUNT = PLOT_INK_RAMP + PLOT_RAMP_INKS
} plot_ink;

typedef struct plot_color {
    const char *light, *dark; /* "#rrggbb" */
} plot_color;

extern const plot_color plot_inks[PLOT_INK_COUNT];
extern const plot_color plot_panel; /* what is behind everything */

/* The ink for item i of `count` ordered ones, spread over the ramp. */
int plot_ramp_ink(size_t i, size_t count);

typedef enum plot_style {
    PLOT_LINE,
    PLOT_DASHED,
    PLOT_STAIRS, /* thin */
    PLOT_DOTTED,
    PLOT_DASH_DOT,
    PLOT_DISCS,
    PLOT_RINGS
} plot_style;

typedef struct plot_series {
    char name[PLOT_TEXT_SIZE]; /* for the CSV */
    char text[PLOT_TEXT_SIZE]; /* for the figure, gnuplot's enhanced text; "" for none */
    int ink;
    plot_style style;
    size_t count;
    double x[PLOT_POINTS], y[PLOT_POINTS]; /* y NaN: a gap */
} plot_series;

/* Text at the upper right of a point; texts of one column are kept apart. */
typedef struct plot_note {
    char text[PLOT_TEXT_SIZE];
    double x, y;
    int ink;
} plot_note;

typedef struct plot_tick {
    double at;
    int minor;
    char text[32]; /* enhanced */
} plot_tick;

typedef struct plot_axis {
    const char *title;  /* enhanced text */
    const char *column; /* heading in the CSV */
    int logarithmic;
    double low, high; /* both 0: from the data */
    plot_tick ticks[PLOT_TICKS_MAX];
    size_t tick_count; /* 0: made from the range */
} plot_axis;

/* A line across the chart that curves are read against. */
typedef struct plot_rule {
    const char *text; /* NULL: no rule */
    double y;
} plot_rule;

/* Columns of the chart under one heading, up to where the next band begins. */
typedef struct plot_band {
    const char *text;
    double low;
} plot_band;

typedef struct plot_chart {
    const char *name, *title;
    char condition[PLOT_TEXT_SIZE]; /* what holds for all curves, behind the title of y */
    int width, height;              /* px */
    int labels_at_end;              /* 1: names stand at the curves' right ends; 0: in a key */
    int key_inside; /* 1: the key is in the lower right corner, not beside the plot */
    plot_axis x, y;
    plot_rule rule;
    plot_series series[PLOT_SERIES_MAX];
    size_t series_count;
    plot_note notes[PLOT_NOTES_MAX];
    size_t note_count;
    plot_band bands[PLOT_BANDS_MAX];
    size_t band_count;
} plot_chart;

/* What a figure is drawn for. */
typedef struct plot_request {
    double exponents[PLOT_LIST_MAX];
    size_t exponent_count;
    char lobes[PLOT_LIST_MAX][PLOT_LOBE_SIZE];
    size_t lobe_count;
    double bits[PLOT_LIST_MAX];
    size_t bits_count;
    int width, height;
    int lenient; /* 1: lobes or exponents are the figure's own, which need not all fit the others */
} plot_request;

/* One figure. Defaults are lists as the flags read them; NULL: the figure has no use for the flag.
 * exponents_are_range, bits_are_range: the axis runs from the least to the greatest of the list. */
typedef struct plot_figure {
    const char *name, *title;
    const char *exponents, *lobes, *bits;
    int exponents_are_range, bits_are_range;
    int single_exponent; /* 1: takes one exponent only */
    int width, height;
    /* Fills a chart that is zero but for name, title and size; NULL: a picture, see below. */
    burnish_status (*fill)(const plot_request *request, plot_chart *chart, burnish_error *error);
} plot_figure;

/* All figures; `index` past the end gives NULL. */
const plot_figure *plot_figure_at(size_t index);

/* Says in the chart which exponent all its curves are for: the request's first. */
void plot_state_exponent(const plot_request *request, plot_chart *chart);

/* The figure `cost` (lobe_plot_cost.c). */
burnish_status plot_fill_cost(const plot_request *request, plot_chart *chart, burnish_error *error);

/* The lobe of a word at an exponent; messages begin with --lobes. */
burnish_status plot_model(const char *word, double exponent, burnish_theory_model *model,
                          burnish_error *error);

/* Adds a series without points; NULL after an error. */
plot_series *plot_add_series(plot_chart *chart, burnish_error *error);

/* Ranges and ticks of both axes from the data, where the figure does not give them. */
void plot_finish_axes(plot_chart *chart);

/* The least size, in px, that leaves room for the names and some for the curves. */
int plot_least_width(const plot_chart *chart);
int plot_least_height(const plot_chart *chart);

/* Writes the points as CSV, or the script that makes gnuplot draw them on standard output. */
void plot_write_data(const plot_chart *chart, FILE *file);
void plot_write_script(const plot_chart *chart, FILE *file);

/* Runs gnuplot on a script and makes its SVG fit for light and dark pages. *svg is allocated. */
burnish_status plot_run(const plot_chart *chart, const char *script, size_t length, char **svg,
                        size_t *size, burnish_error *error);

/* The figure `object`: an object shaded with each lobe and how each differs from the first, as PNG,
 * or with data 1 the differences as CSV. */
burnish_status plot_object(const plot_request *request, int data, const char *path,
                           burnish_error *error);

#endif
