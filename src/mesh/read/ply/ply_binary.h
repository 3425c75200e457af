/* Binary values of PLY, and rows that all have one size. */
#ifndef BURNISH_MESH_READ_PLY_PLY_BINARY_H
#define BURNISH_MESH_READ_PLY_PLY_BINARY_H

#include "mesh/read/ply/ply_header.h"
#include <stdatomic.h>
#include <string.h>

/* The position of a value in a row. */
typedef struct burnish_ply_column {
    size_t offset;
    burnish_ply_type type; /* NONE: absent */
} burnish_ply_column;

typedef struct burnish_ply_rows {
    size_t row_size;
    int big_endian;
    burnish_ply_column columns[BURNISH_PLY_ROLE_COUNT];
    burnish_ply_column length, corners; /* of the one list, which has 3 items */
    size_t first_triangle, vertex_count;
    const double *scale, *offset; /* of coordinates, as in burnish_ply_header */
    const burnish_mesh_data *mesh;
    atomic_size_t odd; /* the first row that is not as expected */
} burnish_ply_rows;

/* Rows [first, end) of vertices or triangles, the first at `bytes`, into the streams, which have
 * room for them: as burnish_rows_task. The first row that is not as expected goes to rows->odd.
 * user_data: the burnish_ply_rows. */
void burnish_ply_convert_vertices(void *user_data, const uint8_t *bytes, size_t first, size_t end);
void burnish_ply_convert_triangles(void *user_data, const uint8_t *bytes, size_t first, size_t end);

/* The colours of triangles that have been converted, one each. */
void burnish_ply_convert_face_colors(void *user_data, const uint8_t *bytes, size_t first,
                                     size_t end);

static inline uint64_t load_bits(const uint8_t *p, size_t size, int big_endian) {
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i) {
        bits = bits << 8 | p[big_endian ? i : size - 1 - i];
    }
    return bits;
}

static inline double burnish_ply_load(const uint8_t *p, burnish_ply_type type, int big_endian) {
    const uint64_t bits = load_bits(p, burnish_ply_type_size(type), big_endian);
    const uint32_t low = (uint32_t)bits;
    float single;
    double wide;
    switch (type) {
    case BURNISH_PLY_INT8:
        return (double)low - (low & 0x80u ? 256.0 : 0.0);
    case BURNISH_PLY_INT16:
        return (double)low - (low & 0x8000u ? 65536.0 : 0.0);
    case BURNISH_PLY_INT32:
        return (double)low - (low & 0x80000000u ? 4294967296.0 : 0.0);
    case BURNISH_PLY_INT64:
        return (double)(int64_t)bits;
    case BURNISH_PLY_UINT64:
        return (double)bits;
    case BURNISH_PLY_FLOAT32:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case BURNISH_PLY_FLOAT64:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default:
        return (double)low;
    }
}

/* floats count from 0 to 1, 16 bits to 65535, anything else to 255 */
static inline uint8_t burnish_ply_to_color(double value, burnish_ply_type type) {
    if (type == BURNISH_PLY_FLOAT32 || type == BURNISH_PLY_FLOAT64) {
        value *= 255;
    } else if (type == BURNISH_PLY_UINT16) {
        value /= 257;
    }
    return (uint8_t)(value > 0 ? (value < 255 ? value + 0.5 : 255) : 0);
}

/* A value that is not negative; UINT32_MAX for one that is, or that is larger. */
static inline uint32_t burnish_ply_load_count(const uint8_t *from, burnish_ply_type type,
                                              int big_endian) {
    const double value = burnish_ply_load(from, type, big_endian);
    return value >= 0 && value < UINT32_MAX ? (uint32_t)value : UINT32_MAX;
}

#endif
