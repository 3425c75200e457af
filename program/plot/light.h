/* The figures `polygon` and `rough`. */
#ifndef TOOL_PLOT_LIGHT_H
#define TOOL_PLOT_LIGHT_H

#include "plot/figures.h"

/* As plot_fill. */
burnish_status plot_fill_polygon(const plot_request *request, plot_chart *chart,
                                 burnish_error *error);
burnish_status plot_fill_rough(const plot_request *request, plot_chart *chart,
                               burnish_error *error);

#endif
