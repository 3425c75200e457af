/* For tests of readers with threads: files of random text, read in several ways that must agree. */
#ifndef BURNISH_TEST_READER_COMPARE_H
#define BURNISH_TEST_READER_COMPARE_H

#include <stdarg.h>

#include "reader_input.h"

enum { PARTS = 17, PART_SIZE = 4096 /* bytes of a chunk in most readings */ };

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

/* Whether the text is within `back` bytes of the end of a part. */
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

typedef enum expectation {
    ANYTHING, /* all readings agree */
    GOOD,
    GOLDEN, /* good, and its mesh has a golden hash */
    BROKEN
} expectation;

/* Hashes of meshes. */
static inline uint64_t hash_words(uint64_t hash, const void *items, size_t bytes, size_t width) {
    for (size_t at = 0; items && at < bytes; at += width) {
        const uint8_t *p = (const uint8_t *)items + at;
        uint32_t word = *p;
        uint16_t half;
        if (width == 4) {
            memcpy(&word, p, 4);
        } else if (width == 2) {
            memcpy(&half, p, 2);
            word = half;
        }
        hash = (hash ^ word) * UINT64_C(0x100000001B3);
    }
    return hash;
}

static inline uint64_t hash_mesh(const burnish_mesh_data *mesh) {
    uint64_t hash = UINT64_C(0xCBF29CE484222325);
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        const burnish_stream *stream = &mesh->streams[i];
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        hash = hash_words(hash, stream->items, stream->count * size, i == BURNISH_COLOR ? 1 : 4);
        hash = hash_words(hash, stream->corners, 12 * mesh->triangle_count, 4);
    }
    for (size_t i = 0; i < mesh->material_count; ++i) {
        hash = hash_words(hash, mesh->materials[i].diffuse, 12, 4);
    }
    return hash_words(hash, mesh->triangle_materials, 2 * mesh->triangle_count, 2);
}

/* test/golden/meshes.txt has a line "HASH NAME" for each file. After a deliberate change, take the
 * new line from the message. */
static inline void check_golden(const char *name, const burnish_mesh_data *mesh) {
    char line[160], expected[160];
    int found = 0;
    FILE *file = fopen(TEST_SOURCE_DIR "/test/golden/meshes.txt", "r");
    snprintf(expected, sizeof expected, "%016llx %.100s\n", (unsigned long long)hash_mesh(mesh),
             name);
    while (file && !found && fgets(line, sizeof line, file)) {
        found = strcmp(line, expected) == 0;
    }
    if (file) {
        fclose(file);
    }
    CHECK(found || getenv("BURNISH_TEST_SEED"), "test/golden/meshes.txt has no line \"%.*s\"",
          (int)strlen(expected) - 1, expected);
}

/* Reads with one thread in one chunk, then with more threads and smaller chunks. Files that are
 * GOOD and have a golden hash are compared with it. Returns the status. */
static inline burnish_status check(const char *what, burnish_format format, const text *t,
                                   const burnish_load_options *options, expectation expected) {
    static const struct {
        int threads;
        size_t chunk_size;
    } ways[] = {{1, 64}, {2, PART_SIZE}, {7, PART_SIZE}, {7, 64}};
    reader_run run = {format, t->bytes, t->size, options, open_library, NULL, (size_t)1 << 30};
    burnish_mesh_data mesh;
    burnish_error error;
    const burnish_status status = read_as(&run, &mesh, &error);
    CHECK(expected == ANYTHING || (expected == BROKEN) == (status != BURNISH_STATUS_OK),
          "%s: status %d, \"%s\"", what, (int)status, error.text);
    if (expected == GOLDEN && status == BURNISH_STATUS_OK) {
        check_golden(what, &mesh);
    }
    for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i) {
        burnish_tasks tasks;
        burnish_tasks_begin(&tasks, NULL, ways[i].threads);
        run.tasks = &tasks;
        run.chunk_size = ways[i].chunk_size;
        check_same_reading(what, &run, status, &mesh, &error);
    }
    burnish_mesh_data_destroy(&mesh);
    return status;
}

/* Changes bytes of a good file, a few at a time: all readings agree on the result. */
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

/* Replaces the next long line from `at` on that begins so by another line, padded with blanks in
 * front. */
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
