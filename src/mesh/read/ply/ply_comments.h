/* Lines in an ASCII body that are not rows. */
#ifndef BURNISH_MESH_READ_PLY_PLY_COMMENTS_H
#define BURNISH_MESH_READ_PLY_PLY_COMMENTS_H

#include "mesh/read/ply/ply_rows.h"

/* Gives the reader an input whose body has blanks where it had comments; *any: 1 if there are
 * some. Errors: MEMORY. */
burnish_status burnish_ply_hide_comments(burnish_ply_state *ply, int *any);

/* Gives it its own input back, once the body has been read. */
void burnish_ply_show_comments(burnish_ply_state *ply);

#endif
