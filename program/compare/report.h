/* Reports of a comparison. */
#ifndef TOOL_COMPARE_REPORT_H
#define TOOL_COMPARE_REPORT_H

#include "compare/sides.h"

/* Writes text, or JSON to the file of --json. */
burnish_status compare_write_report(const comparison *c, burnish_error *error);

#endif
