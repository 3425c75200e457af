/* OBJ with threads and chunks of any size: see test_reader_threads.c. */
#include "reader_compare.h"

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

/* An index of a value so far, from either end. */
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

/* Statements without triangles. */
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

/* Fills a part to its last byte, and begins the next one with critical statements. */
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
    if (plan->materials) { /* which gives a warning */
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
            const double z = (double)below(&t, 1000);
            say(&t, "vn 0 %s %.3f", below(&t, 10) ? "1" : "nan", z);
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
            check(name, BURNISH_FORMAT_OBJ, &t, &options, GOLDEN);
            t.bytes[t.size - 8] = '\n'; /* and with a line end at the end, or in the last face */
            check(name, BURNISH_FORMAT_OBJ, &t, &options, ANYTHING);
            free(t.bytes);
        }
    }
}

/* Unused normals, and colours that only the first vertices of a part seem to have. */
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
    static const expectation expected[] = {BROKEN,   BROKEN, BROKEN,   GOOD,     BROKEN, GOOD,
                                           GOOD,     GOOD,   BROKEN,   BROKEN,   BROKEN, BROKEN,
                                           BROKEN,   GOOD,   ANYTHING, ANYTHING, GOOD,   GOOD,
                                           ANYTHING, GOOD,   BROKEN,   GOOD,     BROKEN, ANYTHING};
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

/* Lines longer than a part, also joined across a border; nothing but line ends. */
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

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_obj());
    RUN(test_obj_unused());
    RUN(test_obj_broken());
    RUN(test_obj_mutations());
    RUN(test_obj_shapes());
    return test_end("obj_threads");
}
