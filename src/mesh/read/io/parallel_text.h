/* Text in chunks, which threads read in parallel; a small file is one chunk.
 *
 * Each chunk is parsed into separate arrays, as if it were the start of the file, and then appended
 * to the whole in the order of the file. A chunk with an error is parsed again when everything
 * before it is known, which gives the message. The first error of the file is therefore the one
 * that is reported, whether it is in a statement or in grammar->accept, for any number of threads.
 */
#ifndef BURNISH_MESH_READ_IO_PARALLEL_TEXT_H
#define BURNISH_MESH_READ_IO_PARALLEL_TEXT_H

#include "mesh/read/io/chunk.h"

/* Bytes of a chunk, up to the end of its last statement. This is about 0.2 ms of work, far more
 * than the cost of scheduling it, and its data fits into the second-level cache. */
#ifndef BURNISH_CHUNK_SIZE
#define BURNISH_CHUNK_SIZE 65536
#endif

typedef struct burnish_grammar {
    /* The first byte from `from` on at which a chunk may begin; `end` when there is none. NULL:
     * starts can't be recognised, so chunks are read one after the other. */
    const uint8_t *(*find_start)(const uint8_t *from, const uint8_t *end);
    /* Reads statements from chunk->first on until one ends at chunk->end or after it. */
    void (*parse)(const void *state, burnish_chunk *chunk);
    /* In the order of the file, before the chunk is appended; may be NULL. */
    burnish_status (*accept)(void *state, const burnish_chunk *chunk);
    unsigned indexed; /* bits 1 << attribute: attributes with separate corners */
    unsigned lenient; /* attributes whose corners may refer to missing values */
} burnish_grammar;

/* A find_start for rows: after the next line end. */
const uint8_t *burnish_chunk_find_line(const uint8_t *from, const uint8_t *end);

/* Appends what is read to reader->mesh.
 *
 * at:    where to begin; receives where reading ended
 * rows:  how many rows to read, at most; receives how many are missing at the end of the file.
 *        NULL: the rest of the file, whatever it holds */
burnish_status burnish_chunks_read(const burnish_grammar *grammar, void *state,
                                   burnish_reader *reader, const uint8_t **at, size_t *rows);

#endif
