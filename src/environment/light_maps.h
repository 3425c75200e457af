/* Light that arrives from far away, as tables: the mean radiance around a direction, weighted by
 * the cosine (diffuse) or by lobes (specular), for distant area lights, a dome and an environment. */
#ifndef BURNISH_ENVIRONMENT_LIGHT_MAPS_H
#define BURNISH_ENVIRONMENT_LIGHT_MAPS_H

#include "burnish/kernels.h"
#include "burnish/light.h"
#include "core/tasks.h"
#include "shading/light_map.h"

/* The most maps of one alpha each, and the most texels per side of a map. A look-up in a map of at most
 * BURNISH_LIGHT_MAP_USUAL texels per side costs less than computing it. */
enum {
    BURNISH_LIGHT_ALPHAS_MAX = 16,
    BURNISH_LIGHT_MAP_USUAL = 256,
    BURNISH_LIGHT_MAP_LARGEST = 1024
};

/* All in the space of the maps. */
typedef struct burnish_light_sources {
    const burnish_area_light *distant;      /* is_distant and follows_camera are not read */
    int distant_count;                      /* [0, BURNISH_AREA_LIGHT_MAX] */
    const burnish_dome *dome;               /* NULL: none */
    double up[3];                           /* of the dome, a unit vector */
    const burnish_environment *environment; /* NULL: none */
    float strength;                         /* factor of the environment, [0, 1e6] */
    double environment_axes[3][3];          /* its axes x, y (up), z: orthonormal rows */
    int largest; /* texels per side, even, [24, BURNISH_LIGHT_MAP_LARGEST]; 0: USUAL */
} burnish_light_sources;

typedef struct burnish_light_maps burnish_light_maps;

/* *maps: NULL on error. context: must outlive them; NULL: the default. Errors: MEMORY. */
burnish_status burnish_light_maps_create(const burnish_context *context, burnish_light_maps **maps,
                                         burnish_error *error);

/* NULL is allowed. */
void burnish_light_maps_destroy(burnish_light_maps *maps);

/* Sets the sources, which are copied except for the environment, which must outlive look-ups. If they
 * differ from the last ones, all maps are dropped.
 *   kernels  NULL: the best; do not affect the maps
 * Errors: MEMORY. */
burnish_status burnish_light_maps_set(burnish_light_maps *maps,
                                      const burnish_light_sources *sources,
                                      const burnish_kernels *kernels, burnish_error *error);

/* D(N) of light.h. Valid until the sources change. */
const burnish_light_map *burnish_light_maps_diffuse(const burnish_light_maps *maps);

/* Spec(R, alpha) of light.h, kept as long as the sources are the same. Valid until the next
 * burnish_light_maps_set(), after which another map may replace it.
 *   alpha  clamped to [burnish_light_least_alpha(sources.largest), 1]
 * Errors: MEMORY, LIMIT (more than BURNISH_LIGHT_ALPHAS_MAX since then: use the levels). */
burnish_status burnish_light_maps_need(burnish_light_maps *maps, float alpha,
                                       burnish_light_map *specular, burnish_error *error);

/* The same for the levels from `first`, [0, BURNISH_LIGHT_LEVELS), on; the others are copies of it.
 * Level 0 has the least alpha; if level 1 has, too, it is a copy. */
burnish_status burnish_light_maps_levels(burnish_light_maps *maps, int first,
                                         burnish_light_map levels[BURNISH_LIGHT_LEVELS],
                                         burnish_error *error);

/* Computes all texels of a map now: look-ups of large pictures then need not check. tasks NULL: by the
 * caller alone. */
void burnish_light_map_complete(burnish_light_map *map, burnish_tasks *tasks);

/* The alpha of level 1. Maps of 256 texels per side have no more detail than that. */
#define BURNISH_LIGHT_ALPHA_USUAL 0.015625f

/* The alpha of the narrowest lobe that maps with so many texels per side can show: a texel is at most
 * 0.7 of its radius. */
static inline float burnish_light_least_alpha(int largest) {
    return largest > BURNISH_LIGHT_MAP_USUAL ? 3 / (float)largest : BURNISH_LIGHT_ALPHA_USUAL;
}

/* Axes of an environment whose y axis is `up` (not 0), turned by `degrees` about it,
 * counter-clockwise from above. For up = y and 0 degrees they are x, y, z; for another up they are
 * rotated with it by the shortest way. */
void burnish_light_axes(const double up[3], double degrees, double axes[3][3]);

#endif
