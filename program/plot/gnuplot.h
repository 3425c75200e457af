/* Writes a chart as CSV or, with gnuplot and the scripts in figures/, as SVG and PNG. */
#ifndef TOOL_PLOT_GNUPLOT_H
#define TOOL_PLOT_GNUPLOT_H

#include <stdio.h>

#include "plot/figures.h"

/* The files of figures/, in the program. */
typedef struct plot_script {
    const char *name; /* "style" */
    const char *text;
} plot_script;

extern const plot_script plot_scripts[]; /* a NULL name ends them */

/* Writes the points as CSV, or the gnuplot script that draws them to standard output. */
void plot_write_data(const plot_chart *chart, FILE *file);
void plot_write_script(const plot_chart *chart, const plot_figure *figure, int is_png, FILE *file);

/* Runs gnuplot on a script; *drawing is allocated. */
burnish_status plot_run(const char *script, size_t length, char **drawing, size_t *size,
                        burnish_error *error);

/* Adds a title and a style sheet for dark pages to gnuplot's SVG; replaces *svg. */
burnish_status plot_dress(const plot_chart *chart, char **svg, size_t *size, burnish_error *error);

#endif
