/* The mesh stream, which importers, separate programs, write for burnish. Layout of its parts;
 * docs/importers.md describes it byte by byte. Numbers are little-endian, floats IEEE. */
#ifndef BURNISH_MESH_READ_BMS_H
#define BURNISH_MESH_READ_BMS_H

#define BURNISH_BMS_MAGIC "\211BMS\r\n\032\n"

enum {
    BURNISH_BMS_VERSION = 1,
    BURNISH_BMS_HEAD_SIZE = 64,
    BURNISH_BMS_TEXTURE_SIZE = 24,
    BURNISH_BMS_MATERIAL_SIZE = 144,
    BURNISH_BMS_SLOTS = 8,

    /* bytes of the head */
    BURNISH_BMS_AT_VERSION = 8,
    BURNISH_BMS_AT_KIND = 12,
    BURNISH_BMS_AT_SIZE = 16, /* 8 bytes: of the whole stream */
    BURNISH_BMS_AT_VERTICES = 24,
    BURNISH_BMS_AT_TRIANGLES = 28,
    BURNISH_BMS_AT_MATERIALS = 32,
    BURNISH_BMS_AT_TEXTURES = 36,
    BURNISH_BMS_AT_PARTS = 40,
    BURNISH_BMS_AT_TEXT_SIZE = 44,
    BURNISH_BMS_AT_UP = 48,
    BURNISH_BMS_AT_UNIT = 60,

    /* bytes of a material: colours are 3 floats, then come single ones */
    BURNISH_BMS_AT_EXPONENT = 48,
    BURNISH_BMS_AT_FLAGS = 72,
    BURNISH_BMS_AT_SLOTS = 76
};

/* The kinds of streams. The text of an error stream is its message. */
typedef enum burnish_bms_kind {
    BURNISH_BMS_MESH,
    BURNISH_BMS_FORMAT_ERROR,
    BURNISH_BMS_LIMIT_ERROR,
    BURNISH_BMS_MEMORY_ERROR,
    BURNISH_BMS_KIND_COUNT
} burnish_bms_kind;

/* Optional parts of a stream, in addition to positions and triangles. */
enum {
    BURNISH_BMS_NORMALS = 1,
    BURNISH_BMS_COLORS = 2,
    BURNISH_BMS_TEXCOORDS = 4,
    BURNISH_BMS_TRIANGLE_MATERIALS = 8,
    BURNISH_BMS_NAMED_PARTS = 16, /* of which triangles consist, with their names */
    BURNISH_BMS_PARTS_ALL = 31
};

/* The flags of a material. */
enum {
    BURNISH_BMS_HAS_DIFFUSE = 1, /* vertex colours multiply its colours */
    BURNISH_BMS_METALLIC = 2,
    BURNISH_BMS_UNLIT = 4,
    BURNISH_BMS_MASK = 8,
    BURNISH_BMS_BLEND = 16,
    BURNISH_BMS_HAS_EXPONENT = 32
};

/* The kind of a texture's bytes. */
typedef enum burnish_bms_picture {
    BURNISH_BMS_FILE,    /* no pixels: its name is a file next to the input */
    BURNISH_BMS_ENCODED, /* PNG, JPEG, ... */
    BURNISH_BMS_PIXELS   /* 4 per texel: red, green, blue, alpha; rows from the top */
} burnish_bms_picture;

#endif
