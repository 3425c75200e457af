/* Scenes: meshes of several files, placed and joined into one. A reader loads files, adds items,
 * and joins them. */
#ifndef BURNISH_MESH_READ_SCENE_SCENE_H
#define BURNISH_MESH_READ_SCENE_SCENE_H

#include "mesh/read/common/matrix.h"
#include "mesh/read/io/reader.h"

/* The most items of a scene. */
#define BURNISH_SCENE_ITEMS 65535

/* What a scene consists of: a file, or a mesh that its reader makes. */
typedef struct burnish_scene_source {
    burnish_mesh_data mesh;
    char *shown;           /* a file's name for messages; NULL: made */
    const char *path;      /* its end, which identifies the file */
    burnish_status status; /* of reading a file, with its message */
    burnish_error why;
    int is_turned;     /* 1: a file with +Z up that an importer turned to +Y */
    int has_materials; /* 1: those of the scene from first_material on are its own */
    uint32_t first_material;
} burnish_scene_source;

/* A source at one place. */
typedef struct burnish_scene_item {
    burnish_scene_source *source;
    double transform[12]; /* 3 rows of 4, to the coordinates of the scene */
    char name[BURNISH_NAME_SIZE];
    int has_color;   /* 1: srgb replaces the materials and colours of the source */
    uint8_t srgb[4]; /* with alpha */
    uint32_t first_material, first_part; /* set by joining */
    const burnish_mesh_data *mesh;       /* the same: the source's, or its splats */
} burnish_scene_item;

/* Start from {.reader = reader}. */
typedef struct burnish_scene {
    burnish_reader *reader; /* whose mesh becomes all of them */
    burnish_scene_source **sources;
    size_t source_count, source_capacity;
    burnish_scene_item *items;
    size_t item_count, item_capacity;
    const char *unit;     /* of the scene; NULL: that of the first source with a unit */
    int is_robot;         /* 1: units of files do not count, and no file is a robot */
    uint8_t *joint_found; /* 1: a robot of the scene has this joint of the options */
    size_t more_warnings; /* of files, beyond those that are listed */
    uint64_t vertices, triangles, texels; /* of all sources */
} burnish_scene;

/* An empty mesh as a source; NULL if memory is out. */
burnish_scene_source *burnish_scene_make(burnish_scene *scene);

/* Loads a file once, even if that fails. It may be of every format but a scene, and only a scene
 * may have a robot.
 *   name    as the input spells it
 *   source  receives it
 * Errors: as burnish_read, and READ. */
burnish_status burnish_scene_load(burnish_scene *scene, const char *name,
                                  burnish_scene_source **source, burnish_error *error);

/* Counts a source that its reader made, whether items use it or not. Errors: LIMIT. */
burnish_status burnish_scene_count(burnish_scene *scene, const burnish_mesh_data *mesh);

/* Adds an item without a name, at the origin. NULL if there are too many, or memory is out. */
burnish_scene_item *burnish_scene_add(burnish_scene *scene, burnish_scene_source *source);

/* Fills the reader's mesh with all items in their order, at least one. Errors: FORMAT (coordinates
 * that no float can hold), LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_scene_join(burnish_scene *scene);

void burnish_scene_close(burnish_scene *scene);

/* ---- Transforms ---- */

/* Rotates by angles about the fixed axes X, then Y, then Z, and moves: `rpy` and `xyz` of URDF.
 *   sines, cosines  of the angles */
void burnish_scene_place(const double sines[3], const double cosines[3], const double move[3],
                         double transform[12]);

#endif
