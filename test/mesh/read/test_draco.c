/* KHR_draco_mesh_compression, with a decoder that returns the streams themselves: the reader's
 * requests, and its handling of answers. Draco itself: test/importers/import_draco.sh. */
#include "gltf_input.h"

/* Of two streams at bytes 0 and `second` of the binary chunk. */
#define DRACO(second, size, primitives)                                                            \
    "$head'extensionsRequired':['KHR_draco_mesh_compression'],'buffers':[{'byteLength':" size      \
    "}],"                                                                                          \
    "'bufferViews':[{'buffer':0,'byteLength':" second "},"                                         \
    "{'buffer':0,'byteOffset':" second ",'byteLength':16}],"                                       \
    "'accessors':[{'componentType':5126,'count':3,'type':'VEC3'},"                                 \
    "{'componentType':5123,'count':3,'type':'SCALAR'},"                                            \
    "{'componentType':5121,'count':3,'type':'VEC4','normalized':true},"                            \
    "{'componentType':5126,'count':3,'type':'VEC2'}],"                                             \
    "'meshes':[{'primitives':[" primitives "]}],'nodes':[{'mesh':0}]}"
#define PRIMITIVE(attributes, view, numbers)                                                       \
    "{'attributes':{" attributes "},'indices':1,'extensions':{"                                    \
    "'KHR_draco_mesh_compression':{'bufferView':" #view ",'attributes':{" numbers "}}}}"

static struct {
    int calls, releases;
    size_t size;
    uint8_t request[4096], answer[4096];
    burnish_status status;
} seen;

static burnish_status echo(void *user_data, const char *form, const void *bytes, size_t size,
                           const uint8_t **decoded, size_t *decoded_size, burnish_error *error) {
    CHECK1(user_data == &seen && strcmp(form, "draco") == 0 && size <= sizeof seen.request);
    memcpy(seen.request, bytes, size);
    ++seen.calls;
    seen.size = 0;
    if (seen.status != BURNISH_STATUS_OK) {
        *error = (burnish_error){seen.status, "said elsewhere"};
        return seen.status;
    }
    for (size_t at = 0; at + 4 <= size;) {
        const size_t one = seen.request[at] | (size_t)seen.request[at + 1] << 8;
        memcpy(seen.answer + seen.size, seen.request + at + 4, one);
        seen.size += one;
        at += 4 + ((one + 3) & ~(size_t)3);
    }
    *decoded = seen.answer;
    *decoded_size = seen.size;
    return BURNISH_STATUS_OK;
}

static void release(void *user_data, const uint8_t *decoded, size_t size) {
    CHECK1(user_data == &seen && decoded == seen.answer && size == seen.size);
    ++seen.releases;
}

static burnish_status read_draco(const char *json, const byte_list *binary) {
    burnish_load_options options = burnish_load_options_default();
    static byte_list list;
    list.size = 0;
    put_glb(&list, json, binary);
    options.decoder = (burnish_stream_decoder){echo, release, &seen};
    return run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL);
}

/* A triangle as an answer: gltf_triangle as attribute 7, colours as 2. */
static void put_triangle(byte_list *list, uint32_t last_corner) {
    static const uint32_t words[] = {3, 1, 2, 7, 5126, 3};
    for (size_t i = 0; i < 6; ++i) {
        put_bits(list, words[i], 4, 0);
    }
    put_floats(list, 9, gltf_triangle);
    put_bits(list, 2, 4, 0);
    put_bits(list, 5121, 4, 0);
    put_bits(list, 4, 4, 0);
    put(list, "\xFF\0\0\xFF\0\xFF\0\xFF\0\0\xFF\xFF", 12);
    put_bits(list, 0, 4, 0);
    put_bits(list, 1, 4, 0);
    put_bits(list, last_corner, 4, 0);
}

static byte_list answer_of(uint32_t last_corner) {
    byte_list list = {.size = 0};
    put(&list,
        "\x89"
        "BDA\r\n\x1a\n",
        8);
    put_triangle(&list, last_corner);
    return list;
}

static void test_values(void) {
    byte_list binary = answer_of(2);
    CHECK1(binary.size == 104);
    seen.calls = seen.releases = 0;
    /* two primitives of one stream: it is decoded once */
    CHECK_OK(read_draco(DRACO("104", "104",
                              PRIMITIVE("'POSITION':0,'COLOR_0':2", 0,
                                        "'POSITION':7,'COLOR_0':2") "," PRIMITIVE("'POSITION':0", 0,
                                                                                  "'POSITION':7")),
                        &binary),
             fault);
    CHECK1(seen.calls == 1 && seen.releases == 1);
    CHECK1(seen.request[0] == 104 && seen.request[1] == 0 &&
           memcmp(seen.request + 4, binary.bytes, 104) == 0);
    CHECK1(got.triangle_count == 2 && got.warning_count == 0);
    const float *p = burnish_positions(&got) + 3 * (size_t)got.streams[BURNISH_POSITION].corners[2];
    CHECK1(p[0] == 0 && p[1] == 2 && p[2] == 0);
    CHECK1(got.streams[BURNISH_COLOR].count > 0);
}

/* Uncompressed values need no decoder. */
static void test_plain(void) {
    CHECK_OK(
        read_gltf("$head$triangle_accessors,'meshes':[{'primitives':[{'attributes':{'POSITION':0}"
                  ",'extensions':{"
                  "'KHR_draco_mesh_compression':{'bufferView':0,'attributes':{}}}}]}],"
                  "'nodes':[{'mesh':0}]}"),
        fault);
    CHECK1(got.triangle_count == 1);
}

static void check_refused(const char *json, const byte_list *binary, const char *message) {
    seen.calls = seen.releases = 0;
    CHECK1(read_draco(json, binary) != BURNISH_STATUS_OK);
    CHECK_TEXT(fault.text, message);
    CHECK1(seen.releases == (seen.status == BURNISH_STATUS_OK ? seen.calls : 0));
}

#define ONE PRIMITIVE("'POSITION':0", 0, "'POSITION':7")

static void test_refused(void) {
    byte_list binary = answer_of(2);
    check_fault(
        read_glb(DRACO("104", "104", ONE), &binary), BURNISH_STATUS_FORMAT,
        "mesh.gltf: byte 469: meshes[0].primitives[0]: is compressed by "
        "KHR_draco_mesh_compression, but no decoder is available; export the file without it");

    seen.status = BURNISH_STATUS_LIMIT;
    check_refused(DRACO("104", "104", ONE), &binary, "said elsewhere");
    seen.status = BURNISH_STATUS_OK;
    check_refused(
        DRACO("104", "104", PRIMITIVE("'POSITION':3", 0, "'POSITION':7")), &binary,
        "mesh.gltf: byte 553: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: "
        "unpacks to other values than accessors[3] describes; the file is damaged");
    check_refused(
        DRACO("104", "104", PRIMITIVE("'POSITION':0", 0, "'POSITION':2")), &binary,
        "mesh.gltf: byte 553: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: "
        "unpacks to other values than accessors[0] describes; the file is damaged");
    check_refused(
        DRACO("104", "104",
              "{'attributes':{'POSITION':0},'extensions':{"
              "'KHR_draco_mesh_compression':{}}}"),
        &binary,
        "mesh.gltf: byte 541: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: names "
        "no bufferView");
    binary = answer_of(3);
    check_refused(DRACO("104", "104", ONE), &binary,
                  "mesh.gltf: byte 282: accessors[1]: index 3 is not below the 3 positions; the "
                  "file is damaged");
    memset(binary.bytes + 8, 0, 12); /* a stream that can't be decoded */
    check_refused(
        DRACO("20", "104", ONE), &binary,
        "mesh.gltf: byte 551: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: its "
        "stream of Draco can't be decoded, or holds nothing; the file is damaged");
}

/* A truncated answer, or one with a wrong word, is read, or rejected with one line. */
static void test_damaged(void) {
    static const char cut[] = "mesh.gltf: the decoder of Draco answers with something else, or "
                              "with less than it states";
    const byte_list whole = answer_of(2);
    for (size_t size = 0; size < whole.size; size += 4) {
        char json[2048];
        byte_list binary = whole;
        snprintf(json, sizeof json, DRACO("%zu", "104", ONE), size, size);
        check_refused(json, &binary, cut);
    }
    for (size_t at = 8; at < whole.size; at += 4) {
        static const uint32_t words[] = {0, 1, 0x7FFFFFFF, 0x80000000u, UINT32_MAX, 0x55555556};
        for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
            byte_list binary = whole;
            binary.size = at;
            put_bits(&binary, words[k], 4, 0);
            binary.size = whole.size;
            const burnish_status status = read_draco(DRACO("104", "104", ONE), &binary);
            CHECK1(status == BURNISH_STATUS_OK ? got.triangle_count <= 1
                                               : fault.text[0] != 0 && !strchr(fault.text, '\n'));
        }
    }
}

int main(void) {
    RUN(test_values());
    RUN(test_plain());
    RUN(test_refused());
    RUN(test_damaged());
    return test_end("draco");
}
