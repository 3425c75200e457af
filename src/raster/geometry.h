/* A frame's vertices on the screen, and its triangles in batches: transformed, culled, bounded,
 * clipped.
 *
 * Data flow:
 *   positions -> burnish_geometry_update -> screen vertices; batches of visible triangles
 *             -> burnish_bin_tiles (bins.h) -> triangle lists per tile, a band of tile rows at a
 * time
 *             -> burnish_tile_draw (tile.h) -> depth, ids and attributes of a tile's pixels
 *             -> burnish_tile_next_fragments (fragments.h) -> fragments of complex pixels */
#ifndef BURNISH_RASTER_GEOMETRY_H
#define BURNISH_RASTER_GEOMETRY_H

#include <stddef.h>

#include "base/error.h"
#include "core/tasks.h"
#include "raster/raster_view.h"
#include "raster/tile_layout.h"

/* Where a vertex fell: 16 bytes, loaded as one vector. */
typedef struct burnish_screen_vertex {
    int32_t x, y;     /* 1/256 pixel */
    float depth;      /* z / w, nearer is larger */
    uint32_t outcode; /* which planes it lies beyond: BURNISH_OUT_... */
} burnish_screen_vertex;

enum {
    BURNISH_OUT_LEFT = 1,
    BURNISH_OUT_RIGHT = 2,
    BURNISH_OUT_BOTTOM = 4,
    BURNISH_OUT_TOP = 8,
    BURNISH_OUT_NEAR = 16,
    BURNISH_OUT_GUARD = 32,
    /* a triangle is rejected when all its vertices share one of these, clipped when one has one of
       those */
    BURNISH_OUT_REJECT = 31,
    BURNISH_OUT_CLIP = BURNISH_OUT_NEAR | BURNISH_OUT_GUARD
};

/* One item per vertex of the mesh, then one per vertex made by clipping. */
typedef struct burnish_screen_vertices {
    burnish_screen_vertex *items;
    float *inverse_w;  /* 1 / w; 0 for a vertex of the mesh that only clipped triangles use */
    size_t mesh_count; /* vertices of the mesh */
    size_t count;      /* with the clipped ones */
    size_t item_capacity, inverse_capacity;
} burnish_screen_vertices;

/* A vertex that clipping made: its weights in the mesh's triangle. */
typedef struct burnish_clip_vertex {
    uint32_t triangle;
    float weights[3];
} burnish_clip_vertex;

/* A triangle to be drawn, its area on the screen positive. */
typedef struct burnish_primitive {
    uint32_t vertices[3];   /* into burnish_screen_vertices */
    uint32_t id_and_facing; /* the mesh's triangle * 2, + 1 when it is back-facing */
} burnish_primitive;

enum {
    BURNISH_TASK_GRAIN = 4096, /* triangles or vertices of the mesh that one task handles */
    BURNISH_BATCH_SIZE = 16    /* triangles that are culled, and binned, at once */
};

/* Longest edge, in 1/256 pixel along an axis, whose edge functions fit 32 bits all over a tile that
 * the triangle touches: 2 * 24576 * (24576 + 64 * 256) < 2^31. */
enum { BURNISH_EDGE_32_BITS = 96 * BURNISH_SUBPIXELS };

/* Triangles with a longer edge are large: drawn cell by cell, with planes for depth and attributes
 * (large_simd.h), others stamp by stamp. */
enum { BURNISH_SMALL_EDGE = 48 * BURNISH_SUBPIXELS };
_Static_assert((int)BURNISH_SMALL_EDGE <= (int)BURNISH_EDGE_32_BITS, "stamps have 32-bit edges");

/* Neighbouring triangles, an item each; items of triangles that are not visible hold anything. */
typedef struct burnish_triangle_batch {
    float nearest[BURNISH_BATCH_SIZE]; /* depth of the nearest vertex */
    /* the HiZ cells that the bounds touch, from first to last: packed x and y */
    uint32_t first[BURNISH_BATCH_SIZE], last[BURNISH_BATCH_SIZE];
} burnish_triangle_batch;

typedef struct burnish_batch_header {
    uint16_t visible[2]; /* bit i: triangle i may be seen and is front-facing, back-facing */
    uint32_t tile;       /* that holds all of them, packed x and y; or BURNISH_NO_TILE */
} burnish_batch_header;
#define BURNISH_NO_TILE UINT32_MAX

/* The mesh that is drawn: triangles, or points. */
typedef struct burnish_triangles {
    const float *positions; /* 3 per vertex */
    size_t vertex_count;
    const uint32_t *indices; /* 3 per triangle; NULL: points, each of which counts as a triangle */
    size_t triangle_count;   /* or points, as many as vertices */
    /* per batch; bit i: triangle i is transparent and counts BURNISH_LAYER_WORK times. NULL: none
     */
    const uint16_t *transparent;
    float point_radius; /* in units of the positions; read if there are no indices */
} burnish_triangles;

/* How much longer a sample of a transparent triangle takes than one of an opaque triangle, at most:
 * it moves up to 31 other layers. */
enum { BURNISH_LAYER_WORK = 28 };

/* What spheres of one radius are drawn with: discs, whose plane faces the viewer. */
typedef struct burnish_point_view {
    float radius_w; /* a disc's radius in pixels times w */
    float nearer_z,
        nearer_w; /* added to z and w: from a sphere's centre to its point nearest to the
                                 viewer */
    float right[3], up[3], forward[3]; /* unit vectors, in model space */
    float slope; /* of the ray through a pixel, per pixel from the image's centre; 0: parallel */
    int32_t center[2]; /* of the image, 1/256 pixel */
    float opacity;     /* of all points; the alpha of their colours counts too. Depth ignores it */
} burnish_point_view;

/* A frame's geometry; every array but the mesh's indices is owned. All zero before the first frame;
 * later frames use the arrays again. A primitive has the index of its triangle in the mesh;
 * primitives made by clipping follow the mesh's last batch. */
typedef struct burnish_geometry {
    const burnish_context *context;
    burnish_screen_vertices vertices;
    burnish_clip_vertex *clip_vertices; /* vertices.count - vertices.mesh_count of them */
    const uint32_t *indices;            /* the mesh's; NULL: points */
    burnish_point_view points;          /* valid if there are points */
    uint32_t *clipped_indices;          /* 3 per clipped triangle, into vertices */
    uint32_t *clipped_ids;              /* the mesh's triangle of each */
    burnish_triangle_batch *batches;    /* the mesh's, then the clipped ones */
    burnish_batch_header *headers;      /* one per batch */
    size_t mesh_batches, clipped_count;
    size_t batch_count;    /* with the clipped ones */
    size_t triangle_count; /* visible ones */
    /* Upper bound of the HiZ cells that large visible triangles touch: per triangle, the cells of
     * its bounds or, if that is fewer, of its area and outline. Small ones, whose bounds are at
     * most two cells wide and high, are not counted: they take about as long as being listed. Cells
     * of transparent ones count BURNISH_LAYER_WORK times. */
    uint64_t cells;
    struct burnish_geometry_part *parts; /* what each task found */
    size_t batch_capacity, header_capacity, clip_capacity, index_capacity, id_capacity;
    size_t part_capacity;
} burnish_geometry;

/* The primitive of an index. A front face's winding turns round on the screen, where y points
 * down. */
static inline burnish_primitive burnish_geometry_primitive(const burnish_geometry *geometry,
                                                           size_t index, unsigned back) {
    const size_t mesh_end = geometry->mesh_batches * BURNISH_BATCH_SIZE;
    const uint32_t *v = geometry->indices + 3 * index;
    uint32_t id = (uint32_t)index;
    if (index >= mesh_end) {
        v = geometry->clipped_indices + 3 * (index - mesh_end);
        id = geometry->clipped_ids[index - mesh_end];
    }
    return (burnish_primitive){{v[0], v[2 - back], v[1 + back]}, id * 2 + back};
}

/* Transforms, culls, clips. triangles->indices must outlive the geometry's use; the context is the
 * tasks'. The result does not depend on threads or the instruction set.
 * Errors: MEMORY, LIMIT; destroy it all the same. */
burnish_status burnish_geometry_update(burnish_geometry *geometry, const burnish_raster_ops *ops,
                                       const burnish_raster_view *view,
                                       const burnish_triangles *triangles, burnish_tasks *tasks,
                                       burnish_error *error);

/* How often large triangles that touch so many cells (geometry.cells) cover a picture. */
static inline double burnish_overdraw(uint64_t cells, const burnish_raster_view *view) {
    enum { PIXELS = BURNISH_HIZ_PIXELS * BURNISH_HIZ_PIXELS };
    return (double)cells * PIXELS / ((double)view->width * view->height);
}

/* How often they may: `most` times, and a picture of less than least_area pixels as many times
 * more. */
static inline double burnish_overdraw_limit(const burnish_raster_view *view, double most,
                                            double least_area) {
    const double area = (double)view->width * view->height;
    return most * (area < least_area ? least_area / area : 1);
}

/* LIMIT where they do more often than that limit; "the triangles cover `what` N times ...". */
burnish_status burnish_check_overdraw(double overdraw, double limit, const char *what,
                                      burnish_error *error);

void burnish_geometry_destroy(burnish_geometry *geometry);

/* ---- clip_polygon.c ---- */

/* A corner of a polygon while it is clipped. */
typedef struct burnish_clip_corner {
    float position[4]; /* x, y, z, w as burnish_raster_view defines them */
    float weights[3];  /* in the triangle */
} burnish_clip_corner;

enum { BURNISH_CLIP_MAX = 8 }; /* corners of a triangle cut by five planes */

/* Cuts a convex polygon by the near plane and the guard band.
 *   corners  `count` of them, room for BURNISH_CLIP_MAX
 *   count    [3, BURNISH_CLIP_MAX]
 * Returns the number left, 0 or 3 .. BURNISH_CLIP_MAX: corners beyond that, which only rounding can
 * make of a triangle, are dropped. A point on an edge that two triangles share comes out with the
 * same bits for both. */
int burnish_clip_polygon(burnish_clip_corner *corners, int count);

#endif
