#include "render/light/backdrop.h"

#include "base/elementary.h"
#include "base/numbers.h"
#include "environment/environment.h"
#include "environment/light_maps.h"

/* Components along three axes. */
static void store_along(double axes[3][3], burnish_vec3 v, double out[3]) {
    for (int k = 0; k < 3; ++k) {
        out[k] = burnish_vec3_dot(burnish_vec3_load(axes[k]), v);
    }
}

/* In a parallel projection all pixels look in one direction, and would have one colour: they see
 * the environment as a perspective does. */
burnish_backdrop burnish_backdrop_make(const burnish_render_options *options, burnish_vec3 up) {
    const burnish_camera *camera = &options->camera;
    const int follows = options->environment_follows_camera;
    burnish_vec3 forward = burnish_vec3_normalize(burnish_vec3_sub(
        burnish_vec3_load(camera->focal_point), burnish_vec3_load(camera->position)));
    burnish_vec3 right =
        burnish_vec3_normalize(burnish_vec3_cross(forward, burnish_vec3_load(camera->view_up)));
    burnish_vec3 upward = burnish_vec3_cross(right, forward);
    double axes[3][3], sine, cosine, turned_up[3];
    if (follows) {
        right = (burnish_vec3){1, 0, 0};
        up = upward = (burnish_vec3){0, 1, 0};
        forward = (burnish_vec3){0, 0, -1};
    }
    burnish_vec3_store(up, turned_up);
    burnish_light_axes(turned_up, options->environment_turn, axes);
    burnish_sincos(camera->view_angle * (BURNISH_DEGREE / 2), &sine, &cosine);
    const double pixel = 2 * sine / cosine / options->height; /* at distance 1 */
    const double wide = pixel * options->pixel_aspect;
    const double x = (0.5 - 0.5 * options->width - options->principal_point[0]) * wide;
    const double y = (0.5 * options->height - 0.5 - options->principal_point[1]) * pixel;
    const burnish_vec3 corner = burnish_vec3_add(
        forward, burnish_vec3_add(burnish_vec3_scale(right, x), burnish_vec3_scale(upward, y)));
    burnish_backdrop backdrop = {options->environment,
                                 burnish_environment_level_of(options->environment, pixel),
                                 options->environment_strength,
                                 {0},
                                 {0},
                                 {0}};
    store_along(axes, corner, backdrop.corner);
    store_along(axes, burnish_vec3_scale(right, wide), backdrop.right);
    store_along(axes, burnish_vec3_scale(upward, -pixel), backdrop.down);
    return backdrop;
}

void burnish_backdrop_light(const burnish_backdrop *backdrop, int x, int y, float rgb[3]) {
    double direction[3];
    for (int k = 0; k < 3; ++k) {
        direction[k] = backdrop->corner[k] + x * backdrop->right[k] + y * backdrop->down[k];
    }
    burnish_environment_lookup(backdrop->environment, backdrop->level, direction, rgb);
    for (int k = 0; k < 3; ++k) {
        rgb[k] *= backdrop->strength;
    }
}
