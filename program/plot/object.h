/* The figure `object`. */
#ifndef TOOL_PLOT_OBJECT_H
#define TOOL_PLOT_OBJECT_H

#include "plot/figures.h"

/* Writes an object shaded with each lobe, and the differences from the first, as PNG;
 * with data 1, the differences as CSV. */
burnish_status plot_object(const plot_request *request, int data, const char *path,
                           burnish_error *error);

#endif
