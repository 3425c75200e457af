/* The contents of an AMF file. */
#ifndef BURNISH_IMPORTERS_AMF_FILE_H
#define BURNISH_IMPORTERS_AMF_FILE_H

#include <expat.h>

#include "importer.h"

enum {
    AMF_DEPTH_MAX = 64,
    AMF_TEXT_SIZE = 64, /* of a number */
    AMF_NUMBERS = 13,   /* that one element has at most */
    AMF_NOTHING = UINT32_MAX
};

typedef struct tint {
    uint8_t rgba[4];
    uint8_t is_there;
} tint;

typedef struct amf_vertex {
    double xyz[3];
    tint color;
} amf_vertex;

typedef struct amf_triangle {
    uint32_t corners[3]; /* of all vertices */
    uint32_t volume;
    tint color;
} amf_triangle;

typedef struct amf_volume {
    uint32_t object, material; /* material: its id; AMF_NOTHING: none */
    tint color;
} amf_volume;

typedef struct amf_object {
    uint32_t id;
    size_t first_vertex, first_triangle, triangle_count;
    int is_placed;
    tint color;
} amf_object;

typedef struct amf_material {
    uint32_t id;
    tint color;
} amf_material;

typedef struct amf_instance {
    uint32_t id; /* of an object or a constellation */
    double matrix[12];
} amf_instance;

typedef struct amf_constellation {
    uint32_t id;
    size_t first, count; /* instances */
    int is_placed;
} amf_constellation;

#define LIST(type)                                                                                 \
    struct {                                                                                       \
        type *items;                                                                               \
        size_t count, capacity;                                                                    \
    }

typedef struct amf {
    importer_mesh *mesh;
    XML_Parser parser;
    uint8_t elements[AMF_DEPTH_MAX + 1];
    int depth;
    char text[AMF_TEXT_SIZE]; /* of a number's element */
    size_t text_size;
    int slot;
    double numbers[AMF_NUMBERS];
    int has_number[AMF_NUMBERS];
    double outer[AMF_NUMBERS]; /* of the triangle around a colour */
    int has_outer[AMF_NUMBERS];
    LIST(amf_vertex) vertices;
    LIST(amf_triangle) triangles;
    LIST(amf_volume) volumes;
    LIST(amf_object) objects;
    LIST(amf_material) materials;
    LIST(amf_instance) instances;
    LIST(amf_constellation) constellations;
    int has_colors;
    uint64_t placed; /* triangles */
    int is_counting;
} amf;

/* Reads the file into the lists; ends the process if it is broken. */
void amf_parse(amf *a, const importer_input *input);

#endif
