/* Near area lights, and the one that casts a shadow: their light is integrated over points. */
#ifndef BURNISH_RENDER_LIGHT_AREA_NEAR_H
#define BURNISH_RENDER_LIGHT_AREA_NEAR_H

#include "base/memory.h"
#include "burnish/light.h"
#include "shading/shading_ops.h"

enum { BURNISH_NEAR_BATCH = 256 };

/* What arrives at a point: the light of all lights but the one that casts a shadow, in three colours, and
 * how much of that one's. */
enum {
    BURNISH_NEAR_DIFFUSE = 0,
    BURNISH_NEAR_SPECULAR = 3,
    BURNISH_NEAR_KEY_DIFFUSE = 6,
    BURNISH_NEAR_KEY_SPECULAR,
    BURNISH_NEAR_VALUES
};

/* A frame's lights, each with the lobes of every roughness that is drawn. Owned; all zero before
 * the first frame. */
typedef struct burnish_near_lights {
    int count;
    burnish_area_light lights[BURNISH_AREA_LIGHT_MAX];
    int key; /* the light that casts a shadow, which may be distant, or -1 */
    int alpha_count;
    burnish_polygon_constants *polygons; /* `count` without lobes, then `count` for each alpha, then
                                            `count` for each with GGX's lobes and stretch */
    size_t polygon_capacity;
} burnish_near_lights;

/* Adds a light, in the space of the points. */
void burnish_near_lights_add(burnish_near_lights *lights, const burnish_area_light *light);

/* Prepares lobes of the alphas. Errors: MEMORY. */
burnish_status burnish_near_lights_prepare(burnish_near_lights *lights, const float *alphas,
                                           int alpha_count, burnish_memory *memory);

/* Points of a batch, at most BURNISH_NEAR_BATCH, and which lobes they have. */
typedef struct burnish_near_batch {
    const burnish_kernels_points *points;
    int count;
    int only_specular;      /* 1: diffuse light is not wanted */
    int is_stretched;       /* 1: GGX's lobes and stretch for near lights */
    int alpha;              /* number in the alphas; -1: no lobes */
    int level_count;        /* > 0: so many alphas from `alpha` on are levels, of roughness k /
                               (level_count - 1) */
    const float *roughness; /* of each point; read with levels */
} burnish_near_batch;

/* The points of a batch that no square has lit. */
typedef struct burnish_near_left {
    const int32_t *shown; /* only points that are shown, >= 0, are left; NULL: all are */
    int count[2];         /* that lack all light, and only specular light */
    int32_t number[2][BURNISH_NEAR_BATCH + 16];
} burnish_near_left;

/* A thread's arrays. */
typedef struct burnish_near_scratch {
    float axis[3][BURNISH_NEAR_BATCH];   /* as in maps */
    float leaned[6][BURNISH_NEAR_BATCH]; /* GGX's axis and stretch */
    float light[2][BURNISH_NEAR_BATCH], roughness[BURNISH_NEAR_BATCH];
    float values[BURNISH_NEAR_VALUES][BURNISH_NEAR_BATCH]; /* of a batch's points */
    burnish_near_left left;
    /* some of a batch's points: their normals, positions, w, and values */
    float rest[7][BURNISH_NEAR_BATCH], rest_values[BURNISH_NEAR_VALUES][BURNISH_NEAR_BATCH];
} burnish_near_scratch;

/* Writes what arrives at the points of a batch.
 *   scratch  its axes are read unless alpha is -1, the leaned ones if is_stretched */
void burnish_near_lights_shine(const burnish_near_lights *lights, const burnish_kernels *kernels,
                               const burnish_near_batch *batch, burnish_near_scratch *scratch,
                               float (*values)[BURNISH_NEAR_BATCH]);

/* Adds the light that casts a shadow to the colours of the others.
 *   lit  what of it reaches each point; NULL: all of it */
void burnish_near_lights_add_key(const burnish_near_lights *lights, const float *lit, int count,
                                 float (*values)[BURNISH_NEAR_BATCH]);

/* The number of the polygon of the first light with the lobes of an alpha; those of the other lights
 * follow it. */
int burnish_near_lights_row(const burnish_near_lights *lights, int alpha, int is_stretched);

void burnish_near_lights_destroy(burnish_near_lights *lights, const burnish_context *context);

#endif
