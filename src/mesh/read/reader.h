/* The readers: bytes in, burnish_source out. None opens files, but for the material library of an
 * OBJ, which comes through a callback. */
#ifndef BURNISH_MESH_READ_READER_H
#define BURNISH_MESH_READ_READER_H

#include "mesh/read/source.h"

typedef struct burnish_reader_input {
    const uint8_t *bytes; /* size bytes; nothing is assumed to follow them */
    size_t size;
    const char *name; /* for messages: "FILE:LINE: ..." or "FILE: byte N: ..." */
    const burnish_load_options *options;
    /* Loads a file that lies beside the input; NULL when there is none. *bytes is released with
     * free(). */
    burnish_status (*open_beside)(const char *input_name, const char *file, uint64_t max_bytes,
                                  uint8_t **bytes, size_t *size, burnish_error *error);
} burnish_reader_input;

burnish_status burnish_read_obj(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error);
burnish_status burnish_read_ply(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error);
burnish_status burnish_read_stl(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error);

/* Materials of an MTL file, with names for usemtl to find. */
typedef struct burnish_mtl_entry {
    char *name;
    burnish_material material;
} burnish_mtl_entry;
typedef struct burnish_mtl {
    burnish_mtl_entry *entries;
    size_t count, capacity;
} burnish_mtl;
burnish_status burnish_read_mtl(const uint8_t *bytes, size_t size, const char *name,
                                burnish_mtl *library, burnish_error *error);
void burnish_mtl_destroy(burnish_mtl *library);

/* name without the colon: "teapot", "sphere", "torus", "knot". */
burnish_status burnish_make_builtin(const char *name, const burnish_load_options *options,
                                    burnish_mesh_data *data, burnish_error *error);

/* The format that bytes and name tell of; AUTO when neither does. */
burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name);

#endif
