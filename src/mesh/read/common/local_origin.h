/* Positions far from the origin, as surveys have them: 500,000 m east and 4,100,000 m north, where
 * floats are 0.25 or 0.5 m apart.
 *
 * Such a file is read once more, with an origin near its middle subtracted in double precision
 * before coordinates are rounded. The difference of two doubles that are within a factor of 2 is
 * exact: the mesh has the same bits as one that was made at that origin. */
#ifndef BURNISH_MESH_READ_COMMON_LOCAL_ORIGIN_H
#define BURNISH_MESH_READ_COMMON_LOCAL_ORIGIN_H

#include "mesh/read/io/reader.h"

/* How often a mesh is read again at most. The first time finds the middle to the precision of
 * floats, the second to a grid of its size, and the third handles objects smaller than the steps of
 * those floats. */
enum { BURNISH_ORIGIN_TIMES = 3 };

/* Whether positions should be read again with another origin than mesh->origin, which goes to
 * *origin.
 *
 * An origin is needed if, along any axis, the middle of the box of the positions in use is more
 * than 32 times as far from 0 as the box is large. Below that a float's error, 2^-25 of the
 * distance, is less than 2^-20 of the object: 1/256 pixel if it is 4096 pixels wide. The origin is
 * 0 along axes where the distance is less than twice the size. Along others it is the middle,
 * rounded to 1/16 of the power of two below the size: a number of few digits. */
int burnish_find_origin(const burnish_mesh_data *mesh, double origin[3]);

/* A coordinate of the file as one of the mesh; 0 if it is not finite. */
static inline int burnish_place(double value, double origin, float *coordinate) {
    return burnish_double_to_float(value - origin, coordinate);
}

/* Reads the input again while burnish_find_origin requests it, without repeating warnings.
 * Materials and textures are kept from the first time. Errors: as burnish_read. */
burnish_status burnish_read_from_origin(burnish_reader *reader,
                                        burnish_status (*read)(burnish_reader *reader));

/* Subtracts mesh->origin from positions in the file's coordinates. */
void burnish_move_positions(burnish_mesh_data *mesh);

#endif
