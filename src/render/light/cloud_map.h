/* Depth maps of point clouds. */
#ifndef BURNISH_RENDER_LIGHT_CLOUD_MAP_H
#define BURNISH_RENDER_LIGHT_CLOUD_MAP_H

#include "burnish/mesh.h"
#include "raster/view.h"

/* Draws a cloud into a pair of square maps, along and against a direction: each point as a square
 * about as wide as its disc. Points outside, or so near the edge that they would be cut, are left
 * out. Of points much smaller than a texel, only as many are drawn as fill the map.
 *   view    orthographic, from the middle of the maps
 *   depths  size x size each, all 0 */
void burnish_cloud_map_draw(const burnish_mesh_view *mesh, const burnish_raster_view *view,
                            int size, uint16_t *const depths[2]);

#endif
