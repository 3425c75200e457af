/* For tests: one tetrahedron without colours, written in each format that is read. */
#ifndef BURNISH_TEST_SAME_MESH_H
#define BURNISH_TEST_SAME_MESH_H

#include "gltf_input.h"
#include "zip_input.h"

typedef enum same_kind {
    SAME_STL,
    SAME_STL_TEXT,
    SAME_OBJ,
    SAME_OFF,
    SAME_PLY,
    SAME_PLY_BINARY,
    SAME_GLTF,
    SAME_GLB,
    SAME_3MF, /* last: a build without expat does not read it */
    SAME_COUNT
} same_kind;

static const struct {
    const char *name, *format;
} same_kinds[SAME_COUNT] = {[SAME_STL] = {"a.stl", "stl"},    [SAME_STL_TEXT] = {"text.stl", "stl"},
                            [SAME_OBJ] = {"a.obj", "obj"},    [SAME_OFF] = {"a.off", "off"},
                            [SAME_PLY] = {"text.ply", "ply"}, [SAME_PLY_BINARY] = {"a.ply", "ply"},
                            [SAME_GLTF] = {"a.gltf", "gltf"}, [SAME_GLB] = {"a.glb", "gltf"},
                            [SAME_3MF] = {"a.3mf", "3mf"}};

static const float same_points[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
static const unsigned same_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

/* Appends `format` with three numbers for each of the 4 points, or for each of the 4 faces. */
static inline void same_put_points(byte_list *list, const char *format) {
    char line[160];
    for (int i = 0; i < 4; ++i) {
        const float *p = same_points[i];
        snprintf(line, sizeof line, format, (double)p[0], (double)p[1], (double)p[2]);
        put_text(list, line);
    }
}

static inline void same_put_faces(byte_list *list, const char *format, unsigned base) {
    char line[160];
    for (int i = 0; i < 4; ++i) {
        const unsigned *f = same_faces[i];
        snprintf(line, sizeof line, format, f[0] + base, f[1] + base, f[2] + base);
        put_text(list, line);
    }
}

static inline void same_put_corners(byte_list *list, int i) {
    for (int k = 0; k < 9; ++k) {
        put_float(list, same_points[same_faces[i][k / 3]][k % 3], 0);
    }
}

static inline void same_put_stl(byte_list *list, int is_text) {
    char line[160];
    const uint8_t zeros[80] = {0};
    if (is_text) {
        put_text(list, "solid a\n");
    } else {
        put(list, zeros, 80);
        put_bits(list, 4, 4, 0);
    }
    for (int i = 0; i < 4; ++i) {
        put(list, zeros, is_text ? 0 : 12);
        put_text(list, is_text ? "facet normal 0 0 0\nouter loop\n" : "");
        for (int k = 0; is_text && k < 3; ++k) {
            const float *p = same_points[same_faces[i][k]];
            snprintf(line, sizeof line, "vertex %g %g %g\n", (double)p[0], (double)p[1],
                     (double)p[2]);
            put_text(list, line);
        }
        if (!is_text) {
            same_put_corners(list, i);
        }
        put(list, zeros, is_text ? 0 : 2);
        put_text(list, is_text ? "endloop\nendfacet\n" : "");
    }
    put_text(list, is_text ? "endsolid a\n" : "");
}

static inline void same_put_ply(byte_list *list, int is_text) {
    put_text(list, is_text ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
    put_text(list, "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                   "element face 4\nproperty list uchar int vertex_indices\nend_header\n");
    if (is_text) {
        same_put_points(list, "%g %g %g\n");
        same_put_faces(list, "3 %u %u %u\n", 0);
        return;
    }
    for (int i = 0; i < 12; ++i) {
        put_float(list, same_points[i / 3][i % 3], 0);
    }
    for (int i = 0; i < 12; ++i) {
        put_bits(list, 3, i % 3 == 0, 0);
        put_bits(list, same_faces[i / 3][i % 3], 4, 0);
    }
}

#define SAME_SCENE                                                                                 \
    "'bufferViews':[{'buffer':0,'byteLength':144}],"                                               \
    "'accessors':[{'bufferView':0,'componentType':5126,'count':12,'type':'VEC3'}],"                \
    "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'nodes':[{'mesh':0}]}"

/* The corners as a buffer of GLB, or as a data URI. */
static inline void same_put_gltf(byte_list *list, int is_binary) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static byte_list corners;
    corners.size = 0;
    for (int i = 0; i < 4; ++i) {
        same_put_corners(&corners, i);
    }
    if (is_binary) {
        put_glb(list, "$head'buffers':[{'byteLength':144}]," SAME_SCENE, &corners);
        return;
    }
    put_json(list, "$head'buffers':[{'byteLength':144,'uri':"
                   "'data:application/octet-stream;base64,");
    for (size_t i = 0; i < corners.size; i += 3) {
        const uint8_t *b = corners.bytes + i;
        const unsigned bits = (unsigned)b[0] << 16 | (unsigned)b[1] << 8 | b[2];
        for (int shift = 18; shift >= 0; shift -= 6) {
            put(list, &digits[bits >> shift & 63], 1);
        }
    }
    put_json(list, "'}]," SAME_SCENE);
}

static inline void same_put_3mf(byte_list *list) {
    static byte_list model;
    model.size = 0;
    put_text(&model, "<?xml version='1.0'?><model xmlns='http://schemas.microsoft.com/"
                     "3dmanufacturing/core/2015/02'><resources><object id='1'><mesh><vertices>");
    same_put_points(&model, "<vertex x='%g' y='%g' z='%g'/>");
    put_text(&model, "</vertices><triangles>");
    same_put_faces(&model, "<triangle v1='%u' v2='%u' v3='%u'/>", 0);
    put_text(&model, "</triangles></mesh></object></resources><build><item objectid='1'/></build>"
                     "</model>");
    put(&model, "", 1);
    zip_list *zip = begin_3mf((const char *)model.bytes);
    end_zip(zip, 0);
    put(list, zip->bytes, zip->size);
}

/* The file of a kind. */
static inline void same_mesh(byte_list *list, same_kind kind) {
    list->size = 0;
    switch (kind) {
    case SAME_OBJ:
        same_put_points(list, "v %g %g %g\n");
        same_put_faces(list, "f %u %u %u\n", 1);
        break;
    case SAME_OFF:
        put_text(list, "OFF\n4 4 0\n");
        same_put_points(list, "%g %g %g\n");
        same_put_faces(list, "3 %u %u %u\n", 0);
        break;
    case SAME_PLY:
    case SAME_PLY_BINARY:
        same_put_ply(list, kind == SAME_PLY);
        break;
    case SAME_GLTF:
    case SAME_GLB:
        same_put_gltf(list, kind == SAME_GLB);
        break;
    case SAME_3MF:
        same_put_3mf(list);
        break;
    default:
        same_put_stl(list, kind == SAME_STL_TEXT);
    }
}

#endif
