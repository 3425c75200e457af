/* What all importers share: they get a file as standard input, lock themselves in, and write a mesh
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
    const char *ending; /* of its name, lower case, without the point: "fbx" */
} importer_input;

/* In the order of the stream. Numbers out of range are brought into it when they are written. */
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
    float up[3]; /* all 0: +Y */
    float unit;  /* metres; 0: unknown */
    char warnings[4096];
    size_t warnings_size;
} importer_mesh;

/* ---- What an importer is made of ---- */

extern const char importer_name[];

/* Loads what it will need of the system: before the lock. */
void importer_prepare(void);

/* After the lock: no file, no network, no process. Ends by importer_fail where it can't, or by
 * importer_finish when it has written what it has to say; else the mesh is written. */
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

/* What writes something else than a mesh: bytes, a little-endian word, bytes and up to 3 zeros. */
void importer_put(const void *bytes, size_t size);
void importer_put_word(uint32_t word);
void importer_put_padded(const void *bytes, size_t size);

/* Ends the process; what was written is all. */
#ifdef __cplusplus
[[noreturn]]
#else
_Noreturn
#endif
void importer_finish(void);

/* Takes gzip and zip off, and makes UTF-8 of UTF-16 with a mark; ends the process where it can't.
 */
void importer_unpack(importer_input *input);

/* Adds a line to the warnings, once. */
void importer_warn(importer_mesh *mesh, const char *text);

/* count * size bytes of zeros; ends the process when there is no memory. */
void *importer_zeroed(uint64_t count, size_t size);

/* The arrays of counts and parts. */
void importer_allocate(importer_mesh *mesh);

/* The colour of sRGB values as linear light. */
void importer_linear(const float srgb[3], float linear[3]);

/* burnish's grey. */
importer_material importer_default_material(void);

#ifdef __cplusplus
}
#endif

#endif
