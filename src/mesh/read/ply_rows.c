/* Rows of a binary PLY body that all have one size: converted by threads.
 *
 * Nothing is reported from here: where a row is not as expected, the caller reads the element again
 * value by value, and that finds the error and its place. */
#include "mesh/read/ply_rows.h"

#include <stdatomic.h>
#include <string.h>

#include "core/tasks.h"
#include "mesh/mesh.h"
#include "mesh/read/append.h"

enum { SHARE = 1 << 15 /* rows that a thread takes at once */ };

/* Where a value stands in a row. */
typedef struct column {
    size_t offset;
    burnish_ply_type type; /* NONE: absent */
} column;

static uint32_t load32(const uint8_t *from, int big_endian) {
    uint32_t bits;
    memcpy(&bits, from, sizeof bits);
    return big_endian == (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) ? bits : __builtin_bswap32(bits);
}

/* A finite float at `from`; returns 0 for any other. */
static int load_float(const uint8_t *from, int big_endian, float *value) {
    uint32_t bits = load32(from, big_endian);
    memcpy(value, &bits, sizeof bits);
    return (bits & 0x7F800000u) != 0x7F800000u;
}

/* ---- vertices ---- */

typedef struct vertex_layout {
    size_t row_size;
    column columns[BURNISH_PLY_ROLE_COUNT];
    int has_normals, has_colors;
} vertex_layout;

static int all_have_type(const column *columns, int first, int last, burnish_ply_type type) {
    for (int role = first; role <= last; ++role) {
        if (columns[role].type != type) {
            return 0;
        }
    }
    return 1;
}

static int none_present(const column *columns, int first, int last) {
    return all_have_type(columns, first, last, BURNISH_PLY_NONE);
}

/* Returns 0 for rows with lists, coordinates that are no floats, or colours that are no bytes. */
static int lay_out_vertices(const burnish_ply_rows *rows, vertex_layout *layout) {
    *layout = (vertex_layout){0};
    for (size_t i = 0; i < rows->property_count; ++i) {
        const burnish_ply_property *property = &rows->properties[i];
        if (property->count_type != BURNISH_PLY_NONE) {
            return 0;
        }
        if (property->role < BURNISH_PLY_ROLE_COUNT) {
            layout->columns[property->role] = (column){layout->row_size, property->type};
        }
        layout->row_size += burnish_ply_type_size(property->type);
    }
    const column *columns = layout->columns;
    layout->has_normals =
        all_have_type(columns, BURNISH_PLY_NX, BURNISH_PLY_NZ, BURNISH_PLY_FLOAT32);
    layout->has_colors =
        all_have_type(columns, BURNISH_PLY_RED, BURNISH_PLY_BLUE, BURNISH_PLY_UINT8) &&
        (columns[BURNISH_PLY_ALPHA].type == BURNISH_PLY_NONE ||
         columns[BURNISH_PLY_ALPHA].type == BURNISH_PLY_UINT8);
    return all_have_type(columns, BURNISH_PLY_X, BURNISH_PLY_Z, BURNISH_PLY_FLOAT32) &&
           (layout->has_normals || none_present(columns, BURNISH_PLY_NX, BURNISH_PLY_NZ)) &&
           (layout->has_colors || none_present(columns, BURNISH_PLY_RED, BURNISH_PLY_ALPHA));
}

/* Returns 0 when a coordinate is not finite. */
static int convert_vertex(const burnish_ply_rows *rows, const vertex_layout *layout, size_t row,
                          burnish_source *source) {
    const uint8_t *bytes = rows->bytes + row * layout->row_size;
    const column *columns = layout->columns;
    int good = 1;
    for (int i = 0; i < 3; ++i) {
        good &= load_float(bytes + columns[BURNISH_PLY_X + i].offset, rows->big_endian,
                           &source->positions[3 * row + i]);
    }
    for (int i = 0; i < 3 && layout->has_normals; ++i) {
        float *value = &source->normals[3 * row + i];
        if (!load_float(bytes + columns[BURNISH_PLY_NX + i].offset, rows->big_endian, value)) {
            *value = 0; /* build makes one */
        }
    }
    if (layout->has_colors) {
        uint8_t *rgba = source->colors + 4 * row;
        for (int i = 0; i < 3; ++i) {
            rgba[i] = bytes[columns[BURNISH_PLY_RED + i].offset];
        }
        const column *alpha = &columns[BURNISH_PLY_ALPHA];
        rgba[3] = alpha->type == BURNISH_PLY_NONE ? 255 : bytes[alpha->offset];
    }
    return good;
}

static burnish_status reserve_vertices(const vertex_layout *layout, size_t count,
                                       burnish_source *source, burnish_error *error) {
    burnish_status status =
        burnish_legacy_reserve((void **)&source->positions, &source->position_capacity, count,
                               3 * sizeof(float), "positions", error);
    if (status == BURNISH_STATUS_OK && layout->has_normals) {
        status = burnish_legacy_reserve((void **)&source->normals, &source->normal_capacity, count,
                                        3 * sizeof(float), "normals", error);
    }
    if (status == BURNISH_STATUS_OK && layout->has_colors) {
        status = burnish_legacy_reserve((void **)&source->colors, &source->color_capacity, count, 4,
                                        "colours", error);
    }
    return status;
}

typedef struct vertex_context {
    const burnish_ply_rows *rows;
    const vertex_layout *layout;
    burnish_source *source;
    atomic_int bad; /* 1: a row is not as expected */
} vertex_context;

static void convert_vertices(void *of, size_t first, size_t end) {
    vertex_context *context = of;
    size_t bad = 0;
    for (size_t row = first; row < end; ++row) {
        bad += !convert_vertex(context->rows, context->layout, row, context->source);
    }
    if (bad) {
        atomic_store(&context->bad, 1);
    }
}

burnish_status burnish_ply_vertex_rows(const burnish_ply_rows *rows, burnish_source *source,
                                       size_t *used, burnish_error *error) {
    vertex_layout layout;
    *used = 0;
    if (!lay_out_vertices(rows, &layout) || rows->size / layout.row_size < rows->count ||
        source->position_count > 0 || source->normal_count > 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = reserve_vertices(&layout, rows->count, source, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    vertex_context context = {.rows = rows, .layout = &layout, .source = source};
    burnish_tasks_ranges(source->pool, rows->count, SHARE, convert_vertices, &context);
    if (atomic_load(&context.bad)) {
        free(source->colors); /* a colour array says that there are colours */
        source->colors = NULL;
        source->color_capacity = 0;
        return BURNISH_STATUS_OK;
    }
    source->position_count = rows->count;
    source->normal_count = layout.has_normals ? rows->count : 0;
    *used = rows->count * layout.row_size;
    return BURNISH_STATUS_OK;
}

/* ---- triangles ---- */

typedef struct triangle_layout {
    size_t row_size;
    column length;  /* of the list of corners */
    column corners; /* the first one */
    int is_common;  /* a byte and three words, as they are in memory */
} triangle_layout;

/* The layout of a row with three corners; 0 when there are other lists or corners are no integers.
 */
static int lay_out_triangles(const burnish_ply_rows *rows, triangle_layout *layout) {
    int lists = 0;
    *layout = (triangle_layout){0};
    for (size_t i = 0; i < rows->property_count; ++i) {
        const burnish_ply_property *property = &rows->properties[i];
        if (property->count_type == BURNISH_PLY_NONE) {
            layout->row_size += burnish_ply_type_size(property->type);
            continue;
        }
        if (property->role != BURNISH_PLY_CORNERS || ++lists > 1) {
            return 0;
        }
        layout->length = (column){layout->row_size, property->count_type};
        layout->row_size += burnish_ply_type_size(property->count_type);
        layout->corners = (column){layout->row_size, property->type};
        layout->row_size += 3 * burnish_ply_type_size(property->type);
    }
    const int is_little = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
    layout->is_common =
        layout->length.type == BURNISH_PLY_UINT8 && rows->big_endian != is_little &&
        (layout->corners.type == BURNISH_PLY_INT32 || layout->corners.type == BURNISH_PLY_UINT32);
    return lists == 1 && layout->length.type < BURNISH_PLY_FLOAT32 &&
           layout->corners.type < BURNISH_PLY_FLOAT32;
}

/* Rows [first, end) of the common layout; returns how many are not as expected. Negative corners
 * are too large as they are. */
static size_t convert_common(const burnish_ply_rows *rows, const triangle_layout *layout,
                             size_t first, size_t end, uint32_t vertex_count, uint32_t *corners) {
    const size_t row_size = layout->row_size, length = layout->length.offset,
                 offset = layout->corners.offset;
    size_t bad = 0;
    for (size_t row = first; row < end; ++row) {
        const uint8_t *bytes = rows->bytes + row * row_size;
        uint32_t *to = corners + 3 * row;
        memcpy(to, bytes + offset, 3 * sizeof *to);
        bad += (bytes[length] != 3) | (to[0] >= vertex_count) | (to[1] >= vertex_count) |
               (to[2] >= vertex_count);
    }
    return bad;
}

/* A value that is not negative; UINT32_MAX for one that is. */
static uint32_t load_count(const uint8_t *from, burnish_ply_type type, int big_endian) {
    uint32_t value;
    switch (type) {
    case BURNISH_PLY_INT8:
    case BURNISH_PLY_UINT8:
        value = from[0];
        return type == BURNISH_PLY_INT8 && value > INT8_MAX ? UINT32_MAX : value;
    case BURNISH_PLY_INT16:
    case BURNISH_PLY_UINT16:
        value = big_endian ? (uint32_t)from[0] << 8 | from[1] : (uint32_t)from[1] << 8 | from[0];
        return type == BURNISH_PLY_INT16 && value > INT16_MAX ? UINT32_MAX : value;
    default:
        value = load32(from, big_endian);
        return type == BURNISH_PLY_INT32 && value > INT32_MAX ? UINT32_MAX : value;
    }
}

/* Returns 0 for a row with other than three corners, or one out of range. */
static int convert_triangle(const burnish_ply_rows *rows, const triangle_layout *layout, size_t row,
                            size_t vertex_count, uint32_t *corners) {
    const uint8_t *bytes = rows->bytes + row * layout->row_size;
    size_t step = burnish_ply_type_size(layout->corners.type);
    int good =
        load_count(bytes + layout->length.offset, layout->length.type, rows->big_endian) == 3;
    for (size_t i = 0; i < 3; ++i) {
        corners[i] = load_count(bytes + layout->corners.offset + step * i, layout->corners.type,
                                rows->big_endian);
        good &= corners[i] < vertex_count;
    }
    return good;
}

typedef struct triangle_context {
    const burnish_ply_rows *rows;
    const triangle_layout *layout;
    size_t vertex_count;
    uint32_t *corners;
    atomic_int bad;
} triangle_context;

static void convert_triangles(void *of, size_t first, size_t end) {
    triangle_context *context = of;
    size_t bad = 0;
    if (context->layout->is_common && context->vertex_count <= INT32_MAX) {
        bad = convert_common(context->rows, context->layout, first, end,
                             (uint32_t)context->vertex_count, context->corners);
    } else {
        for (size_t row = first; row < end; ++row) {
            bad += !convert_triangle(context->rows, context->layout, row, context->vertex_count,
                                     context->corners + 3 * row);
        }
    }
    if (bad) {
        atomic_store(&context->bad, 1);
    }
}

burnish_status burnish_ply_triangle_rows(const burnish_ply_rows *rows, size_t vertex_count,
                                         const burnish_load_options *options,
                                         burnish_source *source, size_t *used,
                                         burnish_error *error) {
    triangle_layout layout;
    uint32_t first[3];
    *used = 0;
    if (!lay_out_triangles(rows, &layout) || rows->size / layout.row_size < rows->count ||
        source->corner_normals || source->triangle_count > BURNISH_TRIANGLES_MAX ||
        rows->count > BURNISH_TRIANGLES_MAX - source->triangle_count ||
        rows->count + source->triangle_count > options->max_triangles ||
        !convert_triangle(rows, &layout, 0, vertex_count, first)) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = burnish_reserve_triangles(
        source, options, burnish_place_file("triangles"), rows->count, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    uint32_t *corners = source->corner_positions + 3 * source->triangle_count;
    triangle_context context = {
        .rows = rows, .layout = &layout, .vertex_count = vertex_count, .corners = corners};
    burnish_tasks_ranges(source->pool, rows->count, SHARE, convert_triangles, &context);
    if (!atomic_load(&context.bad)) {
        source->triangle_count += rows->count;
        *used = rows->count * layout.row_size;
    }
    return BURNISH_STATUS_OK;
}
