/* Cameras from flags. */
#ifndef TOOL_RENDER_CAMERA_H
#define TOOL_RENDER_CAMERA_H

#include "render/settings/settings.h"

/* The room around the object, and its scale. */
typedef struct render_room {
    double inset[4]; /* as in burnish_framing; computed for annotations if is_given is 0 */
    int is_given;
    double height; /* of a parallel projection, before --zoom; 0: from the flags */
} render_room;

/* The mesh's axes along which width, height and depth of the front view lie, and these lengths. */
void render_axes(const burnish_mesh *mesh, const render_camera_settings *camera, int axes[3]);
void render_extents(const burnish_mesh *mesh, const render_camera_settings *camera,
                    double extents[3]);

/* The standard view that looks at --section; toward: the coordinate axis that points to its viewer. */
render_view render_section_view(const burnish_mesh *mesh, const render_settings *settings,
                                double toward[3]);

/* The camera of one view of the mesh. room->inset receives the insets of the framing. */
burnish_status render_camera(const burnish_mesh *mesh, const render_settings *settings,
                             render_view view, render_room *room, burnish_camera *camera,
                             burnish_error *error);

/* The annotations of --annotate and --callouts, without colours. */
burnish_annotate_options render_make_annotations(const burnish_mesh *mesh,
                                                 const render_settings *settings);

/* The up axis in use, a unit vector. */
void render_upward(const burnish_mesh *mesh, const render_camera_settings *camera, double up[3]);

/* "front", "right" ...; "view" for VIEW_FREE. */
const char *render_view_name(render_view view);

/* The up axis in use, never UP_AUTO, and its direction, which is a coordinate axis. */
render_up render_up_in_use(const burnish_mesh *mesh, const render_camera_settings *camera,
                           double direction[3]);

/* The up axis in use, as a value of --up. */
const char *render_up_name(const burnish_mesh *mesh, const render_camera_settings *camera);

#endif
