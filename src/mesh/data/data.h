/* Mesh data: triangles as a file states them, before welding and normals.
 *
 * Data flow: bytes -> reader -> burnish_mesh_data -> build -> burnish_mesh. */
#ifndef BURNISH_MESH_DATA_DATA_H
#define BURNISH_MESH_DATA_DATA_H

#include <stddef.h>
#include <stdint.h>

#include "base/clock.h"
#include "base/error.h"
#include "base/memory.h"
#include "burnish/mesh.h"
#include "core/tasks.h"

/* The index of a corner that has no value. */
#define BURNISH_NONE UINT32_MAX

/* Corner indices stop below BURNISH_NONE. */
#define BURNISH_VALUE_LIMIT ((size_t)UINT32_MAX - 1)

/* The attributes of a vertex. */
typedef enum burnish_attribute {
    BURNISH_POSITION,  /* 3 floats, finite */
    BURNISH_NORMAL,    /* 3 floats of any length, possibly 0 or not finite */
    BURNISH_COLOR,     /* 4 bytes: sRGB and alpha */
    BURNISH_TEXCOORD,  /* 2 floats */
    BURNISH_TANGENT,   /* 4 floats: burnish_mesh_view.tangents; dropped if no normal texture is
                         used */
    BURNISH_TEXCOORD2, /* 2 floats; dropped if no texture has coordinates 1 */
    BURNISH_SPLAT,     /* burnish_splat, of a point cloud */
    BURNISH_ATTRIBUTE_COUNT
} burnish_attribute;

/* Bytes of one item. */
static inline size_t burnish_attribute_size(burnish_attribute attribute) {
    static const uint8_t sizes[BURNISH_ATTRIBUTE_COUNT] = {
        12, 12, 4, 8, 16, 8, sizeof(burnish_splat)};
    return sizes[attribute];
}

/* The values of one attribute, and the value that each corner uses. */
typedef struct burnish_stream {
    void *items; /* `count` of them; 0: absent from the file */
    size_t count, capacity;
    uint32_t *corners; /* 3 per triangle, BURNISH_NONE: no value; NULL: as positions are numbered */
    size_t corner_capacity; /* triangles */
} burnish_stream;

/* Start from burnish_mesh_data_begin(). Readers guarantee: finite positions, corners of positions,
 * indices in range (as many items as positions if corners is NULL), counts below 2^32 - 1.
 * Triangles without area or with repeated indices are permitted: build drops them. */
typedef struct burnish_mesh_data {
    burnish_stream streams[BURNISH_ATTRIBUTE_COUNT];
    size_t triangle_count;
    size_t point_count; /* > 0: a point cloud, without triangles; a normal per position */
    float point_radius;
    float inner_min[3], inner_max[3];   /* of a point cloud: what is framed (read/common/cloud.h) */
    size_t line_count;                  /* drawn as triangles */
    size_t layer_count;                 /* burnish_mesh_info.layer_count */
    size_t beside_count;                /* of the last triangles: lines and points beside faces */
    float points_min[3], points_max[3]; /* bounds of the lines' ends, and of faces beside them */
    float up_axis[3];                   /* unit length; all 0: the format's */
    const char *unit;                   /* burnish_mesh_info.unit */
    int is_thumbnail;                   /* burnish_mesh_info.is_thumbnail */
    int is_one_sided;                   /* burnish_mesh_info.is_one_sided */
    double animation_seconds;           /* burnish_mesh_info.animation_seconds */
    char imported[12];                  /* burnish_mesh_info.imported */

    uint16_t *triangle_materials; /* 1 per triangle, in range; NULL: all have material 0 */
    size_t triangle_material_capacity;

    uint16_t *triangle_parts; /* the same for parts */
    size_t triangle_part_capacity;
    struct burnish_mesh_data *negatives; /* volumes to be subtracted: triangles with their parts */
    struct burnish_mesh_data *splats;    /* next to triangles: a point cloud */
    burnish_part *parts;                 /* burnish_contents, with room for more */
    size_t part_count, part_capacity;
    burnish_plate *plates;
    size_t plate_count, plate_capacity;
    burnish_filament *filaments;
    size_t filament_count, filament_capacity;

    burnish_material *materials; /* empty: build adds burnish_material_default() */
    size_t material_count, material_capacity;

    int has_average_normals;   /* the format's normals may be averaged across edges */
    int has_normal_textures;   /* a material names one, which need not be loaded */
    burnish_texture *textures; /* with their names and pixels, which are owned */
    size_t texture_count, texture_capacity;

    burnish_named_camera *cameras; /* with their names, which are owned */
    size_t camera_count, camera_capacity;

    burnish_light *lights;
    size_t light_count, light_capacity;

    char **variants; /* names */
    size_t variant_count, variant_capacity;

    char **warnings;
    size_t warning_count, warning_capacity;
    int is_silent; /* 1: an earlier reading has already reported the warnings */

    uint64_t crowded_max; /* corners at vertices of more than 64 triangles; 0: any number */
    double origin[3]; /* of the positions, in the file's coordinates: burnish_mesh_view.origin */

    burnish_memory memory; /* allocates all arrays and receives errors */
    burnish_tasks *tasks;  /* of the load call, not owned; NULL: the caller alone */
    double start;          /* when reading began, burnish_seconds_now() */
} burnish_mesh_data;

static inline burnish_mesh_data burnish_mesh_data_begin(const burnish_context *context,
                                                        burnish_tasks *tasks,
                                                        burnish_error *error) {
    return (burnish_mesh_data){.memory = burnish_memory_of(context, error),
                               .tasks = tasks,
                               .start = burnish_seconds_now()};
}

void burnish_mesh_data_destroy(burnish_mesh_data *mesh);

/* Gives the mesh empty data for splats in its coordinates; NULL if memory is out. */
burnish_mesh_data *burnish_mesh_data_add_splats(burnish_mesh_data *mesh);

/* Releases the values and corners of one attribute. */
void burnish_mesh_data_drop(burnish_mesh_data *mesh, burnish_attribute attribute);

/* Appends a warning to the list alone, however long it is. */
void burnish_mesh_data_list_warning(burnish_mesh_data *mesh, const char *line);

/* Appends a warning and sends it to the context's log. At most 16 warnings are kept. */
__attribute__((format(printf, 2, 3))) void burnish_mesh_data_warn(burnish_mesh_data *mesh,
                                                                  const char *format, ...);

/* Makes room for `count` items of an attribute, or for the corners of `triangles` triangles.
 * Discards the present contents. Returns the status of mesh->memory. */
burnish_status burnish_mesh_data_reserve(burnish_mesh_data *mesh, burnish_attribute attribute,
                                         size_t count);
burnish_status burnish_mesh_data_reserve_corners(burnish_mesh_data *mesh,
                                                 burnish_attribute attribute, size_t triangles);

/* Typed views; NULL if the mesh lacks the attribute. */
static inline float *burnish_positions(const burnish_mesh_data *mesh) {
    return mesh->streams[BURNISH_POSITION].items;
}
static inline float *burnish_normals(const burnish_mesh_data *mesh) {
    return mesh->streams[BURNISH_NORMAL].items;
}
static inline uint8_t *burnish_colors(const burnish_mesh_data *mesh) {
    return mesh->streams[BURNISH_COLOR].items;
}

/* The corners of an attribute, as the stream has them or as positions are numbered. */
static inline const uint32_t *burnish_stream_corners(const burnish_mesh_data *mesh,
                                                     burnish_attribute attribute) {
    const uint32_t *own = mesh->streams[attribute].corners;
    return own ? own : mesh->streams[BURNISH_POSITION].corners;
}

void burnish_texts_release(const burnish_context *context, char **texts, size_t count);

/* Releases cameras with their names. */
void burnish_cameras_release(const burnish_context *context, burnish_named_camera *cameras,
                             size_t count);

#endif
