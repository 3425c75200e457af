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
 *   A, B           functions of alpha and N.V: what a rough surface reflects of uniform light
 *                  (Karis, Physically Based Shading on Mobile, 2014)
 *   kd, F0, alpha  metallic-roughness: base (1 - metallic), reflectance (1 - metallic) + base
 *                  metallic, roughness^2; Phong: kd, min(1, 8 ks / (n + 4)), sqrt(2 / (n + 2)). A
 *                  Phong material with ks 0 reflects nothing
 * Metallic-roughness materials also reflect light several times (Fdez-Aguera, A Multiple-Scattering
 * Microfacet Model for Real-Time Image Based Lighting, 2019), and their kd is multiplied by the
 * share that is not reflected, so a white surface in uniform light of 1 is 1.
 * For Phong materials, an area light that shrinks to solid angle W becomes a directional light of
 * colour L W / pi.
 *
 * The lights do not cast shadows; ambient occlusion darkens them as it does all light.
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
    BURNISH_AREA_RECT, /* corners: center +- half_u +- half_v */
    BURNISH_AREA_DISC  /* the ellipse center + cos(t) half_u + sin(t) half_v */
} burnish_area_shape;

/* A flat light of constant radiance. It is not visible itself, only its reflections are. */
typedef struct burnish_area_light {
    burnish_area_shape shape;
    int is_distant; /* 1: seen in the same directions from everywhere, those from (0, 0, 0) to its
                           points */
    int follows_camera; /* 1: vectors are in camera space: x right, y up, z toward the viewer, the
                           camera at 0; the unit is the distance from camera to focal point. 0: in
                           the mesh's */
    int is_two_sided;   /* 0: it shines on points p with (p - center) . (half_u x half_v) > 0; for a
                           distant light p is 0. 1: on both sides */
    double center[3];
    double half_u[3], half_v[3]; /* half of each side: not parallel; any angle between them */
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

/* An image of the light from all directions. Immutable: any number of threads may use one. */
typedef struct burnish_environment burnish_environment;

#ifdef __cplusplus
}
#endif

#endif
