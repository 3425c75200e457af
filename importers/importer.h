/* Shared by all importers: they receive a file as standard input, enter a sandbox, and write a mesh
 * stream to standard output. docs/importers.md */
#ifndef BURNISH_IMPORTER_H
#define BURNISH_IMPORTER_H

#include <stddef.h>
#include <stdint.h>

#include "mesh/read/bms.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The file. */
typedef struct importer_input {
    const uint8_t *bytes;
    size_t size;
    const char *extension; /* the file extension, lower case, without the dot: "fbx" */
} importer_input;

/* In the order of the stream. Numbers out of range are clamped when they are written. */
typedef struct importer_material {
    float ambient[3], diffuse[3], specular[3], emissive[3]; /* linear light */
    float exponent, opacity, metallic, roughness, alpha_cutoff, normal_scale;
    uint32_t flags;
    struct {
        uint32_t texture;       /* 1 + number; 0: none */
        uint8_t wrap[2];        /* burnish_texture_wrap */
    } slots[BURNISH_BMS_SLOTS]; /* burnish_texture_slot */
} importer_material;

typedef struct importer_texture {
    burnish_bms_picture kind;
    int is_color;
    uint32_t width, height; /* PIXELS */
    char *name;
    const uint8_t *bytes; /* size of them; FILE: none */
    uint32_t size;
} importer_texture;

/* Triangles that follow those of the part before. */
typedef struct importer_part {
    uint32_t triangle_count;
    char *name;
} importer_part;

/* Counts and parts are set first, then importer_allocate makes the arrays. */
typedef struct importer_mesh {
    uint64_t vertex_count, triangle_count; /* checked by importer_allocate */
    unsigned parts;
    float *positions, *normals, *texcoords; /* all 0 at first */
    uint8_t *colors;
    uint32_t *indices, *triangle_materials;
    importer_material *materials;
    uint32_t material_count;
    importer_texture *textures;
    uint32_t texture_count;
    importer_part *named_parts; /* importer_add_part */
    uint32_t named_part_count;
    float up[3]; /* all 0: +Y */
    float unit;  /* metres; 0: unknown */
    char warnings[4096];
    size_t warnings_size;
} importer_mesh;

/* ---- What an importer is made of ---- */

extern const char importer_name[];

/* Loads what it needs of the system, before the sandbox closes. */
void importer_prepare(void);

/* Runs in the sandbox: no files, network or processes. Ends with importer_fail on errors, or with
 * importer_finish if it has written its own output. Otherwise the mesh is written. */
void importer_import(importer_input *input, importer_mesh *mesh);

/* ---- What it may use ---- */

/* Writes a stream that holds an error of that kind with the first line of a text, and ends the
 * process. */
#ifdef __cplusplus
[[noreturn]]
#else
_Noreturn
#endif
void importer_fail(burnish_bms_kind kind, const char *text);

/* For output other than a mesh: bytes, a little-endian word, bytes and up to 3 zeros. */
void importer_put(const void *bytes, size_t size);
void importer_put_word(uint32_t word);
void importer_put_padded(const void *bytes, size_t size);

/* Ends the process. Nothing more is written. */
#ifdef __cplusplus
[[noreturn]]
#else
_Noreturn
#endif
void importer_finish(void);

/* Unpacks gzip and zip, and converts UTF-16 with a byte order mark to UTF-8; ends the process on
 * errors. */
void importer_unpack(importer_input *input);

/* Adds a line to the warnings, once. */
void importer_warn(importer_mesh *mesh, const char *text);

/* count * size bytes of zeros; ends the process if memory is out. */
void *importer_zeroed(uint64_t count, size_t size);

/* The arrays of counts and parts. */
void importer_allocate(importer_mesh *mesh);

/* Adds a part of triangles that no part has yet, unless there are none. The parts must have all. */
void importer_add_part(importer_mesh *mesh, const char *name, uint64_t triangles);

/* The colour of sRGB values as linear light. */
void importer_linear(const float srgb[3], float linear[3]);

/* burnish's grey. */
importer_material importer_default_material(void);

#ifdef __cplusplus
}
#endif

#endif
