/* Parts by name, of all formats but 3MF and G-code; leaving them out, and moving them apart. */
#include "gltf_input.h"
#include "mesh_arrays.h"

#define CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
#define FACE "f 1 2 3\n"
#define FACET                                                                                      \
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "                      \
    "0\nendloop\nendfacet\n"

/* The parts as "name:triangles ...", and of each triangle the number of its part. */
static void check_parts(const char *wanted, const char *numbers) {
    char parts[400] = "", of_triangles[100] = "";
    for (size_t i = 0; i < got.part_count; ++i) {
        const size_t used = strlen(parts);
        const double *m = got.parts[i].transform;
        CHECK(m[0] == 1 && m[5] == 1 && m[10] == 1, "%s: %g", wanted, m[0]);
        snprintf(parts + used, sizeof parts - used, "%s%s:%zu", i ? " " : "", got.parts[i].name,
                 got.parts[i].triangle_count);
    }
    for (size_t i = 0; got.triangle_parts && i < got.triangle_count; ++i) {
        of_triangles[i] = (char)('0' + got.triangle_parts[i]);
    }
    CHECK_TEXT(parts, wanted);
    CHECK_TEXT(of_triangles, numbers);
}

static void test_obj_parts(void) {
    static const struct {
        const char *text, *parts, *numbers;
    } rows[] = {
        {FACE FACE, "", ""},
        {"o\ng\n" FACE, "", ""},
        {"o one\ng a\n" FACE, "one:1", ""},
        {"o a\n" FACE "o b c \ng x\nf 1 2 4 3\n" FACE "o a\n" FACE, "a:2 b c:3", "01110"},
        {"g a\n" FACE "o none\ng b\n" FACE FACE "o unused\n", "a:1 b:2", "011"},
        {FACE "o a\n" FACE, ":1 a:1", "01"},
        {"o a\ng\n" FACE "g b\n" FACE "g\n" FACE, ":2 b:1", "010"},
        {"o a\n" FACE "f 1 2 9\no b\n" FACE, "a:2 b:1", "01"},
    };
    char text[400];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        snprintf(text, sizeof text, CORNERS "%s", rows[i].text);
        read_good_text(BURNISH_FORMAT_OBJ, text);
        check_parts(rows[i].parts, rows[i].numbers);
    }
    read_good_text(BURNISH_FORMAT_OBJ, CORNERS "o a\nl 1 2\no b\nl 2 3\n");
    check_parts("", "");
}

/* More names than parts, which recur in another order, in many chunks. */
static void test_many_parts(void) {
    enum { NAMES = 70000, ROOM = 24 * 2 * NAMES };
    const burnish_load_options options = burnish_load_options_default();
    char *text = malloc(ROOM);
    size_t size = (size_t)snprintf(text, ROOM, CORNERS);
    for (int i = 0; i < 2 * NAMES; ++i) {
        size += (size_t)snprintf(text + size, ROOM - size, "o n%d\n" FACE,
                                 i < NAMES ? i : 2 * NAMES - 1 - i);
    }
    reader_run run = {BURNISH_FORMAT_OBJ, text, size, &options, NULL, NULL, 0};
    const burnish_status status = read_run(&run);
    CHECK_OK(status, fault);
    CHECK(got.part_count == BURNISH_PARTS_MAX, "%zu parts", got.part_count);
    check_warning(
        "mesh.obj: part 65535 takes all further ones; split the file to hide or colour them");
    const size_t last = BURNISH_PARTS_MAX - 1, more = NAMES - last;
    for (size_t i = 0; i < got.triangle_count; ++i) {
        const size_t name = i < NAMES ? i : 2 * NAMES - 1 - i;
        if (!CHECK(got.triangle_parts[i] == (name < last ? name : last), "%zu", i)) {
            break;
        }
    }
    CHECK1(got.parts[last].id == last && got.parts[0].triangle_count == 2 &&
           got.parts[last].triangle_count == 2 * more);
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, 3);
    run.tasks = &tasks;
    check_same_reading("many parts", &run, status, &got, &fault);
    free(text);
}

static void test_stl_parts(void) {
    read_good_text(BURNISH_FORMAT_STL, "solid alone\n" FACET "endsolid\n");
    check_parts("", "");
    read_good_text(BURNISH_FORMAT_STL, "solid a b\n" FACET "endsolid a b\nsolid empty\nendsolid\n"
                                       "solid a b\n" FACET FACET "endsolid\n");
    check_parts("a b:1 a b:2", "011");
}

/* A triangle with lines, at two nodes, and one at a third. Nodes have names, or their mesh has. */
static void test_gltf_parts(void) {
    byte_list binary = {.size = 0};
    put_floats(&binary, 9, gltf_triangle);
    read_good("{'asset':{'version':'2.0'},'nodes':[{'mesh':0,'name':'left'},{'mesh':1,"
              "'name':'hidden','extensions':{'KHR_node_visibility':{'visible':false}}},{'mesh':0},"
              "{'name':'empty'},{'mesh':1,'name':'\\u00e9','translation':[5,0,0]}],"
              "'meshes':[{'name':'both','primitives':[{'attributes':{'POSITION':0}},"
              "{'mode':2,'attributes':{'POSITION':0}}]},"
              "{'primitives':[{'attributes':{'POSITION':0}}]}],"
              "'buffers':[{'byteLength':36}],'bufferViews':[{'buffer':0,'byteLength':36}],"
              "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}]}",
              &binary);
    check_parts("left:25 both:25 \xc3\xa9:1",
                "012000000000000000000000000111111111111111111111111");
    CHECK1(got.part_count > 2 && got.parts[2].id == 4 && got.parts[2].transform[3] == 5);
}

/* ---- Leaving out and moving ---- */

/* Squares of one side at x = 0, 1 and 4; the first two share an edge. */
static const char three[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 4 0 0\n"
                            "v 5 0 0\nv 5 1 0\nv 4 1 0\nvn 0 0 1\no a1\nf 1//1 2//1 3//1 4//1\n"
                            "o a2\nf 2//1 5//1 6//1 3//1\no b\nf 7//1 8//1 9//1 10//1\n";

static void test_choice(void) {
    static const struct {
        const char *hidden, *only, *warning;
        float low, high;
    } rows[] = {{"b", NULL, NULL, 0, 2},
                {"a*", NULL, NULL, 4, 5},
                {"*2,b", NULL, NULL, 0, 1},
                {"#1,#3", NULL, NULL, 1, 2},
                {"#1,#3", NULL, NULL, 1, 2},
                {NULL, "?2", NULL, 1, 2},
                {"a2", "a*", NULL, 0, 1},
                {"A1,b", NULL, "a.obj: no part is named \"A1\"; there is \"a1\" and 2 more", 0, 2},
                {NULL, "b,", "a.obj: no part is named \"\"; there is \"a1\", \"a2\", \"b\"", 4, 5}};
    burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        options.hidden_parts = rows[i].hidden;
        options.only_parts = rows[i].only;
        OWNED_MESH *mesh = load_bytes(three, sizeof three - 1, "a.obj", &options);
        if (mesh) {
            const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
            CHECK(view->bounds_min[0] == rows[i].low && view->bounds_max[0] == rows[i].high,
                  "%zu: %g to %g", i, (double)view->bounds_min[0], (double)view->bounds_max[0]);
            CHECK_TEXT(burnish_mesh_get_warning(mesh, 0) ? burnish_mesh_get_warning(mesh, 0) : "",
                       rows[i].warning ? rows[i].warning : "");
        }
    }
    options.hidden_parts = NULL;
    options.only_parts = "c,d";
    check_refused(three, sizeof three - 1, "a.obj", &options, BURNISH_STATUS_ARGUMENT,
                  "a.obj: no part is named \"c\"; there is \"a1\", \"a2\", \"b\"");
    options.only_parts = "b";
    options.hidden_parts = "*";
    check_refused(three, sizeof three - 1, "a.obj", &options, BURNISH_STATUS_ARGUMENT,
                  "a.obj: all parts are left out; show one of them");
}

static void test_explosion(void) {
    static const float wanted[3][2] = {{-4, -3}, {-1, 0}, {8, 9}}; /* by twice -2, -1 and 2 */
    burnish_load_options options = burnish_load_options_default();
    options.explode = 2;
    OWNED_MESH *mesh = load_bytes(three, sizeof three - 1, "a.obj", &options);
    burnish_box boxes[3];
    CHECK1(mesh && burnish_mesh_get_contents(mesh)->part_count == 3);
    if (mesh) {
        burnish_mesh_bound_parts(mesh, boxes);
        CHECK1(burnish_mesh_get_view(mesh)->vertex_count == 12);
    }
    for (int i = 0; i < 3 && mesh; ++i) {
        CHECK(boxes[i].low[0] == wanted[i][0] && boxes[i].high[0] == wanted[i][1] &&
                  boxes[i].low[1] == 0 && boxes[i].high[1] == 1,
              "part %d: %g to %g", i, (double)boxes[i].low[0], (double)boxes[i].high[0]);
    }
    options.explode = 1001;
    check_refused(three, sizeof three - 1, "a.obj", &options, BURNISH_STATUS_ARGUMENT,
                  "options: explode 1001 is not in [0, 1000]");
    static const char far[] = "o a\nv 3e38 0 0\nv 3e38 1e38 0\nv 2e38 0 0\nf 1 2 3\no b\n"
                              "v -3e38 0 0\nv -3e38 1e38 0\nv -2e38 0 0\nf 4 6 5\n";
    options.explode = 1;
    check_refused(far, sizeof far - 1, "a.obj", &options, BURNISH_STATUS_LIMIT,
                  "a part would be moved beyond 3.4e38; move it less");
}

int main(void) {
    RUN(test_obj_parts());
    RUN(test_many_parts());
    RUN(test_stl_parts());
    RUN(test_gltf_parts());
    RUN(test_choice());
    RUN(test_explosion());
    burnish_mesh_data_destroy(&got);
    return test_end("named_parts");
}
