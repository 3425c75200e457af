/* Area lights, domes and environments (burnish/light.h) in a frame. Distant ones become maps, once
 * per frame or until they change; near ones are integrated for some pixels (near_cells.h). */
#ifndef BURNISH_RENDER_LIGHT_AREA_H
#define BURNISH_RENDER_LIGHT_AREA_H

#include "base/memory.h"
#include "burnish/light.h"
#include "burnish/render.h"
#include "core/vec3.h"
#include "environment/light_maps.h"
#include "render/render_ops.h"
#include "render/texture/texture.h"
#include "shading/shading_ops.h"

/* ---- Near lights, integrated over points, and the one that casts a shadow (area_near.c) ---- */

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

/* ---- area.c ---- */

/* The camera, in the raster's space, in which a point p of the mesh is at (p - origin) scale. */
typedef struct burnish_area_view {
    double axes[3][3]; /* right, up, toward the viewer */
    double eye[3], origin[3], scale;
    double reach; /* from the camera to its focal point */
    double up[3]; /* of the object, a unit vector */
    int local_viewer;
    float viewer[3]; /* as burnish_kernels_lighting has it */
} burnish_area_view;

typedef struct burnish_area_material {
    burnish_reflecting_material reflecting;
    int alpha; /* its number in the alphas; not used with levels or without reflection */
} burnish_area_material;

/* Owned; all zero before the first frame. */
typedef struct burnish_area {
    burnish_environment_constants constants;
    burnish_light_maps *maps;        /* NULL: not created yet */
    burnish_near_lights near_lights; /* their alphas are followed by levels */
    int key;                 /* number of the area light whose shadow a depth map draws, or -1 */
    burnish_vec3 toward_key; /* the strongest one, from the object's centre, a unit vector;
                                         0: no shadow is cast on object or ground */
    burnish_area_material *materials; /* one per material */
    size_t material_capacity;
    uint8_t *used; /* one per material: 1: a triangle has it */
    size_t used_capacity;
    uint64_t used_mesh; /* burnish_mesh_view.serial; 0: nobody's */
    float alphas[BURNISH_LIGHT_ALPHAS_MAX + BURNISH_LIGHT_LEVELS]; /* of this frame */
    int alpha_count, narrow_count, has_levels, first_level;        /* narrow: below ALPHA_USUAL */
    float least_alpha;
    burnish_light_map diffuse, specular[BURNISH_LIGHT_ALPHAS_MAX]; /* of the alphas */
    burnish_light_map levels[BURNISH_LIGHT_LEVELS];
} burnish_area;

/* A batch that was shaded. */
typedef struct burnish_area_batch {
    const burnish_kernels_points *points;
    int material, count;
    const burnish_textured_material *textured; /* NULL: its material is not special */
    const burnish_texture_scratch *textures;   /* read where it is special */
    burnish_near_scratch *scratch;
    /* near lights: the tile's cells (near_cells.h), where the points are, and whether each is shown,
     * >= 0; NULL: all are */
    const struct burnish_near_cells *cells;
    const burnish_screen_points *screen;
    const int32_t *shown;
    float (*open)[BURNISH_SEEN_BATCH]; /* where rays found what is mirrored; else NULL */
} burnish_area_batch;

/* Whether a frame has such lights. */
int burnish_area_is_needed(const burnish_render_options *options);

/* Prepares the lights of a frame.
 *   texturing  NULL: no material is special
 * Errors: MEMORY. */
burnish_status burnish_area_update(burnish_area *area, const burnish_drawn_mesh *mesh,
                                   const burnish_render_options *options,
                                   const burnish_area_view *view,
                                   const burnish_texturing *texturing, burnish_tasks *tasks,
                                   burnish_memory *memory);

/* Adds their light to the colours of a batch: arrays that are readable and writable up to a
 * multiple of 16. */
void burnish_area_add(const burnish_area *area, const burnish_kernels *kernels,
                      const burnish_render_ops *ops, const burnish_area_batch *batch,
                      float *const rgb[3]);

/* Adds to the colours of count points what a white, matt surface reflects. As above, but near lights
 * are integrated at each point. count <= BURNISH_NEAR_BATCH. */
void burnish_area_add_white(const burnish_area *area, const burnish_kernels *kernels,
                            const burnish_kernels_points *points, int count, float *const rgb[3]);

/* Adds what arrives at the object's centre around `count` directions w, unit vectors in the raster's
 * space: the mean radiance of all lights but the one that casts a shadow, through a lobe of order 2
 * and this zeta. count <= 256. */
void burnish_area_add_radiance(const burnish_area *area, const burnish_render_options *options,
                               const burnish_area_view *view, float zeta, const float *const w[3],
                               int count, float *const rgb[3]);

/* Points of a material over which near lights are integrated. */
typedef struct burnish_area_points {
    const burnish_kernels_points *points;
    int material, count;
    int only_specular;        /* 1: diffuse light is not wanted */
    const float *roughness;   /* of each point; NULL: the material's */
    const float *const *bent; /* three arrays, burnish_reflecting_points'; NULL: none */
} burnish_area_points;

/* Writes what arrives of near lights: BURNISH_NEAR_VALUES arrays. */
void burnish_area_integrate(const burnish_area *area, const burnish_kernels *kernels,
                            const burnish_area_points *points, burnish_near_scratch *scratch,
                            float (*values)[BURNISH_NEAR_BATCH]);

void burnish_area_destroy(burnish_area *area, const burnish_context *context);

/* Writes the area lights that shine, in the raster's space, and their numbers in the options; returns
 * how many there are. */
int burnish_area_list(const burnish_render_options *options, const burnish_area_view *view,
                      burnish_area_light lights[BURNISH_AREA_LIGHT_MAX], int numbers[]);

#endif
