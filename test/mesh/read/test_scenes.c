/* Scenes: JSON and URDF. Places are compared with numbers of scipy.spatial.transform.Rotation. */
#include <math.h>

#include "base/error.h"
#include "counting_context.h"
#include "mesh_arrays.h"

enum { POINTS = 4 };

/* ---- Files next to the scene ---- */

#define TETRAHEDRON "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
#define HIGHER "v 5 0 0\nv 6 0 0\nv 5 2 0\nv 5 0 3\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n"
#define X61 "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx"
#define XYZ "property float x\nproperty float y\nproperty float z\n"

static char dense[50000], long_text[750000]; /* filled by test_budget() */

static const struct near_file {
    const char *name, *text;
} near_files[] = {
    {"t.obj", TETRAHEDRON},
    {"sub/red.obj", "mtllib red.mtl\nusemtl red\n" TETRAHEDRON},
    {"sub/red.mtl", "newmtl red\nKd 0.5 0 0\n"},
    {"far.obj", "v 5 0 0\nv 6 0 0\nv 5 2 0\nv 5 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"},
    {"T.obj", "v 5 0 0\nv 6 0 0\nv 5 2 0\nv 5 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"},
    {X61 "x\xC3\xA9.obj", TETRAHEDRON},
    {"dense.obj", dense},
    {"1.obj", "mtllib long.mtl\nusemtl m\n" TETRAHEDRON},
    {"2.obj", "mtllib long.mtl\nusemtl m\n" TETRAHEDRON},
    {"long.mtl", "newmtl m\nmap_Kd long.png\n"},
    {"long.png", long_text},
    {"two.obj", "o \xC3\xA9\n" TETRAHEDRON "o b\n" HIGHER},
    {"vn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 1 1\nf 1//1 2//1 3//1\n"},
    {"points.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" XYZ "end_header\n0 0 0\n1 2 3\n"},
    {"up.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ "property float nx\n"
               "property float ny\nproperty float nz\nend_header\n0 0 0 0 0.6 0.8\n"},
    {"splat.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                  "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\n"
                  "property float opacity\nproperty float scale_0\nproperty float scale_1\n"
                  "property float scale_2\nproperty float rot_0\nproperty float rot_1\n"
                  "property float rot_2\nproperty float rot_3\nend_header\n"
                  "1 2 3 0 0 0 9 0 0 0 1 0 0 0\n"},
    {"tinted.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
                   "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n"},
    {"inner.scene.json", "{\"burnish_scene\":1,\"items\":[{\"file\":\"t.obj\"}]}"},
    {"robot.urdf", "<robot name='r'><link name='l'><visual><geometry><box size='1 1 1'/></geometry>"
                   "</visual></link></robot>"},
    {"arm.urdf",
     "<robot name='r'><link name='a'/><link name='b'><visual><geometry><mesh filename='t.obj'/>"
     "</geometry></visual></link><joint name='j' type='prismatic'><parent link='a'/>"
     "<child link='b'/><axis xyz='0 0 1'/><limit lower='-1' upper='9'/></joint></robot>"},
    {"pkg/meshes/t.obj", TETRAHEDRON},
};

static int loads; /* of files */

static burnish_status load_near(void *user_data, const char *name, uint64_t max_bytes,
                                const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data, (void)max_bytes;
    for (size_t i = 0; i < sizeof near_files / sizeof *near_files; ++i) {
        if (strcmp(near_files[i].name, name) == 0) {
            ++loads;
            *bytes = near_files[i].text;
            *size = strlen(near_files[i].text);
            return BURNISH_STATUS_OK;
        }
    }
    if (strncmp(name, "odd", 3) == 0) { /* with a warning */
        *bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nmtllib none.mtl\n";
        *size = strlen(*bytes);
        return BURNISH_STATUS_OK;
    }
    return burnish_fail(error, BURNISH_STATUS_READ, "%s: is not there", name);
}

static burnish_load_options near_options(void) {
    burnish_load_options options = burnish_load_options_default();
    options.referenced_files.load = load_near;
    options.measure = 1;
    loads = 0;
    return options;
}

static burnish_mesh *load_scene(const char *text) {
    const burnish_load_options options = near_options();
    return load_bytes(text, strlen(text), "a", &options);
}

/* The tetrahedron's corners, wherever a transform has moved them. */
static void check_points(const char *what, const burnish_mesh *mesh, size_t count,
                         const double expected[][3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    for (size_t i = 0; view && i < count; ++i) {
        double best = 1e9;
        for (size_t v = 0; v < view->vertex_count; ++v) {
            double distance = 0;
            for (size_t k = 0; k < 3; ++k) {
                distance +=
                    fabs((double)view->positions[3 * v + k] + view->origin[k] - expected[i][k]);
            }
            best = fmin(best, distance);
        }
        CHECK(best < 1e-5, "%s: point %zu is missed by %g", what, i, best);
    }
}

/* ---- JSON ---- */

#define SCENE(items) "{\"burnish_scene\": 1, \"items\": [" items "]}"

/* What is joined is the mesh of a file with the same contents. */
static void test_join(void) {
    OWNED_MESH *joined = load_scene(SCENE("{\"file\": \"t.obj\"}, {\"file\": \"far.obj\"}"));
    OWNED_MESH *whole = load_bytes(TETRAHEDRON HIGHER, strlen(TETRAHEDRON HIGHER), "a.obj", NULL);
    CHECK1(joined && whole && same_meshes(joined, whole) && loads == 2);
    const burnish_contents *contents = burnish_mesh_get_contents(joined);
    CHECK1(contents && contents->part_count == 2 && contents->parts[1].item == 1);
    CHECK_TEXT(contents ? contents->parts[1].name : "", "far");
    CHECK1(joined && burnish_mesh_get_view(joined)->up_axis[1] == 1); /* of OBJ */
}

/* Long names end with a whole character of UTF-8, and all with zeros. */
static void check_name(const burnish_mesh *mesh, size_t number, const char *name) {
    const burnish_contents *contents = burnish_mesh_get_contents(mesh);
    char padded[BURNISH_NAME_SIZE] = "";
    strcpy(padded, name);
    CHECK(contents && contents->part_count > number &&
              memcmp(contents->parts[number].name, padded, sizeof padded) == 0,
          "%s", name);
}

static void test_names(void) {
    OWNED_MESH *mesh = load_scene(SCENE("{\"file\": \"t.obj\", \"name\": \"" X61 "y\xC3\xA9\"},"
                                        "{\"file\": \"" X61 "x\xC3\xA9.obj\"},"
                                        "{\"file\": \"two.obj\", \"name\": \"" X61 "\"}"));
    check_name(mesh, 0, X61 "y");
    check_name(mesh, 1, X61 "x");
    check_name(mesh, 2, X61 "/");
}

static void test_places(void) {
    static const double turned[POINTS][3] = {{1, 2, 3},
                                             {1.98480775, 3.17364818, 1.71442478},
                                             {0.0863480148, 3.60574467, 3.76604444},
                                             {-1.22252917, 1.68487862, 1.00975816}};
    static const double moved[POINTS][3] = {{10, 20, 30}, {10, 21, 30}, {8, 20, 30}, {10, 20, 24}};
    OWNED_MESH *mesh = load_scene(
        SCENE("{\"file\": \"t.obj\", \"translate\": [1, 2, 3], \"rotate\": [30, 40, 50],"
              "\"scale\": [2, 1, -1]},"
              "{\"file\": \"./t.obj\", \"matrix\": [0,-1,0,10, 1,0,0,20, 0,0,-2,30, 0,0,0,1]}"));
    check_points("rotated", mesh, POINTS, turned);
    check_points("by a matrix", mesh, POINTS, moved);
    CHECK1(loads == 1);
    /* both mirror, and keep their outsides: 1 x 2 and 1 x 2 */
    const burnish_mesh_facts *facts = mesh ? burnish_mesh_get_facts(mesh) : NULL;
    CHECK1(facts && facts->is_solid && fabs(facts->volume - 4) < 1e-5);
    OWNED_MESH *away = load_scene(SCENE("{\"file\": \"t.obj\", \"translate\": [1e6, 0, 0]}"));
    static const double far_away[POINTS][3] = {
        {1e6, 0, 0}, {1000001, 0, 0}, {1e6, 2, 0}, {1e6, 0, 3}};
    check_points("far away", away, POINTS, far_away);
    CHECK1(away && burnish_mesh_get_view(away)->origin[0] != 0);
    OWNED_MESH *cases = load_scene(SCENE("{\"file\": \"t.obj\"}, {\"file\": \"T.obj\"}"));
    static const double both[POINTS][3] = {{0, 0, 0}, {1, 0, 0}, {5, 2, 0}, {5, 0, 3}};
    check_points("names that differ in case", cases, POINTS, both);
}

/* A normal (1, 1, 1) of a plane stretched by 1, 2, 4 is along (4, 2, 1). */
static void test_normals(void) {
    burnish_load_options options = near_options();
    static const char text[] = SCENE("{\"file\": \"vn.obj\", \"scale\": [1, 2, 4]}");
    options.normals = BURNISH_NORMALS_FILE;
    OWNED_MESH *mesh = load_bytes(text, strlen(text), "a", &options);
    const float *normal = mesh ? burnish_mesh_get_view(mesh)->normals : NULL;
    for (int k = 0; k < 3 && normal; ++k) {
        CHECK(fabs((double)normal[k] - (4 >> k) / sqrt(21)) < 1e-6, "%g", (double)normal[k]);
    }
}

static void test_colors(void) {
    OWNED_MESH *odd = load_scene(SCENE("{\"file\": \"t.obj\", \"colour\": 1, \"x\": [{}]}"));
    CHECK_TEXT(odd ? burnish_mesh_get_warning(odd, 0) : "",
               "a:1: \"colour\" is unknown here and ignored (and 1 more like it)");
    OWNED_MESH *mesh = load_scene(
        "{\"burnish_scene\": 1, \"up\": \"-x\", \"unit\": \"inch\", \"items\": ["
        "{\"file\": \"sub\\\\red.obj\"}, {\"file\": \"sub/red.obj\", \"color\": \"#00FF0080\"},"
        "{\"file\": \"t.obj\", \"color\": \"#00ff0080\"}]}");
    CHECK1(mesh && burnish_mesh_get_material_count(mesh) == 2);
    const burnish_material *red = burnish_mesh_get_material(mesh, 0),
                           *green = burnish_mesh_get_material(mesh, 1);
    CHECK1(red && red->diffuse[0] > 0.1F && red->diffuse[1] == 0);
    CHECK1(green && green->diffuse[1] == 1 && green->diffuse[0] == 0 && green->has_diffuse &&
           fabs((double)green->transparency - 127 / 255.0) < 1e-6);
    CHECK1(mesh && burnish_mesh_get_view(mesh)->up_axis[0] == -1);
    CHECK_TEXT(mesh ? burnish_mesh_get_info(mesh)->unit : "", "inch");
    /* red is left out of the first item, which is white then, but not of the second */
    OWNED_MESH *tinted = load_scene(SCENE("{\"file\": \"tinted.ply\", \"color\": \"#ff0000\"},"
                                          "{\"file\": \"tinted.ply\", \"translate\": [0, 0, 9]}"));
    const burnish_mesh_view *view = burnish_mesh_get_view(tinted);
    CHECK1(view && view->colors && view->vertex_count == 6);
    for (size_t i = 0; view && view->colors && i < view->vertex_count; ++i) {
        CHECK1(view->colors[4 * i + 1] == (view->positions[3 * i + 2] == 0 ? 255 : 0));
    }
}

static void test_clouds(void) {
    OWNED_MESH *both = load_scene(SCENE("{\"file\": \"points.ply\"},"
                                        "{\"file\": \"points.ply\", \"translate\": [0, 0, 9]}"));
    static const double points[POINTS][3] = {{0, 0, 0}, {1, 2, 3}, {0, 0, 9}, {1, 2, 12}};
    CHECK1(both && burnish_mesh_get_info(both)->point_count == 4);
    check_points("clouds", both, POINTS, points);
    OWNED_MESH *up = load_scene(SCENE("{\"file\": \"up.ply\", \"scale\": [1, 1, 2]}"));
    const float *normal = up ? burnish_mesh_get_view(up)->normals : NULL;
    CHECK1(normal && fabsf(normal[1] - 0.832050294f) < 1e-6f &&
           fabsf(normal[2] - 0.554700196f) < 1e-6f);
    OWNED_MESH *dot = load_scene(SCENE("{\"file\": \"points.ply\", \"scale\": 0}"));
    CHECK1(dot && burnish_mesh_get_view(dot)->point_radius > 0);
    OWNED_MESH *mixed = load_scene(SCENE("{\"file\": \"points.ply\"}, {\"file\": \"t.obj\"}"));
    CHECK1(mixed && burnish_mesh_get_view(mixed)->triangle_count == 4);
    CHECK_TEXT(mixed ? burnish_mesh_get_warning(mixed, 0) : "",
               "a: point clouds beside meshes are left out: 1; draw them alone");
    OWNED_MESH *among = load_scene(SCENE("{\"file\": \"splat.ply\", \"scale\": 2},"
                                         "{\"file\": \"t.obj\"}, {\"file\": \"splat.ply\"}"));
    const burnish_mesh_view *splats = burnish_mesh_get_view(burnish_mesh_get_splats(among));
    CHECK1(splats && splats->vertex_count == 2 && splats->positions[2] == 6 &&
           splats->positions[5] == 3 && fabsf(splats->splats[0].axes[0][0] - 2) < 1e-5f);
    CHECK1(burnish_mesh_get_view(among)->triangle_count == 4 &&
           burnish_mesh_get_view(among)->bounds_max[1] >= 4 &&
           burnish_mesh_get_warning_count(among) == 0);
}

/* 5.8 million triangles are too many for 0.8 MB of files, of which two share 0.75 MB. */
static void test_budget(void) {
    enum { FACES = 5800, ITEMS = 1000 };
    static char text[40 * ITEMS];
    char *face = dense + sprintf(dense, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    char *to = text + sprintf(text, "{\"burnish_scene\": 1, \"items\": [{\"file\": \"1.obj\"}");
    memset(long_text, '#', sizeof long_text - 1);
    for (int i = 0; i < FACES; ++i) {
        face += sprintf(face, "f 1 2 3\n");
        to += i >= ITEMS ? 0 : sprintf(to, ",{\"file\": \"%s.obj\"}", i > 0 ? "dense" : "2");
    }
    strcpy(to, "]}");
    const burnish_load_options options = near_options();
    check_refused(text, strlen(text), "a", &options, BURNISH_STATUS_LIMIT,
                  "a: its 818672 bytes become more than 5242880 vertices and triangles; set "
                  "--max-triangles to draw them");
}

static void test_json_errors(void) {
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"{\"burnish_scene\": 2}",
         "a:1: burnish_scene: no scene of version 1; it needs \"burnish_scene\": 1"},
        {"{\"burnish_scene\": 1, \"items\": []}", "a:1: items: no \"items\"; list at least one"},
        {SCENE("{}"), "a:1: items[0]: has no \"file\"; name one"},
        {SCENE("{\"file\": \"no.stl\"}"), "a:1: items[0].file: no.stl: is not there"},
        {SCENE("{\"file\": \"../t.obj\"}"),
         "a:1: items[0].file: it is outside the folder of the file; --root=.. allows it"},
        {SCENE("{\"file\": \"inner.scene.json\"}"),
         "a:1: items[0].file: inner.scene.json: a scene in a scene; list its files instead"},
        {SCENE("{\"file\": \"t.obj\", \"matrix\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,5,5,1]}"),
         "a:1: items[0].matrix: its last row is not 0, 0, 0, 1; give the rows one after another"},
        {SCENE("{\"file\": \"t.obj\", \"matrix\": [1e999,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}"),
         "a:1: items[0].matrix: expected 16 numbers of at most 1e9"},
        {SCENE("{\"file\": \"t.obj\", \"rotate\": [1, 2]}"),
         "a:1: items[0].rotate: expected 3 numbers of at most 1e9"},
        {SCENE("{\"file\": \"t.obj\", \"rotate\": [1e30, 0, 0]}"),
         "a:1: items[0].rotate: expected 3 numbers of at most 1e9"},
        {SCENE("{\"file\": \"t.obj\", \"color\": \"green\"}"),
         "a:1: items[0].color: expected a colour such as \"#ff8800\" or \"#ff880080\""},
        {"{\"burnish_scene\": 1, \"up\": \"W\", \"items\": [{}]}",
         "a:1: up: expected an axis such as \"+Z\""},
        {"{\"burnish_scene\": 1, \"unit\": \"mile\", \"items\": [{}]}",
         "a:1: unit: expected micron, millimeter, centimeter, inch, foot or meter"},
    };
    burnish_load_options options = near_options();
    static const char twice[] = SCENE("{\"file\": \"t.obj\"}, {\"file\": \"far.obj\"}");
    options.max_triangles = 7;
    check_refused(twice, strlen(twice), "a", &options, BURNISH_STATUS_LIMIT,
                  "a: more than 7 triangles; raise the limit or simplify the mesh");
    options = near_options();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_error error = {0};
        burnish_mesh *mesh = NULL;
        CHECK1(burnish_mesh_load_memory(cases[i].text, strlen(cases[i].text), "a", &options, &mesh,
                                        &error) != BURNISH_STATUS_OK);
        CHECK_TEXT(error.text, cases[i].message);
    }
    OWNED_MESH *rest =
        load_scene(SCENE("{\"file\": \"no.stl\"}, {\"file\": \"t.obj\"}, {\"file\": \"x.stl\"}"));
    check_only_warning(
        rest, "a:1: items[0].file: no.stl: is not there; it was left out (and 1 more like it)");
}

static void test_many_warnings(void) {
    enum { FILES = 70, LISTED = 64 };
    char text[FILES * 32 + 64];
    size_t size = (size_t)sprintf(text, "{\"burnish_scene\": 1, \"items\": [");
    for (int i = 0; i < FILES; ++i) {
        size += (size_t)sprintf(text + size, "%s{\"file\": \"odd%d.obj\"}", i > 0 ? "," : "", i);
    }
    strcpy(text + size, "]}");
    OWNED_MESH *mesh = load_scene(text);
    const size_t count = burnish_mesh_get_warning_count(mesh);
    CHECK(count == LISTED + 1, "%zu", count);
    CHECK_TEXT(count > 0 ? burnish_mesh_get_warning(mesh, count - 1) : "",
               "6 more warnings of files are not listed");
}

/* ---- URDF ---- */

#define LINK(name, origin)                                                                         \
    "<link name='" name "'><visual>" origin                                                        \
    "<geometry><mesh filename='t.obj'/></geometry></visual></link>"
#define JOINT(type, more)                                                                          \
    "<joint name='j' type='" type "'><parent link='a'/><child link='b'/>" more "</joint>"
#define ROBOT(contents) "<?xml version='1.0'?><robot name='r'>" contents "</robot>"

static burnish_mesh *load_robot(const char *text, const burnish_joint *joints, size_t count) {
    burnish_load_options options = near_options();
    options.joints = joints;
    options.joint_count = count;
    return load_bytes(text, strlen(text), "a", &options);
}

/* Angles about each axis, of origins and of joints. */
static void test_axes(void) {
    static const struct {
        const char *text;
        double points[POINTS][3];
    } cases[] = {
        {ROBOT(LINK("a", "<origin rpy='.3 0 0'/>")),
         {{0, 0, 0}, {1, 0, 0}, {0, 1.91067298, 0.591040413}, {0, -0.88656062, 2.86600947}}},
        {ROBOT(LINK("a", "<origin rpy='0 -.4 0'/>")),
         {{0, 0, 0}, {0.921060994, 0, 0.389418342}, {0, 2, 0}, {-1.16825503, 0, 2.76318298}}},
        {ROBOT(LINK("a", "<origin rpy='0 0 1.2'/>")),
         {{0, 0, 0}, {0.362357754, 0.932039086, 0}, {-1.86407817, 0.724715509, 0}, {0, 0, 3}}},
        {ROBOT("<link name='a'/>" LINK("b", "") JOINT("revolute", "<axis xyz='1 0 0'/>")),
         {{0, 0, 0}, {1, 0, 0}, {0, 1.52968437, 1.28843537}, {0, -1.93265306, 2.29452656}}},
        {ROBOT("<link name='a'/>" LINK("b", "") JOINT("continuous", "<axis xyz='0 2 0'/>")),
         {{0, 0, 0}, {0.764842187, 0, -0.644217687}, {0, 2, 0}, {1.93265306, 0, 2.29452656}}},
        {ROBOT("<link name='a'/>" LINK("b", "") JOINT("revolute", "<axis xyz='0 0 1'/>")),
         {{0, 0, 0}, {0.764842187, 0.644217687, 0}, {-1.28843537, 1.52968437, 0}, {0, 0, 3}}},
    };
    static const burnish_joint joint = {"j", 0.7};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        OWNED_MESH *mesh = load_robot(cases[i].text, &joint, i >= 3);
        check_points(cases[i].text, mesh, POINTS, cases[i].points);
    }
}

/* A joint with an origin, one that slides and follows it, an origin of the mesh, and its scale,
 * which mirrors. */
static void test_chain(void) {
    static const char text[] = ROBOT(
        "<link name='a'/><link name='b'/><link name='c'><visual name='v'>"
        "<origin xyz='0 .5 0' rpy='.4 -.5 .6'/><geometry><mesh filename='package://pkg/meshes/"
        "t.obj' scale='1 2 -1 1'/></geometry><material name='m'/></visual></link>"
        "<material name='m'><color rgba='0 1 0 1'/></material>"
        "<joint name='k' type='prismatic'><origin xyz='0 0 1'/><parent link='b'/><child link='c'/>"
        "<axis xyz='0 3 4'/><mimic joint='j' multiplier='2' offset='.1'/></joint>" JOINT(
            "revolute", "<origin xyz='1 0 0' rpy='.1 .2 .3'/><axis xyz='1 2 2'/>"));
    static const double points[POINTS][3] = {{1.74493294, 0.998933963, 2.29067803},
                                             {2.18850066, 1.86165225, 2.53350479},
                                             {-0.123971439, 0.964458191, 5.82706148},
                                             {-0.549522787, 2.51576812, 1.0928938}};
    static const burnish_joint joint = {"j", 0.7};
    OWNED_MESH *mesh = load_robot(text, &joint, 1);
    check_points("chain", mesh, POINTS, points);
    const burnish_mesh_facts *facts = mesh ? burnish_mesh_get_facts(mesh) : NULL;
    CHECK1(facts && fabs(facts->volume - 2) < 1e-5);
    const burnish_material *material = burnish_mesh_get_material(mesh, 0);
    CHECK1(material && material->diffuse[1] == 1 && material->diffuse[0] == 0);
    CHECK1(mesh && burnish_mesh_get_view(mesh)->up_axis[2] == 1);
    check_name(mesh, 0, "c");
    OWNED_MESH *named = load_robot(ROBOT(LINK(X61 "x\xC3\xA9", "")), NULL, 0);
    check_name(named, 0, X61 "x");
}

/* Each joint follows the next one; walking from each to the last one would take minutes. */
static void test_followers(void) {
    enum { COUNT = 4094, ROOM = 200 };
    static char text[COUNT * ROOM];
    char *to = text + sprintf(text, "<robot name='r'><link name='r'/>" LINK("0", ""));
    for (int i = 0; i < COUNT; ++i) {
        to += sprintf(to,
                      "<link name='%d'/><joint name='j%d' type='prismatic'><parent link='r'/>"
                      "<child link='%d'/><mimic joint='j%d' offset='.000244140625'/></joint>",
                      i + 1, i, i, i + 1);
    }
    strcpy(to, "</robot>");
    const double x = COUNT / 4096.,
                 moved[POINTS][3] = {{x, 0, 0}, {1 + x, 0, 0}, {x, 2, 0}, {x, 0, 3}};
    OWNED_MESH *mesh = load_robot(text, NULL, 0);
    check_points("followers", mesh, POINTS, moved);
}

/* Volumes of shapes: a cylinder of 48 sides has 24 sin(2 pi / 48) r^2 h. */
static void test_shapes(void) {
    static const struct {
        const char *shape;
        double volume, tolerance;
    } cases[] = {{"<box size='1 2 3'/>", 6, 1e-6},
                 {"<cylinder radius='2' length='3'/>", 12 * 24 * 0.13052619222005159, 1e-4},
                 {"<sphere radius='2'/>", 33.51, 0.4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[300];
        snprintf(text, sizeof text, /* a body of collisions is drawn if nothing is visible */
                 "\n" ROBOT("<link name='a'><%s><geometry>%s</geometry></%s></link>"),
                 i > 0 ? "visual" : "collision", cases[i].shape, i > 0 ? "visual" : "collision");
        OWNED_MESH *mesh = load_robot(text, NULL, 0);
        const burnish_mesh_facts *facts = mesh ? burnish_mesh_get_facts(mesh) : NULL;
        CHECK(facts && facts->is_solid &&
                  fabs(facts->volume - cases[i].volume) < cases[i].tolerance,
              "%s: %.9g", cases[i].shape, facts ? facts->volume : 0);
    }
}

static void test_robot_errors(void) {
    static const struct {
        const char *text, *message;
    } cases[] = {
        {ROBOT(LINK("a", "")), "a: no moving joint is named \"j\"; the robot has none"},
        {ROBOT(LINK("a", "") LINK("b", "") "<joint name='k' type='revolute'><parent link='a'/>"
                                           "<child link='b'/></joint>"),
         "a: no moving joint is named \"j\"; the joints are k"},
        {ROBOT(LINK("a", "") JOINT("fixed", "")),
         "a: line 1: joint \"j\" has no link \"b\"; repair the file"},
        {ROBOT(LINK("a", "") LINK("b", "") JOINT("revolute", "") JOINT("revolute", "")),
         "a: line 1: link \"b\" has two parents; links must be a tree"},
        {ROBOT(LINK("a", "") LINK("b", "")
                   JOINT("revolute", "") "<joint name='k'><parent link='b'/>"
                                         "<child link='a'/></joint>"),
         "a: line 1: its links form a loop; they must be a tree"},
        {ROBOT(LINK("a", "") LINK("b", "") JOINT("revolute", "<mimic joint='i'/>") LINK(
             "c", "") "<joint name='i' type='revolute'><parent link='a'/><child link='c'/>"
                      "<mimic joint='i'/></joint>"),
         "a: line 1: joints that mimic each other; repair the file"},
        {ROBOT("\n<xacro:include filename='b'/>"),
         "a: line 2: a macro of xacro, which burnish does not expand; run \"xacro FILE > "
         "robot.urdf\""},
        {ROBOT("\n" LINK("a", "<origin xyz='1 2'/>")),
         "a: line 2: xyz \"1 2\" is not 3 numbers within 1e6"},
        {ROBOT("<link name='a'>"),
         "a: line 1: the XML is not well formed (mismatched tag); repair the file"},
        {"<!DOCTYPE r><robot name='r'/>", "a: line 1: a document type (DOCTYPE); remove it"},
        {ROBOT("<link name='a'/>"), "a: a robot without anything visible"},
        {ROBOT("<link name='a'><visual><geometry><mesh filename='package://p/x.stl'/></geometry>"
               "</visual></link>"),
         "a: line 1: a mesh is left out: p/x.stl: in no folder from the robot's up to the root; "
         "--root=.. may help"},
    };
    static const burnish_joint joint = {"j", 0.5};
    burnish_load_options options = near_options();
    options.joints = &joint;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_error error = {0};
        burnish_mesh *mesh = NULL;
        options.joint_count = i < 2 || i == 5;
        CHECK(burnish_mesh_load_memory(cases[i].text, strlen(cases[i].text), "a", &options, &mesh,
                                       &error) != BURNISH_STATUS_OK,
              "%s", cases[i].text);
        CHECK_TEXT(error.text, cases[i].message);
    }
    OWNED_MESH *mesh = load_robot(
        ROBOT(LINK("a", "") "<link name='b'><visual><geometry><mesh filename='no.stl'/>"
                            "</geometry></visual><visual><geometry><mesh "
                            "filename='robot.urdf'/></geometry></visual><visual><geometry><mesh "
                            "filename='robot.urdf'/></geometry></visual></link>"),
        NULL, 0);
    CHECK1(mesh && burnish_mesh_get_warning_count(mesh) == 2);
    CHECK(loads == 2, "%d loads", loads); /* a file that fails is not read again */
    CHECK_TEXT(mesh ? burnish_mesh_get_warning(mesh, 0) : "",
               "a: line 1: a mesh is left out: no.stl: is not there");
    CHECK_TEXT(mesh ? burnish_mesh_get_warning(mesh, 1) : "",
               "a: line 1: a mesh is left out: robot.urdf: a robot in a robot; list its files "
               "instead (and 1 more like it)");
}

/* A joint of one robot of a scene, beyond its limit; one of none; limits that mean nothing. */
static void test_joints(void) {
    static const double moved[POINTS][3] = {{0, 0, 9}, {1, 0, 9}, {0, 2, 9}, {0, 0, 12}};
    static const burnish_joint joints[] = {{"j", 90}, {"k", 0}};
    static const char text[] = SCENE("{\"file\": \"arm.urdf\"}, {\"file\": \"robot.urdf\"}");
    OWNED_MESH *mesh = load_robot(text, joints, 1);
    check_points("at its limit", mesh, POINTS, moved);
    CHECK_TEXT(mesh && burnish_mesh_get_warning_count(mesh) ? burnish_mesh_get_warning(mesh, 0)
                                                            : "",
               "arm.urdf: joint \"j\" is at its limit, 9, instead of 90; it moves from -1 to 9");
    burnish_load_options options = near_options();
    burnish_error error = {0};
    burnish_mesh *none = NULL;
    options.joints = joints;
    options.joint_count = 2;
    CHECK1(burnish_mesh_load_memory(text, strlen(text), "a", &options, &none, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "a: no robot of the scene has a moving joint named \"k\"; look up its "
                           "name in their files");
    static const char *const free[] = {
        ROBOT("<link name='a'/>" LINK("b", "")
                  JOINT("continuous", "<limit lower='-1' upper='1'/>")),
        ROBOT("<link name='a'/>" LINK("b", "") JOINT("prismatic", "<limit effort='1'/>"))};
    for (size_t i = 0; i < 2; ++i) {
        OWNED_MESH *one = load_robot(free[i], joints, 1);
        CHECK(one && burnish_mesh_get_warning_count(one) == 0, "%s", free[i]);
    }
}

/* ---- Memory ---- */

static burnish_status make_scene(const void *data, const burnish_load_options *options,
                                 burnish_mesh **mesh, burnish_error *error) {
    burnish_load_options all = *options;
    all.referenced_files.load = load_near;
    return burnish_mesh_load_memory(data, strlen(data), "a", &all, mesh, error);
}

static void test_memory(void) {
    check_failures(make_scene,
                   SCENE("{\"file\": \"sub/red.obj\"}, {\"file\": \"robot.urdf\"},"
                         "{\"file\": \"t.obj\", \"color\": \"#112233\"}"),
                   1, 0);
    check_failures(make_scene, SCENE("{\"file\": \"t.obj\", \"translate\": [1e6, 0, 0]}"), 1, 1);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_join());
    RUN(test_names());
    RUN(test_places());
    RUN(test_normals());
    RUN(test_colors());
    RUN(test_clouds());
    RUN(test_budget());
    RUN(test_json_errors());
    RUN(test_many_warnings());
    if (BURNISH_HAS_3MF) {
        RUN(test_axes());
        RUN(test_chain());
        RUN(test_followers());
        RUN(test_shapes());
        RUN(test_robot_errors());
        RUN(test_joints());
        RUN(test_memory());
    }
    return test_end("scenes");
}
