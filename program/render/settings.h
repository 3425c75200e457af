/* What `burnish render` was asked for, as its flags leave it. */
#ifndef TOOL_RENDER_SETTINGS_H
#define TOOL_RENDER_SETTINGS_H

#include "burnish/annotate.h"
#include "burnish/render.h"
#include "cli/input.h"
#include "cli/values.h"
#include "picture/picture.h"
#include "render/output/planes.h"

/* Longest list of --lobe and of --views. */
#define RENDER_LIST_MAX 16

typedef enum render_view {
    VIEW_FREE, /* as the camera flags say */
    VIEW_FRONT,
    VIEW_RIGHT,
    VIEW_BACK,
    VIEW_LEFT,
    VIEW_TOP,
    VIEW_BOTTOM,
    VIEW_ISO
} render_view;

typedef enum render_up {
    UP_FORMAT, /* the mesh's, told by its format */
    UP_POSITIVE_X,
    UP_NEGATIVE_X,
    UP_POSITIVE_Y,
    UP_NEGATIVE_Y,
    UP_POSITIVE_Z,
    UP_NEGATIVE_Z,
    UP_AUTO /* a guess, made when the mesh is loaded */
} render_up;

typedef enum render_projection {
    PROJECTION_AUTO, /* parallel for standard views, else perspective */
    PROJECTION_PARALLEL,
    PROJECTION_PERSPECTIVE
} render_projection;

typedef struct render_views {
    render_view items[RENDER_LIST_MAX];
    size_t count;
} render_views;

typedef struct render_lobes {
    burnish_lobe_spec items[RENDER_LIST_MAX];
    size_t count;
} render_lobes;

typedef struct render_lights {
    int given;   /* 1: these instead of the default rig */
    int of_file; /* 1: the input's own too */
    burnish_light items[BURNISH_LIGHT_MAX];
    int count;
} render_lights;

typedef struct render_clip {
    burnish_clip_plane items[BURNISH_CUTS_MAX];
    int count;
} render_clip;

/* Rows of the picture that are drawn; count 0: all. */
typedef struct render_rows {
    int first, count;
} render_rows;

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
    int kinds; /* a sum of BURNISH_EDGES_... */
} render_edges;

typedef struct render_background {
    int given; /* 1: color counts */
    int transparent;
    float srgb[3];
} render_background;

/* Names of flags of a picture, for commands that draw as this one does: those of its topics
 * picture, files and report that belong to neither a file nor a limit. */
#define RENDER_PICTURE_FLAGS                                                                       \
    "cull-back-faces,samples,background-color,no-background,views,annotate,columns,labels,"        \
    "no-labels,quality,dpi,input-format,clip,crease-angle,tessellation,animation-time,animation,"  \
    "point-size,strict,no-textures,no-libraries,fail-on-blank"

struct render_result;

typedef struct render_settings {
    const char *input;
    const char *output;     /* NULL until render_finish */
    const char *output_dir; /* NULL: not given */
    const char *files_from; /* NULL: inputs are operands alone */
    int recursive;          /* 1: folders in folders */
    int overwrite;          /* 1: a name made from the input's replaces a file */
    int format;             /* picture_format; AUTO until render_finish */
    int quality;            /* 0: not given */
    cli_real dots_per_inch;
    render_planes planes;
    const char *turntable; /* NULL: a picture */
    int frames, fps;
    int runners; /* sockets from descriptor 3 on, to others that draw frames or bands */
    int runner;  /* 1: this is such a one */

    int size[2];
    render_rows rows;
    int samples;
    int threads;
    const char *isa_name; /* as the flag says */
    burnish_isa isa;
    render_background background;
    render_views views;
    int columns;        /* 0: chosen by the number of cells */
    const char *labels; /* NULL: the views' and lobes' names */
    int no_labels;
    const char *font; /* file; NULL: the system's, where a label needs one */
    int cull_back_faces;

    int up;               /* render_up */
    int stands_otherwise; /* what UP_AUTO guessed, once the mesh is loaded */
    cli_vector direction, position, focal_point, view_up;
    const char *own_camera; /* of the input, by name or number; NULL: none */
    cli_real azimuth, elevation, view_angle, zoom, margin;
    int projection; /* render_projection */
    cli_real orthographic_height;
    int same_scale;
    unsigned annotations; /* sum of burnish_annotation */

    cli_color color;
    int material; /* 1 + index into render_presets; 0: the input's own */
    cli_real specular, exponent, opacity;
    render_lobes lobes;
    int equation, viewer;
    render_lights lights;
    render_ambient ambient;
    int look; /* burnish_look */
    render_occlusion occlusion;
    render_edges edges;
    int wireframe;
    cli_real edge_width;
    cli_color edge_color;
    int ground;
    int shadow;

    cli_input load;
    cli_real max_overdraw, max_seconds;
    uint64_t max_memory; /* 0: no limit */
    int sandbox;
    render_clip clip;
    cli_real crease;
    const char *json; /* where the report goes; NULL: nowhere */
    int timing, quiet, fail_on_blank;
    const char *reference, *reference_difference; /* files; NULL: none */
    cli_real reference_threshold;

    /* Gets the result when the picture is drawn, before it is in place; NULL: not wanted. For
     * callers in C, beside --json. */
    void (*tell)(void *context, const struct render_result *result);
    void *tell_context;

    /* Loads the input; NULL: sandbox_load does. For callers that have it in memory. */
    burnish_status (*load_mesh)(void *context, const char *input,
                                const burnish_load_options *options, burnish_mesh **mesh,
                                burnish_error *error);
    void *load_context;
    int loads_foreign; /* 1: it knows formats that importers read */
    int opens_no_font; /* 1: letters beyond ASCII are drawn as ? */

    cli_given given; /* flags of the command line */

    int is_default_output;    /* 1: the name is made from the input's, so what has it is replaced
                                 only if burnish wrote it */
    char default_output[512]; /* what output may then point to */
} render_settings;

/* What the subcommand does once its flags are read. */
cli_work render_work;

/* The part of it after render_finish and what the system limits: draws, writes and reports. Sets
 * *exit_code where success is not 0. */
burnish_status render_run(render_settings *settings, int *exit_code, burnish_error *error);

/* Checks flags that exclude each other, and chooses the instruction set. */
burnish_status render_check(render_settings *settings, burnish_error *error);

/* Whether a flag of render's was given. */
int render_is_given(const render_settings *settings, const char *flag);

/* ARGUMENT for a flag that was given and can have no effect on what is drawn: of turntables, of
 * sheets, of projections, of lines; and of what an SVG can't show. Called when the format is known.
 */
burnish_status render_check_useless(const render_settings *settings, burnish_error *error);

/* Whether others draw, or this one draws for another. */
int render_is_shared(const render_settings *settings);

/* Checks flags as render_check, and finds the output's name and what depends on it. */
burnish_status render_finish(render_settings *settings, burnish_error *error);

/* The library's options for loading as the flags say, and loading by them. */
burnish_load_options render_load_options(const render_settings *settings);
burnish_status render_load(const render_settings *settings, burnish_mesh **mesh,
                           burnish_error *error);

/* Changes every material as --color, --material, --specular, --exponent and
 * --opacity say. */
burnish_status render_adjust_materials(const render_settings *settings, burnish_mesh *mesh,
                                       burnish_error *error);

/* The library's options but for camera and lobe, which each cell sets. */
burnish_render_options render_make_options(const render_settings *settings);

/* A surface by name. */
typedef struct render_preset {
    const char *name, *what;
    float specular; /* ks */
    float exponent; /* n */
    float diffuse;  /* factor on kd and ka */
    float tint;     /* 0: the highlight is white, 1: it has the surface's colour */
} render_preset;

/* The presets in the order of render_preset_words, whose values are 1 + their indices. */
extern const render_preset render_presets[];
extern const cli_word render_preset_words[];

extern const cli_word render_look_words[];  /* burnish_look */
extern const cli_section render_sections[]; /* of the man page, beside the flags */

/* Handlers for the flags that only this command has; target types as in render_settings. */
cli_handler render_flag_background;    /* render_background */
cli_handler render_flag_no_background; /* render_background */
cli_handler render_flag_rows;          /* render_rows */
cli_handler render_flag_views;         /* render_views */
cli_handler render_flag_lobes;         /* render_lobes */
cli_handler render_flag_light;         /* render_lights */
cli_handler render_flag_clip;          /* render_clip */
cli_handler render_flag_ambient;       /* render_ambient */
cli_handler render_flag_occlusion;     /* render_occlusion */
cli_handler render_flag_plane;         /* render_planes */
cli_handler render_flag_edges;         /* render_edges */
cli_handler render_flag_projection;    /* int: render_projection */
cli_handler render_flag_no_sandbox;    /* int: 0 */
cli_handler render_flag_annotate;      /* unsigned: sum of burnish_annotation */

#endif
