/* The picture that a file holds of itself, drawn on a sheet that faces the viewer. */
#ifndef BURNISH_MESH_READ_COMMON_THUMBNAIL_H
#define BURNISH_MESH_READ_COMMON_THUMBNAIL_H

#include "mesh/read/io/reader.h"

/* Makes a sheet with a picture instead of the mesh, and warns.
 *   bytes  the encoded picture; not used if the options ignore textures
 *   why    for the warning: "it is ..."
 * Errors: MEMORY. */
burnish_status burnish_draw_thumbnail(burnish_reader *reader, const uint8_t *bytes, size_t size,
                                      const char *why);

#endif
