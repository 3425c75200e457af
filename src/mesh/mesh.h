/* Meshes inside the library: what a reader hands over, what build makes of it, and the checks that
 * every way to a mesh shares.
 *
 * Data flow: bytes -> reader -> burnish_mesh_data -> build -> burnish_mesh. */
#ifndef BURNISH_MESH_MESH_H
#define BURNISH_MESH_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/mesh.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/tasks.h"

/* ---- Mesh data: triangles as the file states them, before welding and normals ---- */

/* A corner without a value of its own. */
#define BURNISH_NONE UINT32_MAX

/* Corner indices stop below BURNISH_NONE. */
#define BURNISH_VALUE_LIMIT ((size_t)UINT32_MAX - 1)

/* What a vertex has. */
typedef enum burnish_attribute {
    BURNISH_POSITION, /* 3 floats, finite */
    BURNISH_NORMAL,   /* 3 floats of any length, possibly 0 or not finite */
    BURNISH_COLOR,    /* 4 bytes: sRGB and alpha */
    BURNISH_TEXCOORD, /* 2 floats */
    BURNISH_TANGENT,  /* 4 floats: burnish_mesh_view.tangents; dropped where no normal texture is
                         used */
    BURNISH_ATTRIBUTE_COUNT
} burnish_attribute;

/* Bytes of one item. */
static inline size_t burnish_attribute_size(burnish_attribute attribute) {
    static const uint8_t sizes[BURNISH_ATTRIBUTE_COUNT] = {12, 12, 4, 8, 16};
    return sizes[attribute];
}

/* The values of one attribute, and which of them each corner has. */
typedef struct burnish_stream {
    void *items; /* `count` of them; 0: the file has none */
    size_t count, capacity;
    uint32_t *corners; /* 3 per triangle, BURNISH_NONE: no value; NULL: as positions are numbered */
    size_t corner_capacity; /* triangles */
} burnish_stream;

/* Start from burnish_mesh_data_begin(). Readers guarantee: finite positions, corners of positions,
 * indices in range (as many items as positions where corners is NULL), counts below 2^32 - 1.
 * Triangles without area or with repeated indices may be there: build drops them. */
typedef struct burnish_mesh_data {
    burnish_stream streams[BURNISH_ATTRIBUTE_COUNT];
    size_t triangle_count;
    size_t point_count, line_count;     /* that triangles stand for */
    float points_min[3], points_max[3]; /* bounds of these points, or of the lines' ends */
    float up_axis[3];                   /* unit length; all 0: the format's */
    const char *unit;                   /* burnish_mesh_info.unit */

    uint16_t *triangle_materials; /* 1 per triangle, in range; NULL: all have material 0 */
    size_t triangle_material_capacity;

    burnish_material *materials; /* empty: build adds burnish_material_default() */
    size_t material_count, material_capacity;

    burnish_texture *textures; /* with their names and pixels, which are owned */
    size_t texture_count, texture_capacity;

    burnish_named_camera *cameras; /* with their names, which are owned */
    size_t camera_count, camera_capacity;

    burnish_file_light *lights;
    size_t light_count, light_capacity;

    char **warnings;
    size_t warning_count, warning_capacity;
    int is_silent; /* 1: warnings have been told, by an earlier reading */

    double origin[3]; /* of the positions, in the file's coordinates: burnish_mesh_view.origin */

    burnish_memory memory; /* where all arrays come from, and whom errors are told */
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

/* Releases the values and corners of one attribute. */
void burnish_mesh_data_drop(burnish_mesh_data *mesh, burnish_attribute attribute);

/* Appends a line and tells the context's log; of more than 16 lines the further ones are dropped.
 */
__attribute__((format(printf, 2, 3))) void burnish_mesh_data_warn(burnish_mesh_data *mesh,
                                                                  const char *format, ...);

/* Appends a texture; pixels, of 4 bytes a texel, become the data's, also on failure.
 *   name  copied; may be NULL
 * Returns 1 + its number, 0 on failure: mesh->memory has the status. */
int burnish_mesh_data_add_texture(burnish_mesh_data *mesh, const char *name, int width, int height,
                                  uint8_t *pixels, int is_color);

/* Room for `count` items of an attribute, or for the corners of `triangles` triangles; what was
 * there is dropped. Returns the status of mesh->memory. */
burnish_status burnish_mesh_data_reserve(burnish_mesh_data *mesh, burnish_attribute attribute,
                                         size_t count);
burnish_status burnish_mesh_data_reserve_corners(burnish_mesh_data *mesh,
                                                 burnish_attribute attribute, size_t triangles);

/* Typed views; NULL where there are none. */
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

/* name without the colon: "teapot", "sphere", "torus", "knot". */
burnish_status burnish_make_builtin(const char *name, const burnish_load_options *options,
                                    burnish_mesh_data *data, burnish_error *error);

/* ---- The mesh ---- */

struct burnish_mesh {
    burnish_mesh_view view; /* its pointers are the arrays below */
    burnish_mesh_info info;
    burnish_mesh_facts facts;
    int has_facts;
    float points_min[3], points_max[3]; /* as in burnish_mesh_data */
    const burnish_context *context;     /* where all arrays come from */

    void *attributes[BURNISH_ATTRIBUTE_COUNT]; /* vertex_count items each; NULL: none */
    uint32_t *indices;
    uint16_t *triangle_materials;

    burnish_material *materials;
    size_t material_count;

    burnish_texture *textures; /* with their names and pixels, which are owned */
    size_t texture_count;

    burnish_named_camera *cameras; /* with their names */
    size_t camera_count;

    burnish_file_light *lights;
    size_t light_count;

    char **warnings;
    size_t warning_count;
};

/* Releases textures, and cameras, with what they own. */
void burnish_textures_release(const burnish_context *context, burnish_texture *textures,
                              size_t count);
void burnish_cameras_release(const burnish_context *context, burnish_named_camera *cameras,
                             size_t count);

/* The view of the mesh's arrays, whose counts are set in it; a new serial. */
void burnish_mesh_update_view(burnish_mesh *mesh);

/* Welds positions, turns and orders triangles, drops those without area, generates normals. Takes
 * arrays out of the data; the caller still destroys it. *mesh is NULL on error.
 *   name     of the input, for messages, which go to the data's memory.error
 *   options  checked
 *   format   tells the up axis and the crease angle
 * Errors: FORMAT, MEMORY, CANCELLED. */
burnish_status burnish_mesh_build(burnish_mesh_data *data, const char *name,
                                  const burnish_load_options *options, burnish_format format,
                                  burnish_mesh **mesh);

/* ---- Checks ---- */

/* What the ..._default() functions leave in `cookie`: the struct's name and version. One that was
 * not started from them is refused instead of being read as garbage. */
#define BURNISH_LOAD_OPTIONS_COOKIE 0x6c6f6436u /* "lod6" */
#define BURNISH_DESCRIPTION_COOKIE 0x6d736832u  /* "msh2" */
#define BURNISH_FRAMING_COOKIE 0x66726d32u      /* "frm2" */

/* What every public function that loads looks at first: the place for the mesh, which becomes NULL,
 * and the options.
 * Errors: ARGUMENT (NULL, not started from burnish_load_options_default(), a field out of range).
 */
burnish_status burnish_check_load(const burnish_load_options *options, burnish_mesh **mesh,
                                  burnish_error *error);

/* LIMIT, with its line, where `count` triangles are more than the options allow. `where` is what
 * the line starts with: the input's name, and a location in it. */
burnish_status burnish_check_triangle_count(const burnish_load_options *options, const char *where,
                                            uint64_t count, burnish_error *error);

/* ARGUMENT, with its line, where a number of a material is out of range, or a texture is not one of
 * `texture_count`; `name` is what the line starts with. */
burnish_status burnish_check_material(const burnish_material *material, size_t texture_count,
                                      const char *name, burnish_error *error);

/* Whether a material uses any texture. */
static inline int burnish_material_has_textures(const burnish_material *material) {
    int any = 0;
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        any |= material->textures[slot].texture;
    }
    return any != 0;
}

#endif
