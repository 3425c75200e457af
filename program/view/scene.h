/* The content of the window: the mesh with the settings of flags and keys, its camera, and pictures
 * of it. Still pictures are the same as those of `burnish render`. */
#ifndef TOOL_VIEW_SCENE_H
#define TOOL_VIEW_SCENE_H

#include "render/scene/cameras.h"
#include "render/scene/environments.h"
#include "render/settings/settings.h"

/* The quality of still pictures, and of moving ones, depending on the available time. */
typedef enum view_quality {
    VIEW_STILL,
    VIEW_PLAIN,  /* without ambient occlusion */
    VIEW_FAST,   /* also without shadows, one sample per pixel */
    VIEW_COARSE, /* also with half the resolution */
} view_quality;

/* A cut across an axis of the file's coordinates. */
typedef struct view_section {
    int is_on;
    int axis, side; /* 0, 1, 2; 1: the part above is cut away, -1: below */
    double share;   /* of the mesh's extent along the axis, (0, 1) */
} view_section;

typedef struct view_scene {
    render_settings given;    /* of flags and keys, in coordinates of the file */
    render_settings settings; /* the same in the mesh's own coordinates */
    const char *input;
    const char *warned; /* the input whose warnings were printed */
    view_section section;
    burnish_mesh *mesh;
    render_environment environment;
    int environment_is_old; /* 1: its file has changed */
    burnish_render_options options;
    double low[3], high[3]; /* bounds of the whole mesh in the file's coordinates */
    size_t triangles;       /* of the whole mesh */

    burnish_camera camera;
    render_view view; /* the view of the camera, if is_framed is 1 */
    int is_framed;    /* 1: the camera was not moved */

    burnish_context *context;
    burnish_renderer *renderer;
    int (*interrupted)(void *user_data); /* polled while a still picture is drawn; can be NULL */
    void *user_data;
    int may_stop;
} view_scene;

/* All members but given, interrupted and user_data must be 0. Errors: MEMORY. */
burnish_status view_scene_begin(view_scene *scene, burnish_error *error);
void view_scene_end(view_scene *scene);

/* Loads scene->input with the current settings. After an error the previous mesh stays. Errors: as
 * for loading. */
burnish_status view_scene_load(view_scene *scene, burnish_error *error);

/* Frames a view in a picture of the given size. */
burnish_status view_scene_aim(view_scene *scene, render_view view, burnish_error *error);

/* Sets the exponent of all materials. */
burnish_status view_scene_set_exponent(view_scene *scene, double exponent, burnish_error *error);

/* The exponent of the first material. */
double view_scene_exponent(const view_scene *scene);

/* Up, a unit vector; half the diagonal of the box. */
void view_scene_up(const view_scene *scene, double up[3]);
double view_scene_radius(const view_scene *scene);

/* Draws into BGRA8 pixels of any size. Errors: as for drawing; CANCELLED if interrupted returns 1
 * for a still picture with may_stop. */
burnish_status view_scene_draw(view_scene *scene, const burnish_lobe_spec *lobe,
                               view_quality quality, const burnish_pixels *pixels,
                               burnish_error *error);

/* Prints the command that draws the same picture, without this command line's flags. */
void view_scene_print(const view_scene *scene, const burnish_lobe_spec *lobe);

#endif
