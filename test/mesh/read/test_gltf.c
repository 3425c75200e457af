/* The reader of glTF 2.0 and GLB, on files put together here: containers, accessors, primitives. */
#include <math.h>

#include "base/bytes.h"
#include "core/srgb.h"
#include "gltf_input.h"

/* ---- Containers ---- */

static void test_containers(void) {
    static const char json[] = "$head$triangle,$node}";
    read_good(json, NULL);
    CHECK1(got.triangle_count == 1 && corner_is(0, 0, 0, 0, 0) && corner_is(0, 1, 1, 0, 0) &&
           corner_is(0, 2, 0, 2, 0));
    CHECK1(got.material_count == 1 && got.streams[BURNISH_NORMAL].count == 0 &&
           !got.triangle_materials);
    check_warning(NULL);

    byte_list binary = {.size = 0};
    put_floats(&binary, 9, gltf_triangle);
    read_good("$head$buffer(36),'bufferViews':[$view(0,36)],'accessors':["
              "$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),$node}",
              &binary);
    CHECK1(got.triangle_count == 1 && corner_is(0, 2, 0, 2, 0));
}

/* ---- Files next to the input ---- */

static const char *asked_for;

static burnish_status load_positions(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error) {
    static byte_list list;
    (void)user_data, (void)max_bytes;
    if (strcmp(name, asked_for) != 0) {
        return burnish_fail(error, BURNISH_STATUS_READ, "%s: asked for", name);
    }
    list.size = 0;
    put_floats(&list, 9, gltf_triangle);
    *bytes = list.bytes;
    *size = list.size;
    return BURNISH_STATUS_OK;
}

static void test_companions(void) {
    static const struct {
        const char *uri, *name, *message; /* message NULL: it is read */
    } cases[] = {
        {"a.bin", "a.bin", NULL},
        {"a%20b/%C3%A9%2ebin", "a b/\xC3\xA9.bin", NULL},
        {"50%.bin", "50%.bin", NULL},
        {"b\\u002ebin", "b.bin", NULL},
        {"other.bin", "a.bin", "mesh.gltf:1: buffers[0].uri: other.bin: asked for"},
        {"../a.bin", "../a.bin",
         "mesh.gltf:1: buffers[0].uri: \"../a.bin\": it is outside the folder of the "
         "file; --root=.. allows it"},
        {"a/%2e%2E/../b", "",
         "mesh.gltf:1: buffers[0].uri: \"a/../../b\": it is outside the folder of the "
         "file; --root=.. allows it"},
        {"/etc/passwd", "",
         "mesh.gltf:1: buffers[0].uri: \"/etc/passwd\" is not a file in the folder of the input; "
         "put "
         "it there"},
        {"http://a/b.bin", "",
         "mesh.gltf:1: buffers[0].uri: \"http://a/b.bin\" is not a file in the folder of the "
         "input; "
         "put it there"},
        {"a%00b", "",
         "mesh.gltf:1: buffers[0].uri: \"\" is not a file in the folder of the input; put it "
         "there"},
    };
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        byte_list list = {.size = 0};
        put_json(&list, "$head'buffers':[{'byteLength':36,'uri':'");
        put_text(&list, cases[i].uri);
        put_json(&list, "'}],'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
                        "$mesh('POSITION':0),$node}");
        asked_for = cases[i].name;
        const burnish_status status =
            run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, load_positions);
        CHECK(status == (cases[i].message ? BURNISH_STATUS_READ : BURNISH_STATUS_OK), "%s: %s",
              cases[i].uri, fault.text);
        CHECK_TEXT(fault.text, cases[i].message ? cases[i].message : "");
    }
}

/* ---- Accessors ---- */

/* Two coordinates of each type in a view with a stride, as positions (KHR_mesh_quantization). */
static void test_component_types(void) {
    static const struct {
        int type;
        size_t size;
        uint64_t bits[2];
        double plain[2], normalized[2];
    } types[] = {
        {5120, 1, {0x80, 0x40}, {-128, 64}, {-1, 64 / 127.0}},
        {5121, 1, {0xFF, 0x33}, {255, 51}, {1, 0.2}},
        {5122, 2, {0x8000, 0x4000}, {-32768, 16384}, {-1, 16384 / 32767.0}},
        {5123, 2, {0xFFFF, 0x3333}, {65535, 13107}, {1, 0.2}},
        {5125, 4, {0xFFFFFFFF, 7}, {4294967295.0, 7}, {4294967295.0, 7}},
        {5126, 4, {0x3F000000, 0xC0000000}, {0.5, -2}, {0.5, -2}},
    };
    for (size_t i = 0; i < 2 * sizeof types / sizeof *types; ++i) {
        const size_t t = i / 2, size = types[t].size, stride = 4 + 4 * size;
        const double *expected = i % 2 ? types[t].normalized : types[t].plain;
        byte_list binary = {.size = 0};
        char json[1024];
        put_bits(&binary, 0xEEEEEEEE, 4, 0);
        for (int vertex = 0; vertex < 3; ++vertex) { /* (a, 0, 0), (0, b, 0), (0, 0, a) */
            for (int k = 0; k < 3; ++k) {
                put_bits(&binary, k == vertex ? types[t].bits[k & 1] : 0, size, 0);
            }
            if (vertex < 2) {
                put_bits(&binary, 0xEEEEEEEEEEEEEEEE, stride - 3 * size, 0);
            }
        }
        snprintf(json, sizeof json,
                 "$head$buffer(%zu),'bufferViews':[{'buffer':0,'byteOffset':4,"
                 "'byteLength':%zu,'byteStride':%zu}],'accessors':[{'bufferView':0,"
                 "'componentType':%d,'count':3,'type':'VEC3','normalized':%s}],"
                 "$mesh('POSITION':0),$node}",
                 binary.size, binary.size - 4, stride, types[t].type, i % 2 ? "true" : "false");
        read_good(json, &binary);
        for (int vertex = 0; vertex < 3; ++vertex) {
            for (int k = 0; k < 3; ++k) {
                const float value = burnish_positions(&got)[3 * vertex + k];
                CHECK(value == (float)(k == vertex ? expected[k & 1] : 0), "%d %d: %g",
                      types[t].type, vertex, (double)value);
            }
        }
    }
}

/* Positions 0 and 2 of a view are overwritten; then without a view, where the rest is 0. */
static void test_sparse(void) {
    static const float positions[9] = {9, 9, 9, 1, 0, 0, 9, 9, 9};
    static const float values[6] = {5, 0, 0, 0, 2, 3};
    static const int types[3] = {5121, 5123, 5125};
    for (int i = 0; i < 6; ++i) {
        const size_t size = (size_t)1 << i / 2;
        byte_list binary = {.size = 0};
        char json[1024];
        put_floats(&binary, 9, positions);
        put_floats(&binary, 6, values);
        put_bits(&binary, 0, size, 0);
        put_bits(&binary, 2, size, 0);
        snprintf(json, sizeof json,
                 "$head$buffer(%zu),'bufferViews':[$view(0,36),$view(36,24),$view(60,%zu)],"
                 "'accessors':[{%s'componentType':5126,'count':3,'type':'VEC3',"
                 "'sparse':{'count':2,'indices':{'bufferView':2,'componentType':%d},"
                 "'values':{'bufferView':1}}}],$mesh('POSITION':0),$node}",
                 binary.size, 2 * size, i % 2 ? "" : "'bufferView':0,", types[i / 2]);
        read_good(json, &binary);
        CHECK1(corner_is(0, 0, 5, 0, 0) && corner_is(0, 1, i % 2 ? 0 : 1, 0, 0) &&
               corner_is(0, 2, 0, 2, 3));
    }
}

/* Colours are linear in glTF and sRGB in the mesh; normals and coordinates come along. */
static void test_attributes(void) {
    static const float normals[9] = {0, 0, 2, 0, 3, 4, 0, 0, 0};
    static const float uv[6] = {0, 0, 0.25f, 0.75f, 1, 2};
    static const float colors[9] = {0, 0.5f, 1, 0.25f, -1, 2, 1, 1, 1};
    byte_list binary = {.size = 0};
    put_floats(&binary, 9, gltf_triangle);
    put_floats(&binary, 9, normals);
    put_floats(&binary, 6, uv);
    put_floats(&binary, 9, colors);
    read_good("$head$buffer(132),'bufferViews':[$view(0,36),$view(36,36),$view(72,24),"
              "$view(96,36)],'accessors':[$accessor(0,5126,3,VEC3),"
              "$accessor(1,5126,3,VEC3),$accessor(2,5126,3,VEC2),"
              "$accessor(3,5126,3,VEC3)],'meshes':[{'primitives':[{'attributes':{'POSITION'"
              ":0,'NORMAL':1,'TEXCOORD_0':2,'COLOR_0':3}},"
              "{'attributes':{'POSITION':0}}]}],$node}",
              &binary);
    CHECK1(got.triangle_count == 2 && got.streams[BURNISH_NORMAL].count == 6 &&
           got.streams[BURNISH_COLOR].count == 6 && got.streams[BURNISH_TEXCOORD].count == 6);
    const float *n = burnish_normals(&got), *t = got.streams[BURNISH_TEXCOORD].items;
    const uint8_t *c = burnish_colors(&got);
    CHECK1(n[2] == 1 && n[4] == 0.6f && n[5] == 0.8f && n[6] == 0 && n[8] == 0);
    CHECK1(t[0] == 0 && t[1] == 1 && t[2] == 0.25f && t[3] == 0.25f && t[4] == 1 && t[5] == -1);
    CHECK1(c[0] == 0 && c[1] == burnish_linear_to_srgb(0.5f) && c[2] == 255 && c[3] == 255 &&
           c[4] == burnish_linear_to_srgb(0.25f) && c[5] == 0 && c[6] == 255);
    for (size_t i = 12; i < 24; ++i) { /* the second primitive lacks the attribute */
        CHECK1(c[i] == 255 && n[i / 4 * 3] == 0);
    }
}

/* ---- Primitives ---- */

/* Section 3.7.2.1: strips turn every other triangle, fans share the first vertex. */
static void test_modes(void) {
    static const struct {
        int mode;
        size_t count; /* corners */
        size_t triangles;
        uint32_t corners[9];
    } modes[] = {{4, 6, 2, {0, 1, 2, 3, 4, 5}},
                 {4, 7, 2, {0, 1, 2, 3, 4, 5}},
                 {5, 5, 3, {0, 1, 2, 1, 3, 2, 2, 3, 4}},
                 {6, 5, 3, {1, 2, 0, 2, 3, 0, 3, 4, 0}}};
    for (size_t i = 0; i < 4 * sizeof modes / sizeof *modes; ++i) {
        const size_t m = i / 4, index_size = i % 4 == 0 ? 0 : (size_t)1 << (i % 4 - 1);
        static const int types[4] = {0, 5121, 5123, 5125};
        byte_list binary = {.size = 0};
        char json[1024], indices[256] = "";
        for (size_t k = 0; k < 7; ++k) {
            const float position[3] = {(float)k, (float)(k * k), 0};
            put_floats(&binary, 3, position);
        }
        for (size_t k = 0; k < modes[m].count; ++k) { /* backwards: vertex 6 - k */
            put_bits(&binary, 6 - k, index_size, 0);
        }
        if (index_size > 0) {
            snprintf(indices, sizeof indices, ",$accessor(1,%d,%zu,SCALAR)", types[i % 4],
                     modes[m].count);
        }
        snprintf(json, sizeof json,
                 "$head$buffer(%zu),'bufferViews':[$view(0,84),$view(84,%zu)],"
                 "'accessors':[$accessor(0,5126,%zu,VEC3)%s],"
                 "'meshes':[{'primitives':[{'mode':%d,%s'attributes':{'POSITION':0}}]}],$node}",
                 binary.size, binary.size - 84, index_size > 0 ? (size_t)7 : modes[m].count,
                 indices, modes[m].mode, index_size > 0 ? "'indices':1," : "");
        read_good(json, &binary);
        CHECK1(got.triangle_count == modes[m].triangles);
        for (size_t k = 0; k < 3 * got.triangle_count; ++k) {
            const uint32_t vertex = index_size > 0 ? 6 - modes[m].corners[k] : modes[m].corners[k];
            CHECK(corner_is(k / 3, (int)(k % 3), vertex, vertex * vertex, 0), "mode %d, corner %zu",
                  modes[m].mode, k);
        }
        CHECK1(got.warning_count == (modes[m].count == 7));
        if (got.warning_count > 0) {
            CHECK1(
                strstr(got.warnings[0], "7 corners do not make whole triangles; the last 1 are "));
        }
    }
}

/* Only used vertices are read, each once. */
static void test_shared_vertices(void) {
    byte_list binary = {.size = 0};
    for (int i = 0; i < 100; ++i) {
        const float position[3] = {(float)i, (float)(i * i), 0};
        put_floats(&binary, 3, position);
    }
    put_text(&binary, "\7\11\13\13\11\7\1\2\3");
    read_good("$head$buffer(1209),'bufferViews':[$view(0,1200),$view(1200,9)],"
              "'accessors':[$accessor(0,5126,100,VEC3),$accessor(1,5121,6,SCALAR),"
              "{'bufferView':1,'byteOffset':6,'componentType':5121,'count':3,"
              "'type':'SCALAR'}],'meshes':[{'primitives':[{'attributes':{'POSITION':0},"
              "'indices':1},{'attributes':{'POSITION':0},'indices':2}]}],"
              "'nodes':[{'mesh':0},{'mesh':0,'translation':[0,0,1]}]}",
              &binary);
    CHECK(got.triangle_count == 6 && got.streams[BURNISH_POSITION].count == 12, "%zu, %zu",
          got.triangle_count, got.streams[BURNISH_POSITION].count);
    CHECK1(corner_is(1, 0, 11, 121, 0) && corner_is(2, 2, 3, 9, 0) && corner_is(5, 2, 3, 9, 1));
}

/* ---- Points and lines ---- */

/* Whether the rod of line i joins two of the triangle's positions. */
static int joins(const burnish_mesh_data *s, size_t i, size_t from, size_t to) {
    static const double positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    const size_t ends[2] = {from, to};
    for (size_t end = 0; end < 2; ++end) {
        for (size_t k = 0; k < 3; ++k) { /* of its six rings, the third and fourth */
            const float *ring = burnish_positions(s) + 3 * (48 * i + 16 + 8 * end);
            if (fabs(((double)ring[k] + (double)ring[12 + k]) / 2 - positions[ends[end]][k]) >
                1e-6) {
                return 0;
            }
        }
    }
    return 1;
}

static void test_lines(void) {
    static const struct {
        int mode;
        const char *more;
        size_t count, from[3], to[3];
    } cases[] = {{1, "", 1, {0}, {1}}, /* the third position is ignored */
                 {2, "", 3, {0, 1, 2}, {1, 2, 0}},
                 {3, "", 2, {0, 1}, {1, 2}},
                 {3, ",'material':0", 2, {0, 1}, {1, 2}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[1000];
        snprintf(text, sizeof text,
                 "$head$triangle_accessors,'materials':[{'pbrMetallicRoughness':{'baseColorFac"
                 "tor':[1,0,1,1]}}],'meshes':[{'primitives':[{'mode':%d,"
                 "'attributes':{'POSITION':0}%s},{'mode':0,'attributes':{'POSITION':0}}]}],"
                 "$node}",
                 cases[i].mode, cases[i].more);
        read_good(text, NULL);
        CHECK1(got.line_count == cases[i].count && got.point_count == 0 && got.material_count == 1);
        CHECK1(got.triangle_count == 64 * cases[i].count);
        for (size_t k = 0; k < cases[i].count && k < got.line_count; ++k) {
            CHECK1(joins(&got, k, cases[i].from[k], cases[i].to[k]));
        }
        const uint8_t *colors = burnish_colors(&got);
        CHECK1(!colors == !*cases[i].more);
        CHECK1(!colors || (colors[0] == 255 && colors[1] == 0 && colors[2] == 255));
        if (CHECK1(got.warning_count == (i == 0 ? 2 : 1))) {
            CHECK_TEXT(got.warnings[got.warning_count - 1],
                       i == 0 ? "mesh.gltf:1: meshes[0].primitives[0]: 3 corners do not make whole "
                                "lines; the last 1 are ignored"
                              : "mesh.gltf:1: meshes[0].primitives[1]: points are not drawn in a "
                                "file with lines");
        }
    }
}

/* Indices choose the points; the node moves them. */
static void test_points(void) {
    read_good("$head'buffers':[$triangle_buffer,{'byteLength':2,'uri':'data:;base64,"
              "AgE='}],'bufferViews':[$view(0,36),{'buffer':1,'byteLength':2}],"
              "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5121,2,SCALAR)],"
              "'meshes':[{'primitives':[{'mode':0,'indices':1,"
              "'attributes':{'POSITION':0}}]}],'nodes':[{'mesh':0,'translation':[5,0,0]}]}",
              NULL);
    if (CHECK1(got.point_count == 2 && got.warning_count == 0)) {
        const size_t vertices = got.streams[BURNISH_POSITION].count / 2;
        for (size_t point = 0; point < 2; ++point) {
            double sum[3] = {0, 0, 0};
            for (size_t i = 0; i < 3 * vertices; ++i) {
                sum[i % 3] +=
                    (double)burnish_positions(&got)[3 * vertices * point + i] / (double)vertices;
            }
            CHECK1(fabs(sum[0] - (point == 0 ? 5 : 6)) < 1e-5 &&
                   fabs(sum[1] - (point == 0 ? 2 : 0)) < 1e-5 && fabs(sum[2]) < 1e-5);
        }
    }
}

/* How far vertices of a solid are from the middle of its ends, at most and at least. */
static int is_around(size_t solid, size_t vertices, double x, double y, double radius) {
    int is = 1;
    const size_t base = 3 + vertices * solid;
    double middle[3] = {0, 0, 0};
    for (size_t i = 0; i < 3 * vertices; ++i) {
        const double value = (double)burnish_positions(&got)[3 * base + i];
        middle[i % 3] += value / (double)vertices;
        is &= i % 3 != 2 || fabs(value) <= radius * 1.0001;
    }
    return is && fabs(middle[0] - x) < 1e-5 && fabs(middle[1] - y) < 1e-5;
}

/* Lines and points beside a triangle with the corners (0, 0), (1, 0), (0, 2): solids in the lines'
 * colours without light, which the bounds leave out. */
static void test_beside(void) {
    read_good("$head$triangle_accessors,'materials':[{},{'pbrMetallicRoughness':{'baseColorFactor'"
              ":[0,0,1,1]}}],'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0},"
              "{'mode':3,'attributes':{'POSITION':0},'material':1},"
              "{'mode':0,'attributes':{'POSITION':0}}]}],$node}",
              NULL);
    CHECK1(got.warning_count == 0 && got.triangle_count == 1 + 5 * 8 && got.line_count == 2);
    CHECK1(got.beside_count == 5 * 8 && got.streams[BURNISH_POSITION].count == 3 + 5 * 6);
    const double radius = sqrt(5) / 800; /* of lines */
    for (size_t i = 0; i < 5; ++i) {
        static const double middles[5][2] = {{0, 0}, {1, 0}, {0, 2}, {0.5, 0}, {0.5, 1}};
        CHECK1(is_around(i, 6, middles[i][0], middles[i][1], i < 3 ? 3 * radius : radius));
        const uint8_t *color = burnish_colors(&got) + 4 * (3 + 6 * i);
        CHECK1(color[0] == (i < 3 ? 255 : 0) && color[2] == 255);
        CHECK1(got.triangle_materials[1 + 8 * i] == 3);
    }
    CHECK1(got.triangle_materials[0] == 0 && got.material_count == 4 && got.materials[3].is_unlit &&
           got.materials[3].diffuse[1] == 1 && burnish_colors(&got)[0] == 255);
    CHECK1(got.points_min[0] == 0 && got.points_min[2] == 0 && got.points_max[1] == 2);
}

/* ---- Threads ---- */

enum { MANY = 20000 };

/* Positions, normals, texture coordinates and indices of MANY vertices. */
static uint8_t many[MANY * (32 + 4)];

static burnish_status load_many(void *user_data, const char *name, uint64_t max_bytes,
                                const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data, (void)name, (void)max_bytes, (void)error;
    *bytes = many;
    *size = sizeof many;
    return BURNISH_STATUS_OK;
}

static burnish_status read_many(int threads, burnish_mesh_data *s, burnish_error *e) {
    const burnish_load_options options = burnish_load_options_default();
    static byte_list list;
    char json[1024];
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, threads);
    snprintf(json, sizeof json,
             "$head'buffers':[{'byteLength':%d,'uri':'many'}],'bufferViews':[{'buffer':0,"
             "'byteLength':%d,'byteStride':32},$view(%d,%d)],'accessors':["
             "$accessor(0,5126,%d,VEC3),$part(12,5126,%d,VEC3),$part(24,5126,%d,VEC2),"
             "$accessor(1,5125,%d,SCALAR)],'meshes':[{'primitives':[{'attributes':{'POSITI"
             "ON':0,'NORMAL':1,'TEXCOORD_0':2},'indices':3,'mode':5}]}],"
             "'nodes':[{'mesh':0,'scale':[1,2,-1]}]}",
             36 * MANY, 32 * MANY, 32 * MANY, 4 * MANY, MANY, MANY, MANY, MANY);
    list.size = 0;
    put_json(&list, json);
    return read_as(&(reader_run){BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, load_many,
                                 threads > 1 ? &tasks : NULL, 0},
                   s, e);
}

/* Several threads convert vertices. The first fault of the file is reported, whichever thread finds
 * it, and the triangles that have one are left out. */
static void test_threads(void) {
    static const int threads[] = {2, 7};
    static const struct {
        uint32_t bad[2], index; /* positions, and the position of an index; 0: none */
        const char *message;
        size_t lost; /* triangles of the strip */
    } cases[] = {
        {{0, 0}, 0, "", 0}, /* and each adds its own to those before */
        {{19990, 0}, 0, "accessors[0]: position 19990 is not finite", 3},
        {{0, 0}, 15000, "accessors[3]: index 20000 is not below the 20000 positions", 6},
        {{14000, 6000}, 0, "accessors[3]: index 20000 is not below the 20000 positions", 12},
        {{5999, 0}, 0, "accessors[3]: index 20000 is not below the 20000 positions", 13},
    };
    uint64_t random = test_seed(1);
    for (size_t i = 0; i < MANY; ++i) {
        for (size_t k = 0; k < 8; ++k) {
            const float value = (float)(test_random64(&random) >> 40) / 1e6f;
            uint32_t bits;
            memcpy(&bits, &value, sizeof bits);
            burnish_store32(many + 32 * i + 4 * k, bits);
        }
        burnish_store32(many + 32 * MANY + 4 * i, (uint32_t)i);
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh_data alone, shared;
        burnish_error error, other;
        for (size_t k = 0; k < 2 && cases[i].bad[k] > 0; ++k) {
            burnish_store32(many + 32 * (size_t)cases[i].bad[k] + 4, 0x7fc00000); /* not a number */
        }
        if (cases[i].index > 0) {
            burnish_store32(many + 32 * MANY + 4 * (size_t)cases[i].index, MANY);
        }
        const burnish_status status = read_many(1, &alone, &error);
        CHECK_OK(status, error);
        CHECK(alone.triangle_count == MANY - 2 - cases[i].lost, "case %zu: %zu", i,
              alone.triangle_count);
        CHECK(alone.warning_count == (cases[i].lost > 0) &&
                  (cases[i].lost == 0 || strstr(alone.warnings[0], cases[i].message)),
              "case %zu: %s", i, cases[i].lost > 0 ? alone.warnings[0] : "");
        for (size_t t = 0; t < sizeof threads / sizeof *threads; ++t) {
            CHECK(read_many(threads[t], &shared, &other) == status &&
                      shared.warning_count == alone.warning_count &&
                      (cases[i].lost == 0 || strcmp(shared.warnings[0], alone.warnings[0]) == 0),
                  "case %zu: %s", i, other.text);
            compare_meshes("many", &alone, &shared);
            burnish_mesh_data_destroy(&shared);
        }
        burnish_mesh_data_destroy(&alone);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_containers());
    RUN(test_companions());
    RUN(test_component_types());
    RUN(test_sparse());
    RUN(test_attributes());
    RUN(test_modes());
    RUN(test_shared_vertices());
    RUN(test_threads());
    RUN(test_lines());
    RUN(test_points());
    RUN(test_beside());
    return test_end("gltf");
}
