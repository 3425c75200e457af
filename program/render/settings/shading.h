/* Materials, light and lines. */
#ifndef TOOL_RENDER_SETTINGS_SHADING_H
#define TOOL_RENDER_SETTINGS_SHADING_H

#include "burnish/look.h"
#include "burnish/render.h"
#include "cli/colors.h"

/* Longest list of --lobe and of --views. */
#define RENDER_LIST_MAX 16

typedef struct render_lobes {
    burnish_lobe_spec items[RENDER_LIST_MAX];
    size_t count;
} render_lobes;

typedef struct render_lights {
    int given;   /* 1: these instead of the look's */
    int of_file; /* 1: the input's own too */
    burnish_light items[BURNISH_LIGHT_MAX];
    int count;
    burnish_area_light areas[BURNISH_AREA_LIGHT_MAX];
    int area_count;
} render_lights;

typedef struct render_environment_choice {
    const char *name; /* sky, room or a file; NULL: none */
    cli_real strength, turn;
} render_environment_choice;

typedef struct render_ambient {
    int given;
    float linear[3];
} render_ambient;

typedef struct render_occlusion {
    int given;
    int directions;
} render_occlusion;

typedef struct render_edges {
    int given;
    burnish_edge_flags kinds;
} render_edges;

typedef struct render_shading_settings {
    int look; /* burnish_look */
    cli_color color;
    int no_colors; /* 1: those of the input are ignored */
    int material;  /* 1 + index into render_presets; 0: the input's own */
    cli_real specular, exponent, opacity;
    render_lobes lobes;
    int equation, viewer;
    render_lights lights;
    render_environment_choice environment;
    render_ambient ambient;
    render_occlusion occlusion;
    int ground, shadow;
    render_edges edges;
    int wireframe, hidden_lines, center_lines;
    cli_real edge_width;
    cli_color edge_color;
    cli_real outline_contrast;
} render_shading_settings;

#endif
