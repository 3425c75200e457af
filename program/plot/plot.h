/* The subcommand `lobe plot`: from a figure's name to numbers, from numbers to CSV, or by gnuplot
 * and the scripts in figures/ to SVG and PNG. */
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
    PLOT_TEXT_SIZE = 96
};

/* Colours, as numbers of the list of inks in figures/style.gp. */
typedef enum plot_ink {
    PLOT_INK_TEXT = 1,
    PLOT_INK_AXIS = 2,
    PLOT_INK_REFERENCE = 5, /* the power */
    PLOT_INK_LOBE = 6,      /* the first of seven hues for lobes */
    PLOT_INK_RAMP = 13,     /* the first of eight steps for numbers */
    PLOT_RAMP_INKS = 8
} plot_ink;

/* Dashes, as figures/style.gp numbers them. */
typedef enum plot_dash {
    PLOT_LINE = 1,
    PLOT_DASHED,
    PLOT_DASH_DOT,
    PLOT_DOTTED,
    PLOT_DASH_DOT_DOT,
    PLOT_SHORT_DASHED
} plot_dash;

typedef struct plot_series {
    char name[PLOT_TEXT_SIZE]; /* for the CSV */
    char text[PLOT_TEXT_SIZE]; /* for the figure, gnuplot's enhanced text; "" for none */
    int ink;
    int dash; /* plot_dash, or what the figure's script takes it for */
    size_t count;
    double x[PLOT_POINTS], y[PLOT_POINTS]; /* y NaN: a gap */
} plot_series;

typedef struct plot_chart {
    const char *name, *title;
    char condition[PLOT_TEXT_SIZE];  /* what holds for all curves, after the title of y */
    const char *x_column, *y_column; /* headings in the CSV */
    double x_low, x_high;            /* of the axis */
    int width, height;               /* px */
    plot_series series[PLOT_SERIES_MAX];
    size_t series_count;
} plot_chart;

/* The numbers of --exponents and --bits. */
typedef struct plot_list {
    double items[PLOT_LIST_MAX];
    size_t count;
    double low, high; /* the least and the greatest */
} plot_list;

/* What a figure is drawn for. */
typedef struct plot_request {
    plot_list exponents, bits;
    lobe_names lobes; /* at most PLOT_LIST_MAX */
    int width, height;
    int lenient; /* 1: lobes or exponents are the figure's own, which need not all fit the others */
} plot_request;

/* What a figure plots for one lobe: over the angle x in degrees, or for 2^-x where it has bits. */
typedef double plot_metric(const burnish_theory_model *model, double x);

/* What the axis is; --exponents and --bits are then curves or the ends of the axis. */
typedef enum plot_axis {
    PLOT_AXIS_ANGLES,
    PLOT_AXIS_EXPONENTS,
    PLOT_AXIS_BITS, /* and one exponent only */
    PLOT_AXIS_NONE  /* the figures cost and object: one exponent only */
} plot_axis;

/* One figure. Defaults are lists as the flags read them; NULL: the figure has no use for the flag.
 */
typedef struct plot_figure {
    const char *name, *title;
    const char *script; /* figures/SCRIPT.gp; NULL: a picture, see plot_object */
    plot_axis axis;
    const char *exponents, *lobes, *bits;
    int width, height; /* px; 0: 720 x 440 */
    const char *y_column;
    plot_metric *measure; /* NULL: see PLOT_AXIS_NONE */
    plot_metric *points;  /* the same found in another way, drawn as points; or NULL */
    double least_angle;   /* degrees at the left end of a logarithmic axis of angles; 0: linear */
    int is_narrow;        /* 1: over the angle, more points where narrow lobes end */
    int has_paper_names;  /* 1: lobes are called as the paper does */
    int is_ordered;       /* 1: the lobes are an ordered set */
} plot_figure;

/* The curves of a figure, into a chart that is zero but for name, title, size and the column of y.
 * Errors: ARGUMENT for a lobe that does not exist for an exponent, or too many curves. */
burnish_status plot_fill(const plot_figure *figure, const plot_request *request, plot_chart *chart,
                         burnish_error *error);

/* The same for the figure `cost`. */
burnish_status plot_fill_cost(const plot_request *request, plot_chart *chart, burnish_error *error);

/* The model of a lobe of --lobes. Errors: ARGUMENT. */
burnish_status plot_make_model(const char *word, double exponent, burnish_theory_model *model,
                               burnish_error *error);

/* One more curve, of zeros; NULL with an error where there are PLOT_SERIES_MAX. */
plot_series *plot_add_series(plot_chart *chart, burnish_error *error);

/* A figure for one exponent says which, after the title of y. */
void plot_state_exponent(const plot_request *request, plot_chart *chart);

/* All figures; `index` past the end gives NULL. */
const plot_figure *plot_figure_at(size_t index);

/* The files of figures/, in the program. */
typedef struct plot_script {
    const char *name; /* "style" */
    const char *text;
} plot_script;

extern const plot_script plot_scripts[]; /* a NULL name ends them */

/* Writes the points as CSV, or the script that makes gnuplot draw them on standard output. */
void plot_write_data(const plot_chart *chart, FILE *file);
void plot_write_script(const plot_chart *chart, const plot_figure *figure, int is_png, FILE *file);

/* Runs gnuplot on a script; *drawing is allocated. */
burnish_status plot_run(const char *script, size_t length, char **drawing, size_t *size,
                        burnish_error *error);

/* Gives an SVG of gnuplot's its title and a style sheet for dark pages; *svg is replaced. */
burnish_status plot_dress(const plot_chart *chart, char **svg, size_t *size, burnish_error *error);

/* The figure `object`: an object shaded with each lobe and how each differs from the first, as PNG,
 * or with data 1 the differences as CSV. */
burnish_status plot_object(const plot_request *request, int data, const char *path,
                           burnish_error *error);

#endif
