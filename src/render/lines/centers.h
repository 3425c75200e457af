/* Centre lines of a frame. */
#ifndef BURNISH_RENDER_LINES_CENTERS_H
#define BURNISH_RENDER_LINES_CENTERS_H

#include "render/lines/lines_seen.h"
#include "render/lines/projection.h"

/* Appends the axes of the mesh's circles: chain lines along them, crosses where they are seen along
 * the view. Those of hidden circles only together with hidden lines. Errors: memory->status. */
void burnish_line_art_add_centers(burnish_line_art *art, const burnish_mesh_view *mesh,
                                  const burnish_line_scene *scene,
                                  const burnish_line_projection *projection,
                                  const burnish_render_options *options, burnish_memory *memory);

#endif
