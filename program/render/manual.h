/* Sections of the man page. */
#ifndef TOOL_RENDER_MANUAL_H
#define TOOL_RENDER_MANUAL_H

#include "base/cli/options.h"

extern const cli_section render_sections[];

#endif
