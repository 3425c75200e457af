/* The camera and the up axis. */
#ifndef TOOL_RENDER_SETTINGS_CAMERA_H
#define TOOL_RENDER_SETTINGS_CAMERA_H

#include "base/cli/values.h"

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

typedef struct render_camera_settings {
    int up;               /* render_up */
    int stands_otherwise; /* 1: UP_AUTO has chosen the other axis than the format's */
    int sheet;            /* 1 + the axis on which the object has no extent; 0: none */
    cli_vector direction, position, focal_point, view_up;
    const char *own; /* name or number of a camera of the input; NULL: none */
    cli_real azimuth, elevation, view_angle, zoom, margin;
    int projection; /* render_projection */
    cli_real orthographic_height;
    int same_scale;
} render_camera_settings;

#endif
