/* The options of `burnish render`, as set by its flags. Settings are plain data and can be copied;
 * their texts belong to the command line. */
#ifndef TOOL_RENDER_SETTINGS_H
#define TOOL_RENDER_SETTINGS_H

#include "base/cli/values.h"
#include "burnish/annotate.h"
#include "burnish/look.h"
#include "burnish/render.h"
#include "cli/colors.h"
#include "cli/input.h"
#include "picture/formats.h"

/* ---- The input and how it is read ---- */

typedef struct render_clip {
    burnish_clip_plane items[BURNISH_CUTS_MAX];
    int count;
} render_clip;

/* --section: a cut, and the camera that looks at it. */
typedef struct render_section {
    int axis; /* 1 to 3; 0: none */
    int sign; /* of the axis, on whose side the viewer is; 0: as in the front, right or top view */
    cli_real offset;          /* along the axis; not given: the object's middle */
    burnish_clip_plane plane; /* with a normal to the viewer, once the mesh is known */
} render_section;

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
    render_section section;
    render_coloring coloring;
    int measure; /* 1: the mesh gets its facts, also without a cut */
} render_input_settings;

/* ---- The camera and the up axis ---- */

typedef enum render_up {
    UP_FORMAT, /* the up axis of the input's format */
    UP_POSITIVE_X,
    UP_NEGATIVE_X,
    UP_POSITIVE_Y,
    UP_NEGATIVE_Y,
    UP_POSITIVE_Z,
    UP_NEGATIVE_Z,
    UP_AUTO /* guessed when the mesh is loaded */
} render_up;

typedef enum render_projection {
    PROJECTION_AUTO, /* parallel for standard views, else perspective */
    PROJECTION_PARALLEL,
    PROJECTION_PERSPECTIVE
} render_projection;

typedef struct render_intrinsics {
    int given;
    double values[4]; /* focal lengths and principal point in pixels: fx, fy, cx, cy, of which 0, 0
                         is the middle of the first pixel */
} render_intrinsics;

typedef struct render_camera_settings {
    int up; /* render_up */
    const char
        *stands_otherwise; /* why UP_AUTO has chosen the other axis than the format's; NULL: it
                                     has not */
    int flat_axis;         /* 1 + the axis on which the object has no extent; 0: none */
    double slant[3];       /* the normal of a sheet in a slanted plane, or 0, 0, 0 */
    cli_vector direction, position, focal_point, view_up;
    const char *own; /* name or number of a camera of the input; NULL: none */
    cli_real azimuth, elevation, view_angle, zoom, margin;
    int projection; /* render_projection */
    render_intrinsics intrinsics;
    cli_real orthographic_height;
    int same_scale;
} render_camera_settings;

/* ---- Materials, light and lines ---- */

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
    int ground; /* 1: drawn; -1: not; 0: in the look studio, if the object stands */
    int shadow, raytracing;
    cli_real exposure;
    int tone_mapping; /* 1 + burnish_tone_mapping; 0: the look's */
    render_edges edges;
    int wireframe, hidden_lines, center_lines;
    cli_real edge_width;
    cli_color edge_color;
    cli_real outline_contrast;
} render_shading_settings;

/* ---- The picture: its size, background, views and what is drawn over it ---- */

typedef enum render_view {
    VIEW_FREE, /* as the camera flags say */
    VIEW_FRONT,
    VIEW_RIGHT,
    VIEW_BACK,
    VIEW_LEFT,
    VIEW_TOP,
    VIEW_BOTTOM,
    VIEW_ISO,
    VIEW_SECTION,     /* the standard view of --section */
    VIEW_ALL,         /* all of these, as a sheet */
    VIEW_THIRD_ANGLE, /* layouts of several views */
    VIEW_FIRST_ANGLE
} render_view;

typedef struct render_views {
    render_view items[RENDER_LIST_MAX];
    size_t count;
    render_view layout; /* VIEW_THIRD_ANGLE, VIEW_FIRST_ANGLE, or VIEW_FREE: a contact sheet */
} render_views;

/* Rows of the picture that are drawn; count 0: all. */
typedef struct render_rows {
    int first, count;
} render_rows;

typedef struct render_background {
    int given; /* 1: srgb counts */
    int transparent;
    int environment; /* 1: it shows the environment */
    float srgb[3];
} render_background;

typedef struct render_picture_settings {
    int size[2];  /* of a sheet: of each cell */
    int sides[2]; /* --width and --height, which replace the size; 0: not given */
    render_rows rows;
    int samples;
    int cull_back_faces; /* 0: in rooms; -1: never */
    render_background background;
    burnish_annotation_flags annotations;
    int callouts;

    render_views views;
    int paper;          /* 1 + its number in the series A; 0: none */
    int columns;        /* 0: chosen by the number of cells */
    int is_on_sheet;    /* 1: a batch has a sheet of all pictures */
    const char *labels; /* NULL: names of views and lobes */
    int no_labels;
    const char *font;  /* file; NULL: the system's, if a label needs one */
    int opens_no_font; /* 1: letters beyond ASCII are drawn as ? */
} render_picture_settings;

/* ---- The files that a run writes, and the reference that it compares with ---- */

typedef enum render_plane_kind {
    PLANE_COLOR,
    PLANE_DEPTH,
    PLANE_NORMAL,
    PLANE_TRIANGLE,
    PLANE_MATERIAL,
    PLANE_COVERAGE,
    PLANE_KINDS
} render_plane_kind;

/* One --plane=NAME:FILE. */
typedef struct render_plane {
    render_plane_kind kind;
    const char *path;
    picture_format format; /* set by render_finish */
} render_plane;

enum { RENDER_PLANES_MAX = 3 * PLANE_KINDS };

typedef struct render_planes {
    render_plane items[RENDER_PLANES_MAX];
    size_t count;
} render_planes;

typedef struct render_output_settings {
    const char *path;   /* NULL: derived from the input's name */
    const char *folder; /* NULL: not given */
    const char *place;  /* existing folder of the derived name; NULL: the current one */
    char derived[4096]; /* the derived name; render_output_path */
    int is_derived;     /* 1: an existing file is replaced only if burnish wrote it */
    int overwrite;      /* 1: and other files too */
    int format;         /* picture_format; AUTO until render_finish */
    int quality;        /* 0: not given */
    cli_real dots_per_inch;
    render_planes planes;

    const char *turntable; /* NULL: a picture */
    int plays;             /* 1: it shows the input's animation instead of a turn */
    int frames, fps;

    const char *json; /* file of the report; NULL: none */
    int fail_on_blank;

    const char *reference, *reference_difference; /* files; NULL: none */
    cli_real reference_threshold;
} render_output_settings;

/* The output's name, once render_finish has found it. */
static inline const char *render_output_path(const render_output_settings *output) {
    return output->path ? output->path : output->derived;
}

/* ---- How a run is carried out: inputs, processes, threads, limits and messages ---- */

struct render_result;

typedef struct render_job_settings {
    const char *files_from; /* NULL: all inputs are operands */
    int recursive;          /* 1: includes folders in folders */
    int threads;            /* 0: all */
    const char *isa_name;   /* as the flag says */
    burnish_isa isa;
    int sandbox;
    cli_real max_overdraw, max_seconds;
    uint64_t max_memory; /* 0: no limit */
    int timing, quiet;
    int is_one_of_many; /* 1: a batch warns about flags itself */
    int is_reported;    /* 1: on_result takes the object of --json */

    /* Receives the result once the picture is drawn, before the file is in place; NULL: none. */
    void (*on_result)(void *user_data, const struct render_result *result);
    void *user_data;
} render_job_settings;

/* ---- All ---- */

typedef struct render_settings {
    render_input_settings input;
    render_camera_settings camera;
    render_shading_settings shading;
    render_picture_settings picture;
    render_output_settings output;
    render_job_settings job;
    cli_given given; /* flags of the command line */
} render_settings;

#endif
