/* Moving a camera by hand. No picture depends on libm: what is printed of a camera is its numbers.
 */
#ifndef TOOL_VIEW_ORBIT_H
#define TOOL_VIEW_ORBIT_H

#include "burnish/mesh.h"

/* Walks around the focal point; afterwards `up` points up in the picture, and the camera is at most
 * straight above or below.
 *   azimuth, elevation  degrees, to the right and upward */
void view_orbit(burnish_camera *camera, const double up[3], double azimuth, double elevation);

/* Moves camera and focal point in the plane of the picture by shares of its height, to the right
 * and upward. */
void view_pan(burnish_camera *camera, double right, double upward);

/* Nearer by a factor; what is at (x, y), shares of the picture's height from its middle, stays. */
void view_zoom(burnish_camera *camera, double factor, double x, double y);

/* From perspective to parallel projection and back; what is around the focal point keeps its size.
 *   radius  of the object, which the camera then stays out of */
void view_change_projection(burnish_camera *camera, double radius);

#endif
