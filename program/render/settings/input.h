/* The input and how it is read. */
#ifndef TOOL_RENDER_SETTINGS_INPUT_H
#define TOOL_RENDER_SETTINGS_INPUT_H

#include "cli/input.h"

typedef struct render_clip {
    burnish_clip_plane items[BURNISH_CUTS_MAX];
    int count;
} render_clip;

/* --color-by, --color-map, --color-range. */
typedef struct render_coloring {
    const char *by; /* "height", "normal" or a property; NULL: the colours of the input */
    int map;        /* burnish_color_map */
    double range[2];
    int no_legend;
} render_coloring;

typedef struct render_input_settings {
    const char *name;
    cli_input load;
    cli_real crease;
    int normals; /* burnish_normals_source */
    render_clip clip;
    render_coloring coloring;
    int measure; /* 1: the mesh gets its facts, also without a cut */
} render_input_settings;

#endif
