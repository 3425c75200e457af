/* What the steps of building a mesh share; build.c calls them in their order. */
#ifndef BURNISH_MESH_BUILD_BUILDER_H
#define BURNISH_MESH_BUILD_BUILDER_H

#include <string.h>

#include "core/vector.h"
#include "mesh/mesh.h"

enum {
    BURNISH_BUILD_GRAIN = 8192,   /* triangles, positions or vertices that are
                                     worth a thread */
    BURNISH_BUILD_STEP = 1 << 16, /* items of a serial loop before it asks whether to end */
    BURNISH_EXTRA_ATTRIBUTES = BURNISH_NORMAL + 1, /* the first one that is only passed on */
    BURNISH_ATTRIBUTE_BYTES = 16,                  /* of the largest attribute's items */
    BURNISH_TRIPLE = 3 * sizeof(uint32_t)          /* bytes of a triangle's corners */
};

/* An attribute besides position and normal: only passed on. */
typedef struct burnish_extra {
    burnish_attribute attribute;
    const uint32_t *corners; /* BURNISH_NONE: white, or 0 */
    const uint8_t *items;
} burnish_extra;

/* A triangle's unit normal, and twice its area. */
typedef struct burnish_face {
    burnish_vec3 normal;
    double length;
} burnish_face;

/* The welded mesh, to measure the faces around a vertex and to look beyond them. */
typedef struct burnish_surface {
    const float *positions;
    const uint32_t *corner_positions; /* 3 per triangle, every triangle with area */
    const uint32_t *first_corner;     /* as the builder has them */
    const uint32_t *corners;
    burnish_face *faces; /* 1 per triangle; NULL: too many, each is computed where it is needed */
} burnish_surface;

typedef struct burnish_builder {
    burnish_mesh_data *data;
    burnish_memory *memory; /* the data's */
    const char *name;       /* of the input */
    burnish_mesh *mesh;     /* the result */
    double crease_angle;
    int measure;        /* 1: the mesh gets its facts */
    int needs_tangents; /* 1: a material uses a normal texture */

    size_t position_count;      /* welded positions, at the head of data's positions */
    size_t triangle_count;      /* triangles with area, at the head of data's arrays */
    uint32_t *corner_positions; /* 3 per triangle: welded positions; may be those of data's
                                   positions */
    int has_extras;             /* attributes besides position and normal */
    int normals_complete;       /* every corner has a normal of the file's */

    uint32_t *order; /* of each triangle of the mesh, its number at present; NULL: as they are */

    uint32_t *first_corner; /* position_count + 1: where a position's corners start in ... */
    uint32_t *corners;      /* ... all corners, by position */
    size_t max_faces;       /* around one position */
    burnish_surface surface;
    burnish_extra extras[BURNISH_ATTRIBUTE_COUNT]; /* from the vertices on */
    int extra_count;
    size_t vertex_count;
} burnish_builder;

/* The file's normal of a corner, or NULL where one must be generated. */
static inline const float *burnish_file_normal(const burnish_mesh_data *data, size_t corner) {
    const uint32_t number = data->streams[BURNISH_NORMAL].count > 0
                                ? burnish_stream_corners(data, BURNISH_NORMAL)[corner]
                                : BURNISH_NONE;
    const float *n = number == BURNISH_NONE ? NULL : burnish_normals(data) + 3 * (size_t)number;
    return n && (n[0] != 0 || n[1] != 0 || n[2] != 0) ? n : NULL;
}

/* ---- triangles.c ---- */

/* Moves the different positions to the head of their array, keeps the triangles with area and fills
 * corner_positions; triangles whose winding contradicts the file's normals are turned. Makes the
 * file's normals unit vectors. Errors: FORMAT (nothing is left), MEMORY, CANCELLED. */
burnish_status burnish_build_triangles(burnish_builder *b);

/* Releases what is kept per corner but for `extras`, whose corners are needed until they are
 * written: most of the memory. */
void burnish_build_release_corners(burnish_builder *b, int extras);

/* Releases all numbers that corners have; the values, and the order, stay. */
void burnish_build_release_numbers(burnish_builder *b);

/* ---- measure.c ---- */

/* Fills the mesh's facts: once corner_positions are there, before triangles are turned or left out.
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_measure(burnish_builder *b);

/* ---- order.c ---- */

/* Finds an order of the triangles in space, so that neighbours there are neighbours in memory; it
 * depends on positions and corners only. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_order(burnish_builder *b);

/* Moves what there is per triangle into the order, which is released.
 *   corners  0: what only corners have stays where it is, since it was used in that order
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_move(burnish_builder *b, int corners);

/* ---- corners.c ---- */

/* Lists the corners of every position, in the order of the triangles: first_corner, corners and
 * max_faces. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_list_corners(burnish_builder *b);

/* ---- vertices.c ---- */

/* The mesh's vertices and indices: generates normals where the file has none. Errors: MEMORY,
 * CANCELLED. */
burnish_status burnish_build_vertices(burnish_builder *b);

burnish_status burnish_build_allocate_indices(burnish_builder *b);

/* The arrays of vertex_count vertices. */
burnish_status burnish_build_allocate_vertices(burnish_builder *b);

/* Lists the attributes besides position and normal. */
void burnish_build_find_extras(burnish_builder *b);

/* Copies an item by its number; returns the bytes that it takes. */
static inline size_t burnish_copy_extra(const burnish_extra *extra, uint32_t number, uint8_t *to) {
    const size_t size = burnish_attribute_size(extra->attribute);
    if (number == BURNISH_NONE) {
        memset(to, extra->attribute == BURNISH_COLOR ? 255 : 0, size);
    } else if (size == 4) {
        memcpy(to, extra->items + 4 * (size_t)number, 4);
    } else {
        memcpy(to, extra->items + size * number, size);
    }
    return size;
}

/* ---- indexed.c ---- */

/* Indices and vertices of a mesh with the file's normals and at most one attribute besides, by
 * their numbers. *done becomes 0, and no vertex is made, for others and where a position has many.
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_indexed(burnish_builder *b, int *done);

/* ---- textures.c ---- */

/* Drops what the mesh does not need of textures, coordinates and tangents, before it is built. */
void burnish_build_prepare_textures(burnish_builder *b, const burnish_load_options *options);

/* Generates tangents where they are needed and the file has none; makes them unit vectors at right
 * angles to the normals. Mirrored triangles may get vertices of their own. Errors: MEMORY, LIMIT,
 * CANCELLED. */
burnish_status burnish_build_tangents(burnish_builder *b);

/* ---- weld.c: finding equal vertices, in time that no input can make quadratic ---- */

/* Numbers bitwise equal positions alike, in the order of their first appearance.
 *
 * O(n) for meshes as they are, O(n log n) for any input whatsoever; the result depends on the
 * positions only.
 *
 * from:   3 floats per position; -0 counts as 0
 * count:  [0, 2^32 - 2]
 * tasks:  threads to share the work
 * remap:  count numbers, written
 * to:     room for count positions, may be `from`: the different ones, by number, are written
 * unique: how many different positions there are, written
 * Errors: MEMORY, LIMIT, CANCELLED. */
burnish_status burnish_weld(const float *from, size_t count, burnish_tasks *tasks,
                            burnish_memory *memory, uint32_t *remap, float *to, size_t *unique);

/* Of items that each tell the first one equal to it, no later than itself: numbers them in the
 * order of those first ones, in place. Returns how many there are; when cancelled, too few. */
size_t burnish_number_heads(burnish_tasks *tasks, uint32_t *heads, size_t count);

/* Words that a vertex of one position can differ in: normal, colour, texture coordinates, tangent.
 */
enum { BURNISH_WELD_KEY_WORDS = 10 };

/* Something to be sorted by words; the value breaks ties, so that the order is total. */
typedef struct burnish_weld_record {
    uint32_t key[BURNISH_WELD_KEY_WORDS];
    uint32_t value;
} burnish_weld_record;

/* Sorts in place, O(n log n) in the worst case, O(n) when the records are sorted already. */
void burnish_weld_sort(burnish_weld_record *records, size_t count);

/* ---- creases.c: which edges are smooth where no crease angle is given ---- */

/* 20 degrees: smooth below, whatever is around. */
#define BURNISH_SMOOTH_COSINE 0.93969262078590838
/* 60: never smooth from there on. */
#define BURNISH_SHARP_COSINE 0.5
/* 1: parts of one flat face. */
#define BURNISH_COPLANAR_COSINE 0.99984769515639124

/* Whether an edge between 20 and 60 degrees is smooth.
 *
 * It is where both faces bend at all their edges and none is sharp: scans, spheres, decimated
 * shapes. Where one of them belongs to a larger flat face, or has a sharp edge or none beyond it,
 * only up to 40 degrees and only as a step of a curve: the flat faces on both sides are about as
 * wide, and beyond them the surface goes on bending in the same sense. So a cylinder of 12 sides is
 * round, and a chamfer or a pocket of flat facets keeps its edges.
 *
 * triangles: the two at the edge; their order does not matter
 * edge:      numbers of its positions, in any order */
int burnish_surface_is_smooth(const burnish_surface *surface, const uint32_t triangles[2],
                              const uint32_t edge[2]);

/* ---- normals.c: the average of the faces around a vertex, weighted by their angles there ---- */

/* Faces of a vertex that share a normal. */
typedef struct burnish_face_set {
    burnish_vec3 sum;       /* of unit normals times angles */
    double area, flat_area; /* twice the areas: of all; of the largest and those coplanar with it */
    size_t largest;
    int dominated; /* the flat ones give the normal */
} burnish_face_set;

/* The one-rings of some vertices: what is known of the faces at their corners, in arrays of
 * `capacity`. */
typedef struct burnish_rings {
    double sharp_cosine;  /* an edge is smooth above it, ... */
    double smooth_cosine; /* ... and above this one whatever is around */
    const burnish_surface *surface;
    int asks;                /* 1: edges in between ask the surface; 0: there are none */
    const uint32_t *corners; /* those measured */
    int flat;                /* crease angle 0: no edge is smooth */
    int wide;                /* eight faces are compared at once: as burnish_atan2_array has it */
    size_t capacity;
    /* arrays of `capacity` and eight more, so that eight can be read from anywhere */
    double *x, *y, *z;         /* unit normals of the corners' faces */
    double *lengths, *dots;    /* |a x b| and a . b of the edges at the corner */
    double *angles;            /* between them */
    uint32_t *next, *previous; /* the edges' other ends */
    uint32_t *parents;         /* sets of joined faces of the vertex at hand, and ... */
    burnish_face_set *sets;    /* ... what is known of them */
    uint64_t *edges;           /* 2 per corner: other end and face */
    struct burnish_answer
        *answers; /* what the surface said last: an edge is asked from both ends */
} burnish_rings;

/* Scratch for one thread and `capacity` corners at a time. crease_angle is in degrees, [0, 180], or
 * BURNISH_CREASE_AUTO: then the measured surface, which stays until the rings go, decides. `wide`
 * is as burnish_atan2_array has it; the results have the same bits. Errors: memory->status; the
 * arrays are then incomplete. */
void burnish_rings_create(burnish_rings *rings, size_t capacity, double crease_angle,
                          const burnish_surface *surface, int wide, burnish_memory *memory);

/* Releases the scratch; rings of zero bytes are allowed. */
void burnish_rings_destroy(burnish_rings *rings, const burnish_context *context);

/* Measures the faces at corners of any number of vertices.
 *
 * corners: count corners (3 * triangle + 0..2), those of a vertex together; stay until the next
 * call count:   at most the rings' capacity */
void burnish_rings_measure(burnish_rings *rings, const uint32_t *corners, size_t count);

/* The faces [first, end) of a surface, for its array. */
void burnish_measure_faces(const burnish_surface *surface, size_t first, size_t end,
                           burnish_face *faces);

/* Unit normals of the corners that meet in one vertex, O(count log count).
 *
 * Two faces are joined when they share an edge at this vertex and their normals differ by less than
 * the crease angle, or as burnish_surface_is_smooth says; each set of joined faces has one normal,
 * the sum of its unit face normals times their angles at the vertex (Thuermer and Wuethrich 1998),
 * which does not depend on how a flat face is cut into triangles. With BURNISH_CREASE_AUTO a flat
 * face with four times the area of the rest of its set gives its normal to the set, so that the
 * slivers of a fillet do not bend it. Where the sum cancels to nothing, each face keeps its own.
 *
 * first, count: where the vertex's corners stand among those measured
 * normals:      3 per corner, in their order, written
 * Returns 1 when all of them are the same, bit for bit; then only the first one is written. */
int burnish_rings_normals(burnish_rings *rings, size_t first, size_t count, float *normals);

/* The cross product of two edges: twice the area long, along the normal by winding. */
static inline burnish_vec3 burnish_face_cross(const float *positions, const uint32_t vertices[3]) {
    burnish_vec3 a = burnish_vec3_loadf(positions + 3 * (size_t)vertices[0]);
    burnish_vec3 b = burnish_vec3_loadf(positions + 3 * (size_t)vertices[1]);
    burnish_vec3 c = burnish_vec3_loadf(positions + 3 * (size_t)vertices[2]);
    return burnish_vec3_cross(burnish_vec3_sub(b, a), burnish_vec3_sub(c, a));
}

/* A repeated position makes an edge, and so the product, exactly 0. */
static inline int burnish_has_area(burnish_vec3 cross) {
    return cross.x != 0 || cross.y != 0 || cross.z != 0;
}

/* Writes v / |v| in float with no negative zeros; 0 when v has no direction or is not finite. */
void burnish_store_unit(burnish_vec3 v, float unit[3]);

#endif
