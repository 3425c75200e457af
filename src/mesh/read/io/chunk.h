/* A chunk of text, and what parse() puts into it: parallel_text.h */
#ifndef BURNISH_MESH_READ_IO_CHUNK_H
#define BURNISH_MESH_READ_IO_CHUNK_H

#include "mesh/read/io/reader.h"

/* An event, to be handled in the order of the file. */
typedef struct burnish_chunk_event {
    const uint8_t *at;
    int kind;                  /* the grammar's */
    size_t triangle, position; /* triangles and positions of the chunk before it */
} burnish_chunk_event;

/* Corners whose index is relative to the first value of the chunk, possibly negative. */
typedef struct burnish_chunk_slots {
    uint32_t *items; /* numbers of corners */
    size_t count, capacity;
} burnish_chunk_slots;

typedef struct burnish_chunk {
    const uint8_t *first; /* of its first statement */
    const uint8_t *end;   /* a statement that reaches up to here is the last */
    const uint8_t *cut;   /* what end was before parse() */
    const uint8_t *text_end;
    int is_first; /* nothing precedes it */
    int bounded; /* 1: the next chunk begins at end, which is the start of a statement; 0: parse() moves end */
    size_t rows_left; /* how many rows may be read; SIZE_MAX: all */
    uint64_t most;    /* triangles that the whole file may have */

    /* Set by parse(). */
    burnish_mesh_data data; /* values, corners and triangle_count; no materials */
    unsigned used;          /* bits 1 << attribute: has corners */
    burnish_chunk_slots relative[BURNISH_ATTRIBUTE_COUNT];
    burnish_polygon *polygons;
    size_t polygon_count, polygon_capacity;
    burnish_chunk_event *events;
    size_t event_count, event_capacity;
    size_t highest[BURNISH_ATTRIBUTE_COUNT]; /* highest absolute index + 1 */
    size_t back[BURNISH_ATTRIBUTE_COUNT];    /* how far before the chunk relative ones reach */
    size_t rows;
    const uint8_t *rows_end; /* where the last row ends */
    int is_odd;              /* set by the grammar: some of it is unusual */
    size_t odd_count;        /* words in an unusual form, and the first of them */
    burnish_token odd;
    burnish_status status; /* not OK: must be parsed again, exactly */

    /* Totals before it: known after parsing, or if `exact` is not NULL. */
    burnish_reader *exact; /* takes messages */
    size_t before[BURNISH_ATTRIBUTE_COUNT], triangles_before, rows_before;
    size_t total[BURNISH_ATTRIBUTE_COUNT]; /* of the file; SIZE_MAX: not known yet */

    uint32_t *scratch; /* corners of one face */
    size_t scratch_capacity;
    burnish_error error; /* of memory */
} burnish_chunk;

/* Ends the chunk; the message is written if the chunk is exact. */
__attribute__((format(printf, 4, 5))) burnish_status burnish_chunk_fail(burnish_chunk *chunk,
                                                                        burnish_status status,
                                                                        const uint8_t *at,
                                                                        const char *format, ...);

/* Notes a bad value in reader->damage, or a bad face. Returns 1 if parsing goes on without it; 0 if
 * the chunk ends here, as it must be parsed exactly to have a message. */
__attribute__((format(printf, 4, 5))) int
burnish_chunk_pardon(burnish_chunk *chunk, int is_face, const uint8_t *at, const char *format, ...);

/* The same for a coordinate that is no finite number. */
int burnish_chunk_pardon_number(burnish_chunk *chunk, burnish_token token,
                                burnish_number_status number);

/* Records a word in an unusual form, which is accepted. */
void burnish_chunk_note_odd(burnish_chunk *chunk, burnish_token token);

/* Whether a number can be used. ODD becomes OK, and is recorded; chunk NULL: it is not. */
static inline int burnish_chunk_takes(burnish_chunk *chunk, burnish_token token,
                                      burnish_number_status *number) {
    if (*number == BURNISH_NUMBER_ODD) {
        *number = BURNISH_NUMBER_OK;
        if (chunk) {
            burnish_chunk_note_odd(chunk, token);
        }
    }
    return *number == BURNISH_NUMBER_OK;
}

/* A whole number, also as "2.0", which is recorded. */
burnish_number_status burnish_chunk_index(burnish_chunk *chunk, burnish_token token,
                                          int64_t *value);

/* Makes room for one more item. */
int burnish_chunk_grow(burnish_chunk *chunk, burnish_attribute attribute);

/* Returns the address of the next item of an attribute; NULL with chunk->status if memory is out.
 */
static inline void *burnish_chunk_append(burnish_chunk *chunk, burnish_attribute attribute) {
    burnish_stream *stream = &chunk->data.streams[attribute];
    if (stream->count == stream->capacity && !burnish_chunk_grow(chunk, attribute)) {
        return NULL;
    }
    return (char *)stream->items + burnish_attribute_size(attribute) * stream->count++;
}

/* Appends the triangles of a face: a fan, to be cut properly later.
 *
 * at:       the face, for messages
 * corners:  per corner `stride` numbers, that of an attribute at [attribute]
 * count:    corners, >= 3
 * used:     bits 1 << attribute: attributes with a value at any corner; other attributes get no
 *           values
 * Errors: LIMIT if the chunk is exact, MEMORY. */
burnish_status burnish_chunk_append_face(burnish_chunk *chunk, const uint8_t *at,
                                         const uint32_t *corners, size_t stride, size_t count,
                                         unsigned used);

/* Records an event, to be handled in the order of the file. */
void burnish_chunk_note(burnish_chunk *chunk, int kind, const uint8_t *at);

/* The scratch array with room for `count` numbers; NULL if memory is out, or if the face would
 * exceed the triangle limit. */
uint32_t *burnish_chunk_scratch(burnish_chunk *chunk, size_t count);

#endif
