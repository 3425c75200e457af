/* The settings of `burnish view`. */
#ifndef TOOL_VIEW_VIEW_H
#define TOOL_VIEW_VIEW_H

#include "render/settings/settings.h"

typedef struct view_settings {
    render_settings render; /* first: its flags are shared */
    const char *output;     /* file of screenshots; NULL: the input's name and a number */
    const char *actions;    /* words with commas; NULL: none */
    int frames;             /* of the benchmark; 0: none */
} view_settings;

#endif
