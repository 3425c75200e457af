/* What the window shows, without the window: the mesh as the flags and keys have it, its camera,
 * and pictures of it. Still pictures are those of `burnish render`. */
#ifndef TOOL_VIEW_SCENE_H
#define TOOL_VIEW_SCENE_H

#include "render/camera.h"
#include "render/settings.h"

/* How a picture is drawn: as it is kept, or as time allows while things move. */
typedef enum view_quality {
    VIEW_STILL,
    VIEW_PLAIN,  /* without ambient occlusion */
    VIEW_FAST,   /* also without shadows, one sample a pixel */
    VIEW_COARSE, /* also of half the resolution */
} view_quality;

/* A cut across an axis of the file's coordinates. */
typedef struct view_section {
    int is_on;
    int axis, side; /* 0, 1, 2; 1: what is above is cut away, -1: below */
    double share;   /* of the mesh's extent along the axis, (0, 1) */
} view_section;

typedef struct view_scene {
    render_settings given;    /* by flags and keys, in coordinates of the file, but for... */
    render_settings settings; /* the same in the mesh's own coordinates */
    const char *input;
    view_section section;
    burnish_mesh *mesh;
    burnish_render_options options;
    double low[3], high[3]; /* bounds of the whole mesh in the file's coordinates */
    size_t triangles;       /* of the whole mesh */

    burnish_camera camera;
    render_view view; /* that the camera is of, while... */
    int is_framed;    /* 1: it was not moved since */

    burnish_context *context;
    burnish_renderer *renderer;
    int (*interrupted)(void *user_data); /* asked while a still picture is drawn; NULL: never */
    void *user_data;
    int may_stop;
} view_scene;

/* From zeros but for given, interrupted and user_data. Errors: MEMORY. */
burnish_status view_scene_begin(view_scene *scene, burnish_error *error);
void view_scene_end(view_scene *scene);

/* Loads scene->input as given, section and materials say. The mesh before stays on error. Errors:
 * those of loading. */
burnish_status view_scene_load(view_scene *scene, burnish_error *error);

/* Frames a view in a picture of scene->given.size. */
burnish_status view_scene_aim(view_scene *scene, render_view view, burnish_error *error);

/* Sets the exponent of all materials. */
burnish_status view_scene_set_exponent(view_scene *scene, double exponent, burnish_error *error);

/* The first material's. */
double view_scene_exponent(const view_scene *scene);

/* Up, a unit vector; half the diagonal of the box. */
void view_scene_up(const view_scene *scene, double up[3]);
double view_scene_radius(const view_scene *scene);

/* Draws into BGRA8 pixels of any size. Errors: those of drawing; CANCELLED where interrupted says
 * so, of a still picture with may_stop. */
burnish_status view_scene_draw(view_scene *scene, const burnish_lobe_spec *lobe,
                               view_quality quality, const burnish_pixels *pixels,
                               burnish_error *error);

/* The command that draws the same picture, without the flags that the program was started with. */
void view_scene_print(const view_scene *scene, const burnish_lobe_spec *lobe);

#endif
