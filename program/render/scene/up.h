/* A guess of the up axis. */
#ifndef TOOL_RENDER_UP_H
#define TOOL_RENDER_UP_H

#include "burnish/mesh.h"
#include "render/settings/settings.h"

/* How an object stands on the format's up axis and on the other one of +Y and +Z. */
typedef struct render_stance {
    int usual, other; /* 1: +Y, 2: +Z; both 0 if nothing is guessed: the format states its axis */
    double
        tipping[3]; /* for these axes: the angle in degrees by which the object can lean before it
                          falls, below 0 if it falls; 90 for a flat object that lies */
    const char
        *reason;   /* why it takes the other axis; NULL: it does not. "stability": it would fall
                           over on the usual one. Of clouds: "terrain", "geographic"; and "camera", which takes -Y */
    int flat_axis; /* 1 + the axis on which a flat object has no extent; 0: it is not flat */
    double slant
        [3]; /* the normal of a sheet in a slanted plane, towards the side it faces; or 0, 0, 0 */
} render_stance;

/* OBJ, PLY, OFF and arrays take the other axis if the object can lean by less than 5.7 degrees on
 * the usual one, or -5.7 if its surface is open, and by 21.8 or more on the other; if it falls over
 * on the usual one, 10 are enough. STL, whose axis is more reliable: less than 2, and 60. A flat
 * object, with an extent of at most 0.5 % of its longest one, keeps the usual axis: it is a drawing,
 * which does not need to stand. Points have no faces to stand on: their clouds take +Z if they are
 * lower along Z than 0.3 of their extents along X and Y, as terrain and buildings are, or if they
 * are farther than 10,000 and four times their size from the origin along X and Y, as geographic
 * coordinates are. A PCD whose points are all in the view of a depth camera at 0, 0, 0 takes -Y. */
render_stance render_find_stance(const burnish_mesh *mesh);

/* Whether the object's lowest points carry it: the centre of its surface is above the convex hull
 * of its contact area, or leans over by less than 5.7 degrees, and the hull is not a point or a
 * line. A flat object, points and lines do not stand. */
int render_stands(const burnish_mesh *mesh, const double up[3]);

/* Sets what UP_AUTO and the default view take from the mesh. */
void render_set_stance(const burnish_mesh *mesh, render_camera_settings *camera);

#endif
