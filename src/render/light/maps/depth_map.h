/* Depth maps: the mesh's depth along one direction in parallel projection, drawn by the rasteriser.
 * Ambient occlusion and shadows look points up in them. */
#ifndef BURNISH_RENDER_LIGHT_DEPTH_MAP_H
#define BURNISH_RENDER_LIGHT_DEPTH_MAP_H

#include "base/memory.h"
#include "burnish/mesh.h"
#include "core/vec3.h"
#include "raster/maps.h"
#include "raster/raster_view.h"
#include "raster/tile.h"

/* Codes of depth, [0, BURNISH_MAP_CODES], cover this much of the raster's space. */
#define BURNISH_MAP_RANGE 4.0

enum { BURNISH_MAP_PAIRS = 128 }; /* that are drawn by one call, at most */

/* What a map shows of the raster's space. */
typedef struct burnish_map_view {
    burnish_vec3 toward, right, up; /* unit vectors, depth grows toward `toward` */
    int size;                       /* texels along an edge */
    double texels;                  /* per unit */
} burnish_map_view;

/* A point (p, 1) of the raster's space in a map: column, row and depth are dot products with these.
 * The centres of texels are whole numbers; depth counts in codes. */
typedef struct burnish_map_rows {
    float column[4], row[4], depth[4];
} burnish_map_rows;

/* Memory and settings for drawing maps; kept from map to map. All zero before the first. */
typedef struct burnish_map_drawer {
    const burnish_raster_ops *ops; /* the caller's to set */
    burnish_geometry geometry;
    burnish_bins bins;
    burnish_tile *tiles; /* one per thread */
    int tile_count;
    burnish_map_vertex *vertices; /* of each thread's pairs of maps */
    size_t vertex_capacity;
    const uint16_t *transparent; /* triangles that are left out, as burnish_transparency's masks, or
                                    NULL; the caller's to set */
    double max_overdraw;         /* of each map; the caller's to set */
} burnish_map_drawer;

/* The view along a direction in which the unit sphere fills the map but for two texels at each
 * edge.
 *   right  a unit vector across toward */
burnish_map_view burnish_map_view_make(burnish_vec3 toward, burnish_vec3 right, int size);

/* The view against another one, at the same texels: it is a mirror's. */
static inline burnish_map_view burnish_map_view_back(burnish_map_view view) {
    view.toward = burnish_vec3_scale(view.toward, -1);
    return view;
}

/* Factor for the slope of a surface's plane in a map: codes per texel are
 * -burnish_map_plane (normal . column, normal . row) / (normal . toward). */
static inline double burnish_map_plane(const burnish_map_view *view) {
    return BURNISH_MAP_CODES / (BURNISH_MAP_RANGE * view->texels * view->texels);
}

/* The rows for points that count from `eye`. */
burnish_map_rows burnish_map_rows_make(const burnish_map_view *view, const double eye[3]);

/* Draws the mesh's depth.
 *   depths  receives view->size^2 codes, row after row from the top
 * Errors: MEMORY, CANCELLED, LIMIT; destroy the drawer all the same. */
burnish_status burnish_map_draw(burnish_map_drawer *drawer, const burnish_mesh_view *mesh,
                                const burnish_map_view *view, uint16_t *depths,
                                burnish_tasks *tasks, burnish_memory *memory);

/* Called for a map of size^2 codes as soon as it is drawn, while it is in cache. */
typedef void burnish_map_finish(uint16_t *depths, size_t size);

/* Pairs of maps of one size, which is a multiple of 16 and at most BURNISH_MAPS_SIZE. */
typedef struct burnish_map_pairs {
    const burnish_map_view
        *views;                 /* of each pair's first map; burnish_map_view_back of the other */
    int count;                  /* of pairs, at most BURNISH_MAP_PAIRS */
    uint16_t *depths;           /* receives the maps, pair after pair */
    size_t stride;              /* codes from a map to the next */
    burnish_map_finish *finish; /* or NULL */
} burnish_map_pairs;

/* Draws pairs of maps. Errors: MEMORY, CANCELLED, LIMIT; destroy the drawer all the same. */
burnish_status burnish_map_pairs_draw(burnish_map_drawer *drawer, const burnish_mesh_view *mesh,
                                      const burnish_map_pairs *pairs, burnish_tasks *tasks,
                                      burnish_memory *memory);

void burnish_map_drawer_destroy(burnish_map_drawer *drawer, const burnish_context *context);

#endif
