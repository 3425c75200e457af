/* Which way is up, guessed. */
#ifndef TOOL_RENDER_UP_H
#define TOOL_RENDER_UP_H

#include "burnish/mesh.h"

/* 1: an object whose format says that it stands on one of +Y and +Z would fall over at once, and
 * stands well on the other. 0 for formats with another axis. */
int render_stands_otherwise(const burnish_mesh_view *view);

/* How well an object stands on an axis, 0 to 2: the tangent of the angle by which it may lean
 * before it falls; below 0 it does not stand. */
double render_tipping(const burnish_mesh_view *view, int axis);

#endif
