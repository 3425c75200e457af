/* STL, PLY and numbers: several threads and chunks of any size give what one thread gives for the
 * whole text, array by array, warning by warning, and the same error at the same location. */
#include "reader_compare.h"

/* ---- Files ---- */

static void test_data(void) {
    static const struct {
        const char *name;
        burnish_format format;
    } files[] = {{"cube.obj", BURNISH_FORMAT_OBJ},
                 {"textured.obj", BURNISH_FORMAT_OBJ},
                 {"colors.ply", BURNISH_FORMAT_PLY},
                 {"wedge.stl", BURNISH_FORMAT_STL}};
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        char path[512], bytes[4096];
        text t = {.line_end = "\n"};
        snprintf(path, sizeof path, "%s/%s", TEST_DATA_DIR, files[i].name);
        FILE *file = fopen(path, "rb");
        for (size_t size; file && (size = fread(bytes, 1, sizeof bytes, file)) > 0;) {
            add(&t, bytes, size);
        }
        if (CHECK(file, "no file %s", path)) {
            fclose(file);
        }
        check(files[i].name, files[i].format, &t, &options, GOLDEN);
        free(t.bytes);
    }
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
        check(name, BURNISH_FORMAT_STL, &t, &options, GOLDEN);
        t.size -= strlen("endsolid");
        check(name, BURNISH_FORMAT_STL, &t, &options, GOOD);
        free(t.bytes);
    }
}

/* More blank lines than a chunk has bytes, in a facet or after it. */
static void test_stl_blank_lines(void) {
    const burnish_load_options options = burnish_load_options_default();
    for (int within = 0; within < 2; ++within) {
        text t = {.line_end = "\n"};
        say(&t, "solid\n");
        for (int i = 0; i < 3; ++i) {
            say(&t, "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
            for (int k = 0; within && k < 1 << 17; ++k) {
                end_line(&t);
            }
            say(&t, "endloop\nendfacet\n");
            for (int k = 0; !within && k < 1 << 17; ++k) {
                end_line(&t);
            }
        }
        say(&t, "endsolid\n");
        check("blank lines", BURNISH_FORMAT_STL, &t, &options, GOOD);
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
    say(&t, "solid\nfacet normal 0 0 odd words of a facet without corners\nendfacet\n");
    say_facet(&t, 0); /* which is not the corners of the one before */
    check("ASCII STL, no corners", BURNISH_FORMAT_STL, &t, &options, BROKEN);
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
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, 3);
    CHECK_OK(read_as(&(reader_run){BURNISH_FORMAT_STL, t.bytes, t.size, &options, .tasks = &tasks},
                     &source, &error),
             error);
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

/* Rows of vertices begin with 5, and rows of faces with 77. */
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
            const unsigned digits = below(&t, 1000);
            say(&t, below(&t, 50) ? " 0.%u" : " nan%u", digits);
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
            check(name, BURNISH_FORMAT_PLY, &t, &options, GOLDEN);
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
    static const expectation vertices_expected[] = {GOOD, GOOD, BROKEN, BROKEN, BROKEN, ANYTHING};
    static const char *const faces[] = {"77 2 1 2",     "77 3 1 2 99999", "77 3 1 2 -1",
                                        "77 -1 1 2 3",  "77 3 1 2",       "77 3 1 2 3 4",
                                        "77 99999 1 2", "77 2.5 1 2 3",   "77 0",
                                        "77 3 1 1.5 2", "77 3\r1 2 3",    "\n77 3 1 2 3"};
    static const expectation faces_expected[] = {GOOD,   BROKEN, BROKEN, BROKEN, BROKEN, GOOD,
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

/* As "%e" prints, of any size, in a few forms; one in eight with a character changed. */
static void say_scientific(text *t) {
    static const char *const forms[] = {"%s%u.%06ue%s%02u", "%s%u.%06uE%s%03u", "%s%u.%06ue%s%u",
                                        "%s%u.%07ue%s%02u", "%s%u.%05ue%s%02u", "%s%u.%06ue%s%04u"};
    char number[64];
    const unsigned form = below(t, 2) ? below(t, 2) : below(t, 6);
    const unsigned places = form == 3 ? 10000000 : form == 4 ? 100000 : 1000000;
    const int size = snprintf(number, sizeof number, forms[form], below(t, 2) ? "-" : "",
                              below(t, 10), below(t, 9) ? below(t, places) : 0,
                              below(t, 2) ? "-" : "+", below(t, below(t, 4) ? 20 : 400));
    if (below(t, 8) == 0) {
        number[below(t, (unsigned)size)] = "0123456789.-+eEx/:"[below(t, 18)];
    }
    say(t, " %s", number);
}

/* One look at a number and a character at a time must agree. */
static void test_numbers(void) {
    text t = {.random = test_seed(5), .line_end = "\n"};
    size_t fast = 0, all = 0;
    while (t.size < 2500000) {
        unsigned kind = below(&t, 18);
        if (kind >= 12) {
            say_scientific(&t);
        } else if (kind < 6) {
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
    RUN(test_data());
    RUN(test_numbers());
    RUN(test_stl_text());
    RUN(test_stl_blank_lines());
    RUN(test_stl_broken());
    RUN(test_stl_binary());
    RUN(test_ply());
    RUN(test_ply_broken());
    return test_end("reader_threads");
}
