/* Figures, and the charts that they fill. */
#ifndef TOOL_LOBE_FIGURES_H
#define TOOL_LOBE_FIGURES_H

#include <stdio.h>

#include "program/lobe.h"

enum {
    PLOT_LIST_MAX = 32,   /* items of --exponents, --lobes, --bits */
    PLOT_SERIES_MAX = 48, /* curves of a figure */
    PLOT_POINTS = 241,    /* of a curve */
    PLOT_TEXT_SIZE = 96
};

/* Colours: indices into the list of inks in gnuplot.c, from 1. */
typedef enum plot_ink {
    PLOT_INK_TEXT = 1,
    PLOT_INK_AXIS = 2,
    PLOT_INK_REFERENCE = 5, /* cos^n */
    PLOT_INK_LOBE = 6,      /* the first of seven hues for lobes */
    PLOT_INK_RAMP = 13,     /* the first of eight steps for ordered numbers */
    PLOT_RAMP_INKS = 8
} plot_ink;

/* Dashes, as figures.gp numbers them. */
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
    int dash; /* plot_dash, or another number for figures.gp */
    size_t count;
    double x[PLOT_POINTS], y[PLOT_POINTS]; /* y NaN: a gap */
} plot_series;

typedef struct plot_chart {
    const char *name, *title, *panel;
    char condition[PLOT_TEXT_SIZE];  /* appended to the title of y */
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

/* The parameters of a figure. */
typedef struct plot_request {
    plot_list exponents, bits;
    lobe_names lobes; /* at most PLOT_LIST_MAX */
    int width, height;
    int lenient; /* 1: defaults of the figure: skip lobes that do not exist for an exponent */
} plot_request;

/* The value to plot for a lobe at angle x in degrees or, for figures with bits, at 2^-x. */
typedef double plot_metric(const burnish_theory_model *model, double x);

/* The x axis. Its flag gives the ends; other flags select curves. */
typedef enum plot_axis {
    PLOT_AXIS_ANGLES,
    PLOT_AXIS_EXPONENTS,
    PLOT_AXIS_BITS, /* and one exponent only */
    PLOT_AXIS_NONE  /* with `fill`: one exponent only */
} plot_axis;

/* One figure. Defaults have the syntax of the flags; NULL: the figure ignores the flag.
 */
typedef struct plot_figure {
    const char *name, *title;
    const char *panel; /* its number in the paper; NULL: not in it */
    plot_axis axis;
    const char *exponents, *lobes, *bits;
    int width, height; /* px; 0: 720 x 440 */
    const char *y_column;
    plot_metric *measure;
    /* Figures that are not curves of a metric: as plot_fill. */
    burnish_status (*fill)(const plot_request *request, plot_chart *chart, burnish_error *error);
    plot_metric *points; /* the same by another method, drawn as points; or NULL */
    double least_angle;  /* degrees at the left end of a logarithmic axis of angles; 0: linear */
    int is_narrow;       /* 1: more points at the ends of narrow lobes */
    int has_paper_names; /* 1: use the paper's names of lobes */
    int is_ordered;      /* 1: the lobes are an ordered set */
} plot_figure;

/* Fills a chart, in which only name, title, size and y_column are set, with the curves of a figure.
 * Errors: ARGUMENT for a lobe that does not exist for an exponent, or too many curves. */
burnish_status plot_fill(const plot_figure *figure, const plot_request *request, plot_chart *chart,
                         burnish_error *error);

/* The paper's name of a lobe, else burnish's, as gnuplot's enhanced text. */
void plot_name_lobe(const burnish_theory_model *model, char *text, size_t size);
int plot_lobe_ink(const burnish_theory_model *model);

/* The model of a lobe of --lobes. Errors: ARGUMENT. */
burnish_status plot_make_model(const char *word, double exponent, burnish_theory_model *model,
                               burnish_error *error);

/* Adds an empty curve; NULL with an error after PLOT_SERIES_MAX. */
plot_series *plot_add_series(plot_chart *chart, burnish_error *error);

/* Appends the exponent of a figure for one exponent to the title of y. */
void plot_state_exponent(const plot_request *request, plot_chart *chart);

/* All figures; `index` past the end gives NULL. */
const plot_figure *plot_figure_at(size_t index);

/* The figures `cost`, `polygon` and `rough`: as plot_fill. */
burnish_status plot_fill_cost(const plot_request *request, plot_chart *chart, burnish_error *error);
burnish_status plot_fill_multiplications(const plot_request *request, plot_chart *chart,
                                         burnish_error *error);
burnish_status plot_fill_polygon(const plot_request *request, plot_chart *chart,
                                 burnish_error *error);
burnish_status plot_fill_rough(const plot_request *request, plot_chart *chart,
                               burnish_error *error);

/* Writes the points as CSV, or all numbers of the drawing for figures.gp. */
void plot_write_data(const plot_chart *chart, FILE *file);
void plot_write_numbers(const plot_chart *chart, int is_png, FILE *file);

/* Runs gnuplot and figures.gp on such numbers; *drawing is allocated. */
burnish_status plot_run(const char *numbers, size_t length, char **drawing, size_t *size,
                        burnish_error *error);

/* Adds a title and a style sheet for dark pages to gnuplot's SVG; replaces *svg. */
burnish_status plot_dress(const plot_chart *chart, char **svg, size_t *size, burnish_error *error);

#endif
