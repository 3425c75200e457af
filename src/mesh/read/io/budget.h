/* Limits for the growth of an input: one rule for every reader and every kind of growth.
 *
 * A small file can expand enormously by repeated copies, points that become solids, packed bytes,
 * or pixels of one colour. Each kind of growth has a limit per byte of the input, before anything
 * is unpacked, and of the different files that it names. An input of less than BURNISH_BUDGET_LEAST
 * bytes counts as that many. Time and memory are then proportional to the bytes that were read, and
 * anything that 1 MB may expand to is drawn within 2 seconds. */
#ifndef BURNISH_MESH_READ_IO_BUDGET_H
#define BURNISH_MESH_READ_IO_BUDGET_H

#include "mesh/read/io/reader.h"

enum {
    BURNISH_BUDGET_LEAST = 1 << 20,
    BURNISH_ELEMENTS_PER_BYTE = 5,  /* vertices and triangles; plain files have up to 4.7 if a point
                                       takes three bytes, or 0.1 if a triangle takes 20 */
    BURNISH_UNPACKED_PER_BYTE = 64, /* text of meshes packs to a fifth or a thirtieth, seldom to a
                                       fiftieth */
    BURNISH_TEXELS_PER_BYTE = 32,   /* JPEG has 4 to 16 */
    BURNISH_CROWDED_PER_BYTE = 4, /* corners at vertices of very many triangles: normals there take
                                     most time and memory; meshes have few such vertices */
    BURNISH_SUMS_PER_BYTE = 16    /* values of morph targets that are added up */
};

/* For burnish_load_options.max_memory. */
enum {
    BURNISH_RUN_BYTES = 80 << 20, /* the program, an image, depth maps, tile lists, light */
    BURNISH_ELEMENT_BYTES = 112   /* a point, or a triangle with its vertices, at most */
};

/* The limit for `bytes` bytes. */
static inline uint64_t burnish_budget_of(uint64_t bytes, uint64_t per_byte) {
    bytes = bytes > BURNISH_BUDGET_LEAST ? bytes : BURNISH_BUDGET_LEAST;
    return bytes < UINT64_MAX / per_byte ? bytes * per_byte : UINT64_MAX;
}

/* The bytes of a reader's input, before it was unpacked, and of the companions read so far. */
static inline uint64_t burnish_budget_bytes(const burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    return (input->packed_size ? input->packed_size : input->size) + reader->companion_bytes;
}

/* Bytes that may still be unpacked, after gzip and burnish_reader.unpacked_bytes. */
static inline uint64_t burnish_budget_unpacked_left(const burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    const uint64_t most =
        burnish_budget_of(burnish_budget_bytes(reader), BURNISH_UNPACKED_PER_BYTE);
    const int is_packed = input->packed_size && input->packed_size < input->size;
    const uint64_t used = (is_packed ? input->size : 0) + reader->unpacked_bytes;
    return used < most ? most - used : 0;
}

/* Identifies the file of a companion's name: equal for names that differ only in case, or in parts
 * that are empty or ".". */
uint64_t burnish_companion_key(const char *name);

/* Counts the bytes of a companion that was read: each file once, and a repeated reading as unpacked
 * bytes. Returns 0 if these are too many, or memory is out. */
int burnish_budget_companion(burnish_reader *reader, uint64_t key, uint64_t size);

/* Triangles that may be made: the caller's limit, or else the budget. */
static inline uint64_t burnish_budget_triangles(const burnish_reader *reader) {
    const uint64_t limit = reader->input->options->max_triangles;
    const uint64_t most =
        burnish_budget_of(burnish_budget_bytes(reader), BURNISH_ELEMENTS_PER_BYTE);
    return limit < BURNISH_TRIANGLES_MAX || most > limit ? limit : most;
}

/* burnish_mesh_data.crowded_max of an input that was read. */
static inline uint64_t burnish_budget_crowded(const burnish_reader *reader) {
    return reader->input->options->max_triangles < BURNISH_TRIANGLES_MAX
               ? 0
               : burnish_budget_of(burnish_budget_bytes(reader), BURNISH_CROWDED_PER_BYTE);
}

/* Checks that vertices and triangles are within the budget. There is no budget if the caller sets
 * max_triangles. Errors: LIMIT, with its line. */
burnish_status burnish_budget_check(burnish_reader *reader, uint64_t vertices, uint64_t triangles);

/* How many points or triangles max_memory has room for; UINT64_MAX: no limit. */
uint64_t burnish_budget_room(const burnish_reader_input *input);

#endif
