/* Which edges are smooth if no crease angle is given. */
#ifndef BURNISH_MESH_BUILD_NORMALS_CREASES_H
#define BURNISH_MESH_BUILD_NORMALS_CREASES_H

#include "mesh/build/normals/welded.h"

/* 20 degrees: smooth below, whatever is around. */
#define BURNISH_SMOOTH_COSINE 0.93969262078590838
/* 60: never smooth from there on. */
#define BURNISH_SHARP_COSINE 0.5
/* 1: parts of one flat face. */
#define BURNISH_COPLANAR_COSINE 0.99984769515639124

/* 160: in an organic surface, never smooth from there on. */
#define BURNISH_ORGANIC_COSINE (-0.93969262078590838)

/* What was computed of triangles and positions, by their numbers: neighbours are asked for again and
 * again. */
enum { BURNISH_KNOWN = 1024 };

typedef struct burnish_known_face {
    uint32_t after; /* the number of the triangle, + 1; 0: none */
    burnish_vec3 normal;
} burnish_known_face;

/* The edges at a position between faces of the same winding, by their angles. */
typedef struct burnish_edge_counts {
    int all, plane, flat, gentle, sharp; /* flat: up to 1 degree, with the plane ones */
} burnish_edge_counts;

typedef struct burnish_known_edges {
    uint32_t after; /* the number of the position, + 1 */
    burnish_edge_counts counts;
} burnish_known_edges;

typedef struct burnish_known {
    burnish_known_face faces[BURNISH_KNOWN];
    burnish_known_edges edges[BURNISH_KNOWN];
} burnish_known;

/* Whether a surface is organic, as scans and sculptures are: hardly any two neighbours are in one
 * plane. Half of the edges of most machined parts are diagonals of flat faces. Measured at up to
 * 1,024 vertices, which do not depend on the threads. */
int burnish_surface_is_organic(const burnish_surface *surface, size_t position_count,
                               burnish_tasks *tasks);

/* Whether an edge between 20 and 60 degrees is smooth; in an organic surface, between 20 and 160.
 *
 * An edge of an organic surface is noise, and smooth, if an eighth of the edges at its ends bend by
 * 3 to 20 degrees and at most a quarter of them are plane. A base that was cut flat and facets
 * without smooth edges keep theirs, and so do chains: an edge of 60 degrees or more stays sharp if
 * another one continues it at both ends within 60 degrees, as at the rim of a decimated cylinder. For
 * other edges, up to 60 degrees:
 *
 * It is smooth if both faces bend at all their edges and no edge is sharp, as in scans, spheres and
 * decimated shapes. If a face belongs to a larger flat face, or has an edge that is sharp or open,
 * the edge is smooth only up to 40 degrees and only as a step of a curve: the flat faces on both
 * sides are about equally wide, and beyond them the surface keeps bending in the same direction. A
 * cylinder of 12 sides is therefore round, while a chamfer or a pocket of flat facets keeps its
 * edges.
 *
 * triangles: the two at the edge; their order does not matter
 * edge:      numbers of its positions, in any order */
int burnish_surface_is_smooth(const burnish_surface *surface, const uint32_t triangles[2],
                              const uint32_t edge[2]);

#endif
