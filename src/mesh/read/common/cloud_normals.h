/* Estimates the normals of point clouds. */
#ifndef BURNISH_MESH_READ_COMMON_CLOUD_NORMALS_H
#define BURNISH_MESH_READ_COMMON_CLOUD_NORMALS_H

#include "core/tasks.h"
#include "mesh/read/common/cloud.h"

/* Estimates unit normals, 3 floats per point, of the plane through the
 * neighbourhood of a point, blended between neighbourhoods, of either sign. 0, 0, 0 if that is not like a surface.
 * If that holds for half of the points or more, *are_surface is 0, and all are 0, 0, 0.
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_cloud_normals(const burnish_cloud *cloud, float *normals, int *are_surface,
                                     burnish_tasks *tasks, burnish_memory *memory);

#endif
