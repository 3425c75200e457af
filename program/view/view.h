/* `burnish view`: what it was asked for, and the window. */
#ifndef TOOL_VIEW_VIEW_H
#define TOOL_VIEW_VIEW_H

#include "render/settings.h"

typedef struct view_settings {
    render_settings render; /* first: its flags are ours too */
    const char *output;     /* where the picture is saved; NULL: the input's name and a number */
    const char *actions;    /* words between commas; NULL: none */
    int frames;             /* to measure; 0: none */
} view_settings;

/* Opens the window, and returns when it is closed. Errors: those of loading and drawing before the
 * window is there; READ where there is none to be had; ARGUMENT where this build has no windows. */
burnish_status view_window(const view_settings *settings, burnish_error *error);

#endif
