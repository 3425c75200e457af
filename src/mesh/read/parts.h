/* Cutting text into parts that threads read side by side.
 *
 * The rule of every threaded reader: it reports nothing. Where anything is wrong or unusual it
 * gives up, and the sequential reader reads all again and finds what to say. So it takes only what
 * it understands fully, and what it takes is what the sequential reader would have given. Parts
 * depend on the text alone, never on the number of threads. */
#ifndef BURNISH_MESH_READ_PARTS_H
#define BURNISH_MESH_READ_PARTS_H

#include "mesh/read/source.h"

#ifndef BURNISH_CHUNK_SIZE /* tests with sanitizers cut small files too */
#define BURNISH_CHUNK_SIZE (1 << 16)
#endif

enum {
    /* Bytes of a part, up to its last line: some 0.15 ms of work, far more than it takes to hand
     * one out, and in a file of half a megabyte enough parts for a few threads. */
    BURNISH_PART_SIZE = BURNISH_CHUNK_SIZE,
    BURNISH_PARTS_LEAST = 4 /* fewer do not pay */
};

/* Whether text of this size is worth the threads of a pool. */
static inline int burnish_parts_pay(const burnish_tasks *pool, size_t size) {
    return size >= (size_t)BURNISH_PARTS_LEAST * BURNISH_PART_SIZE &&
           burnish_tasks_threads(pool) > 1;
}

/* How many parts there are at most. */
static inline size_t burnish_parts_most(size_t size) {
    return size / BURNISH_PART_SIZE + 1;
}

/* Releases an array of a source where reading has given up, so that it is as if it had never been.
 */
static inline void burnish_parts_drop(void **array, size_t *capacity) {
    free(*array);
    *array = NULL;
    *capacity = 0;
}

/* The end of the part that begins at first: behind a line end, or the end of the text. wavefront: a
 * line end behind a '\' is none. */
const uint8_t *burnish_part_end(const uint8_t *first, const uint8_t *end, int wavefront);

/* The '\n' that ends the line at `line`, or end. */
const uint8_t *burnish_find_newline(const uint8_t *line, const uint8_t *end);

/* Line ends, and words between characters up to ' '; a byte lies before `first` for the latter. */
size_t burnish_count_newlines(const uint8_t *first, const uint8_t *end);
size_t burnish_count_words(const uint8_t *first, const uint8_t *end);

/* Tokens of a line, characters up to ' ' standing between them. Returns 0 where it does not know: a
 * '#' is in the line, or fewer than 8 bytes lie from its last one to text_end. */
size_t burnish_count_tokens(const uint8_t *line, const uint8_t *line_end, const uint8_t *text_end);

#endif
