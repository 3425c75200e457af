/* The figure `cost`. */
#ifndef TOOL_PLOT_COST_H
#define TOOL_PLOT_COST_H

#include "plot/figures.h"

/* As plot_fill. */
burnish_status plot_fill_cost(const plot_request *request, plot_chart *chart, burnish_error *error);

#endif
