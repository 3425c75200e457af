/* Readers with threads: whatever is in a file, several threads give what one gives, array by array,
 * warning by warning, and the same error at the same location; and that is what the readers of old
 * gave (oracle/). Built a second time with chunks of 64 bytes, so that everything crosses them. */
#include <stdarg.h>

#include "mesh/read/chunks.h"
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

static unsigned below(text *t, unsigned limit) {
    return (unsigned)(test_random64(&t->random) % limit);
}

static void add(text *t, const void *bytes, size_t size) {
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

__attribute__((format(printf, 2, 3))) static void say(text *t, const char *format, ...) {
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    add(t, line, (size_t)vsnprintf(line, sizeof line, format, arguments));
    va_end(arguments);
}
static void end_line(text *t) {
    say(t, "%s", t->line_end);
}

/* A number of one of the shapes that files hold. */
static void say_number(text *t) {
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
static int near_border(const text *t, size_t back) {
    return t->size - t->part >= PART_SIZE - back;
}

/* ---- comparing ---- */

static burnish_status open_library(void *user_data, const char *file, uint64_t max_bytes,
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

static burnish_status open_oracle(const char *input_name, const char *file, uint64_t max_bytes,
                                  uint8_t **bytes, size_t *size, burnish_error *error) {
    const void *library = NULL;
    burnish_status status = open_library(NULL, file, max_bytes, &library, size, error);
    (void)input_name;
    if (status == BURNISH_STATUS_OK) {
        *bytes = malloc(*size);
        memcpy(*bytes, library, *size);
    }
    return status;
}

static int same(const void *a, const void *b, size_t bytes) {
    return bytes == 0 || (!a && !b) || (a && b && memcmp(a, b, bytes) == 0);
}

/* What several threads and one give: the same. */
static void compare_meshes(const char *what, const burnish_mesh_data *a,
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

/* The old readers give the same arrays. They have no texture coordinates, and copies of the
 * positions' corners where normals are numbered as positions are. */
static void compare_oracle(const char *what, const burnish_mesh_data *a, const oracle_source *b) {
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
    CHECK(same(burnish_colors(a), b->colors, 4 * colors), "%s", what);
    CHECK(same(a->streams[BURNISH_POSITION].corners, b->corner_positions, corners), "%s", what);
    CHECK(normals == 0 ||
              same(burnish_stream_corners(a, BURNISH_NORMAL), b->corner_normals, corners),
          "%s", what);
    CHECK(same(a->triangle_materials, b->triangle_materials, a->triangle_count * sizeof(uint16_t)),
          "%s", what);
    CHECK(same(a->materials, b->materials, a->material_count * sizeof *a->materials), "%s", what);
}

/* The line or byte of a message. */
static unsigned long location_of(const char *message) {
    const char *at = strpbrk(message, "0123456789");
    return at ? strtoul(at, NULL, 10) : 0;
}

typedef enum expectation {
    ANYTHING, /* only that all agree */
    GOOD,
    BROKEN,
    FORWARD /* the old readers refuse it: it refers to what comes later */
} expectation;

static burnish_status read_oracle(burnish_format format, const text *t,
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

/* The old reader and the present one, with one thread. What differs on purpose:
 *   - an index of an OBJ may be that of a value that follows it; one that no value has is found at
 *     the end of the file, so that other errors come before it
 *   - the words of messages, not their locations, but for too many triangles of an ASCII STL */
static void check_oracle(const char *what, burnish_format format, const text *t,
                         const burnish_load_options *options, burnish_status status,
                         const burnish_mesh_data *mesh, const burnish_error *error) {
    oracle_source source = {0};
    burnish_error oracle_error = {0};
    burnish_status expected = read_oracle(format, t, options, &source, &oracle_error);
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
        CHECK(location_of(error->text) == location_of(oracle_error.text),
              "%s: \"%s\", the old reader \"%s\"", what, error->text, oracle_error.text);
    }
    oracle_source_destroy(&source);
}

/* Reads with one thread, with more, and as of old. Returns what one thread says. */
static burnish_status check(const char *what, burnish_format format, const text *t,
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
static void check_mutations(const char *what, burnish_format format, text *t, const char *letters,
                            int count) {
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

/* ---- OBJ ---- */

typedef struct obj_plan {
    int normals, textures, colors; /* colors: 0 none, 1 some, 2 from the middle on, 3 all */
    int materials, joins, polygons;
    int runs; /* hundreds of lines of one kind */
} obj_plan;

static void say_vertex(text *t, const obj_plan *plan, size_t total) {
    int colored = plan->colors == 3 || (plan->colors == 1 && below(t, 3) == 0) ||
                  (plan->colors == 2 && t->size > total / 2);
    say(t, plan->runs || below(t, 20) ? "v" : "  \tv");
    for (int i = 0; i < (colored ? 6 : 3); ++i) {
        if (plan->joins && below(t, 100) == 0) {
            say(t, " \\%s", t->line_end);
        }
        if (i < 3) {
            say_number(t);
        } else {
            say(t, " 0.%u", below(t, 1000));
        }
    }
    if (!colored && below(t, 50) == 0) {
        say(t, " 1.0"); /* w */
    }
    say(t, "%s", plan->runs || below(t, 40) ? "" : " # behind");
    end_line(t);
}

/* An index of what stands so far, from either end. */
static void say_index(text *t, size_t count) {
    int index = (int)below(t, (unsigned)count) + 1;
    say(t, "%d", below(t, 4) == 0 ? index - (int)count - 1 : index);
}

static void say_face(text *t, const obj_plan *plan, size_t vertices, size_t normals) {
    unsigned corners = plan->polygons && below(t, 4) == 0 ? 4 + below(t, 6) : 3;
    unsigned form = below(t, 4);
    say(t, "f");
    for (unsigned i = 0; i < corners; ++i) {
        if (plan->joins && below(t, 30) == 0) {
            say(t, "\\%s", t->line_end);
        }
        say(t, " ");
        say_index(t, vertices);
        if (plan->textures && form == 1) {
            say(t, "/%u", 1 + below(t, 100000));
        } else if (plan->normals && normals > 0 && form >= 2) {
            say(t, form == 2 ? "//" : "/7/");
            say_index(t, normals);
        }
    }
    say(t, "%s", plan->runs || below(t, 40) ? "" : "  # 1 2 3");
    end_line(t);
}

/* What no triangle comes of. */
static void say_other(text *t, const obj_plan *plan) {
    static const char *const lines[] = {
        "# a comment \\", "",        "   ", "g group v f", "s off", "vt 0.5 0.5",
        "vp 1 2",         "o thing", "#",   "far away",    "usage"};
    static const char *const names[] = {"red", "a.mtl", "b.mtl", "no such", "red"};
    unsigned kind = below(t, 14);
    if (kind < 11) {
        say(t, "%s", lines[kind]);
    } else if (plan->materials && kind == 11) {
        static const char *const libraries[] = {"a.mtl", "b.mtl a.mtl", "missing.mtl", "c.mtl"};
        say(t, "mtllib %s", libraries[below(t, 4)]);
    } else if (plan->materials) {
        say(t, "usemtl %s", names[below(t, 5)]);
    }
    end_line(t);
}

/* Fills a part to its last byte, and begins the next one with what is easily lost there. */
static void cross_border(text *t, const obj_plan *plan, size_t vertices) {
    size_t room = PART_SIZE - (t->size - t->part);
    unsigned kind = below(t, 4);
    char line[1024];
    if (room < 100 || room > sizeof line) {
        abort();
    }
    memset(line, '#', sizeof line);
    if (kind == 0 && plan->joins) { /* the line end in question is joined */
        static const char face[] = "\nf                       1 \\\n";
        memcpy(line + room - strlen(face), face, strlen(face));
        add(t, line, room);
        say(t, "2 %zu\n", vertices);
        t->part = t->size;
    } else {
        line[room - 1] = '\n';
        add(t, line, room);
        t->part = t->size;
    }
    if (plan->materials) { /* of which a line is warned */
        say(t, "mtllib missing%zu.mtl\n", t->size);
    }
    if (kind == 1 && plan->materials) {
        say(t, "usemtl b.mtl\nf 1 2 %zu\nusemtl red\n", vertices);
    } else if (kind == 2) {
        say(t, "f -1 -2 -3\n");
    }
}

static text make_obj(uint64_t seed, const obj_plan *plan, const char *line_end) {
    const size_t total = (size_t)PARTS * PART_SIZE - 5000;
    text t = {.random = test_seed(seed), .line_end = line_end};
    size_t vertices = 0, normals = 0;
    if (below(&t, 2)) {
        say(&t, "\xEF\xBB\xBF");
        t.part = t.size;
    }
    unsigned kind = 0;
    for (size_t left = 0; t.size < total; --left) {
        if (left == 0 || !plan->runs || kind == 19) {
            kind = below(&t, 20);
            left = 300 + below(&t, 300);
        }
        if (near_border(&t, 900)) {
            cross_border(&t, plan, vertices);
        } else if (vertices < 4 || kind < 8) {
            say_vertex(&t, plan, total);
            ++vertices;
            if (plan->runs && plan->textures) {
                say(&t, "vt 0.5 %u", below(&t, 9));
                end_line(&t);
            }
        } else if (plan->normals && kind < 11) {
            say(&t, "vn 0 %s %.3f", below(&t, 10) ? "1" : "nan", (double)below(&t, 1000));
            end_line(&t);
            ++normals;
        } else if (kind < 19) {
            say_face(&t, plan, vertices, normals);
        } else {
            say_other(&t, plan);
        }
    }
    say(&t, "f 1 2 3");
    return t;
}

/* Puts a line, behind blanks, in place of the next long one from `at` on that begins so. */
static void break_line(text *t, size_t at, const char *beginning, const char *line) {
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

static void check_broken(const char *what, burnish_format format, const text *good,
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

static void test_obj(void) {
    static const obj_plan plans[] = {
        {0, 0, 0, 0, 0, 0, 0}, {1, 1, 0, 1, 0, 1, 0}, {1, 1, 1, 1, 1, 1, 0},
        {0, 1, 2, 1, 0, 1, 0}, {1, 0, 3, 0, 1, 0, 0}, {1, 1, 3, 1, 1, 1, 0},
        {0, 0, 0, 0, 0, 0, 1}, {1, 1, 0, 1, 0, 1, 1}, {1, 1, 2, 1, 0, 1, 1},
    };
    static const char *const line_ends[] = {"\n", "\r\n"};
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof plans / sizeof *plans; ++i) {
        for (size_t k = 0; k < 2; ++k) {
            char name[32];
            text t = make_obj(100 * i + k, &plans[i], line_ends[k]);
            snprintf(name, sizeof name, "OBJ %zu.%zu", i, k);
            check(name, BURNISH_FORMAT_OBJ, &t, &options, GOOD);
            t.bytes[t.size - 8] = '\n'; /* and with a line end at the end, or in the last face */
            check(name, BURNISH_FORMAT_OBJ, &t, &options, ANYTHING);
            free(t.bytes);
        }
    }
}

/* Normals that no face names, colours that only the first vertices of a part seem to have. */
static void test_obj_unused(void) {
    const burnish_load_options options = burnish_load_options_default();
    text t = {.line_end = "\n"};
    while (t.size < 8 * PART_SIZE) {
        say(&t, "vn 0 0 1\nv 0 0 0 1 # . .\nv 1 0 0\nv 0 %zu 1\nf -1 -2 -3\n", t.size);
    }
    check("unused normals", BURNISH_FORMAT_OBJ, &t, &options, GOOD);
    free(t.bytes);
}

static void test_obj_broken(void) {
    static const char *const lines[] = {"v 1 2",
                                        "v 1 2 nan",
                                        "v 1e39 0 0",
                                        "v 1 2 3 4 5",
                                        "v a b c",
                                        "v 1 2 3 1 1 x",
                                        "vn 1 2",
                                        "vn 1 2 x",
                                        "f 1 2 0",
                                        "f 1 2 999999999",
                                        "f 1 2 3x",
                                        "f 1 2 -99999999",
                                        "f 1 2 3/4/5/6",
                                        "f 1 2 3//9999999",
                                        "f 1 2",
                                        "f",
                                        "l 1 2 3",
                                        "p 1",
                                        "# a\rv 0 0 0",
                                        "# a\r\rvn",
                                        "f 1\x01 2 3",
                                        "usemtl \x01",
                                        "v",
                                        "f 1 2 3 \\"};
    static const expectation expected[] = {BROKEN,   BROKEN, BROKEN,   BROKEN,   BROKEN, BROKEN,
                                           BROKEN,   BROKEN, BROKEN,   BROKEN,   BROKEN, BROKEN,
                                           BROKEN,   BROKEN, ANYTHING, ANYTHING, GOOD,   GOOD,
                                           ANYTHING, BROKEN, BROKEN,   GOOD,     BROKEN, ANYTHING};
    const obj_plan plan = {1, 1, 0, 1, 0, 1, 0};
    text t = make_obj(77, &plan, "\n");
    check_broken("OBJ", BURNISH_FORMAT_OBJ, &t, "f ", lines, expected,
                 sizeof lines / sizeof *lines);
    burnish_load_options options = burnish_load_options_default();
    options.max_triangles = PART_SIZE / 4;
    check("OBJ with too many triangles", BURNISH_FORMAT_OBJ, &t, &options, BROKEN);
    free(t.bytes);
}

static void test_obj_mutations(void) {
    const obj_plan plan = {1, 1, 1, 1, 1, 1, 0};
    text t = make_obj(78, &plan, "\n");
    check_mutations("OBJ", BURNISH_FORMAT_OBJ, &t, "\n\r\\ #v0123456789012345678", 60);
    free(t.bytes);
}

/* Lines longer than a part, joined over a border too; nothing but line ends. */
static void test_obj_shapes(void) {
    const burnish_load_options options = burnish_load_options_default();
    text t = {.line_end = "\n"};
    say(&t, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    while (t.size < 3 * PART_SIZE) {
        say(&t, " %zu%s", 1 + t.size % 3, t.size % 97 ? "" : "\\\r\n");
    }
    say(&t, "\nv 0 0 1\nf 1 2 4\n#");
    while (t.size < 6 * PART_SIZE) {
        say(&t, "                                       \\");
    }
    say(&t, "\nf -1 -2 -3\n");
    while (t.size < 8 * PART_SIZE) {
        say(&t, "\n\n\r\n\n");
    }
    say(&t, "f -1 -2 -3\n");
    check("OBJ of long lines", BURNISH_FORMAT_OBJ, &t, &options, GOOD);
    free(t.bytes);
}

/* ---- STL ---- */

static void say_facet(text *t, int odd) {
    say(t, odd ? "  FACET  Normal" : "facet normal");
    for (int i = 0; i < 3; ++i) {
        if (odd && below(t, 8) == 0) {
            say(t, " nan");
        } else {
            say_number(t);
        }
    }
    end_line(t);
    say(t, "  outer loop%s", odd && below(t, 2) ? "\n\n" : t->line_end);
    for (int i = 0; i < 3; ++i) {
        say(t, odd ? " Vertex" : "vertex");
        for (int k = 0; k < 3; ++k) {
            say_number(t);
        }
        say(t, "%s", odd && below(t, 2) ? "  " : t->line_end);
    }
    say(t, odd ? "endLoop endfacet" : "  endloop%sendfacet", t->line_end);
    end_line(t);
}

static text make_stl(uint64_t seed, int odd, const char *line_end) {
    text t = {.random = test_seed(seed), .line_end = line_end};
    say(&t, "solid one\n");
    while (t.size < (size_t)PARTS * PART_SIZE) {
        if (below(&t, 500) == 0) {
            say(&t, "endsolid facet 1 2 3\nsolid\nendsolid\n%ssolid facet\n", odd ? "\n \n" : "");
        }
        say_facet(&t, odd && below(&t, 3) == 0);
    }
    say(&t, "endsolid");
    return t;
}

static void test_stl_text(void) {
    static const char *const line_ends[] = {"\n", "\r\n", " \n"};
    const burnish_load_options options = burnish_load_options_default();
    for (uint64_t i = 0; i < 6; ++i) {
        char name[32];
        text t = make_stl(i, i % 2 != 0, line_ends[i / 2]);
        snprintf(name, sizeof name, "ASCII STL %d", (int)i);
        check(name, BURNISH_FORMAT_STL, &t, &options, GOOD);
        t.size -= strlen("endsolid");
        check(name, BURNISH_FORMAT_STL, &t, &options, BROKEN);
        free(t.bytes);
    }
}

static void test_stl_broken(void) {
    static const char *const lines[] = {
        "vertex 1 2 3 4",   "vertex 1 2", "vertex 1 2 inf", "vertex 1e39 0 0",    "vertex 1 2 3x",
        "endsolid",         "solid",      "facet",          "facet normal 0 0 1", "endfacet",
        "endloop endfacet", "vertex"};
    static const expectation expected[] = {BROKEN, BROKEN, BROKEN, BROKEN, BROKEN, BROKEN,
                                           BROKEN, BROKEN, BROKEN, BROKEN, BROKEN, BROKEN};
    text t = make_stl(50, 1, "\n");
    check_broken("ASCII STL", BURNISH_FORMAT_STL, &t, "vertex", lines, expected,
                 sizeof lines / sizeof *lines);
    check_mutations("ASCII STL", BURNISH_FORMAT_STL, &t, "\n\r \tendfacsoli0123456789.-", 40);
    burnish_load_options options = burnish_load_options_default();
    options.max_triangles = PART_SIZE / 32;
    check("ASCII STL with too many triangles", BURNISH_FORMAT_STL, &t, &options, BROKEN);
    options = burnish_load_options_default();
    say(&t, " ENDFACE\nsolid Ndfa\nendsolid\n"); /* counted as a facet, which it is not */
    check("ASCII STL, a name", BURNISH_FORMAT_STL, &t, &options, GOOD);
    free(t.bytes);
}

/* Facets in shares of threads: every one where it belongs. */
static void test_stl_binary(void) {
    enum { COUNT = 100000 };
    burnish_load_options options = burnish_load_options_default();
    text t = {.random = test_seed(9)};
    const char head[80] = "solid";
    const uint32_t count = COUNT;
    add(&t, head, sizeof head);
    add(&t, &count, 4);
    for (int i = 0; i < COUNT; ++i) {
        float values[12];
        for (int k = 0; k < 12; ++k) {
            values[k] = (float)below(&t, 1u << 24) - 1e6f;
        }
        add(&t, values, sizeof values);
        add(&t, "??", 2);
    }
    check("binary STL", BURNISH_FORMAT_STL, &t, &options, ANYTHING);
    burnish_mesh_data source;
    burnish_error error;
    burnish_tasks tasks, *pool = &tasks;
    burnish_tasks_begin(&tasks, NULL, 3);
    CHECK(run_reader_threads(BURNISH_FORMAT_STL, t.bytes, t.size, &options, NULL, pool, &source,
                             &error) == BURNISH_STATUS_OK,
          "%s", error.text);
    size_t wrong = 0;
    for (size_t i = 0; i < COUNT && source.triangle_count == COUNT; ++i) {
        wrong += memcmp(burnish_positions(&source) + 9 * i, t.bytes + 84 + 50 * i + 12, 36) != 0;
        for (uint32_t k = 0; k < 3; ++k) {
            wrong += source.streams[BURNISH_POSITION].corners[3 * i + k] != 3 * i + k;
        }
    }
    CHECK(source.triangle_count == COUNT && wrong == 0, "%zu facets, %zu wrong",
          source.triangle_count, wrong);
    burnish_mesh_data_destroy(&source);
    memset(t.bytes + 84 + 50 * 70000 + 20, 255, 4);
    check("binary STL with nan", BURNISH_FORMAT_STL, &t, &options, BROKEN);
    t.size -= 50;
    check("binary STL cut off", BURNISH_FORMAT_STL, &t, &options, BROKEN);
    free(t.bytes);
}

/* ---- PLY ---- */

typedef struct ply_plan {
    int normals, colors, polygons, extra; /* extra: properties and elements that nobody needs */
} ply_plan;

/* Rows of vertices begin with 5, those of faces with 77. */
static text make_ply(uint64_t seed, const ply_plan *plan, const char *line_end) {
    enum { VERTICES = PART_SIZE / 4, FACES = PART_SIZE / 2 };
    text t = {.random = test_seed(seed), .line_end = line_end};
    say(&t, "ply\nformat ascii 1.0\n");
    if (plan->extra) {
        say(&t, "element camera 2\nproperty list uchar int i\nproperty float f\n");
    }
    say(&t,
        "element vertex %d\nproperty int five\nproperty float x\nproperty float y\n%s"
        "property double z\n",
        VERTICES, plan->extra ? "property list uchar int tags\n" : "");
    if (plan->normals) {
        say(&t, "property float nx\nproperty float ny\nproperty float nz\n");
    }
    if (plan->colors) {
        say(&t, "property uchar red\nproperty uchar green\nproperty uchar blue\n%s",
            plan->colors > 1 ? "property uchar alpha\n" : "");
    }
    say(&t,
        "element face %d\nproperty uchar flags\nproperty list uchar int vertex_indices\n"
        "%selement edge 1\nproperty int end\nend_header\n%s",
        FACES, plan->extra ? "property float quality\n" : "",
        plan->extra ? "2 1 2\n0.5\n0 1 " : "");
    for (int i = 0; i < VERTICES; ++i) {
        say(&t, "5");
        say_number(&t);
        say_number(&t);
        say(&t, "%s", !plan->extra ? "" : below(&t, 2) ? " 2 7 7" : " 0");
        say_number(&t);
        for (int k = 0; plan->normals && k < 3; ++k) {
            say(&t, below(&t, 50) ? " 0.%u" : " nan%u", below(&t, 1000));
        }
        for (int k = 0; plan->colors && k < 2 + plan->colors; ++k) {
            say(&t, " %u", below(&t, 256));
        }
        say(&t, "%s", below(&t, 30) ? "" : "  ");
        end_line(&t);
    }
    for (int i = 0; i < FACES; ++i) {
        unsigned corners = plan->polygons && below(&t, 3) == 0 ? 4 + below(&t, 5) : 3;
        say(&t, "77 %u", corners);
        while (corners-- > 0) {
            say(&t, " %u", below(&t, VERTICES));
        }
        say(&t, "%s", plan->extra ? "\t0.5" : "");
        end_line(&t);
    }
    say(&t, "12");
    return t;
}

static void test_ply(void) {
    static const ply_plan plans[] = {
        {0, 0, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}, {1, 2, 1, 1}, {0, 0, 1, 1}};
    static const char *const line_ends[] = {"\n", "\r\n"};
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof plans / sizeof *plans; ++i) {
        for (size_t k = 0; k < 2; ++k) {
            char name[32];
            text t = make_ply(10 * i + k, &plans[i], line_ends[k]);
            snprintf(name, sizeof name, "ASCII PLY %zu.%zu", i, k);
            check(name, BURNISH_FORMAT_PLY, &t, &options, GOOD);
            t.size -= 2; /* the last element is empty: the line of the message */
            check(name, BURNISH_FORMAT_PLY, &t, &options, BROKEN);
            free(t.bytes);
        }
    }
}

static void test_ply_broken(void) {
    static const char *const vertices[] = {
        "5 1 2 3 0 0 1 1 2 3 4 5", "5 1 2 3 0 0", "5 nan 2 3", "5 1 2 x", "5 1e39 2 3",
        "5\r1 2 3 0 0 1"};
    static const expectation vertices_expected[] = {BROKEN, BROKEN, BROKEN,
                                                    BROKEN, BROKEN, ANYTHING};
    static const char *const faces[] = {"77 2 1 2",     "77 3 1 2 99999", "77 3 1 2 -1",
                                        "77 -1 1 2 3",  "77 3 1 2",       "77 3 1 2 3 4",
                                        "77 99999 1 2", "77 2.5 1 2 3",   "77 0",
                                        "77 3 1 1.5 2", "77 3\r1 2 3",    "\n77 3 1 2 3"};
    static const expectation faces_expected[] = {GOOD,   BROKEN, BROKEN, BROKEN, BROKEN, BROKEN,
                                                 BROKEN, BROKEN, GOOD,   BROKEN, GOOD,   ANYTHING};
    const ply_plan plan = {1, 0, 1, 0};
    text t = make_ply(40, &plan, "\n");
    check_broken("ASCII PLY", BURNISH_FORMAT_PLY, &t, "5 ", vertices, vertices_expected,
                 sizeof vertices / sizeof *vertices);
    check_broken("ASCII PLY", BURNISH_FORMAT_PLY, &t, "77 ", faces, faces_expected,
                 sizeof faces / sizeof *faces);
    check_mutations("ASCII PLY", BURNISH_FORMAT_PLY, &t, "\n\r \t0123456789.-e", 40);
    burnish_load_options options = burnish_load_options_default();
    options.max_triangles = PART_SIZE / 2;
    check("ASCII PLY with too many triangles", BURNISH_FORMAT_PLY, &t, &options, BROKEN);
    free(t.bytes);
}

/* ---- numbers ---- */

/* One look at a number and a character at a time must agree. */
static void test_numbers(void) {
    text t = {.random = test_seed(5), .line_end = "\n"};
    size_t fast = 0, all = 0;
    while (t.size < 1500000) {
        unsigned kind = below(&t, 12);
        if (kind < 6) {
            say_number(&t);
        } else if (kind < 10) { /* digits around 2^53, any small exponent */
            say(&t, " %s%.*f", kind & 1 ? "-" : "", (int)below(&t, 25),
                (double)(test_random64(&t.random) >> below(&t, 64)) /
                    (double)(1 + below(&t, 100000)));
        } else {
            say(&t, " %llu.%0*lluE%+d",
                (unsigned long long)(test_random64(&t.random) >> below(&t, 64)), (int)below(&t, 12),
                (unsigned long long)below(&t, 1000), (int)below(&t, 50) - 25);
        }
    }
    burnish_lexer one = burnish_lexer_open((const uint8_t *)t.bytes, t.size, 0), other = one;
    for (burnish_token a, b; burnish_lexer_token(&other, &a); ++all) {
        double x = 0, y = 0;
        burnish_number_status status, expected = burnish_parse_double(a, &y);
        int found = burnish_lexer_double(&one, &b, &x, &status);
        CHECK(found && a.bytes == b.bytes && a.size == b.size && status == expected &&
                  memcmp(&x, &y, sizeof x) == 0,
              "%.*s: %.17g %.17g", (int)a.size, (const char *)a.bytes, x, y);
        fast += one.end - a.bytes > BURNISH_DECIMAL_ROOM && burnish_scan_decimal(a.bytes, &x) > 0;
    }
    CHECK(fast > all / 2, "%zu of %zu", fast, all);
    free(t.bytes);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_numbers());
    RUN(test_obj());
    RUN(test_obj_unused());
    RUN(test_obj_broken());
    RUN(test_obj_mutations());
    RUN(test_obj_shapes());
    RUN(test_stl_text());
    RUN(test_stl_broken());
    RUN(test_stl_binary());
    RUN(test_ply());
    RUN(test_ply_broken());
    return test_end("reader_threads");
}
