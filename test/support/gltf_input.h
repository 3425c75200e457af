/* For tests of the glTF reader: files put together by hand. */
#ifndef BURNISH_TEST_GLTF_INPUT_H
#define BURNISH_TEST_GLTF_INPUT_H

#include "reader_input.h"

static const float gltf_triangle[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};

/* Words after $ that put_json replaces; #1 to #4 are their arguments, #4 is all that is left, #0
 * all of them. Positions of the triangle: gltf_triangle. */
static const struct {
    const char *word, *text;
} gltf_words[] = {
    {"head", "{'asset':{'version':'2.0'},"},
    {"buffer", "'buffers':[{'byteLength':#1}]"},
    {"view", "{'buffer':0,'byteOffset':#1,'byteLength':#2}"},
    {"accessor", "{'bufferView':#1,'componentType':#2,'count':#3,'type':'#4'}"},
    {"part", "{'bufferView':0,'byteOffset':#1,'componentType':#2,'count':#3,'type':'#4'}"},
    {"packed", "{'buffer':#1,'byteLength':9,'extensions':{'EXT_meshopt_compression':{'buffer':0,"
               "'byteOffset':#2,'byteLength':#3,#4}}}"},
    {"mesh", "'meshes':[{'primitives':[{'attributes':{#0}}]}]"},
    {"node", "'nodes':[{'mesh':0}]"},
    {"painted", "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}],$node"},
    {"triangle_buffer", "{'byteLength':36,'uri':'data:application/octet-stream;base64,"
                        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA'}"},
    {"triangle_accessors", "'buffers':[$triangle_buffer],'bufferViews':[{'buffer':0,"
                           "'byteLength':36}],'accessors':[$accessor(0,5126,3,VEC3)]"},
    {"triangle", "$triangle_accessors,$mesh('POSITION':0)"},
    {"image", "{'uri':'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAA"
              "DUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=='}"}};

static inline void put_json(byte_list *list, const char *text);

/* Writes the replacement of the word at text + 1; returns the byte after it and its arguments. */
static inline const char *put_gltf_word(byte_list *list, const char *text) {
    char expanded[512];
    const char *from = NULL, *arguments[6];
    const size_t length = strspn(++text, "abcdefghijklmnopqrstuvwxyz_");
    size_t size = 0;
    int count = 0;
    for (size_t i = 0; i < sizeof gltf_words / sizeof *gltf_words; ++i) {
        if (strlen(gltf_words[i].word) == length && !memcmp(gltf_words[i].word, text, length)) {
            from = gltf_words[i].text;
        }
    }
    text += length;
    if (strchr(from, '#')) {
        for (arguments[count++] = ++text; *text != ')'; ++text) {
            if (*text == ',' && count < 4) {
                arguments[count++] = text + 1;
            }
        }
        arguments[count] = ++text;
    }
    for (; *from; ++from) {
        const int number = *from == '#' ? *++from - '0' : -1;
        const char *part = number < 0 ? from : arguments[number > 0 ? number - 1 : 0];
        const char *end = number < 0 ? from + 1 : arguments[number > 0 ? number : count] - 1;
        memcpy(expanded + size, part, (size_t)(end - part));
        size += (size_t)(end - part);
    }
    expanded[size] = 0;
    put_json(list, expanded);
    return text;
}

/* JSON with ' for ", and with the words above. */
static inline void put_json(byte_list *list, const char *text) {
    while (*text) {
        if (*text == '$') {
            text = put_gltf_word(list, text);
        } else {
            put(list, *text == '\'' ? "\"" : text, 1);
            ++text;
        }
    }
}

/* A GLB of a JSON text and a binary chunk. */
static inline void put_glb(byte_list *list, const char *json, const byte_list *binary) {
    enum { HEADS = 20 };
    static byte_list text;
    const size_t binary_size = (binary->size + 3) & ~(size_t)3;
    text.size = 0;
    put_json(&text, json);
    while (text.size % 4 != 0) {
        put_text(&text, " ");
    }
    put_text(list, "glTF");
    put_bits(list, 2, 4, 0);
    put_bits(list, HEADS + text.size + 8 + binary_size, 4, 0);
    put_bits(list, text.size, 4, 0);
    put_text(list, "JSON");
    put(list, text.bytes, text.size);
    put_bits(list, binary_size, 4, 0);
    put(list, "BIN", 4);
    put(list, binary->bytes, binary->size);
    while (list->size % 4 != 0) {
        put_bits(list, 0, 1, 0);
    }
}

static inline burnish_status read_glb(const char *json, const byte_list *binary) {
    static byte_list list;
    list.size = 0;
    put_glb(&list, json, binary);
    return read_bytes(BURNISH_FORMAT_GLTF, list.bytes, list.size);
}

static inline burnish_status read_gltf(const char *json) {
    static byte_list list;
    list.size = 0;
    put_json(&list, json);
    return read_bytes(BURNISH_FORMAT_GLTF, list.bytes, list.size);
}

static inline void read_good(const char *json, const byte_list *binary) {
    const burnish_status status = binary ? read_glb(json, binary) : read_gltf(json);
    CHECK(status == BURNISH_STATUS_OK, "%s: %s", json, fault.text);
}

static inline void put_floats(byte_list *list, size_t count, const float *values) {
    for (size_t i = 0; i < count; ++i) {
        put_float(list, values[i], 0);
    }
}

#endif
