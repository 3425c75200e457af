/* Filling a chunk of text. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "mesh/read/io/budget.h"
#include "mesh/read/io/chunk.h"

burnish_status burnish_chunk_fail(burnish_chunk *chunk, burnish_status status, const uint8_t *at,
                                  const char *format, ...) {
    chunk->status = status;
    if (chunk->exact) {
        char message[300];
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message, sizeof message, format, arguments);
        va_end(arguments);
        burnish_reader_fail(chunk->exact, status, at, "%s", message);
    }
    return status;
}

int burnish_chunk_pardon(burnish_chunk *chunk, int is_face, const uint8_t *at, const char *format,
                         ...) {
    char message[300];
    va_list arguments;
    if (!chunk->exact) {
        chunk->status = BURNISH_STATUS_FORMAT;
        return 0;
    }
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    burnish_reader_note(chunk->exact, &chunk->exact->damage, at, "%s", message);
    chunk->exact->has_bad_faces |= is_face;
    return 1;
}

int burnish_chunk_pardon_number(burnish_chunk *chunk, burnish_token token,
                                burnish_number_status number) {
    return burnish_chunk_pardon(chunk, 0, token.bytes, "%s",
                                burnish_describe_number("coordinate", token, number).text);
}

void burnish_chunk_note_odd(burnish_chunk *chunk, burnish_token token) {
    chunk->odd = chunk->odd_count++ == 0 ? token : chunk->odd;
}

burnish_number_status burnish_chunk_index(burnish_chunk *chunk, burnish_token token,
                                          int64_t *value) {
    static const double most = 4294967296;
    double number;
    const burnish_number_status status = burnish_parse_integer(token, value);
    if (status != BURNISH_NUMBER_GARBAGE ||
        burnish_parse_double(token, &number) != BURNISH_NUMBER_OK ||
        !(number > -most && number < most && number == (double)(int64_t)number)) {
        return status;
    }
    *value = (int64_t)number;
    burnish_chunk_note_odd(chunk, token);
    return BURNISH_NUMBER_OK;
}

/* After an allocation for the chunk. */
static int has_memory(burnish_chunk *chunk) {
    if (chunk->data.memory.status != BURNISH_STATUS_OK) {
        chunk->status = chunk->data.memory.status;
    }
    return chunk->status == BURNISH_STATUS_OK;
}

int burnish_chunk_grow(burnish_chunk *chunk, burnish_attribute attribute) {
    burnish_stream *stream = &chunk->data.streams[attribute];
    stream->items =
        burnish_reserve(&chunk->data.memory, stream->items, &stream->capacity, stream->count + 1,
                        burnish_attribute_size(attribute), "values of a chunk");
    return has_memory(chunk);
}

/* If the chunk is exact, the message says whether the file's limit or its budget is exceeded. */
static burnish_status fail_triangles(burnish_chunk *chunk, const uint8_t *at, uint64_t triangles) {
    chunk->status = BURNISH_STATUS_LIMIT;
    if (chunk->exact && burnish_budget_check(chunk->exact, 0, triangles) == BURNISH_STATUS_OK) {
        burnish_fail_triangles(chunk->exact, at);
    }
    return BURNISH_STATUS_LIMIT;
}

uint32_t *burnish_chunk_scratch(burnish_chunk *chunk, size_t count) {
    enum { NUMBERS = 4 /* at most, of a corner */ };
    if (count / NUMBERS > chunk->most + 2) {
        fail_triangles(chunk, chunk->first, count / NUMBERS - 2);
        return NULL;
    }
    if (count > chunk->scratch_capacity) {
        chunk->scratch =
            burnish_reserve(&chunk->data.memory, chunk->scratch, &chunk->scratch_capacity, count,
                            sizeof *chunk->scratch, "corners");
    }
    return has_memory(chunk) ? chunk->scratch : NULL;
}

void burnish_chunk_note(burnish_chunk *chunk, int kind, const uint8_t *at) {
    chunk->events = burnish_reserve(&chunk->data.memory, chunk->events, &chunk->event_capacity,
                                    chunk->event_count + 1, sizeof *chunk->events, "statements");
    if (has_memory(chunk)) {
        chunk->events[chunk->event_count++] = (burnish_chunk_event){
            at, kind, chunk->data.triangle_count, chunk->data.streams[BURNISH_POSITION].count};
    }
}

/* Makes room for `more` triangles. Earlier triangles get no values of the attribute. */
static int reserve_corners(burnish_chunk *chunk, burnish_attribute attribute, size_t more) {
    burnish_stream *stream = &chunk->data.streams[attribute];
    const size_t count = chunk->data.triangle_count;
    const unsigned bit = 1u << attribute;
    if (count + more > stream->corner_capacity) {
        stream->corners =
            burnish_reserve(&chunk->data.memory, stream->corners, &stream->corner_capacity,
                            count + more, 3 * sizeof *stream->corners, "triangles of a chunk");
        if (!has_memory(chunk)) {
            return 0;
        }
    }
    if (!(chunk->used & bit)) {
        memset(stream->corners, 0xFF, 3 * count * sizeof *stream->corners);
        chunk->used |= bit;
    }
    return 1;
}

static int note_polygon(burnish_chunk *chunk, size_t count) {
    chunk->polygons =
        burnish_reserve(&chunk->data.memory, chunk->polygons, &chunk->polygon_capacity,
                        chunk->polygon_count + 1, sizeof *chunk->polygons, "polygons");
    if (!has_memory(chunk)) {
        return 0;
    }
    chunk->polygons[chunk->polygon_count++] =
        (burnish_polygon){(uint32_t)chunk->data.triangle_count, (uint32_t)count};
    return 1;
}

/* The most common face: a triangle with the same attributes as those before it. Returns 0 if there
 * is no room. */
static inline int append_triangle(burnish_chunk *chunk, const uint32_t *corners, size_t stride,
                                  unsigned used) {
    const size_t count = chunk->data.triangle_count;
    if (chunk->exact || chunk->used != used || chunk->triangles_before + count >= chunk->most) {
        return 0;
    }
    for (unsigned i = 0; used >> i; ++i) {
        burnish_stream *stream = &chunk->data.streams[i];
        if (!(used >> i & 1)) {
            continue;
        }
        if (count >= stream->corner_capacity) {
            return 0;
        }
        for (size_t k = 0; k < 3; ++k) {
            stream->corners[3 * count + k] = corners[k * stride + i];
        }
    }
    ++chunk->data.triangle_count;
    return 1;
}

burnish_status burnish_chunk_append_face(burnish_chunk *chunk, const uint8_t *at,
                                         const uint32_t *corners, size_t stride, size_t count,
                                         unsigned used) {
    const size_t first = chunk->data.triangle_count, more = count - 2;
    if (count == 3 && append_triangle(chunk, corners, stride, used)) {
        return BURNISH_STATUS_OK;
    }
    const uint64_t limit = chunk->exact ? burnish_budget_triangles(chunk->exact) : chunk->most;
    if (chunk->triangles_before + first + more > limit) {
        return fail_triangles(chunk, at, chunk->triangles_before + first + more);
    }
    for (unsigned i = 0, all = chunk->used | used; all >> i; ++i) {
        if (!(all >> i & 1)) {
            continue;
        }
        if (!reserve_corners(chunk, (burnish_attribute)i, more)) {
            return chunk->status;
        }
        uint32_t *to = chunk->data.streams[i].corners + 3 * first;
        if (!(used >> i & 1)) {
            memset(to, 0xFF, 3 * more * sizeof *to);
            continue;
        }
        for (size_t k = 0; k < more; ++k, to += 3) {
            to[0] = corners[i];
            to[1] = corners[(k + 1) * stride + i];
            to[2] = corners[(k + 2) * stride + i];
        }
    }
    if (count > 3 && count <= BURNISH_POLYGON_CORNERS && !note_polygon(chunk, count)) {
        return chunk->status;
    }
    chunk->data.triangle_count += more;
    return BURNISH_STATUS_OK;
}
