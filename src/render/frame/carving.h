/* Negative volumes, subtracted sample by sample.
 *
 * Their triangles are drawn as if they followed the mesh's own. In a sample, the triangles of all
 * items that have negative volumes are layers. From the viewer on, each item's layers tell whether
 * one is in its solid, and in how many of its negative volumes. What is seen is the solid's first
 * surface outside of them or, inside the solid, the back of the last of them: that triangle is
 * drawn like any other.
 *
 * Shadows, occlusion, edges and the ground know nothing of it. */
#ifndef BURNISH_RENDER_FRAME_CARVING_H
#define BURNISH_RENDER_FRAME_CARVING_H

#include "raster/raster_ops.h"
#include "render/frame/caps.h"
#include "render/space.h"
#include "render/texture/transparency.h"

/* Per frame; arrays are owned. All zero before the first. */
typedef struct burnish_carving {
    burnish_mesh_view view; /* the mesh with its negative volumes */
    size_t own_count;       /* triangles of the mesh; 0: there are no negative volumes */
    uint64_t serial;        /* of the mesh that the arrays are of */
    int turned[2];          /* of solids and negative volumes: 1 if their back faces are outside */
    void *arrays[8];
    uint32_t *items;   /* per triangle: its item + 1; 0: nothing is subtracted from it */
    uint32_t *hosts;   /* per triangle of negative volumes: a triangle from whose item it cuts */
    uint16_t *masks;   /* as burnish_transparency.masks: carved triangles, */
    uint16_t *layered; /* and these and transparent ones */
    size_t mask_capacity, layered_capacity;
    burnish_cap_range range;
} burnish_carving;

/* Joins the mesh with its negative volumes; mesh->view becomes carving->view if it has some.
 * Errors: MEMORY. */
burnish_status burnish_carving_update(burnish_carving *carving, burnish_drawn_mesh *mesh,
                                      burnish_memory *memory);

/* Finds the masks and the planes of cuts. transparency: NULL where all is opaque; its masks lose
 * what is carved. Errors: MEMORY. */
burnish_status burnish_carving_find(burnish_carving *carving, const burnish_geometry *geometry,
                                    const burnish_transparency *transparency,
                                    const burnish_raster_view *view, burnish_memory *memory);
void burnish_carving_destroy(burnish_carving *carving, const burnish_context *context);

/* What a thread knows of its tile's samples. */
typedef struct burnish_carver burnish_carver;
burnish_carver *burnish_carver_create(int samples, burnish_memory *memory);

typedef struct burnish_carve_scene {
    const burnish_carving *carving;
    const burnish_raster_ops *ops;
    const burnish_raster_view *view;
    const burnish_geometry *geometry;
} burnish_carve_scene;

/* Draws the carved triangles of a tile whose other opaque triangles have been drawn. Returns 0
 * where more negative volumes, or layers, lie over a sample than it can count. */
int burnish_carve_tile(burnish_carver *carver, burnish_tile *tile, const burnish_carve_scene *scene,
                       const burnish_bins *bins);

/* The most negative volumes of an item over a sample. */
#define BURNISH_NEGATIVES_MAX 16

#endif
