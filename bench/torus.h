/* A torus of 2 grid^2 triangles in every format, for timing readers. */
#ifndef BURNISH_BENCH_TORUS_H
#define BURNISH_BENCH_TORUS_H

#include <stddef.h>

/* A file in memory; data is malloc's. */
typedef struct bytes {
    char *data;
    size_t size, capacity;
} bytes;

typedef struct torus {
    size_t grid;
    double *positions, *normals; /* 3 per vertex, grid * grid vertices */
} torus;

torus make_torus(size_t grid);
void torus_destroy(torus *t);

/* digits: decimals of positions; normals, coordinates: 1 to write them. */
bytes write_obj(const torus *t, int digits, int normals, int coordinates);
bytes write_ply(const torus *t, int ascii, int normals);
bytes write_stl(const torus *t, int ascii);
bytes write_glb(const torus *t); /* little-endian machines only */

#endif
