/* Conversion of settings from coordinates of the file to coordinates of a mesh with an origin. */
#ifndef BURNISH_RENDER_ORIGIN_H
#define BURNISH_RENDER_ORIGIN_H

#include "render/settings/settings.h"

/* Subtracts an origin from the camera, the planes and the options' lights. */
void render_subtract_origin(render_camera_settings *camera, render_clip *clip,
                            burnish_render_options *options, const double origin[3]);

/* Forgets --light=file if the mesh has no lights: the options get the look's, unless the command line
 * has other lights. Call it before the materials are adjusted. */
void render_drop_file_lights(render_settings *settings, const burnish_mesh *mesh,
                             burnish_render_options *options);

/* What is not drawn as asked for; NULL for none. */
typedef struct render_light_warnings {
    const char *spot, *shadow;
} render_light_warnings;

/* Adds the mesh's own lights to the options' if the settings ask for them, in coordinates of the mesh,
 * and drops the shadow if no light can cast it. Errors: ARGUMENT for too many lights, and for a
 * dropped shadow with --strict. */
burnish_status render_add_own_lights(const render_settings *settings, const burnish_mesh *mesh,
                                     burnish_render_options *options,
                                     render_light_warnings *warnings, burnish_error *error);

/* The offset of a plane in coordinates of the file. */
double render_file_offset(const burnish_clip_plane *plane, const double origin[3]);

#endif
