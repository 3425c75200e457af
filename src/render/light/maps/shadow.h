/* The shadow of one light on the mesh: one depth map toward the light. */
#ifndef BURNISH_RENDER_LIGHT_SHADOW_H
#define BURNISH_RENDER_LIGHT_SHADOW_H

#include "render/light/maps/depth_map.h"

enum { BURNISH_SHADOW_SMALL = 1024, BURNISH_SHADOW_LARGE = 2048 }; /* texels along an edge */

/* Parameters of a look-up, for points relative to the eye. */
typedef struct burnish_shadow_lookup {
    burnish_map_rows map;
    float toward[3]; /* the light */
    const uint16_t *depths;
    int size;
    float offset; /* along the normal, in the raster's space */
    float slope;  /* a texel's width nearer by depth hides a point */
    float plane;  /* burnish_map_plane */
    float radius; /* of the filter, in texels */
} burnish_shadow_lookup;

/* The map, kept from frame to frame. All zero before the first. */
typedef struct burnish_shadow {
    uint64_t mesh;       /* whose it is, burnish_mesh_view.serial; 0: nobody's */
    double max_overdraw; /* the drawer's then: a lower one may refuse it */
    burnish_vec3 toward;
    int size;
    uint16_t *depths;
    size_t capacity;
} burnish_shadow;

/* Which map, and where it is looked up from. */
typedef struct burnish_shadow_options {
    burnish_vec3 toward; /* the light, a unit vector */
    int size;
    int is_area;       /* its edge is softer */
    const double *eye; /* the camera, in the raster's space */
} burnish_shadow_options;

/* Draws the map unless it is there, and prepares the look-up.
 *   drawer  its transparent triangles, which cast no shadow, are the caller's to set; the mesh has
 *           another serial if they are others
 * Errors: MEMORY, CANCELLED, LIMIT; the map is then nobody's. */
burnish_status burnish_shadow_update(burnish_shadow *shadow, burnish_map_drawer *drawer,
                                     const burnish_mesh_view *mesh,
                                     const burnish_shadow_options *options, burnish_tasks *tasks,
                                     burnish_memory *memory, burnish_shadow_lookup *lookup);
void burnish_shadow_destroy(burnish_shadow *shadow, const burnish_context *context);

#endif
