/* The unit normals, areas and angles of the faces at some corners. */
#ifndef BURNISH_MESH_BUILD_NORMALS_FACES_H
#define BURNISH_MESH_BUILD_NORMALS_FACES_H

#include "mesh/build/normals/welded.h"

enum {
    BURNISH_FACE_LANES = 8, /* results are written up to a multiple of so many */
    BURNISH_FACE_BLOCK = 64 /* corners that are measured at once */
};

/* Where results go: one per corner. */
typedef struct burnish_measured_faces {
    double *x, *y, *z;         /* unit normals */
    double *lengths;           /* twice the areas */
    double *angles;            /* between the edges at the corner */
    uint32_t *next, *previous; /* the other ends of these edges */
} burnish_measured_faces;

/* Measures the faces at `count` corners (3 * triangle + 0..2), which have area.
 *
 * wide: 1 if the processor has AVX2, 2 for AVX-512; does not affect the bits of the results */
void burnish_measure_faces(const burnish_surface *surface, const uint32_t *corners, size_t count,
                           int wide, const burnish_measured_faces *to);

/* Measures the faces of `count` vertices, at most BURNISH_FACE_BLOCK, with `faces` each: those of
 * their i-th corners to to[i].
 *
 * starts: of each vertex's corners in the surface's list */
void burnish_measure_fans(const burnish_surface *surface, const uint32_t *starts, size_t count,
                          size_t faces, int wide, const burnish_measured_faces *to);

/* Whether each of `count` triangles has area, 1 or 0. */
void burnish_find_areas(const float *positions, const uint32_t *corners, size_t count, int wide,
                        uint8_t *has_area);

/* 2 if the instruction set that kernels would take has AVX-512, 1 for AVX2, else 0. */
int burnish_face_width(void);

#endif
