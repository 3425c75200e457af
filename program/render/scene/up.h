/* A guess of the up axis. */
#ifndef TOOL_RENDER_UP_H
#define TOOL_RENDER_UP_H

#include "burnish/mesh.h"

/* 1: the format's up axis is +Y or +Z, the object would fall over on it, and is stable on the other
 * one. 0 for formats with another axis. */
int render_stands_otherwise(const burnish_mesh_view *view);

#endif
