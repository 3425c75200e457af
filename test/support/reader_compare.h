/* For tests of readers with threads: files of random text, and what several threads make of them
 * beside what one makes and what the readers of old made (oracle/). */
#ifndef BURNISH_TEST_READER_COMPARE_H
#define BURNISH_TEST_READER_COMPARE_H

#include <stdarg.h>

#include "mesh/read/io/chunks.h"
#include "oracle/reader.h"
#include "reader_input.h"

enum { PARTS = 17, POOLS = 2, PART_SIZE = BURNISH_CHUNK_SIZE < 4096 ? 4096 : BURNISH_CHUNK_SIZE };

/* ---- text under construction ---- */

typedef struct text {
    char *bytes;
    size_t size, capacity;
    size_t part; /* where the last part begins */
    uint64_t random;
    const char *line_end;
} text;

static inline unsigned below(text *t, unsigned limit) {
    return (unsigned)(test_random64(&t->random) % limit);
}

static inline void add(text *t, const void *bytes, size_t size) {
    if (t->capacity - t->size < size) {
        t->capacity = 2 * t->capacity + size;
        t->bytes = realloc(t->bytes, t->capacity);
        if (!t->bytes) {
            abort();
        }
    }
    memcpy(t->bytes + t->size, bytes, size);
    t->size += size;
}

__attribute__((format(printf, 2, 3))) static inline void say(text *t, const char *format, ...) {
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    add(t, line, (size_t)vsnprintf(line, sizeof line, format, arguments));
    va_end(arguments);
}
static inline void end_line(text *t) {
    say(t, "%s", t->line_end);
}

/* A number of one of the shapes that files hold. */
static inline void say_number(text *t) {
    double value = (double)(int64_t)test_random64(&t->random) / 4e17;
    if (below(t, 100) == 0) {
        say(t, " %+.25f", value);
        return;
    }
    switch (below(t, 8)) {
    case 0:
        say(t, " %.17g", value);
        break;
    case 1:
        say(t, "  %.6e", value);
        break;
    case 2:
        say(t, "\t%d", (int)value);
        break;
    default:
        say(t, " %.6f", value);
    }
}

/* Whether the text now stands `back` bytes before the end of a part that is not the last wanted. */
static inline int near_border(const text *t, size_t back) {
    return t->size - t->part >= PART_SIZE - back;
}

/* ---- comparing ---- */

static inline burnish_status open_library(void *user_data, const char *file, uint64_t max_bytes,
                                          const void **bytes, size_t *size, burnish_error *error) {
    static char libraries[4][256];
    static int next;
    char *library = libraries[next++ % 4];
    (void)user_data, (void)max_bytes;
    if (strncmp(file, "missing", 7) == 0) {
        return burnish_fail(error, BURNISH_STATUS_READ, "%s: not here", file);
    }
    *size = (size_t)snprintf(library, sizeof libraries[0],
                             "newmtl %s\nKd 0.%zu 0 1\nnewmtl red\nKd 1 0 0\nNs 0.5\n", file,
                             strlen(file));
    *bytes = library;
    return BURNISH_STATUS_OK;
}

static inline burnish_status open_oracle(const char *input_name, const char *file,
                                         uint64_t max_bytes, uint8_t **bytes, size_t *size,
                                         burnish_error *error) {
    const void *library = NULL;
    burnish_status status = open_library(NULL, file, max_bytes, &library, size, error);
    (void)input_name;
    if (status == BURNISH_STATUS_OK) {
        *bytes = malloc(*size);
        memcpy(*bytes, library, *size);
    }
    return status;
}

static inline int same(const void *a, const void *b, size_t bytes) {
    return bytes == 0 || (!a && !b) || (a && b && memcmp(a, b, bytes) == 0);
}

/* What several threads and one give: the same. */
static inline void compare_meshes(const char *what, const burnish_mesh_data *a,
                                  const burnish_mesh_data *b) {
    const size_t corners = 3 * a->triangle_count * sizeof(uint32_t);
    if (!CHECK(a->triangle_count == b->triangle_count && a->material_count == b->material_count &&
                   a->warning_count == b->warning_count,
               "%s: %zu %zu triangles, %zu %zu materials, %zu %zu warnings", what,
               a->triangle_count, b->triangle_count, a->material_count, b->material_count,
               a->warning_count, b->warning_count)) {
        return;
    }
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        const burnish_stream *x = &a->streams[i], *y = &b->streams[i];
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        CHECK(x->count == y->count && same(x->items, y->items, x->count * size), "%s: stream %d",
              what, i);
        CHECK(same(x->corners, y->corners, corners), "%s: corners of stream %d", what, i);
    }
    CHECK(same(a->triangle_materials, b->triangle_materials, a->triangle_count * sizeof(uint16_t)),
          "%s", what);
    CHECK(same(a->materials, b->materials, a->material_count * sizeof *a->materials), "%s", what);
    for (size_t i = 0; i < a->warning_count; ++i) {
        CHECK(strcmp(a->warnings[i], b->warnings[i]) == 0, "%s: \"%s\" \"%s\"", what,
              a->warnings[i], b->warnings[i]);
    }
}

/* Whether colours that count to 1 were taken to count to 255, as a mutation makes them: then nearly
 * all bytes are 0 or 1, or 255 where there is none. */
static inline int counts_to_255(const burnish_mesh_data *mesh) {
    const size_t count = mesh->streams[BURNISH_COLOR].count;
    size_t small = 0, others = 0;
    for (size_t i = 0; i < 4 * count; ++i) {
        small += burnish_colors(mesh)[i] <= 1;
        others += burnish_colors(mesh)[i] > 1 && burnish_colors(mesh)[i] < 255;
    }
    return small > others;
}

/* The old readers give the same arrays. They have no texture coordinates, and copies of the
 * positions' corners where normals are numbered as positions are. */
static inline void compare_oracle(const char *what, const burnish_mesh_data *a,
                                  const oracle_source *b) {
    const size_t corners = 3 * a->triangle_count * sizeof(uint32_t);
    const size_t colors = b->colors ? b->position_count : 0;
    const size_t normals = b->corner_normals ? b->normal_count : 0;
    if (!CHECK(a->triangle_count == b->triangle_count && a->material_count == b->material_count &&
                   a->streams[BURNISH_POSITION].count == b->position_count &&
                   a->streams[BURNISH_NORMAL].count == normals &&
                   a->streams[BURNISH_COLOR].count == colors,
               "%s: %zu %zu triangles, %zu %zu materials, %zu %zu positions, %zu %zu normals", what,
               a->triangle_count, b->triangle_count, a->material_count, b->material_count,
               a->streams[BURNISH_POSITION].count, b->position_count,
               a->streams[BURNISH_NORMAL].count, normals)) {
        return;
    }
    CHECK(same(burnish_positions(a), b->positions, 12 * b->position_count), "%s", what);
    CHECK(same(burnish_normals(a), b->normals, 12 * normals), "%s", what);
    CHECK(counts_to_255(a) || same(burnish_colors(a), b->colors, 4 * colors), "%s", what);
    CHECK(same(a->streams[BURNISH_POSITION].corners, b->corner_positions, corners), "%s", what);
    CHECK(normals == 0 ||
              same(burnish_stream_corners(a, BURNISH_NORMAL), b->corner_normals, corners),
          "%s", what);
    CHECK(same(a->triangle_materials, b->triangle_materials, a->triangle_count * sizeof(uint16_t)),
          "%s", what);
    CHECK(same(a->materials, b->materials, a->material_count * sizeof *a->materials), "%s", what);
}

/* The line or byte of a message. */
static inline unsigned long location_of(const char *message) {
    const char *at = strpbrk(message, "0123456789");
    return at ? strtoul(at, NULL, 10) : 0;
}

typedef enum expectation {
    ANYTHING, /* only that all agree */
    GOOD,
    BROKEN,
    FORWARD /* the old readers refuse it: it refers to what comes later */
} expectation;

static inline burnish_status read_oracle(burnish_format format, const text *t,
                                         const burnish_load_options *options, oracle_source *source,
                                         burnish_error *error) {
    const oracle_reader_input input = {.bytes = (const uint8_t *)t->bytes,
                                       .size = t->size,
                                       .name = "mesh",
                                       .options = options,
                                       .open_beside = open_oracle};
    return format == BURNISH_FORMAT_OBJ   ? oracle_read_obj(&input, source, error)
           : format == BURNISH_FORMAT_PLY ? oracle_read_ply(&input, source, error)
                                          : oracle_read_stl(&input, source, error);
}

/* Whether the old reader's error tells what is a warning now. */
static inline int is_tolerated(const char *error) {
    static const char *const words[] = {"normal",   "colour",    "vertex has 5 numbers",
                                        "endsolid", "\"solid\"", "triangles are announced"};
    int found = 0;
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        found |= strstr(error, words[i]) != NULL;
    }
    return found;
}

/* The old reader and the present one, with one thread. What differs on purpose:
 *   - an index of an OBJ may be that of a value that follows it; one that no value has is found at
 *     the end of the file, so that other errors come before it
 *   - some faults are passed over with a warning, so that others are found: in an ASCII PLY rows
 *     with other values than the header says, from which the old reader went wrong somewhere later
 *   - the words of messages, not their locations, but for too many triangles of an ASCII STL */
static inline void check_oracle(const char *what, burnish_format format, const text *t,
                                const burnish_load_options *options, burnish_status status,
                                const burnish_mesh_data *mesh, const burnish_error *error) {
    oracle_source source = {0};
    burnish_error oracle_error = {0};
    burnish_status expected = read_oracle(format, t, options, &source, &oracle_error);
    if (is_tolerated(oracle_error.text) || (mesh->warning_count > 0 && expected)) {
        oracle_source_destroy(&source);
        return;
    }
    const int refers = strstr(oracle_error.text, "before it; correct the index") != NULL;
    if (refers && (status == BURNISH_STATUS_OK || !strstr(error->text, "correct the index") ||
                   location_of(error->text) > location_of(oracle_error.text))) {
        oracle_source_destroy(&source);
        return;
    }
    CHECK(status == expected, "%s: \"%s\", the old reader \"%s\"", what, error->text,
          oracle_error.text);
    if (status == BURNISH_STATUS_OK && expected == status) {
        compare_oracle(what, mesh, &source);
    } else if (status == expected &&
               (status != BURNISH_STATUS_LIMIT || format != BURNISH_FORMAT_STL)) {
        const int is_text_ply =
            format == BURNISH_FORMAT_PLY && memmem(t->bytes, t->size, "format ascii", 12);
        CHECK(is_text_ply || location_of(error->text) == location_of(oracle_error.text),
              "%s: \"%s\", the old reader \"%s\"", what, error->text, oracle_error.text);
    }
    oracle_source_destroy(&source);
}

/* Reads with one thread, with more, and as of old. Returns what one thread says. */
static inline burnish_status check(const char *what, burnish_format format, const text *t,
                                   const burnish_load_options *options, expectation expected) {
    static const int THREADS[POOLS] = {2, 7};
    burnish_mesh_data alone, shared;
    burnish_error alone_error, shared_error;
    burnish_status status =
        run_reader(format, t->bytes, t->size, options, open_library, &alone, &alone_error);
    CHECK(expected == ANYTHING || (expected == BROKEN) == (status != BURNISH_STATUS_OK),
          "%s: status %d, \"%s\"", what, (int)status, alone_error.text);
    check_oracle(what, format, t, options, status, &alone, &alone_error);
    for (int i = 0; i < POOLS; ++i) {
        burnish_tasks tasks;
        burnish_tasks_begin(&tasks, NULL, THREADS[i]);
        burnish_status other = run_reader_threads(format, t->bytes, t->size, options, open_library,
                                                  &tasks, &shared, &shared_error);
        CHECK(status == other && strcmp(alone_error.text, shared_error.text) == 0,
              "%s: %d \"%s\", %d \"%s\"", what, (int)status, alone_error.text, (int)other,
              shared_error.text);
        if (status == BURNISH_STATUS_OK && other == status) {
            compare_meshes(what, &alone, &shared);
        }
        burnish_mesh_data_destroy(&shared);
    }
    burnish_mesh_data_destroy(&alone);
    return status;
}

/* Changes bytes of a good file, a few at a time: whatever comes of it, all agree. */
static inline void check_mutations(const char *what, burnish_format format, text *t,
                                   const char *letters, int count) {
    const burnish_load_options options = burnish_load_options_default();
    int good = 0;
    for (int i = 0; i < count; ++i) {
        const int bytes = 1 + i % 3;
        size_t at[3];
        char old[3], name[64];
        for (int k = 0; k < bytes; ++k) {
            at[k] = test_random64(&t->random) % t->size;
            old[k] = t->bytes[at[k]];
            t->bytes[at[k]] = letters[below(t, (unsigned)strlen(letters))];
        }
        snprintf(name, sizeof name, "%s, mutation %d", what, i);
        good += check(name, format, t, &options, ANYTHING) == BURNISH_STATUS_OK;
        for (int k = bytes - 1; k >= 0; --k) {
            t->bytes[at[k]] = old[k];
        }
    }
    printf("%s: %d of %d mutations are good files\n", what, good, count);
}

/* Puts a line, behind blanks, in place of the next long one from `at` on that begins so. */
static inline void break_line(text *t, size_t at, const char *beginning, const char *line) {
    const size_t size = strlen(line), length = strlen(beginning);
    const char *end = NULL;
    while (!end) {
        if (at + 500 > t->size) {
            at = 1;
        }
        ++at;
        if (t->bytes[at - 1] == '\n' && memcmp(t->bytes + at, beginning, length) == 0) {
            end = memchr(t->bytes + at, '\n', t->size - at);
            end = end && (size_t)(end - t->bytes) >= at + size ? end : NULL;
        }
    }
    memset(t->bytes + at, ' ', (size_t)(end - t->bytes) - at);
    memcpy(t->bytes + (end - t->bytes) - size, line, size);
}

static inline void check_broken(const char *what, burnish_format format, const text *good,
                                const char *beginning, const char *const *lines,
                                const expectation *expected, size_t count) {
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < count; ++i) {
        for (size_t place = 1; place < 4; ++place) {
            text t = {.bytes = malloc(good->size), .size = good->size};
            char name[128];
            memcpy(t.bytes, good->bytes, good->size);
            break_line(&t, good->size * place / 4, beginning, lines[i]);
            snprintf(name, sizeof name, "%s, \"%s\" at %zu/4", what, lines[i], place);
            check(name, format, &t, &options, expected[i]);
            free(t.bytes);
        }
    }
}

#endif
