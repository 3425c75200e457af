/* From positions on the screen back to positions in space. */
#ifndef BURNISH_RENDER_SCREEN_H
#define BURNISH_RENDER_SCREEN_H

/* How a point of the screen becomes one of space. What is visible at (x, y), in pixels from the
 * image's centre, right and up, lies from the eye at
 *   (ray + x ray_x + y ray_y + (1 - depth) ray_depth) / q,
 *   q = depth * q_per_depth + q_constant (1/w in perspective, 1 in parallel projection). */
typedef struct burnish_rays {
    float ray[3], ray_x[3], ray_y[3], ray_depth[3];
    float q_per_depth, q_constant;
} burnish_rays;

/* Points of the screen: (x + x_offset[i], y + y_offset[i]) with the depth of what they show. */
typedef struct burnish_screen_points {
    float x, y;
    const float *x_offset, *y_offset, *depth;
} burnish_screen_points;

#endif
