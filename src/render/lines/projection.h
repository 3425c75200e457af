/* From the mesh's space to the screen, in double precision. */
#ifndef BURNISH_RENDER_LINES_PROJECTION_H
#define BURNISH_RENDER_LINES_PROJECTION_H

#include "core/vector.h"
#include "render/lines/lines.h"

typedef struct burnish_line_projection {
    double rows[4][4];
    burnish_vec3 origin;
    double middle[2], size[2]; /* pixels */
    burnish_view_distance distance;
    int is_parallel;
    burnish_vec3 viewer; /* position, or in parallel projection the direction toward it */
} burnish_line_projection;

typedef struct burnish_clip_point {
    double x, y, z, w;
} burnish_clip_point;

burnish_line_projection burnish_line_project_view(const burnish_line_view *view,
                                                  const burnish_render_options *options);

burnish_clip_point burnish_line_project(const burnish_line_projection *p, burnish_vec3 position);

/* What is linear along a line on the screen at a point; see burnish_line_segment.key. */
double burnish_line_key(const burnish_line_projection *p, burnish_clip_point c);

#endif
