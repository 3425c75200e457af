/* What a reader hands over: triangles as the file states them, before welding and normals.
 *
 * Data flow: bytes -> reader (obj.c, ply_body.c, stl.c, builtin.c) -> oracle_source -> build.c ->
 * oracle_mesh. */
#ifndef ORACLE_MESH_READ_SOURCE_H
#define ORACLE_MESH_READ_SOURCE_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/mesh.h"
#include "core/memory.h"
#include "core/tasks.h"
#include "oracle/legacy.h"

/* A corner or face without a value of its own. */
#define ORACLE_SOURCE_NONE UINT32_MAX

/* Growing arrays, all owned (malloc family). Readers guarantee: finite positions, corner indices in
 * range, counts below 2^32 - 1. Zero-area and repeated-index triangles may be present: build drops
 * them. */
typedef struct oracle_source {
    float *positions; /* 3 a position */
    size_t position_count, position_capacity;

    uint8_t *colors; /* 4 a position (sRGB, alpha), or NULL: none */
    size_t color_capacity;

    float *normals; /* 3 a normal, as in the file: any length, may be 0 or not finite */
    size_t normal_count, normal_capacity;

    uint32_t *corner_positions; /* 3 a triangle, index into positions */
    size_t triangle_count, corner_capacity;

    uint32_t
        *corner_normals; /* 3 a triangle, index into normals or ORACLE_SOURCE_NONE; NULL: none */
    size_t corner_normal_capacity;

    uint16_t *triangle_materials; /* 1 a triangle; NULL: all material 0 */
    size_t triangle_material_capacity;

    burnish_material *materials; /* empty: build adds burnish_material_default() */
    size_t material_count, material_capacity;

    char **warnings;
    size_t warning_count, warning_capacity;

    burnish_tasks *pool; /* the loader's threads, not owned; NULL: the caller alone */
} oracle_source;

void oracle_source_destroy(oracle_source *source);

/* Appends a line; after 16 lines further ones are dropped, failing silently when memory is out. */
__attribute__((format(printf, 2, 3))) void oracle_source_warn(oracle_source *source,
                                                              const char *format, ...);

#endif
