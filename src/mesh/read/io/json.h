/* JSON (RFC 8259), strictly by its grammar.
 *
 * A document becomes one array of small nodes in the order of the text, which is not copied: 12
 *   bytes per value at any depth. Numbers and strings are parsed on access. */
#ifndef BURNISH_MESH_READ_IO_JSON_H
#define BURNISH_MESH_READ_IO_JSON_H

#include "mesh/read/io/reader.h"

/* The nesting depth of arrays and objects. */
#define BURNISH_JSON_DEPTH 64

/* A missing value. */
#define BURNISH_JSON_NONE UINT32_MAX

typedef enum burnish_json_kind {
    BURNISH_JSON_NULL,
    BURNISH_JSON_FALSE,
    BURNISH_JSON_TRUE,
    BURNISH_JSON_NUMBER,
    BURNISH_JSON_STRING,
    BURNISH_JSON_ARRAY,
    BURNISH_JSON_OBJECT
} burnish_json_kind;

/* A value. An array is followed by its items, and an object by its keys (strings) and values in
 * turn. */
typedef struct burnish_json_node {
    uint32_t first; /* its first byte; of a string the one after the quote */
    uint32_t size;  /* bytes of a number or string; items of an array; members of an object */
    uint32_t kind : 3;
    uint32_t next : 29; /* the value after it and its contents */
} burnish_json_node;

typedef struct burnish_json {
    const uint8_t *bytes;
    burnish_json_node *nodes; /* count of them; 0 is the document's value */
    size_t count, capacity;
} burnish_json;

/* Parses `size` bytes, which must remain valid. Errors: FORMAT, LIMIT (4 GiB, 2^29 values), MEMORY.
 */
burnish_status burnish_json_parse(burnish_reader *reader, const uint8_t *bytes, size_t size,
                                  burnish_json *json);
void burnish_json_destroy(const burnish_context *context, burnish_json *json);

static inline int burnish_json_is_kind(const burnish_json *json, uint32_t value,
                                       burnish_json_kind kind) {
    return value != BURNISH_JSON_NONE && json->nodes[value].kind == (uint32_t)kind;
}

/* The byte at which a value begins. */
static inline const uint8_t *burnish_json_at(const burnish_json *json, uint32_t value) {
    return json->bytes + json->nodes[value].first;
}

/* Members of an object that are searched. No format has objects with so many keys, and the limit
 * bounds the time of each look-up. */
#define BURNISH_JSON_MEMBERS 256

/* The value of a key; NONE if it is missing, or `object` is not an object. Of two equal keys the
 * first counts. */
uint32_t burnish_json_member(const burnish_json *json, uint32_t object, const char *key);

/* Items of an array; 0 for other values. The first is array + 1, the one after i is nodes[i].next.
 */
size_t burnish_json_length(const burnish_json *json, uint32_t array);

/* The nearest double; returns 0 if the value is not a number or exceeds the range of doubles. */
int burnish_json_number(const burnish_json *json, uint32_t value, double *number);

/* Whether a value is a string of this text. */
int burnish_json_is_text(const burnish_json *json, uint32_t value, const char *text);

/* Writes a string without its escapes, in UTF-8, with a 0 at the end. Room for the node's size + 1
 * bytes is enough. Returns the bytes written, without the 0; a string that does not fit is cut. A
 * value of another kind gives an empty string. */
size_t burnish_json_text(const burnish_json *json, uint32_t value, char *text, size_t room);

/* "accessors[5].byteOffset": the path of a value, for messages; "" for the document. */
typedef struct burnish_json_path {
    char text[120];
} burnish_json_path;
burnish_json_path burnish_json_path_of(const burnish_json *json, uint32_t value);

#endif
