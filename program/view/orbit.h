/* Moving a camera interactively. It uses libm, which does not affect the bits of pictures: the
 * printed command has the resulting numbers. */
#ifndef TOOL_VIEW_ORBIT_H
#define TOOL_VIEW_ORBIT_H

#include "burnish/mesh.h"

/* Rotates the camera around the focal point. Afterwards `up` points up in the picture, and the
 * camera is at most straight above or below.
 *   azimuth, elevation  degrees, to the right and upward */
void view_orbit(burnish_camera *camera, const double up[3], double azimuth, double elevation);

/* Moves camera and focal point in the plane of the picture, by shares of its height to the right
 * and upward. */
void view_pan(burnish_camera *camera, double right, double upward);

/* Zooms in by a factor. The point at (x, y), in shares of the picture's height from its middle,
 * stays. */
void view_zoom(burnish_camera *camera, double factor, double x, double y);

/* Changes from perspective to parallel projection or back, with the same size at the focal point.
 * The camera stays outside of the object's radius. */
void view_change_projection(burnish_camera *camera, double radius);

#endif
