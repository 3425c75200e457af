/* Which way the faces of a mesh look. */
#ifndef TOOL_RENDER_WINDING_H
#define TOOL_RENDER_WINDING_H

#include "burnish/mesh.h"

typedef struct render_winding {
    double volume; /* signed, about the middle of the box: negative if faces look inward */
    double box;    /* volume of the bounding box */
    int is_closed; /* 1: the area vectors add up to 0 */
} render_winding;

render_winding render_measure_winding(const burnish_mesh_view *view);

/* Whether the mesh is a room whose walls are seen from outside only if their backs are drawn: glTF
 * whose faces show one side, and look inward in an open surface. A closed one that is inside out stays
 * a solid, as a room and a wrong solid look alike. */
int render_is_room(const burnish_mesh *mesh);

#endif
