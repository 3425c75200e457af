/* PLY: rows of one size, vertices column by column, triangles at once. */
#include "mesh/read/ply/ply_binary.h"
#include "mesh/read/common/splats.h"

#include "base/numbers.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/ply/ply_header.h"

static inline uint32_t load_u32(const uint8_t *from, int big_endian) {
    uint32_t bits;
    memcpy(&bits, from, sizeof bits);
    return big_endian == (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) ? bits : __builtin_bswap32(bits);
}

/* A value of a coordinate's column. */
static double load_coordinate(const burnish_ply_rows *rows, const uint8_t *from, size_t axis) {
    const double value =
        burnish_ply_load(from, rows->columns[BURNISH_PLY_X + axis].type, rows->big_endian);
    return rows->scale[axis] != 0 ? value * rows->scale[axis] + rows->offset[axis] : value;
}

/* Values of one column of `count` rows, less an origin, as floats; returns the first row whose
 * value is not finite, `count` for none. What is not finite becomes 0. */
static size_t convert_floats(const burnish_ply_rows *rows, const uint8_t *bytes, size_t count,
                             const burnish_ply_column *column, double origin, float *to,
                             size_t stride) {
    size_t odd = count;
    bytes += column->offset;
    for (size_t row = 0; row < count; ++row, bytes += rows->row_size, to += stride) {
        int finite;
        if (column->type == BURNISH_PLY_FLOAT32 && origin == 0) {
            uint32_t bits = load_u32(bytes, rows->big_endian);
            finite = burnish_is_finite_bits(bits);
            bits = finite ? bits : 0;
            memcpy(to, &bits, sizeof bits);
        } else {
            const size_t axis = (size_t)(column - rows->columns);
            *to = 0;
            finite = burnish_place(axis <= BURNISH_PLY_Z
                                       ? load_coordinate(rows, bytes, axis)
                                       : burnish_ply_load(bytes, column->type, rows->big_endian),
                                   origin, to);
        }
        odd = !finite && row < odd ? row : odd;
    }
    return odd;
}

/* Coordinates that are not finite become NaN. */
static void mark_odd(const burnish_ply_rows *rows, const uint8_t *bytes, size_t count, size_t axis,
                     float *to) {
    const size_t offset = rows->columns[BURNISH_PLY_X + axis].offset;
    for (size_t row = 0; row < count; ++row, bytes += rows->row_size, to += 3) {
        float unused;
        if (!burnish_place(load_coordinate(rows, bytes + offset, axis), rows->mesh->origin[axis],
                           &unused)) {
            *to = __builtin_nanf("");
        }
    }
}

static void convert_colors(const burnish_ply_rows *rows, const uint8_t *bytes, size_t count,
                           uint8_t *rgba) {
    for (int i = 0; i < 4; ++i) {
        const burnish_ply_column from = rows->columns[BURNISH_PLY_RED + i];
        const uint8_t *at = bytes + from.offset;
        for (size_t k = 0; k < count; ++k, at += rows->row_size) {
            rgba[4 * k + (size_t)i] =
                from.type == BURNISH_PLY_NONE ? 255
                : from.type == BURNISH_PLY_UINT8
                    ? *at
                    : burnish_ply_to_color(burnish_ply_load(at, from.type, rows->big_endian),
                                           from.type);
        }
    }
}

void burnish_ply_convert_face_colors(void *user_data, const uint8_t *bytes, size_t first,
                                     size_t end) {
    const burnish_ply_rows *rows = user_data;
    convert_colors(rows, bytes, end - first,
                   burnish_colors(rows->mesh) + 4 * (rows->first_triangle + first));
}

/* Rows [first, end) of vertices, in groups that fit into the first-level cache. */
void burnish_ply_convert_vertices(void *user_data, const uint8_t *bytes, size_t first, size_t end) {
    enum { ROWS = 512, SPLAT_FLOATS = sizeof(burnish_splat) / sizeof(float) };
    burnish_ply_rows *rows = user_data;
    const burnish_mesh_data *mesh = rows->mesh;
    for (; first < end; first += ROWS, bytes += ROWS * rows->row_size) {
        const size_t count = end - first < ROWS ? end - first : ROWS;
        for (size_t i = 0; i < 3; ++i) {
            const size_t odd =
                convert_floats(rows, bytes, count, &rows->columns[BURNISH_PLY_X + i],
                               mesh->origin[i], burnish_positions(mesh) + 3 * first + i, 3);
            if (odd < count) {
                mark_odd(rows, bytes, count, i, burnish_positions(mesh) + 3 * first + i);
                burnish_lower_to(&rows->odd, first + odd);
            }
            if (mesh->streams[BURNISH_NORMAL].count > 0) {
                convert_floats(rows, bytes, count, &rows->columns[BURNISH_PLY_NX + i], 0,
                               burnish_normals(mesh) + 3 * first + i, 3);
            }
            if (mesh->streams[BURNISH_TEXCOORD].count > 0 && i < 2) {
                convert_floats(rows, bytes, count, &rows->columns[BURNISH_PLY_S + i], 0,
                               (float *)mesh->streams[BURNISH_TEXCOORD].items + 2 * first + i, 2);
            }
        }
        for (int i = BURNISH_PLY_SCALE;
             i <= BURNISH_PLY_OPACITY && mesh->streams[BURNISH_SPLAT].count > 0; ++i) {
            const burnish_ply_column *column = &rows->columns[i];
            float *to = (float *)mesh->streams[BURNISH_SPLAT].items + SPLAT_FLOATS * first +
                        (i - BURNISH_PLY_SCALE);
            for (size_t row = 0; row < count; ++row, to += SPLAT_FLOATS) {
                const double value = burnish_ply_load(bytes + row * rows->row_size + column->offset,
                                                      column->type, rows->big_endian);
                if (!burnish_double_to_float(value, to)) {
                    *to = burnish_splat_odd(value, i == BURNISH_PLY_OPACITY);
                }
            }
        }
        if (mesh->streams[BURNISH_COLOR].count > 0) {
            convert_colors(rows, bytes, count, burnish_colors(mesh) + 4 * first);
        }
    }
}

/* Triangles in the most common layout: a byte and three words in the byte order of this machine.
 * Negative corners read as too large. Returns the first odd row. */
static size_t convert_common(const burnish_ply_rows *rows, const uint8_t *bytes, size_t count,
                             uint32_t *to) {
    const size_t row_size = rows->row_size;
    const uint32_t vertex_count = (uint32_t)rows->vertex_count;
    size_t row = 0;
    for (; row < count; ++row, bytes += row_size, to += 3) {
        memcpy(to, bytes + rows->corners.offset, 3 * sizeof *to);
        if ((bytes[rows->length.offset] != 3) | (to[0] >= vertex_count) | (to[1] >= vertex_count) |
            (to[2] >= vertex_count)) {
            break;
        }
    }
    return row;
}

static size_t convert_any(const burnish_ply_rows *rows, const uint8_t *bytes, size_t count,
                          uint32_t *to) {
    const size_t size = burnish_ply_type_size(rows->corners.type);
    size_t row = 0;
    for (; row < count; ++row, bytes += rows->row_size, to += 3) {
        int good = burnish_ply_load_count(bytes + rows->length.offset, rows->length.type,
                                          rows->big_endian) == 3;
        for (size_t i = 0; i < 3; ++i) {
            to[i] = burnish_ply_load_count(bytes + rows->corners.offset + size * i,
                                           rows->corners.type, rows->big_endian);
            good &= to[i] < rows->vertex_count;
        }
        if (!good) {
            break;
        }
    }
    return row;
}

void burnish_ply_convert_triangles(void *user_data, const uint8_t *bytes, size_t first,
                                   size_t end) {
    burnish_ply_rows *rows = user_data;
    const size_t count = end - first;
    uint32_t *to =
        rows->mesh->streams[BURNISH_POSITION].corners + 3 * (rows->first_triangle + first);
    const int is_little = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    const int is_common =
        rows->length.type == BURNISH_PLY_UINT8 && rows->big_endian != is_little &&
        (rows->corners.type == BURNISH_PLY_INT32 || rows->corners.type == BURNISH_PLY_UINT32) &&
        rows->vertex_count <= INT32_MAX;
    if (first > atomic_load_explicit(&rows->odd, memory_order_relaxed)) {
        return;
    }
    const size_t odd =
        is_common ? convert_common(rows, bytes, count, to) : convert_any(rows, bytes, count, to);
    if (odd < count) {
        burnish_lower_to(&rows->odd, first + odd);
    }
}
