/* What `burnish render` was asked for, as its flags leave it. */
#ifndef BURNISH_TOOL_RENDER_SETTINGS_H
#define BURNISH_TOOL_RENDER_SETTINGS_H

#include "burnish/render.h"
#include "cli/values.h"

/* Longest list of --lobe and of --views. */
#define BURNISH_CLI_LIST_MAX 16

typedef enum burnish_cli_view {
    BURNISH_CLI_VIEW_FREE, /* as the camera flags say */
    BURNISH_CLI_VIEW_FRONT,
    BURNISH_CLI_VIEW_RIGHT,
    BURNISH_CLI_VIEW_BACK,
    BURNISH_CLI_VIEW_LEFT,
    BURNISH_CLI_VIEW_TOP,
    BURNISH_CLI_VIEW_BOTTOM,
    BURNISH_CLI_VIEW_ISO
} burnish_cli_view;

typedef enum burnish_cli_up {
    BURNISH_CLI_UP_AUTO, /* the mesh's, told by its format */
    BURNISH_CLI_UP_POSITIVE_X,
    BURNISH_CLI_UP_NEGATIVE_X,
    BURNISH_CLI_UP_POSITIVE_Y,
    BURNISH_CLI_UP_NEGATIVE_Y,
    BURNISH_CLI_UP_POSITIVE_Z,
    BURNISH_CLI_UP_NEGATIVE_Z
} burnish_cli_up;

typedef struct burnish_cli_views {
    burnish_cli_view items[BURNISH_CLI_LIST_MAX];
    size_t count;
} burnish_cli_views;

typedef struct burnish_cli_lobes {
    burnish_lobe_spec items[BURNISH_CLI_LIST_MAX];
    size_t count;
} burnish_cli_lobes;

typedef struct burnish_cli_lights {
    int given; /* 1: these instead of the default rig */
    burnish_light items[BURNISH_LIGHT_MAX];
    int count;
} burnish_cli_lights;

typedef struct burnish_cli_ambient {
    int given;
    float linear[3];
} burnish_cli_ambient;

typedef struct burnish_cli_background {
    int given; /* 1: color counts */
    int transparent;
    float srgb[3];
} burnish_cli_background;

typedef struct burnish_cli_render {
    const char *input;
    const char *output; /* NULL until burnish_cli_render_finish */

    int size[2];
    int samples;
    int threads;
    burnish_isa isa;
    burnish_cli_background background;
    burnish_cli_views views;
    int columns;        /* 0: chosen by the number of cells */
    const char *labels; /* NULL: the views' and lobes' names */
    int no_labels;
    int cull_back_faces;

    int up; /* burnish_cli_up */
    burnish_cli_vector direction, position, focal_point, view_up;
    burnish_cli_real azimuth, elevation, view_angle, zoom, margin;
    int orthographic;

    burnish_cli_color color;
    int material; /* index into burnish_cli_presets; -1: the input's own */
    burnish_cli_real specular, exponent;
    burnish_cli_lobes lobes;
    int equation, viewer;
    burnish_cli_lights lights;
    burnish_cli_ambient ambient;

    int format;
    burnish_cli_real crease;
    int tessellation;
    uint64_t max_triangles, max_input_bytes;
    int json, timing, quiet, fail_on_blank;
    int help;

    char default_output[512]; /* what output points to when the name is made from the input's */
} burnish_cli_render;

/* The subcommand: its flags and their handlers. */
extern const burnish_cli_command burnish_cli_render_command;

/* Checks what no single flag can: flags that exclude each other, the output's name. */
burnish_status burnish_cli_render_finish(burnish_cli_render *settings, burnish_error *error);

/* Loads the input as the flags say. */
burnish_status burnish_cli_load(const burnish_cli_render *settings, burnish_mesh **scene,
                                burnish_error *error);

/* Changes every material as --color, --material, --specular and --exponent say. */
burnish_status burnish_cli_adjust_materials(const burnish_cli_render *settings, burnish_mesh *scene,
                                            burnish_error *error);

/* The library's options but for camera and lobe, which each cell sets. */
burnish_render_options burnish_cli_render_options(const burnish_cli_render *settings);

/* Runs the subcommand and returns the exit code. */
int burnish_cli_render_main(int argc, char **argv);

/* A surface by name. */
typedef struct burnish_cli_preset {
    const char *name, *what;
    float specular; /* ks */
    float exponent; /* n */
    float diffuse;  /* factor on kd and ka */
    float tint;     /* 0: the highlight is white, 1: it has the surface's colour */
} burnish_cli_preset;

/* The presets in the order of burnish_cli_preset_words, whose values are their indices. */
extern const burnish_cli_preset burnish_cli_presets[];
extern const burnish_cli_word burnish_cli_preset_words[];

/* Handlers for the flags that only this command has; target types as in burnish_cli_render. */
burnish_cli_handler burnish_cli_flag_resolution;    /* int[2] */
burnish_cli_handler burnish_cli_flag_size;          /* int[2] */
burnish_cli_handler burnish_cli_flag_background;    /* burnish_cli_background */
burnish_cli_handler burnish_cli_flag_no_background; /* burnish_cli_background */
burnish_cli_handler burnish_cli_flag_views;         /* burnish_cli_views */
burnish_cli_handler burnish_cli_flag_lobes;         /* burnish_cli_lobes */
burnish_cli_handler burnish_cli_flag_light;         /* burnish_cli_lights */
burnish_cli_handler burnish_cli_flag_ambient;       /* burnish_cli_ambient */

#endif
