/* --reference: comparing the picture with an older one. */
#ifndef TOOL_RENDER_REFERENCE_H
#define TOOL_RENDER_REFERENCE_H

#include "render/output/report.h"

/* Reads the reference, if there is one, before anything is drawn. Errors: READ, FORMAT, LIMIT,
 * MEMORY. */
burnish_status render_read_reference(render_result *result, burnish_error *error);

/* Compares result->picture with the reference, and writes --reference-difference. */
burnish_status render_judge(render_result *result, burnish_error *error);

/* Adds the key "reference" to the report. */
void render_add_reference(cJSON *root, const render_result *result, int *failed);

/* If the picture does not pass, prints one line on standard error and returns 1. */
int render_report_difference(const render_result *result);

#endif
