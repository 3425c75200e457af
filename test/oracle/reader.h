/* The readers as they were before they became one per format: the oracle of test_reader_threads.c
 * until the next release. */
/* The readers: bytes in, oracle_source out. None opens files, but for the material library of an
 * OBJ, which comes through a callback. */
#ifndef ORACLE_MESH_READ_READER_H
#define ORACLE_MESH_READ_READER_H

#include "oracle/source.h"

typedef struct oracle_reader_input {
    const uint8_t *bytes; /* size bytes; nothing is assumed to follow them */
    size_t size;
    const char *name; /* for messages: "FILE:LINE: ..." or "FILE: byte N: ..." */
    const burnish_load_options *options;
    /* Loads a file that lies beside the input; NULL when there is none. *bytes is released with
     * free(). */
    burnish_status (*open_beside)(const char *input_name, const char *file, uint64_t max_bytes,
                                  uint8_t **bytes, size_t *size, burnish_error *error);
} oracle_reader_input;

burnish_status oracle_read_obj(const oracle_reader_input *input, oracle_source *source,
                               burnish_error *error);
burnish_status oracle_read_ply(const oracle_reader_input *input, oracle_source *source,
                               burnish_error *error);
burnish_status oracle_read_stl(const oracle_reader_input *input, oracle_source *source,
                               burnish_error *error);

/* Materials of an MTL file, with names for usemtl to find. */
typedef struct oracle_mtl_entry {
    char *name;
    burnish_material material;
} oracle_mtl_entry;
typedef struct oracle_mtl {
    oracle_mtl_entry *entries;
    size_t count, capacity;
} oracle_mtl;
burnish_status oracle_read_mtl(const uint8_t *bytes, size_t size, const char *name,
                               oracle_mtl *library, burnish_error *error);
void oracle_mtl_destroy(oracle_mtl *library);

#endif
