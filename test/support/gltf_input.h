/* For tests of the glTF reader: files put together by hand. */
#ifndef BURNISH_TEST_GLTF_INPUT_H
#define BURNISH_TEST_GLTF_INPUT_H

#include "reader_input.h"

/* JSON with ' for ", so that it can be read in C. */
static inline void put_json(byte_list *list, const char *text) {
    for (; *text; ++text) {
        put(list, *text == '\'' ? "\"" : text, 1);
    }
}

/* A GLB of a JSON text and a binary chunk. */
static inline void put_glb(byte_list *list, const char *json, const byte_list *binary) {
    const size_t json_size = (strlen(json) + 3) & ~(size_t)3;
    const size_t binary_size = (binary->size + 3) & ~(size_t)3;
    put_text(list, "glTF");
    put_bits(list, 2, 4, 0);
    put_bits(list, 12 + 8 + json_size + 8 + binary_size, 4, 0);
    put_bits(list, json_size, 4, 0);
    put_text(list, "JSON");
    put_json(list, json);
    while (list->size % 4 != 0) {
        put_text(list, " ");
    }
    put_bits(list, binary_size, 4, 0);
    put(list, "BIN", 4);
    put(list, binary->bytes, binary->size);
    while (list->size % 4 != 0) {
        put_bits(list, 0, 1, 0);
    }
}

static inline burnish_status read_glb(const char *json, const byte_list *binary,
                                      burnish_mesh_data *mesh, burnish_error *error) {
    const burnish_load_options options = burnish_load_options_default();
    static byte_list list;
    list.size = 0;
    put_glb(&list, json, binary);
    return run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL, mesh, error);
}

static inline burnish_status read_gltf(const char *json, burnish_mesh_data *mesh,
                                       burnish_error *error) {
    const burnish_load_options options = burnish_load_options_default();
    static byte_list list;
    list.size = 0;
    put_json(&list, json);
    return run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL, mesh, error);
}

static inline void put_floats(byte_list *list, size_t count, const float *values) {
    for (size_t i = 0; i < count; ++i) {
        put_float(list, values[i], 0);
    }
}

#define GLTF_HEAD "{'asset':{'version':'2.0'},"

/* Three positions (0 0 0, 1 0 0, 0 2 0) as a data URI, and what draws them. */
#define GLTF_TRIANGLE_BUFFER                                                                       \
    "{'byteLength':36,'uri':'data:application/octet-stream;base64,"                                \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA'}"
#define GLTF_TRIANGLE_ACCESSORS                                                                    \
    "'buffers':[" GLTF_TRIANGLE_BUFFER "],'bufferViews':[{'buffer':0,'byteLength':36}],"           \
    "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}]"
#define GLTF_TRIANGLE                                                                              \
    GLTF_TRIANGLE_ACCESSORS ",'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]"

#endif
