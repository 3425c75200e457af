/* The picture: its size, background, views and what is drawn over it. */
#ifndef TOOL_RENDER_SETTINGS_PICTURE_H
#define TOOL_RENDER_SETTINGS_PICTURE_H

#include "burnish/annotate.h"
#include "render/settings/shading.h"

typedef enum render_view {
    VIEW_FREE, /* as the camera flags say */
    VIEW_FRONT,
    VIEW_RIGHT,
    VIEW_BACK,
    VIEW_LEFT,
    VIEW_TOP,
    VIEW_BOTTOM,
    VIEW_ISO,
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
    int cull_back_faces;
    render_background background;
    burnish_annotation_flags annotations;

    render_views views;
    int columns;        /* 0: chosen by the number of cells */
    const char *labels; /* NULL: names of views and lobes */
    int no_labels;
    const char *font;  /* file; NULL: the system's, if a label needs one */
    int opens_no_font; /* 1: letters beyond ASCII are drawn as ? */
} render_picture_settings;

#endif
