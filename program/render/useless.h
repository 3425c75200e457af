/* Flags without an effect. */
#ifndef TOOL_RENDER_USELESS_H
#define TOOL_RENDER_USELESS_H

#include "render/settings/settings.h"

/* ARGUMENT for a flag that was given and can't affect what is drawn: flags of turntables, sheets,
 * projections and lines, and flags of areas for an SVG. Call it when the format is known. */
burnish_status render_check_useless(render_settings *settings, burnish_error *error);

#endif
