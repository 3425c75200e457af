/* The files that a run writes, and the reference that it compares with. */
#ifndef TOOL_RENDER_SETTINGS_OUTPUT_H
#define TOOL_RENDER_SETTINGS_OUTPUT_H

#include "base/cli/values.h"
#include "picture/formats.h"

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

#endif
