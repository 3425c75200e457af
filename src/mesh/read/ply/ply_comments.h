/* Lines in an ASCII body that are not rows. */
#ifndef BURNISH_MESH_READ_PLY_PLY_COMMENTS_H
#define BURNISH_MESH_READ_PLY_PLY_COMMENTS_H

#include "mesh/read/ply/ply_rows.h"

/* Gives the reader an input with blanks in place of comments in the body; *any: 1 if there are
 * some. Errors: MEMORY. */
burnish_status burnish_ply_hide_comments(burnish_ply_state *ply, int *any);

/* Restores the original input, after the body has been read. */
void burnish_ply_show_comments(burnish_ply_state *ply);

#endif
