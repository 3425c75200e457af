/* Ambient occlusion: how much of the sky a point sees. The mesh's depth is drawn from directions
 * spread over the sphere; a direction does not see a point if its depth map shows something nearer.
 */
#ifndef BURNISH_RENDER_LIGHT_OCCLUSION_H
#define BURNISH_RENDER_LIGHT_OCCLUSION_H

#include "burnish/mesh.h"
#include "burnish/render.h"
#include "render/light/maps/depth_map.h"
#include "render/light/maps/vertex_clusters.h"

enum { BURNISH_OCCLUDED_MAX = 256 /* points that are looked up at once */ };

/* Texels along the edge of a depth map, and of a cell, whose nearest depth is also stored. */
enum { BURNISH_OCCLUSION_SMALL = 128, BURNISH_OCCLUSION_LARGE = 256, BURNISH_OCCLUSION_CELL = 8 };

/* A direction and the one against it, for points that count from the eye in the raster's space. A
 * point faces one of them. */
typedef struct burnish_occlusion_pair {
    float toward[3],
        weight[2]; /* unit vector; of what arrives from there and from the other side */
    burnish_map_rows map;
    const uint16_t *depths; /* size^2, growing toward the sky */
    /* (size / CELL)^2: the largest of each cell, followed by the largest of each 2 x 2 cells */
    const uint16_t *blockers;
} burnish_occlusion_pair;

/* Parameters of a look-up. */
typedef struct burnish_occlusion_lookup {
    int count, size; /* of pairs; texels along an edge */
    const burnish_occlusion_pair *pairs;
    int32_t back;   /* offset from a map's codes to the codes of the opposite map */
    float strength; /* [0, 1]: what a point that sees no sky loses of its direct light */
    int is_traced;  /* 1: rays are cast instead */
    float mean[3];  /* light of the surfaces that are seen, on white */
    float offset;   /* along the normal, off the surface that the maps show */
    float slope;    /* a texel's width nearer by depth hides all of a point */
    float plane;    /* burnish_map_plane */
    float cone;     /* radius of a direction's cone, in texels, per code of distance */
    float least_radius, most_radius; /* of the filter, in texels */
    float reach;                     /* points so near share a look-up, in the raster's space */
    int share;                       /* pixels along the edge of the squares that share: 2 or 4 */
} burnish_occlusion_lookup;

/* Depth maps of a mesh, kept from frame to frame. All zero before the first. */
typedef struct burnish_occlusion {
    uint64_t mesh;       /* whose maps they are, burnish_mesh_view.serial; 0: nobody's */
    int count, size;     /* of directions */
    double max_overdraw; /* the drawer's then: a lower one may refuse them */
    burnish_occlusion_pair pairs[BURNISH_OCCLUSION_MAX / 2];
    uint16_t *depths; /* and each map's blockers after it */
    size_t capacity;
    burnish_map_drawer drawer;
    burnish_clusters clusters;
} burnish_occlusion;

/* What map i of `count`, an even number, shows: i + 1 is against i where i is even. */
burnish_map_view burnish_occlusion_view(int i, int count, int size);

/* Depth map i. */
const uint16_t *burnish_occlusion_depths(const burnish_occlusion *occlusion, int i);

/* Which maps, and where they are looked up from. */
typedef struct burnish_occlusion_options {
    int count; /* directions, [1, BURNISH_OCCLUSION_MAX], or BURNISH_OCCLUSION_AUTO; odd: one more
                */
    int side;  /* pixels along the shorter edge of the picture */
    const double *eye; /* the camera, in the raster's space */
    double pixel;      /* about what one is wide at the mesh, in the raster's space */
} burnish_occlusion_options;

/* Draws the maps unless they are there, and prepares the look-up. The drawer's transparent
 * triangles are the caller's to set; the mesh has another serial if they are others. Errors:
 * MEMORY, CANCELLED; the maps are then nobody's. */
burnish_status burnish_occlusion_update(burnish_occlusion *occlusion, const burnish_mesh_view *mesh,
                                        const burnish_occlusion_options *options,
                                        burnish_tasks *tasks, burnish_memory *memory,
                                        burnish_occlusion_lookup *lookup);

/* Sets the directions' weights; burnish_occlusion_update sets them to 1.
 *   light  of direction i, and of the one against it where i is odd; >= 0, of any unit */
void burnish_occlusion_weigh(burnish_occlusion *occlusion, const float *light);
void burnish_occlusion_destroy(burnish_occlusion *occlusion, const burnish_context *context);

#endif
