/* burnish/light.h: area lights, domes and environments: light that arrives from more than one
 * direction.
 *
 * Their radiance L is linear; a hemisphere of radiance 1 lights a white, matt surface to 1, as Ia
 * does. render.h adds for each point
 *   kd D(N) + Spec(R, alpha) (F0 A + B)
 * with unit vectors N (normal), V (viewer) and R = 2 (N.V) N - V, which for metallic-roughness
 * materials is moved toward N by alpha^2:
 *   D(N)           1/pi integral of L max(0, N.w) over the directions w
 *   Spec(R, alpha) mean of L over the directions w, weighted by lobes of R.w as wide as the
 *                  highlight of a material of this alpha
 *   A, B           functions of alpha and N.V: what GGX reflects of uniform light, A + B within
 *                  0.013 and B within 0.015 from N.V = 0.05 on
 *   kd, F0, alpha  metallic-roughness: base (1 - metallic), reflectance (1 - metallic) + base
 *                  metallic, roughness^2; Phong: kd, min(1, 8 ks / (n + 4)), sqrt(2 / (n + 2)). A
 *                  Phong material with ks 0 reflects nothing
 * Metallic-roughness materials also reflect light several times (Fdez-Aguera, A Multiple-Scattering
 * Microfacet Model for Real-Time Image Based Lighting, 2019), and their kd is multiplied by the
 * share that is not reflected, so a white surface in uniform light of 1 is 1. 0.8 alpha^1.5 of
 * their Spec is D(N) instead: GGX's tails, which the lobes cut off.
 * The kd of a Phong material is at most 1 - (F0 A + B): white surfaces with a highlight reflect no
 * more than they receive.
 * For Phong materials, an area light that shrinks to solid angle W becomes a directional light of
 * colour L W / pi.
 *
 * Ambient occlusion weighs the directions that a point sees by the light that arrives from them, so
 * area lights, domes and environments cast soft shadows. One area light can cast a sharper one
 * (burnish_render_options.shadow), as if all of its light came from its centre; occlusion of at least
 * half strength replaces it on the object if the light is wider than 0.35 sr.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_LIGHT_H
#define BURNISH_LIGHT_H

#include "burnish/core.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum burnish_area_shape {
    BURNISH_AREA_RECT,   /* corners: center +- half_u +- half_v */
    BURNISH_AREA_DISC,   /* the ellipse center + cos(t) half_u + sin(t) half_v */
    BURNISH_AREA_SPHERE, /* around center, with a radius of |half_u| */
    BURNISH_AREA_LINE    /* a tube from center - half_u to center + half_u, with open ends and a
                            radius of |half_v| */
} burnish_area_shape;

/* A light of constant radiance. It is not visible itself, only its reflections are. Spheres and
 * lines shine in all directions. A point inside is lit as on their surface, from the side of the
 * centre or axis. */
typedef struct burnish_area_light {
    burnish_area_shape shape;
    int is_distant; /* 1: seen in the same directions from everywhere, those from (0, 0, 0) to its
                           points */
    int follows_camera; /* 1: vectors are in camera space: x right, y up, z toward the viewer, the
                           camera at 0; the unit is the distance from camera to focal point. 0: in
                           the mesh's */
    int is_two_sided;   /* of a flat light. 0: it shines on points p with (p - center) . (half_u x
                           half_v) > 0; for a distant light p is 0. 1: on both sides */
    double center[3];
    double half_u[3], half_v[3]; /* half of each side: not parallel; any angle between them. A
                                    sphere has no half_v. The radius of a distant sphere or line is
                                    less than the length of center */
    float color[3];              /* radiance, [0, 1e6] */
} burnish_area_light;

/* The most area lights. */
#define BURNISH_AREA_LIGHT_MAX 8

/* Light from all directions w: with y = w.up, its radiance is the polynomial of degree 2 in y that
 * is nadir at y = -1, horizon at 0 and zenith at 1; it must not be negative between them. */
typedef struct burnish_dome {
    float zenith[3], horizon[3], nadir[3]; /* [0, 1e6] */
    int follows_camera;                    /* 1: up is the camera's y axis; 0: as
                                              burnish_render_options.up */
} burnish_dome;

/* The largest radiance of an environment. */
#define BURNISH_RADIANCE_MAX 1e6f

/* The longest side of an environment's image in pixels, and the most pixels. */
#define BURNISH_ENVIRONMENT_MAX_SIDE 32768
#define BURNISH_ENVIRONMENT_MAX_PIXELS ((uint64_t)1 << 27)

/* An image of the light from all directions. Immutable: any number of threads may use one.
 *
 * The image is equirectangular: the first row is up (y), the last row is down. With x and z
 * horizontal, the middle column is x and the one at three quarters of the width is z; render.h says
 * how these axes are turned. Each pixel has constant radiance over its range of angles. An image
 * with more than 1024 columns or 512 rows is reduced to 1024 x 512 by solid angle, which takes 17
 * MB; maps of light have no more detail.
 *
 * Values that are negative or not numbers count as 0, and values above BURNISH_RADIANCE_MAX as it;
 * the context's log receives one warning. */
typedef struct burnish_environment burnish_environment;

/* Creates an environment from linear colours.
 *   context        supplies memory, receives warnings; NULL: the default
 *   width, height  [1, BURNISH_ENVIRONMENT_MAX_SIDE], usually 2:1
 *   rgb            3 width height floats: red, green, blue of each pixel, rows from the top
 *   environment    receives it, NULL on error; release it with burnish_environment_destroy()
 * Errors: ARGUMENT, LIMIT, MEMORY. */
BURNISH_API burnish_status burnish_environment_create(const burnish_context *context, int width,
                                                      int height, const float *rgb,
                                                      burnish_environment **environment,
                                                      burnish_error *error);

/* Creates an environment that needs no file.
 *   name  "room": a white room with bright windows, after three.js' RoomEnvironment; "sky": a clear
 *         sky with the sun behind the viewer's left shoulder, over grey ground
 * Other parameters as for burnish_environment_create(). Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_environment_create_named(const burnish_context *context,
                                                            const char *name,
                                                            burnish_environment **environment,
                                                            burnish_error *error);

/* Creates an environment from bytes: Radiance HDR or, if the build has OpenEXR, EXR with channels
 * R, G and B, or Y alone or with RY and BY, in the first part of the file that has these. The
 * exposure of an HDR file is undone. A file may unpack to 256 bytes per byte, a small one to 256
 * MiB.
 *   name  for messages; NULL: "environment"
 * Errors: FORMAT, LIMIT, MEMORY; ARGUMENT (NULL, or EXR without OpenEXR). */
BURNISH_API burnish_status burnish_environment_decode(const burnish_context *context,
                                                      const void *bytes, size_t size,
                                                      const char *name,
                                                      burnish_environment **environment,
                                                      burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_environment_destroy(burnish_environment *environment);

#ifdef __cplusplus
}
#endif

#endif
