/* The reader of glTF 2.0 and GLB, on files put together here. */
#include <math.h>

#include "core/srgb.h"
#include "gltf_input.h"

static const uint32_t *corners_of(const burnish_mesh_data *s) {
    return s->streams[BURNISH_POSITION].corners;
}

/* Whether corner k of triangle i lies at x, y, z. */
static int corner_is(const burnish_mesh_data *s, size_t i, int k, double x, double y, double z) {
    if (i >= s->triangle_count) {
        return 0;
    }
    const float *p = burnish_positions(s) + 3 * (size_t)corners_of(s)[3 * i + (size_t)k];
    return fabs((double)p[0] - x) < 1e-6 && fabs((double)p[1] - y) < 1e-6 &&
           fabs((double)p[2] - z) < 1e-6;
}

static void check_warning(const burnish_mesh_data *s, size_t count, const char *text) {
    CHECK(s->warning_count == count, "%zu warnings: %s", s->warning_count,
          s->warning_count > 0 ? s->warnings[0] : "");
    if (count > 0 && s->warning_count == count) {
        CHECK_TEXT(s->warnings[0], text);
    }
}

static void read_good(const char *json, const byte_list *binary, burnish_mesh_data *s) {
    burnish_error e;
    const burnish_status status = binary ? read_glb(json, binary, s, &e) : read_gltf(json, s, &e);
    CHECK(status == BURNISH_STATUS_OK, "%s: %s", json, e.text);
}

/* ---- Containers ---- */

static void test_containers(void) {
    static const char json[] = "$head$triangle,$node}";
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
    burnish_mesh_data s;
    read_good(json, NULL, &s);
    CHECK1(s.triangle_count == 1 && corner_is(&s, 0, 0, 0, 0, 0) && corner_is(&s, 0, 1, 1, 0, 0) &&
           corner_is(&s, 0, 2, 0, 2, 0));
    CHECK1(s.material_count == 1 && s.streams[BURNISH_NORMAL].count == 0 && !s.triangle_materials);
    check_warning(&s, 0, "");
    burnish_mesh_data_destroy(&s);

    byte_list binary = {.size = 0};
    put_floats(&binary, 9, positions);
    read_good("$head$buffer(36),'bufferViews':[$view(0,36)],'accessors':["
              "$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),$node}",
              &binary, &s);
    CHECK1(s.triangle_count == 1 && corner_is(&s, 0, 2, 0, 2, 0));
    burnish_mesh_data_destroy(&s);
}

static void test_guess(void) {
    static const struct {
        const char *text, *name;
        burnish_format format;
    } cases[] = {{"glTF\2\0\0\0\0\0\0\0\0\0", "a.obj", BURNISH_FORMAT_GLTF},
                 {"\n{ \"asset\": {", NULL, BURNISH_FORMAT_GLTF},
                 {"{ }", NULL, BURNISH_FORMAT_GLTF},
                 {"{ }", "a.ply", BURNISH_FORMAT_PLY},
                 {"v 0 0 0\n", "a.glb", BURNISH_FORMAT_OBJ},
                 {"\1", "a.glb", BURNISH_FORMAT_GLTF}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const size_t size = i == 0 ? 14 : strlen(cases[i].text);
        CHECK(burnish_guess_format((const uint8_t *)cases[i].text, size, cases[i].name) ==
                  cases[i].format,
              "%zu", i);
    }
}

/* ---- Files beside the input ---- */

static const char *asked_for;

static burnish_status load_positions(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
    static byte_list list;
    (void)user_data, (void)max_bytes;
    if (strcmp(name, asked_for) != 0) {
        return burnish_fail(error, BURNISH_STATUS_READ, "%s: asked for", name);
    }
    list.size = 0;
    put_floats(&list, 9, positions);
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
         "mesh.gltf:1: buffers[0].uri: \"../a.bin\" is no file in the folder of the input; put it "
         "there"},
        {"a/%2e%2E/../b", "",
         "mesh.gltf:1: buffers[0].uri: \"a/../../b\" is no file in the folder of the input; put it "
         "there"},
        {"/etc/passwd", "",
         "mesh.gltf:1: buffers[0].uri: \"/etc/passwd\" is no file in the folder of the input; put "
         "it there"},
        {"http://a/b.bin", "",
         "mesh.gltf:1: buffers[0].uri: \"http://a/b.bin\" is no file in the folder of the input; "
         "put it there"},
        {"a%00b", "",
         "mesh.gltf:1: buffers[0].uri: \"\" is no file in the folder of the input; put it there"},
    };
    const burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        byte_list list = {.size = 0};
        burnish_mesh_data s;
        burnish_error e;
        put_json(&list, "$head'buffers':[{'byteLength':36,'uri':'");
        put_text(&list, cases[i].uri);
        put_json(&list, "'}],'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
                        "$mesh('POSITION':0),$node}");
        asked_for = cases[i].name;
        const burnish_status status = run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size,
                                                 &options, load_positions, &s, &e);
        CHECK(status == (cases[i].message ? BURNISH_STATUS_READ : BURNISH_STATUS_OK), "%s: %s",
              cases[i].uri, e.text);
        CHECK_TEXT(e.text, cases[i].message ? cases[i].message : "");
        burnish_mesh_data_destroy(&s);
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
        burnish_mesh_data s;
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
        read_good(json, &binary, &s);
        for (int vertex = 0; vertex < 3; ++vertex) {
            for (int k = 0; k < 3; ++k) {
                const float value = burnish_positions(&s)[3 * vertex + k];
                CHECK(value == (float)(k == vertex ? expected[k & 1] : 0), "%d %d: %g",
                      types[t].type, vertex, (double)value);
            }
        }
        burnish_mesh_data_destroy(&s);
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
        burnish_mesh_data s;
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
        read_good(json, &binary, &s);
        CHECK1(corner_is(&s, 0, 0, 5, 0, 0) && corner_is(&s, 0, 1, i % 2 ? 0 : 1, 0, 0) &&
               corner_is(&s, 0, 2, 0, 2, 3));
        burnish_mesh_data_destroy(&s);
    }
}

/* Colours are linear in glTF and sRGB in the mesh; normals and coordinates come along. */
static void test_attributes(void) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
    static const float normals[9] = {0, 0, 2, 0, 3, 4, 0, 0, 0};
    static const float uv[6] = {0, 0, 0.25f, 0.75f, 1, 2};
    static const float colors[9] = {0, 0.5f, 1, 0.25f, -1, 2, 1, 1, 1};
    byte_list binary = {.size = 0};
    burnish_mesh_data s;
    put_floats(&binary, 9, positions);
    put_floats(&binary, 9, normals);
    put_floats(&binary, 6, uv);
    put_floats(&binary, 9, colors);
    read_good("$head$buffer(132),'bufferViews':[$view(0,36),$view(36,36),$view(72,24),"
              "$view(96,36)],'accessors':[$accessor(0,5126,3,VEC3),"
              "$accessor(1,5126,3,VEC3),$accessor(2,5126,3,VEC2),"
              "$accessor(3,5126,3,VEC3)],'meshes':[{'primitives':[{'attributes':{'POSITION'"
              ":0,'NORMAL':1,'TEXCOORD_0':2,'COLOR_0':3}},"
              "{'attributes':{'POSITION':0}}]}],$node}",
              &binary, &s);
    CHECK1(s.triangle_count == 2 && s.streams[BURNISH_NORMAL].count == 6 &&
           s.streams[BURNISH_COLOR].count == 6 && s.streams[BURNISH_TEXCOORD].count == 6);
    const float *n = burnish_normals(&s), *t = s.streams[BURNISH_TEXCOORD].items;
    const uint8_t *c = burnish_colors(&s);
    CHECK1(n[2] == 1 && n[4] == 0.6f && n[5] == 0.8f && n[6] == 0 && n[8] == 0);
    CHECK1(t[0] == 0 && t[1] == 1 && t[2] == 0.25f && t[3] == 0.25f && t[4] == 1 && t[5] == -1);
    CHECK1(c[0] == 0 && c[1] == burnish_linear_to_srgb(0.5f) && c[2] == 255 && c[3] == 255 &&
           c[4] == burnish_linear_to_srgb(0.25f) && c[5] == 0 && c[6] == 255);
    for (size_t i = 12; i < 24; ++i) { /* of the second primitive, which has none */
        CHECK1(c[i] == 255 && n[i / 4 * 3] == 0);
    }
    burnish_mesh_data_destroy(&s);
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
        burnish_mesh_data s;
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
        read_good(json, &binary, &s);
        CHECK1(s.triangle_count == modes[m].triangles);
        for (size_t k = 0; k < 3 * s.triangle_count; ++k) {
            const uint32_t vertex = index_size > 0 ? 6 - modes[m].corners[k] : modes[m].corners[k];
            CHECK(corner_is(&s, k / 3, (int)(k % 3), vertex, vertex * vertex, 0),
                  "mode %d, corner %zu", modes[m].mode, k);
        }
        CHECK1(s.warning_count == (modes[m].count == 7));
        if (s.warning_count > 0) {
            CHECK1(strstr(s.warnings[0], "7 corners make no whole triangles; the last 1 are "));
        }
        burnish_mesh_data_destroy(&s);
    }
}

/* Only vertices that are used are taken, and each once. */
static void test_shared_vertices(void) {
    byte_list binary = {.size = 0};
    burnish_mesh_data s;
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
              &binary, &s);
    CHECK(s.triangle_count == 6 && s.streams[BURNISH_POSITION].count == 12, "%zu, %zu",
          s.triangle_count, s.streams[BURNISH_POSITION].count);
    CHECK1(corner_is(&s, 1, 0, 11, 121, 0) && corner_is(&s, 2, 2, 3, 9, 0) &&
           corner_is(&s, 5, 2, 3, 9, 1));
    burnish_mesh_data_destroy(&s);
}

/* ---- Nodes ---- */

/* A chain of a matrix, a turn about z, and a mirror, against the same by hand. */
static void test_hierarchy(void) {
    burnish_mesh_data s;
    /* p -> 2 p + (10, 20, 30); a quarter turn: (x, y) -> (-y, x); then x mirrored, y times 3. */
    read_good("$head$triangle,'scene':1,'scenes':[{'nodes':[3]},{'nodes':[2]}],"
              "'nodes':[{'mesh':0,'scale':[-1,3,1]},{'children':[0],'rotation':[0,0,"
              "0.70710678118654757,0.70710678118654757]},{'children':[1],'matrix':[2,0,0,"
              "0, 0,2,0,0, 0,0,2,0, 10,20,30,1]},{'mesh':0}]}",
              NULL, &s);
    /* The mirror turns the winding: corners 0, 2, 1. */
    CHECK1(s.triangle_count == 1 && corner_is(&s, 0, 0, 10, 20, 30) &&
           corner_is(&s, 0, 2, 10, 18, 30) && corner_is(&s, 0, 1, -2, 20, 30));
    burnish_mesh_data_destroy(&s);
    /* Without scenes all roots are drawn, but for what is hidden. */
    read_good("$head$triangle,'extensionsUsed':['KHR_node_visibility'],"
              "'nodes':[{'mesh':0},{'children':[2],'extensions':{'KHR_node_visibility':{'vi"
              "sible':false}}},{'mesh':0},{'mesh':0,'translation':[5,0,0]}]}",
              NULL, &s);
    CHECK1(s.triangle_count == 2 && corner_is(&s, 1, 0, 5, 0, 0));
    check_warning(&s, 0, "");
    burnish_mesh_data_destroy(&s);
    /* A scene that is not there is none. */
    read_good("$head$triangle,'scene':3,'nodes':[{'mesh':0}]}", NULL, &s);
    CHECK1(s.triangle_count == 1);
    check_warning(&s, 1, "mesh.gltf:1: scene: 3 is not in scenes, of which there are 0; ignored");
    burnish_mesh_data_destroy(&s);
}

/* Normals keep at right angles to a surface that is stretched, and on its side in a mirror. */
static void test_normals_of_nodes(void) {
    static const float positions[9] = {0, 0, 0, 1, 1, 0, 0, 0, 1};
    static const float normals[9] = {1, -1, 0, 1, -1, 0, 1, -1, 0};
    for (int mirror = 0; mirror < 2; ++mirror) {
        byte_list binary = {.size = 0};
        burnish_mesh_data s;
        char json[1024];
        put_floats(&binary, 9, positions);
        put_floats(&binary, 9, normals);
        snprintf(json, sizeof json,
                 "$head$buffer(72),'bufferViews':[$view(0,36),$view(36,36)],"
                 "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5126,3,VEC3)],"
                 "$mesh('POSITION':0,'NORMAL':1),'nodes':[{'mesh':0,'scale':[%d,1,1]}]}",
                 mirror ? -4 : 4);
        read_good(json, &binary, &s);
        /* (1/4, -1, 0), the 1/4 mirrored, made a unit vector */
        const double x = (mirror ? -0.25 : 0.25) / sqrt(0.0625 + 1), y = -1 / sqrt(0.0625 + 1);
        for (size_t i = 0; i < 3; ++i) {
            const float *n = burnish_normals(&s) + 3 * i;
            CHECK(fabs((double)n[0] - x) < 1e-7 && fabs((double)n[1] - y) < 1e-7 && n[2] == 0,
                  "%g %g %g", (double)n[0], (double)n[1], (double)n[2]);
        }
        burnish_mesh_data_destroy(&s);
    }
}

/* ---- Materials ---- */

static void test_materials(void) {
    burnish_mesh_data s;
    read_good("$head$triangle_accessors,'materials':[{'pbrMetallicRoughness':{'baseColorFac"
              "tor':[0.5,0.25,1,0.5],'metallicFactor':0,'roughnessFactor':0.5}},"
              "{'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,0.5],"
              "'roughnessFactor':1},'alphaMode':'BLEND'},"
              "{'extensions':{'KHR_materials_pbrSpecularGlossiness':{'diffuseFactor':[1,"
              "0.5,0,1],'specularFactor':[0.1,0.1,0.1],'glossinessFactor':0.5}}},"
              "{'pbrMetallicRoughness':{'metallicFactor':'x'},"
              "'extensions':{'KHR_materials_unlit':{}}}],"
              "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0},"
              "{'attributes':{'POSITION':0},'material':1},{'attributes':{'POSITION':0}},"
              "{'attributes':{'POSITION':0},'material':3}]}],$node}",
              NULL, &s);
    CHECK1(s.material_count == 5 && s.triangle_count == 4 && s.triangle_materials[1] == 1 &&
           s.triangle_materials[2] == 4 && s.triangle_materials[3] == 3);
    const burnish_material *m = s.materials;
    /* alpha 1/4: n = 2 * 16 - 2 = 30, and a height of 0.04 * 32 / 8 */
    CHECK1(m->exponent == 30 && m->diffuse[0] == 0.5f && m->diffuse[2] == 1 &&
           m->ambient[1] == 0.25f && m->transparency == 0);
    CHECK1(fabsf(m->specular[0] - 0.16f) < 1e-6f);
    ++m; /* a metal: no diffuse, its colour is the highlight's, 3/8 as high as n = 1 has it */
    CHECK1(m->exponent == 1 && m->diffuse[2] == 0 && m->transparency == 0.5f &&
           m->ambient[2] == 1 && m->specular[0] == 0.1875f);
    ++m;
    CHECK1(m->exponent == 30 && m->diffuse[1] == 0.5f && fabsf(m->specular[1] - 0.4f) < 1e-6f);
    ++m;
    CHECK1(m->is_unlit && m->diffuse[0] == 1 && m->specular[0] == 0);
    check_warning(&s, 1,
                  "mesh.gltf:1: materials[3].pbrMetallicRoughness.metallicFactor: expected a "
                  "number, found \"x\"; ignored");
    burnish_mesh_data_destroy(&s);
}

/* ---- What moves vertices ---- */

/* Views over one buffer: positions, then whatever follows. */
static burnish_status read_posed(const char *rest, const byte_list *binary, double time,
                                 const char *animation, burnish_mesh_data *s, burnish_error *e) {
    static byte_list list;
    static char json[4096];
    burnish_load_options options = burnish_load_options_default();
    options.animation_time = time;
    options.animation = animation;
    snprintf(json, sizeof json, "$head$buffer(%zu),%s}", binary->size, rest);
    list.size = 0;
    put_glb(&list, json, binary);
    return run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL, s, e);
}

/* p + 0.5 (0, 0, 4) for vertex 1; the node's weights go before the mesh's, weight 0 counts for
 * nothing, and normals move too. */
static void test_morph_targets(void) {
    static const float floats[] = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 1,  0, 0, 1,
                                   0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0};
    static const struct {
        const char *weights;
        double z, n[3];
    } cases[] = {{"]}],'nodes':[{'mesh':0", 0, {0, 0, 1}},
                 {"],'weights':[0.5,9]}],'nodes':[{'mesh':0", 2, {0.5, 0, 0.5}},
                 {"],'weights':[7,0]}],'nodes':[{'mesh':0,'weights':[1,0]", 4, {1, 0, 0}}};
    byte_list binary = {.size = 0};
    put_floats(&binary, 36, floats);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char rest[1024];
        burnish_mesh_data s;
        burnish_error e;
        snprintf(rest, sizeof rest,
                 "'bufferViews':[{'buffer':0,'byteLength':144,'byteStride':12}],"
                 "'accessors':[$accessor(0,5126,3,VEC3),$part(36,5126,3,VEC3),"
                 "$part(72,5126,3,VEC3),$part(108,5126,3,VEC3)],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},"
                 "'targets':[{'POSITION':2,'NORMAL':3},{}]}%s}]",
                 cases[i].weights);
        if (!CHECK(read_posed(rest, &binary, BURNISH_AT_REST, NULL, &s, &e) == BURNISH_STATUS_OK,
                   "%s", e.text)) {
            continue;
        }
        CHECK1(corner_is(&s, 0, 1, 1, 0, cases[i].z) && corner_is(&s, 0, 2, 0, 2, 0));
        const float *n = burnish_normals(&s) + 3;
        const double length = sqrt(cases[i].n[0] * cases[i].n[0] + cases[i].n[2] * cases[i].n[2]);
        CHECK(fabs((double)n[0] - cases[i].n[0] / length) < 1e-6 &&
                  fabs((double)n[2] - cases[i].n[2] / length) < 1e-6,
              "%g %g", (double)n[0], (double)n[2]);
        burnish_mesh_data_destroy(&s);
    }
}

/* Two joints, of which the second is turned by 90 degrees about z around its place (1, 0, 0) and
 * bound there: vertices follow joint 0, joint 1, and both by half. The node's own matrix counts for
 * nothing. */
static void test_skin(void) {
    static const float positions[9] = {5, 0, 0, 2, 0, 0, 2, 0, 0};
    static const float weights[12] = {1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0};
    static const float bind[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};
    byte_list binary = {.size = 0};
    burnish_mesh_data s;
    burnish_error e;
    put_floats(&binary, 9, positions);
    put_floats(&binary, 12, weights);
    put_floats(&binary, 32, bind);
    put(&binary, "\0\1\0\0\0\1\0\0\0\1\0\0", 12);
    static const char rest[] =
        "'bufferViews':[$view(0,36),$view(36,48),$view(84,128),$view(212,12)],"
        "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5126,3,VEC4),"
        "$accessor(2,5126,2,MAT4),$accessor(3,5121,3,VEC4)],"
        "$mesh('POSITION':0,'WEIGHTS_0':1,'JOINTS_0':3),'skins':[{'joints':[1,2],"
        "'inverseBindMatrices':2}],'nodes':[{'mesh':0,'skin':0,'translation':[100,0,"
        "0]},{},{'translation':[1,0,0],'rotation':[0,0,0.70710678118654757,"
        "0.70710678118654757]}]";
    CHECK(read_posed(rest, &binary, BURNISH_AT_REST, NULL, &s, &e) == BURNISH_STATUS_OK, "%s",
          e.text);
    /* (5, 0, 0); (1, 0, 0) + (0, 1, 0); the middle of (2, 0, 0) and (1, 1, 0) */
    CHECK1(corner_is(&s, 0, 0, 5, 0, 0) && corner_is(&s, 0, 1, 1, 1, 0) &&
           corner_is(&s, 0, 2, 1.5, 0.5, 0));
    burnish_mesh_data_destroy(&s);
    binary.bytes[212] = 2;
    CHECK1(read_posed(rest, &binary, BURNISH_AT_REST, NULL, &s, &e) == BURNISH_STATUS_FORMAT);
    CHECK1(strstr(e.text, "accessors[3]: joint 2 of vertex 0 is not below the skin's 2"));
    burnish_mesh_data_destroy(&s);
}

static void test_instances(void) {
    static const float floats[] = {0, 0,  0, 1, 0, 0, 0, 2,  0, 10, 0,
                                   0, 20, 0, 0, 2, 2, 2, -1, 1, 1};
    byte_list binary = {.size = 0};
    burnish_mesh_data s;
    burnish_error e;
    put_floats(&binary, sizeof floats / sizeof *floats, floats);
    CHECK(read_posed("'bufferViews':[$view(0,84)],'accessors':[$accessor(0,5126,3,VEC3),"
                     "$part(36,5126,2,VEC3),$part(60,5126,2,VEC3)],"
                     "'extensionsRequired':['EXT_mesh_gpu_instancing'],$mesh('POSITION':0),"
                     "'nodes':[{'mesh':0,'translation':[0,0,5],"
                     "'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':1,"
                     "'SCALE':2}}}}]",
                     &binary, BURNISH_AT_REST, NULL, &s, &e) == BURNISH_STATUS_OK,
          "%s", e.text);
    CHECK1(s.triangle_count == 2 && corner_is(&s, 0, 1, 12, 0, 5) &&
           corner_is(&s, 0, 2, 10, 4, 5) && corner_is(&s, 1, 2, 19, 0, 5) &&
           corner_is(&s, 1, 1, 20, 2, 5)); /* a mirror */
    burnish_mesh_data_destroy(&s);
}

/* Translations 0 at 1 s and (8, 0, 0) at 3 s by each interpolation; a rotation of a quarter turn,
 * whose middle is an eighth of one, and whose quarters are equal angles. */
static void test_animation(void) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0}, times[2] = {1, 3};
    static const float steps[6] = {0, 0, 0, 8, 0, 0};
    /* in-tangent, value, out-tangent, twice */
    static const float cubic[18] = {9, 9, 9, 0, 0, 0, 1, 0, 0, 2, 0, 0, 8, 0, 0, 9, 9, 9};
    static const float turns[8] = {0, 0, 0, 1, 0, 0, -0.70710678f, -0.70710678f};
    static const struct {
        const char *animation, *path;
        double time, x;
    } cases[] = {{"0", "", 0, 0},
                 {"0", "", 2, 4},
                 {"0", "", 2.5, 6},
                 {"linear", "", 9, 8},
                 {"step", "", 2.9, 0},
                 {"1", "", 3, 8},
                 {"cubic", "", 1, 0},
                 {"cubic", "", 3, 8},
                 /* t = 1/2: 8/2 + 2 (1/8 1) - 2 (1/8 2) */
                 {"cubic", "", 2, 4 + 0.25 - 0.5}};
    byte_list binary = {.size = 0};
    put_floats(&binary, 9, positions);
    put_floats(&binary, 2, times);
    put_floats(&binary, 6, steps);
    put_floats(&binary, 18, cubic);
    put_floats(&binary, 8, turns);
    static const char rest[] =
        "'bufferViews':[$view(0,172)],'accessors':[$accessor(0,5126,3,VEC3),"
        "$part(36,5126,2,SCALAR),$part(44,5126,2,VEC3),$part(68,5126,6,VEC3),"
        "$part(140,5126,2,VEC4)],$mesh('POSITION':0),'nodes':[{'mesh':0,"
        "'translation':[0,7,0]}],'animations':[{'name':'linear',"
        "'samplers':[{'input':1,'output':2}],'channels':[{'sampler':0,"
        "'target':{'node':0,'path':'translation'}}]},{'name':'step',"
        "'samplers':[{'input':1,'output':2,'interpolation':'STEP'}],"
        "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]},"
        "{'name':'cubic','samplers':[{'input':1,'output':3,"
        "'interpolation':'CUBICSPLINE'}],'channels':[{'sampler':0,"
        "'target':{'node':0,'path':'translation'}}]},{'name':'turn',"
        "'samplers':[{'input':1,'output':4}],'channels':[{'sampler':0,"
        "'target':{'node':0,'path':'rotation'}}]}]";
    burnish_mesh_data s;
    burnish_error e;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        CHECK(read_posed(rest, &binary, cases[i].time, cases[i].animation, &s, &e) ==
                  BURNISH_STATUS_OK,
              "%s", e.text);
        CHECK(corner_is(&s, 0, 0, cases[i].x, 0, 0), "%zu: %g", i,
              (double)burnish_positions(&s)[0]);
        burnish_mesh_data_destroy(&s);
    }
    CHECK1(read_posed(rest, &binary, BURNISH_AT_REST, NULL, &s, &e) == BURNISH_STATUS_OK);
    CHECK1(corner_is(&s, 0, 0, 0, 7, 0));
    burnish_mesh_data_destroy(&s);
    /* From no turn to one of 90 degrees about z, whose quaternion has the other sign. */
    for (int quarter = 0; quarter <= 4; ++quarter) {
        CHECK1(read_posed(rest, &binary, 1 + quarter / 2.0, "turn", &s, &e) == BURNISH_STATUS_OK);
        const double angle = quarter * acos(0) / 4;
        CHECK(corner_is(&s, 0, 1, cos(angle), 7 + sin(angle), 0), "%d", quarter);
        burnish_mesh_data_destroy(&s);
    }
    CHECK1(read_posed(rest, &binary, 0, "4", &s, &e) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(e.text,
               "mesh.gltf: animation \"4\" is none of its 4; give a name or a number from 0 "
               "to 3");
    burnish_mesh_data_destroy(&s);
    read_good("$head$triangle,$node}", NULL, &s);
    burnish_mesh_data_destroy(&s);
}

/* ---- Points and lines ---- */

/* Whether the prism of line i joins two of the triangle's positions. */
static int joins(const burnish_mesh_data *s, size_t i, size_t from, size_t to) {
    static const double positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    const size_t ends[2] = {from, to};
    for (size_t end = 0; end < 2; ++end) {
        for (size_t k = 0; k < 3; ++k) { /* opposite vertices of its six are around the end */
            const float *ring = burnish_positions(s) + 3 * (12 * i + 6 * end);
            if (fabs(((double)ring[k] + (double)ring[9 + k]) / 2 - positions[ends[end]][k]) >
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
    } cases[] = {{1, "", 1, {0}, {1}}, /* the third position is passed over */
                 {2, "", 3, {0, 1, 2}, {1, 2, 0}},
                 {3, "", 2, {0, 1}, {1, 2}},
                 {3, ",'material':0", 2, {0, 1}, {1, 2}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[1000];
        burnish_mesh_data s;
        snprintf(text, sizeof text,
                 "$head$triangle_accessors,'materials':[{'pbrMetallicRoughness':{'baseColorFac"
                 "tor':[1,0,1,1]}}],'meshes':[{'primitives':[{'mode':%d,"
                 "'attributes':{'POSITION':0}%s},{'mode':0,'attributes':{'POSITION':0}}]}],"
                 "$node}",
                 cases[i].mode, cases[i].more);
        read_good(text, NULL, &s);
        CHECK1(s.line_count == cases[i].count && s.point_count == 0 && s.material_count == 1);
        CHECK1(s.triangle_count == 12 * cases[i].count);
        for (size_t k = 0; k < cases[i].count && k < s.line_count; ++k) {
            CHECK1(joins(&s, k, cases[i].from[k], cases[i].to[k]));
        }
        const uint8_t *colors = burnish_colors(&s);
        CHECK1(!colors == !*cases[i].more);
        CHECK1(!colors || (colors[0] == 255 && colors[1] == 0 && colors[2] == 255));
        if (CHECK1(s.warning_count == (i == 0 ? 2 : 1))) {
            CHECK_TEXT(s.warnings[s.warning_count - 1],
                       i == 0 ? "mesh.gltf:1: meshes[0].primitives[0]: 3 corners make no whole "
                                "lines; the last 1 are passed over"
                              : "mesh.gltf:1: meshes[0].primitives[1]: points are not drawn beside "
                                "lines");
        }
        burnish_mesh_data_destroy(&s);
    }
}

/* Indices choose the points; the node moves them. */
static void test_points(void) {
    burnish_mesh_data s;
    burnish_error e;
    read_good("$head'buffers':[$triangle_buffer,{'byteLength':2,'uri':'data:;base64,"
              "AgE='}],'bufferViews':[$view(0,36),{'buffer':1,'byteLength':2}],"
              "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5121,2,SCALAR)],"
              "'meshes':[{'primitives':[{'mode':0,'indices':1,"
              "'attributes':{'POSITION':0}}]}],'nodes':[{'mesh':0,'translation':[5,0,0]}]}",
              NULL, &s);
    if (CHECK1(s.point_count == 2 && s.warning_count == 0)) {
        const size_t vertices = s.streams[BURNISH_POSITION].count / 2;
        for (size_t point = 0; point < 2; ++point) {
            double sum[3] = {0, 0, 0};
            for (size_t i = 0; i < 3 * vertices; ++i) {
                sum[i % 3] +=
                    (double)burnish_positions(&s)[3 * vertices * point + i] / (double)vertices;
            }
            CHECK1(fabs(sum[0] - (point == 0 ? 5 : 6)) < 1e-5 &&
                   fabs(sum[1] - (point == 0 ? 2 : 0)) < 1e-5 && fabs(sum[2]) < 1e-5);
        }
    }
    burnish_mesh_data_destroy(&s);
    CHECK1(read_gltf("$head$triangle_accessors,'meshes':[{'primitives':[{'attributes':{'POSITION':"
                     "0}},{'mode':3,'attributes':{'POSITION':0}}]}],$node}",
                     &s, &e) == BURNISH_STATUS_OK &&
           s.triangle_count == 1 && s.warning_count == 1);
    CHECK_TEXT(s.warnings[0],
               "mesh.gltf:1: meshes[0].primitives[1]: lines are not drawn beside triangles");
    burnish_mesh_data_destroy(&s);
}

/* ---- Compressed views ---- */

/* Raw differences of every byte of three positions, the first of 0; the tail holds that 0. */
static void put_packed_positions(byte_list *list) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
    uint8_t bytes[36];
    memcpy(bytes, positions, sizeof bytes); /* of a little-endian machine */
    put_bits(list, 0xA0, 1, 0);
    for (size_t k = 0; k < 12; ++k) {
        put_bits(list, 3, 1, 0);
        for (size_t i = 0; i < 16; ++i) {
            const int8_t delta =
                (int8_t)(i < 1 || i > 2 ? 0 : bytes[12 * i + k] - bytes[12 * i - 12 + k]);
            put_bits(list, (uint8_t)((uint8_t)delta << 1 ^ (delta < 0 ? 255 : 0)), 1, 0);
        }
    }
    for (int i = 0; i < 32; ++i) {
        put_bits(list, 0, 1, 0);
    }
}

/* A triangle and its indices, with a buffer that has no bytes; whatever is damaged, it ends. */
static void test_compressed_views(void) {
    static const char head[] =
        "$head'extensionsRequired':['EXT_meshopt_compression'],'buffers':[{'byteLength':255},"
        "{'byteLength':99}],'bufferViews':[$packed(1,0,237,'mode':'ATTRIBUTES','byteStride':12,"
        "'count':3),%s],'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5123,3,SCALAR)],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],$node}";
    static const struct {
        const char *view, *message;
    } cases[] = {
        {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':2,'count':3)", NULL},
        {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':3,'count':3)",
         "byteStride of indices must be 2 or 4"},
        {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':2,'count':4)",
         "count of TRIANGLES must be a multiple of 3"},
        {"$packed(1,237,18,'mode':'TRIANGLES','byteStride':2)", "it has no elements"},
        {"$packed(1,237,18,'mode':'INDICES','filter':'EXPONENTIAL','byteStride':4,'count':3)",
         "only ATTRIBUTES can have a filter"},
        {"$packed(1,237,18,'mode':'ATTRIBUTES','byteStride':6,'count':3)",
         "byteStride of ATTRIBUTES must be a multiple of 4 up to 256"},
        {"$packed(1,237,18,'mode':'ATTRIBUTES','filter':'QUATERNION','byteStride':12,'count':3)",
         "byteStride of OCTAHEDRAL and COLOR must be 4 or 8, of QUATERNION 8"},
        {"$packed(1,237,18,'mode':'SOME','byteStride':2,'count':3)",
         "its mode is none that is known; export the file without meshopt's compression"},
        {"$packed(1,237,18,'mode':'ATTRIBUTES','filter':'X','byteStride':4,'count':3)",
         "its filter is none that is known; export the file without meshopt's compression"},
        {"$packed(1,237,17,'mode':'TRIANGLES','byteStride':2,'count':3)",
         "its 17 bytes are no 3 elements compressed as TRIANGLES; the file is damaged"},
        {"$packed(1,237,99,'mode':'TRIANGLES','byteStride':2,'count':3)",
         "reaches to byte 336 of a buffer of 256"},
        {"$packed(1,237,18,'mode':'ATTRIBUTES','byteStride':256,'count':4000000)",
         "compressed buffer views unpack to 1024000036 bytes, of a file of "}};
    byte_list binary = {.size = 0};
    put_packed_positions(&binary);
    put_bits(&binary, 0xE1, 1, 0);
    put_bits(&binary, 0xF0, 1, 0);
    for (int i = 0; i < 16; ++i) {
        put_bits(&binary, 0, 1, 0);
    }
    burnish_mesh_data s;
    burnish_error e;
    char text[1500];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        snprintf(text, sizeof text, head, cases[i].view);
        CHECK((read_glb(text, &binary, &s, &e) == BURNISH_STATUS_OK) == !cases[i].message, "%s",
              e.text);
        CHECK(!cases[i].message || strstr(e.text, cases[i].message), "%s", e.text);
        if (!cases[i].message && CHECK1(s.triangle_count == 1)) {
            CHECK1(corner_is(&s, 0, 0, 0, 0, 0) && corner_is(&s, 0, 1, 1, 0, 0) &&
                   corner_is(&s, 0, 2, 0, 2, 0));
        }
        burnish_mesh_data_destroy(&s);
    }
    snprintf(text, sizeof text, head, cases[0].view);
    for (char *at = text; (at = strstr(at, "EXT_meshopt"));) { /* as Khronos took it over */
        memcpy(at, "KHR", 3);
    }
    CHECK(read_glb(text, &binary, &s, &e) == BURNISH_STATUS_OK && s.triangle_count == 1 &&
              s.warning_count == 0,
          "%s", e.text);
    burnish_mesh_data_destroy(&s);
    for (size_t bit = 0; bit < 8 * binary.size; ++bit) {
        binary.bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
        const burnish_status status = read_glb(text, &binary, &s, &e);
        CHECK1(status == BURNISH_STATUS_OK || status == BURNISH_STATUS_FORMAT);
        burnish_mesh_data_destroy(&s);
        binary.bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
}

/* ---- Cameras and textures ---- */

static void test_cameras(void) {
    burnish_mesh_data s;
    read_good("$head$triangle,'cameras':[{'type':'perspective','perspective':{'yfov':0.5,"
              "'znear':1}},{'name':'plan','type':'orthographic',"
              "'orthographic':{'ymag':3}}],'nodes':[{'mesh':0},{'name':'front','camera':0,"
              "'translation':[0.5,1,10]},{'camera':1,'translation':[0,50,0],"
              "'rotation':[-0.70710678118654757,0,0,0.70710678118654757]}]}",
              NULL, &s);
    if (CHECK1(s.camera_count == 2)) {
        const burnish_camera *c = &s.cameras[0].camera;
        CHECK_TEXT(s.cameras[0].name, "front");
        CHECK1(c->position[0] == 0.5 && c->position[2] == 10 && c->view_up[1] == 1 &&
               c->orthographic_height == 0 && fabs(c->view_angle - 90 / acos(0) * 0.5) < 1e-9);
        /* as far away as the middle of the triangle's box */
        CHECK1(fabs(c->focal_point[0] - 0.5) < 1e-9 && fabs(c->focal_point[2]) < 1e-9);
        CHECK_TEXT(s.cameras[1].name, "plan");
        c = &s.cameras[1].camera;
        CHECK1(c->orthographic_height == 6 && fabs(c->focal_point[1] - 1) < 1e-9 &&
               fabs(c->view_up[2] + 1) < 1e-9 && fabs(c->view_up[1]) < 1e-9);
    }
    burnish_mesh_data_destroy(&s);
}

/* Lux at the middle of the triangle's box, (0.5, 1, 0): 2 from +z, and from -x 18 / 3^2 = 2, of
 * which green is half. None faces the other, so that 2 becomes 1; the light that is not drawn, the
 * dark one and the one that is not there are left out. */
static void test_lights(void) {
    burnish_mesh_data s;
    burnish_error e;
    read_good("$head$triangle,'extensionsUsed':['KHR_lights_punctual'],"
              "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'directional',"
              "'intensity':2},{'type':'spot','intensity':18,'color':[1,0.5,0]},"
              "{'type':'point','intensity':0}]}},'nodes':[{'mesh':0},"
              "{'extensions':{'KHR_lights_punctual':{'light':0}},'translation':[7,8,9]},"
              "{'extensions':{'KHR_lights_punctual':{'light':1}},'translation':[-2.5,1,"
              "0]},{'extensions':{'KHR_lights_punctual':{'light':2}}},"
              "{'extensions':{'KHR_lights_punctual':{'light':3}}},"
              "{'extensions':{'KHR_lights_punctual':{'light':0},"
              "'KHR_node_visibility':{'visible':false}}}]}",
              NULL, &s);
    if (CHECK1(s.light_count == 2)) {
        const burnish_light *sun = &s.lights[0].light, *lamp = &s.lights[1].light;
        CHECK1(sun->kind == BURNISH_LIGHT_DIRECTIONAL && !s.lights[0].is_spot &&
               !sun->follows_camera);
        CHECK1(sun->vector[0] == 0 && sun->vector[1] == 0 && sun->vector[2] == 1);
        CHECK1(lamp->kind == BURNISH_LIGHT_POINT && s.lights[1].is_spot);
        CHECK1(lamp->vector[0] == -2.5 && lamp->vector[1] == 1 && lamp->vector[2] == 0);
        for (int k = 0; k < 3; ++k) {
            CHECK1(sun->color[k] == 1 && fabsf(lamp->color[k] - (1 - 0.5f * (float)k)) < 1e-6f);
        }
    }
    CHECK1(s.warning_count == 0);
    burnish_mesh_data_destroy(&s);
    CHECK1(read_gltf("$head$triangle,$node}", &s, &e) == BURNISH_STATUS_OK && s.light_count == 0);
    burnish_mesh_data_destroy(&s);
}

#define IMAGE                                                                                      \
    "{'uri':'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+"  \
    "M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=='}"

/* One image as colours and as numbers is two textures, however often it is used. The transform of
 * (u, v) = (1/4, 1/4 from above) is checked by hand. */
static void test_textures(void) {
    burnish_mesh_data s;
    read_good("$head$triangle_accessors,'images':[$image],'samplers':[{'wrapS':33071,"
              "'wrapT':33648,'magFilter':9728}],'textures':[{'source':0,'sampler':0},"
              "{'source':0}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'ind"
              "ex':0,'extensions':{'KHR_texture_transform':{'offset':[0.5,0.25],"
              "'scale':[2,4],'rotation':1.5707963267948966}}},"
              "'metallicRoughnessTexture':{'index':1}},'normalTexture':{'index':1,"
              "'scale':0.5},'emissiveTexture':{'index':1},'occlusionTexture':{'index':1,"
              "'texCoord':1},'emissiveFactor':[1,0,0.5],"
              "'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':3}},"
              "'alphaMode':'MASK','alphaCutoff':0.25}],"
              "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}],"
              "$node}",
              NULL, &s);
    const burnish_material *m = s.materials;
    const burnish_texture_use *color = &m->textures[BURNISH_TEXTURE_COLOR];
    CHECK1(s.texture_count == 2 && s.textures[color->texture - 1].is_color &&
           m->textures[BURNISH_TEXTURE_EMISSIVE].texture == color->texture &&
           m->textures[BURNISH_TEXTURE_NORMAL].texture ==
               m->textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS].texture &&
           m->textures[BURNISH_TEXTURE_OCCLUSION].texture == 0);
    CHECK1(color->wrap[0] == BURNISH_WRAP_CLAMP && color->wrap[1] == BURNISH_WRAP_MIRROR &&
           color->is_nearest && m->textures[BURNISH_TEXTURE_NORMAL].strength == 0.5f &&
           m->textures[BURNISH_TEXTURE_NORMAL].wrap[0] == BURNISH_WRAP_REPEAT);
    CHECK1(m->is_metallic && m->emissive[0] == 3 && m->emissive[2] == 1.5f &&
           m->alpha_mode == BURNISH_ALPHA_MASK && m->alpha_cutoff == 0.25f && m->diffuse[0] == 1);
    /* Scaled (1/2, 1), turned to (1, -1/2), moved to (3/2, -1/4), which is 5/4 from below. */
    const float *t = color->transform, u = 0.25f, v = 0.75f;
    CHECK(color->has_transform && fabsf(t[0] * u + t[1] * v + t[2] - 1.5f) < 1e-6f &&
              fabsf(t[3] * u + t[4] * v + t[5] - 1.25f) < 1e-6f,
          "%g %g", (double)(t[0] * u + t[1] * v + t[2]), (double)(t[3] * u + t[4] * v + t[5]));
    check_warning(&s, 1,
                  "mesh.gltf:1: materials[0].occlusionTexture: left out, as it has texture "
                  "coordinates of its own (set 1)");
    burnish_mesh_data_destroy(&s);
}
/* A vertex has one set of texture coordinates: that which most of its material's textures use, of
 * two that of the base colour. The accessor of set 1 is the positions' x and y, turned. */
static void test_texture_sets(void) {
    static const struct {
        const char *sets[3]; /* of base colour, normals, occlusion */
        int has[3];
        double u; /* of the second corner */
    } cases[] = {{{"0", "0", "0"}, {1, 1, 1}, 0.5}, {{"1", "1", "1"}, {1, 1, 1}, 1},
                 {{"0", "1", "1"}, {0, 1, 1}, 1},   {{"1", "0", "1"}, {1, 0, 1}, 1},
                 {{"0", "1", "9"}, {1, 0, 0}, 0.5}, {{"1", "2", "0"}, {1, 0, 0}, 1}};
    static const int slots[3] = {BURNISH_TEXTURE_COLOR, BURNISH_TEXTURE_NORMAL,
                                 BURNISH_TEXTURE_OCCLUSION};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char json[2048];
        burnish_mesh_data s;
        byte_list binary = {.size = 0};
        static const float values[] = {0,    0, 0, 1,    0, 0, 0, 2, 0, 0, 0,
                                       0.5f, 0, 0, 0.5f, 0, 0, 1, 0, 0, 1};
        put_floats(&binary, sizeof values / sizeof *values, values);
        snprintf(json, sizeof json,
                 "$head$buffer(84),'bufferViews':[$view(0,36),$view(36,24),$view(60,24)],"
                 "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5126,3,VEC2),"
                 "$accessor(2,5126,3,VEC2)],'images':[$image],'textures':[{'source':0}],"
                 "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,"
                 "'texCoord':%s}},'normalTexture':{'index':0,'texCoord':%s},"
                 "'occlusionTexture':{'index':0,'texCoord':7,"
                 "'extensions':{'KHR_texture_transform':{'texCoord':%s}}}}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1,"
                 "'TEXCOORD_1':2},'material':0}]}],$node}",
                 cases[i].sets[0], cases[i].sets[1], cases[i].sets[2]);
        read_good(json, &binary, &s);
        for (int k = 0; k < 3 && s.material_count > 0; ++k) {
            CHECK((s.materials[0].textures[slots[k]].texture > 0) == cases[i].has[k],
                  "%zu: slot %d", i, k);
        }
        const float *uv = s.streams[BURNISH_TEXCOORD].items;
        CHECK(s.streams[BURNISH_TEXCOORD].count == 3 && (double)uv[2] == cases[i].u, "%zu", i);
        CHECK(s.warning_count == (i > 1), "%zu: %zu warnings", i, s.warning_count);
        burnish_mesh_data_destroy(&s);
    }
}

/* Images that can't be had leave the mesh as it is without them; after some that are damaged, no
 * further ones are tried. */
static void test_damaged_images(void) {
    static const char *const images[] = {"{'uri':'data:image/png;base64,AAAA'}",
                                         "{'uri':'data:image/png;base64,A*'}",
                                         "{'bufferView':7}",
                                         "{'uri':5}",
                                         "{}",
                                         "{'uri':'../a.png'}"};
    for (size_t i = 0; i < sizeof images / sizeof *images; ++i) {
        char json[2048];
        burnish_mesh_data s;
        snprintf(json, sizeof json,
                 "$head$triangle_accessors,'images':[%s,%s],'textures':[{'source':0},"
                 "{'source':1}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'ind"
                 "ex':0}},'normalTexture':{'index':1},'emissiveTexture':{'index':9}}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}],"
                 "$node}",
                 images[i], images[i]);
        read_good(json, NULL, &s);
        CHECK1(s.triangle_count == 1 && s.texture_count == 0 && s.warning_count >= 1 &&
               s.materials[0].textures[BURNISH_TEXTURE_COLOR].texture == 0);
        burnish_mesh_data_destroy(&s);
    }
}

/* ---- Faults ---- */

static void test_faults(void) {
    static const struct {
        const char *json, *message;
    } cases[] = {
        {"{}", "mesh.gltf:1: the JSON has no \"asset\"; this is no glTF 2.0"},
        {"[]", "mesh.gltf:1: the JSON has no \"asset\"; this is no glTF 2.0"},
        {"{'asset':{'version':'1.0'}}",
         "mesh.gltf:1: asset: version \"1.0\" is not supported; convert the file to glTF 2.0"},
        {"{'asset':{'version':'2.0'}}", "mesh.gltf: no triangles; export the scene's meshes"},
        {"$head'extensionsRequired':['ACME_x']}",
         "mesh.gltf:1: extensionsRequired[0]: the file can't be drawn without the extension "
         "ACME_x, which is not supported; export it without"},
        {"$head'nodes':{}}", "mesh.gltf:1: nodes: expected an array, found {"},
        {"$head'nodes':[{'mesh':0}]}",
         "mesh.gltf:1: nodes[0].mesh: 0 is not in meshes, of which there are 0"},
        {"$head$triangle,'nodes':[{'mesh':-1}]}",
         "mesh.gltf:1: nodes[0].mesh: expected a whole number from 0 to 4194304, found -1"},
        {"$head$triangle,'nodes':[{'mesh':0,'scale':[1,2]}]}",
         "mesh.gltf:1: nodes[0].scale: expected 3 numbers in [], found ["},
        {"$head$triangle,'nodes':[{'children':[1]},{'children':[1]}]}",
         "mesh.gltf:1: nodes[1].children[0]: nodes[1] has two parents, or is its own; nodes must "
         "form a tree"},
        {"$head$triangle,'nodes':[{'children':[1]},{'children':[0]},{'mesh':0}]}",
         "mesh.gltf:1: nodes: 2 nodes are their own ancestors; nodes must form a tree"},
        {"$head$triangle,'nodes':[{'mesh':0,'scale':[1e38,1,1],'translation':[1e39,0,"
         "0]}]}",
         "mesh.gltf:1: accessors[0]: position 0 is not finite, or beyond 3.4e38; repair the mesh"},
        {"$head$buffer(36),'bufferViews':[$view(0,36)],'accessors':["
         "$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),$node}",
         "mesh.gltf:1: buffers[0]: has no uri, and there is no binary chunk for it; write the file "
         "anew"},
        {"$head'buffers':[{'byteLength':37,'uri':'data:;base64,AAAA'}],"
         "'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
         "$mesh('POSITION':0),$node}",
         "mesh.gltf:1: buffers[0]: has 3 bytes where byteLength is 37; the file is truncated"},
        {"$head'buffers':[{'byteLength':3,'uri':'data:;base64,AA*A'}],"
         "'bufferViews':[$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],"
         "$mesh('POSITION':0),$node}",
         "mesh.gltf:1: buffers[0].uri: its base64 holds a character that base64 has not; the file "
         "is damaged"},
        {"$head'buffers':[{'byteLength':3,'uri':'a.bin'}],'bufferViews':["
         "$view(0,36)],'accessors':[$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),"
         "$node}",
         "mesh.gltf:1: buffers[0].uri: names the file a.bin, which an input without a folder can't "
         "have; give its path, or convert it to GLB"},
        {"$head'buffers':[$triangle_buffer],'bufferViews':[$view(4,36)],"
         "'accessors':[$accessor(0,5126,3,VEC3)],$mesh('POSITION':0),$node}",
         "mesh.gltf:1: bufferViews[0]: reaches to byte 40 of a buffer of 36"},
        {"$head'buffers':[$triangle_buffer],'bufferViews':[$view(0,36)],"
         "'accessors':[$accessor(0,5126,4,VEC3)],$mesh('POSITION':0),$node}",
         "mesh.gltf:1: accessors[0]: 4 elements do not fit into bufferViews[0] of 36 bytes; the "
         "file is damaged"},
        {"$head'buffers':[$triangle_buffer],'bufferViews':[{'buffer':0,"
         "'byteLength':36,'byteStride':4}],'accessors':[$accessor(0,5126,3,VEC3)],"
         "$mesh('POSITION':0),$node}",
         "mesh.gltf:1: accessors[0]: its elements have 12 bytes, but lie 4 apart in "
         "bufferViews[0]"},
        {"$head'accessors':[{'componentType':5126,'count':1000000000,'type':'VEC3'}],"
         "$mesh('POSITION':0),$node}",
         "mesh.gltf:1: accessors[0]: sparse accessors unpack to 12000000000 bytes, of a file of "
         "176; write them in full"},
        {"$head$triangle_accessors,'meshes':[{'primitives':[{'indices':0,"
         "'attributes':{'POSITION':0}}]}],$node}",
         "mesh.gltf:1: meshes[0].primitives[0].indices: accessors[0] has another type than what is "
         "needed here"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh_data s;
        burnish_error e;
        CHECK(read_gltf(cases[i].json, &s, &e) != BURNISH_STATUS_OK, "%zu", i);
        CHECK_TEXT(e.text, cases[i].message);
        burnish_mesh_data_destroy(&s);
    }
}

/* A small file whose nodes draw one mesh again and again is refused before memory is taken. */
static void test_instances_are_bounded(void) {
    burnish_load_options options = burnish_load_options_default();
    byte_list list = {.size = 0};
    burnish_mesh_data s;
    burnish_error e;
    put_json(&list, "$head'accessors':[{'componentType':5126,'count':3000000,'type':'VEC3'}],"
                    "$mesh('POSITION':0),'nodes':[{'mesh':0}");
    for (int i = 0; i < 50; ++i) {
        put_json(&list, ",{'mesh':0}");
    }
    put_text(&list, "]}");
    CHECK1(run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL, &s, &e) ==
           BURNISH_STATUS_LIMIT);
    CHECK_TEXT(e.text, "mesh.gltf: its 723 bytes become more than 5242880 vertices and triangles; "
                       "set max-triangles to draw them");
    burnish_mesh_data_destroy(&s);
    options.max_triangles = 1000;
    CHECK1(run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL, &s, &e) ==
           BURNISH_STATUS_LIMIT);
    CHECK_TEXT(e.text, "mesh.gltf: more than 1000 triangles; raise the limit or simplify the mesh");
    burnish_mesh_data_destroy(&s);
}

/* Every beginning of a GLB, and every byte of one changed: one line, or a sound mesh. */
static void test_damage(void) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
    const burnish_load_options options = burnish_load_options_default();
    byte_list binary = {.size = 0}, list = {.size = 0};
    put_floats(&binary, 9, positions);
    put_bits(&binary, 0x020100, 4, 0);
    put_glb(&list,
            "$head$buffer(40),'bufferViews':[$view(0,36),$view(36,3)],"
            "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5121,3,SCALAR)],"
            "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],$node}",
            &binary);
    for (size_t i = 0; i < 9 * list.size; ++i) {
        burnish_mesh_data s;
        burnish_error e;
        byte_list damaged = list;
        if (i < list.size) {
            damaged.size = i;
        } else {
            damaged.bytes[i / 9] ^= (uint8_t)(1u << i % 8);
        }
        const burnish_status status =
            run_reader(BURNISH_FORMAT_GLTF, damaged.bytes, damaged.size, &options, NULL, &s, &e);
        CHECK(status == BURNISH_STATUS_OK ? s.triangle_count > 0 : *e.text && !strchr(e.text, '\n'),
              "%zu", i);
        CHECK1(i >= list.size - 4 || i >= list.size || status != BURNISH_STATUS_OK);
        burnish_mesh_data_destroy(&s);
    }
}

/* ---- Threads ---- */

enum { MANY = 20000 };

/* Positions, normals, texture coordinates and indices of MANY vertices. */
static uint8_t many[MANY * (32 + 4)];

static void store(uint8_t *to, uint32_t bits) {
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(bits >> 8 * i);
    }
}

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

static int are_same(const burnish_mesh_data *a, const burnish_mesh_data *b) {
    const size_t vertices = a->streams[BURNISH_POSITION].count;
    return vertices == MANY && b->streams[BURNISH_POSITION].count == MANY &&
           a->triangle_count == b->triangle_count &&
           memcmp(burnish_positions(a), burnish_positions(b), 12 * vertices) == 0 &&
           memcmp(burnish_normals(a), burnish_normals(b), 12 * vertices) == 0 &&
           memcmp(a->streams[BURNISH_TEXCOORD].items, b->streams[BURNISH_TEXCOORD].items,
                  8 * vertices) == 0 &&
           memcmp(corners_of(a), corners_of(b), 12 * a->triangle_count) == 0;
}

/* Vertices that several threads convert, and the first fault of the file whoever finds it. */
static void test_threads(void) {
    static const int threads[] = {2, 7};
    static const struct {
        uint32_t bad[2], index; /* positions, a place of an index; 0: none */
        const char *message;
    } cases[] = {
        {{0, 0}, 0, ""}, /* and each adds its own to those before */
        {{19990, 0}, 0, "accessors[0]: position 19990 is not finite"},
        {{0, 0}, 15000, "accessors[3]: index 20000 is not below the 20000 positions"},
        {{14000, 6000}, 0, "accessors[0]: position 6000 is not finite"},
        {{5999, 0}, 0, "accessors[0]: position 5999 is not finite"},
    };
    uint64_t random = test_seed(1);
    for (size_t i = 0; i < MANY; ++i) {
        for (size_t k = 0; k < 8; ++k) {
            const float value = (float)(test_random64(&random) >> 40) / 1e6f;
            uint32_t bits;
            memcpy(&bits, &value, sizeof bits);
            store(many + 32 * i + 4 * k, bits);
        }
        store(many + 32 * MANY + 4 * i, (uint32_t)i);
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh_data alone, shared;
        burnish_error error, other;
        for (size_t k = 0; k < 2 && cases[i].bad[k] > 0; ++k) {
            store(many + 32 * (size_t)cases[i].bad[k] + 4, 0x7fc00000); /* not a number */
        }
        if (cases[i].index > 0) {
            store(many + 32 * MANY + 4 * (size_t)cases[i].index, MANY);
        }
        const burnish_status status = read_many(1, &alone, &error);
        CHECK(status == (*cases[i].message ? BURNISH_STATUS_FORMAT : BURNISH_STATUS_OK) &&
                  strstr(error.text, cases[i].message),
              "case %zu: %s", i, error.text);
        for (size_t t = 0; t < sizeof threads / sizeof *threads; ++t) {
            CHECK(read_many(threads[t], &shared, &other) == status &&
                      strcmp(other.text, error.text) == 0,
                  "case %zu: %s", i, other.text);
            CHECK(status != BURNISH_STATUS_OK || are_same(&alone, &shared), "case %zu", i);
            burnish_mesh_data_destroy(&shared);
        }
        burnish_mesh_data_destroy(&alone);
    }
}

/* ---- Nothing to be seen ---- */

#define MATERIALS(first, second)                                                                   \
    "'materials':[{" first "},{" second "}],'meshes':[{'primitives':["                             \
    "{'attributes':{'POSITION':0},'material':0},{'attributes':{'POSITION':0},'material':1}]}]"     \
    ",$node}"
#define CLEAR "'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,0,0,0]}"
#define CLEAR_MASK "'alphaMode':'MASK','pbrMetallicRoughness':{'baseColorFactor':[1,0,0,0]}"

/* A wholly transparent part of something visible stays so; if everything is, all is opaque. */
static void test_invisible(void) {
    static const struct {
        const char *json;
        int is_opaque;
    } cases[] = {{"$head$triangle_accessors," MATERIALS(CLEAR, "'name':'visible'"), 0},
                 {"$head$triangle_accessors," MATERIALS(CLEAR, CLEAR), 1},
                 {"$head$triangle_accessors," MATERIALS(CLEAR, CLEAR_MASK), 1},
                 {"$head$triangle_accessors," MATERIALS(CLEAR, CLEAR_MASK ",'alphaCutoff':0"), 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_mesh_data s;
        read_good(cases[i].json, NULL, &s);
        check_warning(&s, (size_t)cases[i].is_opaque,
                      "mesh.gltf: everything is wholly transparent (alpha 0) and drawn opaque");
        CHECK(s.material_count == 2 && s.materials[0].transparency == !cases[i].is_opaque, "%zu",
              i);
        burnish_mesh_data_destroy(&s);
    }
}

/* Alpha of vertices, which a blended material multiplies: 0 for all of them, or for all but one. */
static void test_invisible_vertices(void) {
    for (int visible = 0; visible < 2; ++visible) {
        static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
        burnish_mesh_data s;
        byte_list binary = {.size = 0};
        put_floats(&binary, 9, positions);
        for (int i = 0; i < 3; ++i) {
            put_bits(&binary, 0x00334455u | (visible && i == 2 ? 0x80000000u : 0), 4, 0);
        }
        read_good("$head$buffer(48),'bufferViews':[$view(0,36),$view(36,12)],"
                  "'accessors':[$accessor(0,5126,3,VEC3),{'bufferView':1,'componentType':5121,"
                  "'count':3,'type':'VEC4','normalized':true}],"
                  "'materials':[{'alphaMode':'BLEND'}],'meshes':[{'primitives':[{'attributes':{"
                  "'POSITION':0,'COLOR_0':1},'material':0}]}],$node}",
                  &binary, &s);
        check_warning(&s, !visible,
                      "mesh.gltf: everything is wholly transparent (alpha 0) and drawn opaque");
        if (CHECK1(s.streams[BURNISH_COLOR].count == 3)) {
            CHECK1(burnish_colors(&s)[3] == (visible ? 0 : 255));
        }
        burnish_mesh_data_destroy(&s);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_invisible());
    RUN(test_invisible_vertices());
    RUN(test_containers());
    RUN(test_guess());
    RUN(test_companions());
    RUN(test_component_types());
    RUN(test_sparse());
    RUN(test_attributes());
    RUN(test_modes());
    RUN(test_shared_vertices());
    RUN(test_threads());
    RUN(test_hierarchy());
    RUN(test_normals_of_nodes());
    RUN(test_materials());
    RUN(test_morph_targets());
    RUN(test_skin());
    RUN(test_instances());
    RUN(test_animation());
    RUN(test_compressed_views());
    RUN(test_lines());
    RUN(test_points());
    RUN(test_cameras());
    RUN(test_lights());
    RUN(test_textures());
    RUN(test_texture_sets());
    RUN(test_damaged_images());
    RUN(test_faults());
    RUN(test_instances_are_bounded());
    RUN(test_damage());
    return test_end("gltf");
}
