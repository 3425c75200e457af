/* The settings of `burnish view`, and its window. */
#ifndef TOOL_VIEW_VIEW_H
#define TOOL_VIEW_VIEW_H

#include "render/settings/settings.h"

typedef struct view_settings {
    render_settings render; /* first: its flags are shared */
    const char *output;     /* file of screenshots; NULL: the input's name and a number */
    const char *actions;    /* words with commas; NULL: none */
    int frames;             /* of the benchmark; 0: none */
} view_settings;

/* Opens the window, and returns when it is closed. Errors: as for loading and drawing, before the
 * window opens; READ if no window can be opened; ARGUMENT if this build has no windows. */
burnish_status view_window(const view_settings *settings, burnish_error *error);

#endif
