/* From a loaded mesh and settings to a scene that can be drawn: the order of the steps. */
#ifndef TOOL_RENDER_SCENE_PREPARE_H
#define TOOL_RENDER_SCENE_PREPARE_H

#include "render/scene/environments.h"
#include "render/scene/warnings.h"

typedef struct render_scene {
    render_settings *settings; /* in coordinates of the file; prepared ones in those of the mesh */
    burnish_mesh *mesh;
    burnish_render_options *options; /* set without camera and lobe, which each cell sets */
    render_environment *environment; /* read or made unless it already is; the caller releases it */
    render_warnings *warnings;
    double *color_range; /* 2 values of --color-by */
} render_scene;

/* Adds the warnings of loading; the mesh can be NULL. */
void render_warn_of_mesh(render_warnings *warnings, const burnish_mesh *mesh);

/* Once for a mesh, which keeps the changes: finds the up axis, applies --clip and --color-by. Uses
 * neither options nor environment. Errors: ARGUMENT, MEMORY. */
burnish_status render_prepare_mesh(render_scene *scene, burnish_error *error);

/* Then once for settings of a picture: lights, materials and the environment. Materials are those
 * of the file, and are changed. Errors: ARGUMENT for too many lights, and with --strict for a
 * shadow that no light casts; as for reading and decoding an environment. */
burnish_status render_prepare_picture(render_scene *scene, burnish_error *error);

/* Both. */
burnish_status render_prepare(render_scene *scene, burnish_error *error);

/* Cuts by the plane of --section, of which only the last cell of a sheet of aligned views shows
 * what is left. Errors: ARGUMENT, MEMORY. */
burnish_status render_cut_section(const render_scene *scene, burnish_error *error);

/* The offset of a plane in coordinates of the file. */
double render_file_offset(const burnish_clip_plane *plane, const double origin[3]);

#endif
