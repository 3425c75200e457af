/* From the camera flags to a camera. */
#ifndef TOOL_RENDER_CAMERA_H
#define TOOL_RENDER_CAMERA_H

#include "render/settings.h"

/* What framing leaves around the object, and how large it shows it. */
typedef struct render_room {
    double inset[4]; /* as burnish_framing has it; what annotations need where is_given is 0 */
    int is_given;
    double height; /* of a parallel projection before --camera-zoom-factor; 0: as the flags say */
} render_room;

/* The camera of one view of the mesh. room->inset receives what it was framed with. */
burnish_status render_camera(const burnish_mesh *mesh, const render_settings *settings,
                             render_view view, render_room *room, burnish_camera *camera,
                             burnish_error *error);

/* What --annotate asks for, but for colours. */
burnish_annotate_options render_make_annotations(const burnish_mesh *mesh,
                                                 const render_settings *settings);

/* The up axis in use, a unit vector. */
void render_upward(const burnish_mesh *mesh, const render_camera_settings *camera, double up[3]);

/* "front", "right" ...; "view" for VIEW_FREE. */
const char *render_view_name(render_view view);

/* The up axis in use, never UP_AUTO, and its direction, along one of the coordinates' axes. */
render_up render_up_in_use(const burnish_mesh *mesh, const render_camera_settings *camera,
                           double direction[3]);

/* The up axis in use, as --up names it. */
const char *render_up_name(const burnish_mesh *mesh, const render_camera_settings *camera);

#endif
