/* Cuts a mesh. */
#ifndef TOOL_RENDER_CUT_H
#define TOOL_RENDER_CUT_H

#include "render/output/report.h"

/* Applies --clip to the mesh, and warns about cuts without an effect or a filling. Errors: see
 * burnish_mesh_clip. */
burnish_status render_cut(render_result *result, burnish_mesh *mesh, burnish_error *error);

#endif
